// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

// The laws of optics in ball arithmetic (600 bits) and, where a sign decides, in exact dyadic arithmetic. Each function
// takes doubles as the exact numbers they are, divides out the lengths of direction vectors, evaluates the textbook
// formula, and returns how far a candidate is from it: an upper bound, so that a comparison never passes by luck.
namespace etendue::oracle {

using Triple = std::array<double, 3>;

/// |candidate − R|, R = 2 N (N·V) − V with V = −direction.
double distance_to_reflection(const Triple& direction, const Triple& normal, const Triple& candidate);

/// Sign of 1 − η² sin²θ, exactly: −1 total internal reflection, 0 the critical angle, 1 refraction.
int sign_of_radicand(const Triple& direction, const Triple& normal, double eta);

/// |candidate − cos θ'|. Demands that sign_of_radicand is not −1.
double distance_to_refracted_cosine(const Triple& direction, const Triple& normal, double eta, double candidate);

/// |candidate − T|, T of 5-7 with the normal turned to the side of incidence (to its own side where δ·s = 0).
/// Demands that sign_of_radicand is not −1.
double distance_to_refraction(const Triple& direction, const Triple& normal, double eta, const Triple& candidate);

/// |candidate/F − 1|, F from the two angles by sines and tangents; 1 beyond the critical angle. Demands eta ≠ 1.
double relative_distance_to_fresnel(double cosine, double eta, double candidate);

/// Share of the power that is transmitted, from the amplitude ratios t_s and t_p. Demands refraction.
double fresnel_transmittance(double cosine, double eta);

/// |candidate − max(0, min(1, R·V))ⁿ|, R of the normalised light and normal, V as given; 0 where N·L ≤ 0.
double distance_to_phong(const Triple& normal, const Triple& to_light, const Triple& to_viewer, double exponent,
                         double candidate);

/// |candidate − max(0, N·L)| of the vectors as given.
double distance_to_lambert(const Triple& normal, const Triple& to_light, double candidate);

}  // namespace etendue::oracle
