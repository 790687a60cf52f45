// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/execution/execution.hpp"
#include "etendue/image/image.hpp"
#include "etendue/view/vertex_radiosity.hpp"

namespace etendue {

/// The picture that view_radiosities() draws, by rays: each sample's ray meets the nearest front, and the point there has its
/// value from the same fan of triangles. Nothing is snapped to a grid and nothing interpolated in the picture: the two agree
/// but where an outline passes between a sample and its snapped place.                  @eq IU.6.5, IU.6.5v, IU.5.2
///
/// Domain    any camera that camera_frame() accepts; samples ≥ 1
/// Returns   B at what each pixel shows [W/m²]; `background` where that is nothing
/// Errors    those of camera_frame(); ErrorCode::stopped, between rows
[[nodiscard]] Result<Image> trace_radiosities(const Camera& camera, const ElementMesh& mesh,
                                              const VertexRadiosities& radiosities, const Rgb& background, int samples,
                                              const Execution& execution = {});

}  // namespace etendue
