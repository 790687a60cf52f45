// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/patch_chart.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "etendue/form_factor/gauss_legendre.hpp"
#include "form_factor/shapes.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr double kPi = std::numbers::pi;
/// Of the Gauss sums below: 8 · 32 nodes along angles over which a reach has no singularity nearer than a tenth of a turn.
constexpr double kSummed = 1e-11;

double gauss(const auto& integrand, double from, double to) {
  constexpr int kPieces = 8;
  double sum = 0;
  for (int piece = 0; piece < kPieces; ++piece) {
    const double width = (to - from) / kPieces, middle = from + (piece + 0.5) * width;
    for (const QuadratureNode& node : gauss_legendre(32)) {
      sum += 0.5 * width * node.weight * integrand(middle + 0.5 * width * node.x);
    }
  }
  return sum;
}

double area_of_charts(const std::vector<PatchChart>& charts) {
  double area = 0;
  for (const PatchChart& chart : charts) {
    area += gauss([&](double s) { return gauss([&](double t) { return chart.at(s, t).area; }, 0, 1); }, 0, 1);
  }
  return area;
}

double area_of_wedges(const FlatPart& part, const Vec2& apex, double hole) {
  double area = 0;
  for (const Wedge& wedge : part.wedges(apex, hole)) {
    const auto ring = [&](double angle) {
      const Vec2 way(std::cos(angle), std::sin(angle));
      const double inner = wedge.inner.along(way), outer = wedge.outer.along(way);
      return 0.5 * (outer - inner) * (outer + inner);
    };
    area += gauss(ring, wedge.turn, wedge.turn + wedge.turns);
  }
  return area;
}

/// Of a circle of radius r what lies beyond a line at the distance d from its centre.
double segment(double r, double d) {
  return r * r * std::acos(d / r) - d * std::sqrt(r * r - d * d);
}

Polygon regular(int corners) {
  std::vector<Vec3> v;
  for (int k = 0; k < corners; ++k)
    v.push_back({std::cos(2 * kPi * k / corners), std::sin(2 * kPi * k / corners), 0.0});
  return tilted(polygon(v));
}

// CLAIM      IU.6-2: charts share out a flat patch, without what blockers standing on it cover: triangles, quadrilaterals, pentagons,
//            discs; under a prism, under one cylinder, under several that stand close.
// ORACLE     closed form: areas of polygons and circles.
// TOLERANCE  kSummed of the patch.
TEST(PatchChart, SharesOutWhatIsFree) {
  proves({"IU.6-2"}, Oracle::closed_form, "areas of polygons and discs less their footprints");
  const Vec3 above = tilted(Vec3(0, 0, 5));
  for (const int corners : {3, 4, 5, 7}) {
    const double whole = 0.5 * corners * std::sin(2 * kPi / corners);
    const auto charts = PatchChart::covering(regular(corners), above, 1);
    EXPECT_TRUE(near(area_of_charts(charts), whole, kSummed * whole));
    EXPECT_TRUE(holds(charts.size() == (corners == 4 ? 1u : static_cast<std::size_t>(corners) - 2)))
        << "none of no area";
  }
  const Polygon square = tilted(rectangle({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}));
  const auto at = [](double x, double y) { return tilted(Vec3(x, y, 0)); };
  const auto circle = [&](double x, double y, double r) { return Footprint{{}, at(x, y), r}; };
  PatchCuts cuts;
  cuts.footprints = {circle(-0.9, 0.1, 0.5)};
  EXPECT_TRUE(near(area_of_charts(PatchChart::covering(square, above, 1, cuts)), 16 - 0.25 * kPi, 16 * kSummed));
  cuts.footprints.push_back(circle(0.2, 0.3, 0.55));
  cuts.footprints.push_back(circle(-0.2, -1.1, 0.3));
  const double covered = kPi * (0.25 + 0.55 * 0.55 + 0.09);
  EXPECT_TRUE(near(area_of_charts(PatchChart::covering(square, above, 1, cuts)), 16 - covered, 16 * kSummed));
  cuts.footprints = {Footprint{{at(0.5, 0.5), at(1.5, 0.5), at(1, 1.5)}, Vec3::Zero(), 0}, circle(-0.5, 0, 0.5)};
  EXPECT_TRUE(near(area_of_charts(PatchChart::covering(square, above, 1, cuts)), 16 - 0.5 - 0.25 * kPi, 16 * kSummed));
  cuts.footprints = {circle(-0.5, 0, 1),
                     circle(0.71, 0, 0.2)};  // a hundredth apart: the cut between them has no choice
  EXPECT_TRUE(near(area_of_charts(PatchChart::covering(square, above, 1, cuts)), 16 - 1.04 * kPi, 16 * kSummed));
  const Disc disc{at(0, 0), (at(0, 0) - tilted(Vec3(0, 0, -1))).normalized(), 2};
  EXPECT_TRUE(near(area_of_charts(PatchChart::covering(disc, above, 1)), 4 * kPi, 4 * kPi * kSummed));
  cuts.footprints = {circle(0.7, 0, 0.5), circle(-0.6, 0.2, 0.6)};
  EXPECT_TRUE(
      near(area_of_charts(PatchChart::covering(disc, above, 1, cuts)), kPi * (4 - 0.25 - 0.36), 4 * kPi * kSummed));
}

