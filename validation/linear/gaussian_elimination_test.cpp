// SPDX-License-Identifier: Apache-2.0
#include "etendue/linear/gaussian_elimination.hpp"

#include <CGAL/Gmpq.h>

#include <cmath>
#include <limits>
#include <random>

#include "etendue/core/rounding.hpp"
#include "etendue/linear/dense_solve.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

using Rational = CGAL::Gmpq;
using RationalMatrix = DenseMatrix<Rational>;
using RationalVector = DenseVector<Rational>;

RationalMatrix exact(const Eigen::MatrixXd& matrix) {
  RationalMatrix result(matrix.rows(), matrix.cols());
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) result(i, j) = Rational(matrix(i, j));
  }
  return result;
}

RationalMatrix hilbert(int n) {
  RationalMatrix result(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) result(i, j) = Rational(1, i + j + 1);
  }
  return result;
}

RationalVector times(const RationalMatrix& matrix, const RationalVector& x) {
  RationalVector result(matrix.rows());
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    result(i) = Rational(0);
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) result(i) += matrix(i, j) * x(j);
  }
  return result;
}

Eigen::MatrixXd random_matrix(std::mt19937_64& random, int n) {
  std::uniform_real_distribution<double> entry(-1, 1);
  Eigen::MatrixXd matrix(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) matrix(i, j) = entry(random);
  }
  return matrix;
}

// Rows scaled by 2^-40 … 2^40, in random order: elimination without pivoting loses everything here.
Eigen::MatrixXd graded_matrix(std::mt19937_64& random, int n) {
  Eigen::MatrixXd matrix = random_matrix(random, n);
  for (int i = 0; i < n; ++i) matrix.row(i) *= std::ldexp(1.0, static_cast<int>(random() % 81) - 40);
  return matrix;
}

struct ExactBackwardError {
  Rational normwise, componentwise;
};

ExactBackwardError exact_backward_error(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& x,
                                        const Eigen::VectorXd& rhs) {
  const auto size = [](double v) { return Rational(std::abs(v)); };
  ExactBackwardError worst{0, 0};
  Rational matrix_norm = 0, x_norm = 0, rhs_norm = 0, residual_norm = 0;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Rational residual(rhs(i)), scale = size(rhs(i)), row = 0;
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      residual -= Rational(matrix(i, j)) * Rational(x(j));
      scale += size(matrix(i, j)) * size(x(j));
      row += size(matrix(i, j));
    }
    const Rational magnitude = residual < 0 ? Rational(-residual) : residual;
    matrix_norm = std::max(matrix_norm, row);
    x_norm = std::max(x_norm, size(x(i)));
    rhs_norm = std::max(rhs_norm, size(rhs(i)));
    residual_norm = std::max(residual_norm, magnitude);
    worst.componentwise = std::max(worst.componentwise, Rational(magnitude / scale));
  }
  worst.normwise = residual_norm / (matrix_norm * x_norm + rhs_norm);
  return worst;
}

// CLAIM      IU.6-9: over the rationals Gaussian elimination returns the solution itself, for the Hilbert matrix of
//            order 12 (condition 1e16), graded and random ones, and where the first pivots are zero.
// ORACLE     identity: A x = b, multiplied out in exact rationals.
// TOLERANCE  none: every component of A x equals that of b.
TEST(GaussianElimination, SolvesExactlyOverTheRationals) {
  proves({"IU.6-9"}, Oracle::exact, "A x = b multiplied out in rationals (GMP)");
  std::mt19937_64 random(20);
  std::vector<RationalMatrix> matrices{hilbert(12), exact(graded_matrix(random, 8)), exact(random_matrix(random, 9))};
  matrices.push_back(exact(random_matrix(random, 6)));
  for (int k = 0; k < 3; ++k) matrices.back()(k, k) = 0;  // and so must swap
  std::uint64_t wrong = 0, checked = 0;
  for (const auto& matrix : matrices) {
    RationalVector rhs(matrix.rows());
    for (Eigen::Index i = 0; i < rhs.size(); ++i) rhs(i) = Rational(static_cast<int>(random() % 100), 7);
    const auto x = gaussian_elimination<Rational>(matrix, rhs);
    ASSERT_TRUE(x.ok());
    const RationalVector product = times(matrix, *x);
    for (Eigen::Index i = 0; i < rhs.size(); ++i, ++checked) wrong += product(i) != rhs(i);
  }
  EXPECT_TRUE(all_agree(wrong, checked));
}

// CLAIM      IU.6-9: both double solvers return an upper bound of the backward error of what they return.
// ORACLE     exact arithmetic: residual and scale of the same x in rationals.
// TOLERANCE  the returned value; it may exceed the truth by the documented enclosure γ_(n+2) times two, no more.
TEST(GaussianElimination, BackwardErrorEnclosesTheExactOne) {
  proves({"IU.6-9"}, Oracle::exact, "componentwise and normwise backward error in rationals (GMP)");
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> entry(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    const int n = 2 + trial / 2;
    const Eigen::MatrixXd matrix = trial % 2 ? graded_matrix(random, n) : random_matrix(random, n);
    Eigen::VectorXd rhs(n);
    for (int i = 0; i < n; ++i) rhs(i) = entry(random);
    for (const auto& solution : {solve_gaussian(matrix, rhs), solve_eigen_lu(matrix, rhs)}) {
      ASSERT_TRUE(solution.ok());
      const ExactBackwardError truth = exact_backward_error(matrix, solution->x, rhs);
      const BackwardError& claimed = solution->backward_error;
      EXPECT_TRUE(within(CGAL::to_double(truth.componentwise), claimed.componentwise));
      EXPECT_TRUE(within(CGAL::to_double(truth.normwise), claimed.normwise));
      const double enclosure = 2 * gamma_bound(n + 2);
      EXPECT_TRUE(within(claimed.componentwise, CGAL::to_double(truth.componentwise) + enclosure));
    }
  }
}

