// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/assembly/closure_repair.hpp"
#include "etendue/radiosity/form_factors.hpp"

namespace etendue {

/// Form factors from elsewhere, mended: reciprocal and closed.
struct RepairedFactors {
  RowMatrix factors;
  double reciprocity_defect = 0;  ///< max |A_i F_ij − A_j F_ji| / max(A_i, A_j) before
  RepairReport report;
};

/// repaired() of closure_repair.hpp for a matrix of which nothing is known but its numbers: A_i F_ij becomes the mean of
/// A_i F_ij and A_j F_ji, as uncertain as both differ and a share of it besides, and then all rows close to 1.
///                                                                                          @eq IU.6-5, IU.6-6
/// Contract  as many areas as rows, all positive; F_ij ≥ 0
/// Errors    not_converged: a row misses more than kOpenRow of 1, or no change closes all rows
[[nodiscard]] Result<RepairedFactors> repaired(const RowMatrix& factors, const Eigen::VectorXd& areas);

}  // namespace etendue
