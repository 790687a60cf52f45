// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/bounded.hpp"
#include "etendue/geometry/disc.hpp"
#include "etendue/geometry/sphere.hpp"

namespace etendue {

/// Factor from a differential element to a disc in any position: the fraction of the element's power that arrives at its
/// front. What lies below the element's horizon is cut off along a chord.
///
///     F = (1/2π) (γ + ∫ n · (p' × p)/|p|² dt)   over the arc above the horizon                    @eq IU.6-2, IU.6-10
///
/// Symbols   n the element's normal, p the rim as seen from the element [length]; γ the angle that the chord spans [rad]
/// Domain    point finite; both normals of length one within 2^-49, divided by their lengths. One-sided: an element behind
///           the disc's plane, or in it, receives 0; where rounding leaves that open, 0 with a bound that says so
/// Returns   value in [0, 1] and a bound on its absolute error; the same bits for lengths times powers of two
/// Accuracy  |value − F| ≤ bound: every step is counted in twice the digits (catalogue/counted.hpp), proved up to the
///           form of the antiderivative, which the tests hold. Bound below 1e-15 unless the element is in the plane
///           but for rounding; most are below 1e-15 of the value: measured
/// Errors    ContractViolation where the domain is left
/// Source    Lambert 1760; the antiderivative: NOTES.md §13
[[nodiscard]] Bounded point_to_disc(const Vec3& point, const Vec3& normal, const Disc& disc);

/// An element this share of the radius inside a sphere counts as on it: rounding of its coordinates.
inline constexpr double kOnSphere = 0x1p-48;

/// Factor from a differential element to a sphere in any position, cut by the element's horizon.     @eq IU.6-2
///
/// Domain    the point outside the sphere or on it, to kOnSphere; there the bound grows by the root of how far inside
/// Returns   value in [0, 1] and a bound on its absolute error; the same bits for lengths times powers of two
/// Accuracy  |value − F| ≤ bound, counted as above
/// Errors    ContractViolation for a point inside the sphere, and where the domain is left
/// Source    the catalogue's entry element-sphere-cut
[[nodiscard]] Bounded point_to_sphere(const Vec3& point, const Vec3& normal, const Sphere& sphere);

}  // namespace etendue
