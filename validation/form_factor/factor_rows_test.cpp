// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/factor_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/difference_rule.hpp"
#include "etendue/form_factor/gauss_legendre.hpp"
#include "etendue/form_factor/polygon_polygon.hpp"
#include "form_factor/shapes.hpp"
#include "oracles/pair_form_factor.hpp"
#include "reference/pair_geometry.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

/// Parallelograms all over a cube of side `spread`, turned every way, some of them no parallelograms.
std::vector<Polygon> scattered(std::size_t count, double spread, std::size_t family) {
  pairs::Random random(family, count);
  std::vector<Polygon> result;
  const auto point = [&](double size) {
    return Vec3(random.between(-size, size), random.between(-size, size), random.between(-size, size));
  };
  while (result.size() < count) {
    const Vec3 o = point(spread), a = point(1);
    Vec3 b = point(1);
    b -= random.between(0.5, 1) * a.dot(b) / a.squaredNorm() * a;
    const bool triangle = result.size() % 16 == 5;
    auto made =
        Polygon::make(triangle ? std::vector<Vec3>{o, o + a, o + b} : std::vector<Vec3>{o, o + a, o + a + b, o + b});
    if (made.ok()) result.push_back(*made);
  }
  return result;
}

std::vector<std::uint32_t> all_columns(const FactorRows& rows) {
  std::vector<std::uint32_t> columns(rows.size());
  std::iota(columns.begin(), columns.end(), 0u);
  return columns;
}

double factor_in_balls(const Polygon& from, const Polygon& to) {
  std::array<std::vector<oracle::Point>, 2> points;
  for (const Vec3& v : from.vertices()) points[0].push_back({v.x(), v.y(), v.z()});
  for (const Vec3& v : to.vertices()) points[1].push_back({v.x(), v.y(), v.z()});
  return oracle::pair_form_factor(points[0], points[1], 0).factor;
}

using PolygonPair = std::pair<Polygon, Polygon>;
const std::vector<std::uint32_t> kSecond{1};

std::vector<Vec3> moved(const std::vector<Vec3>& vertices, int frame) {
  std::vector<Vec3> result;
  for (const Vec3& v : vertices) {
    if (frame == 0) result.push_back(v);
    if (frame == 1) result.push_back(tilted(v));
    if (frame >= 2) result.push_back(tilted(v) + Vec3(2000, -1000, 500));  // coordinates are rounded to 2^-42
  }
  return result;
}

/// Rectangles with edges along one frame: perpendicular ones, or opposite ones, from touching planes to far away, of equal
/// lengths or not, first corner and order of edges by chance. Every frame but the first rounds the corners; in the fourth the
/// second is turned a little.
std::vector<PolygonPair> aligned(std::size_t count, std::size_t family, int frame) {
  pairs::Random random(family, count);
  std::vector<PolygonPair> result;
  while (result.size() < count) {
    const bool opposite = random.below(2) == 0, equal = random.below(3) != 0;
    const auto length = [&] { return random.between(0.2, 1); };
    const double a = length(), b = length(), c = equal ? a : length(), d = opposite && equal ? b : length();
    const double near = random.below(4) == 0 ? 0.0 : random.between(0.05, 1);
    const double distance = near * std::ldexp(1.0, static_cast<int>(random.below(8)));
    const double x = random.between(-1, 1) * (0.5 + distance), y = random.between(-1, 1) * (0.5 + distance);
    const double up = random.below(3) == 0 ? 0.0 : random.between(0, 1 + distance);
    std::vector<Vec3> from{{0, 0, 0}, {a, 0, 0}, {a, b, 0}, {0, b, 0}}, to;
    if (opposite) {
      const double z = 0.1 + distance;
      to = {{x, y, z}, {x, y + d, z}, {x + c, y + d, z}, {x + c, y, z}};
    } else {  // at x' = b + distance, looking back
      const double z = b + distance;
      to = {{x, z, up}, {x + c, z, up}, {x + c, z, up + d}, {x, z, up + d}};
    }
    if (frame == 3) {
      const double turn = std::ldexp(random.between(-1, 1), -21), lean = std::ldexp(random.between(-1, 1), -21);
      const Mat3 slight = (Eigen::AngleAxisd(turn, Vec3::UnitX()) * Eigen::AngleAxisd(lean, Vec3::UnitZ())).matrix();
      for (Vec3& v : to) v = slight * v;
    }
    std::rotate(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(random.below(4)), from.end());
    std::rotate(to.begin(), to.begin() + static_cast<std::ptrdiff_t>(random.below(4)), to.end());
    result.emplace_back(polygon(moved(from, frame)), polygon(moved(to, frame)));
  }
  return result;
}

