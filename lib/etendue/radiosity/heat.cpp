// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/heat.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/core/text_of.hpp"
#include "etendue/linear/dense_solve.hpp"
#include "etendue/radiosity/equation.hpp"

namespace etendue {

namespace {

template <class... Parts>
Error error(ErrorCode code, const Parts&... parts) {
  return {code, text_of("heat exchange: ", parts...)};
}

template <class... Parts>
Error invalid(const Parts&... parts) {
  return error(ErrorCode::invalid_input, parts...);
}

std::optional<Error> bad_emissivity(Eigen::Index i, double emissivity) {
  if (emissivity > 0 && emissivity <= 1) return std::nullopt;
  return invalid("patch ", i, ": emissivity ", emissivity, " is not in (0, 1]");
}

std::optional<Error> bad_rows(const FormFactors& factors, double row_excess) {
  require(row_excess >= 0, "heat exchange: the excess of rows is not negative");
  const Eigen::VectorXd sums = row_sums(factors);
  for (Eigen::Index i = 0; i < sums.size(); ++i) {
    if (!(sums(i) <= 1 + row_excess)) return invalid("row ", i, " sums to ", sums(i), ", more than it can see");
  }
  return std::nullopt;
}

std::optional<Error> bad_factors(const FormFactors& factors, Eigen::Index patches, double row_excess) {
  if (factors.size() != patches || patches == 0) {
    return invalid("F is ", factors.size(), " × ", factors.size(), " and there are ", patches, " patches");
  }
  constexpr double kFactorError = 1e-12;  // as RadiosityRules
  if (const auto entry = factors.entry_outside(1 + kFactorError)) {
    return invalid("F(", entry->row, ", ", entry->column, ") = ", entry->value, " is not a fraction of power");
  }
  return bad_rows(factors, row_excess);
}

std::optional<Error> bad_patch(const std::vector<GreyPatch>& patches, std::size_t i) {
  const GreyPatch& patch = patches[i];
  if (auto bad = bad_emissivity(static_cast<Eigen::Index>(i), patch.emissivity)) return bad;
  if (const auto* held = std::get_if<HeldAt>(&patch.given)) {
    if (!(held->kelvin >= 0)) return invalid("patch ", i, ": temperature ", held->kelvin, " K is not at least 0");
    if (std::isfinite(emissive_power(held->kelvin))) return std::nullopt;
    return invalid("patch ", i, ": temperature ", held->kelvin, " K: its emissive power overflows");
  }
  if (const auto* flux = std::get_if<NetFlux>(&patch.given)) {
    if (std::isfinite(flux->watts_per_square_metre)) return std::nullopt;
    return invalid("patch ", i, ": net flux ", flux->watts_per_square_metre, " W/m² is not finite");
  }
  const Eigen::Index other = std::get<SheetWith>(patch.given).other_side;
  const bool exists =
      other >= 0 && other < static_cast<Eigen::Index>(patches.size()) && other != static_cast<Eigen::Index>(i);
  const auto* back = exists ? std::get_if<SheetWith>(&patches[static_cast<std::size_t>(other)].given) : nullptr;
  if (back != nullptr && back->other_side == static_cast<Eigen::Index>(i)) return std::nullopt;
  return invalid("patch ", i, ": the other side of its sheet is said to be patch ", other,
                 ", which does not say the same");
}

/// J = E + P J: each row of P is a row of F times a reflectance, or of a sheet a mean of two.
struct Exchange {
  RowMatrix matrix;
  Eigen::VectorXd source;
};

Exchange exchange_of(const Eigen::MatrixXd& factors, const std::vector<GreyPatch>& patches) {
  const auto n = static_cast<Eigen::Index>(patches.size());
  Exchange exchange{RowMatrix(n, n), Eigen::VectorXd::Zero(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const GreyPatch& patch = patches[static_cast<std::size_t>(i)];
    const double emissivity = patch.emissivity;
    if (const auto* held = std::get_if<HeldAt>(&patch.given)) {
      exchange.matrix.row(i) = (1 - emissivity) * factors.row(i);
      exchange.source(i) = emissivity * emissive_power(held->kelvin);
    } else if (const auto* flux = std::get_if<NetFlux>(&patch.given)) {
      exchange.matrix.row(i) = factors.row(i);
      exchange.source(i) = flux->watts_per_square_metre;
    } else {
      // σT⁴ = (ε H + ε' H')/(ε + ε'), for both sides together give off nothing.
      const Eigen::Index other = std::get<SheetWith>(patch.given).other_side;
      const double back = patches[static_cast<std::size_t>(other)].emissivity;
      const double own_share = emissivity / (emissivity + back), back_share = back / (emissivity + back);
      exchange.matrix.row(i) =
          (1 - emissivity + emissivity * own_share) * factors.row(i) + emissivity * back_share * factors.row(other);
    }
  }
  return exchange;
}

Error undetermined() {
  return error(ErrorCode::not_converged,
               "some patches see neither a temperature nor an opening, not even by way of others: their fluxes alone "
               "do not determine how warm they are");
}

/// |J − exact J| ≤ scale · w, w > 0 and (I − P) w > 0: NOTES.md §7.
struct Bound {
  double scale = 0;
  Eigen::VectorXd weights;
};

Result<Bound> bound_of(const DenseFactors& p, const Eigen::VectorXd& source, const Eigen::VectorXd& radiosity,
                       const Eigen::VectorXd& weights) {
  const Eigen::Index n = source.size();
  Eigen::MatrixXd columns(n, 3);
  columns << radiosity, radiosity.cwiseAbs(), weights;
  const Eigen::MatrixXd product = p.times(columns);
  const double gamma = gamma_bound(p.roundings() + 4), widen = 1 + 2 * gamma;
  Bound bound{0, weights};
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!(weights(i) > 0)) return undetermined();
    const double margin = (weights(i) - product(i, 2)) - gamma * (weights(i) + product(i, 2)) * widen;
    if (!(margin > 0)) return undetermined();
    const double residual = (source(i) - radiosity(i)) + product(i, 0);
    const double magnitude = std::abs(source(i)) + std::abs(radiosity(i)) + product(i, 1);
    bound.scale = std::max(bound.scale, (std::abs(residual) + gamma * magnitude * widen) / margin * widen);
  }
  if (!std::isfinite(bound.scale)) return invalid("radiosities or their bounds overflow");
  return bound;
}

/// What follows from the radiosities.
Result<HeatExchange> completed(const FormFactors& factors, const std::vector<GreyPatch>& patches,
                               const Eigen::VectorXd& radiosity, const Bound& bound) {
  const Eigen::Index n = radiosity.size();
  Eigen::MatrixXd columns(n, 3);
  columns << radiosity, radiosity.cwiseAbs(), bound.weights;
  const Eigen::MatrixXd product = factors.times(columns);
  const double gamma = gamma_bound(factors.roundings() + 8);
  HeatExchange result{radiosity,          product.col(0),     Eigen::VectorXd(n), Eigen::VectorXd(n),
                      Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const GreyPatch& patch = patches[static_cast<std::size_t>(i)];
    const double emissivity = patch.emissivity, irradiance = product(i, 0);
    // Of the irradiance: the error of J, and the rounding of the sum.
    double wrong = bound.scale * product(i, 2) * (1 + gamma) + gamma * product(i, 1);
    if (const auto* held = std::get_if<HeldAt>(&patch.given)) {
      result.emissive_power(i) = emissive_power(held->kelvin);
      result.net_flux(i) = emissivity * (result.emissive_power(i) - irradiance);
    } else if (const auto* flux = std::get_if<NetFlux>(&patch.given)) {
      result.net_flux(i) = flux->watts_per_square_metre;
      result.emissive_power(i) = irradiance + result.net_flux(i) / emissivity;
    } else {
      const Eigen::Index other = std::get<SheetWith>(patch.given).other_side;
      const double back = patches[static_cast<std::size_t>(other)].emissivity, both = emissivity + back;
      result.emissive_power(i) = (emissivity * irradiance + back * product(other, 0)) / both;
      result.net_flux(i) = emissivity * back / both * (product(other, 0) - irradiance);
      wrong += bound.scale * product(other, 2) * (1 + gamma) + gamma * product(other, 1);
    }
    // What arrives may be below nothing by its error, where all that is seen is at 0 K.
    const double power = result.emissive_power(i);
    if (power < 0 && -power <= wrong + gamma * std::abs(irradiance)) result.emissive_power(i) = 0;
    if (!(result.emissive_power(i) >= 0)) {
      return invalid("patch ", i, ": a net flux of ", result.net_flux(i), " W/m² draws more than arrives, ", irradiance,
                     " W/m²: no temperature emits less than nothing");
    }
    result.temperature(i) = temperature(result.emissive_power(i));
    result.radiosity_bound(i) = bound.scale * bound.weights(i) * (1 + gamma);
    // ε (E − H), or ε ε'/(ε + ε') (H' − H), where ε'/(ε + ε') H' is at most E.
    const double terms = wrong + gamma * (result.emissive_power(i) + std::abs(irradiance));
    result.net_flux_bound(i) = emissivity * terms * (1 + gamma);
    if (std::holds_alternative<NetFlux>(patch.given)) result.net_flux_bound(i) = 0;
  }
  return result;
}

}  // namespace

