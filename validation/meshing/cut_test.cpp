// SPDX-License-Identifier: Apache-2.0
#include "etendue/meshing/cut.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "etendue/meshing/elements.hpp"
#include "meshing/small_scenes.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

/// A plane in general position, and points in it.
struct Plane2 {
  Vec3 origin, u, v;
  Vec3 at(double x, double y) const { return origin + x * u + y * v; }
};

Plane2 tilted() {
  return {{0.3, -0.2, 0.7}, Vec3(2, 1, -0.5).normalized(), Vec3(-1, 2, 0).normalized()};  // u ⊥ v
}

/// columns × rows cells over [0, 1]², which share their corners to the last bit.
std::vector<Polygon> cells_of(const Plane2& plane, int columns, int rows) {
  Scene scene = scene_of({quadrilateral(plane.at(0, 0), plane.at(1, 0), plane.at(1, 1), plane.at(0, 1))});
  scene.objects[0].subdivision = {{columns, rows}, {1, 1}};
  const ElementMesh mesh = *mesh_elements(scene);
  std::vector<Polygon> cells;
  for (const Element& element : mesh.elements) cells.push_back(element.polygon);
  return cells;
}

using Place = std::array<double, 3>;
Place key(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

// CLAIM      IU.6.5.1: lines through a grid of cells, some of them through corners, or within 2^-45 of corners, cut it into
//            convex pieces that fill it, and neighbours share their new corners to the last bit: no cut leaves a gap.
// ORACLE     identity: Euler's V − E + F = 1 over distinct doubles, where every inner side has two pieces; areas.
// TOLERANCE  counts: none. Areas: 64 roundings of one for each piece.
TEST(CutAlong, LeavesNoGapBetweenPieces) {
  proves({"IU.6.5.1"}, Oracle::identity, "Euler's formula over distinct corners");
  constexpr std::uint64_t kSeed = 591;
  uses_seed(kSeed);
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> entry(0, 1);
  const Plane2 plane = tilted();
  const Vec3 normal = plane.u.cross(plane.v);
  std::uint64_t wrong = 0, checked = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const std::vector<Polygon> cells = cells_of(plane, 3, 4);
    std::vector<Segment> lines;
    for (int k = 0; k < 5; ++k) {
      double x = entry(random), y = entry(random);
      const double angle = 6.3 * entry(random);
      if (k > 1) {  // through a corner of the grid
        x = std::floor(4 * x) / 3;
        y = std::floor(5 * y) / 4;
      }
      if (k > 2) x += (k == 3 ? 1 : -1) * 0x1p-45;
      lines.push_back({plane.at(x - 3 * std::cos(angle), y - 3 * std::sin(angle)),
                       plane.at(x + 3 * std::cos(angle), y + 3 * std::sin(angle))});
    }
    const auto pieces = cut_along(cells, normal, lines, 0x1p-40);
    std::set<Place> corners;
    std::map<std::pair<Place, Place>, int> sides;
    std::vector<double> areas(cells.size(), 0);
    double total = 0;
    for (const CutPiece& piece : pieces) {
      const auto& v = piece.polygon.vertices();
      for (std::size_t k = 0; k < v.size(); ++k) {
        const Place a = key(v[k]), b = key(v[(k + 1) % v.size()]);
        corners.insert(a);
        ++sides[{std::min(a, b), std::max(a, b)}];
      }
      areas[piece.of] += piece.polygon.area();
      total += piece.polygon.area();
      wrong += !is_convex(piece.polygon) || piece.polygon.normal().dot(normal) < 0.5;
      ++checked;
    }
    EXPECT_GT(pieces.size(), 2 * cells.size());
    const auto v = static_cast<double>(corners.size()), e = static_cast<double>(sides.size());
    EXPECT_TRUE(near(v - e + static_cast<double>(pieces.size()), 1, 0)) << "trial " << trial;
    for (const auto& [side, count] : sides) wrong += count > 2;
    for (const double area : areas)
      EXPECT_TRUE(near(area, 1.0 / 12, 64 * 0x1p-53 * static_cast<double>(pieces.size())));
    EXPECT_TRUE(near(total, 1, 64 * 0x1p-53 * static_cast<double>(pieces.size())));
  }
  EXPECT_TRUE(all_agree(wrong, checked));
}

