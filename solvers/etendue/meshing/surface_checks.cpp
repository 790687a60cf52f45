// SPDX-License-Identifier: Apache-2.0
#include "etendue/meshing/surface_checks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

using Points = std::vector<Vec3>;

double signed_area(const Points& points, const Vec3& normal) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    sum += 0.5 * (points[i] - points[0]).cross(points[i + 1] - points[0]).dot(normal);
  }
  return sum;
}

/// What of `points` lies to the left of the edge from a to b, seen against `normal`.
Points left_of(const Points& points, const Vec3& a, const Vec3& b, const Vec3& normal) {
  const Vec3 inward = normal.cross(b - a);
  Points kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& p = points[i];
    const Vec3& q = points[(i + 1) % points.size()];
    const double hp = inward.dot(p - a), hq = inward.dot(q - a);
    if (hp >= 0) kept.push_back(p);
    if ((hp > 0 && hq < 0) || (hp < 0 && hq > 0)) kept.push_back(p + hp / (hp - hq) * (q - p));
  }
  return kept;
}

double common_area(const Polygon& first, const Polygon& second) {
  Points common = second.vertices();
  const auto& v = first.vertices();
  for (std::size_t i = 0; i < v.size() && common.size() >= 3; ++i) {
    common = left_of(common, v[i], v[(i + 1) % v.size()], first.normal());
  }
  return common.size() < 3 ? 0 : signed_area(common, first.normal());
}

bool in_plane(const Polygon& plane, const Polygon& polygon, double slack) {
  return std::all_of(polygon.vertices().begin(), polygon.vertices().end(),
                     [&](const Vec3& v) { return std::abs(plane.normal().dot(v - plane.centroid())) <= slack; });
}

struct Box3 {
  Vec3 low, high;
};

Box3 box_of(const Polygon& polygon) {
  Box3 box{polygon.vertices().front(), polygon.vertices().front()};
  for (const Vec3& v : polygon.vertices()) {
    box.low = box.low.cwiseMin(v);
    box.high = box.high.cwiseMax(v);
  }
  return box;
}

bool inside(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
  return normal.cross(b - a).dot(p - a) >= 0 && normal.cross(c - b).dot(p - b) >= 0 &&
         normal.cross(a - c).dot(p - c) >= 0;
}

}  // namespace

Overlap overlap(const Polygon& first, const Polygon& second, double slack) {
  if (first.normal().dot(second.normal()) <= 0) return Overlap::none;
  if (!in_plane(first, second, slack) || !in_plane(second, first, slack)) return Overlap::none;
  const double common = common_area(first, second);
  const double least = std::min(first.area(), second.area());
  if (!(common > kLeastOverlap * least)) return Overlap::none;
  const bool covers_first = common >= (1 - kLeastOverlap) * first.area();
  const bool covers_second = common >= (1 - kLeastOverlap) * second.area();
  if (covers_first && covers_second) return Overlap::same;
  if (covers_first) return Overlap::first_inside;
  return covers_second ? Overlap::second_inside : Overlap::partial;
}

std::vector<Overlapping> overlapping(std::span<const Polygon> polygons, double slack) {
  std::vector<Box3> boxes;
  for (const Polygon& polygon : polygons) boxes.push_back(box_of(polygon));
  std::vector<std::size_t> order(polygons.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(boxes[a].low.x(), a) < std::pair(boxes[b].low.x(), b);
  });
  std::vector<Overlapping> found;
  for (std::size_t k = 0; k < order.size(); ++k) {
    for (std::size_t m = k + 1; m < order.size(); ++m) {
      const std::size_t a = std::min(order[k], order[m]), b = std::max(order[k], order[m]);
      if (boxes[order[m]].low.x() > boxes[order[k]].high.x() + slack) break;
      if (((boxes[a].low.array() > boxes[b].high.array() + slack).any()) ||
          ((boxes[b].low.array() > boxes[a].high.array() + slack).any())) {
        continue;
      }
      const Overlap how = overlap(polygons[a], polygons[b], slack);
      if (how != Overlap::none) found.push_back({a, b, how});
    }
  }
  std::sort(found.begin(), found.end(), [](const Overlapping& x, const Overlapping& y) {
    return std::pair(x.second, x.first) < std::pair(y.second, y.first);
  });
  return found;
}

