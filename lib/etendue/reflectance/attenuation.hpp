// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/floating_point.hpp"

namespace etendue {

/// Weakening of a light with distance, as shading models use it: a straight line in the denominator.
///
///     f(d) = 1 / max(1, d + d0)                                                     @eq IU.2-5, IU.2-6, IU.2-7
///
/// Symbols   d distance to the light, d0 ≥ 0 a constant chosen by eye, in the same unit
/// Returns   value in (0, 1], falling in d. The printed 1/(d + d0) amplifies where d + d0 < 1 (G3): there a light
///           would return more than it was given. The cap ends that and changes nothing elsewhere; the factor stays
///           continuous, and its meaning plain: nothing is lit more strongly than by the light's own intensity.
///           Where d0 ≥ 1, the cap never acts
/// Accuracy  relative error of at most 2.1 u: one sum, one quotient
/// Errors    ContractViolation unless both are finite and not negative
[[nodiscard]] double linear_attenuation(double distance, double d0);

/// Irradiance at normal incidence from a point that radiates `power` evenly in all directions.
///
///     E = Φ / (4 π d²)                                                                        @eq IU.2.6a
///
/// Symbols   Φ power [W]; d distance [m], > 0; E irradiance [W/m²]. It falls with the square of the distance, and Φ
///           is a power; where 2-2 takes I_p it means an irradiance, 4 π d² smaller (E7)
/// Accuracy  relative error of at most 4.1 u
/// Errors    ContractViolation unless power is not negative, distance positive, both finite, and d² a normal number
[[nodiscard]] double irradiance_of_power(double power, double distance);

/// The same for a source known by its intensity: E = I / d².                                   @eq IU.2.6a
/// Symbols   I radiant intensity [W/sr] in the direction of the point
/// Accuracy  relative error of at most 2.1 u
[[nodiscard]] double irradiance_of_intensity(double intensity, double distance);

/// How the light of a point weakens with distance.
struct Falloff {
  enum class Law { none, linear, inverse_square };
  Law law = Law::none;
  double unit = 1;  ///< [length] that distances are counted in, > 0
  double d0 = 0;    ///< of the linear law, in units
};

/// What of a light's I_p is left at a distance: 1, linear_attenuation() of d/unit, or (unit/d)².     @eq IU.2-5, IU.2.6a
/// Domain    distance ≥ 0; unit > 0, d0 ≥ 0
/// Returns   0 by the inverse square where (d/unit)² is no normal number: at the light itself, or nowhere near it
[[nodiscard]] double arriving_share(const Falloff& falloff, double distance);

}  // namespace etendue
