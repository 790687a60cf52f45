// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/scene_radiosity.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "etendue/assembly/schedule.hpp"
#include "etendue/radiosity/certificate.hpp"

namespace etendue {

RadiosityEquation radiosity_equation(const Scene& scene, const ElementMesh& mesh,
                                     std::shared_ptr<const FormFactors> factors) {
  const auto n = static_cast<Eigen::Index>(mesh.elements.size());
  RadiosityEquation equation{std::move(factors),
                             Eigen::MatrixXd(n, 3),
                             Eigen::MatrixXd(n, 3),
                             Eigen::VectorXd(n),
                             {"red channel", "green channel", "blue channel"}};
  const double square_metres = scene.metres_per_unit * scene.metres_per_unit;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Element& element = mesh.elements[static_cast<std::size_t>(i)];
    const Material& material = scene.materials[mesh.face_of(element).material];
    for (Eigen::Index c = 0; c < 3; ++c) {
      equation.reflectance(i, c) = material.rho(c);
      equation.emission(i, c) = material.emission(c);
    }
    equation.areas(i) = element.polygon.area() * square_metres;
  }
  return equation;
}

namespace {

RadiosityEquation only_channels(const RadiosityEquation& all, Eigen::Index first, Eigen::Index count) {
  const auto begin = all.channels.begin() + first;
  return {all.factors,
          all.reflectance.middleCols(first, count),
          all.emission.middleCols(first, count),
          all.areas,
          {begin, begin + count}};
}

/// Enters what was solved, one report after the other: of one channel each, or of all. Judged together, in one pass over F.
void enter(SceneRadiosity& result, const RadiosityEquation& all, const std::vector<RadiosityReport>& reports,
           const FormFactors& errors) {
  Eigen::Index count = 0;
  for (const RadiosityReport& report : reports) count += report.radiosity.cols();
  const RadiosityEquation equation = only_channels(all, 0, count);
  Eigen::MatrixXd radiosity(all.emission.rows(), count);
  Eigen::Index first = 0;
  for (const RadiosityReport& report : reports) {
    radiosity.middleCols(first, report.radiosity.cols()) = report.radiosity;
    first += report.radiosity.cols();
  }
  const RadiosityJudge judge(equation, row_sums(*equation.factors));
  const Eigen::VectorXd with_factors = judge.bound_with(errors, radiosity, judge.judge(radiosity));
  Eigen::Index channel = 0;
  for (const RadiosityReport& report : reports) {
    const RadiosityEquation own = only_channels(all, channel, report.radiosity.cols());
    for (Eigen::Index c = 0; c < report.radiosity.cols(); ++c, ++channel) {
      for (std::size_t i = 0; i < result.radiosity.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        result.radiosity[i](channel) = report.radiosity(row, c);
        result.irradiance[i](channel) = report.incident(row, c);
      }
      result.channels[static_cast<std::size_t>(channel)] = {
          {report.radiosity.col(c), report.residual(c), report.bound(c), report.backward_error(c)},
          with_factors(channel),
          power_balance(own, report, c)};
    }
    result.status = report.status;
    result.steps = report.steps;
  }
}

SceneRadiosity partial(SceneRadiosity result, std::size_t channels) {
  result.solved = channels;
  return result;
}

}  // namespace

Result<SceneRadiosity> solve_scene_radiosity(const Scene& scene, const ElementMesh& mesh,
                                             const FormFactorMatrix& matrix, const RadiosityGoal& goal,
                                             const Execution& execution) {
  require(matrix.complete, "solve_scene_radiosity: all form factors are there");
  const std::size_t n = mesh.elements.size();
  const Schedule schedule = on_threads(execution.threads);
  const RadiosityEquation equation =
      radiosity_equation(scene, mesh, std::make_shared<DenseFactors>(matrix.factors, schedule));
  SceneRadiosity result;
  result.radiosity.assign(n, Rgb::Zero());
  result.irradiance.assign(n, Rgb::Zero());
  // One channel at a time where a solver has nothing to share, so that those that are done are kept when it stops.
  const Eigen::Index parts = is_direct(goal.solver) ? 3 : 1;
  std::vector<RadiosityReport> solved;
  for (Eigen::Index part = 0; part < parts; ++part) {
    RadiosityGoal own = goal;
    // The factors may exceed 1 by as much as they were computed to.
    own.rules.factor_error = std::max(Tolerance{}.relative, n > 0 ? matrix.bounds.maxCoeff() : 0);
    own.may_go_on = [&execution, part, parts](Eigen::Index done, Eigen::Index total) {
      if (execution.progress) {
        execution.progress(static_cast<std::size_t>(part * total + done), static_cast<std::size_t>(parts * total));
      }
      return !execution.stopping();
    };
    auto report = solve_radiosity(parts == 1 ? equation : only_channels(equation, part, 1), own);
    if (!report && report.error().code != ErrorCode::stopped) return report.error();
    if (!report || report->status == RadiosityStatus::stopped) break;
    solved.push_back(std::move(report).value());
  }
  const DenseFactors errors(matrix.bounds, schedule);
  if (!solved.empty()) enter(result, equation, solved, errors);
  if (solved.size() < static_cast<std::size_t>(parts)) return partial(std::move(result), solved.size());
  return result;
}

}  // namespace etendue
