// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/predicates.hpp"

#include <string>

#include "geometry/exact.hpp"
#include "geometry/families.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

enum class Family { general, degenerate, nudged };  // nudged: degenerate, then one coordinate off by 2^-45

// An integer vector and two others that are exactly perpendicular to it: a frame askew to the axes, without rounding.
struct Frame {
  Vec3 normal, along, across;
};

Frame integer_frame(Random& random) {
  for (;;) {
    Frame frame;
    frame.normal = random.dyadic(9, 0);
    frame.along = frame.normal.cross(random.dyadic(9, 0));
    frame.across = frame.normal.cross(frame.along);
    if (!frame.across.isZero()) return frame;
  }
}

double nudge(Random& random) {
  return random.bits() % 2 ? 0x1p-45 : -0x1p-45;
}

struct Case {
  Vec3 point;
  Plane plane;
};

Case plane_case(Family family, Random& random) {
  if (family == Family::general) return {random.in_cube(10), {random.in_cube(10), random.unit_vector()}};
  const Frame frame = integer_frame(random);
  const double p = random.dyadic(1, 6).x(), q = random.dyadic(1, 6).x();
  Case result;
  result.plane = {random.dyadic(4, 8), frame.normal};
  result.point = result.plane.point + p * frame.along + q * frame.across;
  if (family == Family::nudged) result.point[static_cast<Eigen::Index>(random.index(3))] += nudge(random);
  return result;
}

// Holds decisions over each family; decide() judges one case of a family and says what the exact sign is. The
// degenerate family must consist of zeros only, the nudged one mostly of others.
struct Decision {
  int ours, exact;
};
template <class Decide>
void expect_exact(std::uint64_t seed, const Decide& decide) {
  Random random(seed);
  for (const Family family : {Family::general, Family::degenerate, Family::nudged}) {
    std::uint64_t mismatches = 0, zeros = 0;
    constexpr std::uint64_t kCases = 20'000;
    for (std::uint64_t i = 0; i < kCases; ++i) {
      const Decision decision = decide(family, random);
      mismatches += decision.ours != decision.exact;
      zeros += decision.exact == 0;
    }
    EXPECT_TRUE(all_agree(mismatches, kCases));
    if (family == Family::degenerate) {
      EXPECT_EQ(zeros, kCases);
    }
    if (family == Family::nudged) {
      EXPECT_LT(zeros, kCases / 2);
    }
  }
}

// CLAIM      IU.5-12: side() is exact for random planes, points on the plane, and points 2^-45 off it, in skew frames.
// ORACLE     exact: CGAL's rational kernel; the degenerate family is asserted to lie on the plane.
// TOLERANCE  none: no decision may differ.
TEST(Predicates, SideOfAPlaneIsExact) {
  proves({"IU.5-12"}, Oracle::exact, "CGAL Plane_3::oriented_side over rationals");
  expect_exact(301, [](Family family, Random& random) -> Decision {
    const Case c = plane_case(family, random);
    return {side(c.point, c.plane), oracle::side_of_plane(exact(c.point), exact(c.plane.point), exact(c.plane.normal))};
  });
}

// CLAIM      IU.5.6.2: orientation() is exact for random, collinear and almost collinear points.
// ORACLE     exact: CGAL's rational kernel; the degenerate family is asserted to be collinear.
// TOLERANCE  none.
TEST(Predicates, OrientationIsExact) {
  proves({"IU.5.6.2"}, Oracle::exact, "CGAL orientation over rationals");
  expect_exact(302, [](Family family, Random& random) -> Decision {
    Vec2 a = random.in_cube(10).head<2>(), b = random.in_cube(10).head<2>(), c = random.in_cube(10).head<2>();
    if (family != Family::general) {
      const Vec2 step = random.dyadic(9, 3).head<2>();
      a = random.dyadic(9, 3).head<2>();
      b = a + std::round(random.uniform(-99, 99)) * step;
      c = a + std::round(random.uniform(-99, 99)) * step;
    }
    if (family == Family::nudged) c.x() += nudge(random);
    return {orientation(a, b, c), oracle::turn(exact(a), exact(b), exact(c))};
  });
}

}  // namespace
}  // namespace etendue::validation
