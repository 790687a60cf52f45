// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "etendue/form_factor/obstructed.hpp"
#include "form_factor/obstructed_rows.hpp"
#include "form_factor/shapes.hpp"
#include "oracles/obstructed_pairs.hpp"
#include "support/evidence.hpp"
#include "support/long_run.hpp"

namespace etendue::validation {
namespace {

using oracle::PairFamily;

struct Scene {
  explicit Scene(const oracle::ObstructedPair& pair) : from(turned(pair.from)), to(turned(pair.to)) {
    for (const oracle::Corners& plate : pair.plates) plates.push_back(turned(plate));
  }
  Polygon from, to;
  std::vector<Polygon> plates;
};

/// The frame's rounding of corners of size one moves edges by it; factors by no more.
constexpr double kFrame = 64 * 0x1p-53;
constexpr std::size_t kLeastRows = 2000;
constexpr std::uint64_t kSeed = 20261122;
constexpr double kGoal = 1e-8;  ///< of the recomputed rows; their own error says what was reached

// CLAIM      IU.6-4: the returned bound holds for random pairs with one to three plates, floating, touching with an edge
//            or a corner, hugging, tiny, and for partitions that stand on a surface or share its edge; the value lies
//            between 0 and the free factor, and that is at most min(1, A_2/A_1).
// ORACLE     table: two integrations in slices, over the one polygon and over the other, by an oracle that finds the
//            visible part by inclusion and exclusion (reference/obstructed_pairs_table.cpp).
// TOLERANCE  the returned bound, the table's uncertainty, kFrame. Asked: 1e-3, 1e-4 and 1e-6 in turn, of the first polygon
//            and of the second in turn.
TEST(ObstructedTable, KeepsItsBoundInEveryPair) {
  proves({"IU.6-4"}, Oracle::table,
         "reference/obstructed_pairs.csv: every fifth random pair with plates in seven families; in a long run all");
  const std::vector<TableRow> table = table_rows();
  ASSERT_GE(table.size(), kLeastRows);
  std::uint64_t outside = 0, unreached = 0;
  double loosest = 0;
  std::size_t judged = 0;
  for (std::size_t k = 0; k < table.size(); k += every(5), ++judged) {
    const TableRow& row = table[k];
    Scene scene(oracle::obstructed_pair(row.family, row.index));
    if (k % 2 == 1) std::swap(scene.from, scene.to);
    const double asked = std::array{1e-4, 1e-6, 1e-3}[k % 3];
    const ObstructedFormFactor f = obstructed_form_factor(scene.from, scene.to, scene.plates, {asked, 1e-9});
    const double area = scene.from.area();
    EXPECT_TRUE(near(f.value, row.exchange / area, f.bound + row.uncertainty / area + kFrame))
        << oracle::name(row.family) << ' ' << row.index;
    outside += !(0 <= f.value && f.value <= f.free.value && f.free.value <= std::min(1.0, scene.to.area() / area));
    unreached += !f.reached;
    if (f.reached) loosest = std::max(loosest, f.bound / std::max(1e-9, asked * f.value));
  }
  EXPECT_TRUE(all_agree(outside, judged));
  EXPECT_TRUE(all_agree(unreached, judged));
  EXPECT_TRUE(within(loosest, 1));
}

// CLAIM      IU.6-4: who asks for more gets no larger bound, also where the work ends before the tolerance is reached.
// ORACLE     metamorphic: the same pair at 1e-3 … 1e-11; a corner of a plate that grazes the source is among them.
// TOLERANCE  a factor of two between one bound and the next: the last step before the end may go to other cells.
TEST(ObstructedTable, BoundsDoNotGrowWithWhatIsAsked) {
  proves({"IU.6-4"}, Oracle::metamorphic, "bounds at 1e-3 to 1e-11, pairs with one and three plates");
  constexpr double kStep = 2;
  for (const auto& [family, index] : {std::pair{PairFamily::cornered, 242}, std::pair{PairFamily::cornered, 169},
                                      std::pair{PairFamily::on_an_edge, 157}}) {
    const Scene scene(oracle::obstructed_pair(family, index));
    double before = 1;
    for (double asked = 1e-3; asked > 1e-12; asked *= 0.01) {
      const double bound = obstructed_form_factor(scene.to, scene.from, scene.plates, {asked, 0}).bound;
      EXPECT_TRUE(within(bound, kStep * before)) << oracle::name(family) << ' ' << index << " at " << asked;
      before = std::min(before, bound);
    }
  }
}

// CLAIM      IU.6-5, IU.6-4: computed from the other side the factors are reciprocal within their bounds: no gap is seen from
//            one side only.
// ORACLE     metamorphic: A_1 F_12 = A_2 F_21, every fifth pair of the table.
// TOLERANCE  the two bounds, and kFrame for the areas.
TEST(ObstructedTable, IsReciprocalWithinTheBounds) {
  proves({"IU.6-5", "IU.6-4"}, Oracle::metamorphic, "both sides of every fifth pair at 1e-6");
  const std::vector<TableRow> table = table_rows();
  ASSERT_GE(table.size(), kLeastRows);
  for (std::size_t k = 0; k < table.size(); k += 5) {
    const Scene scene(oracle::obstructed_pair(table[k].family, table[k].index));
    const Bounded there = obstructed_form_factor(scene.from, scene.to, scene.plates, {1e-6, 1e-9});
    const Bounded back = obstructed_form_factor(scene.to, scene.from, scene.plates, {1e-6, 1e-9});
    const double a = scene.from.area(), b = scene.to.area();
    EXPECT_TRUE(near(a * there.value, b * back.value, a * there.bound + b * back.bound + kFrame))
        << oracle::name(table[k].family) << ' ' << table[k].index;
  }
}

// CLAIM      IU.6-4: the bound holds where a partition nearly touches a surface, and where plates hide all but a sliver
//            along curves, from either side and at every tolerance.
// ORACLE     table: as above.
// TOLERANCE  the returned bound, kTable, kFrame.
TEST(ObstructedTable, KeepsItsBoundAtNarrowGapsAndSlivers) {
  proves({"IU.6-4"}, Oracle::table, "reference/obstructed_pairs.csv: families gapped and stacked");
  constexpr double kTable = 1e-10;  // to which the table's two integrations were made to agree
  std::size_t pairs = 0;
  for (const TableRow& row : table_rows()) {
    if (row.family != PairFamily::gapped && row.family != PairFamily::stacked) continue;
    ++pairs;
    Scene scene(oracle::obstructed_pair(row.family, row.index));
    for (int side = 0; side < 2; ++side) {
      const double area = scene.from.area();
      for (const double asked : {1e-3, 1e-5, 1e-6}) {
        const ObstructedFormFactor f = obstructed_form_factor(scene.from, scene.to, scene.plates, {asked, 1e-10});
        EXPECT_TRUE(near(f.value, row.exchange / area, f.bound + kTable / area + kFrame))
            << oracle::name(row.family) << ' ' << row.index << " at " << asked;
      }
      std::swap(scene.from, scene.to);
    }
  }
  EXPECT_GE(pairs, 80U);
}

// CLAIM      IU.6-4: the table is what its generator makes, and what pairs of random points find.
// ORACLE     program: the generator's integration, in a third direction, for 14 rows; statistics: 10 000 stratified pairs of
//            points for 70.
// TOLERANCE  both uncertainties; 5 standard errors of the plain estimator, which stratification only lowers: a right
//            row fails once in 25 000 seeds; a factor that counts hidden light is off by tens of them.
TEST(ObstructedTable, IsWhatItsGeneratorAndRandomPointsFind) {
  proves({"IU.6-4"}, Oracle::program, "rows recomputed, and 10 000 stratified pairs of points");
  uses_seed(kSeed);
  const std::vector<TableRow> table = table_rows();
  ASSERT_GE(table.size(), kLeastRows);
  for (std::size_t k = 0; k < 70; ++k) {
    const TableRow& row = table[(k * 7919) % table.size()];
    const oracle::ObstructedPair pair = oracle::obstructed_pair(row.family, row.index);
    const oracle::Estimate points = oracle::obstructed_exchange_by_points(pair, 10, kSeed + k);
    EXPECT_TRUE(near(points.value, row.exchange, 5 * points.error + row.uncertainty)) << oracle::name(row.family);
    if (k % 5 != 0 || pair.plates.size() > 1) continue;
    const oracle::Estimate again = oracle::obstructed_exchange(pair, 2.0, kGoal);
    EXPECT_TRUE(near(again.value, row.exchange, again.error + row.uncertainty)) << oracle::name(row.family);
  }
}

}  // namespace
}  // namespace etendue::validation
