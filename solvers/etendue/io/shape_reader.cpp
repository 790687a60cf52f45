// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/shape_reader.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

#include "etendue/io/mesh_reader.hpp"

namespace etendue {

namespace {

/// Axes of a box that its transform has sheared have a cosine larger than the roundings of a chain of rotations leave:
/// each of up to some hundreds of products errs by a few 2^-53.
constexpr double kLargestAxisCosine = 0x1p-40;

/// More vertices than any polygon of a scene has; the checks of Polygon::make grow with their square.
constexpr std::size_t kMostVertices = 10000;

/// What a placed length or coordinate must still be.
bool usable(const Vec3& v) {
  return v.allFinite() && v.cwiseAbs().maxCoeff() <= kLargestNumber;
}
bool usable(double length) {
  return length > 0 && length <= kLargestNumber;
}

template <class T>
std::optional<T> out_of_range(const SceneNode& node) {
  node.complain(
      "found a transform that moves the shape out of range, expected coordinates within ±1e+50 and lengths > 0");
  return std::nullopt;
}

/// Values of mandatory members; a missing one was reported by SceneNode::is().
std::optional<Vec3> vector_of(const SceneNode& node, const char* key, const Interval& interval = kAnyNumber) {
  const auto member = node.member(key);
  return member ? member->vector(interval) : std::nullopt;
}
std::optional<Vec3> direction_of(const SceneNode& node, const char* key) {
  const auto member = node.member(key);
  return member ? member->direction() : std::nullopt;
}
std::optional<double> length_of(const SceneNode& node, const char* key) {
  const auto member = node.member(key);
  return member ? member->number(kPositive) : std::nullopt;
}

/// A round shape under a scale that would make it oval.
bool stays_round(const SceneNode& node, const std::string& type, const Placement& placement) {
  if (placement.keeps_shape) return true;
  node.complain("found a scale that is not the same along all axes, expected one number for a " + type);
  return false;
}

std::optional<Shape> read_sphere(const SceneNode& node, const Placement& placement) {
  const auto centre = vector_of(node, "centre");
  const auto radius = length_of(node, "radius");
  const bool round = stays_round(node, "sphere", placement);
  if (!centre || !radius || !round) return std::nullopt;
  const Sphere sphere{placement.point(*centre), placement.scale * *radius};
  if (!usable(sphere.centre) || !usable(sphere.radius)) return out_of_range<Shape>(node);
  return sphere;
}

std::optional<Shape> read_polygon(const SceneNode& node, const Placement& placement) {
  const auto member = node.member("vertices");
  auto vertices = member ? read_vertices(*member, 3, kMostVertices) : std::nullopt;
  if (!vertices) return std::nullopt;
  for (Vec3& vertex : *vertices) {
    vertex = placement.point(vertex);
    if (!usable(vertex)) return out_of_range<Shape>(node);
  }
  auto polygon = Polygon::make(std::move(*vertices));
  if (!polygon) {
    const std::string& why = polygon.error().message;  // "polygon: what is wrong"
    member->complain("found a polygon that is none: " + why.substr(why.find(' ') + 1) +
                     "; expected a flat one whose edges do not cross");
    return std::nullopt;
  }
  return Shape(*polygon);
}

std::optional<Shape> read_triangle(const SceneNode& node, const Placement& placement) {
  const auto member = node.member("vertices");
  auto vertices = member ? read_vertices(*member, 3, 3) : std::nullopt;
  if (!vertices) return std::nullopt;
  for (Vec3& vertex : *vertices) {
    vertex = placement.point(vertex);
    if (!usable(vertex)) return out_of_range<Shape>(node);
  }
  const Triangle triangle{(*vertices)[0], (*vertices)[1], (*vertices)[2]};
  if (!has_area(triangle)) {
    member->complain("found three vertices on one line, expected a triangle with an area");
    return std::nullopt;
  }
  return triangle;
}

std::optional<Shape> read_plane(const SceneNode& node, const Placement& placement) {
  const auto point = vector_of(node, "point");
  const auto normal = direction_of(node, "normal");
  if (!point || !normal) return std::nullopt;
  const Plane plane{placement.point(*point), placement.normal(*normal)};
  if (!usable(plane.point) || !plane.normal.allFinite()) return out_of_range<Shape>(node);
  return plane;
}

std::optional<Shape> read_disc(const SceneNode& node, const Placement& placement) {
  const auto centre = vector_of(node, "centre");
  const auto normal = direction_of(node, "normal");
  const auto radius = length_of(node, "radius");
  const bool round = stays_round(node, "disc", placement);
  if (!centre || !normal || !radius || !round) return std::nullopt;
  const Disc disc{placement.point(*centre), placement.normal(*normal), placement.scale * *radius};
  if (!usable(disc.centre) || !usable(disc.radius) || !disc.normal.allFinite()) return out_of_range<Shape>(node);
  return disc;
}

std::optional<Shape> read_cylinder(const SceneNode& node, const Placement& placement) {
  const auto base = vector_of(node, "base"), top = vector_of(node, "top");
  const auto radius = length_of(node, "radius");
  const bool round = stays_round(node, "cylinder", placement);
  if (!base || !top || !radius || !round) return std::nullopt;
  const Cylinder cylinder{placement.point(*base), placement.point(*top), placement.scale * *radius};
  if (!usable(cylinder.base) || !usable(cylinder.top) || !usable(cylinder.radius)) return out_of_range<Shape>(node);
  if (cylinder.base == cylinder.top) {
    node.complain("found base and top in one point, expected a cylinder with a height");
    return std::nullopt;
  }
  return cylinder;
}

/// Low and high corner of the box as written.
std::optional<std::pair<Vec3, Vec3>> read_corners(const SceneNode& node) {
  const bool by_corners = node.member("low") || node.member("high");
  const bool by_centre = node.member("centre") || node.member("size");
  if (by_corners == by_centre || !node.member(by_corners ? "high" : "size") ||
      !node.member(by_corners ? "low" : "centre")) {
    node.complain("found a box with other keys, expected either \"low\" and \"high\", or \"centre\" and \"size\"");
    for (const char* key : {"low", "high", "centre"}) (void)vector_of(node, key);
    (void)vector_of(node, "size", kPositive);
    return std::nullopt;
  }
  if (by_centre) {
    const auto centre = vector_of(node, "centre");
    const auto size = vector_of(node, "size", kPositive);
    if (!centre || !size) return std::nullopt;
    return std::pair<Vec3, Vec3>(*centre - *size / 2, *centre + *size / 2);
  }
  const auto low = vector_of(node, "low"), high = vector_of(node, "high");
  if (!low || !high) return std::nullopt;
  if (!(low->array() < high->array()).all()) {
    node.member("high")->complain(
        "found a coordinate that is not above that of \"low\", expected low < high on each axis");
    return std::nullopt;
  }
  return std::pair<Vec3, Vec3>(*low, *high);
}

std::optional<Shape> read_box(const SceneNode& node, const Placement& placement) {
  const auto corners = read_corners(node);
  if (!corners) return std::nullopt;
  const auto& [low, high] = *corners;
  Box box;
  box.centre = placement.point((low + high) / 2);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Vec3 edge = placement.linear.col(axis);
    box.axes.col(axis) = edge.stableNormalized();
    box.half_edges[axis] = edge.stableNorm() * ((high[axis] - low[axis]) / 2);
  }
  if (!usable(box.centre) || !usable(box.half_edges) || !usable(box.half_edges.minCoeff()) || !box.axes.allFinite()) {
    return out_of_range<Shape>(node);
  }
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    if (std::abs(box.axes.col(axis).dot(box.axes.col((axis + 1) % 3))) <= kLargestAxisCosine) continue;
    node.complain("found a transform that shears the box, expected right angles (or a mesh)");
    return std::nullopt;
  }
  return box;
}

