// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "oracles/obstructed_factor.hpp"

namespace etendue::oracle {

/// A convex body. As a patch a polygon or a disc radiates from its front, a sphere from outside, a cylinder from the
/// outside of its wall; as a blocker each stops light from any side, the cylinder with its ends.
struct RoundBody {
  enum class Kind { polygon, sphere, disc, cylinder, box };
  Kind kind = Kind::sphere;
  Point centre{};                ///< of a sphere or disc; of a cylinder's base; corner of a box
  Point axis{};                  ///< a disc's unit normal; a cylinder's way from base to top
  double radius = 0;             ///< of what is round
  Corners corners;               ///< of a polygon: convex, counter-clockwise as seen from the front
  std::array<Point, 3> edges{};  ///< of a box: three at right angles, right-handed
};

/// None of the bodies may meet another but by touching it, nor share an edge with it.
struct RoundPair {
  RoundBody from, to;
  std::vector<RoundBody> blockers;
};

/// A_1 F_12 with H_12 of IU.6-4, as a measure of lines: over all directions the area, across the direction, of the lines
/// that leave the one, arrive at the other, and meet nothing in between.
///
///     A_1 F_12 = (1/π) ∫ A(ω) dω
///
/// A(ω) is exact: every outline is drawn, a piece of which between two crossings bounds the area, or not, as a whole; lines
/// beside its middle tell. No cosine, no distance and no horizon occurs, and touching bodies are nothing special.
/// The integral over directions is adaptive, in an equal-area chart.
///
/// Symbols   turn the angle of the chart about its middle, and how far that is off [rad]; goal absolute error asked
/// Returns   the value, and the sum of what cells and their quarters differ by
[[nodiscard]] Estimate round_exchange(const RoundPair& pair, double turn, double goal, long most_directions);

/// A_1 F_12 from lines at random, stratified over the chart, and its standard error (not lowered by stratification).
[[nodiscard]] Estimate round_exchange_by_lines(const RoundPair& pair, int side, std::uint64_t seed);

/// Middle and radius of a ball around a body.
struct BodyBall {
  Point middle;
  double size;
};
[[nodiscard]] BodyBall ball_of(const RoundBody& body);

/// Area of the side that radiates.
[[nodiscard]] double area_of(const RoundBody& body);

}  // namespace etendue::oracle
