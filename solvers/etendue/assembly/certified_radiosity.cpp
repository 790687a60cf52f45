// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/certified_radiosity.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "etendue/assembly/scene_radiosity.hpp"
#include "etendue/assembly/schedule.hpp"
#include "etendue/core/contract.hpp"
#include "etendue/core/interval.hpp"

namespace etendue {

namespace {

struct Row {
  PairCounts pairs;
  std::size_t wide = 0;
};

void count(const EnclosedExchange& found, Row& row) {
  if (found.averted) {
    ++row.pairs.averted;
  } else if (found.obstructed) {
    ++row.pairs.obstructed;
  } else {
    ++row.pairs.clear;
  }
  row.wide += !found.factor.reached;
}

}  // namespace

CertifiedGoals certified_goals(double relative, std::size_t elements) {
  const double share = 1 / static_cast<double>(std::max<std::size_t>(1, elements));
  CertifiedGoals goals;
  goals.free.tolerance = {kCertifiedFree, kCertifiedFree * share};
  goals.obstructed = {{relative, relative * share}, kCertifiedWork};
  return goals;
}

CertifiedFactors certified_factors(const ElementMesh& mesh, const CertifiedGoals& goals, const Execution& execution) {
  const std::size_t n = mesh.elements.size();
  const auto size = static_cast<Eigen::Index>(n);
  const CertifiedExchange method(mesh, goals.free, goals.obstructed);
  CertifiedFactors result;
  result.lower = Eigen::MatrixXd::Zero(size, size);
  result.upper = Eigen::MatrixXd::Zero(size, size);
  std::vector<Row> rows(n);
  result.complete = parallel_for(n, execution, [&](std::size_t i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      const EnclosedExchange found = method.enclosed({i, j});
      count(found, rows[i]);
      const auto put = [&](std::size_t from, std::size_t to) {
        const Interval factor = found.exchange / method.area(from);
        const auto r = static_cast<Eigen::Index>(from), c = static_cast<Eigen::Index>(to);
        result.lower(r, c) = std::clamp(factor.lower, 0.0, 1.0);
        result.upper(r, c) = std::clamp(factor.upper, 0.0, 1.0);
      };
      put(i, j);
      put(j, i);
    }
  });
  for (const Row& row : rows) {
    result.pairs.averted += row.pairs.averted;
    result.pairs.clear += row.pairs.clear;
    result.pairs.obstructed += row.pairs.obstructed;
    result.wide += row.wide;
  }
  if (n > 0) {
    Eigen::Index from = 0, to = 0;
    result.widest = (result.upper - result.lower).maxCoeff(&from, &to);
    result.from = static_cast<std::size_t>(from);
    result.to = static_cast<std::size_t>(to);
  }
  return result;
}

Result<CertifiedRadiosity> solve_certified(const Scene& scene, const ElementMesh& mesh, const CertifiedFactors& factors,
                                           RadiosityGoal goal, const Execution& execution) {
  require(factors.complete, "solve_certified: all form factors are there");
  const std::size_t n = mesh.elements.size();
  CertifiedRadiosity result{std::vector<Rgb>(n, Rgb::Zero()), std::vector<Rgb>(n, Rgb::Zero()), {}, {}};
  const Schedule schedule = on_threads(execution.threads);
  const auto upper = std::make_shared<DenseFactors>(factors.upper, schedule);
  const RadiosityEquation equation = radiosity_equation(scene, mesh, upper);
  goal.may_go_on = [&execution](Eigen::Index, Eigen::Index) { return !execution.stopping(); };
  const auto enclosed =
      enclose_radiosity({std::make_shared<DenseFactors>(factors.lower, schedule), upper, equation.reflectance,
                         equation.reflectance, equation.emission, equation.emission, equation.areas, equation.channels},
                        goal);
  if (!enclosed) return enclosed.error();
  for (Eigen::Index channel = 0; channel < 3; ++channel) {
    const auto c = static_cast<std::size_t>(channel);
    for (std::size_t i = 0; i < n; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      result.lower[i](channel) = enclosed->lower(row, channel);
      result.upper[i](channel) = enclosed->upper(row, channel);
      const double width = Interval(enclosed->lower(row, channel), enclosed->upper(row, channel)).width();
      if (i == 0 || width > result.widest[c]) {
        result.widest[c] = width;
        result.worst[c] = i;
      }
    }
  }
  return result;
}

}  // namespace etendue
