// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/geometry/vector.hpp"
#include "etendue/reflectance/relief.hpp"

namespace etendue {

/// How a height over a surface grows from place to place, as a vector in its tangent plane: ∇f.           @eq IU.4.2.1
///
///     ∇f = (∂f/∂u (Q_v × m) + ∂f/∂v (m × Q_u)) / |m|²,   m = Q_u × Q_v
///
/// Symbols   Q_u, Q_v tangents ∂Q/∂u, ∂Q/∂v [length]
/// Returns   the vector whose scalar products with Q_u and Q_v are ∂f/∂u and ∂f/∂v; zero where the tangents span no plane, as at
///           a pole: there the coordinates do not say which way the height grows
/// Accuracy  a few u, over the sine of the angle between the tangents; tested
[[nodiscard]] Vec3 height_gradient(const Vec3& along_u, const Vec3& along_v, const Relief& relief);

/// Unit normal of a surface that stands f above a smooth one, at a point that is left where it was.        @eq IU.4.2.1
///
///     q' = q + f(q) n_q;   N' = (n − s) / |n − s|,   s = ∇f − (n·∇f) n
///
/// Which is Blinn's n + (∂f/∂u (n × Q_v) − ∂f/∂v (n × Q_u))/|Q_u × Q_v|, whatever the coordinates; of the exact
/// Q'_u × Q'_v it leaves out what is of the second order in f and its slopes.
/// Symbols   n unit normal on the side to which f counts as positive; ∇f any vector whose tangential part is the growth of f
/// Domain    n a unit vector (kUnitTolerance), ∇f finite
/// Returns   a unit vector, less than 90° from n
/// Accuracy  against the surface that is really displaced: O(f²) as f and its slopes are scaled down together, NOTES.md §6; of
///           the formula itself: 12 u, measured
/// Errors    ContractViolation outside the domain
/// Source    Blinn 1978, Simulation of Wrinkled Surfaces, doi:10.1145/965139.507101
[[nodiscard]] Vec3 bumped_normal(const Vec3& normal, const Vec3& gradient);

/// The sides of a surface whose shading normal is not its own.
///
/// Returns   `direction` if it leads away from the smooth surface on the side of `normal`; else its mirror image there, as if the
///           bump next to it sent it on: nothing that was mirrored passes through a surface, and nothing jumps where it just would
/// Domain    unit vectors
[[nodiscard]] Vec3 kept_outside(const Vec3& direction, const Vec3& normal);

}  // namespace etendue
