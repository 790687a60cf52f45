// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/visible_part.hpp"

#include <cstddef>
#include <utility>

#include "etendue/form_factor/loop.hpp"

namespace etendue {

namespace {

using Part = std::vector<Vec3>;

/// Splits `part` by the plane normal · x = level: what lies outside is appended to `outside`, what lies inside is kept.
void cut_off(Part& part, const Vec3& normal, double level, std::vector<Part>& outside) {
  std::vector<double> heights;
  heights.reserve(part.size());
  bool any_inside = false, any_outside = false;
  for (const Vec3& v : part) {
    heights.push_back(normal.dot(v) - level);
    any_inside = any_inside || heights.back() > 0;
    any_outside = any_outside || heights.back() < 0;
  }
  if (!any_outside) return;
  if (!any_inside) {
    outside.push_back(std::move(part));
    part.clear();
    return;
  }
  Part inner = clip(part, heights);
  for (double& h : heights) h = -h;
  Part outer = clip(part, heights);
  if (!outer.empty()) outside.push_back(std::move(outer));
  part = std::move(inner);
}

/// Newell's sum, twice the area times the normal.
Vec3 area_vector(const Part& loop) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) sum += (loop[i] - loop[0]).cross(loop[i + 1] - loop[0]);
  return sum;
}

/// True where some half-space of the shadow holds nothing of the part: it is then visible past this blocker.
bool misses(const Part& part, const Part& blocker, double side, const Vec3& normal, double level) {
  const auto all_below = [&](const Vec3& n, double l) {
    for (const Vec3& v : part) {
      if (n.dot(v) - l > 0) return false;
    }
    return true;
  };
  if (all_below(side * normal, side * level)) return true;
  for (std::size_t i = 0; i < blocker.size(); ++i) {
    if (all_below(side * blocker[i].cross(blocker[(i + 1) % blocker.size()]), 0)) return true;
  }
  return false;
}

}  // namespace

std::vector<Part> visible_part(Part receiver, std::span<const Part> blockers) {
  std::vector<Part> parts;
  parts.push_back(std::move(receiver));
  for (const Part& blocker : blockers) {
    const Vec3 normal = area_vector(blocker);
    const double level = normal.dot(blocker[0]);
    if (level == 0) continue;
    // With the blocker counter-clockwise around the direction away from the origin, a × b points into the cone.
    const double side = level > 0 ? 1 : -1;
    std::vector<Part> remaining;
    for (Part& part : parts) {
      if (misses(part, blocker, side, normal, level)) {
        remaining.push_back(std::move(part));
        continue;
      }
      cut_off(part, side * normal, side * level, remaining);
      for (std::size_t i = 0; i < blocker.size() && !part.empty(); ++i) {
        cut_off(part, side * blocker[i].cross(blocker[(i + 1) % blocker.size()]), 0, remaining);
      }
    }
    parts = std::move(remaining);
    if (parts.empty()) break;
  }
  return parts;
}

}  // namespace etendue
