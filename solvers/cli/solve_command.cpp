// SPDX-License-Identifier: Apache-2.0
#include "solve_command.hpp"

#include <algorithm>
#include <chrono>
#include <ostream>

#include "etendue/core/version.hpp"
#include "etendue/io/atomic_file.hpp"
#include "etendue/io/row_file.hpp"
#include "etendue/meshing/element_count.hpp"
#include "etendue/meshing/shared_vertices.hpp"
#include "etendue/meshing/surface_checks.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"
#include "etendue/view/radiosity_view.hpp"
#include "outputs.hpp"
#include "progress.hpp"
#include "refined_command.hpp"
#include "solve_factors_command.hpp"
#include "solve_parts.hpp"
#include "solve_report.hpp"

namespace etendue::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "solve";

struct Request : SolutionRequest {
  SensorRequest sensors;
  std::string method = "full";
  std::string solver = "gauss";
  double tolerance = AssemblyTolerance{}.obstructed.relative;
  int steps = 100'000;
  bool certify = false, resume = false;
  double certified = 0.02;  ///< half width asked of enclosures past obstructions, relative
};

/// What identifies the picture; nothing that may differ between runs. So equal PNGs are equal files; an EXR's header also
/// has the time of writing (capDate), which OpenImageIO adds.
ImageMetadata metadata(const SolveReport& report, int samples) {
  return {{"etendue:version", version()},
          {"etendue:method", "radiosity, full matrix, Gouraud"},
          {"etendue:scene", report.file.scene.name},
          {"etendue:scene_hash", report.file.hash},
          {"etendue:solver", report.solver},
          {"etendue:tolerance", shortest(report.tolerance.obstructed.relative)},
          {"etendue:samples_per_side", std::to_string(samples)}};
}

/// A mesh whose elements meet in corners, and what its display needs and NAME.json names.
ElementMesh prepare_view(SolveReport& report, const Request& request) {
  const Scene& scene = report.file.scene;
  ElementMesh shown = with_shared_vertices(report.mesh);
  report.vertices = vertex_radiosities(shown, report.solution->radiosity, report.closure.covered);
  report.exposure = linear_exposure(request.tone, white_level(scene, shown, report.vertices));
  return shown;
}

/// The solution as other programs want it; H = F B.
SolvedSurfaces surfaces(const SolveReport& report, const ElementMesh& shown) {
  SolvedSurfaces solved{report.file.scene,           shown, report.vertices, report.solution->radiosity,
                        report.solution->irradiance, {},    report.exposure};
  for (const Element& element : shown.elements) {
    solved.emission.push_back(report.file.scene.materials[shown.face_of(element).material].emission);
  }
  return solved;
}

/// Draws and writes both pictures; ErrorCode::stopped when the user asked for it meanwhile.
Result<Done> write_pictures(SolveReport& report, const ElementMesh& shown, const Request& request, std::ostream& err) {
  auto picture = drawn(report.file.scene, shown, report.vertices, request, err);
  if (!picture) return picture.error();
  report.exr = solution_path(request, ".exr");
  report.png = solution_path(request, ".png");
  const ToneMapping how = mapping(request.tone, report.exposure);
  Shown both{std::move(picture).value(), {}};
  both.displayed = tone_mapped(both.radiosities, how);
  return write_pictures(report, both, how, metadata(report, request.samples));
}

/// Refuses elements whose matrix this machine cannot hold, before it is begun.
Result<Done> check_room(const Request& request, std::size_t elements) {
  const double bytes_a_pair = request.certify ? kCertifiedBytesAPair : kBytesAPair;
  const auto n = static_cast<double>(elements);
  return check_memory(request.scene, {n * n * bytes_a_pair, std::to_string(elements) + " elements need",
                                      shortest(bytes_a_pair) + " bytes for each of n² pairs",
                                      "divide the surfaces into fewer elements (\"elements\" of the objects)"});
}

