// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/bounded.hpp"

namespace etendue {

/// Lengths in any unit that the rectangles take: wide enough for every one, and quotients stay normal numbers.
inline constexpr double kShortestLength = 1e-100;
inline constexpr double kLongestLength = 1e100;

/// Ratios that the rectangles take: what the integral of C-11 is proved for (NOTES.md §6), and tested to both ends.
inline constexpr double kLeastRatio = 1e-6;
inline constexpr double kGreatestRatio = 1e6;

/// Relative error of the rectangles' factors in that domain.
inline constexpr double kRectangleError = 0x1p-44;

/// Form factor between two equal, parallel, directly opposed rectangles (Howell's C-11), with X = width/distance,
/// Y = height/distance.
///
///     F = (2/πXY) { ln √[(1+X²)(1+Y²)/(1+X²+Y²)] + X√(1+Y²) atan(X/√(1+Y²)) + Y√(1+X²) atan(Y/√(1+X²))
///         − X atan X − Y atan Y }                                                            @eq IU.6-3
///
/// The sum is of order X²Y² with terms of order one: in double it is empty of digits at X = Y = 1e-4. Where the smaller
/// ratio is at most one, the positive single integral that the formula is the value of is taken instead (NOTES.md §6).
///
/// Domain    lengths within [kShortestLength, kLongestLength], width/distance and height/distance within
///           [kLeastRatio, kGreatestRatio]
/// Returns   value in (0, 1) and a bound on its absolute error
/// Accuracy  |value − F| ≤ bound ≤ kRectangleError · value; counted
/// Errors    ContractViolation outside the domain
/// Source    Howell, catalogue of configuration factors, C-11
[[nodiscard]] Bounded parallel_rectangles(double width, double height, double distance);

/// Form factor from a rectangle (common × width) to one (common × height) at a right angle, sharing the edge `common`
/// (Howell's C-14), with W = width/common, H = height/common.
///
///     2π W F = J(W) + J(H) − J(√(W²+H²)),
///     J(a) = ½ ln(1+a²) + 2a atan(1/a) − ½ a² ln(1+1/a²)                                     @eq IU.6-3
///
/// which is C-14 gathered by its three lengths; the difference of the two larger ones is formed without cancellation.
///
/// Domain    lengths within [kShortestLength, kLongestLength], width/common and height/common within
///           [kLeastRatio, kGreatestRatio]
/// Returns   value in (0, 1) and a bound on its absolute error
/// Accuracy  |value − F| ≤ bound ≤ kRectangleError · value; counted
/// Errors    ContractViolation outside the domain
/// Source    Howell, catalogue of configuration factors, C-14
[[nodiscard]] Bounded perpendicular_rectangles(double width, double height, double common);

}  // namespace etendue
