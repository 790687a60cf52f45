// SPDX-License-Identifier: Apache-2.0
#include <CGAL/Interval_nt.h>

#include <cmath>
#include <string>

#include "etendue/core/rounding.hpp"
#include "etendue/radiosity/balance.hpp"
#include "etendue/radiosity/certificate.hpp"
#include "radiosity/solver_systems.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr std::uint64_t kSeed = 20261126;

/// The same form factors in each form that a caller may have: dense, sparse, a function that multiplies.
std::vector<std::shared_ptr<const FormFactors>> forms(const FormFactors& factors) {
  const Eigen::MatrixXd dense = factors.dense();
  const auto times = [dense](const Eigen::MatrixXd& x) -> Eigen::MatrixXd { return dense * x; };
  return {std::make_shared<DenseFactors>(dense), std::make_shared<SparseFactors>(SparseRows(dense.sparseView())),
          std::make_shared<OperatorFactors>(dense.rows(), static_cast<int>(dense.rows()) + 1, times)};
}

bool needs_rows(RadiositySolver solver) {
  return solver == RadiositySolver::gauss_seidel || solver == RadiositySolver::southwell;
}

// CLAIM      IU.6-7, IU.6-8, IU.6-9, IU.6-12, IU.6-13: with every solver and every form of F each channel is within its
//            returned bound of the exact solution, and the bound within the tolerance asked, for 1 to 60 patches, black,
//            dark and concave ones among them.
// ORACLE     exact arithmetic: the same system in rationals, substituted into 6-7.
// TOLERANCE  the returned bound; of it, the tolerance 1e-10 of the largest radiosity.
TEST(Solvers, StayWithinTheirBoundsOfTheExactSolution) {
  proves({"IU.6-7", "IU.6-8", "IU.6-9", "IU.6-12", "IU.6-13"}, Oracle::exact, "the same system in rationals (GMP)");
  uses_seed(kSeed);
  CounterRandom random(kSeed);
  for (const Eigen::Index n : {1, 2, 3, 5, 9, 30, 60}) {
    for (const double rho : {0.4, 0.99}) {
      if (n > 9 && rho > 0.5 && n < 60) continue;
      const Eigen::Index channels = n > 9 ? 1 : 3;
      RadiosityEquation equation = dyadic_equation(random, n, channels, rho);
      std::vector<DenseVector<CGAL::Gmpq>> truth;
      for (Eigen::Index c = 0; c < channels; ++c) truth.push_back(exact_radiosity(channel_of(equation, c)));
      for (const auto& form : forms(*equation.factors)) {
        equation.factors = form;
        for (const RadiositySolver solver : all_solvers()) {
          if (needs_rows(solver) && !form->by_rows()) continue;
          const auto solution = solve_radiosity(equation, goal(solver));
          ASSERT_TRUE(solution.ok()) << solution.error().message;
          EXPECT_TRUE(holds(solution->status == RadiosityStatus::reached)) << name(solver) << " " << n;
          for (Eigen::Index c = 0; c < channels; ++c) {
            const Eigen::VectorXd b = solution->radiosity.col(c);
            EXPECT_TRUE(within(true_error(b, truth[static_cast<std::size_t>(c)]), solution->bound(c))) << name(solver);
            EXPECT_TRUE(within(solution->bound(c), 1e-10 * b.maxCoeff())) << name(solver);
          }
        }
      }
    }
  }
}

// CLAIM      IU.6-7, IU.6-9: a sphere of any patches, up to 2,000 of them: every solver is within its bound of the closed
//            form, for every reflectance and emission.
// ORACLE     exact: B_i = E_i + ρ_i Σ A E / Σ A (1 − ρ) over the rationals; F_ij = A_j/ΣA are exact doubles.
// TOLERANCE  the returned bound, and the tolerance asked.
TEST(Solvers, FillASphereOfAnyPatches) {
  proves({"IU.6-7", "IU.6-9"}, Oracle::exact, "the sphere's closed form over CGAL::Gmpq");
  uses_seed(kSeed + 1);
  CounterRandom random(kSeed + 1);
  for (const Eigen::Index n : {1, 4, 50, 2000}) {
    const RadiosityEquation equation = sphere_equation(random, n, 2, 0.95);
    for (const RadiositySolver solver : all_solvers()) {
      // An elimination of 2,000 rows takes longer than all else together; a product shows as much.
      if (n > 50 && (is_direct(solver) || solver == RadiositySolver::southwell)) continue;
      const auto solution = solve_radiosity(equation, goal(solver));
      ASSERT_TRUE(solution.ok()) << solution.error().message;
      EXPECT_TRUE(holds(solution->status == RadiosityStatus::reached)) << name(solver);
      for (Eigen::Index c = 0; c < 2; ++c) {
        EXPECT_TRUE(within(true_error(solution->radiosity.col(c), sphere_truth(equation, c)), solution->bound(c)))
            << name(solver);
        EXPECT_TRUE(within(solution->bound(c), 1e-10 * solution->radiosity.col(c).maxCoeff())) << name(solver);
      }
    }
  }
}

