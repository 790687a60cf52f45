// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "etendue/assembly/exchange_matrix.hpp"

namespace etendue {

/// What was dropped.
struct DropReport {
  std::size_t pairs = 0;     ///< that were not zero before
  double largest_share = 0;  ///< of a row: Σ_j of its dropped factors
  std::size_t row = 0;       ///< which
};

/// Sets to zero the pairs of which both factors are below `threshold`, so that a sparse file leaves them out. Their bounds
/// grow by what they were: the matrix stays true.
///
/// Contract  a complete matrix
DropReport drop_below(ExchangeMatrix& matrix, double threshold);

}  // namespace etendue
