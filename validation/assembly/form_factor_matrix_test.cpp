// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/form_factor_matrix.hpp"

#include <atomic>
#include <random>
#include <utility>

#include "etendue/assembly/closure.hpp"
#include "etendue/assembly/scene_radiosity.hpp"
#include "etendue/assembly/sight.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/polygon_polygon.hpp"
#include "meshing/small_scenes.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr double kClosureOfExactFactors = 1e-10;  // the bar of the project for exact factors in a closed box

// A closed box in general position whose walls are divided differently, so that no mesh continues around a corner.
Scene turned_furnace(double rho, double emission) {
  Scene scene = room_of({0, 0, 0}, {2, 3, 1.5});
  const int cells[6][2] = {{4, 3}, {3, 4}, {5, 2}, {2, 2}, {3, 3}, {1, 1}};
  const Eigen::AngleAxisd turn(0.7, Vec3(1, 2, 3).normalized());
  for (std::size_t k = 0; k < 6; ++k) {
    std::vector<Vec3> moved;
    for (const Vec3& p : std::get<Polygon>(scene.objects[k].shape).vertices())
      moved.push_back(turn * p + Vec3(5, -2, 1));
    scene.objects[k].shape = polygon(moved);
    scene.objects[k].subdivision = {{cells[k][0], cells[k][1]}, {1, 1}};
  }
  scene.materials[0].rho = Rgb(rho, rho / 2, 0);
  scene.materials[0].emission = Rgb::Constant(emission);
  return scene;
}

// A closed room with a screen in the middle of it, turned against the walls.
Scene room_with_screen() {
  Scene scene = room_of({0, 0, 0}, {4, 3, 2});
  for (auto& object : scene.objects) object.subdivision = {{2, 2}, {1, 1}};
  const Polygon front = quadrilateral({1.5, 1.25, 0.5}, {2.5, 1.75, 0.5}, {2.5, 1.75, 1.5}, {1.5, 1.25, 1.5});
  std::vector<Vec3> back(front.vertices().rbegin(), front.vertices().rend());
  scene.objects.push_back({"screen", front, 0, {}});
  scene.objects.push_back({"screen, back", polygon(back), 0, {}});
  return scene;
}

// CLAIM      IU.6-6, IU.6.2: in a closed box of unobstructed elements every row sums to one, and no element sees
//            itself.
// ORACLE     identity: closure.
// TOLERANCE  1e-10, the bar of the project; also the sum of the returned bounds of the row and of its roundings.
TEST(FormFactorMatrix, ClosesABoxToTenDigits) {
  proves({"IU.6-6", "IU.6.2", "IU.6-3"}, Oracle::identity, "Σ_j F_ij = 1 in a closed box");
  const ElementMesh mesh = *mesh_elements(turned_furnace(0.5, 1));
  const FormFactorMatrix matrix = assemble_form_factors(mesh, {}, {});
  ASSERT_TRUE(matrix.complete);
  const ClosureReport closure = closure_report(mesh, matrix);
  EXPECT_TRUE(closure.covered.empty());
  EXPECT_TRUE(within(closure.defect, kClosureOfExactFactors));
  for (Eigen::Index i = 0; i < matrix.factors.rows(); ++i) {
    EXPECT_TRUE(near(closure.row_sums(i), 1, matrix.bounds.row(i).sum() + gamma_bound(100)));
    EXPECT_EQ(matrix.factors(i, i), 0);
  }
  EXPECT_EQ(matrix.pairs.obstructed + matrix.pairs.blocked, 0u);
  const std::size_t n = mesh.elements.size();
  EXPECT_EQ(matrix.pairs.averted + matrix.pairs.clear, n * (n - 1) / 2);
}

