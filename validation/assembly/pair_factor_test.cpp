// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/pair_factor.hpp"

#include "etendue/assembly/form_factor_matrix.hpp"
#include "etendue/form_factor/polygon_polygon.hpp"
#include "meshing/small_scenes.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

// A floor cell, a ceiling cell of 0.5 m × 0.55 m each, as in scenes/room, and a wall between them that lets only the
// floor within `strip` of its far edge see the ceiling at all, past the wall's top.
struct NarrowWay {
  Polygon floor = quadrilateral({2, 3.3, 0}, {2.5, 3.3, 0}, {2.5, 3.85, 0}, {2, 3.85, 0});
  Polygon ceiling = quadrilateral({4, 3.3, 3}, {4, 3.85, 3}, {4.5, 3.85, 3}, {4.5, 3.3, 3});
  // In the plane x = 3, as high as the line from (2 + strip, z = 0) to (4, z = 3) there: what lies nearer looks higher.
  static Polygon wall(double strip) {
    const double top = 3 * (1 - strip) / (2 - strip);
    return quadrilateral({3, 0, 0}, {3, 9, 0}, {3, 9, top}, {3, 0, top});
  }
};

// CLAIM      IU.6-4, IU.6-5: through ways down to a hundredth of a cell both sides agree, and keep the tolerance.
// ORACLE     identity: over the strip of floor that sees the ceiling at all, the factor times the strip's area is that of
//            the whole cell; computed on the strip alone, where the way is not narrow.
// TOLERANCE  the returned bounds.
TEST(PairFactor, SeesThroughNarrowWays) {
  proves({"IU.6-4", "IU.6-5"}, Oracle::identity, "the strip of the cell that sees through");
  const NarrowWay way;
  for (const double strip : {0.25, 0.05, 0.02, 0.01, 0.005}) {
    const Blocker wall = Blocker::plate(way.wall(strip));
    const PairFactor whole = two_sided_factor({way.floor, way.ceiling, {&wall}}, {});
    const Polygon seeing = quadrilateral({2, 3.3, 0}, {2 + strip, 3.3, 0}, {2 + strip, 3.85, 0}, {2, 3.85, 0});
    const PairFactor part = two_sided_factor({seeing, way.ceiling, {&wall}}, {});
    const double share = seeing.area() / way.floor.area();
    EXPECT_TRUE(whole.agree) << strip;
    EXPECT_TRUE(near(whole.factor.value, share * part.factor.value, whole.factor.bound + share * part.factor.bound));
    EXPECT_TRUE(within(whole.factor.bound, allowed_error(AssemblyTolerance{}.obstructed, whole.factor.value, 1)));
  }
}

// CLAIM      IU.6-4, IU.6-5: two sides that disagree are compared over parts, down to the last quartering, and the pair
//            says that they still do; the larger value keeps the difference as its bound.
// ORACLE     identity: a plate open at the back stops what comes from the floor and nothing that comes from the ceiling.
// TOLERANCE  none on the count; the returned bounds on the values.
TEST(PairFactor, QuartersTheTwoSidesWhileTheyDisagree) {
  proves({"IU.6-4", "IU.6-5"}, Oracle::identity, "a plate that blocks one way only");
  const Polygon floor = quadrilateral({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  const Polygon ceiling = quadrilateral({0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1});
  const Blocker plate =
      Blocker::plate(quadrilateral({-4, -4, 0.5}, {-4, 4, 0.5}, {4, 4, 0.5}, {4, -4, 0.5}), BlockingSides::front);
  const PairFactor found = two_sided_factor({floor, ceiling, {&plate}}, {});
  EXPECT_EQ(found.quarterings, kMostQuarterings);
  EXPECT_TRUE(holds(found.checked && !found.agree));
  const Bounded free = form_factor(floor, ceiling);
  EXPECT_TRUE(near(found.factor.value, free.value, 1e-6 * free.value));
  EXPECT_TRUE(near(found.factor.bound, free.value, 1e-6 * free.value));
  // One side alone asks nothing of the other, where no curve crosses it.
  const PairFactor one = one_sided_factor({floor, ceiling, {&plate}}, {});
  EXPECT_TRUE(holds(!one.checked && one.quarterings == 0));
  EXPECT_TRUE(within(one.factor.value, 0));
}

// CLAIM      IU.6-4: a tolerance that cannot be reached is reported pair by pair, with the worst; one that is reached is
//            not.
// ORACLE     identity: the bounds that the matrix itself returns against the tolerance.
// TOLERANCE  none: counts.
TEST(PairFactor, CountsThePairsThatMissTheTolerance) {
  proves({"IU.6-4"}, Oracle::identity, "the returned bounds against the tolerance");
  Scene scene = room_of({0, 0, 0}, {4, 3, 2});
  scene.objects.push_back(
      {"screen", quadrilateral({1.5, 1.25, 0.5}, {2.5, 1.75, 0.5}, {2.5, 1.75, 1.5}, {1.5, 1.25, 1.5}), 0, {}});
  const ElementMesh mesh = *mesh_elements(scene);
  for (const double relative : {1e-4, 1e-12}) {
    AssemblyTolerance tolerance;
    tolerance.obstructed = {relative, relative * kAbsoluteShare};
    const FormFactorMatrix matrix = assemble_form_factors(mesh, tolerance, {});
    std::size_t missed = 0;
    double worst = 0;
    for (Eigen::Index i = 0; i < matrix.factors.rows(); ++i) {
      for (Eigen::Index j = i + 1; j < matrix.factors.rows(); ++j) {
        const double ratio = matrix.factors(i, j) > 0 ? matrix.factors(j, i) / matrix.factors(i, j) : 1;
        const double asked = std::max(relative * matrix.factors(i, j), relative / 1000 * std::max(1.0, 1 / ratio));
        missed += matrix.bounds(i, j) > asked * (1 + 1e-12);
        worst = std::max(worst, matrix.bounds(i, j) / asked);
      }
    }
    EXPECT_EQ(matrix.missed.pairs, missed);
    EXPECT_EQ(missed > 0, relative < 1e-4);
    if (missed > 0) {
      EXPECT_TRUE(near(matrix.missed.bound / matrix.missed.allowed, worst, 1e-12 * worst));
    }
  }
}

}  // namespace
}  // namespace etendue::validation
