// SPDX-License-Identifier: Apache-2.0
#include "etendue/refinement/adaptive_radiosity.hpp"

#include <algorithm>
#include <utility>

#include "etendue/radiosity/substructuring.hpp"

namespace etendue {

namespace {

double white(const Scene& scene, const AdaptiveMesh& mesh, const std::vector<Rgb>& radiosity) {
  double most = 0;
  for (std::size_t k = 0; k < mesh.cells.size(); ++k) {
    const Material& material = scene.materials[mesh.faces[mesh.cells[k].face].material];
    if (!(material.emission > 0).any()) most = std::max(most, radiosity[k].maxCoeff());
  }
  return most;
}

/// What every patch has shot so far: its mean radiosity less what it has not shot.
std::vector<Rgb> shot_so_far(const Scene& scene, const AdaptiveSolution& solution) {
  const PatchModel& model = solution.model;
  const std::vector<Rgb> radiosity = radiosities(scene, model, emissions_of(scene, model), solution.state);
  std::vector<Rgb> shot(model.patch_areas.size(), Rgb::Zero());
  for (std::size_t q = 0; q < radiosity.size(); ++q) shot[model.patch_of(q)] += radiosity[q] * model.element_areas[q];
  for (std::size_t j = 0; j < shot.size(); ++j) shot[j] = shot[j] / model.patch_areas[j] - solution.state.unshot[j];
  return shot;
}

/// The state on new elements after every patch has shot what it shot on the old ones; false when stopped.
bool take_over(const Scene& scene, const std::vector<Rgb>& shot, const SceneShooting& before, PatchFactors& factors,
               const PatchModel& model, const Execution& execution, SceneShooting& state) {
  state = before_shooting(model, emissions_of(scene, model));
  for (std::size_t j = 0; j < shot.size(); ++j) {
    if ((shot[j] == 0).all()) continue;
    if (execution.stopping()) return false;
    const std::vector<SeenShare> column = factors.from_patch(j, execution);
    if (column.empty() && execution.stopping()) return false;
    const Rgb received = state.unshot[j];
    state.unshot[j] = shot[j];  // what the step takes for unshot, it shoots
    shoot(state, scene, model, j, column);
    state.unshot[j] += received - shot[j];
  }
  state.steps = before.steps;
  state.shooters = before.shooters;
  state.unshot_shares = before.unshot_shares;
  state.unshot_shares.back() = unshot_share(model, state);
  return true;
}

Result<AdaptiveSolution> quartered(const Scene& scene, const AdaptiveSolution& solution, SplitMesh parts) {
  auto elements = elements_of(parts.mesh);
  if (!elements) return elements.error();
  AdaptiveSolution next;
  next.mesh = std::move(parts.mesh);
  next.model = with_elements(solution.model, scene, std::move(elements).value());
  next.rounds = solution.rounds;
  return next;
}

/// Quarters what is too steep; nothing where there is none, or no more is allowed.
SplitMesh next_mesh(const Scene& scene, AdaptiveSolution& solution, const AdaptiveGoal& goal) {
  const auto radiosity = radiosities(scene, solution.model, emissions_of(scene, solution.model), solution.state);
  SplitMesh parts = split(solution.mesh, too_steep(solution.mesh, scene, radiosity, goal));
  solution.truncated = parts.mesh.cells.size() > goal.most_elements;
  if (solution.truncated) parts.mesh = solution.mesh;
  return parts;
}

/// Rows F_qj of all elements; those of elements that stay are taken over. False when stopped.
bool gather_rows(PatchFactors& factors, const PatchModel& model, const std::vector<std::ptrdiff_t>& kept,
                 const Eigen::MatrixXd& before, const Execution& execution, Eigen::MatrixXd& rows) {
  rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(model.element_areas.size()),
                               static_cast<Eigen::Index>(model.patch_areas.size()));
  return parallel_for(model.element_areas.size(), execution, [&](std::size_t q) {
    const auto row = static_cast<Eigen::Index>(q);
    if (kept[q] >= 0) {
      rows.row(row) = before.row(kept[q]);
      return;
    }
    for (const SeenShare& share : factors.from_element(q)) {
      rows(row, static_cast<Eigen::Index>(share.element)) = share.factor;
    }
  });
}

Substructure substructure_of(const PatchModel& model) {
  Substructure parts;
  for (const Element& element : model.elements.elements) {
    parts.patch_of.push_back(static_cast<Eigen::Index>(element.patch));
  }
  parts.element_areas = Eigen::Map<const Eigen::VectorXd>(model.element_areas.data(),
                                                          static_cast<Eigen::Index>(model.element_areas.size()));
  parts.patches = static_cast<Eigen::Index>(model.patch_areas.size());
  return parts;
}

/// Solves the patches and gathers to the elements, one channel.
Result<Done> solve_channel(const Scene& scene, AdaptiveSolution& solution, const Eigen::MatrixXd& rows,
                           const Eigen::MatrixXd& factors, Eigen::Index channel, const MayGoOn& may_go_on) {
  const PatchModel& model = solution.model;
  const auto n = static_cast<Eigen::Index>(model.patch_areas.size());
  RadiositySystem system{factors, Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index j = 0; j < n; ++j) {
    const Material& material = model.material_of(scene, static_cast<std::size_t>(j));
    system.reflectance(j) = material.rho(channel);
    system.emission(j) = material.emission(channel);
  }
  // A row of one element is a share of power up to what its factors were asked for; a hemicube's is exact in that.
  constexpr double kFactorError = 1e-3;
  const auto solved = solve_radiosity(system, RadiositySolver::gaussian_elimination, kFactorError, may_go_on);
  if (!solved) return solved.error();
  solution.bound(channel) = solved->bound;
  const Eigen::Index m = rows.rows();
  const Eigen::VectorXd irradiance =
      element_radiosities(rows, Eigen::VectorXd::Zero(m), Eigen::VectorXd::Ones(m), solved->radiosity);
  for (Eigen::Index q = 0; q < m; ++q) {
    solution.state.irradiance[static_cast<std::size_t>(q)](channel) = irradiance(q);
  }
  return Done{};
}

/// Where the power goes once nothing is unshot.
void balance(const Scene& scene, AdaptiveSolution& solution) {
  const PatchModel& model = solution.model;
  SceneShooting& state = solution.state;
  state.absorbed = Rgb::Zero();
  Rgb left = Rgb::Zero();  // leaves the surfaces, and arrives or escapes
  const std::vector<Rgb> radiosity = radiosities(scene, model, emissions_of(scene, model), state);
  Rgb arrived = Rgb::Zero();
  for (std::size_t q = 0; q < radiosity.size(); ++q) {
    const Rgb& rho = model.material_of(scene, model.patch_of(q)).rho;
    state.absorbed += (1 - rho) * state.irradiance[q] * model.element_areas[q];
    left += radiosity[q] * model.element_areas[q];
    arrived += state.irradiance[q] * model.element_areas[q];
  }
  state.escaped = left - arrived;
  std::fill(state.unshot.begin(), state.unshot.end(), Rgb::Zero());
  state.unshot_shares.push_back(0);
}

/// All channels of a mesh whose rows are there.
Result<Done> solve_patches(const Scene& scene, AdaptiveSolution& solution, const Eigen::MatrixXd& rows,
                           const Execution& execution) {
  const Eigen::MatrixXd between_patches = patch_form_factors(substructure_of(solution.model), rows);
  const auto may_go_on = [&](Eigen::Index, Eigen::Index) { return !execution.stopping(); };
  solution.state.irradiance.assign(solution.model.element_areas.size(), Rgb::Zero());
  for (Eigen::Index channel = 0; channel < 3; ++channel) {
    const auto done = solve_channel(scene, solution, rows, between_patches, channel, may_go_on);
    if (!done) return done;
  }
  balance(scene, solution);
  return Done{};
}

}  // namespace

