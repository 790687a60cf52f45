// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/hemicube.hpp"

#include <cmath>
#include <numbers>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

constexpr double kPi = std::numbers::pi;

/// Roundings of one corner term of T or S, relative to the sum of the absolute values of its parts. Counted for
/// y/√(1+y²) atan(x/√(1+y²)): the root 2, a quotient 3, atan of it 3 more (atan does not enlarge relative errors) and 2
/// of its own, the product 3 + 5 + 1 = 9, the sum of two 10, 1/2π and its product 12; the alternating sum of four
/// corners 2 more; and 2 for the evaluation of the bound itself.
constexpr int kCornerRoundings = 16;

/// T of the header; odd in x and in y.
double top_corner(double x, double y) {
  const double along_x = std::sqrt(1 + x * x);
  const double along_y = std::sqrt(1 + y * y);
  return (x / along_x * std::atan(y / along_x) + y / along_y * std::atan(x / along_y)) / (2 * kPi);
}

/// S of the header; odd in x.
double side_corner(double x, double z) {
  const double root = std::sqrt(1 + z * z);
  return -std::atan(x / root) / root / (2 * kPi);
}

template <class Corner>
Bounded over(const HemicubeRectangle& r, Corner corner) {
  const double far_far = corner(r.to_x, r.to_y);
  const double near_far = corner(r.from_x, r.to_y);
  const double far_near = corner(r.to_x, r.from_y);
  const double near_near = corner(r.from_x, r.from_y);
  const double size = std::abs(far_far) + std::abs(near_far) + std::abs(far_near) + std::abs(near_near);
  return {(far_far - near_far) - (far_near - near_near), gamma_bound(kCornerRoundings) * size};
}

bool finite(const HemicubeRectangle& r) {
  return std::isfinite(r.from_x) && std::isfinite(r.to_x) && std::isfinite(r.from_y) && std::isfinite(r.to_y);
}

/// How many pixels from the middle of a face pixel i lies: 0 for the two innermost.
int from_middle(int i, int half) {
  return i < half ? half - 1 - i : i - half;
}

std::size_t triangular(int i) {
  return static_cast<std::size_t>(i) * (static_cast<std::size_t>(i) + 1) / 2;
}

}  // namespace

double hemicube_top_delta(double x, double y, double area) {
  const double r2 = x * x + y * y + 1;
  return area / (kPi * (r2 * r2));
}

double hemicube_side_delta(double x, double z, double area) {
  require(z >= 0, "hemicube_side_delta: z is not below the patch's plane");
  const double r2 = x * x + z * z + 1;
  return z * area / (kPi * (r2 * r2));
}

Bounded hemicube_top_factor(const HemicubeRectangle& rectangle) {
  require(finite(rectangle), "hemicube_top_factor: the corners are finite");
  return over(rectangle, top_corner);
}

Bounded hemicube_side_factor(const HemicubeRectangle& rectangle) {
  require(finite(rectangle), "hemicube_side_factor: the corners are finite");
  require(rectangle.from_y >= 0 && rectangle.to_y >= 0, "hemicube_side_factor: heights are not negative");
  return over(rectangle, side_corner);
}

HemicubeDeltas::HemicubeDeltas(int resolution) : half_(resolution / 2) {
  constexpr int kFinest = 4096;  // 2^23 distinct factors, 64 MB: beyond that a hemicube is the wrong method
  require(resolution >= 2 && resolution <= kFinest && resolution % 2 == 0,
          "HemicubeDeltas: the resolution is even, from 2 to 4096");
  const double pixel = 1.0 / half_;
  for (int i = 0; i < half_; ++i) {
    for (int j = 0; j < half_; ++j) {
      const HemicubeRectangle square{i * pixel, (i + 1) * pixel, j * pixel, (j + 1) * pixel};
      if (j <= i) top_.push_back(hemicube_top_factor(square).value);
      side_.push_back(hemicube_side_factor(square).value);
    }
  }
}

double HemicubeDeltas::top(int i, int j) const {
  require(i >= 0 && i < resolution() && j >= 0 && j < resolution(), "HemicubeDeltas::top: the pixel exists");
  const int a = from_middle(i, half_);
  const int b = from_middle(j, half_);
  return a >= b ? top_[triangular(a) + static_cast<std::size_t>(b)] : top_[triangular(b) + static_cast<std::size_t>(a)];
}

double HemicubeDeltas::side(int i, int k) const {
  require(i >= 0 && i < resolution() && k >= 0 && k < half_, "HemicubeDeltas::side: the pixel exists");
  return side_[static_cast<std::size_t>(from_middle(i, half_)) * static_cast<std::size_t>(half_) +
               static_cast<std::size_t>(k)];
}

}  // namespace etendue
