// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/equation.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "etendue/core/rounding.hpp"
#include "etendue/radiosity/enclosure.hpp"
#include "radiosity/solver_systems.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr std::uint64_t kSeed = 20261127;

/// Six walls, one patch each, in the order −x +x −y +y −z +z: only opposite ones differ from the other four.
RowMatrix cube_factors(double opposite) {
  RowMatrix factors = RowMatrix::Constant(6, 6, (1 - opposite) / 4);
  for (int i = 0; i < 6; ++i) factors(i, i) = 0, factors(i, i ^ 1) = opposite;
  return factors;
}

// CLAIM      IU.6-7, IU.6-9: a cube with one emitting wall, a patch a wall, ρ = 0.5: the irradiances of emitter, opposite wall and
//            sides, with every solver.
// ORACLE     table: three numbers of another program, with the exact factor of opposite walls of a cube, 0.19982489569838734.
// TOLERANCE  half a unit of the sixteenth digit as printed, 5e-17, four ulp of the factor, and the returned bound.
TEST(RadiosityEquation, LightsACubeByOneWall) {
  proves({"IU.6-7", "IU.6-9"}, Oracle::table, "irradiances in a cube with one emitting wall");
  // F of opposite squares of a cube: 2/π (ln √(4/3) + 2√2 atan(1/√2) − π/2), the closed form with X = Y = 1.
  const double pi = std::acos(-1.0);
  const double opposite =
      2 / pi * (0.5 * std::log(4.0 / 3) + 2 * std::sqrt(2.0) * std::atan(1 / std::sqrt(2.0)) - pi / 2);
  RadiosityEquation equation{std::make_shared<DenseFactors>(cube_factors(opposite)),
                             Eigen::MatrixXd::Constant(6, 1, 0.5),
                             Eigen::MatrixXd::Zero(6, 1),
                             Eigen::VectorXd::Ones(6),
                             {}};
  equation.emission(2, 0) = 1;
  for (const RadiositySolver solver : all_solvers()) {
    const auto solution = solve_radiosity(equation, goal(solver, 1e-14));
    ASSERT_TRUE(solution.ok());
    const double slack = solution->bound(0) + 16 * kUnitRoundoff;
    EXPECT_TRUE(within(solution->bound(0), 2e-14)) << name(solver);
    for (int i = 0; i < 6; ++i) {
      const double expected = i == 2 ? 0.18181819621539094 : i == 3 ? 0.363491652215577 : 0.36367253789225795;
      EXPECT_TRUE(near(solution->incident(i, 0), expected, slack)) << name(solver) << " wall " << i;
    }
  }
}

/// Two perpendicular plates of unit width, endless along their common edge, each cut into strips that halve towards the
/// edge. Form factors by crossed strings.
RadiosityEquation perpendicular_plates(int strips, double rho) {
  std::vector<double> ends{0};
  for (int k = strips - 1; k >= 0; --k) ends.push_back(std::ldexp(1.0, -k));
  const auto n = static_cast<Eigen::Index>(ends.size()) - 1;
  const auto width = [&](Eigen::Index k) {
    return ends[static_cast<std::size_t>(k) + 1] - ends[static_cast<std::size_t>(k)];
  };
  RowMatrix factors = RowMatrix::Zero(2 * n, 2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = i; j < n; ++j) {  // from the narrower one: what is small keeps its digits
      const double a = ends[static_cast<std::size_t>(i)], b = ends[static_cast<std::size_t>(i) + 1];
      const double c = ends[static_cast<std::size_t>(j)], d = ends[static_cast<std::size_t>(j) + 1];
      // √(b² + c²) − √(a² + c²) = (b² − a²)/(√(b² + c²) + √(a² + c²)), and d alike
      const double factor =
          (a + b) / 2 * (1 / (std::hypot(b, c) + std::hypot(a, c)) - 1 / (std::hypot(b, d) + std::hypot(a, d)));
      factors(i, n + j) = factors(n + i, j) = factor;
      factors(j, n + i) = factors(n + j, i) = factor * width(i) / width(j);
    }
  }
  Eigen::VectorXd widths(2 * n);
  for (Eigen::Index i = 0; i < n; ++i) widths(i) = widths(n + i) = width(i);
  return {std::make_shared<DenseFactors>(factors),
          Eigen::MatrixXd::Constant(2 * n, 1, rho),
          Eigen::MatrixXd::Ones(2 * n, 1),
          widths,
          {}};
}

