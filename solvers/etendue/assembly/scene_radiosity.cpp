// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/scene_radiosity.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "etendue/radiosity/certificate.hpp"

namespace etendue {

RadiositySystem radiosity_system(const Scene& scene, const ElementMesh& mesh, const Eigen::MatrixXd& form_factors,
                                 Eigen::Index channel) {
  const auto n = static_cast<Eigen::Index>(mesh.elements.size());
  RadiositySystem system{form_factors, Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const Element& element = mesh.elements[static_cast<std::size_t>(i)];
    const Material& material = scene.materials[mesh.face_of(element).material];
    system.reflectance(i) = material.rho(channel);
    system.emission(i) = material.emission(channel);
  }
  return system;
}

namespace {

SceneRadiosity partial(SceneRadiosity result, std::size_t channels) {
  result.solved = channels;
  return result;
}

}  // namespace

Result<SceneRadiosity> solve_scene_radiosity(const Scene& scene, const ElementMesh& mesh,
                                             const FormFactorMatrix& matrix, DirectSolver solver,
                                             const Execution& execution) {
  require(matrix.complete, "solve_scene_radiosity: all form factors are there");
  static constexpr const char* kChannels[] = {"red", "green", "blue"};
  const std::size_t n = mesh.elements.size();
  Eigen::VectorXd areas(static_cast<Eigen::Index>(n));
  const double square_metres = scene.metres_per_unit * scene.metres_per_unit;
  for (std::size_t i = 0; i < n; ++i) {
    areas(static_cast<Eigen::Index>(i)) = mesh.elements[i].polygon.area() * square_metres;
  }
  // The factors may exceed 1 by as much as they were computed to.
  const double factor_error = std::max(Tolerance{}.relative, n > 0 ? matrix.bounds.maxCoeff() : 0);
  SceneRadiosity result{std::vector<Rgb>(n, Rgb::Zero()), {}};
  const auto stopped = [&execution] { return execution.stop && *execution.stop; };
  for (Eigen::Index channel = 0; channel < 3; ++channel) {
    const auto c = static_cast<std::size_t>(channel);
    if (stopped()) return partial(std::move(result), c);
    const RadiositySystem system = radiosity_system(scene, mesh, matrix.factors, channel);
    const auto may_go_on = [&](Eigen::Index done, Eigen::Index total) {
      if (execution.progress) execution.progress(static_cast<std::size_t>(channel * total + done), 3 * n);
      return !stopped();
    };
    auto solved = solve_radiosity(system, solver, factor_error, may_go_on);
    if (!solved && solved.error().code == ErrorCode::stopped) return partial(std::move(result), c);
    if (!solved) return Error{solved.error().code, std::string(kChannels[c]) + " channel: " + solved.error().message};
    const Eigen::VectorXd& radiosity = solved->radiosity;
    for (std::size_t i = 0; i < n; ++i) result.radiosity[i](channel) = radiosity(static_cast<Eigen::Index>(i));
    const double with_factors = residual_bound(system, radiosity, matrix.bounds).bound;
    const PowerBalance balance = power_balance(system, areas, radiosity);
    result.channels[c] = {std::move(solved).value(), with_factors, balance};
  }
  return result;
}

}  // namespace etendue
