// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "etendue/geometry/polygon.hpp"

namespace etendue::validation {

inline Polygon polygon(std::vector<Vec3> vertices) {
  return Polygon::make(std::move(vertices)).value();
}

/// The parallelogram o, o + a, o + a + b, o + b; its front is where a × b points.
inline Polygon rectangle(const Vec3& o, const Vec3& a, const Vec3& b) {
  return polygon({o, o + a, o + a + b, o + b});
}

/// Faces, seen from outside, of the block whose corner k lies at the end of those edges whose bits k has.
inline std::vector<Polygon> block(const std::array<Vec3, 8>& v) {
  constexpr std::array<std::array<std::size_t, 4>, 6> kFaces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  std::vector<Polygon> faces;
  for (const auto& face : kFaces) faces.push_back(polygon({v[face[0]], v[face[1]], v[face[2]], v[face[3]]}));
  return faces;
}

/// Of a loop in a plane across z; negative where it runs clockwise as seen from above.
inline double signed_area(const std::vector<Vec3>& loop) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3 &a = loop[i], &b = loop[(i + 1) % loop.size()];
    sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  return sum;
}

/// A rotation about no axis of the coordinates, and a shift: frames that hide nothing by being aligned.
inline Vec3 tilted(const Vec3& p) {
  static const Mat3 rotation =
      (Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()) * Eigen::AngleAxisd(1.1, Vec3(-2, 1, 0.5).normalized()))
          .toRotationMatrix();
  return rotation * p + Vec3(0.3, -0.2, 0.9);
}

inline Polygon tilted(const Polygon& p) {
  std::vector<Vec3> placed;
  for (const Vec3& v : p.vertices()) placed.push_back(tilted(v));
  return polygon(std::move(placed));
}

/// Whether the segment between two points crosses a convex polygon: signs of volumes, no division.
inline bool crosses(const Vec3& p, const Vec3& q, const std::vector<Vec3>& v) {
  const Vec3 normal = (v[1] - v[0]).cross(v[2] - v[0]);
  if (normal.dot(p - v[0]) * normal.dot(q - v[0]) >= 0) return false;
  const double side = normal.dot(q - p) > 0 ? 1 : -1;
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (side * (v[i] - p).cross(v[(i + 1) % v.size()] - p).dot(q - p) < 0) return false;
  }
  return true;
}

/// Three leaning blockers between the unit squares z = 0 and z = 1; the last touches the upper one.
inline std::vector<Polygon> leaning_blockers() {
  return {rectangle({0.2, 0.1, 0.3}, {0.4, 0, 0.1}, {0, 0.5, 0.05}),
          rectangle({0.6, 0.4, 0.6}, {0.5, 0.1, 0}, {-0.1, 0.4, 0.1}),
          rectangle({0.5, 0.2, 0.7}, {0, 0.6, 0}, {0, 0, 0.3})};
}

/// What straight lines between the unit squares z = 0 and z = 1 find of the form factor, and its standard error by the
/// plain estimator, which stratification only lowers: one point pair in each of side⁴ strata, from `unit` in [0, 1).
struct RayEstimate {
  double mean, error;
};
template <class Unit>
RayEstimate between_unit_squares(const std::vector<Polygon>& blockers, int side, Unit unit) {
  const int strata = side * side * side * side;
  double sum = 0, squares = 0;
  for (int s = 0; s < strata; ++s) {
    const auto cell = [&](int divisor) { return (s / divisor % side + unit()) / side; };
    const double px = cell(1), py = cell(side), qx = cell(side * side), qy = cell(side * side * side);
    const Vec3 p(px, py, 0), q(qx, qy, 1);
    bool hidden = false;
    for (const Polygon& b : blockers) hidden = hidden || crosses(p, q, b.vertices());
    const double square = (q - p).squaredNorm();
    const double term = hidden ? 0 : 1 / (std::numbers::pi * square * square);
    sum += term;
    squares += term * term;
  }
  const double mean = sum / strata;
  return {mean, std::sqrt((squares / strata - mean * mean) / strata)};
}

}  // namespace etendue::validation
