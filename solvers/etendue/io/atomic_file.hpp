// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "etendue/core/result.hpp"

namespace etendue {

/// Makes a file that is either complete or absent: `write` fills a temporary file beside `path` (hidden, same
/// extension, since some writers choose the format by it), which then takes the name `path`, replacing what was there.
/// When `write` fails or throws, or the name cannot be taken, the temporary file is removed and `path` is as it was.
///
/// Errors    input_output "cannot write 'path': reason"; `write`'s own error as it is. A target that is a device, a
///           pipe or a directory is refused by name, for renaming over it would replace it.
[[nodiscard]] Result<Done> write_atomically(const std::filesystem::path& path,
                                            const std::function<Result<Done>(const std::filesystem::path&)>& write);

/// write_atomically() of these bytes.
[[nodiscard]] Result<Done> write_file(const std::filesystem::path& path, std::string_view bytes);

/// All bytes of a regular file.
/// Errors    input_output "cannot read 'path': reason" (missing, a directory, larger than `kLargestFile`)
[[nodiscard]] Result<std::string> read_file(const std::filesystem::path& path);

/// 1 GiB: a scene that needs more belongs into several files; protects from reading an endless device.
inline constexpr std::uintmax_t kLargestFile = std::uintmax_t{1} << 30;

}  // namespace etendue
