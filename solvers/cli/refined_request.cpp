// SPDX-License-Identifier: Apache-2.0
#include "refined_request.hpp"

#include "etendue/text/number_text.hpp"
#include "refined_command.hpp"
#include "solve_parts.hpp"

namespace etendue::cli {

namespace {

constexpr int kMostPoints = 16;  // a side, 256 hemicubes a patch
constexpr int kMostSteps = 1'000'000'000;

void declare_method(Options& options, RefinedRequest& request) {
  options.argument("SCENE", "scene file (JSON)", request.scene);
  add_method(options, request.method);
  options.choice("--factors-by", {"hemicube", "exact"},
                 "form factors by pixels, without a bound, or by integration (default: hemicube; of adaptive exact)",
                 request.factors_by);
  options.integer("--resolution", "N", "pixels along an edge of a hemicube, even (default: 256)", request.resolution,
                  kLeastResolution, kMostResolution);
  options.integer("--points", "N", "N × N hemicubes on each patch (default: 1)", request.points, 1, kMostPoints);
  options.real("--tolerance", "T", "relative error asked of exact form factors past obstructions (default: 1e-6)",
               request.tolerance, 1e-12, 0.1);
}

void declare_shooting(Options& options, RefinedRequest& request) {
  options.real("--unshot", "X", "stop when at most this share of the emitted power is unshot (default: 0.001)",
               request.unshot, 0, 1);
  options.integer("--steps", "N", "stop after N steps (default: as many as it takes)", request.steps, 1, kMostSteps);
  options.flag("--overshoot", "patches also shoot part of what they are yet to receive; the same solution, sooner",
               request.overshoot);
  options.flag("--ambient", "add the ambient term to the pictures, for light that is still unshot", request.ambient);
  options.flag("--resume", "go on from NAME.incomplete.json or NAME.json, to the same bits as without a pause",
               request.resume);
  options.flag("--per-light", "keep one solution for each material that emits, to be relit", request.per_light);
  options.text("--relight", "LIGHTS",
               "MATERIAL=FACTOR[,…]: from NAME.json of a run with --per-light, in no time; writes NAME-relit.…\n"
               "FACTOR is a number or R:G:B; lights that are not named stay as they are",
               request.relight);
}

void declare_adaptive(Options& options, RefinedRequest& request) {
  options.choice("--solve-by", {"shooting", "elimination"}, "how adaptive solves each mesh (default: shooting)",
                 request.solve_by);
  options.real("--threshold", "T",
               "adaptive: quarter neighbours that differ by more than this share of the brightest (default: 0.1)",
               request.threshold, 1e-6, 1e6);
  options.integer("--levels", "N", "adaptive: halvings of the scene's elements (default: 3)", request.levels, 0,
                  kDeepestCell);
  options.integer("--most-elements", "N", "adaptive: stop dividing there (default: 50000)", request.most_elements, 1,
                  100'000'000);
  options.flag("--mesh", "draw the outlines of the elements into the PNG", request.draw_mesh);
}

}  // namespace

void add_method(Options& options, std::string& method) {
  options.choice(
      "--method", {"full", "hemicube", "progressive", "adaptive"},
      "full: all form factors, one solve (default). hemicube: the same, factors from pixels. progressive:\n"
      "brightest patches shoot first. adaptive: elements divided where radiosity changes; each has options of\n"
      "its own: etendue solve --method progressive --help",
      method);
}

void declare(Options& options, RefinedRequest& request) {
  declare_method(options, request);
  add_meshing(options, request);
  declare_shooting(options, request);
  declare_adaptive(options, request);
  add_sensors(options, request.sensors);
  add_extrapolation(options, request.sensors);
  add_results(options, request);
  options.elsewhere({"--solver", "--certify", "--certify-tolerance"}, "--method full");
  options.note(
      "NAME.json holds every element with its corners, radiosity and irradiance, and all that is needed to go on. "
      "Without\n"
      "--steps the goal is --unshot. With exact factors the distance from the solution of the discrete system is "
      "bounded\n"
      "for every element; with hemicubes only the power that is missing is. After Ctrl-C the solution so far is in\n"
      "NAME.incomplete.json, and the exit code is 6. Details: docs/progressive.md");
  options.example("etendue solve scenes/furnace/scene.json --method progressive --output furnace-progressive.png");
  options.example(
      "etendue solve scenes/furnace/scene.json --method hemicube --resolution 64 --output furnace-hemicube.png");
}

std::optional<std::string> contradiction(RefinedRequest& request) {
  if (request.factors_by.empty()) request.factors_by = request.adaptive() ? "exact" : "hemicube";
  if (request.method == "hemicube" && request.factors_by != "hemicube")
    return "--method hemicube has --factors-by hemicube";
  if (request.resolution % 2 != 0) return "--resolution is even: no pixel may look along an axis";
  if (request.solve_by == "elimination" && !request.adaptive()) return "--solve-by is for --method adaptive";
  if (request.eliminates() && (request.resume || request.overshoot || request.ambient || request.steps > 0)) {
    return "--resume, --overshoot, --ambient and --steps are for methods that shoot";
  }
  if (request.per_light && request.method != "progressive") return "--per-light is for --method progressive";
  if (auto wrong = contradiction(request.tone)) return wrong;
  if (request.sensors.extrapolate) return "--extrapolate is for --method full, which solves two meshes alike";
  if (request.relight && (request.resume || request.per_light)) {
    return "--relight combines a finished run: neither --resume nor --per-light";
  }
  return std::nullopt;
}

AdaptiveGoal RefinedRequest::adaptive_goal() const {
  return {threshold, adaptive() ? levels : 0, static_cast<std::size_t>(most_elements)};
}

SceneShootingGoal RefinedRequest::shooting_goal() const {
  SceneShootingGoal goal;
  goal.unshot_share = unshot;
  if (steps > 0) goal.most_steps = static_cast<std::size_t>(steps);
  goal.rule = overshoot ? ShotRule::overshoot : ShotRule::unshot;
  return goal;
}

FactorsOf RefinedRequest::factors() const {
  return [*this](const PatchModel& model) {
    AssemblyTolerance asked;
    asked.obstructed = {tolerance, tolerance * kAbsoluteShare};
    auto source = factors_by == "exact" ? exact_factors(model, asked)
                                        : hemicube_factors(model, {PixelBody::hemicube, resolution, points, false, 1});
    return remembered(std::move(source), model.patch_areas.size(), column_budget(model));
  };
}

std::string RefinedRequest::settings() const {
  std::string line = method + ", factors by " + factors_by;
  line += factors_by == "exact"
              ? " to " + shortest(tolerance)
              : " of " + std::to_string(resolution) + " pixels, " + std::to_string(points * points) + " a patch";
  if (eliminates()) line += ", by elimination";
  if (overshoot) line += ", overshooting";
  if (per_light) line += ", per light";
  if (element_size > 0) line += ", elements within " + shortest(element_size);
  if (align_mesh) line += ", aligned";
  if (adaptive()) {
    line += ", threshold " + shortest(threshold) + ", " + std::to_string(levels) + " levels, at most " +
            std::to_string(most_elements) + " elements, unshot " + shortest(unshot);
  }
  return line;
}

}  // namespace etendue::cli