/// Two vectors around the solution, by X ← X ∩ (E + ρ F X) in intervals that the processor rounds outward.
std::vector<CGAL::Interval_nt<false>> enclosed(const RadiosityEquation& equation, int sweeps) {
  using Interval = CGAL::Interval_nt<false>;
  const Interval::Protector upward;
  const auto& factors = dynamic_cast<const DenseFactors&>(*equation.factors).matrix();
  const auto n = static_cast<std::size_t>(factors.rows());
  double largest = 0;
  for (Eigen::Index i = 0; i < factors.rows(); ++i) largest = std::max(largest, equation.emission(i, 0));
  // No row reflects more than half: B ≤ 2 max E, doubled once more.
  std::vector<Interval> x(n, Interval(0, 4 * largest));
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (std::size_t i = 0; i < n; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      Interval sum = 0;
      for (std::size_t j = 0; j < n; ++j) {
        const double factor = factors(row, static_cast<Eigen::Index>(j));
        if (factor != 0) sum += Interval(factor) * x[j];
      }
      const Interval next = Interval(equation.emission(row, 0)) + Interval(equation.reflectance(row, 0)) * sum;
      x[i] = Interval(std::max(next.inf(), x[i].inf()), std::min(next.sup(), x[i].sup()));
    }
  }
  return x;
}

// CLAIM      IU.6-7, IU.6-9: in an irregular open room of 2,000 patches every solver's answer, widened by its bound, meets
//            the interval that holds the exact one, for every patch.
// ORACLE     interval iteration with directed rounding (CGAL::Interval_nt), which shares no arithmetic with ours.
// TOLERANCE  the returned bound and the width of the interval.
TEST(Solvers, MeetTheIntervalsOfALargeRoom) {
  proves({"IU.6-7", "IU.6-9"}, Oracle::exact, "interval Gauss–Seidel with directed rounding");
  constexpr Eigen::Index kPatches = 2000;
  uses_seed(kSeed + 2);
  CounterRandom random(kSeed + 2);
  RadiosityEquation equation = dyadic_equation(random, kPatches, 1, 0.5);
  RowMatrix factors = dynamic_cast<const DenseFactors&>(*equation.factors).matrix();
  ASSERT_GT(factors.rowwise().sum().minCoeff(), 0) << "patches see each other";
  const auto truth = enclosed(equation, 35);
  for (const RadiositySolver solver : all_solvers()) {
    const auto solution = solve_radiosity(equation, goal(solver));
    ASSERT_TRUE(solution.ok()) << solution.error().message;
    std::uint64_t outside = 0;
    double farthest = 0;
    for (Eigen::Index i = 0; i < kPatches; ++i) {
      const auto& interval = truth[static_cast<std::size_t>(i)];
      const double b = solution->radiosity(i, 0), bound = solution->bound(0);
      outside += b + bound < interval.inf() || b - bound > interval.sup();
      farthest = std::max({farthest, b - interval.inf(), interval.sup() - b});
    }
    EXPECT_TRUE(all_agree(outside, kPatches)) << name(solver);
    EXPECT_TRUE(within(farthest, 1e-9 * solution->radiosity.maxCoeff())) << name(solver);
  }
}

// CLAIM      IU.6-7: a closed furnace has E/(1 − ρ) on every patch at ρ = 0.5, 0.9, 0.99 and 0.999 with every solver.
// ORACLE     closed form: E/(1 − ρ), ρ as the double it is.
// TOLERANCE  the returned bound, and two roundings of the expected value; rows sum to one exactly.
TEST(Solvers, FillAFurnace) {
  proves({"IU.6-7", "IU.6-8"}, Oracle::closed_form, "E/(1 − ρ)");
  uses_seed(kSeed + 3);
  CounterRandom random(kSeed + 3);
  for (const double rho : {0.5, 0.9, 0.99, 0.999}) {
    RadiosityEquation equation = sphere_equation(random, 24, 2, 0.5);
    equation.reflectance.setConstant(rho);
    equation.emission.col(0).setConstant(3);
    equation.emission.col(1).setConstant(1000);
    for (const RadiositySolver solver : all_solvers()) {
      const auto solution = solve_radiosity(equation, goal(solver));
      ASSERT_TRUE(solution.ok());
      EXPECT_TRUE(holds(solution->status == RadiosityStatus::reached)) << name(solver) << " " << rho;
      for (Eigen::Index c = 0; c < 2; ++c) {
        const double expected = equation.emission(0, c) / (1 - rho);
        const double error = (solution->radiosity.col(c).array() - expected).abs().maxCoeff();
        EXPECT_TRUE(within(error, solution->bound(c) + 2 * kUnitRoundoff * expected)) << name(solver);
      }
    }
  }
}

