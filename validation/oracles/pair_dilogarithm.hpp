// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "oracles/pair_contour.hpp"

namespace etendue::oracle {

/// Form factor between two planar regions in closed form, in balls of 448 bits: no quadrature, no bound of a rule.
/// What Schröder and Hanrahan (SIGGRAPH 1993) showed to exist; derived anew in pair_dilogarithm.cpp, in the coordinates of the
/// lines' common perpendicular, where two dilogarithms a corner are left. Nothing where a vertex of one lies behind the other's plane:
/// this oracle does not cut.
std::optional<FactorBall> pair_dilogarithm(const Loops& from, const Loops& to);

}  // namespace etendue::oracle