/// Perpendicular rectangles near one another: beside a long edge the distance of the centres says little.
std::vector<PolygonPair> near_and_narrow(std::size_t count, std::size_t family) {
  pairs::Random random(family, count);
  const auto log_even = [&](double low, double high) { return low * std::pow(high / low, random.between(0, 1)); };
  const auto gap = [&] { return random.below(3) == 0 ? 0.0 : log_even(0.01, 1); };
  std::vector<PolygonPair> result;
  while (result.size() < count) {
    const double a = log_even(0.05, 3), b = log_even(0.05, 3), c = random.below(2) == 0 ? a : log_even(0.05, 3);
    const double d = log_even(0.05, 3), y = b + gap(), z = gap(), aside = gap();
    const double x = random.below(2) == 0 ? a + aside : random.between(-c, a);
    result.emplace_back(rectangle({0, 0, 0}, {a, 0, 0}, {0, b, 0}), rectangle({x, y, z}, {c, 0, 0}, {0, 0, d}));
  }
  return result;
}

// CLAIM      IU.6-3: the rows hold what the contour finds, within their bounds, and reach the tolerance.
// ORACLE     form_factor() of boundaries, which knows no product rule, at 1e-12; held against balls elsewhere.
// TOLERANCE  the two returned bounds; the bound itself: what was asked of the value.
TEST(FactorRows, HoldWhatSinglePairsGive) {
  proves({"IU.6-3"}, Oracle::program,
         "form_factor() of boundaries at 1e-12, 200 scattered parallelograms at four tolerances");
  constexpr std::size_t kFamily = 20;
  uses_seed(pairs::kSeed);
  for (const double spread : {3.0, 12.0}) {
    const std::vector<Polygon> polygons = scattered(100, spread, kFamily);
    const FactorRows rows(polygons);
    const std::vector<std::uint32_t> columns = all_columns(rows);
    std::vector<Bounded> found(columns.size());
    for (std::size_t i = 0; i < polygons.size(); i += 7) {
      std::vector<Bounded> truth;
      for (const Polygon& to : polygons) {
        truth.push_back(form_factor(Boundary{polygons[i].vertices()}, Boundary{to.vertices()}, {1e-12, 0}));
      }
      for (const double asked : {1e-2, 1e-4, 1e-6, 1e-9}) {
        rows.row(i, columns, {asked, 0}, found);
        for (std::size_t j = 0; j < columns.size(); ++j) {
          ASSERT_TRUE(near(found[j].value, truth[j].value, found[j].bound + truth[j].bound)) << i << ' ' << j;
          ASSERT_TRUE(within(found[j].bound, asked * found[j].value + truth[j].bound)) << i << ' ' << j;
        }
      }
    }
  }
}

// CLAIM      IU.6-3: the rows have the same bits with the machine's widest vectors and with none.
// ORACLE     metamorphic: lanes only add, multiply and divide.
// TOLERANCE  none: bitwise equal.
TEST(FactorRows, HaveTheSameBitsWithEveryInstructionSet) {
  proves({"IU.6-3"}, Oracle::metamorphic, "portable against widest instructions, bitwise");
  std::vector<Polygon> polygons = scattered(120, 8, 21);
  for (const auto& [from, to] : aligned(60, 28, 1)) {
    polygons.push_back(from);
    polygons.push_back(to);
  }
  const FactorRows wide(polygons), portable(polygons, Instructions::portable);
  const std::vector<std::uint32_t> columns = all_columns(wide);
  std::vector<Bounded> a(columns.size()), b(columns.size());
  std::uint64_t mismatches = 0, decisions = 0;
  for (std::size_t i = 0; i < polygons.size(); i += 5) {
    wide.row(i, columns, {1e-6, 0}, a);
    portable.row(i, columns, {1e-6, 0}, b);
    for (std::size_t j = 0; j < columns.size(); ++j) {
      if (a[j].value != b[j].value || a[j].bound != b[j].bound) ++mismatches;
      ++decisions;
    }
  }
  EXPECT_TRUE(all_agree(mismatches, decisions));
}

