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

std::optional<Error> refusal(const RadiositySystem& system) {
  const Eigen::Index n = system.form_factors.rows();
  if (system.form_factors.cols() != n || system.reflectance.size() != n || system.emission.size() != n) {
    return invalid("F is ", n, " × ", system.form_factors.cols(), ", ρ has ", system.reflectance.size(),
                   " entries and E ", system.emission.size(), "; they must belong to the same patches");
  }
  if (n == 0) return invalid("there is no patch");
  for (Eigen::Index i = 0; i < n; ++i) {
    const double rho = system.reflectance(i);
    if (!(rho >= 0 && rho < 1)) return invalid("row ", i, ": reflectance ", rho, " is not in [0, 1)");
    if (!std::isfinite(system.emission(i))) return invalid("row ", i, ": emission is not finite");
    for (Eigen::Index j = 0; j < n; ++j) {
      const double factor = system.form_factors(i, j);
      if (!(factor >= 0) || !std::isfinite(factor)) {
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

}  // namespace

Eigen::MatrixXd radiosity_matrix(const RadiositySystem& system) {
  Eigen::MatrixXd matrix = -(system.reflectance.asDiagonal() * system.form_factors);
  matrix.diagonal().array() += 1;
  return matrix;
}

Result<RadiositySolution> solve_radiosity(const RadiositySystem& system, DirectSolver solver) {
  if (const auto error = refusal(system)) return *error;
  const Eigen::MatrixXd matrix = radiosity_matrix(system);
  const auto solved = solver == DirectSolver::eigen_lu ? solve_eigen_lu(matrix, system.emission)
                                                       : solve_gaussian(matrix, system.emission);
  if (!solved) return solved.error();
  const ResidualBound certificate = residual_bound(system, solved->x);
  return RadiositySolution{solved->x, certificate.residual, certificate.bound, solved->backward_error.componentwise};
}

}  // namespace etendue
