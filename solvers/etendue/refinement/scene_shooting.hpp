// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "etendue/refinement/patch_factors.hpp"

// Progressive refinement over a scene, three channels at once: patches shoot, elements receive.
//                                                                                     @eq IU.6.6, IU.6-13, IU.6.7.1
namespace etendue {

/// The light of a run: E of each patch [W/m²].
using Emissions = std::vector<Rgb>;
/// What the materials emit.
[[nodiscard]] Emissions emissions_of(const Scene& scene, const PatchModel& model);

/// All that shooting remembers between two steps: 24 bytes an element and 24 a patch.                      @eq IU.6.6
struct SceneShooting {
  std::vector<Rgb> irradiance;  ///< H_q [W/m²]: what element q has received so far; B_q = E_q + ρ_q H_q
  std::vector<Rgb> unshot;      ///< ΔB_j [W/m²] of each patch: the mean of what its elements have not shot
  Rgb emitted = Rgb::Zero();    ///< [W]
  Rgb absorbed = Rgb::Zero();   ///< [W] so far: Σ (1 − ρ_q) A_q H_q
  Rgb escaped = Rgb::Zero();    ///< [W] so far: what met no front
  std::size_t steps = 0;
  std::vector<std::size_t> shooters;  ///< of each step
  std::vector<double> unshot_shares;  ///< before the first step and after each: unshot_share()
};

/// Before the first step everything that is emitted is unshot.
[[nodiscard]] SceneShooting before_shooting(const PatchModel& model, const Emissions& emissions);

/// B_q = E_q + ρ_q H_q of each element.                                                              @eq IU.6-16
[[nodiscard]] std::vector<Rgb> radiosities(const Scene& scene, const PatchModel& model, const Emissions& emissions,
                                           const SceneShooting& state);

/// Σ_j |ΔB_j| A_j over all patches [W].
[[nodiscard]] Rgb unshot_power(const PatchModel& model, const SceneShooting& state);
/// Of all channels together, as a share of what is emitted; 0 where nothing is emitted.            @eq IU.6.6, E26
[[nodiscard]] double unshot_share(const PatchModel& model, const SceneShooting& state);

/// The patch with the largest |ΔB_j| A_j, summed over the channels; the first of equals.              @eq IU.6-13
[[nodiscard]] std::size_t brightest_unshot(const PatchModel& model, const SceneShooting& state);

/// How a patch shoots.
enum class ShotRule {
  unshot,     ///< what it has not shot: ΔB_j                                                        @eq IU.6-13
  overshoot,  ///< and part of what it will yet receive, by overshot()
};

/// What to shoot from a patch, one channel: ΔB_j and an advance on what it is still to receive, estimated by the ambient
/// term. What is shot in advance becomes negative unshot light.
///
///     S_j = ΔB_j + min( ρ_j B_amb,  ½ ΔB_j (1 − σ_j)/(1 + σ_j) )        ΔB_j > 0;  else  S_j = ΔB_j
///
/// Symbols   ambient ρ_j B_amb [W/m²]; seen_reflectance σ_j = Σ_q F_jq ρ_q: what comes back from what it sees
/// Returns   S_j; the cap makes Σ |ΔB| A fall in every step, by at least half of what a shot of ΔB_j alone takes away
///           (NOTES.md §3), so it converges to the same solution
/// Source    Feda and Purgathofer 1992 for the amount; the cap is ours
[[nodiscard]] double overshot(double unshot, double ambient, double seen_reflectance);

/// One step: patch j shoots S_j.
///
///     H_q += S_j F_jq A_j/A_q,   ΔB_i += ρ_i Σ_{q in i} S_j F_jq A_j/A_i,   ΔB_j −= S_j      @eq IU.6-12, IU.6-13, IU.6-17
///
/// Symbols   column F_jq from j, in the order of the elements
/// Accuracy  emitted = absorbed + escaped + Σ ΔB_j A_j holds after every step up to the rounding of the sums; a sum of
///           the F_jq above one (rounding) counts as one
void shoot(SceneShooting& state, const Scene& scene, const PatchModel& model, std::size_t patch,
           const std::vector<SeenShare>& column, ShotRule rule = ShotRule::unshot);

/// When to stop.
struct SceneShootingGoal {
  double unshot_share = 1e-3;  ///< the source text's 0.1 % of the emitted power
  std::size_t most_steps = 1'000'000;
  ShotRule rule = ShotRule::unshot;
};

enum class ShootingEnd { reached, steps_used_up, stopped };

/// Shoots until the goal is met, the steps are used up, or the execution is stopped. The state is complete after every
/// step, so a run that goes on from it has the same bits as one that was never stopped. `told` is called after each step.
ShootingEnd shoot_until(SceneShooting& state, const Scene& scene, const PatchModel& model, PatchFactors& factors,
                        const SceneShootingGoal& goal, const Execution& execution = {},
                        const std::function<void(const SceneShooting&)>& told = {});

/// How far a state is from the solution of its discrete system.
struct ShootingGap {
  Rgb power = Rgb::Zero();  ///< Σ_q A_q |B_q − exact B_q| ≤ this [W]: proved for any factors with Σ_q F_jq ≤ 1
  Rgb radiosity = Rgb::Zero();  ///< |B_q − exact B_q| ≤ this [W/m²]: infinite unless PatchFactors::reciprocal()
};
/// ρ/(1 − ρ) Σ_j |ΔB_j| A_j, and ρ/(1 − ρ) max_j |ΔB_j|, ρ the largest reflectance: NOTES.md §2.
///
/// Accuracy  rounding of the state's sums not counted
[[nodiscard]] ShootingGap shooting_gap(const Scene& scene, const PatchModel& model, const SceneShooting& state,
                                       bool reciprocal);

/// B_amb of each channel, for display only.                                                    @eq IU.6-14, IU.6-15
[[nodiscard]] Rgb ambient_radiosity(const Scene& scene, const PatchModel& model, const SceneShooting& state);

/// What to show of elements: B_q + ρ_q B_amb.                                                      @eq IU.6-15, IU.f64
[[nodiscard]] std::vector<Rgb> with_ambient_term(const Scene& scene, const PatchModel& model,
                                                 const std::vector<Rgb>& radiosity, const Rgb& ambient);

}  // namespace etendue
