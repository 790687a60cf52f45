// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include "etendue/core/contract.hpp"
#include "etendue/geometry/vector.hpp"
#include "oracles/optics.hpp"

// Families of directions and normals for the tests of optics and reflectance. All stand in random frames.
namespace etendue::validation {

/// The numbers are the same on every platform: only the engine, which the standard fixes, and exact arithmetic.
class Directions {
 public:
  explicit Directions(std::uint64_t seed) : engine_(seed) {}

  double uniform(double from, double to) {
    return from + (to - from) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  int integer(int from, int to) {
    return from + static_cast<int>(engine_() % static_cast<std::uint64_t>(to - from + 1));
  }
  double sign() { return engine_() >> 63 != 0 ? 1 : -1; }

  Vec3 unit() {
    for (;;) {
      const double x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
      const Vec3 v(x, y, z);
      if (v.squaredNorm() > 0.01 && v.squaredNorm() < 1) return v.normalized();
    }
  }
  Vec3 orthogonal_to(const Vec3& axis) {
    for (;;) {
      const Vec3 v = axis.cross(unit());
      if (v.squaredNorm() > 0.01) return v.normalized();
    }
  }
  /// Direction that meets a surface with normal `s` under the angle whose sine and cosine are given.
  Vec3 incident(const Vec3& s, double sine, double cosine) {
    return (sine * orthogonal_to(s) - cosine * s).normalized();
  }

 private:
  std::mt19937_64 engine_;
};

inline oracle::Triple triple(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

/// 1 if `call` is let through, 0 if it is refused as a breach of contract: a mismatch to add up.
template <class Call>
unsigned accepted(Call call) {
  try {
    (void)call();
  } catch (const ContractViolation&) {
    return 0;
  }
  return 1;
}

/// How far rounding its components moves a unit vector, at most: half an ulp of a number below one is 2^-54, times √3.
inline constexpr double kInputRounding = 1.75 * 0x1p-54;

inline constexpr double kDegree = 0.017453292519943295;

}  // namespace etendue::validation
