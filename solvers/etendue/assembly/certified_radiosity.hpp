// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "etendue/assembly/certified_exchange.hpp"
#include "etendue/assembly/form_factor_matrix.hpp"
#include "etendue/radiosity/enclosure.hpp"

namespace etendue {

/// Half the width asked of enclosures where nothing is in between, relative: little beside what obstructed pairs leave open.
inline constexpr double kCertifiedFree = 1e-6;
/// Most evaluations that an obstructed pair may cost, of about a microsecond each.
inline constexpr std::int64_t kCertifiedWork = 10'000;

/// Of every factor half the width asked is `relative` of it, or of 1/n: a row's half widths then sum to 2 relative.
[[nodiscard]] CertifiedGoals certified_goals(double relative, std::size_t elements);

/// As kBytesAPair: beside the factors and bounds the two ends, both by rows once more, a matrix, its copy, and one to spare.
inline constexpr double kCertifiedBytesAPair = 9 * sizeof(double);

/// Enclosures of all form factors of a scene.
struct CertifiedFactors {
  Eigen::MatrixXd lower, upper;  ///< of F_ij, n × n
  PairCounts pairs;              ///< none counts as blocked: their enclosures end at next to nothing
  std::size_t wide = 0;          ///< pairs wider than was asked
  double widest = 0;             ///< max upper − lower
  std::size_t from = 0, to = 0;  ///< where
  bool complete = false;         ///< false: stopped
};

/// Order     the same bits with any number of threads; stops between rows
[[nodiscard]] CertifiedFactors certified_factors(const ElementMesh& mesh, const CertifiedGoals& goals,
                                                 const Execution& execution);

/// Radiosities of a scene between two numbers each.
struct CertifiedRadiosity {
  std::vector<Rgb> lower, upper;     ///< of B of each element [W/m²]
  std::array<double, 3> widest{};    ///< max upper − lower of each channel
  std::array<std::size_t, 3> worst;  ///< the element where
};

/// Encloses the exact solution of the discrete system of 6-9, the form factors being exact.          @eq IU.6-9
///
/// Accuracy  proved, for ρ and E as the doubles of the scene: radiosity/NOTES.md §5
/// Contract  goal.may_go_on is set here
/// Errors    those of enclose_radiosity(), with the channel; ErrorCode::stopped
[[nodiscard]] Result<CertifiedRadiosity> solve_certified(const Scene& scene, const ElementMesh& mesh,
                                                         const CertifiedFactors& factors, RadiosityGoal goal,
                                                         const Execution& execution = {});

}  // namespace etendue
