// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "etendue/assembly/certified_exchange.hpp"
#include "etendue/assembly/closure_repair.hpp"
#include "etendue/assembly/drop.hpp"
#include "etendue/assembly/exact_exchange.hpp"
#include "etendue/assembly/ray_exchange.hpp"
#include "etendue/assembly/row_closure.hpp"
#include "etendue/core/rounding.hpp"
#include "meshing/small_scenes.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

/// A closed room, turned against the axes so that its corners are rounded.
ElementMesh turned_room(int cells) {
  Scene scene = room_of({0, 0, 0}, {2, 3, 1.5});
  const Eigen::AngleAxisd turn(0.7, Vec3(1, 2, 3).normalized());
  for (Object& object : scene.objects) {
    std::vector<Vec3> moved;
    for (const Vec3& p : std::get<Polygon>(object.shape).vertices()) moved.push_back(turn * p);
    object.shape = polygon(moved);
    object.subdivision = {{cells, cells}, {1, 1}};
  }
  return *mesh_elements(scene);
}

ExchangeMatrix filled(const ElementMesh& mesh, const ExchangeMethod& method) {
  ExchangeMatrix matrix(areas_of(mesh));
  EXPECT_TRUE(fill_exchanges(matrix, method, {1e-8, 1e-11}, {}));
  return matrix;
}

// CLAIM      IU.6-3: enclosures and exact integration agree within their bounds on every pair of a room.
// ORACLE     another program part: certified_form_factor, in intervals, shares no arithmetic with form_factor.
// TOLERANCE  the sum of both bounds.
TEST(ExchangeMethods, AgreeWithEnclosures) {
  proves({"IU.6-3"}, Oracle::program, "intervals against floating point");
  const ElementMesh mesh = turned_room(1);
  const ExchangeMatrix exact = filled(mesh, ExactExchange(mesh, {{1e-8, 1e-11}, {1e-8, 1e-11}}));
  const ExchangeMatrix certified = filled(mesh, CertifiedExchange(mesh, {1e-8, 1e-11}));
  EXPECT_EQ(certified.report().clear, 15u);
  EXPECT_EQ(certified.report().beyond, 0u);
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = i + 1; j < 6; ++j) {
      EXPECT_TRUE(near(exact.exchange(i, j), certified.exchange(i, j),
                       exact.exchange_bound(i, j) + certified.exchange_bound(i, j)));
    }
  }
}

