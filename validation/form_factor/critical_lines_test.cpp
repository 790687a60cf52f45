// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/critical_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/cell.hpp"
#include "etendue/form_factor/chord.hpp"
#include "etendue/form_factor/event_curves.hpp"
#include "etendue/form_factor/loop_sides.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

const std::vector<Vec2> kFloor{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
const std::vector<Vec3> kCeiling{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};

// CLAIM      IU.6-4: the critical lines of a square blocker midway between two unit squares are x = 1/2 and y = 1/2: from
//            a receiver's vertex 0 or 1 the blocker's edges at 1/4 and 3/4 project to 1/2, −1/2, 3/2 and 1/2. They cut
//            the floor into four cells.
// ORACLE     closed form: similar triangles, exact in double.
// TOLERANCE  zero: all numbers are dyadic.
TEST(CriticalLines, AreWhereSimilarTrianglesPutThem) {
  proves({"IU.6-4"}, Oracle::closed_form, "a square blocker between unit squares: x = 1/2 and y = 1/2");
  const SightZone zone{kFloor, {{{0.25, 0.25, 0.5}, {0.75, 0.25, 0.5}, {0.75, 0.75, 0.5}, {0.25, 0.75, 0.5}}}, false};
  const std::vector<CriticalLine> lines = critical_lines(kCeiling, zone);
  bool upright = false, level = false;
  for (const CriticalLine& line : lines) {
    const bool is_upright = std::abs(line.normal.x()) > std::abs(line.normal.y());
    const double at = line.level / (is_upright ? line.normal.x() : line.normal.y());
    EXPECT_TRUE(within(std::min(std::abs(line.normal.x()), std::abs(line.normal.y())), 0));
    EXPECT_TRUE(near(at, 0.5, 0));
    EXPECT_TRUE(within(std::max(std::abs(line.begin), std::abs(line.end)), 1.5));
    (is_upright ? upright : level) = true;
  }
  EXPECT_TRUE(holds(upright && level)) << lines.size() << " lines";
  const std::vector<Cell> cells = cells_between(kFloor, lines);
  EXPECT_TRUE(near(static_cast<double>(cells.size()), 4, 0));
  for (const Cell& cell : cells) EXPECT_TRUE(near(cell.area(), 0.25, 0));
}

// CLAIM      IU.6-4: a plate above another can be passed by the light that it does not stop only as far as that goes on to
//            the receiver: events between two plates whose line of sight misses the receiver are not listed.
// ORACLE     closed form: the corner (1/2, 1/2, 1/4) against the edge x = 1/2 at height 1/2 is seen from x = 1/2 only;
//            straight up, into the receiver; a receiver beyond x = 2 is missed.
// TOLERANCE  zero.
TEST(CriticalLines, EndWhereTheLineOfSightMissesTheReceiver) {
  proves({"IU.6-4"}, Oracle::closed_form, "two plates one above the other, a receiver above or aside");
  const std::vector<Vec3> lower{{0.25, 0.25, 0.25}, {0.5, 0.25, 0.25}, {0.5, 0.5, 0.25}, {0.25, 0.5, 0.25}};
  const std::vector<Vec3> upper{{0.5, 0.25, 0.5}, {0.8, 0.25, 0.5}, {0.8, 0.5, 0.5}, {0.5, 0.5, 0.5}};
  // No corner of a receiver makes the line x = 1/2 with an edge of either: (e − r h)/(1 − h) for edges at e, height h.
  const SightZone zone{kFloor, {lower, upper}, false};
  const auto listed = [&](double shift) {
    std::vector<Vec3> receiver = kCeiling;
    for (Vec3& v : receiver) v.x() += shift;
    const std::vector<CriticalLine> lines = critical_lines(receiver, zone);
    return std::any_of(lines.begin(), lines.end(), [](const CriticalLine& line) {
      return line.normal.y() == 0 && line.level / line.normal.x() == 0.5 && line.begin < line.end;
    });
  };
  EXPECT_TRUE(holds(listed(0)));
  EXPECT_TRUE(holds(!listed(4)));
}

// CLAIM      IU.6-4: such an event ends where its line of sight leaves the receiver, whichever way its line runs; it is not listed where
//            the zone is wholly before that stretch, or wholly behind.
// ORACLE     closed form: past the corner (1/2, 1/2, 1/4) the eye at (1/2, y, 0) sees the edge x = 1/2 at height 1/2 up to its corner for
//            y from 1/2 on, and beyond it (1/2, 2 − 3y, 1): in the receiver to y = 2/3. The same mirrored in both axes.
// TOLERANCE  4 u: two products and a quotient of numbers below 2.
TEST(CriticalLines, BeginAndEndAtTheReceiver) {
  proves({"IU.6-4"}, Oracle::closed_form, "two plates one above the other, a receiver of a quarter");
  const std::vector<Vec3> lower{{0.25, 0.25, 0.25}, {0.5, 0.25, 0.25}, {0.5, 0.5, 0.25}, {0.25, 0.5, 0.25}};
  const std::vector<Vec3> upper{{0.5, 0.25, 0.5}, {0.8, 0.25, 0.5}, {0.8, 0.5, 0.5}, {0.5, 0.5, 0.5}};
  const std::vector<Vec3> receiver{{0, 0, 1}, {0, 0.25, 1}, {1, 0.25, 1}, {1, 0, 1}};
  constexpr double kBegin = 0.5, kEnd = 2.0 / 3, kRounding = 4 * kUnitRoundoff;
  for (const bool mirror_x : {false, true}) {
    for (const bool mirror_y : {false, true}) {
      const auto mirrored = [&](std::vector<Vec3> loop) {
        for (Vec3& v : loop) v = {mirror_x ? 1 - v.x() : v.x(), mirror_y ? 1 - v.y() : v.y(), v.z()};
        if (mirror_x != mirror_y) std::reverse(loop.begin(), loop.end());
        return loop;
      };
      const auto listed = [&](double low, double high) {
        const double y_0 = mirror_y ? 1 - high : low, y_1 = mirror_y ? 1 - low : high;
        const SightZone zone{{{0, y_0}, {1, y_0}, {1, y_1}, {0, y_1}}, {mirrored(lower), mirrored(upper)}, false};
        const std::vector<CriticalLine> lines = critical_lines(mirrored(receiver), zone);
        return std::any_of(lines.begin(), lines.end(), [&](const CriticalLine& line) {
          if (line.normal.y() != 0 || line.level / line.normal.x() != 0.5) return false;
          double a = line.begin / line.normal.x(), b = line.end / line.normal.x();
          if (mirror_y) a = 1 - a, b = 1 - b;
          return std::abs(std::min(a, b) - kBegin) <= kRounding && std::abs(std::max(a, b) - kEnd) <= kRounding;
        });
      };
      EXPECT_TRUE(holds(listed(0, 1) && listed(0.6, 1) && listed(0, 0.6))) << mirror_x << mirror_y;
      EXPECT_TRUE(holds(!listed(0, 0.45) && !listed(0.7, 1))) << mirror_x << mirror_y;
    }
  }
}

// CLAIM      IU.6-4: two upright edges one behind the other cover one another at once, as seen from the plane through both:
//            the line is listed although the receiver is seen only past the lower parts of them, not past their corners.
// ORACLE     closed form: edges over (0.5, 0.5) and (0.75, 0.25), from height 1/32 to 2: the line x + y = 1.
// TOLERANCE  zero: dyadic.
TEST(CriticalLines, CountParallelEdgesByTheirWholeLength) {
  proves({"IU.6-4"}, Oracle::closed_form, "two upright edges: the line through their feet");
  const auto upright = [](double x, double y) {
    return std::vector<Vec3>{{x - 0.25, y - 0.25, 0.03125}, {x - 0.25, y - 0.25, 2}, {x, y, 2}, {x, y, 0.03125}};
  };
  const SightZone zone{
      {{0.75, 0}, {1.5, 0}, {1.5, 0.5}, {1.0625, 0.5}}, {upright(0.5, 0.5), upright(0.75, 0.25)}, false};
  // A strip far behind them and in the middle of their height: the lines of sight to the corners pass over and under it.
  const std::vector<Vec3> strip{{-1, 1, 1}, {-1, 3, 1}, {-1, 3, 1.5}, {-1, 1, 1.5}};
  const std::vector<CriticalLine> lines = critical_lines(strip, zone);
  const bool listed = std::any_of(lines.begin(), lines.end(), [](const CriticalLine& line) {
    const double at = line.along({0.875, 0.125});
    return line.normal.x() == line.normal.y() && line.level / line.normal.x() == 1 && line.begin < at && at < line.end;
  });
  EXPECT_TRUE(holds(listed)) << lines.size() << " lines";
}

// CLAIM      IU.6-4: a cell that a line only touches is not cut: along an edge, at a corner, aside, the other half is empty.
// ORACLE     identity: a square under six lines.
// TOLERANCE  none.
TEST(CriticalLines, CutOffNothingWhereTheyTouch) {
  proves({"IU.6-4"}, Oracle::identity, "a square and lines along its edges and through its corners");
  Cell square;
  for (const Vec2& v : kFloor) square.add(v);
  const auto sizes = [&](const Vec2& normal, double level) {
    const Cell::Halves halves = square.cut(normal, level);
    return std::pair(halves.above.size(), halves.below.size());
  };
  EXPECT_TRUE(holds(sizes({1, 0}, 0.5) == std::pair(4, 4) && sizes({1, -1}, 0) == std::pair(3, 3)));
  EXPECT_TRUE(holds(sizes({1, 0}, 0) == std::pair(4, 0) && sizes({1, 0}, 1) == std::pair(0, 4)));
  EXPECT_TRUE(holds(sizes({1, 1}, 0) == std::pair(4, 0) && sizes({1, 1}, 2) == std::pair(0, 4)));
  EXPECT_TRUE(holds(sizes({1, 0}, -1) == std::pair(4, 0) && sizes({1, 0}, 3) == std::pair(0, 4)));
}

// CLAIM      IU.6-4: loops that lie beside one another from all of a zone are told apart, loops that cover one another are not.
// ORACLE     identity: plates in a row, plates one over the other, a receiver over both.
// TOLERANCE  none.
TEST(LoopSides, TellLoopsApart) {
  proves({"IU.6-4"}, Oracle::identity, "four plates below a ceiling");
  const auto plate = [](double x, double height) {
    return std::vector<Vec3>{{x, 0.4, height}, {x + 0.1, 0.4, height}, {x + 0.1, 0.5, height}, {x, 0.5, height}};
  };
  const SightZone zone{{{0.4, 0.4}, {0.6, 0.4}, {0.6, 0.6}, {0.4, 0.6}},
                       {plate(0.1, 0.3), plate(0.8, 0.3), plate(0.45, 0.3), plate(0.45, 0.5)},
                       false};
  LoopSides sides(kCeiling, zone);
  EXPECT_TRUE(holds(sides.apart(1, 2) && sides.apart(2, 1) && sides.apart(1, 3)));
  EXPECT_TRUE(holds(!sides.apart(3, 4) && !sides.apart(0, 3) && !sides.apart(4, 0)));
}

// CLAIM      IU.6-4: however many lines are drawn through a zone, the cells between them fill it, and no line passes
//            through the inside of a cell.
// ORACLE     identity: areas add up to one; no corner of a cell lies on the far side of a line from another.
// TOLERANCE  kSums for the areas: 600 cells of up to 12 corners, each area within 16 u of one; for the sides the 2^-40
//            of crosses().
TEST(CriticalLines, CutAZoneIntoCellsThatTheyDoNotCross) {
  proves({"IU.6-4"}, Oracle::identity, "40 lines through a square: areas and sides");
  std::vector<CriticalLine> lines;
  for (int k = 0; k < 40; ++k) {
    const double angle = 2.399963 * k;  // the golden angle: no two parallel
    const Vec2 normal(std::cos(angle), std::sin(angle));
    lines.push_back({normal, normal.dot(Vec2(0.5, 0.5)) + 0.01 * (k - 20), -10, 10});
  }
  const std::vector<Cell> cells = cells_between(kFloor, lines);
  EXPECT_GT(cells.size(), 300u);
  double area = 0;
  std::uint64_t crossed = 0;
  for (const Cell& cell : cells) {
    area += cell.area();
    for (const CriticalLine& line : lines) crossed += crosses(line, cell);
  }
  constexpr double kSums = 600 * 16 * 0x1p-53;
  EXPECT_TRUE(near(area, 1, kSums));
  EXPECT_TRUE(all_agree(crossed, cells.size() * lines.size()));
}

// CLAIM      IU.6-4: the lines of sight that meet three edges start, in the source's plane, on a conic; here the regulus of
//            x = y z, with edges on three of its rulings: from (0, t, 0) one meets all three.
// ORACLE     closed form: the line through (0, t, 0) in direction (t, 0, 1) lies in the surface x = y z.
// TOLERANCE  zero: dyadic.
TEST(EventCurves, VanishWhereOneLineOfSightMeetsThreeEdges) {
  proves({"IU.6-4"}, Oracle::closed_form, "three rulings of x = y z: the curve is the y axis");
  // The rulings of the other family: at height z the line x = z y.
  const auto ruling = [](double z) { return EventCurve::Edge{{-z, -1, z}, {z, 1, z}}; };
  const EventCurve curve(ruling(0.25), ruling(0.5), ruling(1));
  for (double t : {-0.75, -0.5, 0.0, 0.25, 0.5}) {
    EXPECT_TRUE(near(curve.at({0, t}), 0, 0));
    EXPECT_TRUE(holds(curve.at({0.25, t}) != 0));
  }
  // Three parallel edges: whatever rounding leaves of zero is no curve.
  const auto parallel = [](const Vec3& p) { return EventCurve::Edge{p, p + Vec3(0.3, 0.7, 0.2)}; };
  const EventCurve none(parallel({0.1, 0.1, 0.3}), parallel({0.3, 0.2, 0.7}), parallel({0.7, 0, 0.9}));
  Cell across, aside;
  for (const Vec2& v : {Vec2(-0.5, 0), Vec2(0.5, 0), Vec2(0.25, 1)}) across.add(v);
  for (const Vec2& v : {Vec2(0.125, 0), Vec2(0.5, 0), Vec2(0.25, 1)}) aside.add(v);
  EXPECT_TRUE(holds(curve.may_cross(across)));
  EXPECT_TRUE(holds(!curve.may_cross(aside)));
  EXPECT_TRUE(holds(curve == EventCurve(ruling(0.25), ruling(0.5), ruling(1)) && !(curve == none)));
  for (const double unit : {0x1p-60, 0x1p60}) {  // it knows no unit of length
    const auto scaled = [&](double z) {
      const EventCurve::Edge edge = ruling(z);
      return EventCurve::Edge{unit * edge.start, unit * edge.end};
    };
    const EventCurve larger(scaled(0.25), scaled(0.5), scaled(1));
    Cell larger_across, larger_aside;
    for (const Vec2& v : across.corners()) larger_across.add(unit * v);
    for (const Vec2& v : aside.corners()) larger_aside.add(unit * v);
    EXPECT_TRUE(holds(larger.may_cross(larger_across) && !larger.may_cross(larger_aside))) << unit;
  }
  EXPECT_TRUE(holds(!none.may_cross(across)));
}

// CLAIM      IU.6-4: a curve's chord through a cell joins the two places where it crosses the cell's boundary; a side that it only touches
//            is not crossed, and without two crossings there is none.
// ORACLE     closed form: rulings of x² + y² − z² = 1, whose curve is the unit circle.
// TOLERANCE  4 u for what roots round, 400 u for a difference quotient over hundredths. The sag is value over slope: (1 − h²)/(2h) for a
//            chord at the height h, here as a share of its length.
TEST(EventCurves, HaveChordsBetweenTwoCrossings) {
  proves({"IU.6-4"}, Oracle::closed_form, "the unit circle in cells that it touches and crosses");
  const EventCurve circle({{1, 1, 1}, {1, 2, 2}}, {{-1, 1, 1}, {-2, 1, 2}}, {{-1, -1, 1}, {-1, -2, 2}});
  const auto cell = [](double low, double high) {
    Cell made;
    for (const Vec2& v : {Vec2(-0.5, low), Vec2(0.5, low), Vec2(0.5, high), Vec2(-0.5, high)}) made.add(v);
    return made;
  };
  constexpr double kHeight = 0.875, kRounding = 4 * kUnitRoundoff;
  for (const double high : {1.0, 1.25}) {
    const auto chord = chord_of(circle, cell(kHeight, high));
    ASSERT_TRUE(chord) << high;
    EXPECT_TRUE(near(chord->length, 2 * std::sqrt(1 - kHeight * kHeight), kRounding));
    EXPECT_TRUE(near(chord->level / chord->normal.y(), kHeight, kRounding));
    const double square = 1 - kHeight * kHeight;
    EXPECT_TRUE(near(chord->sag, square / (2 * kHeight) / (2 * std::sqrt(square)), kRounding * 100))
        << "a difference quotient";
  }
  EXPECT_TRUE(holds(!chord_of(circle, cell(1, 1.25)) && !chord_of(circle, cell(1.125, 1.25)))) << "touched, missed";
  EXPECT_TRUE(holds(!chord_of(circle, cell(-1.5, 1.5)).has_value())) << "four crossings";
}

/// Three rulings of x = y z, whose curve is the y axis.
EventCurve rulings() {
  const auto ruling = [](double z) { return EventCurve::Edge{{-z, -1, z}, {z, 1, z}}; };
  return {ruling(0.25), ruling(0.5), ruling(1)};
}

/// The factor of the triangle that these rulings leave as seen from x: the solid angle of its corners' directions, by Van
/// Oosterom and Strackee, times the greatest of their cosines.
double triangle_factor(const Vec2& x) {
  const Vec3 eye(x.x(), x.y(), 0);
  std::array<Vec3, 3> planes, rays;
  const std::array<double, 3> heights{0.25, 0.5, 1};
  for (std::size_t k = 0; k < 3; ++k)
    planes[k] = (Vec3(-heights[k], -1, heights[k]) - eye).cross(Vec3(2 * heights[k], 2, 0));
  double cosine = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    rays[k] = planes[k].cross(planes[(k + 1) % 3]).normalized();
    if (rays[k].z() < 0) rays[k] = -rays[k];
    cosine = std::max(cosine, rays[k].z());
  }
  const double spread = 1 + rays[0].dot(rays[1]) + rays[1].dot(rays[2]) + rays[2].dot(rays[0]);
  return 2 * std::atan2(std::abs(rays[0].dot(rays[1].cross(rays[2]))), spread) * cosine / std::numbers::pi;
}

