// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "etendue/geometry/polygon.hpp"

namespace etendue {

/// A parallelogram around its centre: centre ± half[0] ± half[1] are its corners.
struct Parallelogram {
  Vec3 corner, centre;  ///< the first vertex; the centre as seen from it
  Vec3 half[2];
  Vec3 direction[2];  ///< of the half edges, of length one
  Vec3 normal;
  double length[2];  ///< of the half edges
  double radius, area;
  double shape;         ///< share of the factor that the rounding of corners and normal may cost
  double flatness;      ///< bounds the distance of a corner from the plane
  double skew;          ///< the largest cosine between the two directions and the normal: rounding, for a rectangle
  std::uint32_t plane;  ///< the same number for all that lie exactly in one plane and turn the same way
  bool valid;           ///< false: the polygon is none
};

[[nodiscard]] Parallelogram parallelogram(const Polygon& polygon, std::uint32_t plane);

/// Numbers of planes: the same for all that lie exactly in one and turn the same way.
[[nodiscard]] std::vector<std::uint32_t> planes_of(const std::vector<Polygon>& polygons);

}  // namespace etendue
