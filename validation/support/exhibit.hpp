// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

// What a test hands to the report besides its evidence: figures. They decide nothing (near() and its like do), but the page
// derives what they state again and turns red where it does not agree.
namespace etendue::validation {

/// Errors that fall with a size as a power of it.
struct Convergence {
  std::string title;
  std::string size_name;  ///< "h, side of an element"
  std::vector<double> sizes, errors;
  double slope = 0;      ///< the expected power
  double tolerance = 0;  ///< of the slope that the points have, by least squares of the logarithms
};

/// How often an error had how many units; bin i holds [i, i + 1) · width, the last one all from there.
class ErrorHistogram {
 public:
  /// Contract: width > 0, bins > 0
  ErrorHistogram(std::string title, std::string unit, double width, std::size_t bins);
  /// One that was counted elsewhere.
  /// Contract: width > 0, counts not empty
  ErrorHistogram(std::string title, std::string unit, double width, double worst, std::vector<std::uint64_t> counts);
  /// Contract: units ≥ 0, not NaN
  void add(double units);

  const std::string& title() const { return title_; }
  const std::string& unit() const { return unit_; }
  double width() const { return width_; }
  double worst() const { return worst_; }
  std::uint64_t total() const { return total_; }
  const std::vector<std::uint64_t>& counts() const { return counts_; }

 private:
  std::string title_, unit_;
  double width_, worst_ = 0;
  std::uint64_t total_ = 0;
  std::vector<std::uint64_t> counts_;
};

/// The input that came nearest to its tolerance.
struct WorstInput {
  std::string title;
  std::string command;  ///< computes it again, when pasted into a shell
  double share = 0;     ///< error/tolerance there

  /// Keeps the worse of two.
  void consider(double other_share, const std::string& other_command);
};

/// Form factors of n surfaces with their bounds.
struct FactorTable {
  std::string title;
  std::vector<double> areas;            ///< n [m²]
  std::vector<double> factors, bounds;  ///< n · n, row by row
  std::vector<std::size_t> covered;     ///< rows that see nothing; all others see 1
};

/// A channel's power [W], and by how much it may fail to balance.
struct Balance {
  double emitted = 0, absorbed = 0, escaped = 0, tolerance = 0;
};

/// A solved room: elements with their radiosities, residuals from pass to pass, where the power went.
struct RadiosityField {
  std::string title;
  std::vector<std::vector<double>> corners;  ///< of each element x, y, z of each corner [m]
  std::vector<double> radiosity;             ///< red, green, blue of each element [W/m²]
  std::vector<double> residuals;             ///< of an iteration after 1, 2, … passes [W/m²]
  double contraction = 0;                    ///< no residual is larger than that of the pass before, times this
  std::vector<Balance> balance;              ///< of red, green, blue
  std::vector<double> eye, gaze;             ///< a place to look from [m], and where to
};

/// A picture and what it should be: linear red, green and blue of each pixel, row by row from the top.
struct ImagePair {
  std::string title;
  int columns = 0, rows = 0;
  std::vector<double> reference, ours;
  double tolerance = 0;  ///< of a channel
};

using Figure = std::variant<Convergence, ErrorHistogram, WorstInput, FactorTable, RadiosityField, ImagePair>;

struct Exhibit {
  std::string test;  ///< Suite.Name
  Figure figure;
};

/// Hands a figure to the report, in the name of the running test.
void exhibit(Figure figure);

/// Takes over what a test showed in another process.
void adopt(Exhibit exhibit);

/// Of all tests run so far in this process, and adopted, in order.
const std::vector<Exhibit>& collected_exhibits();

}  // namespace etendue::validation
