// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "render_files.hpp"

namespace etendue::cli {

/// What a rendering was, for people.
void print_text(std::ostream& out, const RenderRequest& request, const SceneFile& file, const Rendering& rendering,
                const RenderFiles& written, double seconds);

/// The same for machines.
void print_json(std::ostream& out, const RenderRequest& request, const SceneFile& file, const Rendering& rendering,
                const RenderFiles& written, double seconds);

/// What the rasteriser tells besides its picture.
struct RasterFacts {
  std::size_t facets = 0;  ///< triangles
  std::vector<std::string> left_out;
  double seconds = 0;
};
void print_raster_text(std::ostream& out, const RenderRequest& request, const SceneFile& file,
                       const Rendering& rendering, const RenderFiles& written, const RasterFacts& facts);
void print_raster_json(std::ostream& out, const RenderRequest& request, const SceneFile& file,
                       const Rendering& rendering, const RenderFiles& written, const RasterFacts& facts);

}  // namespace etendue::cli