// CLAIM      IU.6-7: two perpendicular plates with uniform E and ρ: B tends to E/(1 − ρ/2) at the common edge, where each
//            point sees the other plate under half of what it sees.
// ORACLE     closed form: B = E + ρ B/2 in the limit. B falls away from the edge like x^s, where x^s is what the other
//            plate makes of itself: ρ/4 Β(1 + s/2, (1 − s)/2) = 1 (Β: Euler's), s = 0.86 for ρ = 0.3 and 0.63 for 0.8. So
//            the innermost of strips that halve errs by less than half as much with every two strips more.
// TOLERANCE  2·2^(−strips/2) of the answer, and each doubling of strips must come closer.
TEST(RadiosityEquation, TendsToTheEdgeOfPerpendicularPlates) {
  proves({"IU.6-7"}, Oracle::closed_form, "E/(1 − ρ/2) at the common edge");
  for (const double rho : {0.3, 0.8}) {
    const double expected = 1 / (1 - rho / 2);
    double last = 1;
    for (const int strips : {5, 10, 20, 40}) {
      const auto solution =
          solve_radiosity(perpendicular_plates(strips, rho), goal(RadiositySolver::conjugate_gradients));
      ASSERT_TRUE(solution.ok()) << solution.error().message;
      const double error = std::abs(solution->radiosity(0, 0) - expected);
      EXPECT_TRUE(within(error, 2 * std::pow(2.0, -strips / 2.0) * expected)) << strips;
      EXPECT_LT(error, 0.5 * last);
      last = error;
    }
  }
}

/// What lies around each number of an equation, relatively.
EnclosedRadiosityEquation widened(CounterRandom& random, const RadiosityEquation& equation, double width) {
  const RowMatrix factors = equation.factors->dense();
  RowMatrix low = factors, high = factors;
  EnclosedRadiosityEquation ends;
  ends.reflectance_lower = ends.reflectance_upper = equation.reflectance;
  ends.emission_lower = ends.emission_upper = equation.emission;
  const auto spread = [&](auto& lower, auto& upper) {
    for (Eigen::Index k = 0; k < lower.size(); ++k) {
      const double down = random.unit() * width, up = random.unit() * width;
      lower.data()[k] *= 1 - down;
      upper.data()[k] *= 1 + up;
    }
  };
  spread(low, high);
  spread(ends.reflectance_lower, ends.reflectance_upper);
  spread(ends.emission_lower, ends.emission_upper);
  ends.factors_lower = std::make_shared<DenseFactors>(low);
  ends.factors_upper = std::make_shared<DenseFactors>(RowMatrix(high.cwiseMin(1.0)));
  ends.areas = equation.areas;
  return ends;
}

