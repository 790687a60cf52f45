// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/noise.hpp"

#include <array>
#include <cmath>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

/// Sebastiano Vigna's splitmix64: a bijection in which each bit of the result depends on all bits of x.
constexpr std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

constexpr int kDirections = 32;

std::array<Vec3, kDirections> directions() {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  std::array<Vec3, kDirections> all;
  std::size_t count = 0;
  for (int turn = 0; turn < 3; ++turn) {
    const auto add = [&](const Vec3& v) {
      Vec3 turned;
      for (int axis = 0; axis < 3; ++axis) turned[(axis + turn) % 3] = v[axis];
      all[count++] = turned.normalized();
    };
    for (const double a : {-1.0, 1.0}) {
      for (const double b : {-1.0, 1.0}) {
        add({0, a, b * golden});           // the icosahedron's
        add({0, a / golden, b * golden});  // the dodecahedron's beside the cube's corners
      }
    }
  }
  for (int corner = 0; corner < 8; ++corner) {
    all[count++] = Vec3((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1).normalized();
  }
  return all;
}

double blend(double t) {
  return t * t * t * (t * (6 * t - 15) + 10);
}

/// From here on doubles are whole numbers: all points belong to the lattice.
constexpr double kWhole = 0x1p52;

}  // namespace

std::uint64_t lattice_hash(std::uint64_t seed, std::int64_t i, std::int64_t j, std::int64_t k) {
  std::uint64_t hash = mixed(seed);
  for (const std::int64_t number : {i, j, k}) hash = mixed(hash ^ static_cast<std::uint64_t>(number));
  return hash;
}

double gradient_noise(const Vec3& p, std::uint64_t seed) {
  require(p.allFinite(), "gradient_noise: the point is finite");
  static const std::array<Vec3, kDirections> gradients = directions();
  if (!(p.cwiseAbs().maxCoeff() < kWhole)) return 0;
  const Vec3 low = p.array().floor();
  const Vec3 t = p - low;
  const Vec3 far(blend(t[0]), blend(t[1]), blend(t[2]));
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 step(corner & 1, (corner >> 1) & 1, corner >> 2);
    double weight = 1;
    for (int a = 0; a < 3; ++a) weight *= step[a] == 1 ? far[a] : 1 - far[a];
    const Vec3 at = low + step;
    const std::uint64_t hash = lattice_hash(seed, static_cast<std::int64_t>(at[0]), static_cast<std::int64_t>(at[1]),
                                            static_cast<std::int64_t>(at[2]));
    sum += weight * gradients[hash % kDirections].dot(t - step);
  }
  return sum;
}

double fractal_noise(const Vec3& p, int octaves, std::uint64_t seed) {
  require(octaves >= 1 && octaves <= kMostOctaves, "fractal_noise: a number of octaves in range");
  const Vec3 shift(5.0 / 17, 11.0 / 17, 7.0 / 17);  // no octave's lattice comes to lie on another's
  double sum = 0, share = 1;
  for (int k = 0; k < octaves; ++k, share /= 2) {
    const Vec3 place = p / share + k * shift;
    if (place.allFinite()) sum += share * gradient_noise(place, seed + static_cast<std::uint64_t>(k));
  }
  return sum;
}

}  // namespace etendue
