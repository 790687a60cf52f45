// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/drop.hpp"

#include <algorithm>
#include <vector>

#include "etendue/core/contract.hpp"

namespace etendue {

DropReport drop_below(ExchangeMatrix& matrix, double threshold) {
  require(matrix.complete(), "drop_below: the matrix is complete");
  DropReport report;
  std::vector<double> shares(matrix.size(), 0);
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    for (std::size_t j = i; j < matrix.size(); ++j) {
      const double value = matrix.exchange(i, j);
      if (value == 0 || value >= threshold * std::min(matrix.areas()[i], matrix.areas()[j])) continue;
      shares[i] += value / matrix.areas()[i];
      if (i != j) shares[j] += value / matrix.areas()[j];
      matrix.set(i, j, {0, value + matrix.exchange_bound(i, j)});
      ++report.pairs;
    }
  }
  const TileReport what = matrix.report();
  for (std::size_t tile = 0; tile < matrix.layout().tiles(); ++tile)
    matrix.close(tile, tile == 0 ? what : TileReport{});
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (shares[i] <= report.largest_share) continue;
    report.largest_share = shares[i];
    report.row = i;
  }
  return report;
}

}  // namespace etendue
