// SPDX-License-Identifier: Apache-2.0
#include "solve_command.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <ostream>

#include "etendue/core/version.hpp"
#include "etendue/image/exposure.hpp"
#include "etendue/io/atomic_file.hpp"
#include "etendue/io/image_file.hpp"
#include "etendue/meshing/element_count.hpp"
#include "etendue/meshing/surface_checks.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"
#include "etendue/view/radiosity_view.hpp"
#include "memory.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "progress.hpp"
#include "refined_command.hpp"
#include "solve_factors_command.hpp"
#include "solve_parts.hpp"
#include "solve_report.hpp"
#include "stop.hpp"

namespace etendue::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "solve";
constexpr int kMostSamples = 16;  // a side, 256 a pixel

struct Request {
  CommonOptions common;
  fs::path scene;
  std::vector<fs::path> written;  ///< --write
  std::string method = "full";
  std::string solver = "gauss";
  double tolerance = AssemblyTolerance{}.obstructed.relative;
  double exposure =
      0;  ///< 0, which --exposure does not take: so that white is the brightest surface that does not emit
  int samples = 3;
  int steps = 100'000;
  bool certify = false;
  double certified = 0.02;  ///< half width asked of enclosures past obstructions, relative
};

fs::path named(const Request& request, const char* ending) {
  return solution_path(request.common.output, request.scene, ending);
}

/// What identifies the picture; nothing that may differ between runs. So equal PNGs are equal files; an EXR's header also
/// has the time of writing (capDate), which OpenImageIO adds.
ImageMetadata metadata(const SolveReport& report, int samples) {
  return {{"etendue:version", version()},
          {"etendue:method", "radiosity, full matrix, Gouraud"},
          {"etendue:scene", report.file.scene.name},
          {"etendue:scene_hash", report.file.hash},
          {"etendue:solver", report.solver},
          {"etendue:tolerance", shortest(report.tolerance.obstructed.relative)},
          {"etendue:samples_per_side", std::to_string(samples)},
          {"etendue:values", "radiosity [W/m2]"}};
}

/// What the display of the solution needs, and NAME.json names.
void prepare_view(SolveReport& report, const Request& request) {
  const Scene& scene = report.file.scene;
  report.vertices = vertex_radiosities(report.mesh, report.solution->radiosity, report.closure.covered);
  report.exposure = request.exposure > 0 ? request.exposure : 1 / white_level(scene, report.mesh, report.vertices);
}

/// The solution as other programs want it; H = F B.
SolvedSurfaces surfaces(const SolveReport& report) {
  const std::size_t n = report.mesh.elements.size();
  SolvedSurfaces solved{
      report.file.scene, report.mesh, report.vertices, report.solution->radiosity, std::vector<Rgb>(n, Rgb::Zero()), {},
      report.exposure};
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i < n; ++i) {
      const double factor = report.matrix.factors(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      solved.irradiance[i] += factor * solved.radiosity[j];
    }
    const Face& face = report.mesh.face_of(report.mesh.elements[j]);
    solved.emission.push_back(report.file.scene.materials[face.material].emission);
  }
  return solved;
}

/// Draws and writes both pictures; ErrorCode::stopped when the user asked for it meanwhile.
Result<Done> write_pictures(SolveReport& report, const Request& request, std::ostream& err) {
  const Scene& scene = report.file.scene;
  const auto picture = [&] {
    Progress progress(err, "picture", request.common);
    return view_radiosities(scene.camera, report.mesh, report.vertices, scene.background, request.samples,
                            execution(request.common, progress));
  }();
  if (!picture) return picture.error();
  ImageMetadata facts = metadata(report, request.samples);
  report.exr = named(request, ".exr");
  report.png = named(request, ".png");
  const auto exr = encode_image(report.exr, *picture, facts);
  if (!exr) return exr.error();
  facts.back().second = "radiosity times exposure";
  facts.emplace_back("etendue:exposure", shortest(report.exposure));
  const auto png = encode_image(report.png, exposed(*picture, report.exposure), facts);
  if (!png) return png.error();
  return write_files({*exr, *png});
}

/// Refuses elements whose matrix this machine cannot hold, before it is begun.
Result<Done> check_room(const Request& request, std::size_t elements) {
  const double bytes_a_pair = request.certify ? kCertifiedBytesAPair : kBytesAPair;
  const auto n = static_cast<double>(elements);
  const auto room = check_memory({n * n * bytes_a_pair, std::to_string(elements) + " elements need",
                                  shortest(bytes_a_pair) + " bytes for each of n² pairs",
                                  "divide the surfaces into fewer elements (\"elements\" of the objects)"});
  if (!room) return Error{room.error().code, printable(request.scene.string()) + ": " + room.error().message};
  return Done{};
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
  options.real("--exposure", "F",
               "multiply the PNG's values by F (default: 1 / the largest radiosity that is not an emitter's)",
               request.exposure, kLeastExposure, kMostExposure);
  options.integer("--samples", "N", "N × N samples a pixel (default: 3)", request.samples, 1, kMostSamples);
  add_common(options, request.common,
             "NAME.exr or NAME.png: writes both and NAME.json (default: the scene's name, in this folder;\n"
             "NAME-radiosity where NAME.json is the scene)");
  options.alias("-o", "--output");
  add_write(options, request.written);
  options.note(
      "NAME.json holds the radiosity of every element with its bounds, the EXR radiosities [W/m²] as seen by the\n"
      "camera. A surface shows its front only, so a camera outside a room sees through the back of the nearest wall.\n"
      "With --certify NAME.json also holds two numbers for each element and channel between which its exact radiosity\n"
      "lies: proved, whatever the rounding. Where the form factors are known too loosely for that, or less well than\n"
      "--certify-tolerance asks, the exit code is 4.\n"
      "Solvers that iterate go on until a proved bound on their error is below 1e-10 of the largest radiosity.\n"
      "Where form factors are less certain than --tolerance asks, everything is saved and the exit code is 4. After\n"
      "Ctrl-C what is done, rows of the form-factor matrix or channels, is saved as NAME.incomplete.json, once all is\n"
      "solved as NAME.json, and the exit code is 6.");
  options.note(
      "Without a scene, from form factors in a file: --factors FILE --reflectance R --emission E [--areas A]\n"
      "[--solver S] [--certify] [--tolerance X] [--steps N] [--row-excess X] [--repair-closure] [--output FILE];\n"
      "'etendue solve --factors --help' tells more.");
  options.example("etendue solve scenes/furnace/scene.json --output furnace.png");
  options.example("etendue solve scenes/furnace/scene.json --certify --output furnace-certified.png");
  options.example("etendue solve scenes/furnace/scene.json --solver gmres --json --output furnace-gmres.png");
}

