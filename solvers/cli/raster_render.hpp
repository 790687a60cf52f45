// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iosfwd>

#include "render_files.hpp"

namespace etendue::cli {

/// `etendue render --method raster`, with all options settled: draws, writes, reports; returns the exit code. Says on `err`, once,
/// what of the scene the picture leaves out.
int render_by_raster(const RenderRequest& request, const SceneFile& file, std::ostream& out, std::ostream& err);

}  // namespace etendue::cli
