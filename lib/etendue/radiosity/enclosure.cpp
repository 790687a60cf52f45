// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/enclosure.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "etendue/core/interval.hpp"
#include "etendue/core/text_of.hpp"

namespace etendue {

namespace {

template <class... Parts>
Error error(ErrorCode code, const Parts&... parts) {
  return {code, text_of("enclosed radiosity system: ", parts...)};
}

/// The first entry whose lower end is not below its upper one, where entries can be looked at.
std::optional<Error> crossed_factors(const FormFactors& lower, const FormFactors& upper) {
  const auto crossed = [](Eigen::Index i, Eigen::Index j, double low, double high) {
    return error(ErrorCode::invalid_input, "row ", i, ": F(", i, ", ", j, ") is said to lie between ", low, " and ",
                 high);
  };
  const auto* low = dynamic_cast<const DenseFactors*>(&lower);
  const auto* high = dynamic_cast<const DenseFactors*>(&upper);
  if (low != nullptr && high != nullptr) {
    for (Eigen::Index i = 0; i < lower.size(); ++i) {
      for (Eigen::Index j = 0; j < lower.size(); ++j) {
        const double a = low->matrix()(i, j), b = high->matrix()(i, j);
        if (!(a <= b)) return crossed(i, j, a, b);
      }
    }
  }
  const auto* few_low = dynamic_cast<const SparseFactors*>(&lower);
  const auto* few_high = dynamic_cast<const SparseFactors*>(&upper);
  if (few_low != nullptr && few_high != nullptr) {
    const SparseRows difference = few_high->matrix() - few_low->matrix();
    for (Eigen::Index i = 0; i < difference.rows(); ++i) {
      for (SparseRows::InnerIterator entry(difference, i); entry; ++entry) {
        if (entry.value() >= 0) continue;
        const Eigen::Index j = entry.col();
        return crossed(i, j, few_low->matrix().coeff(i, j), few_high->matrix().coeff(i, j));
      }
    }
  }
  return std::nullopt;
}

std::optional<Error> crossed(const std::string& prefix, const char* what, const Eigen::MatrixXd& lower,
                             const Eigen::MatrixXd& upper, Eigen::Index c) {
  for (Eigen::Index i = 0; i < lower.rows(); ++i) {
    if (lower(i, c) <= upper(i, c)) continue;
    Error refused = error(ErrorCode::invalid_input, "row ", i, ": ", what, " is said to lie between ", lower(i, c),
                          " and ", upper(i, c));
    refused.message = prefix + refused.message;
    return refused;
  }
  return std::nullopt;
}

std::optional<Error> refusal(const EnclosedRadiosityEquation& equation, const RadiosityEquation& upper) {
  const FormFactors &low = *equation.factors_lower, &high = *equation.factors_upper;
  if (low.size() != high.size()) {
    return error(ErrorCode::invalid_input, "the lower factors are ", low.size(), " × ", low.size(), ", the upper ",
                 high.size(), " × ", high.size());
  }
  const auto same = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return a.rows() == b.rows() && a.cols() == b.cols();
  };
  if (!same(equation.reflectance_lower, equation.reflectance_upper) ||
      !same(equation.emission_lower, equation.emission_upper)) {
    return error(ErrorCode::invalid_input, "lower and upper reflectances or emissions differ in number");
  }
  if (auto misfits = misfit(upper)) return misfits;
  if (auto entry = crossed_factors(low, high)) return entry;
  for (Eigen::Index c = 0; c < upper.emission.cols(); ++c) {
    const std::string prefix = channel_prefix(upper, c);
    if (auto rho = crossed(prefix, "the reflectance", equation.reflectance_lower, equation.reflectance_upper, c)) {
      return rho;
    }
    if (auto e = crossed(prefix, "the emission", equation.emission_lower, equation.emission_upper, c)) return e;
  }
  return std::nullopt;
}

/// Where a row of the upper system reflects all it may receive, nothing bounds its radiosity.
std::optional<Error> too_loose(const EnclosedRadiosityEquation& equation, const RadiosityEquation& upper) {
  const Eigen::VectorXd sums = row_sums(*upper.factors), lower_sums = row_sums(*equation.factors_lower);
  for (Eigen::Index c = 0; c < upper.emission.cols(); ++c) {
    for (Eigen::Index i = 0; i < sums.size(); ++i) {
      const double rho = upper.reflectance(i, c);
      if (!(rho >= 0 && rho < 1) || dominance(rho, sums(i), upper.factors->roundings()) > 0) continue;
      Error loose = error(ErrorCode::not_converged, "row ", i, ": reflectance ", rho,
                          " times the sum of the upper bounds of its form factors, ", sums(i),
                          ", is not below 1 (the lower bounds sum to ", lower_sums(i),
                          "): the form factors are known too loosely to bound the radiosity");
      loose.message = channel_prefix(upper, c) + loose.message;
      return loose;
    }
  }
  return std::nullopt;
}

Error named(const Error& of, const char* end) {
  return {of.code, std::string(end) + " end: " + of.message};
}

/// A solve of one end; stopped ones are errors, for half an enclosure is none.
Result<RadiosityReport> end_of(const RadiosityEquation& equation, const RadiosityGoal& goal, const char* end) {
  auto solved = solve_radiosity(equation, goal);
  if (!solved) return named(solved.error(), end);
  if (solved->status == RadiosityStatus::stopped) return named({ErrorCode::stopped, "stopped"}, end);
  return solved;
}

}  // namespace

