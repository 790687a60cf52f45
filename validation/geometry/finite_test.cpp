// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include "etendue/geometry/box.hpp"
#include "etendue/geometry/cylinder.hpp"
#include "etendue/geometry/disc.hpp"
#include "etendue/geometry/plane.hpp"
#include "etendue/geometry/polygon.hpp"
#include "etendue/geometry/sphere.hpp"
#include "etendue/geometry/triangle.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

// CLAIM      No intersection answers where the ray or the shape holds NaN or infinity: the contract is broken, and said.
// ORACLE     identity: the documented refusal.
// TOLERANCE  none: each outcome is a yes or a no.
TEST(Intersections, RefuseWhatIsNotFinite) {
  const Ray sound{{0, 0, -3}, {0, 0, 1}};
  const Triangle triangle{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  const Polygon polygon = Polygon::make({triangle.a, triangle.b, triangle.c}).value();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (int part = 0; part < 2; ++part) {
      Ray ray = sound;
      (part ? ray.direction : ray.origin).x() = bad;
      EXPECT_THROW((void)intersect(ray, Sphere{{0, 0, 0}, 1}), ContractViolation);
      EXPECT_THROW((void)intersect(ray, Plane{{0, 0, 0}, {0, 0, 1}}), ContractViolation);
      EXPECT_THROW((void)intersect(ray, Disc{{0, 0, 0}, {0, 0, 1}, 1}), ContractViolation);
      EXPECT_THROW((void)intersect(ray, Cylinder{{0, 0, 0}, {1, 0, 0}, 1}), ContractViolation);
      EXPECT_THROW((void)intersect(ray, Box{{0, 0, 0}, Mat3::Identity(), {1, 1, 1}}), ContractViolation);
      EXPECT_THROW((void)intersect(ray, triangle), ContractViolation);
      EXPECT_THROW((void)intersect(ray, polygon), ContractViolation);
    }
    EXPECT_THROW((void)intersect(sound, Sphere{{bad, 0, 0}, 1}), ContractViolation);
    EXPECT_THROW((void)intersect(sound, Sphere{{0, 0, 0}, bad}), ContractViolation);
    EXPECT_THROW((void)intersect(sound, Plane{{bad, 0, 0}, {0, 0, 1}}), ContractViolation);
    EXPECT_THROW((void)intersect(sound, Disc{{bad, 0, 0}, {0, 0, 1}, 1}), ContractViolation);
    EXPECT_THROW((void)intersect(sound, Disc{{0, 0, 0}, {0, 0, 1}, bad}), ContractViolation);
    EXPECT_THROW((void)intersect(sound, Cylinder{{0, 0, 0}, {bad, 0, 0}, 1}), ContractViolation);
    EXPECT_THROW((void)intersect(sound, Box{{bad, 0, 0}, Mat3::Identity(), {1, 1, 1}}), ContractViolation);
    EXPECT_THROW((void)intersect(sound, Triangle{{bad, 0, 0}, triangle.b, triangle.c}), ContractViolation);
  }
}

}  // namespace
}  // namespace etendue::validation
