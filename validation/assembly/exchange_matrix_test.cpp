// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/exchange_matrix.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <set>
#include <vector>

#include "etendue/assembly/exact_exchange.hpp"
#include "etendue/assembly/form_factor_matrix.hpp"
#include "etendue/assembly/row_closure.hpp"
#include "etendue/core/rounding.hpp"
#include "meshing/small_scenes.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

// F_ij is one division of the stored exchange area, A_i F_ij one product more: two roundings on either side.
constexpr double kReciprocityRounding = gamma_bound(4);

Scene room_with_partition() {
  Scene scene = room_of({0, 0, 0}, {4, 3, 2});
  for (auto& object : scene.objects) object.subdivision = {{3, 2}, {1, 1}};
  const Polygon front = quadrilateral({1.5, 1.25, 0}, {2.5, 1.75, 0}, {2.5, 1.75, 1.5}, {1.5, 1.25, 1.5});
  scene.objects.push_back({"partition", front, 0, {}});
  scene.objects.push_back({"partition, back", polygon({front.vertices().rbegin(), front.vertices().rend()}), 0, {}});
  return scene;
}

ExchangeMatrix filled(const ElementMesh& mesh, int threads) {
  ExchangeMatrix matrix(areas_of(mesh));
  const ExactExchange method(mesh, {{1e-9, 1e-12}, {1e-5, 1e-8}});
  EXPECT_TRUE(fill_exchanges(matrix, method, {1e-5, 1e-8}, {threads, {}, nullptr}));
  return matrix;
}

// CLAIM      Every pair i ≤ j has a cell of its own, and every tile knows its place, whatever the number of surfaces.
// ORACLE     exact: all cells counted.
// TOLERANCE  none.
TEST(ExchangeMatrix, GivesEveryPairACellOfItsOwn) {
  proves({}, Oracle::exact, "all cells counted");
  std::uint64_t wrong = 0, decided = 0;
  for (const std::size_t n : {1u, 2u, 3u, 64u, 65u, 130u, 513u}) {
    const TileLayout layout(n);
    std::set<std::size_t> cells;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i; j < n; ++j) {
        const std::size_t cell = layout.cell_of(i, j), tile = cell / layout.cells();
        const auto block = layout.block_of(tile);
        const auto rows = layout.range(block.row), columns = layout.range(block.column);
        ++decided;
        wrong += !(cells.insert(cell).second && tile < layout.tiles() && i >= rows.begin && i < rows.end &&
                   j >= columns.begin && j < columns.end);
      }
    }
  }
  EXPECT_TRUE(all_agree(wrong, decided));
}

// CLAIM      A stored bound is never smaller than the bound that was given, and larger by no more than a float's rounding.
// ORACLE     exact: comparison of doubles over magnitudes from 1e-40 to 1.
// TOLERANCE  2^-23 relatively, a float's spacing, and 2^-149, its smallest number.
TEST(ExchangeMatrix, NeverStoresASmallerBound) {
  proves({}, Oracle::exact, "the bound that was given");
  for (const double scale : {1.0, 0x1p-40, 0x1p40}) {
    ExchangeMatrix matrix({3 * scale, 0.7 * scale});
    for (double bound = 1; bound > 1e-40; bound *= 0.37) {
      matrix.set(0, 1, {0.5 * scale, bound * 0.7 * scale});
      const double kept = matrix.factor(1, 0).bound - kUnitRoundoff * matrix.factor(1, 0).value;
      EXPECT_TRUE(holds(matrix.exchange_bound(0, 1) >= bound * 0.7 * scale));
      EXPECT_TRUE(near(kept, bound, 0x1p-22 * bound + 0x1p-148 + 2 * kUnitRoundoff));
    }
  }
}

