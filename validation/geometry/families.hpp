// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "etendue/geometry/vector.hpp"

// Random points, directions and frames for the tests of geometry. The same numbers from every standard library: only the
// generator itself is taken from <random>. A call that draws twice among its arguments draws in the compiler's order.
namespace etendue::validation {

class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}

  std::uint64_t bits() { return generator_(); }
  std::size_t index(std::size_t count) { return static_cast<std::size_t>(bits() % count); }

  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53; }

  /// Uniform in its logarithm.
  double scale(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }

  Vec3 in_cube(double half_edge) {
    const double x = uniform(-half_edge, half_edge), y = uniform(-half_edge, half_edge);
    return {x, y, uniform(-half_edge, half_edge)};
  }

  Vec3 unit_vector() {
    const double z = uniform(-1, 1), turn = uniform(0, 2 * std::numbers::pi);
    const double r = std::sqrt(1 - z * z);
    return Vec3(r * std::cos(turn), r * std::sin(turn), z).normalized();
  }

  /// A rotation, orthonormal to rounding.
  Mat3 rotation() {
    Mat3 frame;
    frame.col(0) = unit_vector();
    frame.col(1) = frame.col(0).cross(unit_vector()).normalized();
    frame.col(2) = frame.col(0).cross(frame.col(1)).normalized();
    return frame;
  }

  /// A multiple of 2^-`digits` in [−half_edge, half_edge]³: sums and products of few of them are exact in double.
  Vec3 dyadic(double half_edge, int digits) {
    const Vec3 v = in_cube(half_edge) * std::ldexp(1.0, digits);
    return Vec3(std::round(v.x()), std::round(v.y()), std::round(v.z())) * std::ldexp(1.0, -digits);
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace etendue::validation
