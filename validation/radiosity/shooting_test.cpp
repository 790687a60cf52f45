// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/shooting.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "etendue/core/rounding.hpp"
#include "etendue/radiosity/ambient_term.hpp"
#include "radiosity/exact_system.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr std::uint64_t kSeed = 61213;
constexpr double kLargestReflectance = 0.8;

struct Enclosure {
  RadiositySystem system;
  Eigen::VectorXd areas;
};

// Reciprocal and closed by construction: exchange areas s_ij = s_ji are drawn, A_i is the sum of row i, F_ij =
// s_ij/A_i.
Enclosure random_enclosure(std::mt19937_64& random, Eigen::Index n) {
  const auto draw = [&] { return static_cast<double>(random() % 64 + 1) / 64; };
  Eigen::MatrixXd exchange(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) exchange(i, j) = exchange(j, i) = i == j ? 0 : draw();
  }
  Enclosure enclosure;
  enclosure.areas = exchange.rowwise().sum();  // exact: multiples of 1/64
  enclosure.system.form_factors = exchange.array().colwise() / enclosure.areas.array();
  enclosure.system.reflectance = Eigen::VectorXd::NullaryExpr(n, [&] { return kLargestReflectance * draw(); });
  enclosure.system.emission = Eigen::VectorXd::Zero(n);
  enclosure.system.emission(0) = 100;
  return enclosure;
}

// In k steps an entry is a sum of products along at most k reflections, each of 4 roundings, 1 of the sum and 3 by
// which the rounded factors miss reciprocity; everything has one sign.
double path_rounding(int steps) {
  return gamma_bound(8 * steps);
}

// CLAIM      IU.6-12, IU.6-13: one step gives patch i the share ρ_i ΔB_j F_ji A_j/A_i, and clears what j had unshot.
// ORACLE     exact: small integers over powers of two, where the doubles do not round.
// TOLERANCE  none: equal to the last bit.
TEST(Shooting, OneStepIsThePrintedFormula) {
  proves({"IU.6-12", "IU.6-13"}, Oracle::exact, "dyadic numbers, worked by hand");
  const Eigen::Vector3d areas(1, 2, 4);
  const Eigen::Vector3d reflectance(0.5, 0.25, 0.75);
  const ShootingState before{Eigen::Vector3d(10, 20, 30), Eigen::Vector3d(8, 16, 4)};
  // Patch 1 (ΔB = 16, A = 2) sees 0 and 2 by 1/8 and 1/2, and itself by 1/4.
  const ShootingState after = shoot(before, 1, Eigen::Vector3d(0.125, 0.25, 0.5), reflectance, areas);
  const double to_0 = 0.5 * 16 * 0.125 * 2;         // 2
  const double to_1 = 0.25 * 16 * 0.25;             // 1
  const double to_2 = 0.75 * 16 * 0.5 * 2.0 / 4.0;  // 3
  EXPECT_TRUE(holds(after.radiosity == Eigen::Vector3d(10 + to_0, 20 + to_1, 30 + to_2)));
  EXPECT_TRUE(holds(after.unshot == Eigen::Vector3d(8 + to_0, to_1, 4 + to_2)));
}

// CLAIM      IU.6-12, IU.6-13: an area that is zero, negative or no number is refused by every function that weighs or
//            divides by it.
// ORACLE     identity: the documented domain.
// TOLERANCE  none: refusals.
TEST(Shooting, RefusesAreasThatAreNotPositive) {
  proves({"IU.6-12", "IU.6-13"}, Oracle::identity, "one area out of its domain");
  const Eigen::Vector2d half(0.5, 0.5), emission(8, 0);
  const ShootingState state = before_shooting(emission);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, -1.0, std::nan(""), infinity}) {
    const Eigen::Vector2d areas(1, bad);
    EXPECT_TRUE(refuses([&] { static_cast<void>(shoot(state, 0, half, half, areas)); }));
    EXPECT_TRUE(refuses([&] { static_cast<void>(brightest_unshot(state, areas)); }));
    EXPECT_TRUE(refuses([&] { static_cast<void>(unshot_share(state, emission, areas)); }));
    const RadiositySystem system{Eigen::MatrixXd::Constant(2, 2, 0.5), half, emission};
    EXPECT_TRUE(refuses([&] { static_cast<void>(shoot_until(system, areas)); }));
  }
}

