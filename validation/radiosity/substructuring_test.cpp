// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/substructuring.hpp"

#include <cmath>
#include <cstdint>
#include <random>

#include "etendue/form_factor/point_polygon.hpp"
#include "oracles/parallel_plates.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr std::uint64_t kSeed = 61619;
constexpr int kScale = 64;  // all drawn numbers are k/64 with k ≤ 64: products of three and their sums are exact

// CLAIM      IU.6-16 … IU.6-19: averaging the elements' radiosities over a patch gives the radiosity that the averaged
//            form factors give, whatever the patches' radiosities are.
// ORACLE     exact: integers of 64 bits; areas are chosen so that every patch has an area of 4.
// TOLERANCE  none: equal to the last bit, because the doubles do not round here.
TEST(Substructuring, MeansOfElementsAreTheEquationOfThePatches) {
  proves({"IU.6-16", "IU.6-17", "IU.6-18", "IU.6-19"}, Oracle::exact, "64-bit integers");
  uses_seed(kSeed);
  std::mt19937_64 random(kSeed);
  const auto draw = [&] { return static_cast<std::int64_t>(random() % kScale); };
  constexpr Eigen::Index n = 3;
  const Substructure structure{{0, 0, 1, 1, 1, 2}, Eigen::VectorXd{{1, 3, 1, 1, 2, 4}}, n};
  constexpr std::int64_t areas[] = {1, 3, 1, 1, 2, 4};
  constexpr std::int64_t kPatchArea = 4;
  constexpr Eigen::Index elements = 6;
  for (int round = 0; round < 50; ++round) {
    std::int64_t factor[elements][n];
    std::int64_t emission[n], reflectance[n], radiosity[n];
    Eigen::MatrixXd factors(elements, n);
    Eigen::VectorXd element_emission(elements), element_reflectance(elements), patch_radiosity(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      emission[i] = draw();
      reflectance[i] = draw();
      radiosity[i] = draw();
      patch_radiosity(i) = static_cast<double>(radiosity[i]) / kScale;
    }
    for (Eigen::Index q = 0; q < elements; ++q) {
      const Eigen::Index i = structure.patch_of[static_cast<std::size_t>(q)];
      element_emission(q) = static_cast<double>(emission[i]) / kScale;
      element_reflectance(q) = static_cast<double>(reflectance[i]) / kScale;
      for (Eigen::Index j = 0; j < n; ++j) {
        factor[q][j] = draw();
        factors(q, j) = static_cast<double>(factor[q][j]) / kScale;
      }
    }
    const Eigen::VectorXd of_elements =
        element_radiosities(factors, element_emission, element_reflectance, patch_radiosity);
    const Eigen::VectorXd means = patch_means(structure, of_elements);
    const Eigen::MatrixXd patch_factors = patch_form_factors(structure, factors);
    for (Eigen::Index i = 0; i < n; ++i) {
      std::int64_t gathered = 0;  // Σ_j B_j Σ_q F_qj A_q, in units of 64⁻²
      for (Eigen::Index j = 0; j < n; ++j) {
        std::int64_t weighted = 0;
        for (Eigen::Index q = 0; q < elements; ++q) {
          if (structure.patch_of[static_cast<std::size_t>(q)] == i) weighted += factor[q][j] * areas[q];
        }
        EXPECT_TRUE(near(patch_factors(i, j), static_cast<double>(weighted) / (kScale * kPatchArea), 0)) << "6-19";
        gathered += radiosity[j] * weighted;
      }
      // B_i = E_i + ρ_i Σ_j B_j F_ij in units of 64⁻³ / 4
      const std::int64_t right = emission[i] * kScale * kScale * kPatchArea + reflectance[i] * gathered;
      const double unit = 1.0 / (static_cast<double>(kScale) * kScale * kScale * kPatchArea);
      EXPECT_TRUE(near(means(i), static_cast<double>(right) * unit, 0)) << "6-17 against 6-18";
    }
  }
}