// CLAIM      wedges around an apex share out a part but for a hole around the apex: inside it, on an edge, at a corner, beside it.
// ORACLE     closed form: a whole, a half and a quarter circle, a circle's segment, the lens of two circles.
// TOLERANCE  kSummed of the part; 1e-7 of it where a wedge begins on the tangent of a circle, at which its reach has a root.
TEST(FlatPart, IsSharedOutAroundAnApex) {
  proves({}, Oracle::closed_form, "areas of squares and discs less a hole");
  const FlatPart square = FlatPart::polygon({{0, 0}, {2, 0}, {2, 2}, {0, 2}});
  const double r = 0.7;
  EXPECT_TRUE(near(area_of_wedges(square, {0.9, 1.2}, 0), 4, 4 * kSummed));
  EXPECT_TRUE(near(area_of_wedges(square, {0.9, 1.2}, r), 4 - kPi * r * r, 4 * kSummed));
  EXPECT_TRUE(near(area_of_wedges(square, {0, 0.9}, r), 4 - kPi * r * r / 2, 4 * kSummed));
  EXPECT_TRUE(near(area_of_wedges(square, {2, 2}, r), 4 - kPi * r * r / 4, 4 * kSummed));
  EXPECT_TRUE(near(area_of_wedges(square, {-0.3, 1.1}, r), 4 - segment(r, 0.3), 4 * kSummed));
  EXPECT_TRUE(near(area_of_wedges(square, {1.2, 0.3}, r), 4 - kPi * r * r + segment(r, 0.3), 4 * kSummed));
  const FlatPart disc = FlatPart::disc(1.5);
  EXPECT_TRUE(near(area_of_wedges(disc, {0.2, 0.3}, r), kPi * (2.25 - r * r), 8 * kSummed));
  const double d = 1.3, to_lens = (d * d + r * r - 2.25) / (2 * d);
  const double lens = segment(r, to_lens) + segment(1.5, d - to_lens);
  EXPECT_TRUE(near(area_of_wedges(disc, {d * 0.6, d * 0.8}, r), 2.25 * kPi - lens, 1e-7));
  const auto [beyond, before] = disc.split({0.6, 0.8}, 0.5);
  EXPECT_TRUE(near(area_of_wedges(beyond, beyond.middle(), 0), segment(1.5, 0.5), 8 * kSummed));
  EXPECT_TRUE(near(area_of_wedges(before, before.middle(), 0), 2.25 * kPi - segment(1.5, 0.5), 8 * kSummed));
}

// CLAIM      a circle meets a part where its radius is more than the centre's distance from it, for polygons, discs, cut discs.
// ORACLE     another method: the distance from 20 000 points of the outline, or none where the centre is inside by the signs of
//            the lines that bound the part.
// TOLERANCE  circles of 0.99 and 1.01 times the distance: the points are nearer to each other than 1e-3, which makes a distance
//            of 0.05 or more too large by less than 3e-6.
TEST(FlatPart, MeetsTheCirclesThatReachIt) {
  proves({}, Oracle::program, "distances from sampled outlines, 600 circles");
  uses_seed(20261127);
  CounterRandom random(20261127);
  std::uint64_t wrong = 0, judged = 0;
  const std::vector<Vec2> corners{{-1, -0.8}, {1.2, -0.5}, {0.9, 0.7}, {-0.3, 1.1}};
  const Vec2 normal(0.6, 0.8);
  const double rim = 1.2, offset = 0.4;
  const std::pair<FlatPart, FlatPart> cut = FlatPart::disc(rim).split(normal, offset);
  for (int i = 0; i < 600; ++i) {
    const Vec2 centre(random.between(-3, 3), random.between(-3, 3));
    const bool bounded = i % 3 == 0, far_side = i % 3 == 1;
    const FlatPart part = bounded ? FlatPart::polygon(corners) : far_side ? cut.first : cut.second;
    const double half = std::sqrt(rim * rim - offset * offset);
    double distance = HUGE_VAL;
    bool inside = true;
    for (std::size_t k = 0; bounded && k < corners.size(); ++k) {
      const Vec2 a = corners[k], edge = corners[(k + 1) % corners.size()] - a;
      inside = inside && edge.x() * (centre - a).y() - edge.y() * (centre - a).x() > 0;
      for (int s = 0; s <= 5000; ++s) distance = std::min(distance, (a + s / 5000.0 * edge - centre).norm());
    }
    if (!bounded) {
      inside = centre.norm() < rim && (normal.dot(centre) > offset) == far_side;
      for (int s = 0; s < 20000; ++s) {
        const double angle = kPi * s / 10000;
        const Vec2 p(rim * std::cos(angle), rim * std::sin(angle));
        if ((normal.dot(p) > offset) == far_side) distance = std::min(distance, (p - centre).norm());
        const Vec2 chord = offset * normal + half * (s / 10000.0 - 1) * Vec2(-normal.y(), normal.x());
        distance = std::min(distance, (chord - centre).norm());
      }
    }
    if (distance < 0.05) continue;
    judged += 2;
    wrong += part.meets({centre, 1.01 * distance}) ? 0u : 1u;
    wrong += part.meets({centre, 0.99 * distance}) == inside ? 0u : 1u;
  }
  EXPECT_TRUE(all_agree(wrong, judged));
}

