// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "etendue/form_factor/certified_outline.hpp"

namespace etendue {

/// An interval that holds the double contour integral of Stokes' theorem applied twice:
///
///     ∮∮ ln r dr_1 · dr_2 = 2π A_1 F_12                                                       @eq IU.6-3
///
/// Symbols   r distance between the running points of the two closed chains [length]
/// Domain    any two closed chains, touching or not, of size order one
/// Returns   the enclosure; truncation of about `goal`, the rest is rounding. `work` is raised by the evaluations of the
///           inner integral; beyond `budget` what is left counts as unknown
/// Accuracy  inclusion proved: NOTES.md §2 for the truncation, §10
/// Errors    none
[[nodiscard]] Interval enclosed_contour(const EnclosedOutline& first, const EnclosedOutline& second, double goal,
                                        std::int64_t budget, std::int64_t& work);

/// Upper bound on (32/15)/n ρ^(−2n)/(1 − ρ^(−2)), the error of the n-point rule where the Chebyshev coefficients obey
/// |a_k| ≤ (2/k) ρ^(−k); and on (64/15) ρ^(−2n)/(1 − ρ^(−2)), where |f| ≤ 1 on the ellipse ρ. NOTES.md §2.
[[nodiscard]] double certain_logarithmic_truncation(int n, double rho);
[[nodiscard]] double certain_analytic_truncation(int n, double rho);

}  // namespace etendue