Cell square_around(const Vec2& middle, double half) {
  Cell cell;
  for (const Vec2& v : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)}) cell.add(middle + half * v);
  return cell;
}

// CLAIM      IU.6-4: beyond an event curve the form errs by the triangle that the three edges leave, `gap` is its factor
//            near the curve, and `stray` no less than its integral over what of a cell lies beyond.
// ORACLE     an independent method: Van Oosterom and Strackee's solid angle; sums over 64 × 64 points.
// TOLERANCE  at the distance d from the curve triangles are of the size d/h, h = 1/4 the least height: flat to 4d, and
//            products over a cell of d/64 differ by less.
TEST(EventCurves, WeighTheTriangleBeyondThem) {
  proves({"IU.6-4"}, Oracle::program, "triangles between three rulings of x = y z, from points beside the y axis");
  const EventCurve curve = rulings();
  for (const double t : {-0.4, -0.1, 0.25, 0.5}) {
    for (const double d : {0x1p-6, -0x1p-8, 0x1p-10}) {
      const Vec2 x(d, t);
      const double factor = triangle_factor(x);
      EXPECT_TRUE(near(curve.gap(curve.at(x), square_around(x, std::abs(d) / 64)), factor, 4 * std::abs(d) * factor));
    }
  }
  constexpr int kPoints = 64;
  constexpr double kHalf = 1.0 / 32, kStep = 2 * kHalf / kPoints;
  for (const double middle : {0x1p-7, -0x1p-8, 0x1p-6}) {
    const Cell cell = square_around({middle, 0.1}, kHalf);
    double beyond = 0;
    for (int i = 0; i < kPoints; ++i) {
      for (int j = 0; j < kPoints; ++j) {
        const Vec2 x = cell[0] + kStep * Vec2(i + 0.5, j + 0.5);
        if (x.x() * middle < 0) beyond += kStep * kStep * triangle_factor(x);
      }
    }
    const double stray = curve.stray(cell);
    EXPECT_TRUE(holds(beyond > 0 && stray >= beyond && stray <= 64 * beyond)) << stray << " for " << beyond;
  }
}

}  // namespace
}  // namespace etendue::validation
