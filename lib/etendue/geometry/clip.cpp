// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/clip.hpp"

#include "etendue/geometry/double_double3.hpp"
#include "etendue/geometry/predicates.hpp"
#include "etendue/geometry/resolved.hpp"

namespace etendue {

namespace {

// N·(p − P), resolved: the sign is exact, the relative error at most 2^-57.
DoubleDouble height(const Vec3& point, const Plane& plane) {
  const DoubleDouble3 d = exact_difference(point, plane.point);
  return resolved(dot(d, plane.normal), plane.normal.cwiseProduct(point - plane.point).lpNorm<1>(), [&] {
    return Expansion(d.x) * plane.normal.x() + Expansion(d.y) * plane.normal.y() + Expansion(d.z) * plane.normal.z();
  });
}

// Where the edge between a point in front and one behind passes the plane. Always called with the front one first, so
// that an edge is cut at the same point whichever way it runs.
Vec3 cut(const Vec3& front, const Vec3& behind, const Plane& plane) {
  const DoubleDouble above = height(front, plane), below = height(behind, plane);
  const DoubleDouble share = above / (above - below);
  const DoubleDouble3 edge = exact_difference(behind, front);
  return {rounded(edge.x * share + front.x()), rounded(edge.y * share + front.y()),
          rounded(edge.z * share + front.z())};
}

}  // namespace

std::vector<Vec3> clip(const std::vector<Vec3>& vertices, const Plane& plane) {
  std::vector<Vec3> part;
  if (vertices.empty()) return part;
  part.reserve(vertices.size() + 1);
  const Vec3* previous = &vertices.back();
  int previous_side = side(*previous, plane);
  for (const Vec3& vertex : vertices) {
    const int vertex_side = side(vertex, plane);
    if (previous_side > 0 && vertex_side < 0) part.push_back(cut(*previous, vertex, plane));
    if (previous_side < 0 && vertex_side > 0) part.push_back(cut(vertex, *previous, plane));
    if (vertex_side >= 0) part.push_back(vertex);
    previous = &vertex;
    previous_side = vertex_side;
  }
  if (part.size() < 3) part.clear();
  return part;
}

}  // namespace etendue
