// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/result.hpp"
#include "etendue/io/openimageio_module.hpp"

namespace etendue {

/// The module that holds OpenImageIO, opened on the first call and kept. Looked for as libetendue_io.so, in this order:
/// the file named by the environment variable ETENDUE_IO, and nowhere else where that is set; beside the program;
/// ../lib/etendue from there; the library folder of the installation as configured; the run path of the program, to
/// which linking with etendue::solvers adds the folder of the module.
///
/// Errors    input_output: not found or of another version; the message lists where it was looked for
[[nodiscard]] Result<const EtendueImageModule*> image_module();

}  // namespace etendue