// CLAIM      IU.6-6: the rows of an empty room sum up to one, in exact coordinates, in a frame that rounds them, and far
//            from the origin.
// ORACLE     identity: closure.
// TOLERANCE  the sum of the returned bounds, itself below what was asked.
TEST(FactorRows, CloseAnEmptyRoom) {
  proves({"IU.6-6", "IU.6-3"}, Oracle::identity, "Σ_j F_ij = 1 in a room of 6 × 8 × 8 rectangles, three frames");
  constexpr double kAsked = 1e-9;
  constexpr int kSide = 8;
  for (int frame = 0; frame < 3; ++frame) {
    std::vector<Polygon> polygons;
    const auto wall = [&](const Vec3& o, const Vec3& a, const Vec3& b) {
      for (int i = 0; i < kSide; ++i) {
        for (int j = 0; j < kSide; ++j) {
          const Polygon patch = rectangle(o + a * i / kSide + b * j / kSide, a / kSide, b / kSide);
          std::vector<Vec3> moved;
          for (const Vec3& v : patch.vertices()) moved.push_back(frame == 2 ? Vec3(v + Vec3(1 << 20, 0, 3)) : v);
          polygons.push_back(frame == 1 ? tilted(patch) : polygon(moved));
        }
      }
    };
    const Vec3 x(1, 0, 0), y(0, 2, 0), z(0, 0, 1), o(0, 0, 0);
    wall(o, x, y);
    wall(z, y, x);
    wall(o, z, x);
    wall(y, x, z);
    wall(o, y, z);
    wall(x, z, y);
    const FactorRows rows(polygons);
    const std::vector<std::uint32_t> columns = all_columns(rows);
    std::vector<Bounded> row(columns.size());
    for (std::size_t i = 0; i < polygons.size(); i += 11) {
      rows.row(i, columns, {kAsked, 0}, row);
      double sum = 0, bound = 0;
      for (const Bounded& f : row) {
        sum += f.value;
        bound += f.bound;
      }
      EXPECT_TRUE(near(sum, 1, bound + 0x1p-44)) << i;
      EXPECT_TRUE(within(bound, kAsked)) << i;
    }
  }
}

// CLAIM      The rule for differences is exact for monomials below w^(2n), and errs by difference_remainder(n) on w^(2n).
// ORACLE     exact: ∫ (2 − |w|) w^(2k) dw = 2^(2k+3)/((2k + 1)(2k + 2)), a quotient of integers; odd ones cancel.
// TOLERANCE  nodes and weights within one unit in the last place: (2k + 1) roundings of a power's terms, one of the weight,
//            n of the sum; the remainder within as much of the moment that it is the rest of.
TEST(DifferenceRule, IsExactToItsDegreeAndErrsByItsRemainder) {
  proves({}, Oracle::exact, "moments of the density of a difference, as quotients of integers");
  for (int n = 1; n <= kMostDifferenceNodes; ++n) {
    for (int k = 0; k <= n; ++k) {
      long double even = 0, odd = 0;
      for (const QuadratureNode& node : gauss_difference(n)) {
        long double power = node.weight;
        for (int i = 0; i < 2 * k; ++i) power *= node.x;
        even += power;
        odd += power * node.x;
      }
      const long double moment = std::ldexp(1.0L, 2 * k + 3) / ((2 * k + 1.0L) * (2 * k + 2.0L));
      const double allowed = 2 * (2 * k + n + 2) * kUnitRoundoff * static_cast<double>(moment);
      EXPECT_TRUE(near(static_cast<double>(odd), 0, 2 * allowed)) << n << ' ' << k;
      if (k < n) {
        EXPECT_TRUE(within(static_cast<double>(std::abs(even - moment)), allowed)) << n << ' ' << k;
      } else {
        EXPECT_TRUE(near(difference_remainder(n), static_cast<double>(moment - even), allowed)) << n;
      }
    }
  }
}

// CLAIM      The Gauss-Legendre rule of n points errs by legendre_remainder(n) on x^(2n).
// ORACLE     exact: ∫ x^(2n) dx = 2/(2n + 1).
// TOLERANCE  as above: the remainder is within that of the moment which it is the rest of.
TEST(DifferenceRule, HasLegendresRemainderBeside) {
  proves({}, Oracle::exact, "moments of a segment");
  for (int n = 1; n <= 12; ++n) {
    long double sum = 0;
    for (const QuadratureNode& node : gauss_legendre(n)) {
      long double power = node.weight;
      for (int i = 0; i < 2 * n; ++i) power *= node.x;
      sum += power;
    }
    const long double moment = 2 / (2 * n + 1.0L);
    EXPECT_TRUE(near(legendre_remainder(n), static_cast<double>(moment - sum),
                     2 * (3 * n + 2) * kUnitRoundoff * static_cast<double>(moment)))
        << n;
  }
}

