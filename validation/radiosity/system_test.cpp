// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/system.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "etendue/core/rounding.hpp"
#include "etendue/radiosity/balance.hpp"
#include "etendue/radiosity/certificate.hpp"
#include "radiosity/exact_system.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr RadiositySolver kSolvers[] = {RadiositySolver::gaussian_elimination, RadiositySolver::eigen_lu};

struct Enclosure {
  RadiositySystem system;
  Eigen::VectorXd areas;
};

// Areas a_i and symmetric exchange areas s_ij = A_i F_ij with rows that sum to `closure` A_i: reciprocal by
// construction. Made by symmetric scaling of random positive numbers (Sinkhorn); the last scaling is by rows, so rows
// sum to `closure` up to rounding and reciprocity holds up to the convergence of the scaling.
Enclosure random_enclosure(std::mt19937_64& random, int n, double closure, double max_reflectance) {
  std::uniform_real_distribution<double> unit(0.05, 1);
  Enclosure enclosure{{Eigen::MatrixXd(n, n), Eigen::VectorXd(n), Eigen::VectorXd(n)}, Eigen::VectorXd(n)};
  Eigen::MatrixXd exchange(n, n);
  for (int i = 0; i < n; ++i) {
    enclosure.areas(i) = unit(random);
    enclosure.system.reflectance(i) = max_reflectance * unit(random);
    enclosure.system.emission(i) = random() % 3 ? 0 : 100 * unit(random);
    for (int j = 0; j <= i; ++j) exchange(i, j) = exchange(j, i) = i == j ? 0 : unit(random);
  }
  enclosure.system.emission(0) = 50;
  enclosure.system.reflectance(n - 1) = max_reflectance;
  for (int sweep = 0; sweep < 2000; ++sweep) {
    const Eigen::VectorXd scale = (enclosure.areas.array() / exchange.rowwise().sum().array()).sqrt();
    exchange = scale.asDiagonal() * exchange * scale.asDiagonal();
  }
  enclosure.system.form_factors = closure * (exchange.rowwise().sum().cwiseInverse().asDiagonal() * exchange);
  return enclosure;
}

// CLAIM      IU.6-7, IU.6-8, IU.6-9: the solution of either solver is within its returned bound, up to ρ = 1 − 2^-30.
// ORACLE     exact arithmetic: the system solved in rationals and substituted into 6-7.
// TOLERANCE  the returned bound, proved in lib/etendue/radiosity/NOTES.md.
TEST(RadiositySystem, TrueErrorStaysInsideTheReturnedBound) {
  proves({"IU.6-7", "IU.6-8", "IU.6-9"}, Oracle::exact, "the same system in rationals (GMP), substituted into 6-7");
  std::mt19937_64 random(30);
  for (const double rho : {0.3, 0.9, 1 - 0x1p-10, 1 - 0x1p-30}) {
    for (const int n : {2, 5, 12}) {
      for (const double closure : {1.0, 0.7}) {
        Enclosure enclosure = random_enclosure(random, n, closure, rho);
        if (n == 5) enclosure.system.reflectance.setConstant(rho);  // nearly singular as a whole, not in one row
        const auto truth = exact_radiosity(enclosure.system);
        for (const RadiositySolver solver : kSolvers) {
          const auto solution = solve_radiosity(enclosure.system, solver);
          ASSERT_TRUE(solution.ok()) << solution.error().message;
          EXPECT_TRUE(within(true_error(solution->radiosity, truth), solution->bound));
        }
      }
    }
  }
}

// CLAIM      IU.6-9: the bound holds for any vector, not only for solutions, and is attained: a patch that sees only
//            outside, moved by δ, is off by δ and the bound says so.
// ORACLE     exact arithmetic for random vectors; closed form δ for the attained case.
// TOLERANCE  the bound; attained within its documented rounding 2 γ_(2n+20) of the magnitudes.
TEST(RadiositySystem, BoundHoldsForAnyVectorAndIsAttained) {
  proves({"IU.6-9"}, Oracle::exact, "distance to the rational solution");
  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> entry(-100, 300);
  for (int trial = 0; trial < 40; ++trial) {
    const Enclosure enclosure = random_enclosure(random, 6, 1, 0.9);
    Eigen::VectorXd guess(6);
    for (int i = 0; i < 6; ++i) guess(i) = entry(random);
    const auto truth = exact_radiosity(enclosure.system);
    EXPECT_TRUE(within(true_error(guess, truth), residual_bound(enclosure.system, guess).bound));
  }
  const RadiositySystem lone{Eigen::MatrixXd::Zero(1, 1), Eigen::VectorXd::Constant(1, 0.5), Eigen::VectorXd::Ones(1)};
  const double bound = residual_bound(lone, Eigen::VectorXd::Constant(1, 1.25)).bound;
  EXPECT_TRUE(near(bound, 0.25, 2 * gamma_bound(22) * 2.25));
}

