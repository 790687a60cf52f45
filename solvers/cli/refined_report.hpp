// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "etendue/io/atomic_file.hpp"
#include "etendue/io/scene_reader.hpp"
#include "etendue/view/vertex_radiosity.hpp"
#include "refined_request.hpp"
#include "solve_parts.hpp"

namespace etendue::cli {

/// One light's own solution (--per-light).
struct LightSolution {
  std::size_t material = 0;  ///< index into Scene::materials
  SceneShooting state;
};

enum class RefinedStatus { solved, steps_used_up, elements_used_up, tolerance_missed, stopped, relit };

/// Everything that `etendue solve --method hemicube|progressive|adaptive` found out.
struct RefinedReport : SolutionFiles {
  SceneFile file;
  RefinedRequest request;
  AdaptiveSolution solution;          ///< state: of all lights together
  std::vector<LightSolution> lights;  ///< with --per-light
  std::vector<Rgb> light_factors;     ///< with --relight: of each light
  std::string settings;               ///< RefinedRequest::settings() of the run that found it
  bool bounded = false;               ///< were its form factors exact ones?
  RefinedStatus status = RefinedStatus::stopped;
  ShootingGap gap;      ///< of the state; by elimination AdaptiveSolution::bound in its place
  Emissions emissions;  ///< of each patch
  std::vector<Rgb> radiosity;
  Rgb ambient = Rgb::Zero();            ///< B_amb, shown with --ambient
  std::vector<std::size_t> covered;     ///< elements that see no front
  std::optional<SensorReport> sensors;  ///< asked for by --sensors, and measured once all is solved
  VertexRadiosities vertices;
  double exposure = 0;
  double seconds = 0;
};

[[nodiscard]] const char* words(RefinedStatus status);

/// The summary as a machine reads it, and as a person does.
[[nodiscard]] std::string summary_json(const RefinedReport& report);
void print_summary(std::ostream& out, const RefinedReport& report);

/// Writes summary, patches and elements, all that is needed to go on: docs/progressive.md. Piece by piece: no second copy
/// of the elements is held. Equal results are equal bytes.
[[nodiscard]] Result<Done> write_solution(const std::filesystem::path& path, const RefinedReport& report);

/// Takes cells, received and unshot light from such a file into a report that has scene, request, and the solution as it
/// begins (of per-light runs, lights as they begin).
///
/// Errors    invalid_input: no such file's content; another scene; `same_settings` and other settings; a solution that
///           was relit
[[nodiscard]] Result<Done> read_solution(const std::filesystem::path& path, RefinedReport& report, bool same_settings);

/// "MATERIAL=FACTOR[,…]" into a factor for each light of the report; one where it is not named.
[[nodiscard]] Result<std::vector<Rgb>> light_factors(const std::string& text, const RefinedReport& report);

}  // namespace etendue::cli
