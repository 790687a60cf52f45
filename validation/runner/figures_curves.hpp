// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <type_traits>

#include "runner/figures.hpp"

// Figures that need no script: drawn as SVG, with their numbers in a table.
namespace etendue::validation {

template <class Kind>
constexpr bool is_curve =
    std::is_same_v<Kind, Convergence> || std::is_same_v<Kind, ErrorHistogram> || std::is_same_v<Kind, WorstInput>;

std::string curve_html(const Convergence& convergence);
std::string curve_html(const ErrorHistogram& histogram);
std::string curve_html(const WorstInput& worst);

/// Residuals of steps 1, 2, …, as logarithms.
std::string residual_svg(const std::vector<double>& residuals);

/// Six digits.
std::string short_number(double value);

}  // namespace etendue::validation
