// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/equation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "etendue/core/rounding.hpp"
#include "etendue/core/text_of.hpp"

namespace etendue {

namespace {

/// How many rows a message names.
constexpr std::size_t kRowsNamed = 5;

template <class... Parts>
Error invalid(const std::string& prefix, const Parts&... parts) {
  return {ErrorCode::invalid_input, text_of(prefix, "radiosity system: ", parts...)};
}

std::optional<Error> bad_channel(const RadiosityEquation& equation, Eigen::Index c, const Eigen::VectorXd& row_sums) {
  const std::string prefix = channel_prefix(equation, c);
  for (Eigen::Index i = 0; i < equation.emission.rows(); ++i) {
    const double rho = equation.reflectance(i, c);
    if (!(rho >= 0 && rho < 1)) return invalid(prefix, "row ", i, ": reflectance ", rho, " is not in [0, 1)");
    const double emission = equation.emission(i, c);
    if (!std::isfinite(emission)) return invalid(prefix, "row ", i, ": emission ", emission, " is not finite");
    if (emission < 0) return invalid(prefix, "row ", i, ": emission ", emission, " is negative");
    if (!(dominance(rho, row_sums(i), equation.factors->roundings()) > 0)) {
      return invalid(prefix, "row ", i, ": ρ Σ_j F_ij = ", rho * row_sums(i),
                     " is not below 1 by more than its rounding (reflectance ", rho,
                     "): the patch would reflect all it receives");
    }
  }
  return std::nullopt;
}

std::optional<Error> excessive(const Eigen::VectorXd& row_sums, double excess) {
  const std::vector<RowSum> rows = rows_above_one(row_sums, excess);
  if (rows.empty()) return std::nullopt;
  std::string worst;
  for (std::size_t k = 0; k < std::min(rows.size(), kRowsNamed); ++k) {
    worst += text_of(k > 0 ? ", " : "", "row ", rows[k].row, " to ", rows[k].sum);
  }
  return invalid("", rows.size(), rows.size() == 1 ? " row sums" : " rows sum", " to more than 1 + ", excess, ": ",
                 worst, rows.size() > kRowsNamed ? ", …" : "", "; no patch gives out more than it has");
}

}  // namespace

std::string channel_prefix(const RadiosityEquation& equation, Eigen::Index channel) {
  const auto c = static_cast<std::size_t>(channel);
  if (c < equation.channels.size()) return equation.channels[c] + ": ";
  return equation.emission.cols() > 1 ? "channel " + std::to_string(channel) + ": " : "";
}

double dominance(double reflectance, double row_sum, int roundings) {
  const double reflected = reflectance * row_sum * (1 + gamma_bound(roundings + 4));
  return 1 - reflected - kUnitRoundoff;
}

Eigen::VectorXd row_sums(const FormFactors& factors) {
  return factors.times(Eigen::MatrixXd::Ones(factors.size(), 1)).col(0);
}

std::vector<RowSum> rows_above_one(const Eigen::VectorXd& row_sums, double excess) {
  require(excess >= 0, "rows_above_one: the excess is not negative");
  std::vector<RowSum> rows;
  for (Eigen::Index i = 0; i < row_sums.size(); ++i) {
    if (row_sums(i) > 1 + excess) rows.push_back({i, row_sums(i)});
  }
  std::stable_sort(rows.begin(), rows.end(), [](const RowSum& a, const RowSum& b) { return a.sum > b.sum; });
  return rows;
}

std::optional<Error> misfit(const RadiosityEquation& equation) {
  require(equation.factors != nullptr, "RadiosityEquation: there are form factors");
  const Eigen::Index n = equation.factors->size(), channels = equation.emission.cols();
  if (equation.reflectance.rows() != n || equation.emission.rows() != n) {
    return invalid("", "F is ", n, " × ", n, ", ρ has ", equation.reflectance.rows(), " entries and E ",
                   equation.emission.rows(), "; they must belong to the same patches");
  }
  if (n == 0) return invalid("", "there is no patch");
  if (channels == 0 || equation.reflectance.cols() != channels) {
    return invalid("", "ρ has ", equation.reflectance.cols(), " channels and E ", channels);
  }
  if (equation.areas.size() != 0 && equation.areas.size() != n) {
    return invalid("", "there are ", n, " patches and ", equation.areas.size(), " areas");
  }
  return std::nullopt;
}

std::optional<Error> refusal(const RadiosityEquation& equation, const Eigen::VectorXd& row_sums,
                             const RadiosityRules& rules) {
  require(rules.factor_error >= 0, "RadiosityRules: the error of the form factors is not negative");
  if (const auto error = misfit(equation)) return error;
  if (const auto entry = equation.factors->entry_outside(1 + rules.factor_error)) {
    return invalid("", "row ", entry->row, ": F(", entry->row, ", ", entry->column, ") = ", entry->value,
                   " is not a fraction of power");
  }
  for (Eigen::Index i = 0; i < equation.areas.size(); ++i) {
    const double area = equation.areas(i);
    if (!(area > 0) || !std::isfinite(area)) return invalid("", "row ", i, ": area ", area, " is not positive");
  }
  if (rules.row_excess) {
    if (auto error = excessive(row_sums, *rules.row_excess)) return error;
  }
  for (Eigen::Index c = 0; c < equation.emission.cols(); ++c) {
    if (auto error = bad_channel(equation, c, row_sums)) return error;
  }
  return std::nullopt;
}

}  // namespace etendue
