// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/jordan.hpp"

#include "etendue/geometry/newell.hpp"
#include "etendue/geometry/predicates.hpp"

namespace etendue {

bool encloses(const std::vector<Vec3>& vertices, const Vec3& point, int axis) {
  const Vec2 p = projected(point, axis);
  bool inside = false;
  Vec2 previous = projected(vertices.back(), axis);
  for (const Vec3& vertex : vertices) {
    const Vec2 current = projected(vertex, axis);
    const bool previous_above = previous.y() >= p.y(), current_above = current.y() >= p.y();
    if (previous_above != current_above) {
      // An upward edge crosses the half-line iff the point lies strictly to its left.
      const int turn = orientation(previous, current, p);
      if (current_above ? turn > 0 : turn < 0) inside = !inside;
    }
    previous = current;
  }
  return inside;
}

}  // namespace etendue
