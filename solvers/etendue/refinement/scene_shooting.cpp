// SPDX-License-Identifier: Apache-2.0
#include "etendue/refinement/scene_shooting.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "etendue/radiosity/ambient_term.hpp"

namespace etendue {

namespace {

const Rgb& reflectance(const Scene& scene, const PatchModel& model, std::size_t patch) {
  return model.material_of(scene, patch).rho;
}

Eigen::VectorXd as_vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

Eigen::VectorXd channel_of(const std::vector<Rgb>& values, Eigen::Index channel) {
  Eigen::VectorXd one(static_cast<Eigen::Index>(values.size()));
  for (std::size_t k = 0; k < values.size(); ++k) one(static_cast<Eigen::Index>(k)) = values[k](channel);
  return one;
}

Eigen::VectorXd reflectances(const Scene& scene, const PatchModel& model, Eigen::Index channel) {
  Eigen::VectorXd one(static_cast<Eigen::Index>(model.materials.size()));
  for (std::size_t k = 0; k < model.materials.size(); ++k) {
    one(static_cast<Eigen::Index>(k)) = reflectance(scene, model, k)(channel);
  }
  return one;
}

/// What patch j shoots of each channel.
Rgb shot(const SceneShooting& state, const Scene& scene, const PatchModel& model, std::size_t patch,
         const std::vector<SeenShare>& column, ShotRule rule) {
  Rgb amount = state.unshot[patch];
  if (rule == ShotRule::unshot) return amount;
  const Rgb ambient = reflectance(scene, model, patch) * ambient_radiosity(scene, model, state);
  Rgb seen = Rgb::Zero();
  for (const SeenShare& share : column) seen += share.factor * reflectance(scene, model, model.patch_of(share.element));
  for (Eigen::Index c = 0; c < 3; ++c) amount(c) = overshot(amount(c), ambient(c), seen(c));
  return amount;
}

}  // namespace

Emissions emissions_of(const Scene& scene, const PatchModel& model) {
  Emissions emissions;
  for (const std::size_t material : model.materials) emissions.push_back(scene.materials[material].emission);
  return emissions;
}

SceneShooting before_shooting(const PatchModel& model, const Emissions& emissions) {
  require(emissions.size() == model.patch_areas.size(), "before_shooting: one emission a patch");
  SceneShooting state;
  state.irradiance.assign(model.elements.elements.size(), Rgb::Zero());
  state.unshot = emissions;
  for (std::size_t j = 0; j < emissions.size(); ++j) state.emitted += emissions[j] * model.patch_areas[j];
  state.unshot_shares.push_back(unshot_share(model, state));
  return state;
}

std::vector<Rgb> radiosities(const Scene& scene, const PatchModel& model, const Emissions& emissions,
                             const SceneShooting& state) {
  std::vector<Rgb> values;
  values.reserve(state.irradiance.size());
  for (std::size_t q = 0; q < state.irradiance.size(); ++q) {
    const std::size_t patch = model.patch_of(q);
    values.push_back(emissions[patch] + reflectance(scene, model, patch) * state.irradiance[q]);
  }
  return values;
}

Rgb unshot_power(const PatchModel& model, const SceneShooting& state) {
  Rgb sum = Rgb::Zero();
  for (std::size_t j = 0; j < state.unshot.size(); ++j) sum += state.unshot[j].abs() * model.patch_areas[j];
  return sum;
}

double unshot_share(const PatchModel& model, const SceneShooting& state) {
  const Rgb unshot = unshot_power(model, state);
  const double emitted = state.emitted(0) + state.emitted(1) + state.emitted(2);
  return emitted > 0 ? (unshot(0) + unshot(1) + unshot(2)) / emitted : 0;
}

std::size_t brightest_unshot(const PatchModel& model, const SceneShooting& state) {
  std::size_t best = 0;
  double most = -1;
  for (std::size_t j = 0; j < state.unshot.size(); ++j) {
    const Rgb amount = state.unshot[j].abs();
    const double power = (amount(0) + amount(1) + amount(2)) * model.patch_areas[j];
    if (power > most) {
      most = power;
      best = j;
    }
  }
  return best;
}

double overshot(double unshot, double ambient, double seen_reflectance) {
  constexpr double kCap = 0.5;
  if (!(unshot > 0)) return unshot;
  const double most = kCap * unshot * (1 - seen_reflectance) / (1 + seen_reflectance);
  return unshot + std::max(0.0, std::min(ambient, most));
}

void shoot(SceneShooting& state, const Scene& scene, const PatchModel& model, std::size_t patch,
           const std::vector<SeenShare>& column, ShotRule rule) {
  require(patch < state.unshot.size(), "shoot: the patch exists");
  const Rgb amount = shot(state, scene, model, patch, column, rule);
  const Rgb power = amount * model.patch_areas[patch];
  state.unshot[patch] -= amount;
  double seen = 0;
  for (const SeenShare& share : column) {
    const std::size_t receiver = model.patch_of(share.element);
    const Rgb arrived = power * share.factor;
    const Rgb& rho = reflectance(scene, model, receiver);
    state.irradiance[share.element] += arrived / model.element_areas[share.element];
    state.unshot[receiver] += rho * arrived / model.patch_areas[receiver];
    state.absorbed += (1 - rho) * arrived;
    seen += share.factor;
  }
  state.escaped += power * std::max(0.0, 1 - seen);
  ++state.steps;
  state.shooters.push_back(patch);
  state.unshot_shares.push_back(unshot_share(model, state));
}

ShootingEnd shoot_until(SceneShooting& state, const Scene& scene, const PatchModel& model, PatchFactors& factors,
                        const SceneShootingGoal& goal, const Execution& execution,
                        const std::function<void(const SceneShooting&)>& told) {
  while (state.unshot_shares.back() > goal.unshot_share) {
    if (state.steps >= goal.most_steps) return ShootingEnd::steps_used_up;
    if (execution.stopping()) return ShootingEnd::stopped;
    const std::size_t patch = brightest_unshot(model, state);
    const std::vector<SeenShare> column = factors.from_patch(patch, execution);
    if (column.empty() && execution.stopping()) return ShootingEnd::stopped;
    shoot(state, scene, model, patch, column, goal.rule);
    if (told) told(state);
  }
  return ShootingEnd::reached;
}

ShootingGap shooting_gap(const Scene& scene, const PatchModel& model, const SceneShooting& state, bool reciprocal) {
  Rgb largest = Rgb::Zero(), brightest = Rgb::Zero();
  for (std::size_t j = 0; j < state.unshot.size(); ++j) {
    largest = largest.max(reflectance(scene, model, j));
    brightest = brightest.max(state.unshot[j].abs());
  }
  const Rgb share = largest / (1 - largest);
  ShootingGap gap{share * unshot_power(model, state), share * brightest};
  if (!reciprocal) gap.radiosity = Rgb::Constant(std::numeric_limits<double>::infinity());
  return gap;
}

Rgb ambient_radiosity(const Scene& scene, const PatchModel& model, const SceneShooting& state) {
  const Eigen::VectorXd areas = as_vector(model.patch_areas);
  Rgb ambient;
  for (Eigen::Index c = 0; c < 3; ++c) {
    ambient(c) = ambient_radiosity(channel_of(state.unshot, c), reflectances(scene, model, c), areas);
  }
  return ambient;
}

std::vector<Rgb> with_ambient_term(const Scene& scene, const PatchModel& model, const std::vector<Rgb>& radiosity,
                                   const Rgb& ambient) {
  std::vector<Rgb> shown;
  for (std::size_t q = 0; q < radiosity.size(); ++q) {
    shown.push_back(radiosity[q] + reflectance(scene, model, model.patch_of(q)) * ambient);
  }
  return shown;
}

}  // namespace etendue
