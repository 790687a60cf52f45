// SPDX-License-Identifier: Apache-2.0
#include "refined_command.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ostream>

#include "etendue/core/version.hpp"
#include "etendue/meshing/element_count.hpp"
#include "etendue/meshing/shared_vertices.hpp"
#include "etendue/meshing/surface_checks.hpp"
#include "etendue/refinement/relighting.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"
#include "etendue/view/mesh_lines.hpp"
#include "etendue/view/radiosity_view.hpp"
#include "outputs.hpp"
#include "progress.hpp"
#include "refined_report.hpp"
#include "solve_parts.hpp"
#include "stop.hpp"

namespace etendue::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "solve";

std::string suffix(const RefinedRequest& request) {
  return request.relight ? "-relit" : "";
}

fs::path named(const RefinedRequest& request, const std::string& ending) {
  return solution_path(request, suffix(request) + ending);
}

/// Where to go on from: what was interrupted, else what was finished with fewer steps or more unshot light.
fs::path earlier(const RefinedRequest& request) {
  const fs::path incomplete = solution_path(request, ".incomplete.json");
  std::error_code absent;
  if (!request.relight && fs::exists(incomplete, absent)) return incomplete;
  return solution_path(request, ".json");
}

/// Refuses what this machine cannot hold. Shooting: refinement/NOTES.md §4. Elimination: rows of element × patch twice,
/// while they grow, and of patches the matrix of one channel three times.
Result<Done> check_room(const RefinedRequest& request, std::size_t elements, std::size_t patches) {
  constexpr double kBytesAnElement = 1024;
  const auto n = static_cast<double>(elements), p = static_cast<double>(patches);
  const double dense = request.eliminates() ? 8 * p * (2 * n + 3 * p) : 0;
  return check_memory(request.scene, {n * kBytesAnElement + dense, std::to_string(elements) + " elements need",
                                      request.eliminates() ? "8 bytes for each pair of element and patch, twice"
                                                           : "about 1 kB for each element",
                                      "divide the surfaces into fewer elements (\"elements\" of the objects)"});
}

/// Scene and beginning: nothing is computed yet.
Result<RefinedReport> begun(const RefinedRequest& request) {
  RefinedReport report;
  report.request = request;
  report.settings = request.settings();
  report.bounded = request.factors_by == "exact";
  auto file = opened(request, suffix(request));
  if (!file) return file.error();
  report.file = std::move(file).value();
  const Scene& scene = report.file.scene;
  if (const auto room = check_room(request, count_elements(scene), 0); !room) return room.error();
  auto mesh = mesh_elements(scene);
  if (!mesh) return mesh.error();
  if (const auto apart = check_overlaps(scene, *mesh); !apart) return apart.error();
  auto model = patch_model(scene, std::move(mesh).value());
  if (!model) return model.error();
  auto solution =
      before_adapting(scene, *model, request.adaptive() ? Beginning::halved_singles : Beginning::as_divided);
  if (!solution) return solution.error();
  report.solution = std::move(solution).value();
  const auto room = check_room(request, report.solution.mesh.cells.size(), report.solution.mesh.patches);
  if (!room) return room.error();
  if (request.sensors.asked()) {
    auto sensors = opened_sensors(request.sensors, report.file, named(request, ".sensors.csv"));
    if (!sensors) return sensors.error();
    const FinalGather gather(report.solution.model.elements);
    if (const auto fit = check_sensors(scene, gather, sensors->sensors); !fit) return fit.error();
    report.sensors = std::move(sensors).value();
  }
  if (request.per_light || request.relight) {
    for (const std::size_t material : emitting_materials(scene, report.solution.model)) {
      report.lights.push_back(
          {material, before_shooting(report.solution.model, emissions_of(scene, report.solution.model, material))});
    }
  }
  return report;
}

/// Tells the progress of shooting on a scale on which it is even: the logarithm of what is unshot.
class ShootingProgress {
 public:
  ShootingProgress(std::ostream& err, const RefinedRequest& request)
      : progress_(err, "shooting", request.common), goal_(std::max(request.unshot, 1e-15)) {
    progress_.annotate([this](std::size_t done, std::size_t total) { return note(done, total); });
  }

