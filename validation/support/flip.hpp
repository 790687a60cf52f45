// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <vector>

// How different two pictures look to a person who flips between them: ꟻLIP for pictures of low dynamic range.
// Source    Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild 2020: FLIP: A Difference Evaluator for
//           Alternating Images, Proc. ACM Comput. Graph. Interact. Tech. 3(2), doi:10.1145/3406183
namespace etendue::validation {

/// Pixels a degree of a 4K screen 0.7 m wide, seen from 0.7 m: 0.7 · 3840/0.7 · π/180.
constexpr double kPixelsPerDegree = 3840 * std::numbers::pi / 180;

/// CIELAB under D65 of linear sRGB, without limits on the channels.
struct Lab {
  double l = 0, a = 0, b = 0;
};
Lab lab_of_linear(double red, double green, double blue);

/// |ΔL| + √(Δa² + Δb²) of colours after Hunt's adjustment, a and b times L/100.
double hunt_adjusted_distance(const Lab& one, const Lab& other);

/// ꟻLIP of two colours that fill two pictures, where neither edges nor points differ: the colour difference alone.
double flip_of_colours(const Lab& one, const Lab& other);

/// Of each pixel, 0 (looks the same) to 1. Channels are linear sRGB, red, green, blue of each pixel row by row; values outside of
/// [0, 1], which no screen shows, are taken to its ends, NaN to 0.
/// Contract: both have 3 · columns · rows values
std::vector<float> flip(const std::vector<double>& reference, const std::vector<double>& test, int columns, int rows,
                        double pixels_per_degree = kPixelsPerDegree);

}  // namespace etendue::validation
