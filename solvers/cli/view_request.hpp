// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "etendue/io/camera_file.hpp"
#include "options.hpp"
#include "saved_solution.hpp"
#include "tone_options.hpp"

namespace etendue::cli {

/// What `etendue view` was asked.
struct ViewRequest {
  CommonOptions common;  ///< its `output` is not used: there may be several
  std::filesystem::path solution;
  std::vector<std::filesystem::path> cameras, outputs;
  std::filesystem::path scene;
  std::optional<std::string> eye, look_at, gaze, up, resolution;  ///< as typed
  double fov = 0;                                                 ///< horizontal, degrees; 0: not given
  std::string method = "raster";
  ToneOptions tone;
  int samples = 3;
  bool draw_mesh = false, ambient = false;
};

void declare(Options& options, ViewRequest& request);

/// What parsing cannot see: options that contradict one another.
[[nodiscard]] std::optional<std::string> contradiction(const ViewRequest& request);

/// The cameras to look through: those of --camera, or the solution's own, each changed by --eye and the like.
///
/// Errors    those of read_cameras(); usage: an option that is no point, direction or size; a camera that sees nothing definite
[[nodiscard]] Result<std::vector<NamedCamera>> cameras_of(const ViewRequest& request, const Scene& scene);

}  // namespace etendue::cli
