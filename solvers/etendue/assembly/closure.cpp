// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/closure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

// The k-th of kWaysOut directions over the hemisphere, one in each band of equal solid angle, turned by the golden angle
// from band to band; none grazes: the lowest is 0.45° above the plane.
Vec3 way_out(const Vec3& normal, int k) {
  constexpr double kGoldenAngle = std::numbers::pi * (3 - 2.23606797749979);
  const Vec3 across = std::abs(normal.x()) < 0.5 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 u = normal.cross(across).normalized(), v = normal.cross(u);
  const double height = 1 - (k + 0.5) / kWaysOut;  // the first nearly along the normal: in the open it is enough
  const double radius = std::sqrt(1 - height * height), turn = k * kGoldenAngle;
  return height * normal + radius * (std::cos(turn) * u + std::sin(turn) * v);
}

Outlook outlook(const ElementMesh& mesh, std::size_t k, double sum, double bound) {
  if (!(bound < 1)) return Outlook::unknown;
  if (sum <= bound) return is_covered(mesh, mesh.elements[k]) ? Outlook::covered : Outlook::facing_void;
  if (sum > 1 + bound) return Outlook::exceeded;
  return sum < 1 - bound ? Outlook::open : Outlook::closed;
}

void enter(ClosureReport& report, std::size_t k) {
  switch (report.outlooks[k]) {
    case Outlook::covered:
      report.covered.push_back(k);
      return;
    case Outlook::facing_void:
      ++report.facing_void;
      return;
    case Outlook::unknown:
      ++report.unknown;
      return;
    case Outlook::closed:
      ++report.closed;
      break;
    case Outlook::open:
      ++report.open;
      break;
    case Outlook::exceeded:
      ++report.exceeded;
      break;
  }
  const double defect = std::abs(1 - report.row_sums(static_cast<Eigen::Index>(k)));
  if (report.judged++ > 0 && defect <= report.defect) return;
  report.defect = defect;
  report.worst = k;
}

}  // namespace

bool is_covered(const ElementMesh& mesh, const Element& element) {
  const auto meets_a_face = [&](const Ray& ray) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      if (f != element.face && intersect(ray, mesh.faces[f].polygon)) return true;
    }
    return false;
  };
  for (int k = 0; k < kWaysOut; ++k) {
    if (!meets_a_face({element.polygon.centroid(), way_out(element.polygon.normal(), k)})) return false;
  }
  return true;
}

ClosureReport closure_report(const ElementMesh& mesh, const FormFactorMatrix& matrix) {
  require(matrix.complete && mesh.elements.size() == static_cast<std::size_t>(matrix.factors.rows()),
          "closure_report: a complete matrix of this mesh");
  const Eigen::Index n = matrix.factors.rows();
  ClosureReport report;
  report.row_sums = Eigen::VectorXd::Zero(n);
  report.row_bounds = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      report.row_sums(i) += matrix.factors(i, j);
      report.row_bounds(i) += matrix.bounds(i, j);
    }
    // n sums of factors, each rounded by two products and divisions on its way from the other side.
    report.row_bounds(i) += gamma_bound(static_cast<int>(n) + 4) * report.row_sums(i);
    report.total_bound += report.row_bounds(i);
    report.largest_row_bound = std::max(report.largest_row_bound, report.row_bounds(i));
    const auto k = static_cast<std::size_t>(i);
    report.outlooks.push_back(outlook(mesh, k, report.row_sums(i), report.row_bounds(i)));
    enter(report, k);
  }
  return report;
}

}  // namespace etendue