double emissive_power(double kelvin) {
  require(kelvin >= 0, "emissive_power: the temperature is at least 0 K");
  return kStefanBoltzmann * ((kelvin * kelvin) * (kelvin * kelvin));
}

double temperature(double emissive_power) {
  require(emissive_power >= 0, "temperature: the emissive power is not negative");
  return std::sqrt(std::sqrt(emissive_power / kStefanBoltzmann));
}

Result<HeatExchange> exchange_heat(const FormFactors& factors, const std::vector<GreyPatch>& patches,
                                   double row_excess) {
  const auto n = static_cast<Eigen::Index>(patches.size());
  if (const auto bad = bad_factors(factors, n, row_excess)) return *bad;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (const auto bad = bad_patch(patches, i)) return *bad;
  }
  Exchange exchange = exchange_of(factors.dense(), patches);
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n, n) - Eigen::MatrixXd(exchange.matrix);
  const auto radiosity = solve_eigen_lu(matrix, exchange.source);
  if (!radiosity) return undetermined();
  const auto weights = solve_eigen_lu(matrix, Eigen::VectorXd::Ones(n));
  if (!weights) return undetermined();
  const auto bound = bound_of(DenseFactors(std::move(exchange.matrix)), exchange.source, radiosity->x, weights->x);
  if (!bound) return bound.error();
  return completed(factors, patches, radiosity->x, *bound);
}