// CLAIM      IU.6-7: after k steps Jacobi has k + 1 terms of E (1 + ρ + ρ² + …) and leaves the share ρ^(k+1) of the furnace's
//            E/(1 − ρ), a factor ρ a step, neither more nor less. A limit of k steps ends with that, and says so.
// ORACLE     closed form: the geometric series.
// TOLERANCE  2k + 2 roundings of the series, two of the expected value.
TEST(Solvers, JacobiLeavesAPowerOfTheReflectance) {
  proves({"IU.6-7"}, Oracle::closed_form, "the remainder of the geometric series");
  uses_seed(kSeed + 4);
  CounterRandom random(kSeed + 4);
  for (const double rho : {0.5, 0.9, 0.999}) {
    RadiosityEquation equation = sphere_equation(random, 16, 1, 0.5);
    equation.reflectance.setConstant(rho);
    equation.emission.setConstant(3);
    for (const int k : {0, 1, 2, 5, 17}) {
      RadiosityGoal wanted = goal(RadiositySolver::jacobi);
      wanted.most_steps = k;
      const auto solution = solve_radiosity(equation, wanted);
      ASSERT_TRUE(solution.ok());
      EXPECT_TRUE(holds(solution->status == RadiosityStatus::limit && solution->steps == k));
      const double whole = 3 / (1 - rho), expected = whole * std::pow(rho, k + 1);
      const double left = whole - solution->radiosity(5, 0);
      EXPECT_TRUE(near(left, expected, (2 * k + 6) * kUnitRoundoff * whole));
      EXPECT_TRUE(within(left, solution->bound(0)));
    }
  }
}

// CLAIM      IU.6-1, IU.6-7: what is emitted is absorbed or escapes, to the bound, with every solver; a closed room lets
//            nothing out.
// ORACLE     identity: power in = power out.
// TOLERANCE  Σ A_i (bound + rounding of a sum of n): each of emitted, absorbed and escaped changes by at most A_i times the
//            error of B_i, and sums of n products of the magnitudes round by γ_(n+4).
TEST(Solvers, KeepThePowerBalance) {
  proves({"IU.6-1", "IU.6-7"}, Oracle::identity, "power in = power out");
  uses_seed(kSeed + 5);
  CounterRandom random(kSeed + 5);
  for (const bool closed : {true, false}) {
    const RadiosityEquation equation =
        closed ? sphere_equation(random, 40, 3, 0.9) : dyadic_equation(random, 40, 3, 0.9);
    for (const RadiositySolver solver : all_solvers()) {
      const auto solution = solve_radiosity(equation, goal(solver));
      ASSERT_TRUE(solution.ok());
      for (Eigen::Index c = 0; c < 3; ++c) {
        const PowerBalance power = power_balance(equation, *solution, c);
        const double slack =
            equation.areas.sum() * (2 * solution->bound(c) + gamma_bound(100) * solution->radiosity.col(c).maxCoeff());
        EXPECT_TRUE(near(power.emitted, equation.areas.dot(equation.emission.col(c)), slack));
        EXPECT_TRUE(near(power.absorbed + power.escaped, power.emitted, slack)) << name(solver);
        EXPECT_EQ(closed, std::abs(power.escaped) <= slack);
      }
    }
  }
}

// CLAIM      IU.6-7: one number of threads is as good as another: a product's blocks in any order give the same bits.
// ORACLE     identity: blocks done backwards, and none scheduled.
// TOLERANCE  none.
TEST(Solvers, GiveTheSameBitsHoweverBlocksAreScheduled) {
  proves({"IU.6-7"}, Oracle::identity, "a schedule that runs backwards");
  uses_seed(kSeed + 6);
  CounterRandom random(kSeed + 6);
  RadiosityEquation equation = dyadic_equation(random, 301, 3, 0.8);
  const Eigen::MatrixXd factors = equation.factors->dense();
  Eigen::Index most_blocks = 0;
  const Schedule backwards = [&](Eigen::Index count, const std::function<void(Eigen::Index)>& body) {
    most_blocks = std::max(most_blocks, count);
    for (Eigen::Index k = count; k-- > 0;) body(k);
  };
  for (const RadiositySolver solver : {RadiositySolver::jacobi, RadiositySolver::conjugate_gradients}) {
    equation.factors = std::make_shared<DenseFactors>(factors);
    const auto plain = solve_radiosity(equation, goal(solver));
    equation.factors = std::make_shared<DenseFactors>(factors, backwards);
    const auto scheduled = solve_radiosity(equation, goal(solver));
    EXPECT_TRUE(holds(plain->radiosity == scheduled->radiosity && plain->bound == scheduled->bound));
  }
  EXPECT_GT(most_blocks, 8);
}

