// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/result.hpp"
#include "etendue/image/image.hpp"
#include "etendue/meshing/elements.hpp"

namespace etendue {

/// How much of each pixel the outlines of the elements cover, as view_radiosities() shows them: fronts only, nearest
/// first.                                                                                                @eq IU.f65
///
/// Returns   in each channel the share of samples × samples points of the pixel whose neighbour to the right or below shows
///           another element
/// Errors    those of camera_frame()
[[nodiscard]] Result<Image> mesh_lines(const Camera& camera, const ElementMesh& mesh, int samples);

/// The picture with lines of brightness `line` drawn over it.
[[nodiscard]] Image drawn_over(const Image& picture, const Image& lines, double line);

}  // namespace etendue
