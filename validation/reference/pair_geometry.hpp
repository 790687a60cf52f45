// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "support/counter_random.hpp"

// What the families of pairs are drawn with: counter-based numbers, points, turned planes, stars. + − · / and square
// roots alone: the same bits with every compiler.
namespace etendue::validation::pairs {

using Point = std::array<double, 3>;
using Loops = std::vector<std::vector<Point>>;

inline constexpr std::uint64_t kSeed = 20240811;

/// Numbers from a counter that the pair's number sets.
class Random {
 public:
  Random(std::size_t family, std::size_t index) : bits_(kSeed + (family << 40) + (index << 16)) { bits_.next(); }
  double between(double low, double high) { return bits_.between(low, high); }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(bits_.next() >> 33) % n; }

 private:
  CounterRandom bits_;
};

/// On a dyadic grid, so that the integer frames below keep it exact.
inline double dyadic(double x, double quantum = 0x1p-12) {
  return std::round(x / quantum) * quantum;
}

inline double power_of_ten(double exponent, Random& random) {  // 10^-e for a whole e, times a number in [1, 2)
  double value = random.between(1, 2);
  for (int i = 0; i < static_cast<int>(exponent); ++i) value /= 10;
  return value;
}

inline Point combine(const Point& o, double x, const Point& u, double y, const Point& v) {
  return {o[0] + x * u[0] + y * v[0], o[1] + x * u[1] + y * v[1], o[2] + x * u[2] + y * v[2]};
}

inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

using Flat = std::vector<std::array<double, 2>>;

/// Star-shaped around (0, 0), counter-clockwise, inside [−1, 1]²: by the boundary of the square, pulled in by chance.
inline Flat star(Random& random, std::size_t n, double least = 0.4) {
  Flat flat;
  for (std::size_t k = 0; k < n; ++k) {
    const double u = 4 * (static_cast<double>(k) + random.between(0.3, 0.7)) / static_cast<double>(n);
    const int side = static_cast<int>(u);
    const double t = 2 * (u - side) - 1, r = random.between(least, 1);
    const double x[] = {1, -t, -1, t}, y[] = {t, 1, -t, -1};
    flat.push_back({dyadic(r * x[side]), dyadic(r * y[side])});
  }
  return flat;
}

/// A plane's two directions, about of length one and about at right angles, on the grid.
struct Axes {
  Point u, v;
};

inline std::array<Point, 3> rotation(double w, double x, double y, double z) {  // |q|² times a rotation
  return {Point{w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)},
          Point{2 * (x * y - w * z), w * w - x * x + y * y - z * z, 2 * (y * z + w * x)},
          Point{2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z}};
}

inline std::array<Point, 3> random_rotation(Random& random) {
  double q[4], square = 0;
  do {
    square = 0;
    for (double& c : q) {
      c = random.between(-1, 1);
      square += c * c;
    }
  } while (square > 1 || square < 0.1);
  const double scale = 1 / std::sqrt(square);
  return rotation(scale * q[0], scale * q[1], scale * q[2], scale * q[3]);
}

inline Axes random_axes(Random& random) {
  auto r = random_rotation(random);
  for (Point& axis : r) {
    for (double& c : axis) c = dyadic(c, 0x1p-10);
  }
  return {r[0], r[1]};
}

inline std::vector<Point> placed(const Flat& flat, const Point& origin, const Axes& axes, double scale = 1) {
  std::vector<Point> loop;
  for (const auto& p : flat) loop.push_back(combine(origin, scale * p[0], axes.u, scale * p[1], axes.v));
  return loop;
}

inline constexpr Point kOrigin{0, 0, 0};
inline constexpr Axes kFloor{{1, 0, 0}, {0, 1, 0}};

/// Turned so that its front looks towards `target`.
inline Axes facing(Axes axes, const Point& at, const Point& target) {
  const Point away{at[0] - target[0], at[1] - target[1], at[2] - target[2]};
  if (dot(cross(axes.u, axes.v), away) > 0) std::swap(axes.u, axes.v);
  return axes;
}

inline Point above(Random& random, double low, double high) {
  return {dyadic(random.between(-1, 1)), dyadic(random.between(-1, 1)), dyadic(random.between(low, high))};
}

}  // namespace etendue::validation::pairs
