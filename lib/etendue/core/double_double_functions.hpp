// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/double_double.hpp"

namespace etendue {

/// Bound on the relative error of log() and the absolute one of angle_of(), whose results are at most π: a table value,
/// the rest of a series at most 2^-106 of it, and about twenty operations of 2^-102 on what is at most 2^-5 of it;
/// the largest of the terms that are added is at most four times the result.
inline constexpr double kDoubleDoubleFunctionError = 0x1p-97;

/// Natural logarithm of x > 0, in twice the digits of double.
///
/// Domain    2^-960 < x < 2^960
/// Accuracy  relative error at most kDoubleDoubleFunctionError; counted above, measured against 600-bit balls
/// Errors    ContractViolation where x is not positive
[[nodiscard]] DoubleDouble log(const DoubleDouble& x);

/// The angle between the positive x-axis and the point (x, y) of the upper half-plane, in [0, π]; 0 for the origin.
///
/// Domain    y ≥ 0; magnitudes between 2^-450 and 2^450, or zero
/// Accuracy  absolute error at most kDoubleDoubleFunctionError, for x > 0 also relative
/// Errors    ContractViolation where y is negative
[[nodiscard]] DoubleDouble angle_of(const DoubleDouble& y, const DoubleDouble& x);

}  // namespace etendue
