// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/system.hpp"

#include <memory>
#include <string>
#include <utility>

#include "etendue/core/contract.hpp"

namespace etendue {

Eigen::MatrixXd radiosity_matrix(Eigen::MatrixXd form_factors, const Eigen::VectorXd& reflectance) {
  require(form_factors.rows() == reflectance.size(), "radiosity_matrix: one reflectance a row");
  for (Eigen::Index j = 0; j < form_factors.cols(); ++j) {
    for (Eigen::Index i = 0; i < form_factors.rows(); ++i) {
      form_factors(i, j) = (i == j ? 1 : 0) - reflectance(i) * form_factors(i, j);
    }
  }
  return form_factors;
}

Result<RadiositySolution> solve_radiosity(const RadiositySystem& system, RadiositySolver solver, double factor_error,
                                          const MayGoOn& may_go_on) {
  const Eigen::Index n = system.form_factors.rows();
  if (system.form_factors.cols() != n || system.reflectance.size() != n || system.emission.size() != n) {
    return Error{ErrorCode::invalid_input,
                 "radiosity system: F is " + std::to_string(n) + " × " + std::to_string(system.form_factors.cols()) +
                     ", ρ has " + std::to_string(system.reflectance.size()) + " entries and E " +
                     std::to_string(system.emission.size()) + "; they must belong to the same patches"};
  }
  const RadiosityEquation equation{
      std::make_shared<DenseFactors>(system.form_factors), system.reflectance, system.emission, {}, {}};
  RadiosityGoal goal;
  goal.solver = solver;
  goal.rules.factor_error = factor_error;
  goal.may_go_on = may_go_on;
  auto solved = solve_radiosity(equation, goal);
  if (!solved) return solved.error();
  if (solved->status == RadiosityStatus::stopped) return Error{ErrorCode::stopped, "the iteration was stopped"};
  return RadiositySolution{solved->radiosity.col(0), solved->residual(0), solved->bound(0), solved->backward_error(0)};
}

}  // namespace etendue