// CLAIM      IU.6-9: the denominator is rounded down: dominance() is at most 1 − ρ Σ F, and close to it.
// ORACLE     exact arithmetic: the same expression in rationals.
// TOLERANCE  γ_(2n+10) (1 + ρ Σ F) below, nothing above.
TEST(RadiositySystem, DominanceIsRoundedDown) {
  proves({"IU.6-9"}, Oracle::exact, "1 − ρ Σ F in rationals (GMP)");
  std::mt19937_64 random(32);
  std::uniform_real_distribution<double> unit(0, 1);
  std::uint64_t above = 0, checked = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const int n = 1 + trial % 40;
    RadiositySystem system{Eigen::MatrixXd(1, n), Eigen::VectorXd::Constant(1, 1 - unit(random) * 0x1p-20),
                           Eigen::VectorXd::Zero(1)};
    for (int j = 0; j < n; ++j) system.form_factors(0, j) = unit(random);
    system.form_factors /= system.form_factors.sum();
    CGAL::Gmpq sum = 0;
    for (int j = 0; j < n; ++j) sum += CGAL::Gmpq(system.form_factors(0, j));
    const CGAL::Gmpq exact = CGAL::Gmpq(1) - CGAL::Gmpq(system.reflectance(0)) * sum;
    const double computed = dominance(system, 0);
    above += CGAL::Gmpq(computed) > exact;
    ++checked;
    EXPECT_TRUE(within(std::abs(CGAL::to_double(exact - CGAL::Gmpq(computed))), 2 * gamma_bound(2 * n + 10)));
  }
  EXPECT_TRUE(all_agree(above, checked));
}

// CLAIM      IU.6.3x: the three patches of 6-8, eliminated by hand.
// ORACLE     exact arithmetic: Cramer's rule on the matrix of 6-9, its determinants written out, in rationals.
// TOLERANCE  the returned bound.
TEST(RadiositySystem, SolvesTheThreePatchesWrittenByHand) {
  proves({"IU.6.3x", "IU.6-8", "IU.6-9"}, Oracle::exact, "Cramer's rule for three unknowns in rationals (GMP)");
  using Rational = CGAL::Gmpq;
  // A closed triangular duct with sides 3, 4, 5: crossed strings give F_12 = (3+4−5)/6, F_13 = (3+5−4)/6 and so on.
  RadiositySystem system{Eigen::MatrixXd(3, 3), Eigen::Vector3d(0.5, 0.75, 0.25), Eigen::Vector3d(8, 0, 1)};
  system.form_factors << 0, 1. / 3, 2. / 3, 0.25, 0, 0.75, 0.4, 0.6, 0;
  const auto m = [&](int i, int j) {
    return Rational(i == j ? 1 : 0) - Rational(system.reflectance(i)) * Rational(system.form_factors(i, j));
  };
  const auto determinant = [&](int replaced) {
    const auto at = [&](int i, int j) { return j == replaced ? Rational(system.emission(i)) : m(i, j); };
    return Rational(at(0, 0) * (at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1)) -
                    at(0, 1) * (at(1, 0) * at(2, 2) - at(1, 2) * at(2, 0)) +
                    at(0, 2) * (at(1, 0) * at(2, 1) - at(1, 1) * at(2, 0)));
  };
  DenseVector<Rational> cramer(3);
  for (int k = 0; k < 3; ++k) cramer(k) = determinant(k) / determinant(-1);
  for (const RadiositySolver solver : kSolvers) {
    const auto solution = solve_radiosity(system, solver);
    ASSERT_TRUE(solution.ok());
    EXPECT_TRUE(within(true_error(solution->radiosity, cramer), solution->bound));
  }
}

