// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/raytracing/sample_key.hpp"
#include "etendue/scene/scene.hpp"

namespace etendue {

/// How many shadow rays a light gets: 1, or N² of one with an area.                                @eq IU.2.1, IU.5.4a
[[nodiscard]] int shadow_rays(const Light& light);

/// Point light `index` of those that an area light is: a random point in part (index mod N, ⌊index/N⌋) of N × N parts of equal
/// area, with the N²-th share of its intensity.
///
///     rectangle   corner + (i + a)/N u + (j + b)/N v
///     sphere      centre + radius (√(1 − z²) cos φ, √(1 − z²) sin φ, z),  z = 1 − 2 (i + a)/N,  φ = 2π (j + b)/N
///
/// Symbols   a, b numbers 2 index and 2 index + 1 of the key
/// Domain    a RectangleLight or a SphereLight; index in [0, N²)
[[nodiscard]] PointLight light_part(const Light& light, int index, const SampleKey& key);

}  // namespace etendue
