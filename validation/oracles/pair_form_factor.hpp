// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

namespace etendue::oracle {

using Point = std::array<double, 3>;

struct PairFormFactor {
  double factor = 0;    ///< F_12, rounded to nearest
  double estimate = 0;  ///< relative difference between the last two levels of the quadrature
  double margin = 0;    ///< least |height| / size of a vertex that was decided to be off the other's plane
};

/// Form factor from one planar polygon to another, at 600 bits: the double contour integral, the inner edge in closed
/// form, the outer one by the tanh-sinh rule between the feet of the other edge's ends and the lines' nearest points.
/// Vertices within `planarity` · size of the other's plane count as on it; what lies behind is cut off.
PairFormFactor pair_form_factor(const std::vector<Point>& from, const std::vector<Point>& to, double planarity);

}  // namespace etendue::oracle