Result<GebhartFactors> gebhart_factors(const FormFactors& factors, const Eigen::VectorXd& emissivity,
                                       double row_excess) {
  const Eigen::Index n = emissivity.size();
  if (const auto bad = bad_factors(factors, n, row_excess)) return *bad;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (const auto bad = bad_emissivity(i, emissivity(i))) return *bad;
  }
  const Eigen::VectorXd reflectance = Eigen::VectorXd::Ones(n) - emissivity;
  const Eigen::MatrixXd once = factors.dense() * emissivity.asDiagonal();
  const Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n, n) - factors.dense() * reflectance.asDiagonal();
  const Eigen::VectorXd reflected = factors.times(reflectance).col(0);
  const double gamma = gamma_bound(factors.roundings() + 6), widen = 1 + 2 * gamma;
  GebhartFactors result{matrix.partialPivLu().solve(once), 0};
  const Eigen::MatrixXd on = reflectance.asDiagonal() * result.factors;
  const Eigen::MatrixXd again = factors.times(on), magnitude = factors.times(on.cwiseAbs());
  for (Eigen::Index i = 0; i < n; ++i) {
    const double margin = 1 - reflected(i) * widen - kUnitRoundoff;
    if (!(margin > 0)) return invalid("row ", i, ": Σ_j F_ij (1 − ε_j) = ", reflected(i), " is not below 1");
    for (Eigen::Index j = 0; j < n; ++j) {
      const double g = result.factors(i, j), residual = (once(i, j) - g) + again(i, j);
      const double scale = std::abs(once(i, j)) + std::abs(g) + magnitude(i, j);
      const double wrong = (std::abs(residual) + gamma * scale * widen) / margin * widen;
      if (!std::isfinite(wrong)) return invalid("row ", i, ": the Gebhart factors are not finite");
      result.bound = std::max(result.bound, wrong);
    }
  }
  return result;
}

Result<ClosedEnclosure> closed_by(double environment_area, const FormFactors& factors, const Eigen::VectorXd& areas,
                                  double row_excess) {
  require(environment_area >= 0 && row_excess >= 0, "closed_by: area and excess are not negative");
  const Eigen::Index n = areas.size();
  if (const auto bad = bad_factors(factors, n, row_excess)) return *bad;
  const Eigen::VectorXd sums = row_sums(factors);
  ClosedEnclosure closed{RowMatrix(n + 1, n + 1), Eigen::VectorXd(n + 1)};
  closed.factors.topLeftCorner(n, n) = factors.dense();
  closed.areas.head(n) = areas;
  double openings = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (!(areas(i) > 0) || !std::isfinite(areas(i)))
      return invalid("patch ", i, ": area ", areas(i), " is not positive");
    closed.factors(i, n) = std::max(0.0, 1 - sums(i));  // below zero by rounding only
    openings += areas(i) * closed.factors(i, n);
  }
  const double area = std::max(environment_area, openings);
  closed.areas(n) = area > 0 ? area : 1;  // nothing is open: nobody sees the environment, however large
  for (Eigen::Index i = 0; i < n; ++i) closed.factors(n, i) = areas(i) * closed.factors(i, n) / closed.areas(n);
  closed.factors(n, n) = std::max(0.0, 1 - openings / closed.areas(n));
  return closed;
}

}  // namespace etendue
