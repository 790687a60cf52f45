// SPDX-License-Identifier: Apache-2.0
#include "form_factors_request.hpp"

#include "etendue/io/length_unit.hpp"
#include "etendue/io/matrix_file.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue::cli {

namespace {

namespace fs = std::filesystem;

constexpr Tolerance kDefault{1e-6, 1e-9};
/// Of the rough methods nothing is asked unless the user does: every bound reaches it.
constexpr Tolerance kNothing{1, 1};
constexpr int kMostPoints = 16;
constexpr int kMostRays = 1000000000;

}  // namespace

void FormFactorsRequest::declare(Options& options) {
  options.argument("SCENE", "surfaces: .json, .vs3 (View3D), .obj or .stl", scene);
  options.choice(
      "--method", {"exact", "certified", "rays", "hemicube", "tetrahedron"},
      "exact integration (default), proved enclosures; rough: counting rays, or the pixels of a hemicube or of a "
      "cubic tetrahedron",
      method);
  options.real("--relative", "X", "error asked of a factor, relative to it (default: 1e-6)", tolerance.relative, 0, 1);
  options.real("--absolute", "X", "or absolute, whichever is looser (default: 1e-9)", tolerance.absolute, 0, 1);
  options.two_texts("--pair", "I J", "print this pair only: surfaces by number, from 1, or by name", pair);
  options.integer("--rays", "N", "rays from every surface, for --method rays (default: 10000)", rays, 1, kMostRays);
  options.integer("--seed", "N", "other rays or rotations (default: 1)", seed, 0, kMostRays);
  options.integer("--resolution", "N", "pixels along an edge, even, for hemicube and tetrahedron (default: 200)",
                  pixels.resolution, kLeastResolution, kMostResolution);
  options.integer("--points", "N", "along each side of a surface that pixels are put around (default: 1)",
                  pixels.points, 1, kMostPoints);
  options.flag("--rotate", "turn each hemicube or tetrahedron about its normal at random", pixels.rotate);
  options.flag("--repair-closure", "change factors by least squares until rows sum to one; says what it changed",
               repair);
  options.real("--drop", "X", "write factors below X in both directions as zero; says what that leaves out", drop, 0,
               1);
  options.choice("--unit", length_unit_names(),
                 "of the lengths in a .vs3, .obj or .stl file, for areas in square metres", unit);
  options.flag("--resume", "go on with the run that left FILE.checkpoint", resume);
  add_common(options, common, "write the matrix: .csv, .npy, .mtx, .json, or .vf as View3D does");
  options.note(
      "Row i of the matrix holds the factors from surface i. Without --output a summary is printed. While the matrix\n"
      "grows it lies in FILE.checkpoint: after Ctrl-C (exit code 6) or a crash, --resume goes on with it, to the same\n"
      "bits. Where a factor's bound exceeds both tolerances the matrix is written all the same, and the exit code is "
      "4.");
  options.example("etendue form-factors scenes/furnace/scene.json");
  options.example("etendue form-factors scenes/furnace/scene.json --relative 1e-9 -o furnace.csv");
  options.example("etendue form-factors scenes/l-room/scene.vs3 --relative 1e-3 --pair floor window");
  options.example("etendue form-factors scenes/l-room/scene.vs3 --relative 1e-3 --output l-room.vf");
  options.example("etendue form-factors scenes/furnace/scene.json --method hemicube --resolution 100 --rotate");
  options.example("etendue form-factors scenes/furnace/scene.json --method rays --rays 1000 --json");
}

std::optional<std::string> FormFactorsRequest::complete() {
  if (rays != kNotGiven && method != "rays") return "--rays are counted by --method rays only";
  if (!by_pixels()) {
    const char* useless = pixels.resolution != kNotGiven ? "--resolution"
                          : pixels.points != kNotGiven   ? "--points"
                          : pixels.rotate                ? "--rotate"
                                                         : nullptr;
    if (useless) return std::string(useless) + " is of --method hemicube and tetrahedron only";
  }
  if (seed != kNotGiven && !rough()) return "--seed is of --method rays, hemicube and tetrahedron only";
  if (!unit.empty() && scene.extension() == ".json") {
    return "--unit: " + quoted_path(scene) + " says its unit itself";
  }
  const bool asked = tolerance.relative != kNotGiven || tolerance.absolute != kNotGiven;
  const Tolerance otherwise = rough() && !asked ? kNothing : kDefault;
  if (tolerance.relative == kNotGiven) tolerance.relative = otherwise.relative;
  if (tolerance.absolute == kNotGiven) tolerance.absolute = otherwise.absolute;
  if (rays == kNotGiven) rays = RaySettings{}.rays;
  if (seed == kNotGiven) seed = 1;
  if (pixels.resolution == kNotGiven) pixels.resolution = HemicubeSettings{}.resolution;
  if (pixels.points == kNotGiven) pixels.points = HemicubeSettings{}.points;
  if (!common.output.empty()) {
    if (const auto known = check_matrix_path(common.output); !known) return known.error().message;
    std::error_code absent;
    if (fs::equivalent(common.output, scene, absent)) {
      return quoted_path(common.output) + " would replace the scene; name another file";
    }
  }
  if (pixels.resolution % 2 != 0) {
    return "--resolution: found " + std::to_string(pixels.resolution) + ", expected an even number";
  }
  if (!pair.first.empty() && !common.output.empty()) return "--pair prints one pair: leave --output out";
  if (!pair.first.empty() && (repair || drop != 0)) {
    return std::string("--pair prints one pair: ") + (repair ? "--repair-closure" : "--drop") + " is of whole matrices";
  }
  if (resume && common.output.empty()) return "--resume needs the --output of the run";
  return std::nullopt;
}

}  // namespace etendue::cli
