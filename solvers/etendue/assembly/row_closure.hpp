// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "etendue/assembly/exchange_matrix.hpp"

namespace etendue {

/// How each row closes: s_i = Σ_j F_ij.                                                            @eq IU.6-6
struct RowClosure {
  std::vector<double> sums;          ///< s_i
  std::vector<double> bounds;        ///< on |s_i − exact|: the row's factors' bounds, and the rounding of the sum
  std::vector<std::size_t> covered;  ///< rows that see nothing: s_i within its bound of 0, not of 1
  std::vector<std::size_t> open;     ///< rows whose sum stays below 1 by more than its bound
  std::vector<std::size_t> above;    ///< rows whose sum exceeds 1 by more than its bound: surfaces overlap
  double defect = 0;                 ///< max |1 − s_i| over the rows that are not covered
  std::size_t worst = 0;             ///< the row where
  double largest_bound = 0;          ///< of a single factor
  std::size_t loosest_from = 0, loosest_to = 0;  ///< the factor with it

  bool closed() const { return open.empty() && above.empty(); }
};

/// Contract  a complete matrix
[[nodiscard]] RowClosure row_closure(const ExchangeMatrix& matrix);

}  // namespace etendue
