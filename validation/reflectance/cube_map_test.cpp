// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/cube_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "etendue/core/rounding.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

Vec3 random_unit(CounterRandom& random) {
  const double z = random.between(-1, 1), turn = random.between(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

/// A smooth pattern of directions, with nothing special about the axes.
Eigen::Array3d pattern(const Vec3& direction) {
  const Vec3 d = direction.normalized();
  const double a = d.dot(Vec3(0.48, -0.6, 0.64)), b = d.dot(Vec3(0.8, 0.36, -0.48));
  return {1 + 0.5 * a * b + 0.2 * a, std::exp(b) / 3, 0.5 + 0.4 * std::sin(3 * a)};
}

template <class Function>
CubeImages images_of(int size, const Function& seen) {
  CubeImages images;
  images.size = size;
  for (const CubeFace face : kCubeFaces) {
    const CubeView view = cube_view(face);
    for (int row = 0; row < size; ++row) {
      for (int column = 0; column < size; ++column) {
        const double x = (2 * column + 1.0) / size - 1, y = 1 - (2 * row + 1.0) / size;
        images.pixels[static_cast<std::size_t>(face)].push_back(seen(view.gaze + x * view.right + y * view.up));
      }
    }
  }
  return images;
}

// CLAIM      IU.4.1.3: what six images show is what is there: exactly at the centres of their pixels, and everywhere, edges and corners
//            included, to the second order in a pixel's size.
// ORACLE     closed form: a smooth pattern of directions.
// TOLERANCE  8 u at centres. Observed orders from 16 to 128 pixels 2 within 0.15 over the sphere, beside the edges and beside the
//            corners: each is measured apart.
TEST(CubeMap, ShowsWhatIsThereToSecondOrder) {
  proves({"IU.4.1.3"}, Oracle::closed_form, "a smooth pattern of directions");
  uses_seed(41);
  constexpr double kRounding = 8 * kUnitRoundoff * 2;  // of colours up to 2
  double before[3] = {0, 0, 0};
  for (int size = 16; size <= 128; size *= 2) {
    const CubeMap map(images_of(size, pattern));
    for (int k = 0; k < 64; ++k) {
      const int i = k * size / 64, j = (k * 37 % 64) * size / 64;
      const CubeView view = cube_view(kCubeFaces[static_cast<std::size_t>(k % 6)]);
      const Vec3 centre = view.gaze + ((2 * i + 1.0) / size - 1) * view.right + ((2 * j + 1.0) / size - 1) * view.up;
      EXPECT_TRUE(within((map.at(7 * centre) - pattern(centre)).abs().maxCoeff(), kRounding * size));
    }
    CounterRandom random(41);
    double worst[3] = {0, 0, 0};
    for (int k = 0; k < 20000; ++k) {
      const Vec3 anywhere = random_unit(random);
      const double near = random.between(-1, 1) / size, along = random.between(-1, 1);
      const double near_too = random.between(-1, 1) / size;
      Vec3 edge(1, 1 + near, along), corner(1, 1 + near, 1 + near_too);
      for (int axis = 0; axis < 3; ++axis) {
        if (random.unit() < 0.5) edge[axis] = -edge[axis];
        if (random.unit() < 0.5) corner[axis] = -corner[axis];
      }
      if (k % 3 == 1) edge = {edge.z(), edge.x(), edge.y()};
      if (k % 3 == 2) edge = {edge.y(), edge.z(), edge.x()};
      worst[0] = std::max(worst[0], (map.at(anywhere) - pattern(anywhere)).abs().maxCoeff());
      worst[1] = std::max(worst[1], (map.at(edge) - pattern(edge)).abs().maxCoeff());
      worst[2] = std::max(worst[2], (map.at(corner) - pattern(corner)).abs().maxCoeff());
    }
    constexpr double kOrder = 0.15;
    for (int where = 0; where < 3 && size > 16; ++where) {
      EXPECT_TRUE(within(std::abs(std::log2(before[where] / worst[where]) - 2), kOrder)) << where << " " << size;
    }
    std::copy(worst, worst + 3, before);
  }
}

// CLAIM      IU.4.1.3: no seam shows where two of the images, or three, meet, whatever they hold: from both sides of an edge the pattern
//            goes to the same colours.
// ORACLE     identity: the limits from both sides, of random images of 1 to 9 pixels.
// TOLERANCE  kCubeEdgeError of the largest colour, 1, and what the distance of 2^-40 from the edge makes of slopes of up to 2 · 9 a unit.
TEST(CubeMap, HasNoSeamsBetweenItsImages) {
  proves({"IU.4.1.3"}, Oracle::identity, "limits from both sides of twelve edges");
  uses_seed(42);
  CounterRandom random(42);
  constexpr double kOff = 0x1p-40, kTolerance = kCubeEdgeError + 2 * kOff * 4 * 18;
  for (const int size : {1, 2, 3, 9}) {
    const CubeMap map(images_of(size, [&](const Vec3&) {
      const double r = random.unit(), g = random.unit();
      return Eigen::Array3d(r, g, random.unit());
    }));
    for (int a = 0; a < 3; ++a) {
      for (int signs = 0; signs < 4; ++signs) {
        Vec3 one = Vec3::Unit(a), other = Vec3::Unit((a + 1) % 3);
        if (signs & 1) one = -one;
        if (signs & 2) other = -other;
        for (double z = -1; z <= 1; z += 1.0 / 64) {
          const Vec3 along = z * Vec3::Unit((a + 2) % 3);
          const Eigen::Array3d here = map.at(one + (1 - kOff) * other + along),
                               there = map.at(other + (1 - kOff) * one + along);
          EXPECT_TRUE(within((here - there).abs().maxCoeff(), kTolerance)) << size << " " << z;
        }
      }
    }
  }
  EXPECT_TRUE(refuses([] { CubeMap(CubeImages{2, {}}); }));
}

// CLAIM      IU.4.1.3: the pattern is right for what is far: a mirror that is small beside the distance shows the same picture as if rays
//            went on from its own points; what it shows wrongly falls like its radius over the distance.
// ORACLE     closed form: the ray of a point P of a mirror ball of radius 1 meets a sphere of radius R around it at P + tD, in sight of the
//            middle under an angle of |P − (P·D)D|/R to D, up to terms of R^-2; its colour is that of the pattern there.
// TOLERANCE  the order, between distances of 8, 16, 32 and 64: 1 within 0.1 (the images' own error, 256 pixels, is 100 times smaller
//            than the least difference, as the first test has it). The angle: within 2/R².
TEST(CubeMap, TendsToTheTracedReflectionWithDistance) {
  proves({"IU.4.1.3"}, Oracle::closed_form, "rays that go on to a sphere far away");
  uses_seed(43);
  const CubeMap map(images_of(256, pattern));
  double before = 0;
  for (double far = 8; far <= 64; far *= 2) {
    CounterRandom random(43);
    double difference = 0;
    for (int k = 0; k < 4000; ++k) {
      const Vec3 p = random_unit(random), view = random_unit(random);
      if (view.dot(p) > -0.05) continue;  // seen from outside
      const Vec3 d = (view - 2 * view.dot(p) * p).normalized();
      const double b = p.dot(d), t = -b + std::sqrt(b * b + far * far - 1);
      const Vec3 met = p + t * d;
      difference = std::max(difference, (map.at(d) - pattern(met)).abs().maxCoeff());
      const double angle = std::atan2(met.cross(d).norm(), met.dot(d));
      EXPECT_TRUE(near(angle, (p - b * d).norm() / far, 2 / (far * far)));
    }
    constexpr double kOrder = 0.1;
    if (far > 8) {
      EXPECT_TRUE(within(std::abs(std::log2(before / difference) - 1), kOrder)) << far << " " << difference;
    }
    before = difference;
  }
}

}  // namespace
}  // namespace etendue::validation
