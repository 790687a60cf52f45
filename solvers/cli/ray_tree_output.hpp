// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "etendue/io/scene_reader.hpp"
#include "etendue/raytracing/ray_tree.hpp"

namespace etendue::cli {

struct Pixel {
  int column, row;
};

/// "COLUMN,ROW" of a pixel in the picture; nothing where it is not.
[[nodiscard]] std::optional<Pixel> read_pixel(const std::string& text, const Camera& camera);

/// The tree of the ray through a pixel's centre, from an eye that may stand in a transparent body; a wavelength [nm], or 0.
///
/// Errors    those of camera_frame()
[[nodiscard]] Result<RayTree> pixel_tree(const Accelerator& accelerator, const Pixel& pixel, const TreeLimits& limits,
                                         double wavelength = 0);

/// The tree of a pixel's ray as a machine reads it: one JSON object, `rays` in the tree's order, numbers to the last bit.
[[nodiscard]] std::string ray_tree_json(const RayTree& tree, const SceneFile& file, const Pixel& pixel,
                                        const TreeLimits& limits);

}  // namespace etendue::cli
