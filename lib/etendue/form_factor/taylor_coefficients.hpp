// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/floating_point.hpp"

namespace etendue {

/// Bounds on |C_k(cos θ)|, Gegenbauer's polynomials for λ = 2, with which the Taylor coefficients of r^(−4) along a line are
/// (e/r)^k C_k/r⁴ (NOTES.md §8): the greatest, at θ = 0, and the factor of 1/sin³θ.
constexpr double steep_coefficient(int k) {
  return (k + 1.0) * (k + 2.0) * (k + 3.0) / 6;
}
constexpr double flat_coefficient(int k) {
  return (k + 2.0) / 2;
}

}  // namespace etendue