// CLAIM      IU.6-7: a furnace with the library's own form factors has E/(1 − ρ) on every element, in every channel.
// ORACLE     closed form: E/(1 − ρ).
// TOLERANCE  1e-12 relatively (the bar of the project), and the returned bound with form factors.
TEST(FormFactorMatrix, SolvesTheFurnaceToTwelveDigits) {
  proves({"IU.6-7", "IU.6-9", "IU.6-6"}, Oracle::closed_form, "E/(1 − ρ)");
  for (const double rho : {0.25, 0.5, 0.8}) {
    const Scene scene = turned_furnace(rho, 3);
    const ElementMesh mesh = *mesh_elements(scene);
    const FormFactorMatrix matrix = assemble_form_factors(mesh, {}, {});
    for (const RadiositySolver solver : {RadiositySolver::gaussian_elimination, RadiositySolver::eigen_lu}) {
      const auto solved = solve_scene_radiosity(scene, mesh, matrix, {solver});
      ASSERT_TRUE(solved.ok());
      const double expected[] = {3 / (1 - rho), 3 / (1 - rho / 2), 3};
      for (std::size_t c = 0; c < 3; ++c) {
        double error = 0;
        for (const Rgb& b : solved->radiosity)
          error = std::max(error, std::abs(b(static_cast<Eigen::Index>(c)) - expected[c]));
        EXPECT_TRUE(within(error, 1e-12 * expected[c]));
        EXPECT_TRUE(within(error, solved->channels[c].bound_with_factors));
        EXPECT_GE(solved->channels[c].bound_with_factors, solved->channels[c].solution.bound);
      }
    }
  }
}

// CLAIM      IU.6-5, IU.6-4: the matrix is reciprocal by construction, and the two directions agree when each is
//            computed on its own, with a screen in the way too.
// ORACLE     metamorphic: A_i F_ij against A_j F_ji, from two calls.
// TOLERANCE  by construction three roundings of the exchange area; computed on their own the bounds of the pair: every
//            obstructed one here, a share of all in the report.
TEST(FormFactorMatrix, IsReciprocal) {
  proves({"IU.6-5", "IU.6-4"}, Oracle::metamorphic, "the same pair from both sides");
  const ElementMesh mesh = *mesh_elements(room_with_screen());
  const FormFactorMatrix matrix = assemble_form_factors(mesh, {}, {});
  Eigen::VectorXd areas(matrix.factors.rows());
  for (Eigen::Index i = 0; i < areas.size(); ++i) areas(i) = mesh.elements[static_cast<std::size_t>(i)].polygon.area();
  EXPECT_TRUE(within(reciprocity_defect(matrix.factors, areas), gamma_bound(4) * areas.maxCoeff()));
  EXPECT_GT(matrix.pairs.obstructed, 20u);
  EXPECT_GE(matrix.reciprocity.pairs, matrix.pairs.obstructed / kCheckedObstructedPairs);
  EXPECT_TRUE(all_agree(matrix.reciprocity.disagreements, matrix.reciprocity.pairs));
  const SightMap sights(mesh);
  std::uint64_t disagree = 0, compared = 0;
  for (std::size_t i = 0; i < mesh.elements.size(); ++i) {
    for (std::size_t j = i + 1; j < mesh.elements.size(); ++j) {
      const SightLine line = sights.between(i, j);
      if (line.sight != PairSight::undecided) continue;
      const PairFactor pair = two_sided_factor({mesh.elements[i].polygon, mesh.elements[j].polygon, line.bodies}, {});
      disagree += !pair.agree || pair.quarterings > 0;
      ++compared;
    }
  }
  EXPECT_EQ(compared, matrix.pairs.obstructed);
  EXPECT_TRUE(all_agree(disagree, compared));
}