std::vector<bool> too_steep(const AdaptiveMesh& mesh, const Scene& scene, const std::vector<Rgb>& radiosity,
                            const AdaptiveGoal& goal) {
  require(radiosity.size() == mesh.cells.size(), "too_steep: one radiosity a cell");
  std::vector<bool> steep(mesh.cells.size(), false);
  const double limit = goal.difference * white(scene, mesh, radiosity);
  for (const auto& [first, second] : neighbours(mesh)) {
    if (!((radiosity[first] - radiosity[second]).abs() > limit).any()) continue;
    // Of two sizes the larger: what it hides may be all there is.
    const std::int64_t level = std::min(mesh.cells[first].halvings(), mesh.cells[second].halvings());
    for (const std::size_t k : {first, second}) {
      steep[k] = steep[k] || (mesh.cells[k].halvings() == level && level < goal.most_levels);
    }
  }
  return steep;
}

Result<AdaptiveSolution> before_adapting(const Scene& scene, const PatchModel& model, Beginning beginning) {
  AdaptiveSolution solution;
  solution.mesh = adaptive_mesh(scene, model.elements);
  if (beginning == Beginning::halved_singles) solution.mesh = with_halved_singles(scene, solution.mesh);
  auto elements = elements_of(solution.mesh);
  if (!elements) return elements.error();
  solution.model = with_elements(model, scene, std::move(elements).value());
  solution.state = before_shooting(solution.model, emissions_of(scene, solution.model));
  return solution;
}

