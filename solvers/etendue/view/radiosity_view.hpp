// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/execution/execution.hpp"
#include "etendue/image/image.hpp"
#include "etendue/view/vertex_radiosity.hpp"

namespace etendue {

/// Surfaces nearer to the eye than this share of the scene's diagonal are cut away: the projection divides by depth.
inline constexpr double kNearPlane = 0x1p-40;

/// A picture of a solved scene: radiosities, not display values.                         @eq IU.6.5, IU.6.5v, IU.5.2
///
/// Each element is drawn as a fan around its centroid, whose value is the mean of its corners, so that no diagonal is
/// preferred; depth-buffered, interpolated linearly on the surface (Gouraud), `samples` × `samples` centres a pixel,
/// averaged. A surface shows its front only: a camera outside a room looks through the back of the nearest wall.
///
/// Domain    any camera that camera_frame() accepts; columns and rows times samples at most 2^16; samples ≥ 1
/// Returns   B at what each pixel shows [W/m²]; `background` where that is nothing
/// Errors    those of camera_frame(); a picture that is too large; ErrorCode::stopped, between elements
[[nodiscard]] Result<Image> view_radiosities(const Camera& camera, const ElementMesh& mesh,
                                             const VertexRadiosities& radiosities, const Rgb& background, int samples,
                                             const Execution& execution = {});

/// What a display value of one stands for: the largest vertex radiosity, in any channel, of elements that do not emit;
/// with emitters only, theirs; 1 where all is dark.
[[nodiscard]] double white_level(const Scene& scene, const ElementMesh& mesh, const VertexRadiosities& radiosities);

}  // namespace etendue
