// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "etendue/geometry/box.hpp"
#include "etendue/geometry/cylinder.hpp"
#include "etendue/geometry/disc.hpp"
#include "etendue/geometry/plane.hpp"
#include "etendue/geometry/polygon.hpp"
#include "etendue/geometry/ray.hpp"
#include "etendue/geometry/sphere.hpp"

namespace etendue {

/// What plain double arithmetic knows for certain of intersect(ray, shape), for a small part of its work.
///
/// Domain    of the shape's intersect(), with lengths between 2^-120 and 2^120
/// Returns   miss: intersect() finds nothing; hit: it finds a hit, with first ≤ t ≤ last; unsure: one of both, and if it is
///           a hit then first ≤ t. Never wrong: proved, NOTES.md §13. Of rays without aim one in 1000 at most is unsure (polygons
///           seen from 1000 times their size: one in 20); of those that leave the surface one in 8: validation/geometry/sight_test.cpp
/// Errors    none: what is not a number, or not in intersect()'s domain, is unsure
struct Sight {
  enum class Kind { miss, hit, unsure };
  Kind kind = Kind::unsure;
  double first = 0, last = std::numeric_limits<double>::infinity();

  static Sight missed() { return {Kind::miss, 0, 0}; }
};

[[nodiscard]] Sight sight(const Ray& ray, const Sphere& sphere);
[[nodiscard]] Sight sight(const Ray& ray, const Cylinder& cylinder);
[[nodiscard]] Sight sight(const Ray& ray, const Plane& plane);
[[nodiscard]] Sight sight(const Ray& ray, const Disc& disc);
[[nodiscard]] Sight sight(const Ray& ray, const Polygon& polygon);
[[nodiscard]] Sight sight(const Ray& ray, const Box& box);

/// Of a box, besides, where it is a hit: which face, if that is certain, too.
struct BoxSight {
  Sight sight;
  int axis = -1;          ///< of the face met; −1: not known
  bool entering = false;  ///< else the ray leaves there
};
[[nodiscard]] BoxSight box_sight(const Ray& ray, const Box& box);

/// Of every other shape: intersect() has to be asked.
template <class Shape>
[[nodiscard]] Sight sight(const Ray&, const Shape&) {
  return {};
}

}  // namespace etendue
