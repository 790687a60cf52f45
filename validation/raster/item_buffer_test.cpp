// SPDX-License-Identifier: Apache-2.0
#include "etendue/raster/item_buffer.hpp"

#include <array>
#include <cmath>
#include <random>

#include "etendue/acceleration/accelerator.hpp"
#include "etendue/geometry/polygon.hpp"
#include "meshing/small_scenes.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr std::uint64_t kSeed = 77;

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  /// In [−1, 1).
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-52 - 1; }
  Vec3 vector() {
    const double x = unit(), y = unit();
    return {x, y, unit()};
  }

 private:
  std::mt19937_64 random_;
};

/// Triangles all about the eye, some through its planes, some behind it.
Scene triangles_about(const Vec3& eye, int count, Draw& draw) {
  std::vector<Shape> shapes;
  for (int k = 0; k < count; ++k) {
    const Vec3 middle = eye + 3 * draw.vector();
    const Vec3 a = middle + draw.vector(), b = middle + draw.vector();
    shapes.emplace_back(polygon({a, b, middle + draw.vector()}));
  }
  return scene_of(shapes);
}

PixelView turned_view(const Vec3& eye, int side, ViewOutline window, Draw& draw) {
  const Eigen::AngleAxisd turn(3 * draw.unit(), draw.vector().normalized());
  return {eye,   turn * Vec3::UnitX(), turn * Vec3::UnitY(), turn * Vec3::UnitZ(), side, side, -2, -2, 3.0 / side,
          window};
}

ItemBuffer drawn(const Scene& scene, const PixelView& view) {
  ItemBuffer buffer(view);
  for (std::size_t k = 0; k < scene.objects.size(); ++k) {
    const auto& shape = std::get<Polygon>(scene.objects[k].shape);
    buffer.draw(shape.vertices(), shape.normal(), static_cast<std::int32_t>(k));
  }
  return buffer;
}

std::int32_t met(const Accelerator& accelerator, const Vec3& eye, const Vec3& direction, double* distance) {
  Ray ray;
  ray.origin = eye;
  ray.direction = direction;
  const auto hit = accelerator.nearest(ray).hit;
  if (hit && distance != nullptr) *distance = hit->hit.t;
  return hit ? static_cast<std::int32_t>(hit->object) : kNoItem;
}

// CLAIM      IU.6.4: every pixel of the item buffer holds what a ray through its sample meets first, and its depth.
// ORACLE     ray casting (exact predicates, bounding volumes): shares no arithmetic with the buffer.
// TOLERANCE  none for the item, on rays that meet the same item when turned by 1e-9 to four sides (others pass an edge;
//            the buffer rounds by less than 1e-12 here; at most one in a thousand is set aside); depth: 1e-9.
TEST(ItemBuffer, HoldsWhatARayMeetsFirst) {
  proves({"IU.6.4"}, Oracle::program, "a ray for every pixel");
  uses_seed(kSeed);
  Draw draw(kSeed);
  constexpr int kSide = 60;
  constexpr double kAside = 1e-9, kDepth = 1e-9;
  std::uint64_t wrong = 0, decided = 0, aside = 0, nothing = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const Vec3 eye = (trial % 3 == 2 ? 100.0 : 1.0) * draw.vector();
    const Scene scene = triangles_about(eye, 40, draw);
    const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
    const ViewOutline window = trial % 2 == 0 ? ViewOutline::rectangle : ViewOutline::upper_triangle;
    const PixelView view = turned_view(eye, kSide, window, draw);
    const ItemBuffer buffer = drawn(scene, view);
    for (int row = 0; row < kSide; ++row) {
      for (int column = 0; column < kSide; ++column) {
        if (!view.has(column, row)) continue;
        const Vec3 direction = view.direction(column, row);
        double distance = 0;
        const std::int32_t item = met(*accelerator, eye, direction, &distance);
        bool edge = false;
        for (const Vec3& side : {view.across, Vec3(-view.across), view.up, Vec3(-view.up)}) {
          edge = edge || met(*accelerator, eye, direction + kAside * side, nullptr) != item;
        }
        if (edge) {
          ++aside;
          continue;
        }
        ++decided;
        nothing += item == kNoItem;
        wrong += buffer.item(column, row) != item;
        const double depth = item == kNoItem ? 0 : 1 / distance;
        EXPECT_TRUE(near(buffer.inverse_depth(column, row), depth, kDepth * depth));
      }
    }
  }
  EXPECT_TRUE(all_agree(wrong, decided));
  EXPECT_LT(aside, decided / 1000);
  EXPECT_GT(nothing, 100u);
}