// CLAIM      IU.6-9: pivoting keeps the normwise backward error of graded matrices at rounding level.
// ORACLE     closed form: Wilkinson's bound n² γ_(3n) g with the growth factor g ≤ 2^(n−1), here with n = 8.
// TOLERANCE  that bound: without pivoting the error of these matrices exceeds it (the mutant was seen to).
TEST(GaussianElimination, PivotingKeepsGradedSystemsStable) {
  proves({"IU.6-9"}, Oracle::closed_form, "Wilkinson's a-priori bound");
  std::mt19937_64 random(22);
  constexpr int n = 8;
  const double wilkinson = n * n * gamma_bound(3 * n) * std::ldexp(1.0, n - 1);
  for (int trial = 0; trial < 50; ++trial) {
    Eigen::MatrixXd matrix = graded_matrix(random, n);
    matrix(0, 0) = 1e-30;  // an unlucky first pivot
    const auto solution = solve_gaussian(matrix, Eigen::VectorXd::Ones(n));
    ASSERT_TRUE(solution.ok());
    EXPECT_TRUE(within(solution->backward_error.normwise, wilkinson));
  }
}

// CLAIM      IU.6-9: a singular matrix is refused and the column that depends on the others is named, by both solvers
//            in double and over the rationals, where rounding cannot hide it.
// ORACLE     identity: column 2 is the sum of columns 0 and 1.
// TOLERANCE  none: refusals and their words.
TEST(GaussianElimination, RefusesSingularMatricesNamingTheColumn) {
  proves({"IU.6-9"}, Oracle::identity, "a matrix made singular in a known column");
  Eigen::MatrixXd matrix(4, 4);
  matrix << 1, 2, 3, 7, 4, 5, 9, 1, 2, 8, 10, 3, 0, 1, 1, 5;
  const Eigen::VectorXd rhs = Eigen::VectorXd::Ones(4);
  const auto over_rationals = gaussian_elimination<Rational>(exact(matrix), RationalVector(exact(rhs)));
  ASSERT_FALSE(over_rationals.ok());
  EXPECT_TRUE(holds(over_rationals.error().message.find("column 2") != std::string::npos))
      << over_rationals.error().message;

  const Eigen::MatrixXd zero_column = matrix * Eigen::Vector4d(1, 1, 0, 1).asDiagonal();
  for (const auto& solution : {solve_gaussian(zero_column, rhs), solve_eigen_lu(zero_column, rhs)}) {
    ASSERT_FALSE(solution.ok());
    EXPECT_TRUE(holds(solution.error().code == ErrorCode::invalid_input));
    EXPECT_TRUE(holds(solution.error().message.find("column 2") != std::string::npos)) << solution.error().message;
  }
}

// CLAIM      IU.6-9: systems whose shapes do not fit, or with entries that are not finite, are refused with the place.
// ORACLE     identity: the defect put there.
// TOLERANCE  none: refusals and their words.
TEST(GaussianElimination, RefusesWhatIsNoSystem) {
  proves({"IU.6-9"}, Oracle::identity, "systems with one defect each");
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(3, 3);
  Eigen::MatrixXd nan_inside = identity;
  nan_inside(1, 2) = std::nan("");
  for (const auto solve : {solve_gaussian, solve_eigen_lu}) {
    const auto shape = solve(identity, Eigen::VectorXd::Ones(2));
    ASSERT_FALSE(shape.ok());
    EXPECT_TRUE(holds(shape.error().message.find("3 × 3") != std::string::npos));
    const auto entry = solve(nan_inside, Eigen::VectorXd::Ones(3));
    ASSERT_FALSE(entry.ok());
    EXPECT_TRUE(holds(entry.error().message.find("(1, 2)") != std::string::npos));
  }
}

// CLAIM      IU.6-9: a vector with an entry that is no number is not taken for a solution, let alone a perfect one; where
//            finite data overflow, the backward error is infinite, not 0 and not NaN.
// ORACLE     identity: A = I and one entry of A, x or b replaced; products of 1e200, alone and as ∞ − ∞.
// TOLERANCE  none: refusals, infinities.
TEST(GaussianElimination, NeverCallsWhatIsNoNumberASolution) {
  proves({"IU.6-9"}, Oracle::identity, "one entry replaced by NaN or infinity; overflow");
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(2, 2);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(2);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::nan(""), infinity, -infinity}) {
    Eigen::VectorXd vector = ones;
    vector(0) = bad;
    Eigen::MatrixXd matrix = identity;
    matrix(0, 1) = bad;
    EXPECT_TRUE(refuses([&] { static_cast<void>(backward_error(identity, vector, ones)); })) << "x";
    EXPECT_TRUE(refuses([&] { static_cast<void>(backward_error(identity, ones, vector)); })) << "b";
    EXPECT_TRUE(refuses([&] { static_cast<void>(backward_error(matrix, ones, ones)); })) << "A";
  }
  Eigen::MatrixXd cancelling = 1e200 * identity;
  cancelling(0, 1) = -1e200;
  for (const Eigen::MatrixXd& matrix : {Eigen::MatrixXd(1e200 * identity), cancelling}) {
    const BackwardError error = backward_error(matrix, 1e200 * ones, ones);
    EXPECT_TRUE(holds(error.normwise == infinity && error.componentwise == infinity));
  }
}

}  // namespace
}  // namespace etendue::validation
