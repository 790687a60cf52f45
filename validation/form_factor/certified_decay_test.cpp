// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/certified_decay.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/certified_contour.hpp"
#include "etendue/form_factor/edge_decay.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr std::uint64_t kSeed = 20261203;
constexpr int kPairs = 400;

Vec3 place(CounterRandom& random, double half) {
  const double x = random.between(-half, half), y = random.between(-half, half), z = random.between(-half, half);
  return {x, y, z};
}

Triple<double> triple(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

/// Four corners of two edges, every other pair brought close to each other, every fifth nearly parallel.
struct Corners {
  Vec3 a, b, c, d;

  EnclosedEdges enclosed() const { return enclosed_edges(Interval3(a), Interval3(b), Interval3(c), Interval3(d)); }
  EnclosedPiece whole() const {
    const EnclosedEdges e = enclosed();
    return {Interval3(Vec3::Zero()), e.outer, e.outer_length};
  }
  Edge<double> outer() const { return make_edge(triple(a), triple(b)); }
  Edge<double> inner() const { return make_edge(triple(c), triple(d)); }
};
Corners corners(CounterRandom& random, int k) {
  Corners found{place(random, 1), place(random, 1), place(random, 1), place(random, 1)};
  if (k % 2 == 0) found.c = 0.5 * (found.a + found.b) + place(random, 0.1);
  if (k % 5 == 0) found.d = found.c + (found.b - found.a) + place(random, 0.2);
  return found;
}

// CLAIM      the decays in intervals are those in doubles: the same ellipses, never larger ones, and the same weights, which here are
//            shares of the inner edge's length.
// ORACLE     another method: edge_decay.hpp, in doubles with margins of its own, itself judged by the coefficients.
// TOLERANCE  1e-6 of rho − 1 and of the weight: the doubles know the foot of the plain one to 2^-20 of the edge, and their roundings
//            are divided by the square of the sine, which is above 1e-3 where it counts.
TEST(CertifiedDecay, IsThatOfTheDoubles) {
  proves({}, Oracle::program, "edge_decay.hpp for 400 pairs of edges");
  uses_seed(kSeed);
  CounterRandom random(kSeed);
  constexpr double kAlike = 1e-6;
  double plain_off = 0, bent_off = 0, weight_off = 0;
  int bent_ones = 0;
  for (int k = 0; k < kPairs; ++k) {
    const Corners pair = corners(random, k);
    const CertifiedDecay plain = certified_plain_decay(pair.enclosed(), pair.whole());
    const double expected = plain_decay(pair.outer(), pair.inner()).rho;
    plain_off = std::max(plain_off, std::abs(plain.rho - expected) / (expected - 1));
    EXPECT_TRUE(holds(plain.weight == 1 && plain.extra == 0));
    const double sine = norm(cross(pair.outer().direction, pair.inner().direction));
    const Decay other = bent_decay(pair.outer(), pair.inner());
    if (sine < 1e-3 || !(other.rho > 1)) continue;
    ++bent_ones;
    const CertifiedDecay bent = certified_bent_decay(pair.enclosed(), pair.whole());
    bent_off = std::max(bent_off, std::abs(bent.rho - other.rho) / (other.rho - 1));
    weight_off = std::max(weight_off, std::abs(bent.weight * pair.inner().length / other.weight - 1));
    EXPECT_TRUE(holds(bent.extra == 0));
  }
  EXPECT_GT(bent_ones, kPairs / 2);
  EXPECT_TRUE(within(plain_off, kAlike));
  EXPECT_TRUE(within(bent_off, kAlike));
  EXPECT_TRUE(within(weight_off, kAlike));
}

// CLAIM      pieces decay like edges of their own: halves of the outer edge like edges between the same points.
// ORACLE     metamorphic: the same bounds for the piece as a whole edge; moved to the origin it is the same but for roundings.
// TOLERANCE  1e-8 of rho − 1 and of the weight: a hundred roundings, 1e-14, times up to 1e4, one over the square of a sine above 1e-2,
//            and over rho − 1, which is above 0.015 where it counts.
TEST(CertifiedDecay, TakesPiecesForEdges) {
  proves({}, Oracle::metamorphic, "quarters of 200 edges as edges of their own");
  uses_seed(kSeed + 1);
  CounterRandom random(kSeed + 1);
  constexpr double kAlike = 1e-8;
  double off = 0, weight_off = 0;
  for (int k = 0; k < kPairs / 2; ++k) {
    Corners pair = corners(random, k);
    const EnclosedEdges whole = pair.enclosed();
    const double from = 0.25 * (k % 4), to = from + 0.25;
    const EnclosedPiece piece{Interval(from) * whole.outer, Interval(to) * whole.outer,
                              Interval(0.25) * whole.outer_length};
    const Vec3 way = pair.b - pair.a;
    const Corners own{pair.a + from * way, pair.a + to * way, pair.c, pair.d};
    if (norm(cross(own.outer().direction, own.inner().direction)) < 1e-2) continue;
    const auto compare = [&](const CertifiedDecay& one, const CertifiedDecay& other) {
      if (!(other.rho > 1.015)) return;
      off = std::max(off, std::abs(one.rho - other.rho) / (other.rho - 1));
      weight_off = std::max(weight_off, std::abs(one.weight / other.weight - 1));
    };
    compare(certified_plain_decay(whole, piece), certified_plain_decay(own.enclosed(), own.whole()));
    compare(certified_bent_decay(whole, piece), certified_bent_decay(own.enclosed(), own.whole()));
  }
  EXPECT_TRUE(within(off, kAlike));
  EXPECT_TRUE(within(weight_off, kAlike));
}

// CLAIM      parallel edges, exactly or but for rounding, have the ellipse of the nearer end, the weight of a path that nothing but the ends
//            is near to, and pay for what was moved.
// ORACLE     closed form: two edges of length 2 at the distance 3/4, one shifted by 5/4: NOTES.md §2 and §10.
// TOLERANCE  1e-12: some dozen roundings in intervals; for the weight 2^-40 of a path of length 2, which the turn may shorten.
TEST(CertifiedDecay, MakesParallelsParallel) {
  proves({}, Oracle::closed_form, "two edges of length 2 side by side");
  const Vec3 along = Vec3(0.36, 0.48, 0.8), aside = Vec3(0.8, -0.6, 0);
  const auto pair = [&](double turn) {
    const Vec3 start = 1.25 * along + 0.75 * aside, inner = 2 * (along + turn * aside);
    return Corners{Vec3::Zero(), 2 * along, start, start + inner};
  };
  const double sum = std::hypot(1.25, 0.75) + std::hypot(0.75, 0.75), axis = sum / 2;
  const double rho = axis + std::sqrt(axis * axis - 1), weight = 1 + 0.25 * 3.14159265358979324 * (rho + 1 / rho);
  for (const double turn : {0.0, 0x1p-52}) {
    const CertifiedDecay bent = certified_bent_decay(pair(turn).enclosed(), pair(turn).whole());
    EXPECT_TRUE(near(bent.rho, rho, 1e-12)) << turn;
    EXPECT_TRUE(near(bent.weight, weight, 1e-12 + 2 * 0x1p-40)) << turn;
    EXPECT_TRUE(holds(bent.extra >= 4 * 3.14159 * turn * 2 / 2 && bent.extra <= 1e-13)) << bent.extra;
  }
}

// CLAIM      what n nodes miss is bounded by (32/15)/n ρ^(−2n)/(1 − ρ^(−2)) where the coefficients fall like (2/k) ρ^(−k), by 2n times
//            that where a function is below 1 on the ellipse; nothing is known without an ellipse.
// ORACLE     closed form: NOTES.md §2, in doubles.
// TOLERANCE  1e-13 from above: intervals of a few dozen roundings; none from below but the oracle's 8 u.
TEST(CertifiedDecay, BoundsWhatNodesMiss) {
  proves({}, Oracle::closed_form, "the bounds of Gauss's rules in doubles");
  const auto alike = [](double bound, double formula) {
    return bound >= formula * (1 - 8 * kUnitRoundoff) && bound <= formula * (1 + 1e-13);
  };
  std::uint64_t wrong = 0, bounds = 0;
  for (int n = 1; n <= 20; ++n) {
    for (const double rho : {1.25, 2.0, 4.5}) {
      double power = 1;
      for (int k = 0; k < 2 * n; ++k) power /= rho;
      const double rest = power / (1 - 1 / (rho * rho));
      wrong += alike(certain_logarithmic_truncation(n, rho), 32.0 / 15 / n * rest) ? 0u : 1u;
      wrong += alike(certain_analytic_truncation(n, rho), 64.0 / 15 * rest) ? 0u : 1u;
      bounds += 2;
    }
    EXPECT_TRUE(
        holds(std::isinf(certain_logarithmic_truncation(n, 1)) && std::isinf(certain_analytic_truncation(n, 1))));
  }
  EXPECT_TRUE(all_agree(wrong, bounds));
}

}  // namespace
}  // namespace etendue::validation
