// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

#include "etendue/core/result.hpp"
#include "etendue/radiosity/form_factors.hpp"

// Grey, diffuse enclosures: the radiosity equation with E = ε σ T⁴ and ρ = 1 − ε, one channel that is all wavelengths.
namespace etendue {

/// Stefan–Boltzmann constant σ = 2π⁵k⁴/(15 h³c²) [W m⁻² K⁻⁴]; exact since the SI of 2019, here to the nearest double
/// (CODATA 2018 and 2022 print 5.670 374 419…e-8).
inline constexpr double kStefanBoltzmann = 5.670374419184429e-8;

/// σ T⁴ [W/m²] of a black surface at T [K] ≥ 0, and the temperature of one that gives so much.
[[nodiscard]] double emissive_power(double kelvin);
[[nodiscard]] double temperature(double emissive_power);

/// The surface is held at this temperature.
struct HeldAt {
  double kelvin = 0;
};
/// The surface gives off this much more than it takes in, whatever its temperature; 0: insulated, it re-radiates.
struct NetFlux {
  double watts_per_square_metre = 0;
};
/// One side of a thin sheet that conducts no heat along itself and takes the temperature at which both sides together
/// give off as much as they take in. The other side names this one; both have the same area.
struct SheetWith {
  Eigen::Index other_side = 0;
};

struct GreyPatch {
  double emissivity = 1;  ///< ε in (0, 1], which is also the absorptance
  std::variant<HeldAt, NetFlux, SheetWith> given = HeldAt{};
};

/// One entry a patch.
struct HeatExchange {
  Eigen::VectorXd radiosity;       ///< J [W/m²]
  Eigen::VectorXd irradiance;      ///< H = F J [W/m²]
  Eigen::VectorXd emissive_power;  ///< σ T⁴ [W/m²]
  Eigen::VectorXd temperature;     ///< T [K]
  Eigen::VectorXd net_flux;  ///< q = J − H = ε (σ T⁴ − H) [W/m²]: what the patch gives off; negative where it warms
  Eigen::VectorXd radiosity_bound;  ///< proved: |J − exact J| [W/m²]
  Eigen::VectorXd net_flux_bound;   ///< proved: |q − exact q| [W/m²]
};

/// Heat exchange by radiation between grey diffuse patches:
///
///     J_i = ε_i σ T_i⁴ + (1 − ε_i) H_i   held at a temperature      J_i = q_i + H_i   with a net flux
///     H_i = Σ_j F_ij J_j                                                                     @eq IU.6-7, IU.6-9
///
/// Domain    F_ij in [0, 1], rows sum to no more than 1 + row_excess. What rows lack of 1 is open to black space at 0 K; closed_by() puts an environment there
/// Accuracy  |J − exact J|, |q − exact q| within their bounds, proved (NOTES.md §7), for the doubles ε σ T⁴ and 1 − ε
/// Errors    sizes, rows above that, ε outside (0, 1], temperatures below 0, non-finite numbers; sheets that do not name each other; a flux
///           so negative that no temperature would do; not_converged: patches that see no temperature and no outside, so
///           that fluxes do not determine theirs
[[nodiscard]] Result<HeatExchange> exchange_heat(const FormFactors& factors, const std::vector<GreyPatch>& patches,
                                                 double row_excess = 1e-6);

/// Gebhart factors G_ij: of what i emits, the share that j absorbs, directly or after any number of reflections.
///
///     G = (I − F diag(1 − ε))⁻¹ F diag(ε),     Q_i = A_i ε_i σ T_i⁴ − Σ_j A_j ε_j σ T_j⁴ G_ji
///
/// In a closed enclosure rows sum to one.
struct GebhartFactors {
  Eigen::MatrixXd factors;
  double bound = 0;  ///< proved: |G_ij − exact G_ij|
};

/// Errors    as exchange_heat(); rows with Σ_j F_ij (1 − ε_j) not below 1
/// Source    Gebhart 1961, Surface temperature calculations in radiant surroundings of arbitrary complexity
[[nodiscard]] Result<GebhartFactors> gebhart_factors(const FormFactors& factors, const Eigen::VectorXd& emissivity,
                                                     double row_excess = 1e-6);

/// An open enclosure with one more patch, the last, that is all its openings look at.
struct ClosedEnclosure {
  RowMatrix factors;      ///< (n + 1)², rows sum to one
  Eigen::VectorXd areas;  ///< n + 1
};

/// Closes openings: F_i,environment = 1 − Σ_j F_ij; the way back by reciprocity. Two-sided sheets are two patches, one a side.
///
/// Symbols   environment_area: of the surface around [m²]; never taken smaller than Σ_i A_i F_i,environment, which is the
///           smallest that reciprocity admits (a convex cap). What is larger sees itself
/// Errors    areas that are not positive, sizes, rows that sum to more than 1 + row_excess
[[nodiscard]] Result<ClosedEnclosure> closed_by(double environment_area, const FormFactors& factors,
                                                const Eigen::VectorXd& areas, double row_excess = 1e-12);

}  // namespace etendue
