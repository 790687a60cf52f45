// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/certified_parts.hpp"

#include <algorithm>
#include <cstddef>

namespace etendue {

namespace {

EnclosedOutline reversed(EnclosedOutline outline) {
  std::reverse(outline.begin(), outline.end());
  return outline;
}

}  // namespace

Interval3 doubled_area_of(const EnclosedOutline& v) {
  Interval3 sum;
  for (std::size_t i = 1; i + 1 < v.size(); ++i) sum = sum + cross(v[i] - v[0], v[i + 1] - v[0]);
  return sum;
}

std::vector<SignedPart> signed_triangles(const EnclosedOutline& outline) {
  const Interval3 normal = doubled_area_of(outline);
  std::vector<SignedPart> parts;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
    EnclosedOutline triangle{outline[0], outline[i], outline[i + 1]};
    const Interval turn = dot(normal, doubled_area_of(triangle));
    const bool positive = turn.middle() >= 0;
    parts.push_back({positive ? triangle : reversed(triangle), positive ? 1.0 : -1.0});
    if (turn.contains(0.0)) parts.back().uncertain = norm(doubled_area_of(triangle)).upper;
  }
  return parts;
}

std::vector<SignedPart> signed_parts(const EnclosedOutline& outline) {
  const Interval3 normal = doubled_area_of(outline);
  const std::size_t n = outline.size();
  bool convex = true;
  for (std::size_t i = 0; i < n && convex; ++i) {
    const Interval3 edge = outline[(i + 1) % n] - outline[i];
    for (std::size_t k = 2; k < n; ++k) {
      // Straight corners are convex but for rounding; what that could do is far below what a fan would cost.
      convex = convex && dot(normal, cross(edge, outline[(i + k) % n] - outline[i])).lower > 0;
    }
  }
  if (convex || n == 3) return {{outline, 1}};
  return signed_triangles(outline);
}

}  // namespace etendue