// CLAIM      IU.6-7, IU.6-9: given intervals for F, ρ and E, every patch and channel gets an interval that holds the exact
//            solution of every system in between, the ones at the ends among them, with every solver.
// ORACLE     exact arithmetic: systems in between, at random and at the corners, in rationals.
// TOLERANCE  none for the inclusion; the ends of the intervals leave the exact ends by at most twice the tolerance asked.
TEST(RadiosityEquation, IntervalsHoldTheSolutionsOfAllDataInBetween) {
  proves({"IU.6-7", "IU.6-9"}, Oracle::exact, "systems in between, in rationals (GMP), substituted into 6-7");
  uses_seed(kSeed);
  CounterRandom random(kSeed);
  std::uint64_t outside = 0, decisions = 0;
  for (const double width : {0.0, 1e-9, 0.05}) {
    const RadiosityEquation middle = dyadic_equation(random, 6, 2, 0.8);
    const EnclosedRadiosityEquation ends = widened(random, middle, width);
    std::vector<RadiosityEnclosure> found;
    for (const RadiositySolver solver : all_solvers()) {
      const auto enclosure = enclose_radiosity(ends, goal(solver, 1e-12));
      ASSERT_TRUE(enclosure.ok()) << enclosure.error().message;
      found.push_back(*enclosure);
    }
    for (int trial = 0; trial < 8; ++trial) {
      // 0 and 1: the two ends themselves; even ones: corners; odd ones: anywhere.
      const auto between = [&](double low, double high) {
        const double share = random.unit();
        if (trial < 2) return trial == 0 ? low : high;
        if (trial % 2 == 0) return share < 0.5 ? low : high;
        return std::min(high, low + share * (high - low));
      };
      for (Eigen::Index c = 0; c < 2; ++c) {
        RadiositySystem system{ends.factors_lower->dense(), ends.reflectance_lower.col(c), ends.emission_lower.col(c)};
        const Eigen::MatrixXd high = ends.factors_upper->dense();
        for (Eigen::Index k = 0; k < high.size(); ++k) {
          system.form_factors(k) = between(system.form_factors(k), high(k));
        }
        for (Eigen::Index i = 0; i < 6; ++i) {
          system.reflectance(i) = between(system.reflectance(i), ends.reflectance_upper(i, c));
          system.emission(i) = between(system.emission(i), ends.emission_upper(i, c));
        }
        const auto truth = exact_radiosity(system);
        for (const RadiosityEnclosure& enclosure : found) {
          const double slack = 2e-12 * enclosure.upper.col(c).maxCoeff();
          for (Eigen::Index i = 0; i < 6; ++i) {
            const CGAL::Gmpq low(enclosure.lower(i, c)), up(enclosure.upper(i, c));
            outside += truth(i) < low || truth(i) > up;
            ++decisions;
            if (trial == 0) {
              EXPECT_TRUE(within(CGAL::to_double(truth(i) - low), slack));
            }
            if (trial == 1) {
              EXPECT_TRUE(within(CGAL::to_double(up - truth(i)), slack));
            }
          }
        }
      }
    }
  }
  EXPECT_TRUE(all_agree(outside, decisions));
}

// CLAIM      IU.6-9: data that cannot bound anything, or whose lower end is above the upper, are refused by name.
// ORACLE     identity: one defect each.
// TOLERANCE  none.
TEST(RadiosityEquation, RefusesIntervalsThatAreNone) {
  proves({"IU.6-9"}, Oracle::identity, "one defect each");
  uses_seed(kSeed + 1);
  CounterRandom random(kSeed + 1);
  const EnclosedRadiosityEquation good = widened(random, dyadic_equation(random, 4, 2, 0.8), 0.01);
  const auto refused = [](const EnclosedRadiosityEquation& ends, const std::string& words, ErrorCode code) {
    const auto enclosure = enclose_radiosity(ends, goal(RadiositySolver::gaussian_elimination));
    ASSERT_FALSE(enclosure.ok()) << words;
    EXPECT_TRUE(holds(enclosure.error().code == code)) << enclosure.error().message;
    EXPECT_TRUE(holds(enclosure.error().message.find(words) != std::string::npos)) << enclosure.error().message;
  };
  EnclosedRadiosityEquation bad = good;
  bad.reflectance_lower(2, 1) = bad.reflectance_upper(2, 1) + 0.1;
  refused(bad, "channel 1: enclosed radiosity system: row 2: the reflectance", ErrorCode::invalid_input);
  bad = good;
  bad.emission_lower(3, 0) = std::nan("");
  refused(bad, "channel 0: enclosed radiosity system: row 3: the emission", ErrorCode::invalid_input);
  bad = good;
  std::swap(bad.factors_lower, bad.factors_upper);
  refused(bad, "is said to lie between", ErrorCode::invalid_input);
  bad = good;
  bad.factors_upper = std::make_shared<DenseFactors>(RowMatrix(RowMatrix::Ones(4, 4)));
  bad.reflectance_lower.setConstant(0.2);
  bad.reflectance_upper.setConstant(0.25);
  refused(bad, "known too loosely", ErrorCode::not_converged);
  bad = good;
  bad.reflectance_upper(1, 0) = 1;
  refused(bad, "upper end: channel 0: radiosity system: row 1: reflectance 1", ErrorCode::invalid_input);
  bad = good;
  bad.emission_upper.resize(4, 1);
  refused(bad, "differ in number", ErrorCode::invalid_input);
}