// CLAIM      IU.6-7: conjugate directions are conjugate: n of them are enough for n patches, but for rounding.
// ORACLE     identity: the method ends after n steps in exact arithmetic.
// TOLERANCE  three steps more, for what rounding takes from conjugacy.
TEST(Solvers, ConjugateGradientsNeedNoMoreStepsThanPatches) {
  proves({"IU.6-7"}, Oracle::identity, "finite termination, 20 rooms of 4 to 23 patches");
  uses_seed(kSeed + 9);
  CounterRandom random(kSeed + 9);
  for (Eigen::Index n = 4; n < 24; ++n) {
    const auto solution =
        solve_radiosity(dyadic_equation(random, n, 1, 0.99), goal(RadiositySolver::conjugate_gradients, 1e-11));
    ASSERT_TRUE(solution.ok() && solution->status == RadiosityStatus::reached) << n;
    EXPECT_TRUE(within(static_cast<double>(solution->steps), static_cast<double>(n + 3)));
  }
}

// CLAIM      IU.6-7, IU.6-12: every solver does the same to watts as to 2^±500 of them, and to square metres as to 2^±400: the
//            same bits, scaled.
// ORACLE     metamorphic: powers of two.
// TOLERANCE  none.
TEST(Solvers, KnowNoUnit) {
  proves({"IU.6-7", "IU.6-12"}, Oracle::metamorphic, "emissions and areas times powers of two");
  uses_seed(kSeed + 8);
  CounterRandom random(kSeed + 8);
  const RadiosityEquation equation = dyadic_equation(random, 20, 2, 0.9);
  for (const RadiositySolver solver : all_solvers()) {
    const auto plain = solve_radiosity(equation, goal(solver));
    ASSERT_TRUE(plain.ok() && plain->status == RadiosityStatus::reached) << name(solver);
    for (const int power : {-500, 500}) {
      RadiosityEquation scaled = equation;
      scaled.emission *= std::ldexp(1.0, power);
      scaled.areas *= std::ldexp(1.0, power * 4 / 5);
      const auto solution = solve_radiosity(scaled, goal(solver));
      ASSERT_TRUE(solution.ok()) << name(solver) << solution.error().message;
      EXPECT_TRUE(holds(solution->radiosity == plain->radiosity * std::ldexp(1.0, power))) << name(solver) << power;
      EXPECT_TRUE(holds(solution->steps == plain->steps && solution->status == plain->status)) << name(solver);
    }
  }
}

// CLAIM      IU.6-7: a product with dense or sparse factors keeps the number of roundings that it states, also where the
//            numbers of rows and columns are no multiples of those taken at once.
// ORACLE     exact: the same sums in rationals.
// TOLERANCE  γ_k Σ F |x|, k the stated number; nothing underflows.
TEST(Solvers, ProductsKeepTheirRoundings) {
  proves({"IU.6-7"}, Oracle::exact, "Σ F_ij x_j in rationals (GMP)");
  uses_seed(kSeed + 7);
  CounterRandom random(kSeed + 7);
  for (const Eigen::Index n : {1, 2, 3, 4, 5, 7, 8, 11, 64, 517}) {
    RowMatrix factors(n, n);
    Eigen::MatrixXd x(n, 2);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) factors(i, j) = random.unit() < 0.3 ? 0 : random.unit();
      for (Eigen::Index c = 0; c < 2; ++c) x(i, c) = random.between(-1, 3);
    }
    const DenseFactors dense(factors);
    const SparseFactors sparse(SparseRows(factors.sparseView()));
    for (const FormFactors* form : std::initializer_list<const FormFactors*>{&dense, &sparse}) {
      const Eigen::MatrixXd product = form->times(x);
      for (Eigen::Index i = 0; i<n; i += n> 100 ? 37 : 1) {
        for (Eigen::Index c = 0; c < 2; ++c) {
          CGAL::Gmpq sum = 0;
          double magnitude = 0;
          for (Eigen::Index j = 0; j < n; ++j) {
            sum += CGAL::Gmpq(factors(i, j)) * CGAL::Gmpq(x(j, c));
            magnitude += factors(i, j) * std::abs(x(j, c));
          }
          const double error = std::abs(CGAL::to_double(CGAL::Gmpq(product(i, c)) - sum));
          EXPECT_TRUE(within(error, gamma_bound(form->roundings()) * magnitude * (1 + gamma_bound(600))));
        }
      }
      EXPECT_TRUE(holds(form->column(n - 1) == factors.col(n - 1)));
      EXPECT_TRUE(holds(RowMatrix(form->dense()) == factors));
    }
  }
}

}  // namespace
}  // namespace etendue::validation