void declare(Options& options, Request& request) {
  options.argument("SCENE", "scene file (JSON)", request.scene);
  options.also("--factors FILE --reflectance R --emission E [OPTIONS]");
  add_method(options, request.method);
  options.choice("--solver", solver_choices(), kSolverHelp, request.solver);
  options.integer("--steps", "N", "most steps of a solver that iterates (default: 100000)", request.steps, 1,
                  1'000'000'000);
  options.real("--tolerance", "T", "relative error asked of form factors past obstructions (default: 1e-6)",
               request.tolerance, 1e-12, 0.1);
  options.flag("--certify", "find intervals that hold every exact radiosity, by enclosures of all form factors; slow",
               request.certify);
  options.real("--certify-tolerance", "T",
               "relative half width asked of enclosures past obstructions (default: 0.02), work allowing",
               request.certified, 1e-9, 1);
  options.flag("--resume", "go on from NAME.factors.resume, to the same bits as without a pause", request.resume);
  add_meshing(options, request);
  add_sensors(options, request.sensors);
  add_extrapolation(options, request.sensors);
  add_results(options, request);
  options.elsewhere({"--factors-by", "--resolution", "--points", "--mesh"},
                    "--method hemicube, progressive and adaptive");
  options.elsewhere({"--unshot", "--overshoot", "--ambient"}, "--method progressive and adaptive");
  options.elsewhere({"--per-light"}, "--method progressive");
  options.elsewhere({"--solve-by", "--threshold", "--levels", "--most-elements"}, "--method adaptive");
  options.note(
      "NAME.json holds the radiosity of every element with its bounds, the EXR radiosities [W/m²] as seen by the\n"
      "camera. A surface shows its front only, so a camera outside a room sees through the back of the nearest wall.\n"
      "With --certify NAME.json also holds two numbers for each element and channel between which its exact radiosity\n"
      "lies: proved, whatever the rounding. Where the form factors are known too loosely for that, or less well than\n"
      "--certify-tolerance asks, the exit code is 4.\n"
      "Solvers that iterate go on until a proved bound on their error is below 1e-10 of the largest radiosity.\n"
      "Where form factors are less certain than --tolerance asks, everything is saved and the exit code is 4. After\n"
      "Ctrl-C what is done, rows of the form-factor matrix or channels, is saved as NAME.incomplete.json, once all is\n"
      "solved as NAME.json, and the exit code is 6. The rows are also in NAME.factors.resume: with --resume the same\n"
      "command computes those that are missing, and all that comes after them.");
  options.note(
      "Without a scene, from form factors in a file: --factors FILE --reflectance R --emission E [--areas A]\n"
      "[--solver S] [--certify] [--tolerance X] [--steps N] [--row-excess X] [--repair-closure] [--output FILE];\n"
      "'etendue solve --factors --help' tells more.");
  options.example("etendue solve scenes/furnace/scene.json --output furnace.png");
  options.example("etendue solve scenes/furnace/scene.json --certify --output furnace-certified.png");
  options.example("etendue solve scenes/furnace/scene.json --solver gmres --json --output furnace-gmres.png");
}

RadiosityGoal goal(const Request& request) {
  RadiosityGoal wanted;
  wanted.solver = *solver_named(request.solver);
  wanted.most_steps = request.steps;
  return wanted;
}

/// Adds the enclosures, or why there are none.
void certify(SolveReport& report, const Request& request, std::ostream& err) {
  const CertifiedGoals goals = certified_goals(request.certified, report.mesh.elements.size());
  {
    Progress progress(err, "enclosures", request.common);
    report.certified = certified_factors(report.mesh, goals, execution(request.common, progress));
  }
  if (!report.certified->complete) {
    report.not_certified = "stopped before all form factors were enclosed";
    return;
  }
  Progress progress(err, "enclosed solve", request.common);
  auto enclosed = solve_certified(report.file.scene, report.mesh, *report.certified, goal(request),
                                  execution(request.common, progress));
  if (enclosed) {
    report.enclosure = std::move(enclosed).value();
  } else {
    report.not_certified = enclosed.error().message;
    if (enclosed.error().code == ErrorCode::stopped) report.certified->complete = false;
  }
}

std::filesystem::path rows_path(const Request& request) {
  return solution_path(request, ".factors.resume");
}

/// What the rows of a form-factor matrix depend on.
RowsKey rows_key(const SolveReport& report) {
  return {{"version", version()},
          {"scene hash", report.file.hash},
          {"--tolerance", shortest(report.tolerance.obstructed.relative)},
          {"--element-size", report.element_size > 0 ? shortest(report.element_size) : "as the scene says"},
          {"--align-mesh", report.file.scene.align_mesh ? "on" : "off"},
          {"elements", std::to_string(report.mesh.elements.size())}};
}

/// All form factors, or, when stopped, some of their rows.
Result<FormFactorMatrix> found_factors(const SolveReport& report, const Request& request, std::ostream& err) {
  FormFactorMatrix begun;
  if (!report.begun.empty()) {
    auto read = read_rows(report.begun, rows_key(report), report.mesh.elements.size());
    if (!read) return read.error();
    begun = std::move(read).value();
  }
  Progress progress(err, "form factors", request.common);
  return assemble_form_factors(report.mesh, report.tolerance, execution(request.common, progress), std::move(begun));
}

/// From the scene of the report to its radiosities; when stopped, there is no solution.
Result<Done> solve_scene(SolveReport& report, const Request& request, std::ostream& err) {
  if (const auto room = check_room(request, count_elements(report.file.scene)); !room) return room.error();
  auto mesh = mesh_elements(report.file.scene);
  if (!mesh) return mesh.error();
  report.mesh = std::move(mesh).value();
  if (const auto apart = check_overlaps(report.file.scene, report.mesh); !apart) return apart.error();
  // Again: the mesh itself has taken of the memory.
  if (const auto room = check_room(request, report.mesh.elements.size()); !room) return room.error();
  if (report.sensors) {
    const auto free = check_sensors(report.file.scene, FinalGather(report.mesh), report.sensors->sensors);
    if (!free) return free.error();
  }
  auto factors = found_factors(report, request, err);
  if (!factors) return factors.error();
  report.matrix = std::move(factors).value();
  if (!report.matrix.complete) return Done{};
  report.closure = closure_report(report.mesh, report.matrix);
  Progress progress(err, "solve", request.common);
  auto solution = solve_scene_radiosity(report.file.scene, report.mesh, report.matrix, goal(request),
                                        execution(request.common, progress));
  if (!solution) return solution.error();
  report.solution = std::move(solution).value();
  return Done{};
}

/// Measures at the sensors, if there are some; ErrorCode::stopped when the user asked for it meanwhile.
Result<Done> add_readings(SolveReport& report, const Request& request, std::ostream& err) {
  if (!report.sensors) return Done{};
  SensorReport sensors = std::move(*report.sensors);
  report.sensors.reset();
  const SolveAgain again = [&](Scene scene) -> Result<SolveReport> {
    SolveReport coarse;
    coarse.file.scene = std::move(scene);
    coarse.tolerance = report.tolerance;
    if (const auto done = solve_scene(coarse, request, err); !done) return done.error();
    if (!is_solved(coarse)) return Error{ErrorCode::stopped, "stopped in the coarser mesh"};
    return coarse;
  };
  Progress progress(err, "sensors", request.common);
  auto found = measured(report, std::move(sensors), request.sensors.extrapolate ? again : SolveAgain{},
                        execution(request.common, progress));
  if (!found) return found.error();
  report.sensors = std::move(found).value();
  return Done{};
}

/// Everything up to the radiosities; when stopped, the report has no solution.
Result<SolveReport> solved(const Request& request, std::ostream& err) {
  SolveReport report;
  auto file = opened(request);
  if (!file) return file.error();
  report.file = std::move(file).value();
  report.scene_path = request.scene;
  report.solver = request.solver;
  report.element_size = request.element_size;
  report.certify_tolerance = request.certified;
  report.tolerance.obstructed = {request.tolerance, request.tolerance * kAbsoluteShare};
  if (request.sensors.asked()) {
    auto sensors = opened_sensors(request.sensors, report.file, solution_path(request, ".sensors.csv"));
    if (!sensors) return sensors.error();
    report.sensors = std::move(sensors).value();
  }
  const fs::path rows = rows_path(request);
  if (const auto free = check_outputs({rows}, report.file.files); !free) return free.error();
  if (std::error_code absent; request.resume && !fs::exists(rows, absent)) {
    err << "etendue solve: nothing to resume, beginning anew: there is no " << quoted_path(rows) << '\n';
  } else if (request.resume) {
    report.begun = rows;
  }
  if (const auto done = solve_scene(report, request, err); !done) return done.error();
  if (request.certify && is_solved(report)) certify(report, request, err);
  return report;
}

/// Keeps the rows for --resume, and says so.
int stopped(const SolveReport& report, const Request& request, std::ostream& err, const std::string& what) {
  const fs::path rows = rows_path(request);
  if (const auto kept = write_rows(rows, rows_key(report), report.matrix); !kept) return fail(err, kName, kept.error());
  return fail(err, kName,
              {ErrorCode::stopped, "stopped; " + what + ", and --resume goes on from " + quoted_path(rows)});
}

/// What is finished needs no going on.
int finished(const Request& request, int code) {
  std::error_code absent;
  if (request.resume && code != static_cast<int>(ErrorCode::stopped)) {
    for (const fs::path& path : {rows_path(request), solution_path(request, ".incomplete.json")}) {
      fs::remove(path, absent);
    }
  }
  return code;
}

/// What to end with, all being saved: 4 where form factors or their enclosures are less certain than was asked, and why.
int judged(const SolveReport& report, const Request& request, std::ostream& err) {
  if (report.certified && !report.certified->complete) {
    return stopped(report, request, err, "all but the enclosures was saved");
  }
  if (!report.not_certified.empty()) {
    return fail(err, kName,
                {ErrorCode::not_converged, "not certified: " + report.not_certified + "; all else was saved"});
  }
  if (!is_direct(goal(request).solver) && report.solution->status != RadiosityStatus::reached) {
    return fail(err, kName,
                {ErrorCode::not_converged, "solver " + request.solver + ": " + words(report.solution->status) +
                                               " after " + std::to_string(report.solution->steps) +
                                               " steps; all was saved with the bounds that were reached"});
  }
  const std::string wide = wide_enclosures_text(report);
  if (report.matrix.missed.pairs == 0 && wide.empty()) return 0;
  std::string what = report.matrix.missed.pairs > 0 ? missed_tolerance_text(report) : "";
  if (!wide.empty()) what += (what.empty() ? "" : "; ") + wide;
  return fail(err, kName, {ErrorCode::not_converged, what + "; all was saved"});
}

}  // namespace