// CLAIM      IU.6-1: in the energy form A_i B_i = A_i E_i + ρ_i Σ_j B_j F_ji A_j the power [W] that leaves every patch
//            is what it emits and reflects; with reciprocal factors that is the system 6-7. All that is emitted is
//            absorbed or escapes.
// ORACLE     identity: the energy form itself, and power in = power out.
// TOLERANCE  A_i (bound + the reciprocity defect of the data), summed over the patches for the balance.
TEST(RadiositySystem, KeepsThePowerBalanceOfEveryPatch) {
  proves({"IU.6-1", "IU.6-7"}, Oracle::identity, "the energy form 6-1, written with F_ji A_j");
  std::mt19937_64 random(33);
  for (const double closure : {1.0, 0.6}) {
    const Enclosure enclosure = random_enclosure(random, 20, closure, 0.8);
    const RadiositySystem& system = enclosure.system;
    const Eigen::VectorXd& areas = enclosure.areas;
    const auto solution = solve_radiosity(system, RadiositySolver::gaussian_elimination);
    ASSERT_TRUE(solution.ok());
    const Eigen::VectorXd& b = solution->radiosity;
    const double slack = solution->bound * areas.sum() + 20 * reciprocity_defect(system.form_factors, areas) * b.sum() +
                         gamma_bound(60) * areas.sum() * b.maxCoeff();
    for (int i = 0; i < 20; ++i) {
      double arriving = 0;
      for (int j = 0; j < 20; ++j) arriving += b(j) * system.form_factors(j, i) * areas(j);
      EXPECT_TRUE(near(areas(i) * b(i), areas(i) * system.emission(i) + system.reflectance(i) * arriving, slack));
    }
    const PowerBalance balance = power_balance(system, areas, b);
    EXPECT_TRUE(near(balance.emitted, areas.dot(system.emission), slack));
    EXPECT_TRUE(near(balance.absorbed + balance.escaped, balance.emitted, 2 * slack));
    EXPECT_TRUE(near(balance.defect, 0, 2 * slack));
    EXPECT_GT(balance.absorbed, 0);
    EXPECT_EQ(closure<1, balance.escaped> slack);
  }
}

// CLAIM      IU.6-7: more emission, reflectance or form factor anywhere never dims any patch.
// ORACLE     metamorphic: the Neumann series Σ (diag(ρ)F)^k E has non-negative terms.
// TOLERANCE  the bounds of the two solutions.
TEST(RadiositySystem, GrowsWithEveryDatum) {
  proves({"IU.6-7"}, Oracle::metamorphic, "monotonicity of the Neumann series");
  std::mt19937_64 random(34);
  for (int trial = 0; trial < 60; ++trial) {
    const Enclosure enclosure = random_enclosure(random, 7, 0.9, 0.8);
    RadiositySystem more = enclosure.system;
    const int i = static_cast<int>(random() % 7), j = static_cast<int>(random() % 7);
    if (trial % 3 == 0) more.emission(i) += 10;
    if (trial % 3 == 1) more.reflectance(i) += 0.1;
    if (trial % 3 == 2) more.form_factors(i, j) += 0.05;
    const auto before = solve_radiosity(enclosure.system, kSolvers[trial % 2]);
    const auto after = solve_radiosity(more, kSolvers[trial % 2]);
    ASSERT_TRUE(before.ok() && after.ok());
    const double dimmed = (before->radiosity - after->radiosity).maxCoeff();
    EXPECT_TRUE(within(std::max(dimmed, 0.0), before->bound + after->bound));
    EXPECT_GT(after->radiosity.sum(), before->radiosity.sum());
  }
}

