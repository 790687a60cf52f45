// SPDX-License-Identifier: Apache-2.0
#include "etendue/raster/scan.hpp"

#include <CGAL/Gmpq.h>

#include <random>
#include <vector>

#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

using Rational = CGAL::Gmpq;
constexpr int kSide = 16;

// Corners on the subpixel grid: where scan() decides exactly. Every third lies on a pixel centre or in its row or
// column.
Vec2 grid_point(std::mt19937_64& random) {
  const auto coordinate = [&] {
    const auto fine = static_cast<double>(random() % (kSide * 4096)) / 4096;
    return random() % 3 == 0 ? std::floor(fine) + 0.5 : fine;
  };
  const double x = coordinate();
  return {x, coordinate()};
}

// Sign of twice the area of a, b, c in rationals.
int turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Rational value = (Rational(b.x()) - Rational(a.x())) * (Rational(c.y()) - Rational(a.y())) -
                         (Rational(b.y()) - Rational(a.y())) * (Rational(c.x()) - Rational(a.x()));
  return CGAL::sign(value);
}

struct Counts {
  std::vector<int> times = std::vector<int>(kSide * kSide, 0);
  void draw(const Vec2& a, const Vec2& b, const Vec2& c) {
    scan({a, b, c}, kSide, kSide,
         [&](const Covered& p) { ++times[static_cast<std::size_t>(p.row * kSide + p.column)]; });
  }
};

// CLAIM      Scan conversion: centres strictly inside a triangle are covered once, those outside never.
// ORACLE     exact arithmetic: signs of areas in rationals.
// TOLERANCE  none: 76,800 pixels of 300 triangles are yes or no. Centres on an edge are left to the next test.
TEST(Scan, AgreesWithExactPointInTriangle) {
  proves({"IU.6.5"}, Oracle::exact, "signs of areas in rationals (GMP)");
  std::mt19937_64 random(50);
  std::uint64_t wrong = 0, decided = 0, on_edge = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Vec2 a = grid_point(random), b = grid_point(random), c = grid_point(random);
    Counts counts;
    counts.draw(a, b, c);
    const int orientation = turn(a, b, c);
    for (int row = 0; row < kSide; ++row) {
      for (int column = 0; column < kSide; ++column) {
        const Vec2 p(column + 0.5, row + 0.5);
        const int s[] = {turn(a, b, p) * orientation, turn(b, c, p) * orientation, turn(c, a, p) * orientation};
        const int times = counts.times[static_cast<std::size_t>(row * kSide + column)];
        const bool outside = orientation == 0 || s[0] < 0 || s[1] < 0 || s[2] < 0;
        const bool inside = orientation != 0 && s[0] > 0 && s[1] > 0 && s[2] > 0;
        if (!outside && !inside) {
          ++on_edge;
          continue;
        }
        wrong += times != (inside ? 1 : 0);
        ++decided;
      }
    }
  }
  EXPECT_GT(on_edge, 50u) << "the family is made to hit edges";
  EXPECT_TRUE(all_agree(wrong, decided));
}

// CLAIM      Top-left rule: triangles that share edges around a common corner cover each centre inside their union
//            once, those on shared edges and on the common corner too.
// ORACLE     exact arithmetic: a fan around a point inside a convex hull covers the hull's interior.
// TOLERANCE  none: every centre is covered once, not less, not twice.
TEST(Scan, CoversSharedEdgesExactlyOnce) {
  proves({"IU.6.5"}, Oracle::exact, "each centre in the interior of a square belongs to one triangle of its fan");
  std::mt19937_64 random(51);
  const Vec2 corner[] = {{0, 0}, {kSide, 0}, {kSide, kSide}, {0, kSide}};
  std::uint64_t wrong = 0, decided = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Vec2 hub = grid_point(random);
    std::vector<Vec2> rim;
    for (int k = 0; k < 4; ++k) {
      rim.push_back(corner[k]);
      const double t = static_cast<double>(1 + random() % 15) / 16;
      rim.push_back(corner[k] + t * (corner[(k + 1) % 4] - corner[k]));
    }
    Counts counts;
    for (std::size_t k = 0; k < rim.size(); ++k) {
      if (random() % 2)
        counts.draw(hub, rim[k], rim[(k + 1) % rim.size()]);
      else
        counts.draw(rim[(k + 1) % rim.size()], rim[k], hub);
    }
    for (const int times : counts.times) {
      wrong += times != 1;
      ++decided;
    }
  }
  EXPECT_TRUE(all_agree(wrong, decided));
}

// CLAIM      The weights are barycentric coordinates of the centre, whatever the orientation, also beyond the picture.
// ORACLE     closed form: Σ λ_k corner_k is the centre.
// TOLERANCE  each weight is one rounding of an exact quotient, at most 1: 3 roundings of the coordinates, at most 40.
TEST(Scan, WeightsReproduceThePixelCentre) {
  proves({"IU.6.5"}, Oracle::closed_form, "barycentric combination of the corners");
  std::mt19937_64 random(52);
  for (int trial = 0; trial < 200; ++trial) {
    std::array<Vec2, 3> corners;
    for (Vec2& corner : corners) corner = 2.5 * grid_point(random) - Vec2(12, 12);
    for (Vec2& corner : corners) corner = (corner * 4096).array().round() / 4096;
    scan(corners, kSide, kSide, [&](const Covered& p) {
      const Vec2 centre = p.weight[0] * corners[0] + p.weight[1] * corners[1] + p.weight[2] * corners[2];
      EXPECT_TRUE(within((centre - Vec2(p.column + 0.5, p.row + 0.5)).cwiseAbs().maxCoeff(), 6 * 40 * 0x1p-53));
    });
  }
}

}  // namespace
}  // namespace etendue::validation