// The factor between unit squares at a distance, the lower one divided into n × n elements with one value each.
double by_elements(int n, double distance) {
  const auto above = Polygon::make({{0, 0, distance}, {0, 1, distance}, {1, 1, distance}, {1, 0, distance}}).value();
  const int count = n * n;
  Substructure structure{std::vector<Eigen::Index>(static_cast<std::size_t>(count), 0),
                         Eigen::VectorXd::Constant(count, 1.0 / count), 1};
  Eigen::MatrixXd factors(count, 1);
  for (int q = 0; q < count; ++q) {
    const Vec3 centre((q % n + 0.5) / n, (q / n + 0.5) / n, 0);
    factors(q, 0) = point_to_polygon(centre, Vec3::UnitZ(), above).value;
  }
  return patch_form_factors(structure, factors)(0, 0);
}

double order(double coarse, double fine) {
  return std::log2(std::abs(coarse / fine));
}

// CLAIM      IU.6-19: the mean over elements is better than the one value at the patch's centre, with second order in
//            the elements' size.
// ORACLE     closed form of parallel squares at 600 bits.
// TOLERANCE  order 2 ± 0.05; the terms of fourth order are a 64th of that at n = 8.
TEST(Substructuring, ImprovesOnOneValueAPatchWithSecondOrder) {
  proves({"IU.6-19"}, Oracle::closed_form, "parallel squares at 600 bits");
  constexpr double kOrderTolerance = 0.05;
  const double exact = oracle::parallel_plates(1, 1);
  const double one = by_elements(1, 1) - exact;
  const double four = by_elements(2, 1) - exact;
  EXPECT_TRUE(within(std::abs(four), std::abs(one) / 2)) << "four elements at least halve the error";
  EXPECT_TRUE(near(order(by_elements(8, 1) - exact, by_elements(16, 1) - exact), 2, kOrderTolerance));
}

// CLAIM      IU.6-10: far away compared with a patch's size the inner integral is constant over the patch: the relative
//            error of the value at its centre falls with the square of the distance.
// ORACLE     closed form of parallel squares at 600 bits.
// TOLERANCE  order 2 ± 0.05 between 8 and 16 sides; the next term is smaller by 1/d² ≤ 1/64.
TEST(Substructuring, OneValueAPatchIsEnoughFarAway) {
  proves({"IU.6-10"}, Oracle::closed_form, "parallel squares at 600 bits");
  constexpr double kOrderTolerance = 0.05;
  const auto relative = [](double d) { return by_elements(1, d) / oracle::parallel_plates(1 / d, 1 / d) - 1; };
  EXPECT_TRUE(near(order(relative(8), relative(16)), 2, kOrderTolerance));
  EXPECT_TRUE(within(std::abs(relative(16)), 1.0 / (16 * 16))) << "below (side/distance)²";
  EXPECT_TRUE(apart(by_elements(1, 0.5), oracle::parallel_plates(2, 2), 0.01)) << "near by it is wrong";
}

// CLAIM      radiosities of elements need a factor for every patch, an emission and a reflectance for every element.
// ORACLE     identity: the domain as documented.
// TOLERANCE  none.
TEST(Substructuring, RefusesSizesThatDoNotFit) {
  proves({}, Oracle::identity, "sizes that do not fit");
  const auto solve = [](Eigen::Index patches, Eigen::Index emissions, Eigen::Index reflectances) {
    return element_radiosities(Eigen::MatrixXd::Constant(3, 2, 0.25), Eigen::VectorXd::Ones(emissions),
                               Eigen::VectorXd::Constant(reflectances, 0.5), Eigen::VectorXd::Ones(patches));
  };
  EXPECT_TRUE(holds(solve(2, 3, 3) == Eigen::VectorXd::Constant(3, 1.25)));
  EXPECT_TRUE(refuses([&] { return solve(3, 3, 3); }));
  EXPECT_TRUE(refuses([&] { return solve(2, 4, 3); }));
  EXPECT_TRUE(refuses([&] { return solve(2, 3, 4); }));
}

}  // namespace
}  // namespace etendue::validation
