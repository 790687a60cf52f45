// SPDX-License-Identifier: Apache-2.0
#include "etendue/meshing/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

namespace etendue {

namespace {

struct Bounds {
  Vec3 low, high;
};

Bounds bounds_of(const Polygon& polygon) {
  Bounds box{polygon.vertices().front(), polygon.vertices().front()};
  for (const Vec3& v : polygon.vertices()) {
    box.low = box.low.cwiseMin(v);
    box.high = box.high.cwiseMax(v);
  }
  return box;
}

/// What a polygon has in common with a plane that it touches or pierces from the front.
std::optional<Segment> common_with_plane(const Polygon& polygon, const Polygon& plane, double touching) {
  const auto& v = polygon.vertices();
  std::vector<double> heights;
  for (const Vec3& point : v) {
    const double height = plane.normal().dot(point - plane.centroid());
    heights.push_back(std::abs(height) <= touching ? 0 : height);
  }
  if (!(*std::max_element(heights.begin(), heights.end()) > 0)) return std::nullopt;
  std::vector<Vec3> common;
  for (std::size_t k = 0; k < v.size(); ++k) {
    const std::size_t next = (k + 1) % v.size();
    if (heights[k] == 0) common.push_back(v[k]);
    if ((heights[k] > 0 && heights[next] < 0) || (heights[k] < 0 && heights[next] > 0)) {
      common.push_back(v[k] + heights[k] / (heights[k] - heights[next]) * (v[next] - v[k]));
    }
  }
  if (common.size() < 2) return std::nullopt;
  // More than two only where corners lie on a straight side: its ends are farthest apart.
  Segment longest{common[0], common[1]};
  for (std::size_t a = 0; a < common.size(); ++a) {
    for (std::size_t b = a + 1; b < common.size(); ++b) {
      if ((common[b] - common[a]).norm() > (longest.to - longest.from).norm()) longest = {common[a], common[b]};
    }
  }
  return longest;
}

/// The part of a segment of the polygon's plane that lies within the polygon, its border included.
std::optional<Segment> within(const Segment& segment, const Polygon& polygon, double touching) {
  double from = 0, to = 1;
  const Vec3 along = segment.to - segment.from;
  const auto& v = polygon.vertices();
  for (std::size_t k = 0; k < v.size(); ++k) {
    const Vec3 inward = polygon.normal().cross(v[(k + 1) % v.size()] - v[k]).normalized();
    const double at_from = inward.dot(segment.from - v[k]) + touching;
    const double at_to = inward.dot(segment.to - v[k]) + touching;
    if (at_from < 0 && at_to < 0) return std::nullopt;
    if (at_from < 0) from = std::max(from, at_from / (at_from - at_to));
    if (at_to < 0) to = std::min(to, at_from / (at_from - at_to));
  }
  const Segment part{segment.from + from * along, to < 1 ? Vec3(segment.from + to * along) : segment.to};
  if (to <= from || (part.to - part.from).norm() <= touching) return std::nullopt;
  return part;
}

}  // namespace

double touching_distance(const ElementMesh& mesh) {
  double largest = 0;
  for (const Face& face : mesh.faces) {
    for (const Vec3& v : face.polygon.vertices()) largest = std::max(largest, v.cwiseAbs().maxCoeff());
  }
  return std::max(kTouching * diagonal(mesh), kCornerRounding * largest);
}

std::vector<Contact> contacts(std::span<const Face> faces, double touching) {
  std::vector<Bounds> boxes;
  for (const Face& face : faces) boxes.push_back(bounds_of(face.polygon));
  std::vector<std::size_t> order(faces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(boxes[a].low.x(), a) < std::pair(boxes[b].low.x(), b);
  });
  std::vector<Contact> found;
  const auto add = [&](std::size_t face, std::size_t other) {
    const Polygon& polygon = faces[face].polygon;
    const auto common = common_with_plane(faces[other].polygon, polygon, touching);
    const auto part = common ? within(*common, polygon, touching) : std::nullopt;
    if (part) found.push_back({face, *part});
  };
  for (std::size_t k = 0; k < order.size(); ++k) {
    for (std::size_t m = k + 1; m < order.size(); ++m) {
      const std::size_t a = order[k], b = order[m];
      if (boxes[b].low.x() > boxes[a].high.x() + touching) break;
      if ((boxes[a].low.array() > boxes[b].high.array() + touching).any() ||
          (boxes[b].low.array() > boxes[a].high.array() + touching).any()) {
        continue;
      }
      add(a, b);
      add(b, a);
    }
  }
  const auto before = [](const Contact& a, const Contact& b) {
    const double length_a = (a.segment.to - a.segment.from).norm(), length_b = (b.segment.to - b.segment.from).norm();
    return a.face != b.face ? a.face < b.face : length_a > length_b;
  };
  std::stable_sort(found.begin(), found.end(), before);
  return found;
}

ElementMesh cut_at_contacts(const ElementMesh& mesh) {
  ElementMesh cut{mesh.faces, {}, 0, {}};
  if (mesh.elements.empty()) return cut;
  const double touching = touching_distance(mesh);
  cut.contacts = contacts(mesh.faces, touching);
  std::vector<std::vector<Segment>> segments(mesh.faces.size());
  for (const Contact& contact : cut.contacts) segments[contact.face].push_back(contact.segment);

  std::vector<bool> falls(mesh.patches, false);
  for (const Element& element : mesh.elements) {
    const Vec3& normal = mesh.face_of(element).polygon.normal();
    auto pieces = cut_along({&element.polygon, 1}, normal, segments[element.face], touching);
    if (pieces.size() > 1) falls[element.patch] = true;
    for (CutPiece& piece : pieces) {
      cut.elements.push_back(
          {std::move(piece.polygon), element.face, element.patch, pieces.size() > 1 ? kNoCell : element.cell});
    }
  }
  // Patches are numbered anew, in the order of their first elements.
  constexpr std::size_t kUnnamed = static_cast<std::size_t>(-1);
  std::vector<std::size_t> names(mesh.patches, kUnnamed);
  for (Element& element : cut.elements) {
    std::size_t& name = names[element.patch];
    if (falls[element.patch] || name == kUnnamed) name = cut.patches++;
    element.patch = name;
  }
  return cut;
}

}  // namespace etendue
