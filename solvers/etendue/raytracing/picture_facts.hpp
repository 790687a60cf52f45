// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/raytracing/render.hpp"
#include "etendue/scene/camera_frame.hpp"

namespace etendue {

/// The facts of one pixel, in the order in which they are asked for; what is one number stands in all three channels.
[[nodiscard]] std::vector<Rgb> picture_facts(const Accelerator& accelerator, const CameraFrame& frame, int column,
                                             int row, const PixelWork& work, const std::vector<PictureFact>& facts);

/// How pictures name a fact ("tree_depth"), and the channels that it fills ("tree_depth", or "normal.X" …).
[[nodiscard]] std::string name(PictureFact fact);
[[nodiscard]] std::vector<std::string> channel_names(PictureFact fact);

/// All of them, in the order in which they are declared.
[[nodiscard]] const std::vector<PictureFact>& all_picture_facts();

}  // namespace etendue