// CLAIM      IU.6-5: A_i F_ij = A_j F_ji by construction, with blockers too, and the rows agree with the dense matrix that
//            the radiosity solver uses.
// ORACLE     identity: reciprocity; another program part: assemble_form_factors at the same tolerances.
// TOLERANCE  reciprocity: kReciprocityRounding of the exchange area; the dense matrix: the sum of both bounds.
TEST(ExchangeMatrix, IsReciprocalByConstruction) {
  proves({"IU.6-5", "IU.6-4"}, Oracle::identity, "A_i F_ij = A_j F_ji");
  const ElementMesh mesh = *mesh_elements(room_with_partition());
  const ExchangeMatrix matrix = filled(mesh, 1);
  const FormFactorMatrix dense = assemble_form_factors(mesh, {{1e-9, 1e-12}, {1e-5, 1e-8}}, {});
  EXPECT_GT(matrix.report().obstructed, 50u);
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    for (std::size_t j = 0; j < matrix.size(); ++j) {
      const Bounded there = matrix.factor(i, j), back = matrix.factor(j, i);
      const double from_i = matrix.areas()[i] * there.value, from_j = matrix.areas()[j] * back.value;
      EXPECT_TRUE(near(from_i, from_j, kReciprocityRounding * matrix.exchange(i, j)));
      const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
      EXPECT_TRUE(near(there.value, dense.factors(row, column), there.bound + dense.bounds(row, column)));
    }
  }
  const TileReport what = matrix.report();
  EXPECT_EQ(what.averted + what.clear + what.blocked + what.obstructed, matrix.layout().pairs());
}

// CLAIM      IU.6-6: rows of a closed room with a partition in it sum to one within their bounds; a room without a
//            ceiling is open, and its floor misses what the ceiling would get.
// ORACLE     identity: closure; closed form: F from floor to ceiling of a cube is 0.19982489569838747 (Howell C-11).
// TOLERANCE  the row's bound; for the cube the row's bound as well.
TEST(ExchangeMatrix, ClosesWhatIsClosed) {
  proves({"IU.6-6"}, Oracle::identity, "Σ_j F_ij = 1");
  const ElementMesh mesh = *mesh_elements(room_with_partition());
  const RowClosure closure = row_closure(filled(mesh, 2));
  EXPECT_TRUE(closure.above.empty());
  for (std::size_t i = 0; i < closure.sums.size(); ++i) EXPECT_TRUE(near(closure.sums[i], 1, closure.bounds[i]));

  Scene cube = room_of({0, 0, 0}, {1, 1, 1});
  cube.objects.erase(cube.objects.begin() + 1);
  const ElementMesh open = *mesh_elements(cube);
  const RowClosure opened = row_closure(filled(open, 1));
  EXPECT_EQ(opened.open.size(), 5u);
  constexpr double kOppositeFacesOfACube = 0.19982489569838747;
  EXPECT_TRUE(near(1 - opened.sums[0], kOppositeFacesOfACube, opened.bounds[0]));
}

// CLAIM      The matrix has the same bits with one thread and with four, and however often it was stopped in between.
// ORACLE     metamorphic: other numbers of threads; stops after every seventh tile.
// TOLERANCE  none: equality of doubles.
TEST(ExchangeMatrix, HasTheSameBitsHoweverItIsMade) {
  proves({}, Oracle::metamorphic, "threads and interruptions");
  const ElementMesh mesh = *mesh_elements(room_with_partition());
  const ExchangeMatrix one = filled(mesh, 1), four = filled(mesh, 4);
  ExchangeMatrix pieces(areas_of(mesh));
  const ExactExchange method(mesh, {{1e-9, 1e-12}, {1e-5, 1e-8}});
  std::size_t runs = 0;
  for (; !pieces.complete(); ++runs) {
    std::atomic<bool> stop{false};
    const std::size_t before = pieces.tiles_done();
    const auto after_some = [&](std::size_t done, std::size_t) { stop = done >= before + 40; };
    fill_exchanges(pieces, method, {1e-5, 1e-8}, {1, after_some, &stop});
  }
  EXPECT_GT(runs, 3u);
  std::uint64_t wrong = 0, decided = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    for (std::size_t j = i; j < one.size(); ++j, ++decided) {
      wrong += one.exchange(i, j) != four.exchange(i, j) || one.exchange_bound(i, j) != four.exchange_bound(i, j) ||
               one.exchange(i, j) != pieces.exchange(i, j) || one.exchange_bound(i, j) != pieces.exchange_bound(i, j);
    }
  }
  EXPECT_TRUE(all_agree(wrong, decided));
  EXPECT_EQ(one.report().defect, pieces.report().defect);
  EXPECT_EQ(one.report().obstructed, four.report().obstructed);
}

