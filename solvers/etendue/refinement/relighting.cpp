// SPDX-License-Identifier: Apache-2.0
#include "etendue/refinement/relighting.hpp"

#include <algorithm>

namespace etendue {

std::vector<std::size_t> emitting_materials(const Scene& scene, const PatchModel& model) {
  std::vector<std::size_t> lights;
  for (std::size_t k = 0; k < scene.materials.size(); ++k) {
    const bool used = std::find(model.materials.begin(), model.materials.end(), k) != model.materials.end();
    if (used && (scene.materials[k].emission > 0).any()) lights.push_back(k);
  }
  return lights;
}

Emissions emissions_of(const Scene& scene, const PatchModel& model, std::size_t material) {
  Emissions emissions;
  for (const std::size_t own : model.materials) {
    emissions.push_back(own == material ? scene.materials[own].emission : Rgb::Zero());
  }
  return emissions;
}

SceneShooting relit(const PatchModel& model, const std::vector<LightShare>& lights) {
  require(!lights.empty(), "relit: there is a light");
  SceneShooting sum;
  sum.irradiance.assign(model.element_areas.size(), Rgb::Zero());
  sum.unshot.assign(model.patch_areas.size(), Rgb::Zero());
  for (const LightShare& light : lights) {
    const SceneShooting& state = *light.state;
    require(state.irradiance.size() == sum.irradiance.size() && state.unshot.size() == sum.unshot.size(),
            "relit: solutions of one model");
    require((light.factor >= 0).all(), "relit: factors are not negative");
    for (std::size_t q = 0; q < sum.irradiance.size(); ++q) sum.irradiance[q] += light.factor * state.irradiance[q];
    for (std::size_t j = 0; j < sum.unshot.size(); ++j) sum.unshot[j] += light.factor * state.unshot[j];
    sum.emitted += light.factor * state.emitted;
    sum.absorbed += light.factor * state.absorbed;
    sum.escaped += light.factor * state.escaped;
    sum.steps += state.steps;
  }
  sum.unshot_shares.push_back(unshot_share(model, sum));
  return sum;
}

Emissions relit(const std::vector<Emissions>& emissions, const std::vector<Rgb>& factors) {
  require(!emissions.empty() && emissions.size() == factors.size(), "relit: one factor a light");
  Emissions sum(emissions.front().size(), Rgb::Zero());
  for (std::size_t l = 0; l < emissions.size(); ++l) {
    for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += factors[l] * emissions[l][j];
  }
  return sum;
}

}  // namespace etendue
