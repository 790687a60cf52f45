// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/factor_rows.hpp"

#include <cmath>
#include <numeric>
#include <vector>

#include "etendue/form_factor/polygon_polygon.hpp"
#include "form_factor/shapes.hpp"
#include "reference/pair_families.hpp"
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
  const std::vector<Polygon> polygons = scattered(120, 8, 21);
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