Result<AdaptiveSolution> adapt_by_shooting(const Scene& scene, AdaptiveSolution solution, const FactorsOf& factors_of,
                                           const AdaptiveGoal& goal, const SceneShootingGoal& shooting,
                                           const Execution& execution, const Told& told) {
  // Factors look at the model they were made of: it must not move.
  auto current = std::make_unique<AdaptiveSolution>(std::move(solution));
  auto factors = factors_of(current->model);
  while (true) {
    const auto step_done = [&](const SceneShooting&) {
      if (told) told(*current);
    };
    const ShootingEnd end =
        shoot_until(current->state, scene, current->model, *factors, shooting, execution, step_done);
    current->missed = factors->missed();
    if (end != ShootingEnd::reached) return std::move(*current);
    current->rounds.push_back({current->mesh.cells.size(), current->state.steps, current->state.unshot_shares.back()});
    SplitMesh parts = next_mesh(scene, *current, goal);
    current->complete = parts.mesh.cells.size() == current->mesh.cells.size();
    if (current->complete) return std::move(*current);
    auto next = quartered(scene, *current, std::move(parts));
    if (!next) return next.error();
    auto finer = std::make_unique<AdaptiveSolution>(std::move(next).value());
    auto finer_factors = factors_of(finer->model);
    if (!take_over(scene, shot_so_far(scene, *current), current->state, *finer_factors, finer->model, execution,
                   finer->state)) {
      current->rounds.pop_back();  // going on ends this round anew, by no further step
      return std::move(*current);
    }
    factors = std::move(finer_factors);
    current = std::move(finer);
  }
}

Result<AdaptiveSolution> adapt_by_elimination(const Scene& scene, AdaptiveSolution solution,
                                              const FactorsOf& factors_of, const AdaptiveGoal& goal,
                                              const Execution& execution, const Told& told) {
  Eigen::MatrixXd rows;
  std::vector<std::ptrdiff_t> kept(solution.mesh.cells.size(), -1);
  AdaptiveSolution current = solution;
  while (true) {
    Eigen::MatrixXd found;
    const auto factors = factors_of(current.model);
    if (!gather_rows(*factors, current.model, kept, rows, execution, found)) return solution;
    rows = std::move(found);
    const auto solved = solve_patches(scene, current, rows, execution);
    if (!solved && solved.error().code == ErrorCode::stopped) return solution;
    if (!solved) return solved.error();
    current.missed = solution.missed + factors->missed();
    current.rounds.push_back({current.mesh.cells.size(), current.rounds.size() + 1, 0});
    SplitMesh parts = next_mesh(scene, current, goal);
    current.complete = parts.mesh.cells.size() == current.mesh.cells.size();
    solution = current;
    if (told) told(solution);
    if (solution.complete) return solution;
    kept.clear();
    for (std::size_t k = 0; k < parts.mesh.cells.size(); ++k) {
      const bool same = parts.mesh.cells[k] == solution.mesh.cells[parts.parents[k]];
      kept.push_back(same ? static_cast<std::ptrdiff_t>(parts.parents[k]) : -1);
    }
    auto next = quartered(scene, solution, std::move(parts));
    if (!next) return next.error();
    current = std::move(next).value();
    current.state = solution.state;
  }
}

}  // namespace etendue