// CLAIM      IU.6-7: in a closed furnace with uniform E and ρ every patch has E/(1 − ρ), inside the returned bound.
// ORACLE     closed form: E/(1 − ρ).
// TOLERANCE  1e-12 relatively for ρ ≤ 0.9 (the bar of the project; 2γ_203 = 4.5e-14 and the closure defect over 1 − ρ allow it
//            up to 0.95 for 200 patches), and for any ρ the returned bound plus the effect
//            ρ |1 − Σ F| E/(1−ρ)² of rows that do not sum to one exactly.
TEST(RadiositySystem, FillsAFurnaceWithEmissionOverOneMinusReflectance) {
  proves({"IU.6-7", "IU.6-9"}, Oracle::closed_form, "E/(1 − ρ)");
  std::mt19937_64 random(35);
  for (const int n : {6, 60, 200}) {
    for (const double rho : {0.0, 0.5, 0.9}) {
      Enclosure enclosure = random_enclosure(random, n, 1, rho);
      enclosure.system.reflectance.setConstant(rho);
      enclosure.system.emission.setConstant(3);
      const double expected = 3 / (1 - rho);
      const double closure = closure_defects(enclosure.system.form_factors).cwiseAbs().maxCoeff();
      for (const RadiositySolver solver : kSolvers) {
        const auto solution = solve_radiosity(enclosure.system, solver);
        ASSERT_TRUE(solution.ok());
        const double error = (solution->radiosity.array() - expected).abs().maxCoeff();
        EXPECT_TRUE(within(error, 1e-12 * expected));
        const double data = rho * (closure + gamma_bound(n)) * expected / (1 - rho);
        EXPECT_TRUE(within(error, solution->bound + 2 * data + 2 * kUnitRoundoff * expected));
      }
    }
  }
}

// CLAIM      E25: at ρ = 1 the interreflections 1 + ρ + ρ² + … diverge, though the text admits ρ = 1; ρ = 1 is refused.
// ORACLE     identity: the partial sums of a furnace grow by E with every reflection.
// TOLERANCE  none: a refusal; n E for the sums, exact in double.
TEST(RadiositySystem, RefusesAMirrorWhite) {
  proves({"E25", "IU.6-7"}, Oracle::identity, "partial sums of 6-15 at ρ = 1");
  double sum = 0;
  for (int k = 0; k < 1000; ++k) sum += 1.0 * 2.5;  // ρ^k E with ρ = 1
  EXPECT_TRUE(near(sum, 2500, 0));
  EXPECT_TRUE(std::isinf(1 / (1 - 1.0)));
  RadiositySystem system{Eigen::MatrixXd::Constant(2, 2, 0.5), Eigen::Vector2d(1, 1), Eigen::Vector2d(2.5, 2.5)};
  for (const RadiositySolver solver : kSolvers) {
    system.reflectance = Eigen::Vector2d(0.5, 1);
    const auto refused = solve_radiosity(system, solver);
    ASSERT_FALSE(refused.ok());
    EXPECT_TRUE(holds(refused.error().message.find("row 1") != std::string::npos)) << refused.error().message;
    system.reflectance = Eigen::Vector2d(0.5, 1 - 0x1p-30);
    EXPECT_TRUE(solve_radiosity(system, solver).ok());
  }
}

// CLAIM      IU.6-9: every documented refusal comes, with the row and its value.
// ORACLE     identity: systems with one defect each.
// TOLERANCE  none: refusals and their words.
TEST(RadiositySystem, RefusesBadDataNamingTheRow) {
  proves({"IU.6-9"}, Oracle::identity, "systems with one defect each");
  const RadiositySystem good{Eigen::MatrixXd::Constant(3, 3, 0.3), Eigen::Vector3d::Constant(0.5),
                             Eigen::Vector3d::Ones()};
  ASSERT_TRUE(solve_radiosity(good, RadiositySolver::gaussian_elimination).ok());
  std::vector<std::pair<RadiositySystem, std::string>> bad;
  const auto with = [&](const std::string& words) -> RadiositySystem& {
    bad.emplace_back(good, words);
    return bad.back().first;
  };
  with("they must belong to the same patches").emission = Eigen::Vector2d::Ones();
  with("F is 3 × 2").form_factors = Eigen::MatrixXd::Zero(3, 2);
  with("row 2: emission").emission(2) = std::numeric_limits<double>::infinity();
  with("row 1: reflectance -0.25").reflectance(1) = -0.25;
  with("row 1: reflectance nan").reflectance(1) = std::nan("");
  with("F(2, 0) = -0.125").form_factors(2, 0) = -0.125;
  with("F(0, 1) = nan").form_factors(0, 1) = std::nan("");
  with("row 0: emission nan").emission(0) = std::nan("");
  with("row 2: emission -1 is negative").emission(2) = -1;
  with("row 1: F(1, 2) = 3 is not a fraction of power").form_factors(1, 2) = 3;
  with("row 0: F(0, 2) = 1.0000").form_factors(0, 2) = 1 + 2 * Tolerance{}.relative;
  RadiositySystem& reflects_all = with("row 1: ρ Σ_j F_ij = 2.25");
  reflects_all.form_factors.row(1).setOnes();
  reflects_all.reflectance(1) = 0.75;
  with("there is no patch") = RadiositySystem{Eigen::MatrixXd(0, 0), Eigen::VectorXd(0), Eigen::VectorXd(0)};
  for (const auto& [system, words] : bad) {
    const auto refused = solve_radiosity(system, RadiositySolver::gaussian_elimination);
    ASSERT_FALSE(refused.ok()) << words;
    EXPECT_TRUE(holds(refused.error().code == ErrorCode::invalid_input));
    EXPECT_TRUE(holds(refused.error().message.find(words) != std::string::npos)) << refused.error().message;
  }
}

