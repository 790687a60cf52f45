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
  RadiosityEquation equation{
      std::move(factors), Eigen::MatrixXd(n, 3), Eigen::MatrixXd(n, 3), Eigen::VectorXd(n), {"red", "green", "blue"}};
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

RadiosityEquation only_channel(const RadiosityEquation& all, Eigen::Index c) {
  return {
      all.factors, all.reflectance.col(c), all.emission.col(c), all.areas, {all.channels[static_cast<std::size_t>(c)]}};
}

/// Enters what was solved: channels `first` to the last of `report`.
void enter(SceneRadiosity& result, const RadiosityEquation& equation, const RadiosityReport& report, std::size_t first,
           const FormFactors& errors) {
  const RadiosityJudge judge(equation, row_sums(*equation.factors));
  const Eigen::VectorXd with_factors = judge.bound_with(errors, report.radiosity, judge.judge(report.radiosity));
  for (Eigen::Index c = 0; c < report.radiosity.cols(); ++c) {
    const std::size_t channel = first + static_cast<std::size_t>(c);
    for (std::size_t i = 0; i < result.radiosity.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(channel);
      result.radiosity[i](column) = report.radiosity(row, c);
      result.irradiance[i](column) = report.incident(row, c);
    }
    result.channels[channel] = {
        {report.radiosity.col(c), report.residual(c), report.bound(c), report.backward_error(c)},
        with_factors(c),
        power_balance(equation, report, c)};
  }
  result.status = report.status;
  result.steps = report.steps;
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
    auto report = solve_radiosity(parts == 1 ? equation : only_channel(equation, part), own);
    if (!report && report.error().code != ErrorCode::stopped) return report.error();
    if (!report || report->status == RadiosityStatus::stopped) break;
    solved.push_back(std::move(report).value());
  }
  const DenseFactors errors(matrix.bounds, schedule);
  for (std::size_t part = 0; part < solved.size(); ++part) {
    const RadiosityEquation own = parts == 1 ? equation : only_channel(equation, static_cast<Eigen::Index>(part));
    enter(result, own, solved[part], part, errors);
  }
  if (solved.size() < static_cast<std::size_t>(parts)) return partial(std::move(result), solved.size());
  return result;
}

}  // namespace etendue
