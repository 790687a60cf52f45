// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "etendue/core/result.hpp"

namespace etendue::validation {

/// A file that is opened under a temporary name before the work starts, and gets its own name when it is complete.
class OutputFile {
 public:
  /// Refuses paths that cannot be written.
  [[nodiscard]] static Result<std::unique_ptr<OutputFile>> open(const std::string& path);

  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();  ///< removes the temporary file if commit() did not succeed

  /// Writes everything and renames.
  [[nodiscard]] Result<Done> commit(std::string_view content);

 private:
  OutputFile(std::string path, std::string temporary, int descriptor);
  Error failure(const char* what) const;

  std::string path_;
  std::string temporary_;
  int descriptor_;
  bool committed_ = false;
};

}  // namespace etendue::validation
