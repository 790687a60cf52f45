// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "etendue/assembly/factor_repair.hpp"
#include "etendue/io/number_table.hpp"
#include "etendue/radiosity/enclosure.hpp"

// What `etendue solve --factors` reads: numbers, and how far they may be off.
namespace etendue::cli {

/// The data of a command line: each a number or a file, as typed.
struct FactorsSource {
  std::filesystem::path factors;
  std::optional<std::string> reflectance, emission, areas;
  std::optional<std::string> factor_bounds, reflectance_bounds, emission_bounds;

  bool has_bounds() const { return factor_bounds || reflectance_bounds || emission_bounds; }
  /// All that are files.
  std::vector<std::filesystem::path> files() const;
};

/// Numbers, and half the width of what each may be; decimal ones as written.
template <class Matrix>
struct Known {
  Matrix value;
  bool decimal = false;
  std::optional<Matrix> bound = std::nullopt;
  bool decimal_bound = false;
};

/// Everything that was read.
struct FactorsData {
  FactorsFile factors;
  std::optional<NumberTable> factor_bounds;  ///< 1 × 1 where one number holds for all pairs, zeros too
  Known<Eigen::MatrixXd> reflectance, emission;
  Eigen::VectorXd areas;
  std::optional<RepairedFactors> repaired;
};

/// Errors    those of read_factors() and read_number_table(); sizes that do not fit; factors outside [0, 1], reflectances outside
///           [0, 1), emissions or bounds below 0, areas that are not positive: file, line, row, channel and value named
[[nodiscard]] Result<FactorsData> read_factors_data(const FactorsSource& source);

[[nodiscard]] std::shared_ptr<const FormFactors> form_factors(const FactorsFile& file, const Schedule& schedule);

/// max |A_i F_ij − A_j F_ji| as a share of the larger of the two. Contract: there are areas
[[nodiscard]] double reciprocity_defect(const FactorsData& data);

/// The equation of the numbers as they were read.
[[nodiscard]] RadiosityEquation equation_of(const FactorsData& data, const Schedule& schedule);

/// The equation between the two ends of every number as written, and its bounds: F in [max(0, F − f), min(1, F + f)], ρ and E
/// alike. Rounded outwards.
[[nodiscard]] EnclosedRadiosityEquation enclosed(const FactorsData& data, const Schedule& schedule);

}  // namespace etendue::cli