// CLAIM      A pair has the same bits alone as in its tile, and is checked from the other side alone where it is there.
// ORACLE     metamorphic: every pair asked for by itself.
// TOLERANCE  none: equality of doubles, and of the counts.
TEST(ExchangeMatrix, AnswersForAPairAsItDoesAlone) {
  proves({}, Oracle::metamorphic, "every pair of a room with a partition, alone");
  const ElementMesh mesh = *mesh_elements(room_with_partition());
  const ExactExchange method(mesh, {{1e-9, 1e-12}, {1e-3, 1e-6}});
  std::vector<SurfacePair> pairs;
  for (std::size_t i = 0; i < mesh.elements.size(); ++i) {
    for (std::size_t j = i + 1; j < mesh.elements.size(); ++j) pairs.push_back({i, j});
  }
  std::vector<Bounded> together(pairs.size());
  TileReport of_all, of_single;
  method.find(pairs, together, of_all);
  std::uint64_t wrong = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    Bounded alone;
    method.find({&pairs[k], 1}, {&alone, 1}, of_single);
    wrong += alone.value != together[k].value || alone.bound != together[k].bound;
  }
  EXPECT_TRUE(all_agree(wrong, pairs.size()));
  EXPECT_TRUE(holds(of_all.checked > 0 && of_all.checked < of_all.clear + of_all.obstructed));
  EXPECT_TRUE(holds(of_all.checked == of_single.checked && of_all.clear == of_single.clear));
}

// CLAIM      IU.6-5: an absolute tolerance holds for both factors of a pair: for that from the smaller surface too.
// ORACLE     exact: bounds of exchange areas against the tolerance times the smaller area.
// TOLERANCE  none: decisions, but for a float's rounding of the kept bound.
TEST(ExchangeMatrix, KeepsAnAbsoluteToleranceFromBothSides) {
  proves({"IU.6-5"}, Oracle::exact, "bounds of exchange areas against the smaller area");
  Scene scene = room_of({0, 0, 0}, {4, 3, 2});
  for (std::size_t k = 3; k < 6; ++k) scene.objects[k].subdivision = {{7, 5}, {1, 1}};
  const ElementMesh mesh = *mesh_elements(scene);
  const Tolerance asked{0, 1e-4};
  ExchangeMatrix matrix(areas_of(mesh));
  EXPECT_TRUE(fill_exchanges(matrix, ExactExchange(mesh, {asked, asked}), asked, {}));
  std::uint64_t wrong = 0;
  constexpr double kFloat = 1 + 0x1p-22;
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    for (std::size_t j = i + 1; j < matrix.size(); ++j) {
      wrong += matrix.exchange_bound(i, j) > asked.absolute * std::min(matrix.areas()[i], matrix.areas()[j]) * kFloat;
    }
  }
  EXPECT_TRUE(all_agree(wrong, matrix.layout().pairs()));
  EXPECT_TRUE(holds(matrix.report().beyond == 0));
}

// CLAIM      Pairs whose bound exceeds the tolerance are counted, and only they.
// ORACLE     exact: the bounds, compared here.
// TOLERANCE  none.
TEST(ExchangeMatrix, CountsWhatMissesTheTolerance) {
  proves({}, Oracle::exact, "the bounds, compared in the test");
  const ElementMesh mesh = *mesh_elements(room_with_partition());
  const ExactExchange loose(mesh, {{1e-3, 1e-6}, {1e-3, 1e-6}});
  const Tolerance strict{1e-10, 1e-14};
  ExchangeMatrix matrix(areas_of(mesh));
  EXPECT_TRUE(fill_exchanges(matrix, loose, strict, {}));
  std::uint64_t beyond = 0;
  constexpr double kFloat = 1 + 0x1p-22;  // a kept bound may have been rounded up by this
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    for (std::size_t j = i + 1; j < matrix.size(); ++j) {
      beyond += matrix.exchange_bound(i, j) / kFloat >
                std::max(1e-14 * std::min(matrix.areas()[i], matrix.areas()[j]), 1e-10 * matrix.exchange(i, j));
    }
  }
  EXPECT_GT(beyond, 100u);
  EXPECT_TRUE(holds(matrix.report().beyond == beyond));
}

}  // namespace
}  // namespace etendue::validation