// CLAIM      IU.6-4: where one box stands on another, but for a rounding, rays pass between their faces no more than light does; and a row whose
//            bound does not tell 0 from 1 is not called covered.
// ORACLE     identity: the faces that touch exchange nothing; the box above covers only part of the one below.
// TOLERANCE  none.
TEST(ExchangeMethods, LetNothingThroughAContact) {
  proves({"IU.6-4"}, Oracle::identity, "a table top on a leg, heights rounded differently");
  Scene scene = room_of({0, 0, 0}, {2, 3, 1.5});
  scene.objects.push_back({"leg", Box{{1, 1, 0.35}, Mat3::Identity(), {0.05, 0.05, 0.35}}, 0, {}});
  scene.objects.push_back({"top", Box{{1, 1, 0.725}, Mat3::Identity(), {0.3, 0.3, 0.025}}, 0, {}});
  const ElementMesh mesh = *mesh_elements(scene);
  const ExchangeMatrix rays = filled(mesh, RayExchange(mesh, {20'000, 3}, {}));
  const auto faces = [&](const Vec3& normal, std::size_t object) {
    for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
      if (mesh.face_of(mesh.elements[k]).object == object && mesh.elements[k].polygon.normal().dot(normal) > 0.99)
        return k;
    }
    return mesh.elements.size();
  };
  const std::size_t leg = faces(Vec3::UnitZ(), 6), top = faces(-Vec3::UnitZ(), 7);
  ASSERT_LT(std::max(leg, top), mesh.elements.size());
  EXPECT_TRUE(near(rays.exchange(std::min(leg, top), std::max(leg, top)), 0, 0));

  ExchangeMatrix vague(std::vector<double>{1, 1});
  struct Vague : ExchangeMethod {
    void find(std::span<const SurfacePair> pairs, std::span<Bounded> exchanges, TileReport&) const override {
      for (std::size_t k = 0; k < pairs.size(); ++k) exchanges[k] = {0.5, 0.75};
    }
  };
  EXPECT_TRUE(fill_exchanges(vague, Vague(), {1, 1}, {}));
  EXPECT_TRUE(holds(row_closure(vague).covered.empty() && row_closure(vague).closed()));
}

// CLAIM      IU.6-4: rays and integration agree within the rays' bounds, past a partition too, and past a mask in its base.
// ORACLE     statistics: 300 pairs, each bound fails with probability 10⁻⁶, seed 7: all hold with 1 − 3·10⁻⁴.
// TOLERANCE  the sum of both bounds.
TEST(ExchangeMethods, AgreeWithRays) {
  constexpr std::uint64_t kSeed = 7;
  proves({"IU.6-4"}, Oracle::statistics, "counted rays, one bound in a million fails");
  uses_seed(kSeed);
  Scene scene = room_of({0, 0, 0}, {2, 3, 1.5});
  for (Object& object : scene.objects) object.subdivision = {{2, 2}, {1, 1}};
  scene.objects.push_back({"partition", quadrilateral({0.5, 1, 0}, {1.5, 1.5, 0}, {1.5, 1.5, 1}, {0.5, 1, 1}), 0, {}});
  const ElementMesh mesh = *mesh_elements(scene);
  const ExchangeMatrix exact = filled(mesh, ExactExchange(mesh, {{1e-4, 1e-7}, {1e-4, 1e-7}}));
  const ExchangeMatrix rays = filled(mesh, RayExchange(mesh, {20000, kSeed}, {}));
  const ExchangeMatrix again = filled(mesh, RayExchange(mesh, {20000, kSeed}, {3, {}, nullptr}));
  std::uint64_t differ = 0, pairs = 0;
  double closest = 1;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    for (std::size_t j = i + 1; j < exact.size(); ++j, ++pairs) {
      EXPECT_TRUE(
          near(rays.exchange(i, j), exact.exchange(i, j), rays.exchange_bound(i, j) + exact.exchange_bound(i, j)));
      differ += rays.exchange(i, j) != again.exchange(i, j);
      closest = std::min(closest, rays.factor(i, j).bound);
    }
  }
  EXPECT_TRUE(all_agree(differ, pairs));
  EXPECT_LT(closest, 0.002) << "bounds that say nothing prove nothing";
}

// CLAIM      chance_bound holds what it promises: the binomial probability of a count as far off as the bound allows is at
//            most the doubt.
// ORACLE     closed form: the binomial tail, summed exactly in the test.
// TOLERANCE  none: an inequality, with 10⁻⁹ for the sum's rounding.
TEST(ExchangeMethods, BoundChancesByChernoff) {
  proves({}, Oracle::closed_form, "binomial tails");
  constexpr double kDoubt = 1e-3;
  constexpr int kOf = 60;
  for (int count = 0; count <= kOf; ++count) {
    const double p = static_cast<double>(count) / kOf;
    const double bound = chance_bound(static_cast<std::uint64_t>(count), kOf, kDoubt);
    for (const double truth : {p - bound, p + bound}) {
      if (truth <= 0 || truth >= 1) continue;
      double tail = 0;
      for (int k = truth < p ? count : 0; truth < p ? k <= kOf : k <= count; ++k) {
        tail += std::exp(std::lgamma(kOf + 1.0) - std::lgamma(k + 1.0) - std::lgamma(kOf - k + 1.0) +
                         k * std::log(truth) + (kOf - k) * std::log1p(-truth));
      }
      EXPECT_TRUE(within(tail, kDoubt / 2 + 1e-9));
    }
  }
}

/// The room's matrix, closed to rounding, and every pair then moved by a known share of what its bound will claim.
ExchangeMatrix perturbed(const ExchangeMatrix& exact, double share, double claimed) {
  ExchangeMatrix matrix(exact.areas());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    for (std::size_t j = i + 1; j < exact.size(); ++j) {
      const double value = exact.exchange(i, j);
      const double sign = (i * 7 + j * 3) % 5 < 2 ? -1 : 1;
      matrix.set(i, j, {value * (1 + sign * share), value * claimed});
    }
  }
  for (std::size_t tile = 0; tile < matrix.layout().tiles(); ++tile) matrix.close(tile, {});
  return matrix;
}

