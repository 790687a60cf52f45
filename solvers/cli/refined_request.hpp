// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "etendue/refinement/adaptive_radiosity.hpp"
#include "options.hpp"
#include "solve_parts.hpp"
#include "solve_sensors.hpp"

namespace etendue::cli {

/// What `etendue solve --method hemicube|progressive|adaptive` was asked.
struct RefinedRequest : SolutionRequest {
  SensorRequest sensors;
  std::string method = "progressive";
  std::string factors_by;  ///< "hemicube" or "exact"; by default what suits the method
  std::string solve_by = "shooting";
  int resolution = 256;
  int points = 1;
  double tolerance = AssemblyTolerance{}.obstructed.relative;
  double unshot = 1e-3;
  int steps = 0;  ///< 0: as many as it takes
  double threshold = AdaptiveGoal{}.difference;
  int levels = AdaptiveGoal{}.most_levels;
  int most_elements = static_cast<int>(AdaptiveGoal{}.most_elements);
  bool overshoot = false, ambient = false, resume = false, per_light = false, draw_mesh = false;
  std::optional<std::string> relight;

  bool adaptive() const { return method == "adaptive"; }
  /// Solves the patches directly: nothing is shot.
  bool eliminates() const { return method == "hemicube" || solve_by == "elimination"; }
  AdaptiveGoal adaptive_goal() const;
  SceneShootingGoal shooting_goal() const;
  FactorsOf factors() const;
  /// One line that says by what the radiosities are found; a solution is resumed with the same only.
  std::string settings() const;
};

void declare(Options& options, RefinedRequest& request);

/// What parsing cannot see: options that contradict one another; fills in what depends on the method.
[[nodiscard]] std::optional<std::string> contradiction(RefinedRequest& request);

}  // namespace etendue::cli
