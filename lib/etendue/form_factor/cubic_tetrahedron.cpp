// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/cubic_tetrahedron.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/point_polygon.hpp"

namespace etendue {

namespace {

/// The sum of three 2, the root 1, its inverse as a quotient 1, and two for the bound itself.
constexpr int kSumRoundings = 6;

/// The half of a pixel that lies above the diagonal from (x1, y0) to (x0, y1), which lies in the patch's plane: by Lambert's
/// sum over its three edges.
double upper_half(const HemicubeRectangle& pixel) {
  const std::array<Vec3, 3> corners{Vec3(pixel.to_x, pixel.from_y, 1), Vec3(pixel.to_x, pixel.to_y, 1),
                                    Vec3(pixel.from_x, pixel.to_y, 1)};
  return std::abs(lambert_sum(corners, Vec3::Constant(1 / std::numbers::sqrt3)).value);
}

}  // namespace

double cubic_tetrahedron_delta(double x, double y, double area) {
  require(x + y + 1 >= 0, "cubic_tetrahedron_delta: the pixel is not below the patch's plane");
  const double r2 = x * x + y * y + 1;
  return (x + y + 1) * area / (std::numbers::sqrt3 * std::numbers::pi * (r2 * r2));
}

Bounded cubic_tetrahedron_factor(const HemicubeRectangle& r) {
  const Bounded even = hemicube_top_factor(r);
  const Bounded along_y = hemicube_side_factor({r.from_x, r.to_x, std::abs(r.from_y), std::abs(r.to_y)});
  const Bounded along_x = hemicube_side_factor({r.from_y, r.to_y, std::abs(r.from_x), std::abs(r.to_x)});
  const double size = std::abs(even.value) + std::abs(along_x.value) + std::abs(along_y.value);
  return {(even.value + along_x.value + along_y.value) / std::numbers::sqrt3,
          (even.bound + along_x.bound + along_y.bound + gamma_bound(kSumRoundings) * size) / std::numbers::sqrt3};
}

CubicTetrahedronDeltas::CubicTetrahedronDeltas(int resolution) : half_(resolution / 2) {
  constexpr int kFinest = 4096;  // as for HemicubeDeltas
  require(resolution >= 2 && resolution <= kFinest && resolution % 2 == 0,
          "CubicTetrahedronDeltas: the resolution is even, from 2 to 4096");
  const double pixel = 3.0 / resolution;
  for (int i = half_; i < resolution; ++i) {
    for (int j = resolution - 1 - i; j <= i; ++j) {
      const HemicubeRectangle square{-2 + i * pixel, -2 + (i + 1) * pixel, -2 + j * pixel, -2 + (j + 1) * pixel};
      values_.push_back(i + j == resolution - 1 ? upper_half(square) : cubic_tetrahedron_factor(square).value);
    }
  }
}

double CubicTetrahedronDeltas::at(int i, int j) const {
  require(i >= 0 && j >= 0 && i < resolution() && j < resolution() && i + j >= resolution() - 1,
          "CubicTetrahedronDeltas::at: the pixel exists");
  if (j > i) std::swap(i, j);
  const int column = i - half_;  // holds 2 column + 2 pixels, after column (column + 1) of those before
  return values_[static_cast<std::size_t>(column * (column + 1) + j - (resolution() - 1 - i))];
}

}  // namespace etendue
