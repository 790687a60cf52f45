// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/form_factor_matrix.hpp"

#include <algorithm>
#include <utility>

#include "etendue/assembly/exact_exchange.hpp"
#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

void count(const PairFactor& found, ReciprocityReport& report) {
  if (!found.checked) return;
  ++report.pairs;
  if (!found.agree) ++report.disagreements;
  if (found.agree && found.quarterings > 0) ++report.refined;
  report.defect = std::max(report.defect, found.difference);
}

bool worse(const MissedTolerance& a, const MissedTolerance& b) {
  return b.pairs == 0 || a.bound * b.allowed > b.bound * a.allowed;
}

void join(MissedTolerance& sum, const MissedTolerance& more) {
  if (more.pairs == 0) return;
  const std::size_t pairs = sum.pairs + more.pairs;
  if (worse(more, sum)) sum = more;
  sum.pairs = pairs;
}

void count(PairSight sight, PairCounts& counts) {
  switch (sight) {
    case PairSight::averted:
      ++counts.averted;
      break;
    case PairSight::clear:
      ++counts.clear;
      break;
    case PairSight::blocked:
      ++counts.blocked;
      break;
    case PairSight::undecided:
      ++counts.obstructed;
      break;
  }
}

void add(RowReport& sum, const RowReport& row) {
  sum.pairs.averted += row.pairs.averted;
  sum.pairs.clear += row.pairs.clear;
  sum.pairs.blocked += row.pairs.blocked;
  sum.pairs.obstructed += row.pairs.obstructed;
  sum.reciprocity.pairs += row.reciprocity.pairs;
  sum.reciprocity.refined += row.reciprocity.refined;
  sum.reciprocity.disagreements += row.reciprocity.disagreements;
  sum.reciprocity.defect = std::max(sum.reciprocity.defect, row.reciprocity.defect);
  join(sum.missed, row.missed);
}

/// Row i right of the diagonal, and what there is to report of it.
void compute_row(const ElementMesh& mesh, const ExactExchange& exact, const AssemblyTolerance& tolerance,
                 std::size_t row, FormFactorMatrix& matrix) {
  const std::size_t n = mesh.elements.size();
  std::vector<SurfacePair> pairs;
  for (std::size_t column = row + 1; column < n; ++column) pairs.push_back({row, column});
  const std::vector<SeenPair> seen = exact.factors(pairs, AbsoluteError::of_this);
  RowReport& report = matrix.rows[row];
  for (std::size_t column = row + 1; column < n; ++column) {
    const auto& [sight, found] = seen[column - row - 1];
    const Bounded factor = found.factor;
    count(sight, report.pairs);
    const auto i = static_cast<Eigen::Index>(row), j = static_cast<Eigen::Index>(column);
    const double ratio = mesh.elements[row].polygon.area() / mesh.elements[column].polygon.area();
    count(found, report.reciprocity);
    const double allowed = std::max(allowed_error(tolerance.free, factor.value, ratio),
                                    allowed_error(tolerance.obstructed, factor.value, ratio));
    if (factor.bound > allowed * (1 + gamma_bound(4))) join(report.missed, {1, row, column, factor.bound, allowed});
    matrix.factors(i, j) = factor.value;
    matrix.bounds(i, j) = factor.bound;
  }
}

/// F_ji = A_i F_ij / A_j, left of the diagonal.                                                     @eq IU.6-5
void mirror_row(const ElementMesh& mesh, std::size_t row, FormFactorMatrix& matrix) {
  for (std::size_t column = row + 1; column < mesh.elements.size(); ++column) {
    const auto i = static_cast<Eigen::Index>(row), j = static_cast<Eigen::Index>(column);
    const double ratio = mesh.elements[row].polygon.area() / mesh.elements[column].polygon.area();
    matrix.factors(j, i) = matrix.factors(i, j) * ratio;
    matrix.bounds(j, i) = matrix.bounds(i, j) * ratio;
  }
}

}  // namespace

FormFactorMatrix assemble_form_factors(const ElementMesh& mesh, const AssemblyTolerance& tolerance,
                                       const Execution& execution, FormFactorMatrix begun) {
  const std::size_t n = mesh.elements.size();
  FormFactorMatrix matrix = std::move(begun);
  if (matrix.row_done.empty()) {
    const auto size = static_cast<Eigen::Index>(n);
    matrix.factors = matrix.bounds = Eigen::MatrixXd::Zero(size, size);
    matrix.row_done.assign(n, false);
    matrix.rows.assign(n, {});
  }
  require(matrix.row_done.size() == n && matrix.rows.size() == n, "assemble_form_factors: rows of this mesh");
  const ExactExchange exact(mesh, tolerance);
  std::vector<char> done(matrix.row_done.begin(), matrix.row_done.end());  // not vector<bool>: threads write neighbours
  matrix.complete = parallel_for(n, execution, [&](std::size_t row) {
    if (!done[row]) compute_row(mesh, exact, tolerance, row, matrix);
    mirror_row(mesh, row, matrix);
    done[row] = 1;
  });

  RowReport sum;
  for (const RowReport& row : matrix.rows) add(sum, row);
  matrix.pairs = sum.pairs;
  matrix.reciprocity = sum.reciprocity;
  matrix.missed = sum.missed;
  matrix.row_done.assign(done.begin(), done.end());
  return matrix;
}

}  // namespace etendue
