// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/result.hpp"
#include "etendue/io/openimageio_module.hpp"

namespace etendue {

/// The module that holds OpenImageIO, opened on the first call and kept. Looked for as libetendue_io.so, in this order:
/// the file named by the environment variable ETENDUE_IO; beside the program; ../lib/etendue from there; the same under
/// the library folder of the installation. Errors    input_output: not found or of another version; the message lists
/// where it was looked for.
[[nodiscard]] Result<const EtendueImageModule*> image_module();

}  // namespace etendue
