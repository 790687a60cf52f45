// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/form_factor_matrix.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/assembly/sight.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/obstructed.hpp"
#include "etendue/form_factor/polygon_polygon.hpp"

namespace etendue {

namespace {

struct RowReport {
  PairCounts pairs;
  ReciprocityReport reciprocity;
};

// One pair of elements, first and second, seen from either side.
struct Pair {
  const Polygon& first;
  const Polygon& second;
  std::vector<Polygon> blockers;

  double ratio() const { return first.area() / second.area(); }

  Bounded factor(const Polygon& from, const Polygon& to, const AssemblyTolerance& tolerance) const {
    return blockers.empty() ? form_factor(from, to, tolerance.free)
                            : obstructed_form_factor(from, to, blockers, tolerance.obstructed);
  }

  // From both sides, as a factor of the first; the two are compared in `report`.
  Bounded checked_factor(const AssemblyTolerance& tolerance, ReciprocityReport& report) const {
    const Bounded there = factor(first, second, tolerance);
    Bounded back = factor(second, first, tolerance);
    back = {back.value / ratio(), back.bound / ratio()};
    const double difference = std::abs(there.value - back.value);
    // Two roundings on the way from A_j F_ji to F_ij.
    const double allowed = there.bound + back.bound + gamma_bound(4) * std::max(there.value, back.value);
    ++report.pairs;
    if (difference > allowed) ++report.disagreements;
    report.defect = std::max(report.defect, difference * std::min(1.0, ratio()));
    return {std::max(there.value, back.value), std::max({there.bound, back.bound, difference})};
  }
};

Bounded pair_factor(const ElementMesh& mesh, const SightMap& sights, const AssemblyTolerance& tolerance, std::size_t i,
                    std::size_t j, RowReport& report) {
  const SightLine line = sights.between(i, j);
  Pair pair{mesh.elements[i].polygon, mesh.elements[j].polygon, {}};
  switch (line.sight) {
    case Sight::averted:
      ++report.pairs.averted;
      return {0, 0};
    case Sight::blocked:
      ++report.pairs.blocked;
      return {0, 0};
    case Sight::clear:
      if (report.pairs.clear++ % kCheckedClearPairs == 0) return pair.checked_factor(tolerance, report.reciprocity);
      return pair.factor(pair.first, pair.second, tolerance);
    case Sight::undecided:
      break;
  }
  ++report.pairs.obstructed;
  for (const std::size_t face : line.blockers) pair.blockers.push_back(mesh.faces[face].polygon);
  return pair.checked_factor(tolerance, report.reciprocity);
}

void add(RowReport& sum, const RowReport& row) {
  sum.pairs.averted += row.pairs.averted;
  sum.pairs.clear += row.pairs.clear;
  sum.pairs.blocked += row.pairs.blocked;
  sum.pairs.obstructed += row.pairs.obstructed;
  sum.reciprocity.pairs += row.reciprocity.pairs;
  sum.reciprocity.disagreements += row.reciprocity.disagreements;
  sum.reciprocity.defect = std::max(sum.reciprocity.defect, row.reciprocity.defect);
}

}  // namespace

FormFactorMatrix assemble_form_factors(const ElementMesh& mesh, const AssemblyTolerance& tolerance,
                                       const Execution& execution) {
  const std::size_t n = mesh.elements.size();
  const auto size = static_cast<Eigen::Index>(n);
  const SightMap sights(mesh);
  FormFactorMatrix matrix{Eigen::MatrixXd::Zero(size, size), Eigen::MatrixXd::Zero(size, size), {}, {}, {}, false};
  std::vector<RowReport> rows(n);
  std::vector<char> done(n, 0);  // not vector<bool>: threads write neighbours

  matrix.complete = parallel_for(n, execution, [&](std::size_t row) {
    for (std::size_t column = row + 1; column < n; ++column) {
      const Bounded factor = pair_factor(mesh, sights, tolerance, row, column, rows[row]);
      const auto i = static_cast<Eigen::Index>(row), j = static_cast<Eigen::Index>(column);
      const double ratio = mesh.elements[row].polygon.area() / mesh.elements[column].polygon.area();
      matrix.factors(i, j) = factor.value;
      matrix.bounds(i, j) = factor.bound;
      matrix.factors(j, i) = factor.value * ratio;
      matrix.bounds(j, i) = factor.bound * ratio;
    }
    done[row] = 1;
  });

  RowReport sum;
  for (const RowReport& row : rows) add(sum, row);
  matrix.pairs = sum.pairs;
  matrix.reciprocity = sum.reciprocity;
  matrix.row_done.assign(done.begin(), done.end());
  return matrix;
}

ClosureReport closure_report(const FormFactorMatrix& matrix) {
  const Eigen::Index n = matrix.factors.rows();
  ClosureReport report;
  report.row_sums = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    double row_bound = 0;
    for (Eigen::Index j = 0; j < n; ++j) {
      report.row_sums(i) += matrix.factors(i, j);
      row_bound += matrix.bounds(i, j);
    }
    report.total_bound += row_bound;
    report.largest_row_bound = std::max(report.largest_row_bound, row_bound);
    if (report.row_sums(i) <= row_bound) {  // zero, as far as the bounds can tell
      report.covered.push_back(static_cast<std::size_t>(i));
    } else if (std::abs(1 - report.row_sums(i)) > report.defect) {
      report.defect = std::abs(1 - report.row_sums(i));
      report.worst = static_cast<std::size_t>(i);
    }
  }
  return report;
}

}  // namespace etendue
