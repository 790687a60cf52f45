// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/system.hpp"

#include <cmath>
#include <optional>
#include <sstream>

#include "etendue/linear/dense_solve.hpp"
#include "etendue/radiosity/certificate.hpp"

namespace etendue {

namespace {

template <class... Parts>
Error invalid(const Parts&... parts) {
  std::ostringstream text;
  text.precision(17);
  (text << ... << parts);
  return {ErrorCode::invalid_input, "radiosity system: " + text.str()};
}

std::optional<Error> refusal(const RadiositySystem& system, double factor_error) {
  const Eigen::Index n = system.form_factors.rows();
  if (system.form_factors.cols() != n || system.reflectance.size() != n || system.emission.size() != n) {
    return invalid("F is ", n, " × ", system.form_factors.cols(), ", ρ has ", system.reflectance.size(),
                   " entries and E ", system.emission.size(), "; they must belong to the same patches");
  }
  if (n == 0) return invalid("there is no patch");
  for (Eigen::Index i = 0; i < n; ++i) {
    const double rho = system.reflectance(i);
    if (!(rho >= 0 && rho < 1)) return invalid("row ", i, ": reflectance ", rho, " is not in [0, 1)");
    const double emission = system.emission(i);
    if (!std::isfinite(emission)) return invalid("row ", i, ": emission ", emission, " is not finite");
    if (emission < 0) return invalid("row ", i, ": emission ", emission, " is negative");
    for (Eigen::Index j = 0; j < n; ++j) {
      const double factor = system.form_factors(i, j);
      if (!(factor >= 0 && factor <= 1 + factor_error) || !std::isfinite(factor)) {
        return invalid("row ", i, ": F(", i, ", ", j, ") = ", factor, " is not a fraction of power");
      }
    }
    if (!(dominance(system, i) > 0)) {
      return invalid("row ", i, ": ρ Σ_j F_ij = ", rho * system.form_factors.row(i).sum(),
                     " is not below 1 (reflectance ", rho, "): the patch would reflect all it receives");
    }
  }
  return std::nullopt;
}

double reach(const RadiositySystem& system, Eigen::Index row) {
  return system.emission(row) / dominance(system, row);
}

/// No B_i exceeds max_i E_i / (1 − ρ_i Σ_j F_ij) (NOTES.md §1 with B̂ = 0): the row that allows the most is to blame.
Error overflow(const RadiositySystem& system) {
  Eigen::Index worst = 0;
  for (Eigen::Index i = 1; i < system.emission.size(); ++i) {
    if (reach(system, i) > reach(system, worst)) worst = i;
  }
  return invalid("row ", worst, ": emission ", system.emission(worst),
                 " with 1 − ρ Σ_j F_ij = ", dominance(system, worst), ": radiosities or their bounds overflow");
}

/// Headroom for the sums of n products that the elimination forms; what overflows all the same is seen afterwards.
bool has_headroom(const RadiositySystem& system) {
  const auto room = 16 * static_cast<double>(system.emission.size());
  for (Eigen::Index i = 0; i < system.emission.size(); ++i) {
    if (!std::isfinite(room * reach(system, i))) return false;
  }
  return true;
}

}  // namespace

Eigen::MatrixXd radiosity_matrix(const RadiositySystem& system) {
  Eigen::MatrixXd matrix = -(system.reflectance.asDiagonal() * system.form_factors);
  matrix.diagonal().array() += 1;
  return matrix;
}

Result<RadiositySolution> solve_radiosity(const RadiositySystem& system, DirectSolver solver, double factor_error,
                                          const MayGoOn& may_go_on) {
  require(factor_error >= 0, "solve_radiosity: the error of the form factors is not negative");
  if (const auto error = refusal(system, factor_error)) return *error;
  if (!has_headroom(system)) return overflow(system);
  const Eigen::MatrixXd matrix = radiosity_matrix(system);
  const auto solved = solver == DirectSolver::eigen_lu ? solve_eigen_lu(matrix, system.emission)
                                                       : stoppable_gaussian(matrix, system.emission, may_go_on);
  if (!solved) return solved.error();
  const ResidualBound certificate = residual_bound(system, solved->x);
  if (!std::isfinite(certificate.bound)) return overflow(system);
  return RadiositySolution{solved->x, certificate.residual, certificate.bound, solved->backward_error.componentwise};
}

}  // namespace etendue
