// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "etendue/core/result.hpp"

namespace etendue {

/// A file to be.
struct NewFile {
  std::filesystem::path path;
  std::string bytes;
};

/// Writes files that belong together. Each is filled under a hidden name beside its path and on the disk before the
/// first takes its own name, replacing what was there: when one cannot be written, all paths are as they were and
/// nothing half-written stays. A link stays a link: what it points to is replaced.
///
/// Errors    input_output "cannot write 'path': reason", naming the path as given. A target that is a device, a pipe or
///           a folder is refused, for renaming over it would replace it.
[[nodiscard]] Result<Done> write_files(const std::vector<NewFile>& files);

/// write_files() of one.
[[nodiscard]] Result<Done> write_file(const std::filesystem::path& path, std::string_view bytes);

/// Takes the next piece of a file.
using Append = std::function<Result<Done>(std::string_view piece)>;

/// write_file() of what `produce` appends, for files too large to be held in memory. An error of `produce` ends it, and
/// the path is as it was.
[[nodiscard]] Result<Done> write_pieces(const std::filesystem::path& path,
                                        const std::function<Result<Done>(const Append& append)>& produce);

/// Would write_files() to these paths be let? Makes the hidden file beside each, and removes it: to be asked before a
/// long computation. Only a lack of space can stop the writing later, or who meddles with the folder meanwhile.
///
/// Errors    as write_files()
[[nodiscard]] Result<Done> check_writable(const std::vector<std::filesystem::path>& paths);

/// All bytes of a regular file.
/// Errors    input_output "cannot read 'path': reason" (missing, a directory, larger than `kLargestFile`)
[[nodiscard]] Result<std::string> read_file(const std::filesystem::path& path);

/// 1 GiB: a scene that needs more belongs into several files; protects from reading an endless device.
inline constexpr std::uintmax_t kLargestFile = std::uintmax_t{1} << 30;

}  // namespace etendue
