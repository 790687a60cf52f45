// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

namespace etendue::oracle {

/// A planar region as its loops: the outline counter-clockwise as seen from the front, holes clockwise.
using Loops = std::vector<std::vector<std::array<double, 3>>>;

/// A form factor as a ball around the sum of two doubles.
struct FactorBall {
  double high = 0;
  double low = 0;
  double radius = 0;  ///< proved: |high + low − F_12| ≤ radius
  double margin = 1;  ///< least |height| / size of a vertex that was decided to be off the other's plane
};

/// Form factor from one planar region to another, in balls of 224 bits: the double contour integral with the inner edge
/// in closed form, the outer one in closed form where the two lie in one plane, else by Gauss rules with Bernstein's
/// bound, halved towards near singularities. Vertices within `planarity` · size of the other's plane count as on it;
/// what lies behind is cut off.
FactorBall pair_contour(const Loops& from, const Loops& to, double planarity);

}  // namespace etendue::oracle
