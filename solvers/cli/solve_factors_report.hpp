// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "etendue/assembly/factor_repair.hpp"
#include "etendue/radiosity/balance.hpp"
#include "etendue/radiosity/enclosure.hpp"
#include "etendue/radiosity/solve.hpp"

namespace etendue::cli {

/// Everything that `etendue solve --factors` found out.
struct FactorsSolution {
  std::string solver;
  RadiosityReport report;
  RadiosityEnclosure around;           ///< certified, or the bound of the solve
  std::vector<PowerBalance> balances;  ///< of each channel where areas are known [W]
  std::optional<Error> not_certified;  ///< why --certify found nothing
  bool certified = false;
};

/// A header, then a row a patch: index, radiosity of each channel, lower and upper bound of each channel; 17 digits.
[[nodiscard]] std::string result_csv(const FactorsSolution& solution);

/// What the bound is and what was asked of it.
[[nodiscard]] std::string missed_text(const RadiosityReport& report, double tolerance);

/// The summary as a person reads it, and as a machine does: one JSON object.
void print_factors_summary(std::ostream& out, const FactorsSolution& solution,
                           const std::optional<RepairedFactors>& repaired);
[[nodiscard]] std::string factors_summary_json(const FactorsSolution& solution,
                                               const std::optional<RepairedFactors>& repaired);

}  // namespace etendue::cli
