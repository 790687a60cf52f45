// SPDX-License-Identifier: Apache-2.0
#include "etendue/meshing/ears.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "etendue/geometry/predicates.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr std::uint64_t kSeed = 0x656172732e31ULL;

using Chain = std::vector<std::uint32_t>;

/// A star with `corners` corners at random distances in [0.3, 1] × radius: simple, mostly concave.
Chain add_star(std::vector<Vec2>& points, CounterRandom& random, const Vec2& centre, double radius, int corners) {
  Chain chain;
  const double turn = random.between(0, 1);
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * (k + turn) / corners;
    chain.push_back(static_cast<std::uint32_t>(points.size()));
    points.emplace_back(centre + radius * random.between(0.3, 1) * Vec2(std::cos(angle), std::sin(angle)));
  }
  return chain;
}

double twice_area(const std::vector<Vec2>& points, const Chain& chain) {
  double sum = 0;
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const Vec2 &a = points[chain[k]], &b = points[chain[(k + 1) % chain.size()]];
    sum += a.x() * b.y() - b.x() * a.y();
  }
  return sum;
}

/// Is the point within the chain? By the angles under which its edges are seen, which the code under test does not use.
bool is_around(const std::vector<Vec2>& points, const Chain& chain, const Vec2& p) {
  double turned = 0;
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const Vec2 a = points[chain[k]] - p, b = points[chain[(k + 1) % chain.size()]] - p;
    turned += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return std::abs(turned) > std::numbers::pi;
}

// CLAIM      Triangles of a polygon with holes are corners + 2 holes − 2, turn left, have its area, and cover each of its points once and
//            nothing else.
// ORACLE     identity: areas by the shoelace formula; random points by the angles of all edges.
// TOLERANCE  1e-12 for areas below 40 as sums of up to 150 products; none for points: angles are summed to 1e-14, and none is that near to an edge.
TEST(Ears, CoverPolygonsWithHolesOnce) {
  proves({}, Oracle::identity, "shoelace formula; angles around random points, 200 polygons with up to nine holes");
  uses_seed(kSeed);
  CounterRandom random(kSeed);
  std::uint64_t wrong = 0, decided = 0;
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Vec2> points;
    // Corners are 3 from the middle or farther, 60° apart or less, so edges are 2.59 or farther; holes are within 1.91.
    Chain outline;
    const int corners = 9 + trial % 20;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * (k + random.between(0, 0.5)) / corners;
      outline.push_back(static_cast<std::uint32_t>(k));
      points.emplace_back(random.between(3, 4) * Vec2(std::cos(angle), std::sin(angle)));
    }
    std::vector<Chain> holes;
    double area = twice_area(points, outline);
    for (int k = 0; k < trial % 10; ++k) {
      holes.push_back(add_star(points, random, Vec2(k % 3 - 1, k / 3 - 1), 0.49, 3 + (trial + k) % 8));
      area -= twice_area(points, holes.back());
      if (k % 2 == 0) std::reverse(holes.back().begin(), holes.back().end());  // either way round
    }
    const auto triangles = ears(points, outline, holes);
    EXPECT_TRUE(holds(triangles.size() == points.size() + 2 * holes.size() - 2));
    double sum = 0;
    for (const auto& t : triangles) {
      const Chain chain(t.begin(), t.end());
      EXPECT_TRUE(holds(orientation(points[t[0]], points[t[1]], points[t[2]]) > 0)) << trial;
      sum += twice_area(points, chain);
    }
    EXPECT_TRUE(near(sum, area, 1e-12)) << trial;
    for (int k = 0; k < 100; ++k) {
      const Vec2 p(random.between(-4, 4), random.between(-4, 4));
      bool is_in = is_around(points, outline, p);
      for (const Chain& hole : holes) is_in = is_in && !is_around(points, hole, p);
      int covered = 0;
      for (const auto& t : triangles) covered += is_around(points, Chain(t.begin(), t.end()), p);
      wrong += covered != (is_in ? 1 : 0);
      ++decided;
    }
  }
  EXPECT_TRUE(all_agree(wrong, decided));
}

// CLAIM      A bridge goes past holes in between, also where corners stand on one line: a grid of square holes, whose corners do.
// ORACLE     closed form: the area that is left.
// TOLERANCE  none: halves of whole numbers.
TEST(Ears, PassHolesOnOneLine) {
  proves({}, Oracle::closed_form, "121 − 25 squares of area 1");
  std::vector<Vec2> points{{0, 0}, {11, 0}, {11, 11}, {0, 11}};
  std::vector<Chain> holes;
  for (int k = 0; k < 25; ++k) {
    const Vec2 low(1 + 2 * (k % 5), 1 + 2 * (k / 5));
    Chain hole(4);
    std::iota(hole.begin(), hole.end(), static_cast<std::uint32_t>(points.size()));
    for (const Vec2& corner : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}) points.push_back(low + corner);
    holes.push_back(hole);
  }
  double sum = 0;
  for (const auto& t : ears(points, {0, 1, 2, 3}, holes)) {
    const double twice = twice_area(points, Chain(t.begin(), t.end()));
    EXPECT_TRUE(holds(twice >= 0));
    sum += twice / 2;
  }
  EXPECT_TRUE(near(sum, 121 - 25, 0));
}

}  // namespace
}  // namespace etendue::validation
