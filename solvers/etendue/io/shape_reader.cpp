// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/shape_reader.hpp"

#include <utility>

#include "etendue/io/curved_shape_reader.hpp"
#include "etendue/io/mesh_reader.hpp"
#include "etendue/io/shape_values.hpp"

namespace etendue {

namespace {

/// More vertices than any polygon of a scene has; the checks of Polygon::make grow with their square.
constexpr std::size_t kMostVertices = 10000;

std::optional<Shape> out_of_range(const SceneNode& node) {
  complain_out_of_range(node);
  return std::nullopt;
}

/// Chains of placed vertices, one a hole; nothing where one cannot be read.
std::optional<std::vector<std::vector<Vec3>>> read_holes(const SceneNode& node, const Placement& placement) {
  std::vector<std::vector<Vec3>> holes;
  const auto chains = node.items(1, kMostVertices, "holes");
  for (const SceneNode& chain : chains) {
    auto vertices = read_vertices(chain, 3, kMostVertices);
    if (!vertices) continue;
    for (Vec3& vertex : *vertices) vertex = placement.point(vertex);
    holes.push_back(std::move(*vertices));
  }
  if (holes.empty() || holes.size() != chains.size()) return std::nullopt;
  return holes;
}

std::optional<Shape> read_polygon(const SceneNode& node, const Placement& placement) {
  const auto member = node.member("vertices");
  auto vertices = member ? read_vertices(*member, 3, kMostVertices) : std::nullopt;
  const auto holes_member = node.member("holes");
  auto holes = holes_member ? read_holes(*holes_member, placement) : std::nullopt;
  if (!vertices || (holes_member && !holes)) return std::nullopt;
  for (Vec3& vertex : *vertices) {
    vertex = placement.point(vertex);
    if (!usable(vertex)) return out_of_range(node);
  }
  auto polygon = Polygon::make(std::move(*vertices));
  if (!polygon) {
    const std::string& why = polygon.error().message;  // "polygon: what is wrong"
    member->complain("found a polygon that is none: " + why.substr(why.find(' ') + 1) +
                     "; expected a flat one whose edges do not cross");
    return std::nullopt;
  }
  if (!holes) return Shape(std::move(*polygon));
  auto pierced = PolygonWithHoles::make(std::move(*polygon), std::move(*holes));
  if (!pierced) {
    const std::string& why = pierced.error().message;
    holes_member->complain("found " + why.substr(why.find(' ') + 1) +
                           "; expected holes inside the polygon, in its plane and apart from each other");
    return std::nullopt;
  }
  return Shape(std::move(*pierced));
}

std::optional<Shape> read_triangle(const SceneNode& node, const Placement& placement) {
  const auto member = node.member("vertices");
  auto vertices = member ? read_vertices(*member, 3, 3) : std::nullopt;
  if (!vertices) return std::nullopt;
  for (Vec3& vertex : *vertices) {
    vertex = placement.point(vertex);
    if (!usable(vertex)) return out_of_range(node);
  }
  const Triangle triangle{(*vertices)[0], (*vertices)[1], (*vertices)[2]};
  if (const auto fault = fault_of_area(triangle)) {
    member->complain("found three vertices that " + *fault + ", expected a triangle with an area");
    return std::nullopt;
  }
  return triangle;
}

std::optional<Shape> read_plane(const SceneNode& node, const Placement& placement) {
  const auto point = vector_of(node, "point");
  const auto normal = direction_of(node, "normal");
  if (!point || !normal) return std::nullopt;
  const Plane plane{placement.point(*point), placement.normal(*normal)};
  if (!usable(plane.point) || !plane.normal.allFinite()) return out_of_range(node);
  return plane;
}

std::optional<Shape> read_placed_mesh(const SceneNode& node, const Placement& placement) {
  auto mesh = read_mesh(node);
  if (!mesh) return std::nullopt;
  for (Vec3& vertex : mesh->vertices) {
    vertex = placement.point(vertex);
    if (!usable(vertex)) return out_of_range(node);
  }
  return Shape(std::move(*mesh));
}

}  // namespace

std::optional<Shape> read_shape(const SceneNode& node, const std::string& type, const Placement& placement) {
  if (type == "polygon") return read_polygon(node, placement);
  if (type == "triangle") return read_triangle(node, placement);
  if (type == "plane") return read_plane(node, placement);
  if (type == "mesh") return read_placed_mesh(node, placement);
  if (type == "box") {
    const auto box = read_placed_box(node, type, placement);
    return box ? std::optional<Shape>(*box) : std::nullopt;
  }
  return read_curved_shape(node, type, placement);
}

void read_numbers_of_shapes(const SceneNode& node) {
  for (const char* key : {"centre", "point", "base", "top", "low", "high"}) (void)vector_of(node, key);
  (void)vector_of(node, "size", kPositive);
  (void)direction_of(node, "normal");
  for (const char* key : {"squares", "products", "linear"}) (void)vector_of(node, key);
  (void)direction_of(node, "axis");
  for (const char* key : {"radius", "ring_radius", "tube_radius"}) (void)length_of(node, key);
  for (const char* key : {"base_radius", "top_radius"}) (void)length_of(node, key, kNonNegative);
  (void)length_of(node, "constant", kAnyNumber);
  if (const auto holes = node.member("holes")) (void)read_holes(*holes, {});
  if (const auto vertices = node.member("vertices")) (void)read_vertices(*vertices, 3, kMostVertices);
}

}  // namespace etendue
