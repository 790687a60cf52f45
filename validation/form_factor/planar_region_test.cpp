// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/planar_region.hpp"

#include <string>
#include <vector>

#include "etendue/form_factor/point_polygon.hpp"
#include "etendue/form_factor/polygon_polygon.hpp"
#include "form_factor/shapes.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

using Holes = std::vector<std::vector<Vec3>>;

std::vector<Vec3> reversed(const std::vector<Vec3>& loop) {
  return {loop.rbegin(), loop.rend()};
}

Polygon ceiling() {
  return tilted(rectangle({-1, -1, 1.25}, {0, 2, 0}, {2, 0, 0.5}));
}
Polygon outline() {
  return tilted(polygon({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {0.25, 0.5, 0}, {-1, 1, 0}}));
}
std::vector<Polygon> plugs() {
  return {tilted(polygon({{-0.5, -0.5, 0}, {-0.125, -0.5, 0}, {-0.25, 0.25, 0}})),
          tilted(rectangle({0.25, -0.75, 0}, {0.5, 0.25, 0}, {0, 0.5, 0}))};
}
PlanarRegion holed() {
  return PlanarRegion::make(outline(), {reversed(plugs()[0].vertices()), reversed(plugs()[1].vertices())}).value();
}

// CLAIM      IU.6-3: a region with holes and its plugs together are the outline, as receivers and as sources.
// ORACLE     identity: additivity of A_1 F_12 in either surface.
// TOLERANCE  the returned bounds, times the areas where they are summed, and the areas' rounding.
TEST(PlanarRegion, AddsUpWithItsPlugs) {
  proves({"IU.6-3"}, Oracle::identity, "F(outline) = F(holed) + Σ F(plugs), two holes, both ways");
  constexpr double kAreas = 0x1p-46;
  const Bounded whole = form_factor(ceiling(), outline());
  Bounded sum = form_factor(ceiling(), holed());
  const Bounded out = form_factor(outline(), ceiling());
  Bounded power = form_factor(holed(), ceiling());
  power = {holed().area() * power.value, holed().area() * power.bound};
  double area = holed().area();
  for (const Polygon& plug : plugs()) {
    const Bounded part = form_factor(ceiling(), plug), back = form_factor(plug, ceiling());
    sum = {sum.value + part.value, sum.bound + part.bound};
    power = {power.value + plug.area() * back.value, power.bound + plug.area() * back.bound};
    area += plug.area();
  }
  EXPECT_TRUE(near(area, outline().area(), kAreas));
  EXPECT_TRUE(near(sum.value, whole.value, sum.bound + whole.bound));
  EXPECT_TRUE(near(power.value, outline().area() * out.value, power.bound + outline().area() * out.bound + kAreas));
}

// CLAIM      IU.6-2: an element above a region with holes sees the outline less the plugs, cut by its horizon or not.
// ORACLE     identity: additivity.
// TOLERANCE  the returned bounds.
TEST(PlanarRegion, IsSeenLessItsHoles) {
  proves({"IU.6-2"}, Oracle::identity,
         "F(outline) = F(holed) + Σ F(plugs) from an element, horizon within and without");
  const Vec3 down = tilted(Vec3(0, 0, -1)) - tilted(Vec3(0, 0, 0));
  const Vec3 along = tilted(Vec3(1, 0.125, 0)) - tilted(Vec3(0, 0, 0));
  for (const Vec3& normal : {Vec3(down.normalized()), Vec3(along.normalized())}) {
    const Vec3 point = tilted(Vec3(-0.375, -0.25, 0.5));
    Bounded sum = point_to_region(point, normal, holed());
    for (const Polygon& plug : plugs()) {
      const Bounded part = point_to_polygon(point, normal, plug);
      sum = {sum.value + part.value, sum.bound + part.bound};
    }
    const Bounded whole = point_to_polygon(point, normal, outline());
    EXPECT_TRUE(near(sum.value, whole.value, sum.bound + whole.bound));
    EXPECT_TRUE(holds(whole.value > 0.01));
  }
}

// CLAIM      IU.6-3: holes that are none are refused, with the hole's number and what is wrong.
// ORACLE     exact: which hole is good is known by construction.
// TOLERANCE  none: decisions.
TEST(PlanarRegion, RefusesHolesThatAreNone) {
  proves({"IU.6-3"}, Oracle::exact, "holes that turn, leave, cross, touch, nest");
  const Polygon square = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const auto box = [](double x, double y, double size, double z = 0) {  // clockwise
    return std::vector<Vec3>{{x, y, z}, {x, y + size, z}, {x + size, y + size, z}, {x + size, y, z}};
  };
  const auto told = [&](const Holes& holes, const char* what) {
    const auto region = PlanarRegion::make(square, holes);
    return !region.ok() && region.error().message.find(what) != std::string::npos;
  };
  EXPECT_TRUE(holds(PlanarRegion::make(square, {box(0.1, 0.1, 0.2), box(0.5, 0.5, 0.3)}).ok()));
  EXPECT_TRUE(holds(told({reversed(box(0.1, 0.1, 0.2))}, "hole 0 runs counter-clockwise")));
  EXPECT_TRUE(holds(told({box(0.1, 0.1, 0.2, 0.01)}, "hole 0 leaves the outline's plane")));
  EXPECT_TRUE(holds(told({box(2, 2, 0.2)}, "hole 0 is not inside the outline")));
  EXPECT_TRUE(holds(told({box(0.9, 0.4, 0.2)}, "hole 0 is not inside the outline")));
  EXPECT_TRUE(holds(told({box(0.1, 0.1, 0.2), box(0.2, 0.2, 0.2)}, "hole 1 meets hole 0")));
  EXPECT_TRUE(holds(told({box(0.1, 0.1, 0.5), box(0.2, 0.2, 0.2)}, "hole 1 meets hole 0")));
  EXPECT_TRUE(holds(told({box(0.1, 0.1, 0.2), box(0.3, 0.1, 0.2)}, "hole 1 meets hole 0")));
  EXPECT_TRUE(holds(told({{{0.1, 0.1, 0}, {0.2, 0.1, 0}}}, "hole 0 is no polygon")));
  // A hole with all its corners inside a concave outline, across its notch.
  const Polygon notched = polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}});
  const auto across = PlanarRegion::make(notched, {{{0.5, 0.5, 0}, {0.5, 2, 0}, {3.5, 2, 0}, {3.5, 0.5, 0}}});
  EXPECT_TRUE(holds(!across.ok() && across.error().message.find("meets the outline") != std::string::npos));
}

}  // namespace
}  // namespace etendue::validation
