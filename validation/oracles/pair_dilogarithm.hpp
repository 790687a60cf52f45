// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "oracles/pair_contour.hpp"

namespace etendue::oracle {

/// Form factor between two planar regions in closed form, in balls of 448 bits: no quadrature, no bound of a rule.
/// What Schröder and Hanrahan (SIGGRAPH 1993) showed to exist; derived anew in pair_dilogarithm.cpp, in the coordinates of the
/// lines' common perpendicular, where two dilogarithms a corner are left. However near to parallel two edges are, at whatever hair's
/// distance. What lies behind the plane through the other's first vertex, across its area vector, is cut off, to every sign.
FactorBall pair_dilogarithm(const Loops& from, const Loops& to);

}  // namespace etendue::oracle