  void show(const SceneShooting& state) {
    if (!progress_.visible()) return;
    steps_ = state.steps;
    unshot_ = state.unshot_shares.back();
    if (first_ < 0) first_ = unshot_;
    const double way = unshot_ > goal_ ? std::log(first_ / unshot_) / std::log(first_ / goal_) : 1;
    progress_.show(static_cast<std::size_t>(kScale * std::clamp(way, 0.0, 1.0)), kScale);
  }

 private:
  static constexpr std::size_t kScale = 1000;

  std::string note(std::size_t done, std::size_t total) const {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    std::string text = ", " + rounded(100 * unshot_, 3) + " % unshot, " + std::to_string(steps_) + " steps, " +
                       rounded(seconds, 3) + " s";
    if (done > 0 && done < total) {
      text +=
          ", about " + rounded(seconds * static_cast<double>(total - done) / static_cast<double>(done), 2) + " s left";
    }
    return text;
  }

  Progress progress_;
  double goal_, first_ = -1, unshot_ = 1;
  std::size_t steps_ = 0;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Each light for itself, one after the other; their form factors are the same.
RefinedStatus shoot_lights(RefinedReport& report, std::ostream& err) {
  const PatchModel& model = report.solution.model;
  const auto factors = report.request.factors()(model);
  RefinedStatus status = RefinedStatus::solved;
  for (LightSolution& light : report.lights) {
    ShootingProgress shown(err, report.request);
    const ShootingEnd end = shoot_until(light.state, report.file.scene, model, *factors, report.request.shooting_goal(),
                                        {report.request.common.threads, {}, &stop_requested()},
                                        [&](const SceneShooting& state) { shown.show(state); });
    if (end == ShootingEnd::steps_used_up && status == RefinedStatus::solved) status = RefinedStatus::steps_used_up;
    if (end == ShootingEnd::stopped) status = RefinedStatus::stopped;
  }
  report.solution.missed += factors->missed();
  return status;
}

RefinedStatus status_of(const AdaptiveSolution& solution) {
  if (!solution.complete) return stop_requested() ? RefinedStatus::stopped : RefinedStatus::steps_used_up;
  if (solution.missed > 0) return RefinedStatus::tolerance_missed;
  return solution.truncated ? RefinedStatus::elements_used_up : RefinedStatus::solved;
}

Result<Done> compute(RefinedReport& report, std::ostream& err) {
  const RefinedRequest& request = report.request;
  if (request.per_light) {
    report.status = shoot_lights(report, err);
    return Done{};
  }
  ShootingProgress shown(err, request);
  Progress rows(err, "form factors", request.common);
  Execution how{request.common.threads, {}, &stop_requested()};
  const auto told = [&](const AdaptiveSolution& solution) { shown.show(solution.state); };
  if (request.eliminates()) how = execution(request.common, rows);
  auto solution = request.eliminates()
                      ? adapt_by_elimination(report.file.scene, std::move(report.solution), request.factors(),
                                             request.adaptive_goal(), how)
                      : adapt_by_shooting(report.file.scene, std::move(report.solution), request.factors(),
                                          request.adaptive_goal(), request.shooting_goal(), how, told);
  if (!solution) return solution.error();
  report.solution = std::move(solution).value();
  report.status = status_of(report.solution);
  return Done{};
}

/// Sums up the lights, and what the report says of the state.
void conclude(RefinedReport& report) {
  const Scene& scene = report.file.scene;
  AdaptiveSolution& solution = report.solution;
  report.emissions = emissions_of(scene, solution.model);
  if (!report.lights.empty()) {
    std::vector<LightShare> shares;
    std::vector<Emissions> emissions;
    std::vector<Rgb> factors = report.light_factors;
    factors.resize(report.lights.size(), Rgb::Ones());
    for (std::size_t l = 0; l < report.lights.size(); ++l) {
      shares.push_back({&report.lights[l].state, factors[l]});
      emissions.push_back(emissions_of(scene, solution.model, report.lights[l].material));
    }
    solution.state = relit(solution.model, shares);
    report.emissions = relit(emissions, factors);
  }
  report.gap = shooting_gap(scene, solution.model, solution.state, report.bounded);
  report.radiosity = radiosities(scene, solution.model, report.emissions, solution.state);
  if (report.request.ambient) report.ambient = ambient_radiosity(scene, solution.model, solution.state);
}

ImageMetadata metadata(const RefinedReport& report) {
  return {{"etendue:version", version()},
          {"etendue:method", "radiosity, Gouraud; " + report.settings},
          {"etendue:scene", report.file.scene.name},
          {"etendue:scene_hash", report.file.hash},
          {"etendue:steps", std::to_string(report.solution.state.steps)},
          {"etendue:unshot_share", shortest(report.solution.state.unshot_shares.back())},
          {"etendue:samples_per_side", std::to_string(report.request.samples)}};
}

/// Draws and writes both pictures; ErrorCode::stopped when the user asked for it meanwhile.
Result<Done> write_pictures(RefinedReport& report, const ElementMesh& shown, std::ostream& err) {
  const Scene& scene = report.file.scene;
  const RefinedRequest& request = report.request;
  auto radiosities = drawn(scene, shown, report.vertices, request, err);
  if (!radiosities) return radiosities.error();
  const ToneMapping how = mapping(request.tone, report.exposure);
  Shown picture{std::move(radiosities).value(), {}};
  picture.displayed = tone_mapped(picture.radiosities, how);
  if (request.draw_mesh) {
    const auto lines = mesh_lines(scene.camera, report.solution.model.elements, request.samples);
    if (!lines) return lines.error();
    picture.displayed.picture = drawn_over(picture.displayed.picture, *lines, 1);
  }
  report.exr = named(request, ".exr");
  report.png = named(request, ".png");
  return write_pictures(report, picture, how, metadata(report));
}

/// A mesh whose elements meet in corners, and the values there; left without values where stopped.
ElementMesh prepare_view(RefinedReport& report) {
  const Scene& scene = report.file.scene;
  const PatchModel& model = report.solution.model;
  ElementMesh shown = with_shared_vertices(model.elements);
  report.covered = without_view(model, report.solution.state.irradiance, {report.request.common.threads, {}, nullptr});
  const std::vector<Rgb> values =
      report.request.ambient ? with_ambient_term(scene, model, report.radiosity, report.ambient) : report.radiosity;
  report.vertices = vertex_radiosities(shown, values, report.covered);
  report.exposure = linear_exposure(report.request.tone, white_level(scene, shown, report.vertices));
  return shown;
}

/// Measures at the sensors, if there are some, and writes the table; ErrorCode::stopped when the user asked for it meanwhile.
Result<Done> add_readings(RefinedReport& report, std::ostream& err) {
  if (!report.sensors) return Done{};
  Rgb bound = report.gap.radiosity;
  if (report.request.eliminates()) bound = report.solution.bound;
  Progress progress(err, "sensors", report.request.common);
  auto found = measured({report.solution.model.elements, report.radiosity, report.covered, bound}, *report.sensors,
                        execution(report.request.common, progress));
  if (!found) return found.error();
  report.sensors = std::move(found).value();
  const SensorReport& sensors = *report.sensors;
  return write_file(sensors.csv, sensors_csv(sensors.sensors, sensors.results, sensors.efficacy));
}

/// The solution as other programs want it, on the mesh that is shown.
SolvedSurfaces surfaces(const RefinedReport& report, const ElementMesh& shown) {
  SolvedSurfaces solved{
      report.file.scene, shown, report.vertices, report.radiosity, report.solution.state.irradiance, {},
      report.exposure};
  for (const Element& element : shown.elements) solved.emission.push_back(report.emissions[element.patch]);
  return solved;
}

Result<RefinedReport> solved(const RefinedRequest& request, std::ostream& err) {
  auto start = begun(request);
  if (!start) return start.error();
  RefinedReport report = std::move(start).value();
  std::error_code absent;
  if (request.resume && !fs::exists(earlier(request), absent)) {
    err << "etendue solve: nothing to resume: there is no " << quoted_path(earlier(request)) << '\n';
  } else if (request.resume || request.relight) {
    const auto read = read_solution(earlier(request), report, request.resume);
    if (!read) return read.error();
  }
  if (request.relight) {
    auto factors = light_factors(*request.relight, report);
    if (!factors) return factors.error();
    report.light_factors = std::move(factors).value();
    report.status = RefinedStatus::relit;
  } else if (const auto done = compute(report, err); !done) {
    return done.error();
  }
  conclude(report);
  return report;
}

int judged(const RefinedReport& report, std::ostream& err) {
  switch (report.status) {
    case RefinedStatus::tolerance_missed:
      return fail(err, kName,
                  {ErrorCode::not_converged, "tolerance not reached: " + counted(report.solution.missed, "pair") +
                                                 " of patch and element are known less well than "
                                                 "--tolerance asks; all was saved"});
    case RefinedStatus::elements_used_up:
      return fail(err, kName,
                  {ErrorCode::not_converged,
                   "the radiosity still changes by more than --threshold where "
                   "--most-elements ended the division; all was saved"});
    case RefinedStatus::stopped:
      return fail(err, kName, {ErrorCode::stopped, "stopped; what was done is in " + quoted_path(report.json)});
    case RefinedStatus::solved:
    case RefinedStatus::steps_used_up:
    case RefinedStatus::relit:
      break;
  }
  return 0;
}

}  // namespace

