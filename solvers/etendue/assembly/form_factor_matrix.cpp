// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/form_factor_matrix.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/assembly/sight.hpp"
#include "etendue/form_factor/obstructed.hpp"
#include "etendue/form_factor/polygon_polygon.hpp"

namespace etendue {

namespace {

struct PairFactor {
  Bounded factor;
  Sight sight;
};

PairFactor pair_factor(const ElementMesh& mesh, const SightMap& sights, const AssemblyTolerance& tolerance,
                       std::size_t i, std::size_t j) {
  const SightLine line = sights.between(i, j);
  const Polygon& from = mesh.elements[i].polygon;
  const Polygon& to = mesh.elements[j].polygon;
  switch (line.sight) {
    case Sight::averted:
    case Sight::blocked:
      return {{0, 0}, line.sight};
    case Sight::clear:
      return {form_factor(from, to, tolerance.free), line.sight};
    case Sight::undecided:
      break;
  }
  std::vector<Polygon> blockers;
  for (const std::size_t face : line.blockers) blockers.push_back(mesh.faces[face].polygon);
  return {obstructed_form_factor(from, to, blockers, tolerance.obstructed), line.sight};
}

void count(PairCounts& counts, Sight sight) {
  switch (sight) {
    case Sight::averted:
      ++counts.averted;
      break;
    case Sight::clear:
      ++counts.clear;
      break;
    case Sight::blocked:
      ++counts.blocked;
      break;
    case Sight::undecided:
      ++counts.obstructed;
      break;
  }
}

}  // namespace

FormFactorMatrix assemble_form_factors(const ElementMesh& mesh, const AssemblyTolerance& tolerance,
                                       const Execution& execution) {
  const std::size_t n = mesh.elements.size();
  const auto size = static_cast<Eigen::Index>(n);
  const SightMap sights(mesh);
  FormFactorMatrix matrix{Eigen::MatrixXd::Zero(size, size), Eigen::MatrixXd::Zero(size, size), {}, {}, false};
  std::vector<PairCounts> counts(n);
  std::vector<char> done(n, 0);  // not vector<bool>: threads write neighbours

  matrix.complete = parallel_for(n, execution, [&](std::size_t row) {
    for (std::size_t column = row + 1; column < n; ++column) {
      const PairFactor pair = pair_factor(mesh, sights, tolerance, row, column);
      count(counts[row], pair.sight);
      const auto i = static_cast<Eigen::Index>(row), j = static_cast<Eigen::Index>(column);
      const double ratio = mesh.elements[row].polygon.area() / mesh.elements[column].polygon.area();
      matrix.factors(i, j) = pair.factor.value;
      matrix.bounds(i, j) = pair.factor.bound;
      matrix.factors(j, i) = pair.factor.value * ratio;
      matrix.bounds(j, i) = pair.factor.bound * ratio;
    }
    done[row] = 1;
  });

  for (const PairCounts& row : counts) {
    matrix.pairs.averted += row.averted;
    matrix.pairs.clear += row.clear;
    matrix.pairs.blocked += row.blocked;
    matrix.pairs.obstructed += row.obstructed;
  }
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

ReciprocityReport measure_reciprocity(const ElementMesh& mesh, const AssemblyTolerance& tolerance, std::size_t sample,
                                      const Execution& execution) {
  const std::size_t n = mesh.elements.size();
  const std::size_t step = std::max<std::size_t>(1, n * (n - 1) / 2 / std::max<std::size_t>(1, sample));
  const SightMap sights(mesh);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  std::size_t ordinal = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      if (ordinal++ % step == 0) pairs.emplace_back(i, j);
    }
  }
  struct Defect {
    bool seen = false;
    double defect = 0, allowed = 0;
  };
  std::vector<Defect> defects(pairs.size());
  parallel_for(pairs.size(), execution, [&](std::size_t k) {
    const auto [i, j] = pairs[k];
    const PairFactor there = pair_factor(mesh, sights, tolerance, i, j);
    if (there.sight == Sight::averted || there.sight == Sight::blocked) return;
    const PairFactor back = pair_factor(mesh, sights, tolerance, j, i);
    const double a_i = mesh.elements[i].polygon.area(), a_j = mesh.elements[j].polygon.area();
    const double larger = std::max(a_i, a_j);
    defects[k] = {true, std::abs(a_i * there.factor.value - a_j * back.factor.value) / larger,
                  (a_i * there.factor.bound + a_j * back.factor.bound) / larger};
  });
  ReciprocityReport report;
  for (const Defect& defect : defects) {
    report.pairs += defect.seen;
    if (defect.defect > report.defect) {
      report.defect = defect.defect;
      report.allowed = defect.allowed;
    }
  }
  return report;
}

}  // namespace etendue
