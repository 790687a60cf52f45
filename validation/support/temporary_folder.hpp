// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace etendue::validation {

/// An empty folder of its own for a test; removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();

  const std::filesystem::path& path() const { return path_; }

  /// Makes a file in it and returns its path.
  std::filesystem::path add(const std::string& name, std::string_view text) const;

  /// Names of all it holds, hidden files too, in alphabetical order, joined by spaces.
  std::string contents() const;

 private:
  std::filesystem::path path_;
};

/// All bytes of a file; throws when it cannot be read.
std::string read_text(const std::filesystem::path& path);

}  // namespace etendue::validation
