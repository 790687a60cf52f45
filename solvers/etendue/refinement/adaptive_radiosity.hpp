// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "etendue/radiosity/system.hpp"
#include "etendue/refinement/adaptive_mesh.hpp"
#include "etendue/refinement/scene_shooting.hpp"

// Adaptive subdivision: solve, quarter the elements across which the radiosity changes too much, carry on.
//                                                                                       @eq IU.6.7.2, IU.f65
namespace etendue {

struct AdaptiveGoal {
  double difference =
      0.1;              ///< between neighbours, in any channel, as a share of the brightest element that does not emit
  int most_levels = 3;  ///< halvings of the elements of the scene file
  std::size_t most_elements = 50'000;
};

/// The elements to be quartered: of two neighbours on a face whose radiosities differ too much the larger one, or both if they
/// are of one size, as far as the goal's levels allow.
[[nodiscard]] std::vector<bool> too_steep(const AdaptiveMesh& mesh, const Scene& scene,
                                          const std::vector<Rgb>& radiosity, const AdaptiveGoal& goal);

struct AdaptiveRound {
  std::size_t elements = 0;
  std::size_t steps = 0;  ///< shots so far; of the full method the rounds so far
  double unshot_share = 0;
};

/// Patches, elements of different sizes, and what they have received.
struct AdaptiveSolution {
  AdaptiveMesh mesh;
  PatchModel model;
  SceneShooting state;
  std::vector<AdaptiveRound> rounds;  ///< those that are solved
  bool complete = false;              ///< false: stopped, or steps used up
  bool truncated = false;             ///< most_elements kept elements from being quartered
  std::size_t missed = 0;             ///< PatchFactors::missed()
  Rgb bound = Rgb::Zero();            ///< by elimination: of the discrete system, as RadiositySolution::bound
};

/// Called with what there is so far: after every shot, or after every elimination.
using Told = std::function<void(const AdaptiveSolution&)>;

/// Makes the factors of a model; the model outlives them.
using FactorsOf = std::function<std::unique_ptr<PatchFactors>(const PatchModel&)>;

enum class Beginning {
  as_divided,      ///< the elements of the scene
  halved_singles,  ///< single elements of a quadrilateral quartered, as figure 61 has it: with_halved_singles()
};
/// Nothing shot yet.
[[nodiscard]] Result<AdaptiveSolution> before_adapting(const Scene& scene, const PatchModel& model,
                                                       Beginning beginning);

/// Shoots to the goal, quarters, takes what every patch has shot so far to the new elements by its factors to them, and
/// goes on; until nothing is too steep. In each round every patch that shone looks at the elements anew.
///
///     H_q = Σ_j S_j F_jq A_j/A_q,   ΔB_j = (1/A_j) Σ_q A_q (E_q + ρ_q H_q) − S_j       S_j: shot in all rounds before
///
/// Returns   where it ends, or is stopped: going on from there has the same bits as never having stopped
/// Errors    elements that cannot be divided any further
[[nodiscard]] Result<AdaptiveSolution> adapt_by_shooting(const Scene& scene, AdaptiveSolution solution,
                                                         const FactorsOf& factors_of, const AdaptiveGoal& goal,
                                                         const SceneShootingGoal& shooting,
                                                         const Execution& execution = {}, const Told& told = {});

/// The full method: patches are solved directly (6-18, with form factors as in 6-19), elements gather from them (6-16),
/// and only the factors of new elements are computed. Memory: elements × patches.
///
/// Returns   state.irradiance by 6-16; nothing is unshot when it is complete. Stopped: the last mesh that was solved
/// Errors    as above, and those of solve_radiosity()
[[nodiscard]] Result<AdaptiveSolution> adapt_by_elimination(const Scene& scene, AdaptiveSolution solution,
                                                            const FactorsOf& factors_of, const AdaptiveGoal& goal,
                                                            const Execution& execution = {}, const Told& told = {});

}  // namespace etendue