// CLAIM      IU.6.4: no ray slips through a wall that is put together from parts, nor where one part's edge ends on another's.
// ORACLE     identity: a wall of three parts with two T-junctions, behind it another; seen from 200 points.
// TOLERANCE  none: the farther wall is never seen through the nearer one's interior.
TEST(ItemBuffer, LetsNoRayThroughBetweenParts) {
  proves({"IU.6.4"}, Oracle::identity, "a wall is a wall, however it is cut");
  uses_seed(kSeed);
  Draw draw(kSeed);
  std::uint64_t through = 0, pixels = 0;
  constexpr int kSide = 50;
  for (int trial = 0; trial < 200; ++trial) {
    // Corners at thirds of turned vectors: where three parts meet, rounding bends the edges.
    const Eigen::AngleAxisd turn(trial % 4 == 0 ? 0 : draw.unit(), draw.vector().normalized());
    const auto at = [&](double x, double y, double z) { return Vec3(turn * Vec3(x, y, z)); };
    const double cut = trial % 2 == 0 ? 0.3 : 1.0 / 3;
    const std::array<Polygon, 4> walls{polygon({at(-9, -9, 1), at(9, -9, 1), at(9, cut, 1), at(-9, cut, 1)}),
                                       polygon({at(-9, cut, 1), at(-cut, cut, 1), at(-cut, 9, 1), at(-9, 9, 1)}),
                                       polygon({at(-cut, cut, 1), at(9, cut, 1), at(9, 9, 1), at(-cut, 9, 1)}),
                                       polygon({at(-40, -40, 3), at(40, -40, 3), at(40, 40, 3), at(-40, 40, 3)})};
    ItemBuffer buffer({Vec3::Zero(), turn * Vec3::UnitX(), turn * Vec3::UnitY(), turn * Vec3::UnitZ(), kSide, kSide, -1,
                       -1, 2.0 / kSide, ViewOutline::rectangle});
    for (std::size_t k = walls.size(); k-- > 0;) {
      buffer.draw(walls[k].vertices(), walls[k].normal(), static_cast<std::int32_t>(k));
    }
    for (int row = 0; row < kSide; ++row) {
      for (int column = 0; column < kSide; ++column, ++pixels) through += buffer.item(column, row) == 3;
    }
  }
  EXPECT_TRUE(all_agree(through, pixels));
}

// CLAIM      IU.6.4: of a plate's front and back at one depth the front is seen, from either side, in either order; what is
//            seen edge-on is not seen.
// ORACLE     exact: two opposite polygons on the same corners.
// TOLERANCE  none.
TEST(ItemBuffer, ShowsTheFrontOfWhatHasNoThickness) {
  proves({"IU.6.4"}, Oracle::exact, "two opposite polygons on the same corners");
  uses_seed(kSeed);
  const Polygon up = polygon({{-1, -1, 0.3}, {1, -1, 0.3}, {1, 1, 0.7}, {-1, 1, 0.7}});
  const Polygon down = polygon({up.vertices()[3], up.vertices()[2], up.vertices()[1], up.vertices()[0]});
  std::uint64_t wrong = 0, pixels = 0;
  for (const double side : {1.0, -1.0}) {
    for (const bool first : {false, true}) {
      ItemBuffer buffer({{0, 0, 0.5 - 3 * side},
                         side * Vec3::UnitX(),
                         Vec3::UnitY(),
                         side * Vec3::UnitZ(),
                         20,
                         20,
                         -0.2,
                         -0.2,
                         0.02,
                         ViewOutline::rectangle});
      const auto put = [&](const Polygon& p, std::int32_t item) { buffer.draw(p.vertices(), p.normal(), item); };
      if (first) put(up, 0);
      put(down, 1);
      if (!first) put(up, 0);
      const std::int32_t front = up.normal().dot(buffer.view().gaze) < 0 ? 0 : 1;
      for (int row = 0; row < 20; ++row) {
        for (int column = 0; column < 20; ++column, ++pixels) wrong += buffer.item(column, row) != front;
      }
    }
  }
  // Odd: the middle column looks along the plane of the polygon, whose corners are rounded to either side of it.
  Draw draw(kSeed);
  for (int trial = 0; trial < 200; ++trial) {
    const PixelView turned = turned_view(3 * draw.vector(), 5, ViewOutline::rectangle, draw);
    const PixelView view{turned.eye, turned.across, turned.up, turned.gaze, 5, 5, -1, -1, 0.4, ViewOutline::rectangle};
    const auto at = [&](double high, double deep) { return Vec3(view.eye + high * view.up + deep * view.gaze); };
    const Polygon edge_on = polygon({at(-1, 1.1), at(1.3, 0.9), at(1, 2.3), at(-1.2, 2)});
    ItemBuffer along(view);
    along.draw(edge_on.vertices(), edge_on.normal(), 0);
    for (int row = 0; row < 5; ++row, ++pixels) wrong += along.item(2, row) != kNoItem;
  }
  EXPECT_TRUE(all_agree(wrong, pixels));
}

// CLAIM      What is no view and no item is refused.
// ORACLE     identity: one broken rule each.
// TOLERANCE  none.
TEST(ItemBuffer, RefusesWhatHasNoPixels) {
  proves({}, Oracle::identity, "one broken rule each");
  EXPECT_TRUE(refuses([] { ItemBuffer none(PixelView{}); }));
  PixelView view;
  view.columns = view.rows = 2;
  view.pixel = 1;
  EXPECT_TRUE(refuses([&] {
    PixelView mirrored = view;
    mirrored.across = -view.across;
    ItemBuffer none(mirrored);
  }));
  const std::array<Vec3, 3> corners{Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(0, 1, 1)};
  EXPECT_TRUE(refuses([&] { ItemBuffer(view).draw(corners, Vec3::UnitZ(), -2); }));
}

}  // namespace
}  // namespace etendue::validation
