// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/sharp_plane.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "etendue/geometry/newell.hpp"

namespace etendue {

namespace {

/// Newell's sum errs by 2^-100 n d² (geometry/NOTES.md §6), products and sums behind it by a few u².
constexpr double kSharp = 0x1p-98;

Vec3 leading(const DoubleDouble3& v) {
  return {v.x.high, v.y.high, v.z.high};
}

}  // namespace

SharpPlane::SharpPlane(const std::vector<Vec3>& vertices) : vertices_(vertices) {
  const DoubleDouble3 sum = newell_sum(vertices);
  const double norm = leading(sum).norm();
  shrink_ = 1 / norm;
  normal_ = {sum.x * shrink_, sum.y * shrink_, sum.z * shrink_};
  double reach = 0;
  for (const Vec3& v : vertices) reach = std::max(reach, (v - vertices_.front()).norm());
  normal_error_ = kSharp * (1 + 4 * static_cast<double>(vertices.size()) * reach * reach / norm);
  for (const Vec3& v : vertices) flatness_ = std::max(flatness_, std::abs(height(v)));
}

DoubleDouble SharpPlane::wide_height(const Vec3& point) const {
  if (point == vertices_.front()) return 0;
  const DoubleDouble height = dot(exact_difference(point, vertices_.front()), normal_);
  return std::abs(height.high) > error(point) ? height : exact_height(point);
}

DoubleDouble SharpPlane::exact_height(const Vec3& point) const {
  return exact_newell_height(vertices_, point).to_double_double() * shrink_;
}

double SharpPlane::error(const Vec3& point) const {
  constexpr double kComponents = 2;  // √3 for three components, and the rounding of the norm
  return kComponents * normal_error_ * (point - vertices_.front()).norm();
}

double least_sine(const SharpPlane& a, const SharpPlane& b) {
  constexpr double kLost = 4;               // √3 times either normal's error, and a share for the product
  constexpr double kLengths = 1 - 0x1p-48;  // the normals' lengths, the rounding of the norm
  const double sine = leading(cross(a.normal_, b.normal_)).norm();
  return kLengths * std::max(0.0, sine - kLost * (a.normal_error_ + b.normal_error_));
}

}  // namespace etendue
