// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/curved_shape_reader.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "etendue/io/shape_values.hpp"
#include "etendue/text/number_text.hpp"

namespace etendue {

namespace {

std::optional<Shape> out_of_range(const SceneNode& node) {
  complain_out_of_range(node);
  return std::nullopt;
}

/// The domain of the polynomials: lengths between 2^-120 and 2^120 (cone.hpp, torus.hpp, quadric.hpp, bezier.hpp).
constexpr double kGreatest = 1e36, kLeast = 1e-36;

/// Cones longer than so many radii are refused: their hits would have few digits, and get lost in the end (cone.hpp).
constexpr double kLongestInRadii = 0x1p26;

bool in_domain(const Vec3& v) {
  return v.allFinite() && v.lpNorm<Eigen::Infinity>() <= kGreatest;
}
bool in_domain(double length) {
  return length >= kLeast && length <= kGreatest;
}
std::optional<Shape> out_of_domain(const SceneNode& node, const std::string& type) {
  node.complain("found a " + type +
                " out of range, expected coordinates within ±1e+36 and lengths in [1e-36, 1e+36] where it stands");
  return std::nullopt;
}

std::optional<Shape> read_sphere(const SceneNode& node, const Placement& placement) {
  const auto centre = vector_of(node, "centre");
  const auto radius = length_of(node, "radius");
  const bool round = stays_round(node, "sphere", placement);
  if (!centre || !radius || !round) return std::nullopt;
  const Sphere sphere{placement.point(*centre), placement.scale * *radius};
  if (!usable(sphere.centre) || !usable(sphere.radius)) return out_of_range(node);
  return sphere;
}

std::optional<Shape> read_disc(const SceneNode& node, const Placement& placement) {
  const auto centre = vector_of(node, "centre");
  const auto normal = direction_of(node, "normal");
  const auto radius = length_of(node, "radius");
  const bool round = stays_round(node, "disc", placement);
  if (!centre || !normal || !radius || !round) return std::nullopt;
  const Disc disc{placement.point(*centre), placement.normal(*normal), placement.scale * *radius};
  if (!usable(disc.centre) || !usable(disc.radius) || !disc.normal.allFinite()) return out_of_range(node);
  return disc;
}

std::optional<Shape> read_cylinder(const SceneNode& node, const Placement& placement) {
  const auto base = vector_of(node, "base"), top = vector_of(node, "top");
  const auto radius = length_of(node, "radius");
  const bool round = stays_round(node, "cylinder", placement);
  if (!base || !top || !radius || !round) return std::nullopt;
  const Cylinder cylinder{placement.point(*base), placement.point(*top), placement.scale * *radius};
  if (!usable(cylinder.base) || !usable(cylinder.top) || !usable(cylinder.radius)) return out_of_range(node);
  if (cylinder.base == cylinder.top) {
    node.complain("found base and top in one point, expected a cylinder with a height");
    return std::nullopt;
  }
  return cylinder;
}

std::optional<Shape> read_cone(const SceneNode& node, const Placement& placement) {
  const auto base = vector_of(node, "base"), top = vector_of(node, "top");
  const auto base_radius = length_of(node, "base_radius", kNonNegative);
  const auto top_radius = node.member("top_radius") ? length_of(node, "top_radius", kNonNegative) : 0.0;
  const bool round = stays_round(node, "cone", placement);
  if (!base || !top || !base_radius || !top_radius || !round) return std::nullopt;
  if (*base_radius == 0 && *top_radius == 0) {
    node.complain("found both radii 0, expected a cone with an end that is none");
    return std::nullopt;
  }
  const Cone cone{placement.point(*base), placement.point(*top), placement.scale * *base_radius,
                  placement.scale * *top_radius};
  if (cone.base == cone.top) {
    node.complain("found base and top in one point, expected a cone with a height");
    return std::nullopt;
  }
  const auto radius_in_domain = [](double radius) { return radius == 0 || in_domain(radius); };
  if (!in_domain(cone.base) || !in_domain(cone.top) || !in_domain((cone.top - cone.base).norm()) ||
      !radius_in_domain(cone.base_radius) || !radius_in_domain(cone.top_radius)) {
    return out_of_domain(node, "cone");
  }
  const double length = (cone.top - cone.base).norm(), radius = std::max(cone.base_radius, cone.top_radius);
  if (length > kLongestInRadii * radius) {
    node.complain("found a cone " + rounded(length, 3) + " long with a radius of " + rounded(radius, 3) +
                  " at most, expected a length of at most 2^26 = 67108864 radii");
    return std::nullopt;
  }
  return cone;
}

std::optional<Shape> read_torus(const SceneNode& node, const Placement& placement) {
  const auto centre = vector_of(node, "centre");
  const auto axis = direction_of(node, "axis");
  const auto ring = length_of(node, "ring_radius"), tube = length_of(node, "tube_radius");
  const bool round = stays_round(node, "torus", placement);
  if (!centre || !axis || !ring || !tube || !round) return std::nullopt;
  if (!(*tube < *ring)) {
    node.complain("found a tube_radius of " + shortest(*tube) + ", not below the ring_radius of " + shortest(*ring) +
                  ", expected a ring with a hole: a spindle would meet itself");
    return std::nullopt;
  }
  const Torus torus{placement.point(*centre), placement.normal(*axis), placement.scale * *ring,
                    placement.scale * *tube};
  if (!in_domain(torus.centre) || !in_domain(torus.ring) || !in_domain(torus.tube) || !(torus.tube < torus.ring) ||
      !torus.axis.allFinite()) {
    return out_of_domain(node, "torus");
  }
  if (torus.ring > kThinnestTorus * torus.tube) {
    node.complain("found a tube_radius of " + rounded(torus.tube, 3) + " around a ring_radius of " +
                  rounded(torus.ring, 3) + ", expected at least 2^-26 = 1.49e-08 of it");
    return std::nullopt;
  }
  return torus;
}

/// Does the polynomial, counted from the middle of a box of these half edges, keep its sign in it? Told by the sum of its
/// least and of its greatest terms, which are its own range unless there are products.
bool keeps_sign(const Quadric& quadric, const Vec3& half) {
  double least = quadric.constant, greatest = quadric.constant;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double square = quadric.square(k, k), linear = 2 * quadric.linear[k], edge = half[k];
    double low = square * edge * edge - std::abs(linear) * edge, high = square * edge * edge + std::abs(linear) * edge;
    if (std::abs(linear) < 2 * std::abs(square) * edge) {  // its vertex lies inside
      const double vertex = -linear * linear / (4 * square);
      (square > 0 ? low : high) = vertex;
    }
    const Eigen::Index next = (k + 1) % 3;
    const double product = 2 * std::abs(quadric.square(k, next)) * edge * half[next];
    least += low - product;
    greatest += high + product;
  }
  return least >= 0 || greatest <= 0;
}

std::optional<Shape> read_quadric(const SceneNode& node, const Placement& placement) {
  const auto optional_vector = [&](const char* key) {
    return node.member(key) ? vector_of(node, key) : std::optional<Vec3>(Vec3::Zero());
  };
  const auto squares = vector_of(node, "squares"), products = optional_vector("products");
  const auto linear = optional_vector("linear");
  const auto constant = length_of(node, "constant", kAnyNumber);
  const auto local = read_placed_box(node, "quadric", Placement{});
  const auto box = local ? read_placed_box(node, "quadric", placement) : std::nullopt;
  if (!squares || !products || !linear || !constant || !box) return std::nullopt;
  if (squares->isZero(0) && products->isZero(0) && linear->isZero(0)) {
    node.complain("found no coefficient but \"constant\", expected one that depends on the place");
    return std::nullopt;
  }
  // Counted from the box's centre, then turned with the box.
  const Vec3 centre = local->centre;
  Quadric quadric;
  const double xy = products->x() / 2, xz = products->y() / 2, yz = products->z() / 2;
  quadric.square << squares->x(), xy, xz, xy, squares->y(), yz, xz, yz, squares->z();
  quadric.constant = *constant + centre.dot(quadric.square * centre + *linear);
  quadric.linear = quadric.square * centre + *linear / 2;
  if (keeps_sign(quadric, local->half_edges)) {
    node.complain("found a quadric without a point in its box: its polynomial keeps its sign there");
    return std::nullopt;
  }
  const Mat3 to_local = placement.linear.inverse();
  quadric.square = to_local.transpose() * quadric.square * to_local;
  quadric.linear = to_local.transpose() * quadric.linear;
  quadric.box = *box;
  const bool finite = quadric.square.allFinite() && quadric.linear.allFinite() && std::isfinite(quadric.constant);
  if (!finite || !in_domain(box->centre) || !in_domain(box->half_edges.minCoeff()) ||
      !in_domain(box->half_edges.maxCoeff())) {
    return out_of_domain(node, "quadric");
  }
  return quadric;
}

/// Do the control points span an area that double arithmetic can see?
bool spans_area(const BezierSurface& surface) {
  const Vec3& corner = surface.control[0][0];
  double extent = 0, coordinate = 0;
  Vec3 along = Vec3::Zero();
  for (const auto& row : surface.control) {
    for (const Vec3& point : row) {
      coordinate = std::max(coordinate, point.lpNorm<Eigen::Infinity>());
      if ((point - corner).norm() > extent) along = point - corner;
      extent = along.norm();
    }
  }
  double across = 0;
  for (const auto& row : surface.control) {
    for (const Vec3& point : row) across = std::max(across, along.stableNormalized().cross(point - corner).norm());
  }
  return across > kNarrowest * coordinate;
}

std::optional<Shape> read_bezier(const SceneNode& node, const Placement& placement) {
  const auto member = node.member("control");
  if (!member) return std::nullopt;
  BezierSurface surface;
  bool complete = true, inside = true;
  const auto rows = member->items(4, 4, "rows of control points");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto points = rows[i].items(4, 4, "points");
    complete = complete && points.size() == 4;
    for (std::size_t j = 0; j < points.size(); ++j) {
      const auto point = points[j].vector();
      complete = complete && point;
      if (!point || i >= 4 || j >= 4) continue;
      surface.control[i][j] = placement.point(*point);
      inside = inside && in_domain(surface.control[i][j]);
    }
  }
  if (!complete || rows.size() != 4) return std::nullopt;
  if (!inside) return out_of_domain(node, "bezier surface");
  if (!spans_area(surface)) {
    member->complain("found sixteen points on one line, expected a surface with an area");
    return std::nullopt;
  }
  return surface;
}

}  // namespace

std::optional<Shape> read_curved_shape(const SceneNode& node, const std::string& type, const Placement& placement) {
  if (type == "sphere") return read_sphere(node, placement);
  if (type == "disc") return read_disc(node, placement);
  if (type == "cylinder") return read_cylinder(node, placement);
  if (type == "cone") return read_cone(node, placement);
  if (type == "torus") return read_torus(node, placement);
  if (type == "quadric") return read_quadric(node, placement);
  return type == "bezier" ? read_bezier(node, placement) : std::nullopt;
}

std::vector<Cap> caps_of(const Shape& shape) {
  std::vector<Cap> caps;
  const auto close = [&caps](const Vec3& base, const Vec3& top, double base_radius, double top_radius) {
    const Vec3 up = (top - base).stableNormalized();
    if (base_radius > 0) caps.push_back({"base", {base, -up, base_radius}});
    if (top_radius > 0) caps.push_back({"top", {top, up, top_radius}});
  };
  if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
    close(cylinder->base, cylinder->top, cylinder->radius, cylinder->radius);
  } else if (const auto* cone = std::get_if<Cone>(&shape)) {
    close(cone->base, cone->top, cone->base_radius, cone->top_radius);
  }
  return caps;
}

}  // namespace etendue
