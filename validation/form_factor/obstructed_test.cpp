// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/obstructed.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "etendue/form_factor/point_polygon.hpp"
#include "etendue/form_factor/polygon_polygon.hpp"
#include "form_factor/shapes.hpp"
#include "oracles/parallel_plates.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

const Polygon kFloor = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
const Polygon kCeiling = rectangle({0, 0, 1}, {0, 1, 0}, {1, 0, 0});

double unit(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

// CLAIM      IU.6-4: a half-plane midway between two plates hides exactly half.
// ORACLE     closed form: the point reflection at the centre maps lit lines to hidden ones, so F = C-11 / 2.
// TOLERANCE  the returned bound, itself below what was asked.
TEST(ObstructedFormFactor, IsHalvedByAHalfPlaneInTheMiddle) {
  proves({"IU.6-4"}, Oracle::closed_form, "C-11 / 2 by symmetry, tolerances 1e-2 to 1e-7");
  const Polygon screen = rectangle({-5, -5, 0.5}, {5.5, 0, 0}, {0, 10, 0});
  const double truth = 0.5 * oracle::parallel_plates(1, 1);
  for (double asked : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
    const std::vector<Polygon> blockers{tilted(screen)};
    const Bounded f = obstructed_form_factor(tilted(kFloor), tilted(kCeiling), blockers, {asked, 0});
    EXPECT_TRUE(near(f.value, truth, f.bound)) << asked;
    EXPECT_TRUE(within(f.bound, asked * f.value)) << asked;
  }
}

// CLAIM      IU.6-4: a blocker that hides all leaves exactly 0; one that hides nothing changes no bit, be it aside,
//            behind, in the plane of either polygon, or both polygons themselves.
// ORACLE     identity: H = 0 and H = 1.
// TOLERANCE  zero.
TEST(ObstructedFormFactor, IsExactWhereAllOrNothingIsHidden) {
  proves({"IU.6-4"}, Oracle::identity, "H = 0 and H = 1 everywhere");
  const std::vector<Polygon> all{rectangle({-1, -1, 0.4}, {3, 0, 0}, {0, 3, 0.1})};
  EXPECT_TRUE(within(obstructed_form_factor(kFloor, kCeiling, all).value, 0));
  const std::vector<Polygon> none{rectangle({1.5, 0, 0.4}, {1, 0, 0}, {0, 1, 0.1}),  // aside
                                  rectangle({0, 0, 1.5}, {1, 0, 0}, {0, 1, 0.1}),    // above
                                  rectangle({-1, -1, 0}, {3, 0, 0}, {0, 3, 0}),      // in the floor
                                  rectangle({1, 0, 0}, {0, 1, 0}, {0, 0, 1}),        // a wall along both
                                  kFloor,
                                  kCeiling};
  const double free = form_factor(kFloor, kCeiling, {1e-13, 0}).value;
  EXPECT_TRUE(within(std::abs(obstructed_form_factor(kFloor, kCeiling, none).value - free), 0));
}

// CLAIM      IU.6-4: a screen cut in two: what passes beside the one part is hidden by the other. Screens and cuts are
//            random, between polygons at random places, so nothing is symmetric.
// ORACLE     identity: F past part one + F past part two = F free, since together they hide all.
// TOLERANCE  the sum of the three returned bounds. Two of them are estimates, and none may be exceeded.
TEST(ObstructedFormFactor, AddsUpOverTheTwoPartsOfAScreen) {
  proves({"IU.6-4"}, Oracle::identity, "complementary screens, 200 random cases at 1e-4 relative");
  constexpr int kCases = 200;
  constexpr double kAsked = 1e-4;
  std::mt19937_64 random(20240301);
  int exceeded = 0;
  double worst = 0;
  for (int i = 0; i < kCases; ++i) {
    const double d = 0.5 + unit(random), shift = unit(random), tilt = 0.4 * unit(random);
    const Polygon to = tilted(rectangle({shift, 0.2, d}, {0, 1, 0}, {1, 0, tilt}));
    const Polygon from = tilted(kFloor);
    // Both ends of the cut lie far outside; the cut itself passes through the shaft, the screen leans.
    const double lean = 0.1 * (unit(random) - 0.5), height = d * (0.2 + 0.5 * unit(random));
    const double angle = std::numbers::pi * unit(random);
    const Vec3 middle(0.2 + 0.6 * unit(random) + 0.4 * shift, 0.3 + 0.4 * unit(random), height);
    const Vec3 along = 4 * Vec3(std::cos(angle), std::sin(angle), lean);
    const Vec3 across = 4 * Vec3(-std::sin(angle), std::cos(angle), 0);
    const std::vector<Polygon> one{tilted(rectangle(middle - along, 2 * along, across))};
    const std::vector<Polygon> two{tilted(rectangle(middle - along, 2 * along, -across))};
    const Bounded past_one = obstructed_form_factor(from, to, one, {kAsked, 1e-6});
    const Bounded past_two = obstructed_form_factor(from, to, two, {kAsked, 1e-6});
    const Bounded free = form_factor(from, to);
    const double defect = std::abs(past_one.value + past_two.value - free.value);
    const double bound = past_one.bound + past_two.bound + free.bound;
    if (defect > bound) ++exceeded;
    worst = std::max(worst, defect / bound);
    EXPECT_TRUE(within(past_one.bound, std::max(1e-6, kAsked * past_one.value)));
  }
  ::testing::Test::RecordProperty("exceeded", exceeded);
  ::testing::Test::RecordProperty("worst_share", std::to_string(worst));
  EXPECT_TRUE(within(exceeded, 0)) << "worst " << worst;
}

// CLAIM      IU.6-4: three leaning blockers, one of them touching the receiver: the factor is what rays between the two
//            polygons find.
// ORACLE     statistics: 38 416 stratified point pairs, seed fixed; unbiased for any blockers.
// TOLERANCE  4 standard errors of the plain estimator (which stratification only lowers): a right answer fails once in
//            15 000 seeds; a wrong one by 3 % of F is seen.
TEST(ObstructedFormFactor, IsWhatRaysFind) {
  proves({"IU.6-4"}, Oracle::statistics, "38 416 stratified point pairs, 4 standard errors");
  const std::vector<Polygon> blockers = leaning_blockers();
  const Bounded f = obstructed_form_factor(kFloor, kCeiling, blockers, {1e-5, 0});
  std::mt19937_64 random(7);
  const auto [mean, error] = between_unit_squares(blockers, 14, [&] { return unit(random); });
  EXPECT_TRUE(near(f.value, mean, 4 * error + f.bound));
  EXPECT_TRUE(within(error, 0.0075 * mean)) << "the test would see little";
}

// CLAIM      IU.6-4: from a point, a screen at half height casts the shadow that similar triangles give.
// ORACLE     identity: the visible factor plus that of the shadow, the receiver's own rectangle, is the free factor.
// TOLERANCE  the three returned bounds, and kFrame for the tilted frame's coordinates.
TEST(VisiblePointToPolygon, CastsTheShadowOfSimilarTriangles) {
  proves({"IU.6-4"}, Oracle::identity, "free = visible + shadow at twice the screen");
  constexpr double kFrame = 64 * 0x1p-53;
  const Vec3 point = tilted(Vec3(0.5, 0.5, 0));
  const Vec3 normal = (tilted(Vec3::UnitZ()) - tilted(Vec3::Zero())).normalized();
  const std::vector<Polygon> screen{tilted(rectangle({0.4, 0.45, 0.5}, {0.2, 0, 0}, {0, 0.3, 0}))};
  const Polygon shadow = tilted(rectangle({0.3, 0.4, 1}, {0, 0.6, 0}, {0.4, 0, 0}));
  const Bounded free = point_to_polygon(point, normal, tilted(kCeiling));
  const Bounded dark = point_to_polygon(point, normal, shadow);
  const Bounded lit = visible_point_to_polygon(point, normal, tilted(kCeiling), screen);
  ASSERT_GT(dark.value, 0.05);
  EXPECT_TRUE(near(lit.value, free.value - dark.value, lit.bound + free.bound + dark.bound + kFrame));
}

/// Which side of the line from a to b a point of the plane lies on: above zero to the left.
double left_of(const Vec2& a, const Vec2& b, const Vec2& p) {
  return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
}

/// The length of a string pulled tight from a to b that leaves all of `body` to its right. Both ends are corners of the
/// hull of everything, so the string runs along that hull.
double string_length(const Vec2& a, const Vec2& b, const std::vector<Vec2>& body) {
  double length = 0;
  Vec2 at = a;
  for (std::size_t step = 0; step <= body.size() && at != b; ++step) {
    Vec2 next = b;
    for (const Vec2& p : body) {
      if (p != at && left_of(at, next, p) > 0) next = p;
    }
    length += (next - at).norm();
    at = next;
  }
  return length;
}

/// Strips seen along their length, from a[0] to a[1] and from b[0] to b[1]: a[0] lies opposite b[0].
struct StripPair {
  std::array<Vec2, 2> a, b;
};

/// Hottel's crossed strings, once for the light that passes on either side of the convex `body`. A pair of points adds the
/// mixed derivative of the string between them, which is the kernel where the string is straight and zero where it
/// bends around the body: its two ends then move apart.
double crossed_strings(const StripPair& s, const std::vector<Vec2>& body) {
  const auto left = [&](const Vec2& p, const Vec2& q) { return string_length(p, q, body); };
  const auto right = [&](const Vec2& p, const Vec2& q) { return string_length(q, p, body); };
  const double one = left(s.a[0], s.b[1]) + left(s.a[1], s.b[0]) - left(s.a[0], s.b[0]) - left(s.a[1], s.b[1]);
  const double other = right(s.a[0], s.b[1]) + right(s.a[1], s.b[0]) - right(s.a[0], s.b[0]) - right(s.a[1], s.b[1]);
  return 0.5 * (one + other) / (s.a[1] - s.a[0]).norm();
}

Vec3 at_depth(const Vec2& p, double z) {
  return {p.x(), p.y(), z};
}

/// The rectangle over p–q between −depth and depth; its front lies to the left.
Polygon wall(const Vec2& p, const Vec2& q, double depth) {
  return polygon({at_depth(p, depth), at_depth(q, depth), at_depth(q, -depth), at_depth(p, -depth)});
}

/// Faces of the prism over a counter-clockwise convex outline, seen from outside.
std::vector<Polygon> prism(const std::vector<Vec2>& outline, double depth) {
  std::vector<Polygon> faces;
  std::vector<Vec3> back, front;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    faces.push_back(wall(outline[(i + 1) % outline.size()], outline[i], depth));
    back.push_back(at_depth(outline[outline.size() - 1 - i], -depth));
    front.push_back(at_depth(outline[i], depth));
  }
  faces.push_back(polygon(back));
  faces.push_back(polygon(front));
  return faces;
}

