// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <variant>

#include "etendue/geometry/vector.hpp"

namespace etendue {

/// Squares in two colours on a plane, and all along its normal.                                          @eq IU.4-1
///
///     s = ⌊u·(p − o)/a⌋ + ⌊v·(p − o)/a⌋;   the first colour where s is even, the second where it is odd
///
/// Symbols   p the point, o a corner of a square of the first colour, u, v unit vectors along the edges, a an edge's length
struct Checkerboard {
  Vec3 origin = Vec3::Zero();
  Vec3 u = Vec3::UnitX(), v = Vec3::UnitY();
  double size = 1;
};

/// Rings of a trunk around an axis, cut by whatever surface: light early wood that darkens slowly to late wood.   @eq IU.4-1
///
///     r = distance of p from the axis + a/4 · (sin(7 h/(16 a)) + sin(3 φ));   share of the second colour = (r/a − ⌊r/a⌋)²
///
/// Symbols   a the width of a ring; h along, φ around the axis: the trunk grew a little crooked
struct Wood {
  Vec3 origin = Vec3::Zero();
  Vec3 axis = Vec3::UnitZ();  ///< a unit vector
  double ring = 1;
};

/// Clouds: share of the second colour = ½ + fractal_noise((p − o)/a), cut to [0, 1].                            @eq IU.4-1
///
/// Symbols   a the size of the largest clouds, half of it that of the next octave's
struct Noise {
  Vec3 origin = Vec3::Zero();
  double size = 1;
  int octaves = 4;
  std::uint64_t seed = 0;
};

/// Layers of stone, crumpled, with thin veins of the second colour.                                          @eq IU.4-1
///
///     x = A·(p − o)/a + s fractal_noise((p − o)/a);   share of the second colour = (½ + ½ cos 2πx)⁴
///
/// Symbols   A unit vector across the layers, a the distance of their veins; s how far the stone is crumpled, in veins
struct Marble {
  Vec3 origin = Vec3::Zero();
  Vec3 axis = Vec3::UnitZ();
  double size = 1;
  double turbulence = 1;
  int octaves = 4;
  std::uint64_t seed = 0;
};

using Pattern = std::variant<Checkerboard, Wood, Noise, Marble>;

/// How much of the second of two colours a pattern shows at a point: 0 to 1.
///
/// Domain    u, v and the axes unit vectors, lengths positive, octaves in [1, kMostOctaves]
/// Accuracy  a point within rounding of the line between two squares, or of the end of a ring, may count to either
[[nodiscard]] double second_share(const Pattern& pattern, const Vec3& point);

}  // namespace etendue
