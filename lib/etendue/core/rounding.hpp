// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/floating_point.hpp"

namespace etendue {

/// Unit roundoff u of double: a correctly rounded operation errs by at most u, relatively.
inline constexpr double kUnitRoundoff = 0x1p-53;

/// γ_n = n u / (1 − n u): bounds the relative error that n roundings accumulate (Higham 2002, lemma 3.1).
constexpr double gamma_bound(int n) {
  return n * kUnitRoundoff / (1 - n * kUnitRoundoff);
}

}  // namespace etendue
