// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/shading_normal.hpp"

#include <type_traits>

#include "etendue/core/contract.hpp"
#include "etendue/geometry/surface_chart.hpp"
#include "etendue/reflectance/bump.hpp"

namespace etendue {

namespace {

Vec3 gradient(const MaterialBump::Lay& lay, const ReliefKind& kind, const Vec3& point) {
  const Vec3 from = (point - lay.origin) / lay.size;
  const Relief at = relief(kind, lay.u.dot(from), lay.v.dot(from));
  return (at.along_u * lay.u + at.along_v * lay.v) / lay.size;
}

Vec3 gradient(const Shape& shape, const ReliefKind& kind, const Vec3& point) {
  const auto on = [&](const auto& each) -> Vec3 {
    using Kind = std::decay_t<decltype(each)>;
    if constexpr (std::is_same_v<Kind, Sphere> || std::is_same_v<Kind, Cylinder> || std::is_same_v<Kind, Cone> ||
                  std::is_same_v<Kind, Torus>) {
      const ChartPoint place = chart(each, point);
      return height_gradient(place.along_u, place.along_v, relief(kind, place.u, place.v));
    } else {
      require(false, "shading_normal: a shape with coordinates of its own, or a lay");
      return Vec3::Zero();
    }
  };
  return std::visit(on, shape);
}

}  // namespace

Vec3 shading_normal(const MaterialBump& bump, const Shape& shape, const Vec3& point, const Vec3& outward) {
  return bumped_normal(outward,
                       bump.lay ? gradient(*bump.lay, bump.relief, point) : gradient(shape, bump.relief, point));
}

}  // namespace etendue
