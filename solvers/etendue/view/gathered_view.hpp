// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/execution/execution.hpp"
#include "etendue/gather/radiosity_field.hpp"
#include "etendue/image/image.hpp"
#include "etendue/meshing/elements.hpp"

namespace etendue {

/// A picture of a solved scene whose values are not interpolated but gathered anew at what each pixel shows.
///
///     B(x) = E + ρ H(x),   H(x) = Σ_j F_xj B_j                                    @eq IU.6-7, IU.6-2, IU.6-4, IU.6.5v
///
/// Symbols   E, ρ of the surface that is shown; F_xj exact factors from its point x to the elements, past all that stands
///           in the way (FinalGather::irradiance()), B_j the radiosities that were solved, linear within elements
/// Samples   samples × samples rays a pixel decide which surfaces it shows, and how much of each. Each of these is gathered
///           once a pixel, at the hit that is nearest to the mean of its hits; with one sample at the pixel's centre
/// Points    within FinalGather::slack() of another surface, where a hair's breadth would decide what they see, are moved
///           towards their element's centroid until they are not
/// Domain    any camera that camera_frame() accepts; samples ≥ 1; materials of `scene` are those of the mesh
/// Returns   B at what each pixel shows [W/m²]; `background` where that is nothing
/// Accuracy  as FinalGather::irradiance(): shadows and highlights are not bound to the mesh. Nothing is sampled but pixels
/// Order     the same bits with any number of threads
/// Errors    those of camera_frame(); ErrorCode::stopped, between parts of rows
[[nodiscard]] Result<Image> gather_radiosities(const Camera& camera, const Scene& scene, const ElementMesh& mesh,
                                               const RadiosityField& field, const Rgb& background, int samples,
                                               const Execution& execution = {});

}  // namespace etendue