// CLAIM      IU.6-13: the patch with the largest ΔB_j A_j shoots first, not the one with the largest ΔB_j.
// ORACLE     exact: small integers.
// TOLERANCE  none: an index.
TEST(Shooting, BeginsWithTheLargestUnshotPower) {
  proves({"IU.6-13"}, Oracle::exact, "small integers");
  const Eigen::Vector4d areas(1, 8, 4, 4);
  EXPECT_TRUE(holds(brightest_unshot({areas, Eigen::Vector4d(9, 2, 5, 5)}, areas) == 2)) << "20 W, the first of two";
  EXPECT_TRUE(holds(brightest_unshot({areas, Eigen::Vector4d(9, 3, 5, 5)}, areas) == 1)) << "24 W";
  EXPECT_TRUE(holds(brightest_unshot({areas, Eigen::Vector4d(25, 3, 5, 5)}, areas) == 0)) << "25 W";
}

// CLAIM      IU.6-12, IU.6-13, IU.6.6: shooting tends to the solution of 6-9 from below and never leaves its gap.
// ORACLE     exact: the system solved over the rationals.
// TOLERANCE  the returned gap, and path_rounding of the number of steps.
TEST(Shooting, TendsToTheExactSolutionFromBelow) {
  proves({"IU.6-12", "IU.6-13"}, Oracle::exact, "Gaussian elimination over CGAL::Gmpq");
  uses_seed(kSeed);
  std::mt19937_64 random(kSeed);
  for (const Eigen::Index n : {2, 5, 9}) {
    const Enclosure enclosure = random_enclosure(random, n);
    const auto exact = exact_radiosity(enclosure.system);
    for (const double share : {0.5, 1e-3, 1e-12}) {
      const ShootingReport report = shoot_until(enclosure.system, enclosure.areas, {share, 10000});
      EXPECT_TRUE(holds(report.reached && report.unshot_share <= share));
      for (Eigen::Index i = 0; i < n; ++i) {
        const double solution = CGAL::to_double(exact(i));
        const double below = CGAL::to_double(exact(i) - CGAL::Gmpq(report.state.radiosity(i)));
        const double rounding = path_rounding(report.steps) * solution;
        EXPECT_TRUE(within(std::max(0.0, -below), rounding)) << "above the solution";
        EXPECT_TRUE(within(std::max(0.0, below), report.gap + rounding)) << "beyond the gap";
      }
    }
  }
}

// CLAIM      E26: at convergence everything is absorbed, so "absorbed below 0.1 %" never comes true; it is the unshot
//            power that must be below. Absorbed and unshot power make up the emitted.
// ORACLE     identity: conservation of power in a closed room, A_i (1 − ρ_i) Σ_j F_ij (B_j − ΔB_j) summed by hand.
// TOLERANCE  path_rounding of the steps and of the sums over n² terms.
TEST(Shooting, ConvergesWhenTheUnshotPowerIsSmallAndNotTheAbsorbed) {
  proves({"E26", "IU.6-13"}, Oracle::identity, "conservation of power");
  uses_seed(kSeed);
  std::mt19937_64 random(kSeed);
  constexpr double kPrintedThreshold = 1e-3;
  const Enclosure enclosure = random_enclosure(random, 8);
  const Eigen::VectorXd& areas = enclosure.areas;
  const double emitted = enclosure.system.emission.dot(areas);
  ShootingState state = before_shooting(enclosure.system.emission);
  int steps = 0;
  constexpr int kMostSteps = 1000;
  for (; steps < kMostSteps && unshot_share(state, enclosure.system.emission, areas) > kPrintedThreshold; ++steps) {
    const Eigen::Index j = brightest_unshot(state, areas);
    state = shoot(state, j, enclosure.system.form_factors.row(j).transpose(), enclosure.system.reflectance, areas);
    const Eigen::VectorXd arrived = enclosure.system.form_factors * (state.radiosity - state.unshot);
    const double absorbed = (areas.array() * (1 - enclosure.system.reflectance.array()) * arrived.array()).sum();
    const double unshot = unshot_share(state, enclosure.system.emission, areas);
    EXPECT_TRUE(near(absorbed / emitted + unshot, 1, path_rounding(steps + 1) + gamma_bound(64 + 16)));
  }
  const ShootingReport report = shoot_until(enclosure.system, areas, {kPrintedThreshold, kMostSteps});
  EXPECT_TRUE(holds(report.reached && report.steps == steps && report.state.radiosity == state.radiosity));
  const Eigen::VectorXd arrived = enclosure.system.form_factors * (state.radiosity - state.unshot);
  const double absorbed = (areas.array() * (1 - enclosure.system.reflectance.array()) * arrived.array()).sum();
  EXPECT_TRUE(apart(absorbed / emitted, 0, kPrintedThreshold)) << "the printed criterion at convergence";
  EXPECT_TRUE(near(absorbed / emitted, 1, kPrintedThreshold + path_rounding(steps) + gamma_bound(64 + 16)));
}

