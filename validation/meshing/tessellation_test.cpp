// SPDX-License-Identifier: Apache-2.0
#include "etendue/meshing/tessellation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "etendue/geometry/vertex_normals.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

// CLAIM      Nets of all shapes lie on the shapes and are seen from outside; what has no net is refused by name.
// ORACLE     identity: each corner in the shape's equation; triangles around a centre have it behind them.
// TOLERANCE  1e-13 for sizes of a few units.
TEST(Tessellation, LiesOnTheShape) {
  proves({}, Oracle::identity, "the shapes' equations");
  const auto net = [](const Shape& shape) {
    Object object;
    object.name = "thing";
    object.shape = shape;
    return tessellated(object, {});
  };
  const Vec3 c(1, -2, 0.5), axis = Vec3(1, 2, -1).normalized();
  const auto check = [&](const Shape& shape, const auto& fault, const auto& inner) {
    const auto made = net(shape);
    ASSERT_TRUE(made.ok());
    for (const Vec3& v : made->mesh.vertices) EXPECT_TRUE(within(std::abs(fault(v)), 1e-13));
    const auto normals = facet_normals(made->mesh);
    std::uint64_t wrong = 0;
    for (std::size_t t = 0; t < normals.size(); ++t) {
      const Triangle triangle = made->mesh.triangle(t);
      const Vec3 middle = (triangle.a + triangle.b + triangle.c) / 3;
      wrong += normals[t].dot(middle - inner(middle)) <= 0;
    }
    EXPECT_TRUE(all_agree(wrong, normals.size()));
  };
  const auto height = [&](const Vec3& p) { return (p - c).dot(axis); };
  const auto away = [&](const Vec3& p) { return (p - c - height(p) * axis).norm(); };
  const auto foot = [&](const Vec3& p) { return Vec3(c + height(p) * axis); };
  check(
      Sphere{c, 2}, [&](const Vec3& p) { return (p - c).norm() - 2; }, [&](const Vec3&) { return c; });
  check(
      Cylinder{c, c + 3 * axis, 0.7}, [&](const Vec3& p) { return away(p) - 0.7; }, foot);
  check(
      Cone{c, c + 3 * axis, 1.5, 0}, [&](const Vec3& p) { return away(p) - 1.5 + 0.5 * height(p); }, foot);
  check(
      Cone{c, c + 3 * axis, 0.5, 1}, [&](const Vec3& p) { return away(p) - 0.5 - height(p) / 6; }, foot);
  check(
      Torus{c, axis, 2, 0.5}, [&](const Vec3& p) { return std::hypot(away(p) - 2, height(p)) - 0.5; },
      [&](const Vec3& p) { return Vec3(c + 2 * (p - foot(p)).normalized()); });
  check(Disc{c, axis, 2}, height, [&](const Vec3& p) { return Vec3(p - axis); });
  const Box box{c, Eigen::AngleAxisd(0.7, axis).toRotationMatrix(), {1, 2, 3}};
  check(
      box,
      [&](const Vec3& p) {
        return ((box.axes.transpose() * (p - c)).cwiseAbs() - box.half_edges).cwiseAbs().maxCoeff();
      },
      [&](const Vec3&) { return c; });
  // A star: concave, its triangles add up to its area.
  std::vector<Vec3> star;
  for (int k = 0; k < 10; ++k) {
    const double turn = 0.2 + std::numbers::pi * k / 5, radius = k % 2 ? 0.8 : 2;
    star.emplace_back(radius * std::cos(turn), radius * std::sin(turn), 0.0);
  }
  const Polygon polygon = Polygon::make(star).value();
  const auto cut = net(polygon);
  double area = 0;
  for (std::size_t t = 0; t < cut->mesh.triangles.size(); ++t) {
    const Triangle part = cut->mesh.triangle(t);
    const double z = (part.b - part.a).cross(part.c - part.a).z();
    EXPECT_GT(z, 0);
    area += z / 2;
  }
  EXPECT_EQ(cut->mesh.triangles.size(), 8u);
  EXPECT_TRUE(near(area, polygon.area(), 1e-13));
  const auto refused = net(Plane{c, axis});
  EXPECT_TRUE(holds(!refused.ok() &&
                    refused.error().message.find("'thing' is an infinite plane") == std::string("object ").size()));
}

// CLAIM      plane_before() is in the plane, wound along its normal, and goes on around the eye's foot until 2^-20 from the horizon; an eye in
//            the plane sees nothing of it.
// ORACLE     identity: the plane's equation; angles from the eye.
// TOLERANCE  2^-50 of its size for coordinates; 1e-6 of the angle.
TEST(Tessellation, OfAPlaneGoesToTheHorizon) {
  proves({}, Oracle::identity, "the plane's equation; angles from the eye");
  const Plane plane{{1, 2, 3}, Vec3(1, -2, 2) / 3};
  for (const double height : {1e-3, -4.0}) {
    const Vec3 foot = plane.point + Vec3(2, 2, 1), eye = foot + height * plane.normal;
    const Tessellation net = plane_before(plane, eye);
    for (const Vec3& normal : facet_normals(net.mesh)) EXPECT_TRUE(near(normal.dot(plane.normal), 1, 0x1p-50));
    double size = 0;
    for (const Vec3& corner : net.mesh.vertices) size = std::max(size, (corner - foot).norm());
    for (std::size_t t = 0; t < 2; ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& a = net.mesh.vertices[net.mesh.triangles[t][k]];
        const Vec3& b = net.mesh.vertices[net.mesh.triangles[t][(k + 1) % 3]];
        EXPECT_TRUE(within(std::abs(plane.normal.dot(a - plane.point)), 0x1p-50 * size));
        if ((a - b).norm() > 1.5 * size) continue;  // the diagonal
        const double nearest = ((a + b) / 2 - foot).norm();
        EXPECT_TRUE(near(std::atan(std::abs(height) / nearest), 0x1p-20, 0x1p-20 * 1e-6));
      }
    }
  }
  EXPECT_TRUE(holds(plane_before(plane, plane.point + Vec3(2, 2, 1)).mesh.triangles.empty()));
}

}  // namespace
}  // namespace etendue::validation
