// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "etendue/assembly/form_factor_matrix.hpp"

namespace etendue {

/// What an element's row sum Σ_j F_ij says of what it sees, as far as the bounds of its factors can tell.  @eq IU.6-6
enum class Outlook {
  closed,       ///< 1: fronts all around
  open,         ///< below 1: the rest of its light leaves the scene, or ends on backs of surfaces
  exceeded,     ///< above 1: surfaces overlap, or bounds are wrong
  covered,      ///< 0, and surfaces all around show it their backs: it lies inside or under something
  facing_void,  ///< 0, and a way leads out of the scene
  unknown,      ///< the bounds of its factors sum to one or more: anything may be
};

/// Directions in which an element without a view looks for a way out; found_covered() says how they are spread.
inline constexpr int kWaysOut = 64;

/// Do surfaces all around show this element their backs? Of one that sees nothing: it lies inside or under something.
/// Accuracy  as closure_report() says
[[nodiscard]] bool is_covered(const ElementMesh& mesh, const Element& element);

/// How well the matrix closes.                                                                     @eq IU.6-6
struct ClosureReport {
  Eigen::VectorXd row_sums;          ///< Σ_j F_ij
  Eigen::VectorXd row_bounds;        ///< Σ_j of the bounds, and what n roundings add
  std::vector<Outlook> outlooks;     ///< of each element
  std::vector<std::size_t> covered;  ///< the elements that are Outlook::covered
  std::size_t closed = 0, open = 0, exceeded = 0, facing_void = 0, unknown = 0;
  std::size_t judged = 0;  ///< closed, open and exceeded ones: those that see something
  double defect = 0;       ///< max |1 − Σ_j F_ij| over these
  std::size_t worst = 0;   ///< the element where; meaningless where none is judged
  double total_bound = 0;  ///< Σ_i of the row bounds
  double largest_row_bound = 0;
};

/// Contract  a complete matrix of this mesh
/// Accuracy  closed, open, exceeded: as far as the bounds are right (measured where obstructed). Covered or facing the
///           void: kWaysOut rays from the element's centroid; an opening that none of them finds counts as covered
[[nodiscard]] ClosureReport closure_report(const ElementMesh& mesh, const FormFactorMatrix& matrix);

}  // namespace etendue