// CLAIM      IU.6-3: pairs of rectangles in one frame keep their bounds, perpendicular and opposite, near and far, of equal
//            and of unequal lengths; in a frame that rounds the corners too, where it rounds them roughly, and where
//            one is turned a little.
// ORACLE     form_factor() of boundaries, which knows no rule for aligned pairs, at 1e-12; below, balls.
// TOLERANCE  the two returned bounds; the bound itself: what was asked of the value.
TEST(FactorRows, HoldTheirBoundsForAlignedPairs) {
  proves({"IU.6-3"}, Oracle::program, "form_factor() of boundaries at 1e-12, 1200 pairs aligned in four frames");
  uses_seed(pairs::kSeed);
  for (int frame = 0; frame < 4; ++frame) {
    for (const auto& [from, to] : aligned(300, 23, frame)) {
      const Bounded truth = form_factor(Boundary{from.vertices()}, Boundary{to.vertices()}, {1e-12, 0});
      for (const double asked : {1e-4, 1e-6, 1e-9, 1e-12}) {
        std::vector<Bounded> found(1);
        FactorRows({from, to}).row(0, kSecond, {asked, 0}, found);
        ASSERT_TRUE(near(found[0].value, truth.value, found[0].bound + truth.bound)) << frame;
        ASSERT_TRUE(within(found[0].bound, asked * found[0].value + truth.bound)) << frame;
      }
    }
  }
}

// CLAIM      IU.6-3: perpendicular pairs of unlike edges keep their bounds near by: these follow from the nearest points.
// ORACLE     form_factor() of boundaries at 1e-12, in 500 pairs; the contour at 600 bits in balls, in 25 of them.
// TOLERANCE  the returned bounds, and one rounding of the truth in balls, which is below one.
TEST(FactorRows, HoldTheirBoundsForNarrowPairsNearBy) {
  proves({"IU.6-3"}, Oracle::closed_form, "500 perpendicular pairs with edges 0.05 to 3, 25 against balls");
  uses_seed(pairs::kSeed);
  std::size_t index = 0;
  for (const auto& [from, to] : near_and_narrow(500, 29)) {
    const Bounded truth = form_factor(Boundary{from.vertices()}, Boundary{to.vertices()}, {1e-12, 0});
    std::vector<Bounded> found(1);
    for (const double asked : {1e-9, 1e-6, 1e-4, 1e-2}) {
      FactorRows({from, to}).row(0, kSecond, {asked, 0}, found);
      ASSERT_TRUE(near(found[0].value, truth.value, found[0].bound + truth.bound)) << index;
      if (index++ % 81 != 0) continue;
      ASSERT_TRUE(near(found[0].value, factor_in_balls(from, to), found[0].bound + kUnitRoundoff)) << index;
    }
  }
}

// CLAIM      IU.6-3: the same at the tightest tolerance, and at a loose one, against proved truth.
// ORACLE     closed form in balls: the contour at 600 bits, of the very corners (oracles/pair_form_factor.hpp).
// TOLERANCE  the returned bound, and one rounding of the truth.
TEST(FactorRows, HoldTheirBoundsForAlignedPairsAgainstBalls) {
  proves({"IU.6-3"}, Oracle::closed_form, "the contour at 600 bits, 40 pairs aligned in exact coordinates");
  for (const auto& [from, to] : aligned(40, 24, 0)) {
    const double truth = factor_in_balls(from, to);
    for (const double asked : {1e-4, 1e-8, 1e-12}) {
      std::vector<Bounded> found(1);
      FactorRows({from, to}).row(0, kSecond, {asked, 0}, found);
      ASSERT_TRUE(near(found[0].value, truth, found[0].bound + kUnitRoundoff * truth));
    }
  }
}

