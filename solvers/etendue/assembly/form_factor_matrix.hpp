// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "etendue/core/bounded.hpp"
#include "etendue/execution/execution.hpp"
#include "etendue/meshing/elements.hpp"

namespace etendue {

/// What is asked of the single form factors.
struct AssemblyTolerance {
  Tolerance free{1e-12, 1e-15};      ///< where nothing comes between
  Tolerance obstructed{1e-6, 1e-9};  ///< where faces do
};

/// Of the pairs with nothing between them, every n-th is also computed from the other side.
inline constexpr std::size_t kCheckedClearPairs = 16;

/// How many pairs of elements were of which kind.
struct PairCounts {
  std::size_t averted = 0;     ///< cannot see each other's front
  std::size_t clear = 0;       ///< nothing between them
  std::size_t blocked = 0;     ///< one face hides all
  std::size_t obstructed = 0;  ///< computed with blockers
};

/// F_ij and F_ji computed each on its own, for all obstructed pairs and a sample of the clear ones.  @eq IU.6-5
struct ReciprocityReport {
  std::size_t pairs = 0;          ///< computed from both sides
  std::size_t disagreements = 0;  ///< pairs whose two values differ by more than their bounds allow
  double defect = 0;              ///< max |A_i F_ij − A_j F_ji| / max(A_i, A_j)
};

/// The form factors between the elements of a scene, as computed: nothing is normalised.
struct FormFactorMatrix {
  Eigen::MatrixXd factors;  ///< F_ij, n × n
  Eigen::MatrixXd bounds;   ///< on |F_ij − exact|; where obstructed an estimate (form_factor/obstructed.hpp)
  PairCounts pairs;
  ReciprocityReport reciprocity;
  std::vector<bool> row_done;  ///< all true unless stopped
  bool complete = false;       ///< false: stopped; pairs of two rows that are not done are zero
};

/// F_ij for all pairs i < j, and F_ji = A_i F_ij / A_j.                                  @eq IU.6-3, IU.6-4, IU.6-5
///
/// Accuracy  clear pairs: as form_factor() bounds them, proved. Obstructed pairs: computed from both sides; the larger
///           value is taken, since what an adaptive rule overlooks is a narrow gap, and its bound is the larger of the
///           two estimates and of the difference: measured. Touching surfaces: as kTouching says
/// Order     the same bits with any number of threads; stops between rows
[[nodiscard]] FormFactorMatrix assemble_form_factors(const ElementMesh& mesh, const AssemblyTolerance& tolerance,
                                                     const Execution& execution);

/// How well the matrix closes.                                                                     @eq IU.6-6
struct ClosureReport {
  Eigen::VectorXd row_sums;  ///< Σ_j F_ij
  std::vector<std::size_t>
      covered;             ///< elements that see nothing (Σ_j F_ij within its bounds of 0): under another surface
  double defect = 0;       ///< max |1 − Σ_j F_ij| over the others
  std::size_t worst = 0;   ///< the element where
  double total_bound = 0;  ///< Σ_ij of the bounds
  double largest_row_bound = 0;  ///< max_i Σ_j of the bounds
};
[[nodiscard]] ClosureReport closure_report(const FormFactorMatrix& matrix);

}  // namespace etendue
