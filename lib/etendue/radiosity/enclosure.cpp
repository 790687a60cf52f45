// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/enclosure.hpp"

#include <algorithm>
#include <optional>
#include <sstream>

#include "etendue/core/interval.hpp"
#include "etendue/radiosity/certificate.hpp"

namespace etendue {

namespace {

template <class... Parts>
Error error(ErrorCode code, const Parts&... parts) {
  std::ostringstream text;
  text.precision(17);
  (text << ... << parts);
  return {code, "enclosed radiosity system: " + text.str()};
}

std::optional<Error> refusal(const EnclosedRadiositySystem& system) {
  const auto &lower = system.lower, &upper = system.upper;
  if (lower.rows() != upper.rows() || lower.cols() != upper.cols()) {
    return error(ErrorCode::invalid_input, "the lower factors are ", lower.rows(), " × ", lower.cols(), ", the upper ",
                 upper.rows(), " × ", upper.cols());
  }
  for (Eigen::Index i = 0; i < lower.rows(); ++i) {
    for (Eigen::Index j = 0; j < lower.cols(); ++j) {
      if (!(lower(i, j) <= upper(i, j))) {
        return error(ErrorCode::invalid_input, "row ", i, ": F(", i, ", ", j, ") is said to lie between ", lower(i, j),
                     " and ", upper(i, j));
      }
    }
  }
  return std::nullopt;
}

/// Where a row of the upper system reflects all it may receive, nothing bounds its radiosity.
std::optional<Error> too_loose(const RadiositySystem& upper, const Eigen::MatrixXd& lower) {
  if (upper.reflectance.size() != lower.rows()) return std::nullopt;  // solve_radiosity() says what does not fit
  for (Eigen::Index i = 0; i < lower.rows(); ++i) {
    const double rho = upper.reflectance(i);
    if (!(rho >= 0 && rho < 1) || dominance(upper, i) > 0) continue;
    return error(ErrorCode::not_converged, "row ", i, ": reflectance ", rho,
                 " times the sum of the upper bounds of its form factors, ", upper.form_factors.row(i).sum(),
                 ", is not below 1 (the lower bounds sum to ", lower.row(i).sum(),
                 "): the form factors are known too loosely to bound the radiosity");
  }
  return std::nullopt;
}

Error named(const Error& of, const char* end) {
  return {of.code, std::string(end) + " end: " + of.message};
}

}  // namespace

Result<RadiosityEnclosure> enclose_radiosity(const EnclosedRadiositySystem& system, DirectSolver solver,
                                             const MayGoOn& may_go_on) {
  if (const auto refused = refusal(system)) return *refused;
  RadiositySystem end{system.upper, system.reflectance, system.emission};
  if (const auto loose = too_loose(end, system.lower)) return *loose;
  const auto upper = solve_radiosity(end, solver, Tolerance{}.relative, may_go_on);
  if (!upper) return named(upper.error(), "upper");
  end.form_factors = system.lower;
  const auto lower = solve_radiosity(end, solver, Tolerance{}.relative, may_go_on);
  if (!lower) return named(lower.error(), "lower");
  const Eigen::Index n = system.emission.size();
  RadiosityEnclosure result{Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    // B ≥ E: nothing is taken from what a patch emits.
    result.lower(i) = std::max(system.emission(i), below(lower->radiosity(i) - lower->bound));
    result.upper(i) = above(upper->radiosity(i) + upper->bound);
  }
  return result;
}

}  // namespace etendue