// CLAIM      A pair's factor has the same bits whatever is asked beside it, in whatever order, and alone; and after
//            scaling by a power of two.
// ORACLE     metamorphic: single calls, the reverse order, form_factor(); coordinates times 2^±20.
// TOLERANCE  none: bitwise equal.
TEST(FactorRows, DependOnNothingButThePair) {
  proves({"IU.6-3"}, Oracle::metamorphic, "order, company and scale by powers of two, bitwise");
  std::vector<Polygon> polygons = scattered(40, 6, 25);
  for (const auto& [from, to] : aligned(30, 26, 1)) {
    polygons.push_back(from);
    polygons.push_back(to);
  }
  const Tolerance asked{1e-7, 0};
  std::vector<IndexPair> forth;
  for (std::uint32_t i = 0; i < polygons.size(); i += 3) {
    for (std::uint32_t j = i % 2; j < polygons.size(); j += 2) {
      if (i != j) forth.push_back({i, j});
    }
  }
  const std::vector<IndexPair> back(forth.rbegin(), forth.rend());
  const auto all = [&](const std::vector<Polygon>& set, const std::vector<IndexPair>& pairs) {
    std::vector<Bounded> found(pairs.size());
    FactorRows(set).pairs(pairs, asked, AbsoluteError::of_this, found);
    return found;
  };
  const std::vector<Bounded> one = all(polygons, forth), other = all(polygons, back);
  std::uint64_t mismatches = 0, decisions = 0;
  const auto compare = [&](const Bounded& a, const Bounded& b) {
    mismatches += a.value != b.value || a.bound != b.bound;
    ++decisions;
  };
  for (std::size_t k = 0; k < forth.size(); ++k) {
    compare(one[k], other[forth.size() - 1 - k]);
    compare(one[k], form_factor(polygons[forth[k].from], polygons[forth[k].to], asked));
  }
  for (const double scale : {0x1p-20, 0x1p20}) {
    std::vector<Polygon> scaled;
    for (const Polygon& p : polygons) {
      std::vector<Vec3> vertices = p.vertices();
      for (Vec3& v : vertices) v *= scale;
      scaled.push_back(polygon(vertices));
    }
    const std::vector<Bounded> found = all(scaled, forth);
    for (std::size_t k = 0; k < forth.size(); ++k) compare(one[k], found[k]);
  }
  EXPECT_TRUE(all_agree(mismatches, decisions));
}

// CLAIM      Asked of both factors, the absolute error holds for the one back as well: it is the smaller surface's.
// ORACLE     exact: the bound times A_1 against the tolerance times the smaller area.
// TOLERANCE  none: decisions; some pairs must need it.
TEST(FactorRows, KeepTheAbsoluteErrorOfBothFactors) {
  proves({"IU.6-5"}, Oracle::exact, "bounds of exchange areas against the smaller area");
  const Tolerance asked{0, 1e-5};
  std::uint64_t wrong = 0, decisions = 0, needed = 0;
  for (const auto& [from, to] : aligned(200, 27, 1)) {
    const FactorRows rows({from, to});
    const std::vector<IndexPair> pair{{0, 1}};
    std::vector<Bounded> both(1), one(1);
    rows.pairs(pair, asked, AbsoluteError::of_both, both);
    rows.pairs(pair, asked, AbsoluteError::of_this, one);
    const double most = asked.absolute * std::min(from.area(), to.area()) * (1 + 0x1p-50);
    wrong += both[0].bound * from.area() > most || one[0].bound > asked.absolute;
    needed += one[0].bound * from.area() > most;
    ++decisions;
  }
  EXPECT_TRUE(all_agree(wrong, decisions));
  EXPECT_GT(needed, 3u);
}

// CLAIM      IU.6-3: rows refuse tolerances below zero, indices out of range and spans that do not fit.
// ORACLE     exact: the contract.
// TOLERANCE  none: decisions.
TEST(FactorRows, RefuseWhatDoesNotFit) {
  proves({"IU.6-3"}, Oracle::exact, "four broken calls");
  const FactorRows rows(scattered(4, 3, 22));
  std::vector<Bounded> out(1);
  const std::vector<std::uint32_t> one{1}, far{4};
  EXPECT_TRUE(refuses([&] { rows.row(0, one, {-1, 0}, out); }));
  EXPECT_TRUE(refuses([&] { rows.row(4, one, {}, out); }));
  EXPECT_TRUE(refuses([&] { rows.row(0, far, {}, out); }));
  out.resize(2);
  EXPECT_TRUE(refuses([&] { rows.row(0, one, {}, out); }));
}

}  // namespace
}  // namespace etendue::validation
