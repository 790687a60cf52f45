// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/curved_exchange.hpp"

#include <cmath>
#include <numbers>

#include "etendue/assembly/ray_exchange.hpp"
#include "etendue/assembly/row_closure.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/curved_factor.hpp"
#include "meshing/small_scenes.hpp"
#include "oracles/catalogue_truth.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr double kPi = std::numbers::pi;

ExchangeMatrix filled(const SurfaceModel& model, const ExchangeMethod& method, const Tolerance& tolerance) {
  ExchangeMatrix matrix(areas_of(model));
  EXPECT_TRUE(fill_exchanges(matrix, method, tolerance, {}));
  return composed(model, matrix);
}

ExchangeMatrix exact(const SurfaceModel& model, const Tolerance& tolerance) {
  return filled(model, CurvedExchange(model, {tolerance, tolerance}), tolerance);
}

/// A ball that lies on the floor, a drum with a lid, a crate, a tray with an upper and a lower side.
Scene furnished(double scale) {
  Scene scene = room_of({0, 0, 0}, {scale, scale, scale});
  const auto add = [&scene](const char* name, const Shape& shape) { scene.objects.push_back({name, shape, 0, {}}); };
  const auto at = [scale](double x, double y, double z) -> Vec3 { return scale * Vec3(x, y, z); };
  add("drum", Cylinder{at(0.3125, 0.3125, 0), at(0.3125, 0.3125, 0.5), 0.15625 * scale});
  add("lid", Disc{at(0.3125, 0.3125, 0.5), Vec3::UnitZ(), 0.15625 * scale});
  add("ball", Sphere{at(0.75, 0.625, 0.1875), 0.1875 * scale});
  Box crate;
  crate.centre = at(0.6875, 0.1875, 0.125);
  crate.half_edges = at(0.09375, 0.09375, 0.125);
  add("crate", crate);
  const Vec3 down = Vec3(0.3, -0.2, -1).normalized();
  add("tray", Disc{at(0.5, 0.8, 0.6), down, 0.125 * scale});
  add("tray's back", Disc{at(0.5, 0.8, 0.6), -down, 0.125 * scale});
  return scene;
}

// CLAIM      IU.6-3, IU.6-6: a sphere in the middle of a cube sends a sixth of its power to each wall, and every row closes,
//            the walls seeing one another past the sphere.
// ORACLE     identity: the cube's symmetry, and conservation of energy.
// TOLERANCE  the returned bounds.
TEST(CurvedExchange, ClosesACubeAroundASphere) {
  proves({"IU.6-3", "IU.6-4", "IU.6-6"}, Oracle::identity, "one sixth by symmetry, rows that sum to one");
  Scene scene = room_of({-1, -1, -1}, {1, 1, 1});
  scene.objects.push_back({"ball", Sphere{{0, 0, 0}, 0.6}, 0, {}});
  const Tolerance asked{1e-5, 1e-6};
  const ExchangeMatrix matrix = exact(*surface_model(scene), asked);
  ASSERT_EQ(matrix.size(), 7u);
  EXPECT_EQ(matrix.report().beyond, 0u);
  for (std::size_t wall = 0; wall < 6; ++wall) {
    const Bounded there = matrix.factor(6, wall);
    EXPECT_TRUE(near(there.value, 1.0 / 6, there.bound));
    EXPECT_LE(there.bound, asked.relative * 0.17);
  }
  EXPECT_EQ(matrix.exchange(6, 6), 0);
  const RowClosure closure = row_closure(matrix);
  for (std::size_t row = 0; row < 7; ++row) EXPECT_TRUE(near(closure.sums[row], 1, closure.bounds[row]));
}

