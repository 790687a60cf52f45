// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace etendue::oracle {

using Point = std::array<double, 3>;
using Corners = std::vector<Point>;

/// Two convex polygons, each wholly in front of the other or touching its plane, and convex two-sided plates anywhere.
struct ObstructedPair {
  Corners from, to;  ///< counter-clockwise as seen from their fronts
  std::vector<Corners> plates;
};

/// A value and what its own adaptive integration says of its error.
struct Estimate {
  double value = 0;
  double error = 0;
  long evaluations = 0;
};

/// A_1 F_12 with H_12 of IU.6-4, by slices: along each slice of `from` the integrand is split at the crossings with all
/// planes through a corner and an edge (linear equations) and with all lines of sight over three edges (quadratics), the
/// pieces are integrated by adaptive Gauss-Kronrod rules, and so is their sum over the slices. From a point the visible
/// part is found by inclusion and exclusion over the plates' shadows: no part is ever cut into pieces.
///
/// Symbols   angle between the slices and from's first edge [rad]; goal absolute error asked [length²]
[[nodiscard]] Estimate obstructed_exchange(const ObstructedPair& pair, double angle, double goal);

/// The same pair with the two polygons exchanged.
[[nodiscard]] ObstructedPair reversed(const ObstructedPair& pair);

/// The mean of the plain estimator over stratified pairs of points, and its standard error (not lowered by the
/// stratification): A_1 F_12.
[[nodiscard]] Estimate obstructed_exchange_by_points(const ObstructedPair& pair, int side, std::uint64_t seed);

}  // namespace etendue::oracle