// CLAIM      IU.6-6 with IU.6-4: a closed room stays closed with a screen in it: what the screen hides, it receives.
// ORACLE     identity: Σ_j F_ij = 1.
// TOLERANCE  the row's bounds: estimates where obstructed, asked for at 1e-6 relatively.
TEST(FormFactorMatrix, ClosesARoomWithAScreen) {
  proves({"IU.6-4", "IU.6-6"}, Oracle::identity, "Σ_j F_ij = 1 with blockers");
  const ElementMesh mesh = *mesh_elements(room_with_screen());
  const FormFactorMatrix matrix = assemble_form_factors(mesh, {}, {});
  const ClosureReport closure = closure_report(mesh, matrix);
  EXPECT_TRUE(closure.covered.empty());
  for (Eigen::Index i = 0; i < matrix.factors.rows(); ++i) {
    EXPECT_TRUE(near(closure.row_sums(i), 1, matrix.bounds.row(i).sum() + gamma_bound(60)));
  }
}

// CLAIM      The matrix has the same bits with one thread and with three, and stopping leaves whole rows.
// ORACLE     metamorphic: another number of threads; a stop after ten rows.
// TOLERANCE  none: equality of doubles.
TEST(FormFactorMatrix, IsTheSameWithAnyNumberOfThreads) {
  proves({"IU.6-4"}, Oracle::metamorphic, "another number of threads");
  const ElementMesh mesh = *mesh_elements(room_with_screen());
  const auto with = [&](int threads) { return assemble_form_factors(mesh, {}, {threads, {}, nullptr}); };
  const FormFactorMatrix one = with(1), three = with(3);
  EXPECT_TRUE(holds(one.factors == three.factors));
  EXPECT_TRUE(holds(one.bounds == three.bounds));
  EXPECT_EQ(one.reciprocity.defect, three.reciprocity.defect);

  std::atomic<bool> stop{false};
  const auto after_ten = [&](std::size_t done, std::size_t) { stop = done >= 10; };
  const FormFactorMatrix part = assemble_form_factors(mesh, {}, {1, after_ten, &stop});
  EXPECT_FALSE(part.complete);
  EXPECT_EQ(std::count(part.row_done.begin(), part.row_done.end(), true), 10);
  EXPECT_TRUE(holds(part.factors.topRows(10) == one.factors.topRows(10)));
}

// CLAIM      PairSight: "clear", "blocked" and "averted" are true: lines between sampled points of the two elements say the
//            same. Elements under a box see nothing and are reported as covered.
// ORACLE     an independent method: segments against rectangles, written out in the test.
// TOLERANCE  none: a segment that contradicts a decision is a mismatch; segments that graze (2^-20) decide nothing.
TEST(FormFactorMatrix, DecidesSightConservatively) {
  proves({"IU.6-4"}, Oracle::program, "sampled segments against rectangles");
  Scene scene = room_with_screen();
  scene.objects.push_back({"box", Box{{3.5, 0.75, 0.5}, Mat3::Identity(), {0.25, 0.25, 0.5}}, 0, {}});
  // Between the screen and the box: hides each from the other altogether.
  scene.objects.push_back({"partition", quadrilateral({3, 0.2, 0.1}, {3, 2, 0.1}, {3, 2, 1.8}, {3, 0.2, 1.8}), 0, {}});
  const ElementMesh mesh = *mesh_elements(scene);
  const SightMap sights(mesh);
  std::mt19937_64 random(70);
  std::uniform_real_distribution<double> unit(0.01, 0.99);
  const auto sample = [&](const Polygon& q) {
    const auto& v = q.vertices();
    const double s = unit(random), t = unit(random);
    return Vec3((1 - s) * ((1 - t) * v[0] + t * v[3]) + s * ((1 - t) * v[1] + t * v[2]));
  };
  const auto hits = [](const Polygon& q, const Vec3& a, const Vec3& b) {
    const double ha = q.normal().dot(a - q.vertices()[0]), hb = q.normal().dot(b - q.vertices()[0]);
    if (std::min(std::abs(ha), std::abs(hb)) < 0x1p-20 || ha * hb > 0) return false;
    const Vec3 p = a + ha / (ha - hb) * (b - a);
    const Vec3 u = q.vertices()[1] - q.vertices()[0], v = q.vertices()[3] - q.vertices()[0];
    const double s = u.dot(p - q.vertices()[0]) / u.squaredNorm(), t = v.dot(p - q.vertices()[0]) / v.squaredNorm();
    return s > 0 && s < 1 && t > 0 && t < 1;
  };
  std::uint64_t wrong = 0, decided = 0;
  std::size_t kinds[4] = {};
  for (std::size_t i = 0; i < mesh.elements.size(); ++i) {
    for (std::size_t j = i + 1; j < mesh.elements.size(); ++j) {
      const SightLine line = sights.between(i, j);
      ++kinds[static_cast<std::size_t>(line.sight)];
      const Polygon& p = mesh.elements[i].polygon;
      const Polygon& q = mesh.elements[j].polygon;
      for (int k = 0; k < 24; ++k, ++decided) {
        const Vec3 a = sample(p), b = sample(q);
        const bool fronts = p.normal().dot(b - a) > 0x1p-20 && q.normal().dot(a - b) > 0x1p-20;
        bool hit = false, listed = true;
        for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
          const bool touched = hits(mesh.faces[f].polygon, a, b);
          hit = hit || touched;
          if (touched && line.sight == PairSight::undecided) {
            listed = listed && std::count(line.blockers.begin(), line.blockers.end(), f) == 1;
          }
        }
        if (line.sight == PairSight::averted) wrong += fronts;
        if (line.sight == PairSight::clear) wrong += fronts && hit;
        if (line.sight == PairSight::blocked) wrong += !hit;
        if (line.sight == PairSight::undecided) wrong += fronts && !listed;
      }
    }
  }
  for (const std::size_t count : kinds) EXPECT_GT(count, 0u);
  EXPECT_TRUE(all_agree(wrong, decided));
}