int solve(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  const auto without_scene = [](const std::string& word) {
    return word == "--factors" || word.rfind("--factors=", 0) == 0;
  };
  if (std::any_of(arguments.begin(), arguments.end(), without_scene)) return solve_factors(arguments, out, err);
  if (asks_for_refinement(arguments)) return solve_refined(arguments, out, err);
  Request request;
  Options options(kName, "Solve the radiosity equation of a scene, and show the result.");
  declare(options, request);
  if (const auto code = options.parse(arguments, out, err)) return *code;
  if (const auto wrong = contradiction(request.sensors)) return options.usage_error(err, *wrong);
  if (const auto wrong = contradiction(request.tone)) return options.usage_error(err, *wrong);
  if (request.solver == "eigen") request.solver = "lu";
  const auto begin = std::chrono::steady_clock::now();
  auto outcome = solved(request, err);
  if (!outcome) return fail(err, kName, outcome.error());
  SolveReport report = std::move(outcome).value();
  tell_left_out(err, request, report.file.scene);
  const ElementMesh shown = is_solved(report) ? prepare_view(report, request) : ElementMesh{};
  std::optional<Error> lost;
  if (is_solved(report)) {
    const auto read = add_readings(report, request, err);
    if (!read && read.error().code != ErrorCode::stopped) return fail(err, kName, read.error());
    if (!read) lost = read.error();
  }
  report.json = solution_path(request, is_solved(report) ? ".json" : ".incomplete.json");
  // Before the pictures: nothing that happens to them takes the radiosities away.
  if (const auto written = write_file(report.json, full_json(report)); !written) {
    return fail(err, kName, written.error());
  }
  if (report.sensors && is_solved(report)) {
    const SensorReport& sensors = *report.sensors;
    const auto written = write_file(sensors.csv, sensors_csv(sensors.sensors, sensors.results, sensors.efficacy));
    if (!written) return fail(err, kName, written.error());
  }
  if (is_solved(report) && !lost) {
    if (!request.written.empty()) {
      if (const auto written = write_solutions(request.written, surfaces(report, shown)); !written) {
        return fail(err, kName, written.error());
      }
      report.written = request.written;
    }
    const auto pictures = write_pictures(report, shown, request, err);
    if (!pictures) lost = pictures.error();
  }
  if (lost && lost->code != ErrorCode::stopped) return fail(err, kName, *lost);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (request.common.json) {
    out << summary_json(report);
  } else if (!request.common.quiet) {
    print_summary(out, report);
  }
  if (lost) {
    return stopped(report, request, err,
                   "sensors or pictures are missing; the radiosities are in " + quoted_path(report.json));
  }
  if (is_solved(report)) return finished(request, judged(report, request, err));
  return stopped(report, request, err, "what was done is in " + quoted_path(report.json));
}

}  // namespace etendue::cli
