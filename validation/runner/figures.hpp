// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "support/exhibit.hpp"

// Figures of the HTML report: what they state, as data for the page's script and as the page reads without one.
namespace etendue::validation {

/// Slope of the line through the points' logarithms, by least squares; NaN for fewer than two points.
double fitted_slope(const Convergence& convergence);
/// How far the points' logarithms (base 10) are from that line, at most.
double misfit(const Convergence& convergence);

/// By how much form factors miss what they must keep.
struct FactorDefects {
  double closure = 0;      ///< max |1 − Σ_j F_ij| of the rows that are not covered
  double reciprocity = 0;  ///< max |A_i F_ij − A_j F_ji| [m²]
  double widest = 0;       ///< the largest bound
};
FactorDefects defects_of(const FactorTable& table);

/// How far a picture is from what it should be; of the largest difference of a pixel's channels, rounded to a float.
struct ImageErrors {
  double mean = 0, median = 0, p95 = 0, p99 = 0, worst = 0;
  int column = 0, row = 0;  ///< of the worst
  std::size_t nan = 0, infinite = 0;
};
ImageErrors errors_of(const ImagePair& pair);

/// JSON array of all figures; long lists of numbers as base64 of little-endian doubles ("f64") or floats ("f32").
std::string figures_json(const std::vector<Exhibit>& exhibits);

/// The sections of the page, each figure with the id "figure-N", N being its place in the array.
std::string figures_html(const std::vector<Exhibit>& exhibits);

/// Links to these sections, and to the figures of one test.
std::string figures_links(const std::vector<Exhibit>& exhibits);
std::string figures_of(const std::string& test, const std::vector<Exhibit>& exhibits);

/// A picture as a data: address (BMP, 24 bits), from red, green, blue of each pixel in 0 … 255.
std::string picture_address(const std::vector<unsigned char>& pixels, int columns, int rows);

/// Text in HTML.
std::string escaped(std::string_view text);

}  // namespace etendue::validation
