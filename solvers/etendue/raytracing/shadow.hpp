// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/raytracing/media.hpp"

namespace etendue {

/// What transparent surfaces do to a shadow ray.                                                   @eq IU.f50s, IU.5.4a
enum class ShadowKind {
  attenuated,  ///< they weaken the light, along the straight line: no refraction, hence no caustics
  opaque,      ///< they block it, as any surface does
};

/// How a shadow ray is kept from meeting the surface that it begins on, which shows as acne.        @eq IU.5.4b, G8
enum class AcneCure {
  error_bound,      ///< it begins outside the error bound of the hit: ours
  tolerance,        ///< the text's first: hits nearer than kShadowTolerance do not count
  moved_origin,     ///< its second: it begins kShadowTolerance farther towards the light
  convex_left_out,  ///< its third: a convex surface does not shade itself, other surfaces are not cured
  none,             ///< it begins at the hit
};

/// The text's ε: absolute, so that it vanishes in the rounding of large coordinates and leaps over small objects (G8).
inline constexpr double kShadowTolerance = 1e-5;

/// How shadows are found.
struct Shadows {
  ShadowKind kind = ShadowKind::attenuated;
  AcneCure cure = AcneCure::error_bound;
};

/// Where a shadow ray begins, besides its origin.
struct ShadowStart {
  std::size_t object;     ///< on which surface
  Media media = {};       ///< in what
  double wavelength = 0;  ///< [nm]; 0: all light at once
};

/// What is left of light at the end of a shadow ray.
struct Passage {
  Rgb share = Rgb::Ones();  ///< per channel, in [0, 1]
  TestCount tests;
};

/// The share of light that a shadow ray lets pass.                                             @eq IU.f50s, IU.5.4a, IU.5.4b
///
///     share = Π k · Π exp(−σ d)        over the transparent surfaces and the stretches of absorbing bodies on the way
///
/// Symbols   k = k_t; with Fresnel's factor (k_r + k_t)(1 − F) for the angle of the straight line, taken on the side of the
///           smaller index, where it is the physical one for a body that is entered; σ, d as in transmittance()
/// Returns   0 at an opaque surface, and at any surface with opaque shadows; surfaces hidden in a body of higher
///           priority let everything pass
[[nodiscard]] Passage passage(const Ray& shadow_ray, const ShadowStart& start, const Accelerator& accelerator,
                              const Shadows& shadows);

}  // namespace etendue