// CLAIM      IU.6-9: a form factor may exceed 1 by its stated error and by no more.
// ORACLE     identity: two plates that see each other only, F_12 just inside and just outside.
// TOLERANCE  none: accepted or refused.
TEST(RadiositySystem, LetsFormFactorsExceedOneByTheirErrorOnly) {
  proves({"IU.6-9"}, Oracle::identity, "F_12 = 1 + error, and the next double but one");
  RadiositySystem system{Eigen::MatrixXd(2, 2), Eigen::Vector2d(0.5, 0.5), Eigen::Vector2d(1, 0)};
  system.form_factors << 0, 1, 1, 0;
  for (const double error : {0.0, Tolerance{}.relative, 1e-4}) {
    system.form_factors(0, 1) = 1 + error;
    EXPECT_TRUE(holds(solve_radiosity(system, RadiositySolver::gaussian_elimination, error).ok()));
    system.form_factors(0, 1) = (1 + error) * (1 + 4 * kUnitRoundoff);
    EXPECT_TRUE(holds(!solve_radiosity(system, RadiositySolver::gaussian_elimination, error).ok()));
  }
  EXPECT_TRUE(refuses([&] { static_cast<void>(solve_radiosity(system, RadiositySolver::eigen_lu, std::nan(""))); }));
}

// CLAIM      IU.6-9: an emission so large that radiosities, or the sums that bound them, overflow is an invalid input,
//            named with its row; what stays in range is solved.
// ORACLE     closed form: two plates that see each other only, B_1 = E/(1 − ρ²).
// TOLERANCE  the returned bound; refusals and their words.
TEST(RadiositySystem, RefusesEmissionsThatOverflow) {
  proves({"IU.6-9"}, Oracle::closed_form, "E/(1 − ρ²) near the largest double");
  RadiositySystem system{Eigen::MatrixXd(2, 2), Eigen::Vector2d(0.5, 0.5), Eigen::Vector2d(0, 0)};
  system.form_factors << 0, 1, 1, 0;
  for (const RadiositySolver solver : kSolvers) {
    for (const double emission : {1e307, 1e308, std::numeric_limits<double>::max()}) {
      system.emission(1) = emission;
      const auto refused = solve_radiosity(system, solver);
      ASSERT_FALSE(refused.ok());
      EXPECT_TRUE(holds(refused.error().code == ErrorCode::invalid_input));
      EXPECT_TRUE(holds(refused.error().message.find("row 1: emission ") != std::string::npos));
      EXPECT_TRUE(holds(refused.error().message.find("overflow") != std::string::npos)) << refused.error().message;
    }
    system.emission(1) = 1e306;
    const auto solution = solve_radiosity(system, solver);
    ASSERT_TRUE(solution.ok()) << solution.error().message;
    EXPECT_TRUE(near(solution->radiosity(1), 1e306 / 0.75, solution->bound + kUnitRoundoff * 2e306));
  }
}

