// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "etendue/assembly/pair_factor.hpp"
#include "etendue/execution/execution.hpp"
#include "etendue/meshing/elements.hpp"

namespace etendue {

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
  std::size_t refined = 0;        ///< pairs whose two values agreed only after quartering (kMostQuarterings)
  std::size_t disagreements = 0;  ///< pairs whose two values differ by more than their bounds allow all the same
  double defect = 0;              ///< max |A_i F_ij − A_j F_ji| / max(A_i, A_j)
};

/// Pairs whose bound exceeds what was asked: allowed_error() of AssemblyTolerance::obstructed, or of `free` where that
/// is looser. The worst is the one that exceeds it by the largest ratio.
struct MissedTolerance {
  std::size_t pairs = 0;
  std::size_t first = 0, second = 0;  ///< elements of the worst pair
  double bound = 0;                   ///< its bound on |F_ij − exact|
  double allowed = 0;                 ///< and what was asked
};

/// What one row, the pairs i < j, adds to the reports.
struct RowReport {
  PairCounts pairs;
  ReciprocityReport reciprocity;
  MissedTolerance missed;
};

/// The form factors between the elements of a scene, as computed: nothing is normalised.
struct FormFactorMatrix {
  Eigen::MatrixXd factors;  ///< F_ij, n × n
  Eigen::MatrixXd bounds;   ///< on |F_ij − exact|; where obstructed an estimate (form_factor/obstructed.hpp)
  PairCounts pairs;
  ReciprocityReport reciprocity;
  MissedTolerance missed;
  std::vector<bool> row_done;     ///< all true unless stopped
  bool complete = false;          ///< false: stopped; pairs of two rows that are not done are zero
  std::vector<RowReport> rows{};  ///< of each row that is done
};

/// F_ij for all pairs i < j, and F_ji = A_i F_ij / A_j.                                  @eq IU.6-3, IU.6-4, IU.6-5
///
/// Accuracy  clear pairs: as form_factor() bounds them, proved. Obstructed pairs: as ExactExchange computes them,
///           measured. Touching surfaces: as SightMap::slack()
/// Returns   also where the tolerance is missed, with the bounds reached: MissedTolerance counts these pairs
/// Order     the same bits with any number of threads; stops between rows. Rows of `begun` that are done stay as they
///           are, right of the diagonal: going on has the same bits as never having stopped
/// Contract  `begun` is empty, or of this mesh and tolerance, or read_rows() of such a one
[[nodiscard]] FormFactorMatrix assemble_form_factors(const ElementMesh& mesh, const AssemblyTolerance& tolerance,
                                                     const Execution& execution, FormFactorMatrix begun = {});

}  // namespace etendue