// CLAIM      IU.6-6, IU.6-7: bad data are refused with channel, row and value, whatever the solver; rows that sum to more than 1
//            and the excess allowed are reported, the worst first.
// ORACLE     identity: one defect each.
// TOLERANCE  none.
TEST(RadiosityEquation, RefusesBadDataByChannelAndRow) {
  proves({"IU.6-6", "IU.6-7"}, Oracle::identity, "one defect each");
  uses_seed(kSeed + 2);
  CounterRandom random(kSeed + 2);
  const RadiosityEquation good = dyadic_equation(random, 5, 3, 0.6);
  RadiosityGoal wanted = goal(RadiositySolver::conjugate_gradients);
  wanted.rules.row_excess = 1e-3;
  ASSERT_TRUE(solve_radiosity(good, wanted).ok());
  const auto refused = [&](const RadiosityEquation& bad, const std::string& words,
                           ErrorCode code = ErrorCode::invalid_input) {
    const auto solution = solve_radiosity(bad, wanted);
    ASSERT_FALSE(solution.ok()) << words;
    EXPECT_TRUE(holds(solution.error().code == code));
    EXPECT_TRUE(holds(solution.error().message.find(words) != std::string::npos)) << solution.error().message;
  };
  const auto with = [&](auto change) {
    RadiosityEquation bad = good;
    change(bad);
    return bad;
  };
  refused(with([](auto& e) { e.reflectance(3, 2) = 1; }),
          "channel 2: radiosity system: row 3: reflectance 1 is not in [0, 1)");
  refused(with([](auto& e) { e.reflectance(3, 1) = -0.5; }), "channel 1: radiosity system: row 3: reflectance -0.5");
  refused(with([](auto& e) { e.reflectance(0, 0) = std::nan(""); }),
          "channel 0: radiosity system: row 0: reflectance nan");
  refused(with([](auto& e) { e.emission(4, 1) = -2; }), "channel 1: radiosity system: row 4: emission -2 is negative");
  refused(with([](auto& e) { e.emission(4, 1) = std::numeric_limits<double>::infinity(); }), "row 4: emission inf");
  refused(with([](auto& e) { e.emission.setConstant(1e308); }), "overflow");
  refused(with([](auto& e) { e.areas(2) = 0; }), "row 2: area 0 is not positive");
  refused(with([](auto& e) { e.areas(2) = std::nan(""); }), "row 2: area nan");
  refused(with([](auto& e) { e.areas.conservativeResize(4); }), "there are 5 patches and 4 areas");
  refused(with([](auto& e) { e.areas.resize(0); }), "there are none", ErrorCode::usage);
  refused(with([](auto& e) { e.reflectance.conservativeResize(5, 2); }), "ρ has 2 channels and E 3");
  refused(with([](auto& e) { e.emission.conservativeResize(4, 3); }), "they must belong to the same patches");
  refused(with([](auto& e) {
            RowMatrix f = e.factors->dense();
            f(1, 2) = std::nan("");
            e.factors = std::make_shared<DenseFactors>(f);
          }),
          "F(1, 2) = nan");
  refused(with([](auto& e) {
            RowMatrix f = e.factors->dense();
            f(4, 0) = -1e-9;
            e.factors = std::make_shared<SparseFactors>(SparseRows(f.sparseView()));
          }),
          "F(4, 0) = -1e-09");
  const auto heavy = with([](auto& e) {
    RowMatrix f = e.factors->dense();
    for (int row : {1, 3}) f.row(row) *= (row == 3 ? 1.25 : 1.125) / f.row(row).sum();
    e.factors = std::make_shared<DenseFactors>(f);
  });
  refused(heavy, "2 rows sum to more than 1 + 0.001: row 3 to 1.25");
  wanted.rules.row_excess.reset();
  EXPECT_TRUE(holds(solve_radiosity(heavy, wanted).ok())) << "ρ Σ F is below 1";
}