Result<Done> check_overlaps(const Scene& scene, const ElementMesh& mesh) {
  if (mesh.faces.empty()) return Done{};
  std::vector<Polygon> polygons;
  for (const Face& face : mesh.faces) polygons.push_back(face.polygon);
  constexpr std::size_t kMostNamed = 3;  // of all that one object overlaps: a pile of n has n² / 2 pairs
  std::string lines;
  std::set<std::pair<std::size_t, std::size_t>> reported;  // pairs of objects, not of their faces
  std::map<std::size_t, std::size_t> partners;
  for (const Overlapping& pair : overlapping(polygons, kTouching * diagonal(mesh))) {
    const std::size_t first = mesh.faces[pair.first].object, second = mesh.faces[pair.second].object;
    if (!reported.emplace(first, second).second) continue;
    if (++partners[second] > kMostNamed) continue;
    const Object& object = scene.objects[second];
    lines += (object.place.empty() ? "" : object.place + ": ") + "object '" + printable(object.name) + "' " +
             described(pair.how) + " object '" + printable(scene.objects[first].name) + "'\n";
  }
  if (reported.empty()) return Done{};
  for (const auto& [second, count] : partners) {
    if (count <= kMostNamed) continue;
    const Object& object = scene.objects[second];
    lines += (object.place.empty() ? "" : object.place + ": ") + "object '" + printable(object.name) + "' overlaps " +
             counted(count - kMostNamed, "object") + " more\n";
  }
  return Error{ErrorCode::invalid_input, lines + counted_errors(reported.size())};
}

std::string described(Overlap how) {
  switch (how) {
    case Overlap::same:
      return "is there twice: it covers the same area as";
    case Overlap::first_inside:
      return "lies over all of";
    case Overlap::second_inside:
      return "lies inside";
    case Overlap::partial:
      return "overlaps";
    case Overlap::none:
      break;
  }
  return "is apart from";
}

Result<FlatPolygon> flattened(std::vector<Vec3> vertices) {
  auto made = Polygon::make(vertices);
  if (made) return FlatPolygon{std::move(made).value(), 0};
  const bool finite = std::all_of(vertices.begin(), vertices.end(), [](const Vec3& v) { return v.allFinite(); });
  if (vertices.size() < 4 || !finite) return made.error();
  Vec3 normal = Vec3::Zero(), middle = Vec3::Zero();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    normal += (vertices[i] - vertices[0]).cross(vertices[(i + 1) % vertices.size()] - vertices[0]);
    middle += (vertices[i] - vertices[0]) / static_cast<double>(vertices.size());
  }
  if (!(normal.norm() > 0)) return made.error();
  normal.normalize();
  double moved = 0, extent = 0;
  const Vec3 origin = vertices[0];
  for (Vec3& v : vertices) {
    const double height = normal.dot((v - origin) - middle);
    extent = std::max(extent, (v - origin).norm());
    moved = std::max(moved, std::abs(height));
    v -= height * normal;
  }
  if (moved > kFlatEnough * extent) {
    return Error{ErrorCode::invalid_input, "is not flat: a vertex is " + rounded(moved, 3) +
                                               " off its plane, expected at most " + rounded(kFlatEnough * extent, 3) +
                                               " (3e-5 of its extent)"};
  }
  made = Polygon::make(std::move(vertices));
  if (!made) return made.error();
  return FlatPolygon{std::move(made).value(), moved};
}

std::vector<Polygon> convex_parts(const Polygon& polygon) {
  if (is_convex(polygon)) return {polygon};
  Points left = polygon.vertices();
  const Vec3& normal = polygon.normal();
  std::vector<Polygon> parts;
  while (left.size() > 3) {
    const std::size_t n = left.size();
    std::size_t ear = n;
    for (std::size_t i = 0; i < n && ear == n; ++i) {
      const Vec3 &a = left[(i + n - 1) % n], &b = left[i], &c = left[(i + 1) % n];
      if (!((b - a).cross(c - b).dot(normal) > 0)) continue;
      bool empty = true;
      for (std::size_t k = 0; k < n && empty; ++k) {
        if (k != i && k != (i + 1) % n && k != (i + n - 1) % n) empty = !inside(left[k], a, b, c, normal);
      }
      if (empty) ear = i;
    }
    if (ear == n) return {};  // only where rounding has made the outline cross itself
    auto triangle = Polygon::make({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
    if (triangle) parts.push_back(std::move(triangle).value());
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  auto last = Polygon::make(left);
  if (last) parts.push_back(std::move(last).value());
  return parts;
}

}  // namespace etendue