/// A strip on y = 0 that looks up, and one above that looks down at it, both wholly in front of one another.
StripPair random_strips(std::mt19937_64& random) {
  const double lean = 0.8 * unit(random) - 0.4, width = 0.4 + 0.6 * unit(random);
  const double shift = unit(random) - 0.5, height = 0.7 + unit(random);
  const Vec2 b(shift, height);
  return {{Vec2(0, 0), Vec2(1, 0)}, {b, b + width * Vec2(std::cos(lean), std::sin(lean))}};
}

/// A segment or a parallelogram between the strips, or a segment with its foot on the lower one.
enum class Body { plate, box, standing };
std::vector<Vec2> random_body(const StripPair& s, Body kind, std::mt19937_64& random) {
  const double low = 0.15 + 0.7 * unit(random), high = unit(random), up = 0.3 + 0.4 * unit(random);
  const double angle = std::numbers::pi * unit(random);
  const Vec2 foot(low, 0), middle = foot + up * (s.b[0] + high * (s.b[1] - s.b[0]) - foot);
  const Vec2 along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
  const double thick = 0.3 + 0.7 * unit(random);
  for (double size = 0.1 + 0.3 * unit(random);; size *= 0.75) {
    std::vector<Vec2> body;
    if (kind == Body::standing) {
      body = {foot, foot + 2 * size * Vec2(along.x(), along.y() + 0.1)};
    } else if (kind == Body::plate) {
      body = {middle - size * along, middle + size * along};
    } else {
      const Vec2 u = size * along, v = size * thick * across;
      body = {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
    }
    const auto between = [&](const Vec2& p) { return p.y() >= 0 && left_of(s.b[0], s.b[1], p) < -0.01; };
    if (std::all_of(body.begin(), body.end(), between)) return body;
  }
}

// CLAIM      IU.6-4: in the middle of a duct past plates, boxes and partitions, each as long as the duct, the factor is that
//            of crossed strings tight around the obstacle.
// ORACLE     closed form: Hottel's strings in the plane, once for the light on either side.
// TOLERANCE  the returned bound; kFrame: depths of 2^10 are rounded by 2^-43, an edge's shadow moves by a few times that;
//            and what the long strip misses of an endless one. Obstacles are longer than both, so H depends on the plane
//            alone, and what is missing is ≥ 0. With plane distance ρ and depth ζ the kernel is at most ρ²/(π (ρ² + ζ²)²)
//            ≤ ρ²/(π ζ⁴); beyond D = L − l, on both sides, over the width w: 2 w ρ²/(3 π D³).
TEST(ObstructedFormFactor, IsThatOfCrossedStringsInTheMiddleOfADuct) {
  proves({"IU.6-4"}, Oracle::closed_form,
         "Hottel's strings around 150 random plates, boxes and partitions, 1e-6 asked");
  constexpr std::uint64_t kDuctSeed = 20261123;
  constexpr double kFrame = 0x1p-36, kAsked = 1e-6, kHalf = 0.5;
  uses_seed(kDuctSeed);
  std::mt19937_64 random(kDuctSeed);
  int shadowed = 0;
  for (int i = 0; i < 150; ++i) {
    const Body kind = std::array{Body::plate, Body::box, Body::standing}[static_cast<std::size_t>(i % 3)];
    const StripPair s = random_strips(random);
    const std::vector<Vec2> body = random_body(s, kind, random);
    const double length = 200 * std::pow(4, unit(random));
    const bool turn = i % 2 == 1;
    const auto placed = [&](const Polygon& p) { return turn ? tilted(p) : p; };
    std::vector<Blocker> made;
    if (kind == Body::box) {
      std::vector<Polygon> faces;
      for (const Polygon& face : prism(body, 1.25 * length)) faces.push_back(placed(face));
      made.push_back(Blocker::solid(faces).value());
    } else {
      made.push_back(Blocker::plate(placed(wall(body[0], body[1], 1.25 * length))));
    }
    const std::vector<const Blocker*> blockers{&made.front()};
    const Polygon from = placed(wall(s.a[0], s.a[1], kHalf)), to = placed(wall(s.b[1], s.b[0], length));
    const ObstructedFormFactor f = obstructed_form_factor(from, to, blockers, {kAsked, 0});
    double farthest = 0;
    for (const Vec2& p : s.a) {
      for (const Vec2& q : s.b) farthest = std::max(farthest, (q - p).squaredNorm());
    }
    const double beyond = length - kHalf, width = (s.b[1] - s.b[0]).norm();
    const double ends = 2 * width * farthest / (3 * std::numbers::pi * beyond * beyond * beyond);
    const double strings = crossed_strings(s, body);
    EXPECT_TRUE(near(f.value, strings, f.bound + ends + kFrame)) << i;
    EXPECT_TRUE(near(f.free.value, crossed_strings(s, {{-10, 1}}), f.free.bound + ends + kFrame)) << i;
    EXPECT_TRUE(within(f.bound, kAsked * f.value)) << i;
    if (strings < 0.9 * f.free.value) ++shadowed;
  }
  EXPECT_GT(shadowed, 75) << "the test would see little";
}

// CLAIM      IU.6-4: a wall from floor to ceiling, touching both, leaves what its two sides see of one another.
// ORACLE     closed form: C-11 of the two chambers, by area.
// TOLERANCE  the returned bound, and kFrame for the tilted frame's coordinates.
TEST(ObstructedFormFactor, IsThatOfTwoChambersBesideASolidWall) {
  proves({"IU.6-4"}, Oracle::closed_form, "C-11 of chambers 0.4 and 0.3 wide beside a solid that touches both squares");
  constexpr double kFrame = 64 * 0x1p-53;
  const double truth = 0.4 * oracle::parallel_plates(0.4, 1) + 0.3 * oracle::parallel_plates(0.3, 1);
  const auto upright = [](const Vec3& p) { return Vec3(p.x(), p.z() + 0.5, p.y()); };
  for (const bool turn : {false, true}) {
    std::vector<Polygon> faces;
    for (const Polygon& face : prism({{0.4, 0}, {0.7, 0}, {0.7, 1}, {0.4, 1}}, 0.75)) {
      std::vector<Vec3> v;
      for (const Vec3& p : face.vertices()) v.insert(v.begin(), upright(p));
      faces.push_back(turn ? tilted(polygon(v)) : polygon(v));
    }
    const Blocker solid = Blocker::solid(faces).value();
    const std::vector<const Blocker*> blockers{&solid};
    const Polygon from = turn ? tilted(kFloor) : kFloor, to = turn ? tilted(kCeiling) : kCeiling;
    for (const double asked : {1e-2, 1e-4, 1e-6}) {
      const Bounded f = obstructed_form_factor(from, to, blockers, {asked, 0});
      EXPECT_TRUE(near(f.value, truth, f.bound + kFrame)) << asked;
      EXPECT_TRUE(within(f.bound, asked * f.value)) << asked;
    }
  }
}

// CLAIM      IU.6-4: a solid hides what its faces hide as plates; a face that lies in the floor or reaches through it too.
// ORACLE     metamorphic: the same boxes as six two-sided plates each.
// TOLERANCE  the two returned bounds.
TEST(ObstructedFormFactor, IsTheSamePastASolidAsPastItsFaces) {
  proves({"IU.6-4"}, Oracle::metamorphic,
         "60 random boxes, floating, on the floor and through it, as solids and as plates");
  constexpr std::uint64_t kBoxSeed = 20261124;
  constexpr double kAsked = 1e-4;
  uses_seed(kBoxSeed);
  std::mt19937_64 random(kBoxSeed);
  int shadowed = 0;
  for (int i = 0; i < 60; ++i) {
    const double angle = std::numbers::pi * unit(random), long_side = 0.05 + 0.3 * unit(random);
    const double side = 0.05 + 0.3 * unit(random), x = unit(random), y = unit(random),
                 depth = 0.05 + 0.3 * unit(random);
    const Vec2 u = long_side * Vec2(std::cos(angle), std::sin(angle)),
               v = side * Vec2(-std::sin(angle), std::cos(angle));
    const Vec2 middle(x, y);
    const double rise = std::array{0.5, depth, 0.1}[static_cast<std::size_t>(i % 3)];
    const double lean = i % 3 == 1 ? 0 : 0.6 * (unit(random) - 0.5);
    const Mat3 leaning = Eigen::AngleAxisd(lean, Vec3::UnitX()).toRotationMatrix();
    std::vector<Polygon> faces;
    for (const Polygon& face : prism({middle - u - v, middle + u - v, middle + u + v, middle - u + v}, depth)) {
      std::vector<Vec3> vertices;
      for (const Vec3& p : face.vertices()) {
        const Vec3 moved = leaning * p + Vec3(0, 0, rise);
        vertices.push_back(i % 2 == 1 ? tilted(moved) : moved);
      }
      faces.push_back(polygon(vertices));
    }
    const Polygon from = i % 2 == 1 ? tilted(kFloor) : kFloor, to = i % 2 == 1 ? tilted(kCeiling) : kCeiling;
    const Blocker solid = Blocker::solid(faces).value();
    const std::vector<const Blocker*> blockers{&solid};
    const ObstructedFormFactor one = obstructed_form_factor(from, to, blockers, {kAsked, 1e-6});
    const Bounded six = obstructed_form_factor(from, to, faces, {kAsked, 1e-6});
    EXPECT_TRUE(near(one.value, six.value, one.bound + six.bound)) << i;
    if (one.value < 0.9 * one.free.value) ++shadowed;
  }
  EXPECT_GT(shadowed, 30) << "the test would see little";
}

// CLAIM      IU.6-4: below a table the bound asked for is reached, where curves hide all of a cell and a chord of one of them
//            is too coarse by thousands of times for what is asked next.
// ORACLE     metamorphic: the same pair from the other side.
// TOLERANCE  what was asked; the two returned bounds.
TEST(ObstructedFormFactor, ReachesItsToleranceBelowATable) {
  proves({"IU.6-4"}, Oracle::metamorphic,
         "a square of floor and one of wall, past a table and two of its legs, at 1e-8");
  constexpr double kAsked = 1e-8, kDepth = 4.0 / 22, kWidth = 5.0 / 22, kHeight = 3.0 / 22;
  const Polygon wall = rectangle({2 * kWidth, 0, 14 * kHeight}, {0, 0, -kHeight}, {-kWidth, 0, 0});
  const Polygon floor = rectangle({17 * kWidth, 9 * kDepth, 0}, {kWidth, 0, 0}, {0, kDepth, 0});
  std::vector<Blocker> solids;
  using Ends = std::array<Vec3, 2>;
  for (const Ends& e : {Ends{Vec3(2.5, 1, 0.7), Vec3(4, 1.8, 0.75)}, Ends{Vec3(2.55, 1.05, 0), Vec3(2.65, 1.15, 0.7)},
                        Ends{Vec3(3.85, 1.65, 0), Vec3(3.95, 1.75, 0.7)}}) {
    std::array<Vec3, 8> v;
    for (std::size_t k = 0; k < 8; ++k) v[k] = {e[k & 1].x(), e[k / 2 & 1].y(), e[k / 4].z()};
    solids.push_back(Blocker::solid(block(v)).value());
  }
  const std::vector<const Blocker*> blockers{&solids[0], &solids[1], &solids[2]};
  const Bounded there = obstructed_form_factor(floor, wall, blockers, {0, kAsked});
  const Bounded back = obstructed_form_factor(wall, floor, blockers, {0, kAsked});
  EXPECT_TRUE(within(std::max(there.bound, back.bound), kAsked));
  const double areas = floor.area() / wall.area();
  EXPECT_TRUE(near(areas * there.value, back.value, areas * there.bound + back.bound));
}

// CLAIM      IU.6-4: a plate open at the back hides what arrives at its front as a two-sided one does, and nothing of what
//            arrives at its back; where the source lies on both of its sides, front and back share what it hides.
// ORACLE     identity: equal bits where one side alone is met; hidden by the front + hidden by the back = hidden by both.
// TOLERANCE  zero; else the three returned bounds and the free factor's, which enters four times.
TEST(ObstructedFormFactor, LetsLightThroughTheOpenBackOfAPlate) {
  proves({"IU.6-4"}, Oracle::identity, "40 random plates one-sided each way and two-sided");
  constexpr std::uint64_t kPlateSeed = 20261125;
  constexpr Tolerance kAsked{1e-5, 1e-7};
  uses_seed(kPlateSeed);
  std::mt19937_64 random(kPlateSeed);
  int both_sides = 0, one_side = 0;
  for (int i = 0; i < 40; ++i) {
    const double x = 0.1 + 0.5 * unit(random), y = 0.1 + 0.5 * unit(random), z = 0.2 + 0.5 * unit(random);
    const double rise = i % 2 == 1 ? 0.8 * (unit(random) - 0.5) : 0.1 * (unit(random) - 0.5);
    const Vec3 o(x, y, z), a(0.4, 0, rise), b(0, 0.2 + 0.2 * unit(random), 0);
    const std::vector<Polygon> up{rectangle(o, a, b)}, down{rectangle(o, b, a)};
    const auto factor = [&](const std::vector<Polygon>& plate, BlockingSides sides) {
      return obstructed_form_factor(kFloor, kCeiling, plate, kAsked, sides);
    };
    const ObstructedFormFactor both = factor(up, BlockingSides::both), back = factor(up, BlockingSides::front);
    const ObstructedFormFactor front = factor(down, BlockingSides::front);
    const double free = both.free.value;
    EXPECT_TRUE(
        near(front.value + back.value, both.value + free, front.bound + back.bound + both.bound + 4 * both.free.bound));
    ASSERT_LT(both.value, free - 100 * both.bound);
    bool below = true;  // the floor lies wholly behind `up`
    for (const Vec3& corner : kFloor.vertices()) below = below && up[0].normal().dot(corner - o) < 0;
    if (below) {
      EXPECT_TRUE(within(std::abs(back.value - free), 0)) << i;
      EXPECT_TRUE(within(std::abs(front.value - factor(down, BlockingSides::both).value), 0)) << i;
    }
    ++(below ? one_side : both_sides);
  }
  EXPECT_GE(std::min(one_side, both_sides), 5);
}

}  // namespace
}  // namespace etendue::validation