// CLAIM      PairSight: what lies under one pillar sees nothing of what lies above it, where the pillar is as wide as the two
//            elements, too, so that all lines between their corners run along its edges; and asking through an Approach
//            makes no difference.
// ORACLE     exact: the pillar fills the space between.
// TOLERANCE  none: decisions.
TEST(FormFactorMatrix, SeesNothingThroughAPillar) {
  proves({"IU.6-4"}, Oracle::exact, "floor and ceiling of a room with a pillar as wide as an element, and wider");
  std::uint64_t wrong = 0, decisions = 0;
  for (const double half : {0.5, 0.625, 0.75}) {
    Scene scene = room_of({0, 0, 0}, {3, 3, 2});
    for (auto& object : scene.objects) object.subdivision = {{3, 3}, {1, 1}};
    scene.objects.push_back({"pillar", Box{{1.5, 1.5, 1}, Mat3::Identity(), {half, half, 1}}, 0, {}});
    const ElementMesh mesh = *mesh_elements(scene);
    const SightMap sights(mesh);
    const auto covered = [&](std::size_t e) {
      const Element& element = mesh.elements[e];
      return mesh.face_of(element).object < 6 && (element.polygon.centroid().head<2>() - Vec2(1.5, 1.5)).norm() < 0.25;
    };
    std::uint64_t pillars = 0;
    for (std::size_t i = 0; i < mesh.elements.size(); ++i) {
      Approach approach;
      for (std::size_t j = 0; j < mesh.elements.size(); ++j, decisions += 2) {
        if (i == j) continue;
        const SightLine line = sights.between(i, j), again = sights.between(i, j, approach);
        wrong += line.sight != again.sight || line.blockers != again.blockers || line.bodies != again.bodies;
        if (!covered(i) || !covered(j)) continue;
        wrong += line.sight != PairSight::blocked;
        ++pillars;
      }
    }
    EXPECT_EQ(pillars, 2u) << half;
  }
  EXPECT_TRUE(all_agree(wrong, decisions));
}