// CLAIM      IU.6.5.1: after cutting, no segment passes the inside of a piece; polygons that no segment passes stay whole, and
//            a segment that ends inside is extended in that polygon only.
// ORACLE     identity: of each piece and segment, corners on both sides of its line and a stretch of it inside; by hand, the
//            pieces of a row of three squares with one segment that ends in the second.
// TOLERANCE  counts: none. A corner within twice the slack of a line is on it.
TEST(CutAlong, EndsWithTheSegment) {
  proves({"IU.6.5.1"}, Oracle::identity, "a row of three squares by hand");
  const Plane2 plane = tilted();
  const Vec3 normal = plane.u.cross(plane.v);
  const auto row = cells_of(plane, 3, 1);
  constexpr double kSlack = 0x1p-40;
  const Segment slanted{plane.at(-0.1, 0.2), plane.at(0.5, 0.6)};
  const auto pieces = cut_along(row, normal, std::vector{slanted}, kSlack);
  ASSERT_EQ(pieces.size(), 5u);
  EXPECT_TRUE(holds(pieces[0].of == 0 && pieces[1].of == 0 && pieces[2].of == 1 && pieces[3].of == 1));
  EXPECT_TRUE(holds(key(pieces[4].polygon.vertices()[0]) == key(row[2].vertices()[0])));
  // The line is y = 0.8/3 + 2 x/3: in the square [1/3, 2/3] it runs from 4.4/9 to 6.4/9, in all of its width.
  EXPECT_TRUE(near(pieces[2].polygon.area(), (1 - (4.4 / 9 + 6.4 / 9) / 2) / 3, 32 * 0x1p-53)) << "what is left of it";

  std::mt19937_64 random(592);
  std::uniform_real_distribution<double> entry(0, 1);
  std::vector<Segment> many;
  for (int k = 0; k < 12; ++k) {
    const double x0 = entry(random), y0 = entry(random), x1 = entry(random), y1 = entry(random);
    many.push_back({plane.at(x0, y0), plane.at(x1, y1)});
  }
  const auto parts = cut_along(cells_of(plane, 4, 4), normal, many, kSlack);
  std::uint64_t passed = 0;
  for (const CutPiece& part : parts) {
    for (const Segment& segment : many) {
      const Vec3 along = (segment.to - segment.from).normalized();
      // Clips the segment to the piece, drawn in by twice the slack.
      double low = 0, high = (segment.to - segment.from).norm();
      const auto& v = part.polygon.vertices();
      for (std::size_t k = 0; k < v.size(); ++k) {
        const Vec3 inward = normal.cross((v[(k + 1) % v.size()] - v[k]).normalized());
        const double at = inward.dot(segment.from - v[k]) - 2 * kSlack, slope = inward.dot(along);
        if (slope > 0) low = std::max(low, -at / slope);
        if (slope < 0) high = std::min(high, -at / slope);
        if (slope == 0 && at < 0) high = -1;
      }
      passed += high - low > 4 * kSlack;
    }
  }
  EXPECT_TRUE(all_agree(passed, parts.size() * many.size()));
  EXPECT_GT(parts.size(), 40u);
}

// CLAIM      Segments nearer to a side, or to a corner's line, than the slack cut nothing; beyond it they cut, and the pieces are
//            polygons. A segment shorter than the slack has no direction and is passed over.
// ORACLE     closed form: a unit square and a segment beside its left side.
// TOLERANCE  area of the strip: what 2^-52 moves a corner by, along a side of one, twice.
TEST(CutAlong, MakesNoPieceThinnerThanItsSlack) {
  proves({"IU.6.5.1"}, Oracle::closed_form, "strips beside a side of a square");
  const std::vector<Polygon> square{quadrilateral({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0})};
  constexpr double kSlack = 0x1p-40;
  const auto cut = [&](const Segment& segment) {
    return cut_along(square, Vec3::UnitZ(), std::vector{segment}, kSlack);
  };
  for (const double share : {0.0, 0.5, -0.5, 0.99}) {
    const double x = share * kSlack;
    EXPECT_TRUE(near(static_cast<double>(cut({{x, -1, 0}, {x, 2, 0}}).size()), 1, 0));
    EXPECT_TRUE(near(static_cast<double>(cut({{x, 1, 0}, {1 + x, 0, 0}}).size()), 2, 0)) << "a diagonal is no side";
  }
  const auto strip = cut({{2 * kSlack, -1, 0}, {2 * kSlack, 2, 0}});
  ASSERT_EQ(strip.size(), 2u);
  EXPECT_TRUE(near(strip[0].polygon.area(), 2 * kSlack, 2 * 0x1p-52));
  EXPECT_TRUE(near(static_cast<double>(cut({{0.5, 0.5, 0}, {0.5, 0.5 + kSlack / 2, 0}}).size()), 1, 0));
  EXPECT_TRUE(near(static_cast<double>(cut({{0.5, 1.5, 0}, {0.5, 2, 0}}).size()), 1, 0)) << "its line alone";
  EXPECT_TRUE(refuses([&] { (void)cut_along(square, Vec3::UnitZ(), {}, 0); }));
}

}  // namespace
}  // namespace etendue::validation