// CLAIM      IU.6-3: configurations with a closed form come out within their bounds, from either side.
// ORACLE     closed form: kernels over the visible parts by double-exponential rules, 64-bit significand.
// TOLERANCE  the returned bound, and 1e-12 for the oracle's quadrature, of factors of order one.
TEST(CurvedExchange, MeetsTheCatalogue) {
  proves({"IU.6-3", "IU.6.2"}, Oracle::closed_form, "discs, spheres, a cylinder on a disc: double-exponential rules");
  const Vec3 up = Vec3::UnitZ();
  struct Case {
    CurvedPatch from, to;
    double truth;
  };
  const auto round = oracle::truths_of_discs_and_cylinders(), balls = oracle::truths_of_spheres_and_cones();
  const auto value = [](const oracle::Truths& truths, const char* id, std::vector<double> p) {
    return static_cast<double>(truths.at(id)(p.data()));
  };
  const std::vector<Case> cases{
      {Disc{{1, 2, 0}, up, 1}, Disc{{1, 2, 2}, -up, 1.5}, value(round, "C-41", {1, 1.5, 2})},
      {Sphere{{0, 0, 0}, 1}, Disc{{0, 0, 2}, -up, 3}, value(balls, "sphere-disc", {1, 3, 2})},
      {Sphere{{0, 0, 0}, 1}, Sphere{{0, 0, 3}, 1.5}, value(balls, "sphere-sphere", {1, 1.5, 0.5})},
      {Cylinder{{0, 0, 0}, {0, 0, 2}, 1}, Disc{{0, 0, 0}, up, 3}, value(round, "C-77", {1, 3, 2})},
  };
  const CurvedGoal goal{1e-6, 0, 400'000};
  for (const Case& one : cases) {
    const double area = std::holds_alternative<Disc>(one.from)     ? kPi
                        : std::holds_alternative<Sphere>(one.from) ? 4 * kPi
                                                                   : 4 * kPi;
    const CurvedExchangeArea there = curved_exchange(one.from, one.to, {}, goal);
    const CurvedExchangeArea back = curved_exchange(one.to, one.from, {}, {1e-5, 0, 400'000});
    EXPECT_TRUE(there.reached && back.reached);
    EXPECT_TRUE(near(there.value / area, one.truth, there.bound / area + 1e-12));
    EXPECT_TRUE(near(back.value / area, one.truth, back.bound / area + 1e-12));
  }
}

// CLAIM      IU.6-4, IU.6-6: in a room with a ball, a drum, a crate and a tray all rows close, but for the floor, by what
//            stands on it; and every factor agrees with counted rays.
// ORACLE     identity: conservation of energy; statistics: rays that need no outline, each bound fails with 10⁻⁶.
// TOLERANCE  the returned bounds; the rays' bounds in addition.
TEST(CurvedExchange, ClosesAFurnishedRoomAndAgreesWithRays) {
  constexpr std::uint64_t kSeed = 5;
  proves({"IU.6-4", "IU.6-6"}, Oracle::identity, "closure of a room with round and flat things in it");
  const Scene scene = furnished(1);
  const SurfaceModel model = *surface_model(scene);
  EXPECT_TRUE(model.notes.empty()) << model.notes.front();
  const ExchangeMatrix matrix = exact(model, {2e-3, 2e-4});
  EXPECT_EQ(matrix.report().beyond, 0u);
  const RowClosure closure = row_closure(matrix);
  const double covered = kPi * 0.15625 * 0.15625 + 0.1875 * 0.1875;
  for (std::size_t row = 0; row < matrix.size(); ++row) {
    const bool under_crate = model.rows[row].name == "crate[5]";  // its bottom lies on the floor
    const double expected = under_crate ? 0 : row == 0 ? 1 - covered : 1;
    EXPECT_TRUE(near(closure.sums[row], expected, closure.bounds[row])) << model.rows[row].name;
  }
  proves({"IU.6-4"}, Oracle::statistics, "counted rays, one bound in a million fails");
  uses_seed(kSeed);
  const ExchangeMatrix rays = filled(model, RayExchange(model.mesh, {20000, kSeed}, {}, model.rounds), {1, 1});
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    for (std::size_t j = i + 1; j < matrix.size(); ++j) {
      EXPECT_TRUE(
          near(matrix.exchange(i, j), rays.exchange(i, j), matrix.exchange_bound(i, j) + rays.exchange_bound(i, j)))
          << model.rows[i].name << " to " << model.rows[j].name;
    }
  }
}

// CLAIM      Scaling a scene by a power of two changes no bit of a factor.
// ORACLE     metamorphic: the same scene, a million times smaller.
// TOLERANCE  none.
TEST(CurvedExchange, KnowsNoUnitOfLength) {
  proves({"IU.6-3"}, Oracle::metamorphic, "a furnished room and its picture scaled by 2^-20");
  const SurfaceModel large = *surface_model(furnished(1)), small = *surface_model(furnished(0x1p-20));
  const ExchangeMatrix first = exact(large, {1e-1, 1e-2}), second = exact(small, {1e-1, 1e-2});
  std::uint64_t differ = 0, pairs = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    for (std::size_t j = i + 1; j < first.size(); ++j, ++pairs) {
      differ += first.factor(i, j).value != second.factor(i, j).value;
    }
  }
  EXPECT_TRUE(all_agree(differ, pairs));
}

// CLAIM      Round objects that pierce others and infinite planes are refused, with place and names; touching ones are not;
//            open cylinders are told of.
// ORACLE     exact: scenes with one defect each.
// TOLERANCE  none.
TEST(CurvedExchange, RefusesWhatPierces) {
  proves({}, Oracle::exact, "scenes with one defect each");
  const auto with = [](const std::vector<Shape>& shapes) {
    Scene scene = room_of({0, 0, 0}, {1, 1, 1});
    for (const Shape& shape : shapes) scene.objects.push_back({"extra", shape, 0, {}});
    return surface_model(scene);
  };
  const Vec3 up = Vec3::UnitZ();
  const auto refused = [](const Result<SurfaceModel>& model, const char* words) {
    return !model.ok() && model.error().message.find(words) != std::string::npos;
  };
  EXPECT_TRUE(holds(refused(with({Sphere{{0.5, 0.5, 0.2}, 0.25}}), "'extra' pierces or lies in object 'object 0'")));
  EXPECT_TRUE(
      holds(refused(with({Sphere{{0.5, 0.5, 0.5}, 0.2}, Sphere{{0.5, 0.5, 0.6}, 0.05}}), "pierces or lies in")));
  EXPECT_TRUE(holds(refused(with({Disc{{0.5, 0.5, 0.1}, Vec3(1, 0, 0.2).normalized(), 0.2}}), "pierces")));
  EXPECT_TRUE(holds(refused(with({Plane{{0, 0, 0}, up}}), "is an infinite plane")));
  EXPECT_TRUE(holds(with({Sphere{{0.5, 0.5, 0.25}, 0.25}, Disc{{0.5, 0.5, 0.5}, up, 0.25}}).ok()));
  const auto column = with({Cylinder{{0.5, 0.5, 0}, {0.5, 0.5, 0.5}, 0.25}});
  ASSERT_TRUE(column.ok());
  ASSERT_EQ(column->notes.size(), 1u);
  EXPECT_TRUE(holds(column->notes[0].find("has an open end") != std::string::npos)) << column->notes[0];
}

}  // namespace
}  // namespace etendue::validation