/// A room with a turned box in it: one object, or a polygon a face.
struct BoxedRoom {
  Scene whole, plates;
};

BoxedRoom boxed_room() {
  BoxedRoom rooms{room_of({0, 0, 0}, {4, 3, 2}), {}};
  for (auto& object : rooms.whole.objects) object.subdivision = {{2, 2}, {1, 1}};
  rooms.plates = rooms.whole;
  const Mat3 turn = Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  rooms.whole.objects.push_back({"box", Box{{2, 1.5, 1}, turn, {0.5, 0.4, 0.3}}, 0, {}});
  const ElementMesh mesh = *mesh_elements(rooms.whole);
  for (const Face& face : mesh.faces) {
    if (face.object == 6) rooms.plates.objects.push_back({"plate", face.polygon, 0, {}});
  }
  return rooms;
}

/// Of the bodies between undecided pairs: solids, and all.
std::pair<std::uint64_t, std::uint64_t> solids_met(const ElementMesh& mesh) {
  const SightMap sights(mesh);
  std::uint64_t solid = 0, all = 0;
  for (std::size_t i = 0; i < mesh.elements.size(); ++i) {
    for (std::size_t j = i + 1; j < mesh.elements.size(); ++j) {
      for (const Blocker* body : sights.between(i, j).bodies) {
        solid += body->is_solid();
        ++all;
      }
    }
  }
  return {solid, all};
}

// CLAIM      IU.6-4: plates of several objects that close a convex solid block as that solid does. Where one is missing, or
//            something inside could see, they stay plates, and what is inside sees what it saw.
// ORACLE     metamorphic: the box as one object; inside, the free factor.
// TOLERANCE  the bounds of both.
TEST(FormFactorMatrix, JoinsPlatesThatCloseASolid) {
  proves({"IU.6-4"}, Oracle::metamorphic, "a turned box as one object and as six, open, and with plates inside");
  const BoxedRoom rooms = boxed_room();
  const ElementMesh whole = *mesh_elements(rooms.whole), plates = *mesh_elements(rooms.plates);
  const auto [solid, all] = solids_met(plates);
  EXPECT_GT(all, 50u);
  EXPECT_TRUE(all_agree(all - solid, all));
  const FormFactorMatrix one = assemble_form_factors(whole, {}, {}), six = assemble_form_factors(plates, {}, {});
  ASSERT_EQ(one.factors.rows(), six.factors.rows());
  EXPECT_EQ(one.pairs.obstructed, six.pairs.obstructed);
  for (Eigen::Index i = 0; i < one.factors.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      EXPECT_TRUE(near(six.factors(i, j), one.factors(i, j), six.bounds(i, j) + one.bounds(i, j)));
    }
  }

  Scene open = rooms.plates;
  open.objects.pop_back();
  EXPECT_EQ(solids_met(*mesh_elements(open)).first, 0u);

  Scene inhabited = rooms.plates;
  const Polygon lower = quadrilateral({1.9, 1.4, 0.95}, {2.1, 1.4, 0.95}, {2.1, 1.6, 0.95}, {1.9, 1.6, 0.95});
  const Polygon upper = quadrilateral({1.9, 1.4, 1.05}, {1.9, 1.6, 1.05}, {2.1, 1.6, 1.05}, {2.1, 1.4, 1.05});
  inhabited.objects.push_back({"lower", lower, 0, {}});
  inhabited.objects.push_back({"upper", upper, 0, {}});
  const ElementMesh inside = *mesh_elements(inhabited);
  EXPECT_EQ(solids_met(inside).first, 0u);
  const FormFactorMatrix seen = assemble_form_factors(inside, {}, {});
  const Eigen::Index last = seen.factors.rows() - 1;
  const Bounded free = form_factor(lower, upper);
  EXPECT_TRUE(near(seen.factors(last - 1, last), free.value, free.bound + seen.bounds(last - 1, last)));
}

}  // namespace
}  // namespace etendue::validation
