// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "etendue/core/floating_point.hpp"

namespace etendue {

/// A model of the eye's first layers: what a receptor reports is lowered by what its neighbours see.
struct Inhibition {
  double strength = 1;  ///< a ≥ 0: of the neighbours' part
  double reach = 4;     ///< s > 0: pixels in which a neighbour's weight falls to 1/e
};

/// Intensities along a line as they are perceived.                                                  @eq IU.3.1.1
///
///     p_k = I_k + a (I_k − Σ_j g_j I_{k+j}),   g_j = (1 − r)/(1 + r) r^|j|,   r = exp(−1/s)
///
/// A uniform field and a uniform slope are perceived as they are (Σ g_j = 1, g even). Beside a step of h the (k+1)-th pixel is
/// off by a h r^(k+1)/(1 + r), darker on the dark and brighter on the bright side; where a slope changes by h a pixel,
/// the k-th pixel from there is off by a h r^(k+1)/(1 − r²): Mach's bands.
///
/// Beyond its ends the line goes on with its end values.
/// Domain    finite intensities; strength ≥ 0, reach > 0, both finite
/// Accuracy  relative to the largest |I|: 2^-48 (1 + a) for reach up to 64; measured
/// Errors    ContractViolation outside the domain
/// Source    Hartline and Ratliff 1957 (lateral inhibition, linear, without recurrence); Ratliff 1965, Mach Bands
[[nodiscard]] std::vector<double> perceived(std::span<const double> intensities, const Inhibition& eye = {});

/// How smooth a line is: what flat shading has in its intensity, Gouraud's in its slope.            @eq IU.3.1.1
struct Jumps {
  double intensity = 0;  ///< largest |I_{k+1} − I_k|
  double slope = 0;      ///< largest |I_{k+1} − 2 I_k + I_{k−1}|
  double perceived =
      0;  ///< largest |p_k − I_k|, away from the line's ends by 5 s and more: there, lines of 10 s and less have none
};
[[nodiscard]] Jumps jumps(std::span<const double> intensities, const Inhibition& eye = {});

}  // namespace etendue