Result<RadiosityEnclosure> enclose_radiosity(const EnclosedRadiosityEquation& equation, const RadiosityGoal& goal) {
  require(equation.factors_lower && equation.factors_upper, "enclose_radiosity: there are form factors");
  const RadiosityEquation high{equation.factors_upper, equation.reflectance_upper, equation.emission_upper,
                               equation.areas, equation.channels};
  if (const auto refused = refusal(equation, high)) return *refused;
  if (const auto loose = too_loose(equation, high)) return *loose;
  const auto upper = end_of(high, goal, "upper");
  if (!upper) return upper.error();
  const RadiosityEquation low{equation.factors_lower, equation.reflectance_lower, equation.emission_lower,
                              equation.areas, equation.channels};
  const auto lower = end_of(low, goal, "lower");
  if (!lower) return lower.error();
  const Eigen::Index n = low.emission.rows(), channels = low.emission.cols();
  RadiosityEnclosure result{Eigen::MatrixXd(n, channels), Eigen::MatrixXd(n, channels),
                            std::max(lower->status, upper->status)};
  for (Eigen::Index c = 0; c < channels; ++c) {
    for (Eigen::Index i = 0; i < n; ++i) {
      // B ≥ E: nothing is taken from what a patch emits.
      result.lower(i, c) = std::max(low.emission(i, c), below(lower->radiosity(i, c) - lower->bound(c)));
      result.upper(i, c) = above(upper->radiosity(i, c) + upper->bound(c));
    }
  }
  return result;
}

Result<RadiosityEnclosure> enclose_radiosity(const EnclosedRadiositySystem& system, RadiositySolver solver,
                                             const MayGoOn& may_go_on) {
  const auto square = [](const Eigen::MatrixXd& factors) { return factors.rows() == factors.cols(); };
  if (!square(system.lower) || !square(system.upper)) {
    return error(ErrorCode::invalid_input, "the lower factors are ", system.lower.rows(), " × ", system.lower.cols(),
                 ", the upper ", system.upper.rows(), " × ", system.upper.cols());
  }
  RadiosityGoal goal;
  goal.solver = solver;
  goal.may_go_on = may_go_on;
  return enclose_radiosity({std::make_shared<DenseFactors>(system.lower),
                            std::make_shared<DenseFactors>(system.upper),
                            system.reflectance,
                            system.reflectance,
                            system.emission,
                            system.emission,
                            {},
                            {}},
                           goal);
}

}  // namespace etendue