bool asks_for_refinement(const std::vector<std::string>& arguments) {
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const std::string& word = arguments[k];
    if (word == "--relight" || word.rfind("--relight=", 0) == 0) return true;
    const std::string value = word.rfind("--method=", 0) == 0                  ? word.substr(9)
                              : word == "--method" && k + 1 < arguments.size() ? arguments[k + 1]
                                                                               : "";
    if (value == "hemicube" || value == "progressive" || value == "adaptive") return true;
  }
  return false;
}

int solve_refined(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  RefinedRequest request;
  Options options(kName, "Solve the radiosity equation of a scene by refinement, and show the result.");
  declare(options, request);
  if (const auto code = options.parse(arguments, out, err)) return *code;
  if (const auto wrong = contradiction(request)) return options.usage_error(err, *wrong);
  const auto begin = std::chrono::steady_clock::now();
  auto outcome = solved(request, err);
  if (!outcome) return fail(err, kName, outcome.error());
  RefinedReport report = std::move(outcome).value();
  tell_left_out(err, request, report.file.scene);
  const bool stopped = report.status == RefinedStatus::stopped;
  report.json = named(request, stopped ? ".incomplete.json" : ".json");
  std::optional<Error> lost;
  const ElementMesh shown = stopped ? ElementMesh{} : prepare_view(report);
  if (!stopped) {
    const auto read = add_readings(report, err);
    if (!read && read.error().code != ErrorCode::stopped) return fail(err, kName, read.error());
    if (!read) lost = read.error();
  }
  // Before the pictures: nothing that happens to them takes the radiosities away.
  if (const auto written = write_solution(report.json, report); !written) return fail(err, kName, written.error());
  if (!stopped) {
    std::error_code absent;  // what is finished needs no going on
    if (request.resume) fs::remove(named(request, ".incomplete.json"), absent);
    if (!request.written.empty()) {
      if (const auto written = write_solutions(request.written, surfaces(report, shown)); !written) {
        return fail(err, kName, written.error());
      }
      report.written = request.written;
    }
    if (!lost) {
      const auto pictures = write_pictures(report, shown, err);
      if (!pictures) lost = pictures.error();
    }
  }
  if (lost && lost->code != ErrorCode::stopped) return fail(err, kName, *lost);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (request.common.json) {
    out << summary_json(report);
  } else if (!request.common.quiet) {
    print_summary(out, report);
  }
  if (lost) {
    return fail(err, kName,
                {ErrorCode::stopped,
                 "stopped; sensors or pictures are missing; the radiosities are in " + quoted_path(report.json)});
  }
  return judged(report, err);
}

}  // namespace etendue::cli
