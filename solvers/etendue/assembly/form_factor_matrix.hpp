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
  Tolerance obstructed{1e-4, 1e-7};  ///< where faces do
};

/// How many pairs of elements were of which kind.
struct PairCounts {
  std::size_t averted = 0;     ///< cannot see each other's front
  std::size_t clear = 0;       ///< nothing between them
  std::size_t blocked = 0;     ///< one face hides all
  std::size_t obstructed = 0;  ///< computed with blockers
};

/// The form factors between the elements of a scene, as computed: nothing is normalised or repaired.
struct FormFactorMatrix {
  Eigen::MatrixXd factors;  ///< F_ij, n × n
  Eigen::MatrixXd bounds;   ///< on |F_ij − exact|; an estimate where obstructed (form_factor/obstructed.hpp)
  PairCounts pairs;
  std::vector<bool> row_done;  ///< all true unless stopped
  bool complete = false;       ///< false: stopped; entries of rows not done are zero
};

/// F_ij for all pairs i < j, and F_ji = A_i F_ij / A_j.                                  @eq IU.6-3, IU.6-4, IU.6-5
///
/// Accuracy  each F_ij as form_factor() or obstructed_form_factor() bound it; touching surfaces as kTouching says;
///           reciprocity holds by construction up to two roundings (measure_reciprocity() asks the routines again)
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

/// F_ij and F_ji computed independently on a sample of pairs.                                       @eq IU.6-5
struct ReciprocityReport {
  std::size_t pairs = 0;  ///< of the sample; those that see each other
  double defect = 0;      ///< max |A_i F_ij − A_j F_ji| / max(A_i, A_j)
  double allowed = 0;     ///< what the bounds of the worst pair allow
};

/// Every n-th pair in a fixed order, about `sample` in all.
[[nodiscard]] ReciprocityReport measure_reciprocity(const ElementMesh& mesh, const AssemblyTolerance& tolerance,
                                                    std::size_t sample, const Execution& execution);

}  // namespace etendue
