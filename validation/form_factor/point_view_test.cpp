// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/point_view.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/blocker.hpp"
#include "etendue/form_factor/obstructed.hpp"
#include "form_factor/shapes.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

/// Of a square of half side a at the height h over an element that looks at its middle: four times the corner formula G11.
double square_overhead(double a, double h) {
  const double s = a / std::hypot(a, h);
  return 4 * s * std::atan(s) / std::numbers::pi;
}

const std::vector<Vec3> kSquare{{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}};

// CLAIM      IU.6-4, G11: a square over an element keeps what is around the shadow of a smaller one between them; where shadows overlap,
//            that counts once, and an outline that only touches a shadow hides nothing.
// ORACLE     closed form: the corner formula of the square less that of the shadow.
// TOLERANCE  the returned bound, below 1e-13, and 8 u for the closed form.
TEST(PointView, LeavesAFrameAroundAShadow) {
  proves({"IU.6-4", "G11"}, Oracle::closed_form, "concentric squares: corner formula");
  const auto plate = [](double half, double height) {
    return Blocker::plate(rectangle({-half, -half, height}, {2 * half, 0, 0}, {0, 2 * half, 0}));
  };
  const Blocker small = plate(0.25, 1), same_shadow = plate(0.375, 1.5), beside = plate(0.5, 1.5);
  const std::array<const Blocker*, 3> blockers{&small, &same_shadow, &beside};
  PointView view(Vec3::Zero(), Vec3::UnitZ(), blockers);
  const double whole = square_overhead(1, 2);
  const auto check = [&](const std::vector<std::size_t>& hiding, double expected) {
    const Bounded found = view.factor(kSquare, hiding);
    EXPECT_TRUE(near(found.value, expected, found.bound + 8 * kUnitRoundoff));
    EXPECT_TRUE(within(found.bound, 1e-13));
  };
  check({}, whole);
  check({0}, whole - square_overhead(0.5, 2));
  check({1}, whole - square_overhead(0.5, 2));
  check({0, 1}, whole - square_overhead(0.5, 2));
  check({0, 2}, whole - square_overhead(2.0 / 3, 2));
  check({2, 1, 0}, whole - square_overhead(2.0 / 3, 2));
}

// CLAIM      IU.6-4: a view serves one polygon after the other as if made for it alone, plates and solids in the way, any normal.
// ORACLE     metamorphic: visible_point_to_polygon, which keeps another part (what is hidden) and another frame.
// TOLERANCE  the sum of both bounds.
TEST(PointView, AgreesWithTheViewOfOnePolygon) {
  proves({"IU.6-4"}, Oracle::metamorphic, "visible_point_to_polygon, 400 elements");
  constexpr std::uint64_t kSeed = 20261201;
  uses_seed(kSeed);
  CounterRandom random(kSeed);
  const auto place = [&](double half) {
    const double x = random.between(-half, half), y = random.between(-half, half), z = random.between(-half, half);
    return Vec3(x, y, z);
  };
  const std::vector<Polygon> faces = block({{{-0.3, -0.2, 1.2},
                                             {0.1, -0.3, 1.1},
                                             {-0.2, 0.2, 1.3},
                                             {0.2, 0.1, 1.2},
                                             {-0.3, -0.2, 1.5},
                                             {0.1, -0.3, 1.4},
                                             {-0.2, 0.2, 1.6},
                                             {0.2, 0.1, 1.5}}});
  const auto solid = Blocker::solid(faces);
  ASSERT_TRUE(solid);
  double worst = 0;
  int partly = 0, inexact = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3 a = place(0.4), b = place(0.4);
    const Blocker triangle = Blocker::plate(
        polygon({Vec3(-0.6, -0.4, 1) + 0.2 * a, Vec3(0.5, -0.3, 0.9) + 0.3 * b, Vec3(0.1, 0.6, 1.1) + 0.2 * a}));
    const std::array<const Blocker*, 2> blockers{&triangle, &*solid};
    const Vec3 point = 0.3 * place(1), normal = (Vec3::UnitZ() + place(0.7)).normalized();
    inexact += normal.squaredNorm() != 1;
    PointView view(point, normal, blockers);
    for (const double shift : {0.0, 0.8, 0.0}) {
      std::vector<Vec3> corners = kSquare;
      for (Vec3& v : corners) v.x() += shift;
      const Bounded found = view.factor(corners, std::array<std::size_t, 2>{0, 1});
      const Polygon seen = polygon(corners);
      const Bounded other = visible_point_to_polygon(point, normal, seen, blockers);
      worst = std::max(worst, std::abs(found.value - other.value) - found.bound - other.bound);
      const double free = view.factor(corners, {}).value;
      partly += found.value > 0.02 && found.value < free - 0.02;
    }
  }
  EXPECT_TRUE(within(std::max(worst, 0.0), 0));
  EXPECT_GT(partly, 600);
  EXPECT_GT(inexact, 100);
  EXPECT_TRUE(refuses([] { return PointView(Vec3::Zero(), Vec3(0, 0, 1 + 1e-14), {}); }));
  EXPECT_TRUE(refuses([] { return PointView(Vec3(0, NAN, 0), Vec3::UnitZ(), {}); }));
}

}  // namespace
}  // namespace etendue::validation