// CLAIM      E27, in part: once the only source has shot, at most the largest reflectance is left, so "100 % after one
//            step" can only be the state before it.
// ORACLE     identity: Σ_i ρ_i A_i F_ji ≤ ρ_max A_j.
// TOLERANCE  rounding of one step and one sum.
TEST(Shooting, LeavesAtMostTheLargestReflectanceAfterTheSource) {
  proves({"E27"}, Oracle::identity, "6-5 and 6-6 applied to one step");
  uses_seed(kSeed);
  std::mt19937_64 random(kSeed);
  const Enclosure enclosure = random_enclosure(random, 8);
  const Eigen::VectorXd& emission = enclosure.system.emission;
  EXPECT_TRUE(near(unshot_share(before_shooting(emission), emission, enclosure.areas), 1, 0));
  const ShootingReport one = shoot_until(enclosure.system, enclosure.areas, {0, 1});
  EXPECT_TRUE(within(one.unshot_share, kLargestReflectance * (1 + gamma_bound(32))));
  EXPECT_TRUE(apart(1, one.unshot_share, 1 - kLargestReflectance - gamma_bound(32))) << "100 % after the first step";
  EXPECT_TRUE(holds(!one.reached && one.steps == 1));
}

// CLAIM      IU.6-15: in a sphere of any patches B + ρ B_amb is the solution at every step of shooting, and B_amb → 0.
// ORACLE     closed form: F_ij = A_j/ΣA gives B_i = E_i + ρ_i H with H = ΣE_jA_j/(ΣA − Σρ_jA_j), over the rationals.
// TOLERANCE  path_rounding of the steps, and γ_(8n) of the mean, the series and the sums.
TEST(AmbientTerm, CompletesTheSolutionInASphereAtEveryStep) {
  proves({"IU.6-14", "IU.6-15"}, Oracle::exact, "the sphere's closed form over CGAL::Gmpq");
  uses_seed(kSeed);
  std::mt19937_64 random(kSeed);
  constexpr int n = 7;
  const auto draw = [&] { return static_cast<double>(random() % 64 + 1) / 64; };
  const Eigen::VectorXd areas = Eigen::VectorXd::NullaryExpr(n, draw);
  const Eigen::VectorXd reflectance = Eigen::VectorXd::NullaryExpr(n, [&] { return 0.9 * draw(); });
  const Eigen::VectorXd emission = Eigen::VectorXd::NullaryExpr(n, [&] { return 10 * draw(); });
  CGAL::Gmpq emitted = 0;
  CGAL::Gmpq lost = 0;
  for (int j = 0; j < n; ++j) {
    emitted += CGAL::Gmpq(emission(j)) * CGAL::Gmpq(areas(j));
    lost += (CGAL::Gmpq(1) - CGAL::Gmpq(reflectance(j))) * CGAL::Gmpq(areas(j));
  }
  ShootingState state = before_shooting(emission);
  double first = 0;
  for (int step = 0; step < 60; ++step) {
    const double ambient = ambient_radiosity(state.unshot, reflectance, areas);
    if (step == 0) first = ambient;
    const Eigen::VectorXd shown = with_ambient_term(state.radiosity, reflectance, ambient);
    for (int i = 0; i < n; ++i) {
      const double solution = CGAL::to_double(CGAL::Gmpq(emission(i)) + CGAL::Gmpq(reflectance(i)) * (emitted / lost));
      EXPECT_TRUE(near(shown(i), solution, (path_rounding(step) + gamma_bound(8 * n)) * solution));
    }
    state = shoot(state, brightest_unshot(state, areas), estimated_form_factors(areas), reflectance, areas);
  }
  constexpr double kNearlyGone =
      1e-3;  // 60 steps are more than eight rounds of all seven patches: the mean reflectance is below 0.6
  EXPECT_TRUE(within(ambient_radiosity(state.unshot, reflectance, areas), kNearlyGone * first));
}

