// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/solve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "etendue/core/text_of.hpp"
#include "etendue/linear/dense_solve.hpp"
#include "etendue/radiosity/certificate.hpp"
#include "etendue/radiosity/iteration.hpp"
#include "etendue/radiosity/system.hpp"

namespace etendue {

namespace {

using detail::Course;

/// No B_i exceeds max_i E_i / (1 − ρ_i Σ_j F_ij) (NOTES.md §1 with B̂ = 0).
double reach(const RadiosityEquation& equation, const RadiosityJudge& judge, Eigen::Index i, Eigen::Index c) {
  return equation.emission(i, c) / judge.margin(i, c);
}

/// The row that allows the most is to blame.
Error overflow(const RadiosityEquation& equation, const RadiosityJudge& judge, Eigen::Index c) {
  Eigen::Index worst = 0;
  for (Eigen::Index i = 1; i < equation.emission.rows(); ++i) {
    if (reach(equation, judge, i, c) > reach(equation, judge, worst, c)) worst = i;
  }
  return {ErrorCode::invalid_input, text_of(channel_prefix(equation, c), "radiosity system: row ", worst, ": emission ",
                                            equation.emission(worst, c), " with 1 − ρ Σ_j F_ij = ",
                                            judge.margin(worst, c), ": radiosities or their bounds overflow")};
}

/// Headroom for the sums of n products that solvers form; what overflows all the same is seen afterwards.
std::optional<Error> no_headroom(const RadiosityEquation& equation, const RadiosityJudge& judge) {
  const auto room = 16 * static_cast<double>(equation.emission.rows());
  for (Eigen::Index c = 0; c < equation.emission.cols(); ++c) {
    for (Eigen::Index i = 0; i < equation.emission.rows(); ++i) {
      if (!std::isfinite(room * reach(equation, judge, i, c))) return overflow(equation, judge, c);
    }
  }
  return std::nullopt;
}

std::optional<Error> unsuited(const RadiosityEquation& equation, RadiositySolver solver) {
  if (solver == RadiositySolver::conjugate_gradients && equation.areas.size() == 0) {
    return Error{ErrorCode::usage,
                 "solver cg makes the system symmetric by the areas of the patches, and there are none"};
  }
  const bool rows = solver == RadiositySolver::gauss_seidel || solver == RadiositySolver::southwell;
  if (rows && !equation.factors->by_rows()) {
    return Error{ErrorCode::usage, "solver " + name(solver) +
                                       " takes form factors patch by patch, and these only multiply; take jacobi, cg, "
                                       "gmres or bicgstab"};
  }
  return std::nullopt;
}

/// B of all channels by elimination, one channel after the other.
Result<Eigen::MatrixXd> eliminated(const RadiosityEquation& equation, const RadiosityGoal& goal) {
  const Eigen::Index n = equation.emission.rows(), channels = equation.emission.cols();
  Eigen::MatrixXd radiosity(n, channels);
  for (Eigen::Index c = 0; c < channels; ++c) {
    const auto may_go_on = [&](Eigen::Index done, Eigen::Index) {
      return !goal.may_go_on || goal.may_go_on(c * n + done, channels * n);
    };
    if (!may_go_on(0, n))
      return Error{ErrorCode::stopped, "stopped before " + channel_prefix(equation, c) + "the solve"};
    const Eigen::MatrixXd matrix = radiosity_matrix(equation.factors->dense(), equation.reflectance.col(c));
    auto solved = goal.solver == RadiositySolver::eigen_lu
                      ? solve_eigen_lu(matrix, equation.emission.col(c))
                      : stoppable_gaussian(matrix, equation.emission.col(c), may_go_on);
    if (!solved) return Error{solved.error().code, channel_prefix(equation, c) + solved.error().message};
    radiosity.col(c) = solved->x;
  }
  return radiosity;
}

void iterate(Course& course) {
  switch (course.goal().solver) {
    case RadiositySolver::jacobi:
      return detail::jacobi(course);
    case RadiositySolver::gauss_seidel:
      return detail::gauss_seidel(course);
    case RadiositySolver::southwell:
      return detail::southwell(course);
    case RadiositySolver::conjugate_gradients:
      return detail::conjugate_gradients(course);
    case RadiositySolver::gmres:
      return detail::gmres(course);
    case RadiositySolver::bicgstab:
      return detail::bicgstab(course);
    case RadiositySolver::gaussian_elimination:
    case RadiositySolver::eigen_lu:
      break;
  }
  throw ContractViolation("solve_radiosity: the solver iterates");
}

}  // namespace

const std::vector<std::string>& solver_names() {
  static const std::vector<std::string> names{"gauss",     "lu", "jacobi", "gauss-seidel",
                                              "southwell", "cg", "gmres",  "bicgstab"};
  return names;
}

std::optional<RadiositySolver> solver_named(std::string_view wanted) {
  const auto& names = solver_names();
  const auto found = std::find(names.begin(), names.end(), wanted);
  if (found == names.end()) return std::nullopt;
  return static_cast<RadiositySolver>(found - names.begin());
}

const std::string& name(RadiositySolver solver) {
  return solver_names()[static_cast<std::size_t>(solver)];
}

const char* words(RadiosityStatus status) {
  switch (status) {
    case RadiosityStatus::reached:
      return "reached";
    case RadiosityStatus::rounding:
      return "as near as rounding allows";
    case RadiosityStatus::limit:
      return "steps used up";
    case RadiosityStatus::stalled:
      return "stalled";
    case RadiosityStatus::stopped:
      return "stopped";
  }
  return "unknown";
}

Result<RadiosityReport> solve_radiosity(const RadiosityEquation& equation, const RadiosityGoal& goal) {
  require(goal.tolerance >= 0 && goal.most_steps >= 0, "solve_radiosity: tolerance and steps are not negative");
  if (const auto error = misfit(equation)) return *error;
  const Eigen::VectorXd sums = row_sums(*equation.factors);
  if (const auto error = refusal(equation, sums, goal.rules)) return *error;
  if (const auto error = unsuited(equation, goal.solver)) return *error;
  const RadiosityJudge judge(equation, sums);
  if (const auto error = no_headroom(equation, judge)) return *error;
  Course course(equation, goal, judge, 1);
  const bool dark = (equation.emission.array() == 0).all();
  if (is_direct(goal.solver) || dark) {
    const auto radiosity = dark ? Result<Eigen::MatrixXd>(equation.emission) : eliminated(equation, goal);
    if (!radiosity) return radiosity.error();
    course.judge_final(*radiosity);
  } else {
    iterate(course);
  }
  RadiosityReport report = std::move(course).report();
  report.dark = dark;
  for (Eigen::Index c = 0; c < report.bound.size(); ++c) {
    if (!std::isfinite(report.bound(c))) return overflow(equation, judge, c);
  }
  return report;
}

}  // namespace etendue
