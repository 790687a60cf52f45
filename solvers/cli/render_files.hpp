// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "etendue/image/exposure.hpp"
#include "etendue/image/scan_line.hpp"
#include "etendue/io/scene_reader.hpp"
#include "render_request.hpp"

// The files of `etendue render`.
namespace etendue::cli {

struct RenderFiles {
  std::filesystem::path exr, png;
  std::filesystem::path saved;  ///< what --resume goes on from
  double scale = 1;             ///< what the PNG's values are multiplied by
  Brightness bright;            ///< of the PNG, before values above 1 are treated
  std::filesystem::path svg;    ///< of --scan-line; empty where there is none
  Jumps jumps;                  ///< along that line
};

/// The files' names, when complete or when stopped.
[[nodiscard]] RenderFiles render_files(const RenderRequest& request, bool complete);

/// All files that a run may write.
[[nodiscard]] std::vector<std::filesystem::path> render_outputs(const RenderRequest& request);

/// Writes both pictures; of a stopped rendering also what --resume goes on from; of a complete one, removes what earlier
/// stopped runs that it went on from left behind.
[[nodiscard]] Result<RenderFiles> write_rendering(const RenderRequest& request, const SceneFile& file,
                                                  const Rendering& rendering);

/// What a stopped run of the same scene and settings has saved.
///
/// Errors    invalid_input: of another scene, other settings, or damaged. input_output: cannot be read
[[nodiscard]] Result<Rendering> read_saved(const RenderRequest& request, const SceneFile& file);

/// The picture as the PNG will show it, to look at while it is rendered.
[[nodiscard]] Result<Done> write_preview(const RenderRequest& request, const Image& image);

}  // namespace etendue::cli
