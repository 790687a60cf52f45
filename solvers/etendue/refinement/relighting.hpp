// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "etendue/refinement/scene_shooting.hpp"

// Lights switched on and off without new form factors: B is linear in E.                                    @eq IU.6-7
namespace etendue {

/// The materials of patches that emit, each a light of its own; indices into Scene::materials, rising.
[[nodiscard]] std::vector<std::size_t> emitting_materials(const Scene& scene, const PatchModel& model);

/// What one material emits, all others dark.
[[nodiscard]] Emissions emissions_of(const Scene& scene, const PatchModel& model, std::size_t material);

/// One light's solution, and what becomes of it.
struct LightShare {
  const SceneShooting* state;
  Rgb factor;  ///< of its emission, each channel; not negative
};

/// Σ_l f_l H_l, Σ_l f_l ΔB_l …: the state of the scene with every light's emission multiplied by its factor.
///
/// Returns   a state whose gap is at most the sum of f_l times the gaps
/// Errors    ContractViolation where states are of different models, or there is none
[[nodiscard]] SceneShooting relit(const PatchModel& model, const std::vector<LightShare>& lights);

/// The emissions that go with it.
[[nodiscard]] Emissions relit(const std::vector<Emissions>& emissions, const std::vector<Rgb>& factors);

}  // namespace etendue