// CLAIM      IU.6-7: without an emitter every radiosity is exactly 0, its bound too, and the report says that it is dark; so is
//            a dark channel among others.
// ORACLE     closed form: 0.
// TOLERANCE  none.
TEST(RadiosityEquation, IsDarkWithoutAnEmitter) {
  proves({"IU.6-7"}, Oracle::closed_form, "B = 0");
  uses_seed(kSeed + 3);
  CounterRandom random(kSeed + 3);
  RadiosityEquation equation = dyadic_equation(random, 7, 2, 0.8);
  equation.emission.col(1).setZero();
  for (const RadiositySolver solver : all_solvers()) {
    const auto half = solve_radiosity(equation, goal(solver));
    EXPECT_TRUE(holds(half->status == RadiosityStatus::reached && !half->dark && half->bound(1) == 0 &&
                      half->radiosity.col(1).isZero(0) && half->radiosity(0, 0) > 0))
        << name(solver);
    RadiosityEquation dark = equation;
    dark.emission.setZero();
    const auto none = solve_radiosity(dark, goal(solver));
    EXPECT_TRUE(holds(none->dark && none->radiosity.isZero(0) && none->bound.isZero(0))) << name(solver);
  }
}

// CLAIM      IU.6-7: an iteration that is stopped, runs out of steps, meets factors that are not reciprocal or is asked for more
//            than double holds says so, and its bound holds all the same.
// ORACLE     exact arithmetic: the system in rationals.
// TOLERANCE  the returned bound.
TEST(RadiosityEquation, SaysHowAnIterationEnded) {
  proves({"IU.6-7"}, Oracle::exact, "the same system in rationals (GMP)");
  uses_seed(kSeed + 4);
  CounterRandom random(kSeed + 4);
  RadiosityEquation equation = dyadic_equation(random, 8, 1, 0.95);
  const auto truth = exact_radiosity(channel_of(equation, 0));
  const auto ended = [&](const RadiosityGoal& wanted, RadiosityStatus status) {
    const auto solution = solve_radiosity(equation, wanted);
    ASSERT_TRUE(solution.ok());
    EXPECT_TRUE(holds(solution->status == status)) << name(wanted.solver) << ": " << words(solution->status);
    EXPECT_TRUE(within(true_error(solution->radiosity.col(0), truth), solution->bound(0)));
  };
  for (const RadiositySolver solver : all_solvers()) {
    if (is_direct(solver)) continue;
    ended(goal(solver, 0), RadiosityStatus::rounding);
    RadiosityGoal wanted = goal(solver);
    wanted.most_steps = 1;
    ended(wanted, RadiosityStatus::limit);
    wanted = goal(solver);
    wanted.may_go_on = [](Eigen::Index done, Eigen::Index total) {
      EXPECT_TRUE(done >= 0 && done <= total);
      return false;
    };
    ended(wanted, RadiosityStatus::stopped);
  }
  RadiosityGoal stopped = goal(RadiositySolver::gaussian_elimination);
  stopped.may_go_on = [](Eigen::Index, Eigen::Index) { return false; };
  EXPECT_TRUE(holds(solve_radiosity(equation, stopped).error().code == ErrorCode::stopped));
  // Areas that have nothing to do with the factors: conjugate gradients end somewhere, with a bound that holds.
  for (Eigen::Index i = 0; i < 8; ++i) equation.areas(i) = i % 2 == 0 ? 1 : 1000;
  const auto crooked = solve_radiosity(equation, goal(RadiositySolver::conjugate_gradients));
  EXPECT_TRUE(within(true_error(crooked->radiosity.col(0), truth), crooked->bound(0)));
  equation.factors = std::make_shared<OperatorFactors>(
      8, 9, [f = equation.factors](const Eigen::MatrixXd& x) -> Eigen::MatrixXd { return f->times(x); });
  for (const RadiositySolver solver : {RadiositySolver::gauss_seidel, RadiositySolver::southwell}) {
    const auto refused = solve_radiosity(equation, goal(solver));
    EXPECT_TRUE(holds(!refused.ok() && refused.error().code == ErrorCode::usage));
  }
}

}  // namespace
}  // namespace etendue::validation