std::optional<Shape> read_placed_mesh(const SceneNode& node, const Placement& placement) {
  auto mesh = read_mesh(node);
  if (!mesh) return std::nullopt;
  for (Vec3& vertex : mesh->vertices) {
    vertex = placement.point(vertex);
    if (!usable(vertex)) return out_of_range<Shape>(node);
  }
  return Shape(std::move(*mesh));
}

}  // namespace

std::optional<Shape> read_shape(const SceneNode& node, const std::string& type, const Placement& placement) {
  if (type == "sphere") return read_sphere(node, placement);
  if (type == "polygon") return read_polygon(node, placement);
  if (type == "triangle") return read_triangle(node, placement);
  if (type == "plane") return read_plane(node, placement);
  if (type == "disc") return read_disc(node, placement);
  if (type == "cylinder") return read_cylinder(node, placement);
  if (type == "box") return read_box(node, placement);
  require(type == "mesh", "read_shape: the type is one of object_types()");
  return read_placed_mesh(node, placement);
}

void read_numbers_of_shapes(const SceneNode& node) {
  for (const char* key : {"centre", "point", "base", "top", "low", "high"}) (void)vector_of(node, key);
  (void)vector_of(node, "size", kPositive);
  (void)direction_of(node, "normal");
  (void)length_of(node, "radius");
  if (const auto vertices = node.member("vertices")) (void)read_vertices(*vertices, 3, kMostVertices);
}

}  // namespace etendue
