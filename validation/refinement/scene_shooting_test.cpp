// SPDX-License-Identifier: Apache-2.0
#include "etendue/refinement/scene_shooting.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "etendue/assembly/form_factor_matrix.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/refinement/relighting.hpp"
#include "refinement/shooting_scenes.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

const AssemblyTolerance kLoose{{1e-12, 1e-15}, {1e-4, 1e-7}};

/// Roundings of the sums in a state: each share received takes part in five sums, at most so many shares a step.
double rounding(const PatchModel& model, const SceneShooting& state) {
  const auto terms = static_cast<double>(state.steps + 2) * static_cast<double>(model.element_areas.size());
  return 8 * terms * kUnitRoundoff * state.emitted.maxCoeff();
}

SceneShooting shot(const Scene& scene, const PatchModel& model, PatchFactors& factors, double unshot,
                   ShotRule rule = ShotRule::unshot, int threads = 1) {
  SceneShooting state = begin(scene, model);
  const SceneShootingGoal goal{unshot, 100'000, rule};
  require(shoot_until(state, scene, model, factors, goal, {threads, {}, nullptr}) == ShootingEnd::reached, "shot");
  return state;
}

// CLAIM      IU.6.6, IU.6-13: shooting with exact factors in a cube whose floor emits finds the irradiances of floor,
//            ceiling and walls.
// ORACLE     closed form: the 3 × 3 system of a cube's symmetry with F_opposite = 0.199824895698387…, F_side from
//            closure, solved by hand: 0.18181819621539094, 0.363491652215577, 0.36367253789225795 W/m².
// TOLERANCE  the returned gap, over the reflectance of one half, and 1e-11 for the factors (asked for to 1e-12).
TEST(SceneShooting, FindsTheIrradiancesOfACube) {
  proves({"IU.6.6", "IU.6-13"}, Oracle::closed_form, "the cube's system by hand");
  const Scene scene = glowing_cube(1);
  const PatchModel model = model_of(scene);
  const auto factors = exact_factors(model, {});
  const SceneShooting state = shot(scene, model, *factors, 1e-13);
  const double tolerance = 2 * shooting_gap(scene, model, state, true).radiosity(0) + 1e-11;
  const std::array<double, 6> expected{0.18181819621539094, 0.363491652215577,   0.36367253789225795,
                                       0.36367253789225795, 0.36367253789225795, 0.36367253789225795};
  for (std::size_t k = 0; k < 6; ++k) EXPECT_TRUE(near(state.irradiance[k](1), expected[k], tolerance));
  EXPECT_TRUE(within(tolerance, 2e-11));
}

// CLAIM      IU.6.6: as steps go on the radiosities tend to the full matrix's, from below, no farther than the gap says,
//            in each channel.
// ORACLE     another method: the matrix of element factors, solved by Eigen.
// TOLERANCE  the gap, and for the factors Σ of the returned bounds times the brightest radiosity over 1 − ρ (both sides
//            compute pairs to 1e-4 past obstacles).
TEST(SceneShooting, TendsToTheFullMatrix) {
  proves({"IU.6.6", "IU.6-12"}, Oracle::program, "the full matrix, Eigen's LU");
  const Scene scene = furnished(2, 2, false);
  const PatchModel model = model_of(scene);
  const FormFactorMatrix matrix = assemble_form_factors(model.elements, kLoose, {});
  const Eigen::Index n = matrix.factors.rows();
  const auto factors = remembered(exact_factors(model, kLoose), model.patch_areas.size(), 1 << 24);
  SceneShooting state = begin(scene, model);
  double before = 1e30;
  for (const double unshot : {0.3, 1e-2, 1e-4, 1e-9}) {
    ASSERT_EQ(shoot_until(state, scene, model, *factors, {unshot, 100'000, ShotRule::unshot}), ShootingEnd::reached);
    const ShootingGap gap = shooting_gap(scene, model, state, factors->reciprocal());
    const auto radiosity = radiosities(scene, model, emissions_of(scene, model), state);
    double worst = 0;
    for (Eigen::Index c = 0; c < 3; ++c) {
      Eigen::VectorXd emission(n), rho(n);
      for (Eigen::Index i = 0; i < n; ++i) {
        const Material& material = model.material_of(scene, model.patch_of(static_cast<std::size_t>(i)));
        emission(i) = material.emission(c);
        rho(i) = material.rho(c);
      }
      const Eigen::MatrixXd system = Eigen::MatrixXd::Identity(n, n) - rho.asDiagonal() * matrix.factors;
      const Eigen::VectorXd full = system.partialPivLu().solve(emission);
      const double slack = 2 * matrix.bounds.rowwise().sum().maxCoeff() * full.maxCoeff() / (1 - rho.maxCoeff()) + 1e-9;
      for (Eigen::Index i = 0; i < n; ++i) {
        const double missing = full(i) - radiosity[static_cast<std::size_t>(i)](c);
        EXPECT_TRUE(near(missing, gap.radiosity(c) / 2, gap.radiosity(c) / 2 + slack));
        worst = std::max(worst, std::abs(missing));
      }
    }
    EXPECT_LT(worst, before);
    before = worst;
  }
  EXPECT_TRUE(within(before, 0.05));
}

// CLAIM      IU.6.6, IU.6-13, IU.6-1: at every step, of hemicubes and of exact factors, in a closed and in an open room, and
//            also overshooting, what is emitted is absorbed, has escaped or is unshot; and the unshot power falls.
// ORACLE     identity: the balance of power.
// TOLERANCE  rounding of the sums (counted in rounding()); none for the fall but that.
TEST(SceneShooting, KeepsItsPowerAtEveryStep) {
  proves({"IU.6.6", "IU.6-13", "IU.6-1"}, Oracle::identity, "emitted = absorbed + escaped + unshot");
  for (const bool open : {false, true}) {
    const Scene scene = furnished(4, 2, open);
    const PatchModel model = model_of(scene);
    for (const bool exact : {false, true}) {
      auto source = exact ? exact_factors(model, {{1e-3, 1e-5}, {1e-2, 1e-4}})
                          : hemicube_factors(model, {PixelBody::hemicube, 60, 1, false, 1});
      const auto factors = remembered(std::move(source), model.patch_areas.size(), 1 << 24);
      for (const ShotRule rule : {ShotRule::unshot, ShotRule::overshoot}) {
        SceneShooting state = begin(scene, model);
        const auto check = [&](const SceneShooting& now) {
          Rgb unshot = Rgb::Zero();
          for (std::size_t j = 0; j < now.unshot.size(); ++j) unshot += now.unshot[j] * model.patch_areas[j];
          const Rgb defect = (now.emitted - now.absorbed - now.escaped - unshot).abs();
          const std::size_t step = now.unshot_shares.size() - 1;
          // With factors to 1 % a column may sum to more than one by as much.
          const double excess = exact ? 1e-2 * now.emitted.maxCoeff() : 0;
          EXPECT_TRUE(within(defect.maxCoeff(), rounding(model, now) + excess));
          EXPECT_LE(now.unshot_shares[step], now.unshot_shares[step - 1] * (1 + 1e-12));
        };
        ASSERT_EQ(shoot_until(state, scene, model, *factors, {1e-4, 100'000, rule}, {1, {}, nullptr}, check),
                  ShootingEnd::reached);
        EXPECT_GT(state.steps, 50u);
        EXPECT_EQ(state.escaped.maxCoeff() > 0.05 * state.emitted.maxCoeff(), open);
      }
    }
  }
}

// CLAIM      IU.6-13: the patch with the largest unshot power shoots, the lamp first; a run that pauses after any number of
//            steps, and one on two or three threads, has the same bits.
// ORACLE     identity: equal states; a plain search for the largest.
// TOLERANCE  none.
TEST(SceneShooting, HasTheSameBitsPausedOrOnMoreThreads) {
  proves({"IU.6-13"}, Oracle::identity, "equal bits");
  const Scene scene = furnished(4, 2, false);
  const PatchModel model = model_of(scene);
  const HemicubeSettings settings{PixelBody::hemicube, 64, 1, false, 1};
  const auto factors = hemicube_factors(model, settings);
  const SceneShooting whole = shot(scene, model, *factors, 0.02);
  EXPECT_EQ(model.materials[whole.shooters.front()], 2u) << "the lamp";
  for (const int threads : {2, 3}) {
    const auto others = remembered(hemicube_factors(model, settings), model.patch_areas.size(), 1 << 16);
    EXPECT_TRUE(holds(same_bits(whole, shot(scene, model, *others, 0.02, ShotRule::unshot, threads))));
  }
  SceneShooting paused = begin(scene, model);
  for (std::size_t most = 3; paused.unshot_shares.back() > 0.02; most += 7) {
    const SceneShooting before = paused;
    shoot_until(paused, scene, model, *factors, {0.02, most, ShotRule::unshot});
    if (paused.steps == before.steps) continue;
    double most_power = 0;
    for (std::size_t j = 0; j < before.unshot.size(); ++j) {
      most_power = std::max(most_power, before.unshot[j].sum() * model.patch_areas[j]);
    }
    const std::size_t shooter = paused.shooters[before.steps];
    EXPECT_TRUE(near(before.unshot[shooter].sum() * model.patch_areas[shooter], most_power, 1e-14 * most_power));
  }
  EXPECT_TRUE(holds(same_bits(whole, paused)));
}

// CLAIM      Overshooting converges to the same radiosities; IU.6-15, IU.f64: the ambient term, which brings the mean picture of
//            an early state nearer to the solution, tends to zero.
// ORACLE     metamorphic: both rules; the converged solution for the early ones.
// TOLERANCE  Σ A |difference| within both gaps; the ambient term within its formula's share of the unshot power.
TEST(SceneShooting, OvershotOrNotEndsAlikeAndNeedsNoAmbientTerm) {
  proves({"IU.6-15", "IU.f64", "IU.6-14"}, Oracle::metamorphic, "two rules, one solution");
  const Scene scene = furnished(4, 2, false);
  const PatchModel model = model_of(scene);
  const auto factors =
      remembered(hemicube_factors(model, {PixelBody::hemicube, 60, 1, false, 1}), model.patch_areas.size(), 1 << 24);
  const Emissions emissions = emissions_of(scene, model);
  const SceneShooting plain = shot(scene, model, *factors, 1e-6);
  const SceneShooting over = shot(scene, model, *factors, 1e-6, ShotRule::overshoot);
  const auto solution = radiosities(scene, model, emissions, plain), other = radiosities(scene, model, emissions, over);
  Rgb apart_by = Rgb::Zero();
  for (std::size_t q = 0; q < other.size(); ++q) apart_by += (solution[q] - other[q]).abs() * model.element_areas[q];
  const Rgb gaps = shooting_gap(scene, model, plain, false).power + shooting_gap(scene, model, over, false).power;
  EXPECT_TRUE(within((apart_by / gaps).maxCoeff(), 1));
  EXPECT_TRUE(holds(over.shooters != plain.shooters)) << "it does shoot otherwise";
  EXPECT_TRUE(holds(std::isinf(shooting_gap(scene, model, plain, false).radiosity(0)))) << "hemicubes bound no element";

  const auto distance = [&](const std::vector<Rgb>& shown) {
    Rgb sum = Rgb::Zero();
    for (std::size_t q = 0; q < shown.size(); ++q) sum += (solution[q] - shown[q]) * model.element_areas[q];
    return std::abs(sum.sum());
  };
  SceneShooting state = begin(scene, model);
  double before = 1e30;
  for (const double unshot : {0.5, 0.2, 0.05, 1e-3, 1e-6}) {
    shoot_until(state, scene, model, *factors, {unshot, 100'000, ShotRule::unshot});
    const Rgb ambient = ambient_radiosity(scene, model, state);
    const auto now = radiosities(scene, model, emissions, state);
    if (unshot > 0.01) {
      EXPECT_LT(distance(with_ambient_term(scene, model, now, ambient)), 0.5 * distance(now));
    }
    double area = 0, reflected = 0;
    for (std::size_t j = 0; j < model.patch_areas.size(); ++j) {
      area += model.patch_areas[j];
      reflected += model.patch_areas[j] * model.material_of(scene, j).rho(0);
    }
    const double expected = unshot_power(model, state)(0) / area / (1 - reflected / area);
    EXPECT_TRUE(near(ambient(0), expected, 1e-12 * expected));
    EXPECT_LT(ambient(0), before);
    before = ambient(0);
  }
  EXPECT_TRUE(within(before, 1e-5));
}

// CLAIM      IU.6-7: B is linear in E: the sum of each light's own solution times a factor is the solution of the scene with
//            those lights, without new form factors.
// ORACLE     metamorphic: a fresh solution of the scene with other emissions.
// TOLERANCE  the gaps of both, for every element.
TEST(SceneShooting, SwitchesLightsByLinearity) {
  proves({"IU.6-7"}, Oracle::metamorphic, "linearity in E");
  Scene scene = furnished(2, 2, false);
  const PatchModel model = model_of(scene);
  const auto factors = remembered(exact_factors(model, kLoose), model.patch_areas.size(), 1 << 24);
  const auto lights = emitting_materials(scene, model);
  ASSERT_EQ(lights, (std::vector<std::size_t>{2, 3}));
  std::vector<SceneShooting> states;
  for (const std::size_t light : lights) {
    SceneShooting state = before_shooting(model, emissions_of(scene, model, light));
    shoot_until(state, scene, model, *factors, {1e-5, 100'000, ShotRule::unshot});
    states.push_back(state);
  }
  const std::array<Rgb, 2> changes{Rgb(0.5, 0, 2), Rgb(0, 3, 1)};
  const SceneShooting sum = relit(model, {{&states[0], changes[0]}, {&states[1], changes[1]}});
  const auto emissions =
      relit({emissions_of(scene, model, 2), emissions_of(scene, model, 3)}, {changes[0], changes[1]});
  for (std::size_t l = 0; l < 2; ++l) scene.materials[lights[l]].emission *= changes[l];
  const SceneShooting fresh = shot(scene, model, *factors, 1e-5);
  const Rgb slack = shooting_gap(scene, model, sum, true).radiosity + shooting_gap(scene, model, fresh, true).radiosity;
  const auto combined = radiosities(scene, model, emissions, sum),
             anew = radiosities(scene, model, emissions_of(scene, model), fresh);
  for (std::size_t q = 0; q < anew.size(); ++q) {
    for (Eigen::Index c = 0; c < 3; ++c) EXPECT_TRUE(near(combined[q](c), anew[q](c), slack(c) + 1e-12));
  }
  EXPECT_TRUE(within((sum.emitted - fresh.emitted).abs().maxCoeff(), 1e-12));
  EXPECT_TRUE(within(slack.maxCoeff(), 0.01));
}

}  // namespace
}  // namespace etendue::validation