/// All files that this run may write.
std::vector<fs::path> outputs(const Request& request) {
  std::vector<fs::path> all = {named(request, ".exr"), named(request, ".png"), named(request, ".json"),
                               named(request, ".incomplete.json")};
  all.insert(all.end(), request.written.begin(), request.written.end());
  return all;
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

/// Everything up to the radiosities; when stopped, the report has no solution.
Result<SolveReport> solved(const Request& request, std::ostream& err) {
  SolveReport report;
  auto file = [&] {
    const NothingToSave reading;
    return read_scene(request.scene);
  }();
  if (!file) return file.error();
  report.file = std::move(file).value();
  // Opens the module for images, which takes longer than refusing a scene.
  const auto fit = check_image_path(request.common.output.empty() ? named(request, ".png") : request.common.output);
  if (!fit) return fit.error();
  if (const auto known = check_solution_paths(request.written); !known) return known.error();
  if (const auto free = check_outputs(outputs(request), report.file.files); !free) return free.error();
  report.scene_path = request.scene;
  report.solver = request.solver;
  report.certify_tolerance = request.certified;
  report.tolerance.obstructed = {request.tolerance, request.tolerance * kAbsoluteShare};
  if (const auto room = check_room(request, count_elements(report.file.scene)); !room) return room.error();
  auto mesh = mesh_elements(report.file.scene);
  if (!mesh) return mesh.error();
  report.mesh = std::move(mesh).value();
  if (const auto apart = check_overlaps(report.file.scene, report.mesh); !apart) return apart.error();
  // Again: the mesh itself has taken of the memory.
  if (const auto room = check_room(request, report.mesh.elements.size()); !room) return room.error();
  {
    Progress progress(err, "form factors", request.common);
    report.matrix = assemble_form_factors(report.mesh, report.tolerance, execution(request.common, progress));
  }
  if (!report.matrix.complete) return report;
  report.closure = closure_report(report.mesh, report.matrix);
  Progress progress(err, "solve", request.common);
  auto solution = solve_scene_radiosity(report.file.scene, report.mesh, report.matrix, goal(request),
                                        execution(request.common, progress));
  if (!solution) return solution.error();
  report.solution = std::move(solution).value();
  if (request.certify && is_solved(report)) certify(report, request, err);
  return report;
}

int stopped(std::ostream& err, const std::string& what) {
  return fail(err, kName, {ErrorCode::stopped, "stopped; " + what});
}

/// What to end with, all being saved: 4 where form factors or their enclosures are less certain than was asked, and why.
int judged(const SolveReport& report, const Request& request, std::ostream& err) {
  if (report.certified && !report.certified->complete) return stopped(err, "all but the enclosures was saved");
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
  if (request.solver == "eigen") request.solver = "lu";
  const auto begin = std::chrono::steady_clock::now();
  auto outcome = solved(request, err);
  if (!outcome) return fail(err, kName, outcome.error());
  SolveReport report = std::move(outcome).value();
  if (!request.common.quiet) {
    for (const std::string& line : left_out(report.file.scene)) err << "etendue solve: left out: " << line << '\n';
  }
  if (is_solved(report)) prepare_view(report, request);
  report.json = named(request, is_solved(report) ? ".json" : ".incomplete.json");
  // Before the pictures: nothing that happens to them takes the radiosities away.
  if (const auto written = write_file(report.json, full_json(report)); !written) {
    return fail(err, kName, written.error());
  }
  std::optional<Error> lost;
  if (is_solved(report)) {
    if (!request.written.empty()) {
      if (const auto written = write_solutions(request.written, surfaces(report)); !written) {
        return fail(err, kName, written.error());
      }
      report.written = request.written;
    }
    const auto pictures = write_pictures(report, request, err);
    if (!pictures) lost = pictures.error();
  }
  if (lost && lost->code != ErrorCode::stopped) return fail(err, kName, *lost);
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (request.common.json) {
    out << summary_json(report);
  } else if (!request.common.quiet) {
    print_summary(out, report);
  }
  if (lost) return stopped(err, "there are no pictures; the radiosities are in " + quoted_path(report.json));
  if (is_solved(report)) return judged(report, request, err);
  return stopped(err, "what was done is in " + quoted_path(report.json));
}

}  // namespace etendue::cli
