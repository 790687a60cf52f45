// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/enclosure.hpp"

#include <algorithm>
#include <cmath>

#include "radiosity/exact_system.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr std::uint64_t kSeed = 20261125;
constexpr RadiositySolver kSolvers[] = {RadiositySolver::gaussian_elimination, RadiositySolver::eigen_lu};

/// Factors between two matrices; rows of the middle sum to at most 1, those of the upper one may exceed it.
EnclosedRadiositySystem random_system(CounterRandom& random, int n, double width, double reflectance) {
  EnclosedRadiositySystem system{Eigen::MatrixXd(n, n), Eigen::MatrixXd(n, n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (int i = 0; i < n; ++i) {
    Eigen::VectorXd row(n);
    for (int j = 0; j < n; ++j) row(j) = i == j ? 0 : random.between(0.05, 1);
    row /= row.sum() * (1 + 0x1p-40);
    for (int j = 0; j < n; ++j) {
      const double below = random.unit() * width, above = random.unit() * width;
      system.lower(i, j) = row(j) * (1 - below);
      system.upper(i, j) = std::min(1.0, row(j) * (1 + above));
    }
    system.reflectance(i) = reflectance * random.unit();
    system.emission(i) = random.unit() < 0.5 ? 0 : random.between(0.1, 100);
  }
  system.emission(0) = 50;
  system.reflectance(n - 1) = reflectance;
  return system;
}

/// Some system whose factors lie in between: anywhere, or at one of the two ends of each.
RadiositySystem within_enclosure(CounterRandom& random, const EnclosedRadiositySystem& system, bool at_ends) {
  RadiositySystem one{system.lower, system.reflectance, system.emission};
  for (Eigen::Index i = 0; i < one.form_factors.rows(); ++i) {
    for (Eigen::Index j = 0; j < one.form_factors.cols(); ++j) {
      const double share = random.unit(), low = system.lower(i, j), high = system.upper(i, j);
      one.form_factors(i, j) = at_ends ? (share < 0.5 ? low : high) : std::min(high, low + share * (high - low));
    }
  }
  return one;
}

// CLAIM      IU.6-7, IU.6-9: the exact radiosities of every system whose form factors lie between the two matrices are
//            between the two vectors, up to ρ Σ F next to 1; the two systems at the ends are, too.
// ORACLE     exact arithmetic: the systems solved in rationals and substituted into 6-7.
// TOLERANCE  none for the inclusion. The ends of the enclosure may leave the exact solutions of the end systems by twice
//            the bound that solve_radiosity() proves of each, and by no more: nothing is wider than it must be.
TEST(RadiosityEnclosure, HoldsTheExactSolutionOfEverySystemInBetween) {
  proves({"IU.6-7", "IU.6-9"}, Oracle::exact, "systems in between, in rationals (GMP), substituted into 6-7");
  uses_seed(kSeed);
  CounterRandom random(kSeed);
  std::uint64_t outside = 0, decisions = 0;
  const auto inside = [&](const RadiosityEnclosure& enclosure, const RadiositySystem& system) {
    const auto truth = exact_radiosity(system);
    for (Eigen::Index i = 0; i < truth.size(); ++i) {
      outside += truth(i) < CGAL::Gmpq(enclosure.lower(i)) || truth(i) > CGAL::Gmpq(enclosure.upper(i));
      ++decisions;
    }
    return truth;
  };
  for (const double width : {0.0, 1e-12, 1e-3, 0.2}) {
    for (const double reflectance : {0.3, 0.8, 1 / (1 + 0.2)}) {
      for (const int n : {2, 7}) {
        const EnclosedRadiositySystem system = random_system(random, n, width, reflectance * (1 - 0x1p-20));
        for (const RadiositySolver solver : kSolvers) {
          const auto enclosure = enclose_radiosity(system, solver);
          ASSERT_TRUE(enclosure.ok()) << enclosure.error().message;
          for (int k = 0; k < 6; ++k) inside(*enclosure, within_enclosure(random, system, k % 2 == 0));
          const RadiositySystem low{system.lower, system.reflectance, system.emission};
          const RadiositySystem high{system.upper, system.reflectance, system.emission};
          const auto least = inside(*enclosure, low), most = inside(*enclosure, high);
          const double low_bound = solve_radiosity(low, solver)->bound,
                       high_bound = solve_radiosity(high, solver)->bound;
          for (int i = 0; i < n; ++i) {
            EXPECT_TRUE(within(CGAL::to_double(least(i) - CGAL::Gmpq(enclosure->lower(i))), 2 * low_bound));
            EXPECT_TRUE(within(CGAL::to_double(CGAL::Gmpq(enclosure->upper(i)) - most(i)), 2 * high_bound));
          }
        }
      }
    }
  }
  EXPECT_TRUE(all_agree(outside, decisions));
}

// CLAIM      IU.6-9: factors too loose to bound the radiosity (ρ Σ upper not below 1) are refused as not converged, with the
//            row; upper below lower, and what solve_radiosity() refuses, as invalid.
// ORACLE     identity: systems on either side of the rule, one ulp of ρ apart.
// TOLERANCE  none.
TEST(RadiosityEnclosure, RefusesFactorsThatAreKnownTooLoosely) {
  proves({"IU.6-9"}, Oracle::identity, "rows at and below ρ Σ F = 1");
  EnclosedRadiositySystem system{Eigen::MatrixXd::Zero(2, 2), Eigen::MatrixXd::Zero(2, 2),
                                 Eigen::VectorXd::Constant(2, 0.5), Eigen::VectorXd::Ones(2)};
  system.upper << 1, 0.75, 1, 1;  // Σ = 2 in row 1
  const auto loose = enclose_radiosity(system, RadiositySolver::gaussian_elimination);
  ASSERT_FALSE(loose.ok());
  EXPECT_TRUE(holds(loose.error().code == ErrorCode::not_converged));
  EXPECT_TRUE(holds(loose.error().message.find("row 1: reflectance 0.5") != std::string::npos))
      << loose.error().message;
  system.reflectance(1) = 0.5 - 0x1p-40;
  EXPECT_TRUE(holds(enclose_radiosity(system, RadiositySolver::gaussian_elimination).ok()));
  system.lower(0, 1) = 0.8;
  const auto crossed = enclose_radiosity(system, RadiositySolver::gaussian_elimination);
  ASSERT_FALSE(crossed.ok());
  EXPECT_TRUE(holds(crossed.error().code == ErrorCode::invalid_input));
  system.lower(0, 1) = 0;
  system.reflectance(0) = 1;
  const auto mirror = enclose_radiosity(system, RadiositySolver::gaussian_elimination);
  ASSERT_FALSE(mirror.ok());
  EXPECT_TRUE(holds(mirror.error().code == ErrorCode::invalid_input));
}

}  // namespace
}  // namespace etendue::validation
