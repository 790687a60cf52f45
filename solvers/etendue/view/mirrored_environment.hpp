// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/scene/scene.hpp"

namespace etendue {

/// What a surface mirrors of the images of its surroundings, where no ray is followed.                     @eq IU.4.1.3
///
///     k E(R),   R = D − 2 (D·N) N;   k = k_r, or by Fresnel (k_r + k_t) F
///
/// Symbols   E colours of the images; D direction of view, `smooth` and `shaded` unit normals on the viewer's side, N the shaded
///           one, with bumps; R is kept on the smooth one's side
/// Domain    a material with an environment; outside, where the index is 1
/// Returns   what shade() adds for the ray that the tracer mirrors there
[[nodiscard]] Rgb mirrored_environment(const Material& material, const Vec3& direction, const Vec3& smooth,
                                       const Vec3& shaded);

}  // namespace etendue
