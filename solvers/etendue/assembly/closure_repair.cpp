// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/closure_repair.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/text/number_text.hpp"

namespace etendue {

namespace {

using Numbers = std::vector<double>;

/// Rows count as closed when what is left is the rounding of their sum.
constexpr double kClosedRow = 0x1p-44;
/// How often pairs may be newly held at zero, and steps of the iteration for a row.
constexpr int kMostRounds = 20;
constexpr std::size_t kStepsARow = 20;
constexpr std::size_t kFewestSteps = 1000;

double dot(const Numbers& a, const Numbers& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

/// The equations for λ, all in factors' units: row i is divided by √(W_i), so that the matrix has ones on its diagonal.
class Repair {
 public:
  Repair(const ExchangeMatrix& matrix, const RowClosure& closure)
      : matrix_(matrix), n_(matrix.size()), active_(n_, 1), held_(n_ * n_, 0) {
    for (const std::size_t row : closure.covered) active_[row] = 0;
  }

  /// The weight of a pair; 0 where it may not change.
  double weight(std::size_t i, std::size_t j) const {
    if (active_[i] == 0 || active_[j] == 0 || held_[i * n_ + j] != 0) return 0;
    const double value = matrix_.exchange(i, j);
    if (value == 0) return 0;
    // Rounding counts as uncertainty too, so that exact rows can absorb the rounding of their own sum.
    return matrix_.exchange_bound(i, j) + 4 * kUnitRoundoff * value;
  }

  /// λ for what is held now; false where none closes the rows.
  bool solve() {
    Numbers defect(n_, 0), sums(n_, 0);
    for (std::size_t i = 0; i < n_; ++i) {
      if (active_[i] == 0) continue;
      double present = 0;
      for (std::size_t j = 0; j < n_; ++j) {
        if (held_[i * n_ + j] == 0) present += matrix_.exchange(i, j);
        sums[i] += i == j ? 2 * weight(i, j) : weight(i, j);
      }
      defect[i] = matrix_.areas()[i] - present;
    }
    for (std::size_t i = 0; i < n_; ++i) {
      if (active_[i] != 0 && sums[i] == 0) return std::abs(defect[i]) <= kClosedRow * matrix_.areas()[i];
    }
    return conjugate_gradients(defect, sums);
  }

  double change(std::size_t i, std::size_t j) const { return weight(i, j) * (lambda_[i] + lambda_[j]); }

  /// Holds at zero what λ makes negative; how many that are.
  std::size_t hold_negative() {
    std::size_t count = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = i; j < n_; ++j) {
        if (weight(i, j) == 0 || matrix_.exchange(i, j) + change(i, j) >= 0) continue;
        fresh_.emplace_back(i, j);
        ++count;
      }
    }
    for (const auto& [i, j] : fresh_) held_[i * n_ + j] = held_[j * n_ + i] = 1;
    fresh_.clear();
    return count;
  }

  bool held(std::size_t i, std::size_t j) const { return held_[i * n_ + j] != 0; }
  bool active(std::size_t i) const { return active_[i] != 0; }

 private:
  /// (D + W) λ, scaled on both sides.
  Numbers product(const Numbers& scaled, const Numbers& root) const {
    Numbers result(n_, 0);
    for (std::size_t i = 0; i < n_; ++i) {
      if (root[i] == 0) continue;
      const double own = scaled[i] / root[i];
      double sum = 0;
      for (std::size_t j = 0; j < n_; ++j) {
        const double w = weight(i, j);
        if (w != 0) sum += w * (own + scaled[j] / root[j]);
      }
      result[i] = sum / root[i];
    }
    return result;
  }

  bool conjugate_gradients(const Numbers& defect, const Numbers& sums) {
    Numbers root(n_, 0), residual(n_, 0), x(n_, 0);
    for (std::size_t i = 0; i < n_; ++i) {
      root[i] = std::sqrt(sums[i]);
      if (root[i] > 0) residual[i] = defect[i] / root[i];
    }
    const auto closed = [&] {
      for (std::size_t i = 0; i < n_; ++i) {
        if (std::abs(residual[i] * root[i]) > kClosedRow * matrix_.areas()[i]) return false;
      }
      return true;
    };
    Numbers direction = residual;
    double size = dot(residual, residual);
    for (std::size_t step = 0; step < kFewestSteps + kStepsARow * n_ && size > 0 && !closed(); ++step) {
      const Numbers turned = product(direction, root);
      const double curvature = dot(direction, turned);
      if (!(curvature > 0)) break;  // nothing left that λ can change
      const double length = size / curvature;
      for (std::size_t i = 0; i < n_; ++i) {
        x[i] += length * direction[i];
        residual[i] -= length * turned[i];
      }
      const double next = dot(residual, residual);
      for (std::size_t i = 0; i < n_; ++i) direction[i] = residual[i] + next / size * direction[i];
      size = next;
    }
    lambda_.assign(n_, 0);
    for (std::size_t i = 0; i < n_; ++i) {
      if (root[i] > 0) lambda_[i] = x[i] / root[i];
    }
    return closed();
  }

  const ExchangeMatrix& matrix_;
  std::size_t n_;
  std::vector<char> active_, held_;
  Numbers lambda_;
  std::vector<std::pair<std::size_t, std::size_t>> fresh_;
};

Error refusal(const std::string& what) {
  return {ErrorCode::not_converged, "closure is not repaired: " + what};
}

}  // namespace

Result<RepairedExchanges> repaired(const ExchangeMatrix& matrix, const RowClosure& closure) {
  require(matrix.complete(), "repaired: the matrix is complete");
  if (closure.defect > kOpenRow) {
    return refusal("row " + std::to_string(closure.worst + 1) + " sums to " + rounded(closure.sums[closure.worst], 3) +
                   "; rows that are off by more than " + rounded(kOpenRow, 3) + " are open, or their surfaces overlap");
  }
  Repair repair(matrix, closure);
  bool solved = repair.solve();
  for (int round = 0; solved && repair.hold_negative() > 0; ++round) {
    solved = round < kMostRounds && repair.solve();
  }
  if (!solved) return refusal("no change of the factors that are uncertain closes all rows");

  RepairReport report;
  report.defect_before = closure.defect;
  report.left_alone = closure.covered.size();
  ExchangeMatrix result(matrix.areas());
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    for (std::size_t j = i; j < matrix.size(); ++j) {
      const double before = matrix.exchange(i, j), bound = matrix.exchange_bound(i, j);
      const double after = repair.held(i, j) ? 0 : before + repair.change(i, j);
      const double change = std::abs(after - before);
      result.set(i, j, {after, bound + change});
      if (change == 0) continue;
      ++report.changed;
      report.at_zero += repair.held(i, j);
      report.beyond += change > bound + 4 * kUnitRoundoff * before;
      const double smaller = std::min(matrix.areas()[i], matrix.areas()[j]);
      if (change / smaller > report.largest_change) {
        const bool from_i = matrix.areas()[i] <= matrix.areas()[j];
        report.largest_change = change / smaller;
        report.from = from_i ? i : j;
        report.to = from_i ? j : i;
      }
    }
  }
  const TileReport what = matrix.report();
  for (std::size_t tile = 0; tile < result.layout().tiles(); ++tile)
    result.close(tile, tile == 0 ? what : TileReport{});
  for (std::size_t i = 0; i < result.size(); ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < result.size(); ++j) sum += result.exchange(i, j);
    if (repair.active(i)) report.defect_after = std::max(report.defect_after, std::abs(1 - sum / result.areas()[i]));
  }
  return RepairedExchanges{std::move(result), report};
}

}  // namespace etendue
