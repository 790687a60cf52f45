// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "etendue/acceleration/accelerator.hpp"
#include "etendue/core/result.hpp"
#include "etendue/image/exposure.hpp"
#include "etendue/raytracing/render.hpp"
#include "etendue/view/shaded_view.hpp"
#include "options.hpp"
#include "tone_options.hpp"

namespace etendue::cli {

inline constexpr int kUsualTreeDepth = 12;

/// What `etendue render` is asked for: options as typed, and what they mean (after settle()).
struct RenderRequest {
  CommonOptions common;
  std::filesystem::path scene;
  std::filesystem::path preview;  ///< empty: none
  RenderOptions render;
  std::string method = "raytrace";
  std::string shading, vertex_normals, stepping;  ///< empty: not given, phong, angle, direct
  int facets = 0;                                 ///< 0: not given
  double crease_deg = -1;                         ///< negative: not given
  std::string overflow = "clamp";
  std::string accelerator = "bvh";
  std::string sampling = "uniform";
  std::string filter = "box";
  std::string shadows = "attenuated";
  std::string acne_cure = "bound";
  double filter_width = 0;  ///< 0: the filter's own
  int seed = 0;
  ToneOptions tone;
  std::optional<std::string> pixel;  ///< of --ray-tree
  std::optional<std::string> size, threshold, crop, facts, scan_line;
  std::optional<std::string> cube, hide;  ///< a place, as typed; the name of an object
  std::optional<Vec3> cube_eye;           ///< of --cube, after settle()
  struct LinePart {
    int row, first, last;
  };
  std::optional<LinePart> line;  ///< of --scan-line, after settle_size()
  int columns = 0;               ///< 0: as the scene says
  bool progress = false;
  bool resume = false;

  bool by_raster() const { return method == "raster"; }
  ShadingOptions shading_options() const;
  Overflow overflow_treatment() const;
  /// All that the picture depends on, besides the scene file: "500 × 500, depth 12, …".
  std::string settings(const Camera& camera) const;
  /// "uniform 2 × 2", "adaptive to 4 × 4, contrast 0.25, 0.2, 0.4": of pictures and reports.
  std::string sampling_text() const;
  std::string filter_text() const;
  /// "phong, 48 facets, normals by angle, creases of 60°"
  std::string shading_text() const;
};

void declare(Options& options, RenderRequest& request);

/// Options that contradict each other or cannot be read, whatever the scene; else fills request.render with them.
[[nodiscard]] std::optional<std::string> settle(RenderRequest& request);

/// The same of --columns, --size, --crop and --scan-line, which need the scene's camera; it gets its new size.
[[nodiscard]] std::optional<std::string> settle_size(RenderRequest& request, Camera& camera);

}  // namespace etendue::cli