// CLAIM      IU.6-14, IU.6-15: mean, estimated factors and the sum of all interreflections.
// ORACLE     exact: dyadic numbers by hand; the geometric series summed term by term with its remainder ρⁿ/(1 − ρ).
// TOLERANCE  none for the dyadic ones; γ_(2n) for the series of n terms and its remainder.
TEST(AmbientTerm, MeansAndSeriesAreThoseOfTheText) {
  proves({"IU.6-14", "IU.6-15"}, Oracle::identity, "dyadic numbers and the series itself");
  const Eigen::Vector4d areas(1, 2, 4, 1);
  EXPECT_TRUE(near(mean_reflectance(Eigen::Vector4d(0.25, 0.5, 0.75, 1), areas), 5.25 / 8, 0));
  EXPECT_TRUE(holds(estimated_form_factors(areas) == Eigen::Vector4d(0.125, 0.25, 0.5, 0.125)));
  constexpr int kTerms = 200;
  for (const double reflectance : {0.0, 0.25, 0.65625, 0.9}) {
    double sum = 0;
    double term = 1;
    for (int k = 0; k < kTerms; ++k, term *= reflectance) sum += term;
    const double limit = interreflection(reflectance);
    EXPECT_TRUE(near(limit, sum + term * limit, gamma_bound(2 * kTerms) * limit));
  }
}

// CLAIM      E25: at ρ_mean = 1, which the text's interval admits, the series exceeds every bound; it is refused.
// ORACLE     identity: n terms of one.
// TOLERANCE  none: a refusal, and partial sums that are integers.
TEST(AmbientTerm, RefusesAMeanReflectanceOfOne) {
  proves({"E25"}, Oracle::identity, "partial sums at ρ = 1");
  EXPECT_TRUE(near(mean_reflectance(Eigen::Vector2d(1, 1), Eigen::Vector2d(3, 5)), 1, 0)) << "6-14 does reach 1";
  EXPECT_TRUE(refuses([] { static_cast<void>(interreflection(1)); }));
  double sum = 0;
  for (int k = 0; k < 1'000'000; ++k) sum += 1;
  EXPECT_TRUE(apart(1 / (1 - 1.0), sum, 1)) << "1/(1 − 1) as printed";
}

// CLAIM      the brightest unshot patch is asked of as many areas as patches, and of one patch at least.
// ORACLE     identity: the domain as documented.
// TOLERANCE  none.
TEST(Shooting, RefusesAreasThatDoNotFit) {
  proves({}, Oracle::identity, "areas that do not fit");
  const ShootingState two = before_shooting(Eigen::MatrixXd::Ones(2, 1)), none = before_shooting(Eigen::MatrixXd(0, 1));
  EXPECT_TRUE(holds(brightest_unshot(two, Eigen::Vector2d(1, 2)) == 1));
  EXPECT_TRUE(refuses([&] { return brightest_unshot(two, Eigen::Vector3d(1, 2, 3)); }));
  EXPECT_TRUE(refuses([&] { return brightest_unshot(two, Eigen::VectorXd::Ones(1)); }));
  EXPECT_TRUE(refuses([&] { return brightest_unshot(none, Eigen::VectorXd(0)); }));
}

}  // namespace
}  // namespace etendue::validation