// CLAIM      IU.6-9: what breaks the premises of the proof gets no bound: negative form factors, reflectances or factor
//            bounds, emissions and radiosities that are no numbers. Sums that overflow give an infinite bound.
// ORACLE     identity: F = −5 and B = E/(1 + 5 ρ) have residual 0, though M = I − ρF is not of the proved kind.
// TOLERANCE  none: refusals, infinities.
TEST(RadiositySystem, ProvesNothingOutsideItsPremises) {
  proves({"IU.6-9"}, Oracle::identity, "one premise broken at a time");
  const auto lone = [](double factor, double reflectance, double emission) {
    return RadiositySystem{Eigen::MatrixXd::Constant(1, 1, factor), Eigen::VectorXd::Constant(1, reflectance),
                           Eigen::VectorXd::Constant(1, emission)};
  };
  const auto refused = [](const RadiositySystem& system, double radiosity, double factor_bound) {
    const Eigen::VectorXd b = Eigen::VectorXd::Constant(1, radiosity);
    const Eigen::MatrixXd bounds = Eigen::MatrixXd::Constant(1, 1, factor_bound);
    EXPECT_TRUE(refuses([&] { static_cast<void>(residual_bound(system, b, bounds)); }));
    if (!(factor_bound >= 0)) return;
    EXPECT_TRUE(refuses([&] { static_cast<void>(residual_bound(system, b)); }));
  };
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::nan("");
  refused(lone(-5, 0.5, 7), 2, 0);
  refused(lone(nan, 0.5, 7), 2, 0);
  refused(lone(0.5, -0.5, 7), 2, 0);
  refused(lone(0.5, nan, 7), 2, 0);
  refused(lone(0.5, 0.5, infinity), 2, 0);
  refused(lone(0.5, 0.5, 7), nan, 0);
  refused(lone(0.5, 0.5, 7), infinity, 0);
  refused(lone(0.5, 0.5, 7), 2, -1e-9);
  refused(lone(0.5, 0.5, 7), 2, nan);
  const Eigen::VectorXd largest = Eigen::VectorXd::Constant(1, std::numeric_limits<double>::max());
  const RadiositySystem brilliant = lone(0.5, 0.5, 1e308);
  EXPECT_TRUE(holds(residual_bound(brilliant, largest).bound == infinity));
  EXPECT_TRUE(holds(residual_bound(brilliant, -largest, Eigen::MatrixXd::Zero(1, 1)).bound == infinity));
}

// CLAIM      IU.6-5, IU.6-6: closure and reciprocity defects of a matrix are what was put into it.
// ORACLE     closed form: 3-4-5 duct by crossed strings (closed, reciprocal); then row 1 scaled by 3/4.
// TOLERANCE  γ_3 for the sums of three, γ_8 times the areas for the products.
TEST(RadiositySystem, MeasuresClosureAndReciprocity) {
  proves({"IU.6-5", "IU.6-6"}, Oracle::closed_form, "crossed strings in a 3-4-5 triangular duct");
  Eigen::MatrixXd factors(3, 3);
  factors << 0, 1. / 3, 2. / 3, 0.25, 0, 0.75, 0.4, 0.6, 0;
  const Eigen::Vector3d areas(3, 4, 5);
  EXPECT_TRUE(near(closure_defects(factors).cwiseAbs().maxCoeff(), 0, 2 * gamma_bound(3)));
  EXPECT_TRUE(near(reciprocity_defect(factors, areas), 0, gamma_bound(8) * 5));
  factors.row(1) *= 0.75;
  EXPECT_TRUE(near(closure_defects(factors)(1), 0.25, gamma_bound(3)));
  EXPECT_TRUE(near(reciprocity_defect(factors, areas), 0.75, gamma_bound(8) * 5));  // 4 · 0.1875 against 5 · 0.6 = 3
}

// CLAIM      G16: radiosity is not limited to polygons: patches may be curved, and see themselves.
// ORACLE     closed form: from a patch of a sphere's inside every other, and itself, is seen with its share a_j of the sphere, so
//            that B_i = E_i + ρ_i Σ a_j E_j / (1 − Σ a_j ρ_j).
// TOLERANCE  the solution's own bound, and γ_16 of 2 for the closed form.
TEST(RadiositySystem, HoldsInsideASphere) {
  proves({"G16", "IU.6-7"}, Oracle::closed_form, "F_ij = a_j inside a sphere");
  const Eigen::Vector4d share(0.125, 0.25, 0.5, 0.125), reflectance(0.9, 0.5, 0.25, 0), emission(0, 1, 0.5, 2);
  const RadiositySystem sphere{Eigen::Vector4d::Ones() * share.transpose(), reflectance, emission};
  const auto solved = solve_radiosity(sphere, RadiositySolver::gaussian_elimination);
  ASSERT_TRUE(solved.ok());
  const double arriving = share.dot(emission) / (1 - share.dot(reflectance));
  for (Eigen::Index i = 0; i < 4; ++i)
    EXPECT_TRUE(
        near(solved->radiosity[i], emission[i] + reflectance[i] * arriving, solved->bound + 2 * gamma_bound(16)));
}

}  // namespace
}  // namespace etendue::validation