// CLAIM      the ball around a patch holds it, and is no larger than it must be.
// ORACLE     closed form: centre and radius.
// TOLERANCE  8 u.
TEST(PatchChart, BallsHoldTheirPatches) {
  proves({}, Oracle::closed_form, "balls around cylinder, sphere, disc, rectangle");
  constexpr double kRounding = 8 * 0x1p-53;
  const PatchBall tube = ball_around(Cylinder{{1, 2, 3}, {1, 2, 7}, 1.5});
  EXPECT_TRUE(near((tube.middle - Vec3(1, 2, 5)).norm(), 0, 5 * kRounding));
  EXPECT_TRUE(near(tube.size, 2.5, 2.5 * kRounding));
  const PatchBall ball = ball_around(Sphere{{1, 2, 3}, 0.5}), flat = ball_around(Disc{{1, 2, 3}, {0, 0, 1}, 0.5});
  EXPECT_TRUE(
      holds(ball.middle == Vec3(1, 2, 3) && ball.size == 0.5 && flat.middle == Vec3(1, 2, 3) && flat.size == 0.5));
  const PatchBall corners = ball_around(rectangle({0, 0, 0}, {3, 0, 0}, {0, 4, 0}));
  EXPECT_TRUE(near((corners.middle - Vec3(1.5, 2, 0)).norm(), 0, 3 * kRounding));
  EXPECT_TRUE(near(corners.size, 2.5, 5 * kRounding));
}

// CLAIM      IU.6-2: of a cylinder and a sphere the charts cover what can see some of a ball, and nothing that sees none of it.
// ORACLE     closed form: a place on a cylinder sees some of the ball where its tangent plane does not have it behind.
// TOLERANCE  kSummed of the wall.
TEST(PatchChart, CoversWhatSeesTheBall) {
  proves({"IU.6-2"}, Oracle::closed_form, "visible parts of cylinder and sphere");
  const Cylinder cylinder{{0, 0, 0}, {0, 0, 2}, 1};
  for (const double distance : {1.5, 2.0, 5.0}) {
    for (const double size : {0.25, 0.5}) {
      const auto charts = PatchChart::covering(cylinder, {distance * 0.6, distance * 0.8, 1}, size);
      const double half = std::acos((1 - size) / distance);
      EXPECT_TRUE(near(area_of_charts(charts), 2 * half * 2, 12 * kSummed));
    }
  }
  EXPECT_TRUE(near(area_of_charts(PatchChart::covering(cylinder, {0, 0, 5}, 0.5)), 4 * kPi, 12 * kSummed))
      << "on the axis";
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const Vec3 towards(scale * 1.8, scale * 2.4, scale);
    const Cylinder scaled{Vec3::Zero(), {0, 0, 2 * scale}, scale};
    for (const PatchChart& chart : PatchChart::covering(scaled, towards, 0.5 * scale)) {
      const PatchSpot spot = chart.at(0.5, 0.5);
      EXPECT_TRUE(holds((towards - spot.point).dot(spot.normal) > -0.5 * scale)) << scale;
    }
  }
  const double distance = 3, size = 0.5, cosine = (1 - size) / distance;
  const auto charts = PatchChart::covering(Sphere{{0, 0, 0}, 1}, {0, distance * 0.6, distance * 0.8}, size);
  EXPECT_TRUE(near(area_of_charts(charts), 2 * kPi * (1 - cosine), 12 * kSummed));
  for (const PatchChart& chart : charts) {
    const PatchSpot spot = chart.at(0.3, 0.7);
    EXPECT_TRUE(near((spot.point - spot.normal).norm(), 0, 1e-15));
  }
}

}  // namespace
}  // namespace etendue::validation
