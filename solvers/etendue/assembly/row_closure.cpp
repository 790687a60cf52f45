// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/row_closure.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"

namespace etendue {

RowClosure row_closure(const ExchangeMatrix& matrix) {
  require(matrix.complete(), "row_closure: the matrix is complete");
  const std::size_t n = matrix.size();
  RowClosure closure;
  closure.sums.resize(n);
  closure.bounds.resize(n);
  const auto take = [&](std::size_t i, std::size_t j) {
    const Bounded factor = matrix.factor(i, j);
    closure.sums[i] += factor.value;
    closure.bounds[i] += factor.bound;
    if (factor.bound > closure.largest_bound) {
      closure.largest_bound = factor.bound;
      closure.loosest_from = i;
      closure.loosest_to = j;
    }
  };
  // Both factors of a pair lie in one cell. Every row takes its columns in ascending order all the same.
  for (std::size_t i = 0; i < n; ++i) {
    take(i, i);
    for (std::size_t j = i + 1; j < n; ++j) {
      take(i, j);
      take(j, i);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double sum = closure.sums[i];
    const double rounding = gamma_bound(static_cast<int>(std::min<std::size_t>(2 * n + 2, 1u << 30)));
    const double bound = closure.bounds[i] * (1 + rounding) + rounding * sum;
    closure.bounds[i] = bound;
    if (sum <= bound && 1 - sum > bound) {  // a bound that holds 0 and 1 alike tells nothing
      closure.covered.push_back(i);
      continue;
    }
    if (1 - sum > bound) closure.open.push_back(i);
    if (sum - 1 > bound) closure.above.push_back(i);
    if (std::abs(1 - sum) > closure.defect) {
      closure.defect = std::abs(1 - sum);
      closure.worst = i;
    }
  }
  return closure;
}

}  // namespace etendue