// CLAIM      IU.6-5, IU.6-6: the repair closes every row to rounding, keeps reciprocity and zeros, changes no pair by more
//            than its bound where the bounds allow that, and grows the bounds by the change.
// ORACLE     identity: closure and reciprocity; the unperturbed matrix lies within the new bounds.
// TOLERANCE  closure: 2^-43 (the iteration stops at 2^-44, sums of 54 terms round); otherwise none.
TEST(ExchangeMethods, RepairClosureByTheSmallestChange) {
  proves({"IU.6-5", "IU.6-6"}, Oracle::identity, "Σ_j F_ij = 1 and A_i F_ij = A_j F_ji");
  const ElementMesh mesh = turned_room(3);
  const ExchangeMatrix exact = filled(mesh, ExactExchange(mesh, {{1e-12, 1e-14}, {1e-12, 1e-14}}));
  const ExchangeMatrix moved = perturbed(exact, 1e-3, 3e-3);
  const auto result = repaired(moved, row_closure(moved));
  ASSERT_TRUE(result.ok()) << result.error().message;
  const ExchangeMatrix& closed = result->matrix;
  double largest = 0;
  for (std::size_t i = 0; i < closed.size(); ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < closed.size(); ++j) {
      sum += closed.exchange(i, j);
      EXPECT_EQ(closed.exchange(i, j) == 0, moved.exchange(i, j) == 0);
      EXPECT_TRUE(near(closed.exchange(i, j), exact.exchange(i, j), closed.exchange_bound(i, j)));
      const double change = std::abs(closed.exchange(i, j) - moved.exchange(i, j));
      largest = std::max(largest, change / closed.areas()[i]);
      EXPECT_LE(change, moved.exchange_bound(i, j));
    }
    EXPECT_TRUE(near(sum / closed.areas()[i], 1, 0x1p-43));
  }
  EXPECT_TRUE(near(result->report.largest_change, largest, 1e-12 * largest));
  EXPECT_EQ(result->report.beyond, 0u);
  EXPECT_GT(result->report.defect_before, 1e-6);
  EXPECT_LT(result->report.defect_after, 1e-12);
}

// CLAIM      The repair refuses an open room, and never touches it.
// ORACLE     exact: a room without its ceiling.
// TOLERANCE  none.
TEST(ExchangeMethods, DoNotRepairWhatIsOpen) {
  proves({"IU.6-6"}, Oracle::exact, "a room without its ceiling");
  Scene scene = room_of({0, 0, 0}, {1, 1, 1});
  scene.objects.erase(scene.objects.begin() + 1);
  const ElementMesh mesh = *mesh_elements(scene);
  const ExchangeMatrix matrix = filled(mesh, ExactExchange(mesh, {{1e-9, 1e-12}, {1e-9, 1e-12}}));
  const auto result = repaired(matrix, row_closure(matrix));
  EXPECT_TRUE(holds(!result.ok() && result.error().code == ErrorCode::not_converged));
  EXPECT_NE(result.error().message.find("are open"), std::string::npos);
}

// CLAIM      Dropping sets to zero the pairs below the threshold and no others, says which row loses most, and leaves every
//            value within its bound.
// ORACLE     exact: the pairs, compared in the test.
// TOLERANCE  none; the share that a row loses: 200 roundings.
TEST(ExchangeMethods, DropOnlyWhatIsSmall) {
  proves({}, Oracle::exact, "the pairs, compared in the test");
  const ElementMesh mesh = turned_room(3);
  const ExactExchange method(mesh, {{1e-6, 1e-9}, {1e-6, 1e-9}});
  const ExchangeMatrix whole = filled(mesh, method);
  ExchangeMatrix sparse = filled(mesh, method);
  constexpr double kThreshold = 0.01;
  const DropReport report = drop_below(sparse, kThreshold);
  std::size_t pairs = 0;
  double most = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    double lost = 0;
    for (std::size_t j = 0; j < whole.size(); ++j) {
      const double value = whole.exchange(i, j);
      const bool small = whole.factor(i, j).value < kThreshold && whole.factor(j, i).value < kThreshold && value > 0;
      EXPECT_EQ(sparse.exchange(i, j), small ? 0 : value);
      EXPECT_TRUE(near(sparse.exchange(i, j), value, sparse.exchange_bound(i, j)));
      if (small) lost += value / whole.areas()[i];
      pairs += small && i < j;
    }
    most = std::max(most, lost);
  }
  EXPECT_GT(pairs, 100u);
  EXPECT_EQ(report.pairs, pairs);
  EXPECT_TRUE(near(report.largest_share, most, gamma_bound(200) * most));
}

}  // namespace
}  // namespace etendue::validation
