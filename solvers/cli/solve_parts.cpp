// SPDX-License-Identifier: Apache-2.0
#include "solve_parts.hpp"

#include <algorithm>
#include <ostream>
#include <utility>

#include "etendue/io/atomic_file.hpp"
#include "etendue/io/scene_node.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"
#include "etendue/view/radiosity_view.hpp"
#include "outputs.hpp"
#include "progress.hpp"
#include "stop.hpp"

namespace etendue::cli {

namespace fs = std::filesystem;

namespace {

constexpr int kMostSamples = 16;  // a side, 256 a pixel

/// Of --element-size; kLargestNumber of the scene format, and its inverse.
constexpr double kLeastSize = 1 / kLargestNumber;

/// What radiosity leaves out of this scene, one line each.
std::vector<std::string> left_out(const Scene& scene) {
  std::vector<std::string> lines;
  if (!scene.lights.empty()) {
    lines.push_back(counted(scene.lights.size(), "point or directional light") + ": only surfaces emit here");
  }
  for (const Material& material : scene.materials) {
    if (material.k_s > 0 || material.k_r > 0 || material.k_t > 0) {
      lines.push_back("k_s, k_r and k_t of material '" + printable(material.name) +
                      "': every surface is ideally diffuse here");
    }
  }
  return lines;
}

/// All files that this run may write.
std::vector<fs::path> outputs(const SolutionRequest& request, const std::string& suffix) {
  std::vector<fs::path> all;
  for (const char* ending : {".exr", ".png", ".json", ".incomplete.json"}) {
    all.push_back(solution_path(request, suffix + ending));
  }
  all.insert(all.end(), request.written.begin(), request.written.end());
  return all;
}

}  // namespace

void add_meshing(Options& options, SolutionRequest& request) {
  options.real(
      "--element-size", "X",
      "divide all surfaces so that no element's side is longer than X, in the scene's unit, in place of what the\n"
      "scene says of \"elements\"",
      request.element_size, kLeastSize, kLargestNumber);
  options.flag("--align-mesh", "cut elements where other objects stand on them, or pierce them, so that no light leaks",
               request.align_mesh);
}

void add_results(Options& options, SolutionRequest& request) {
  add_tone(options, request.tone, "1 / the largest radiosity that is not an emitter's");
  options.integer("--samples", "N", "N × N samples a pixel (default: 3)", request.samples, 1, kMostSamples);
  add_common(options, request.common,
             "NAME.exr or NAME.png: writes both and NAME.json (default: the scene's name, in this folder;\n"
             "NAME-radiosity where NAME.json is the scene)");
  options.paths("--write", "FILE",
                "also: .csv, .npy (numbers), .vtu (ParaView), .obj, .gltf, .glb (coloured surfaces); repeatable",
                request.written);
}

fs::path solution_path(const SolutionRequest& request, const std::string& ending) {
  std::string stem = output_stem(request.common.output, request.scene).string();
  std::error_code absent;  // what does not exist is not the scene
  if (request.common.output.empty() && fs::equivalent(stem + ".json", request.scene, absent)) stem += "-radiosity";
  return stem + ending;
}

Result<SceneFile> opened(const SolutionRequest& request, const std::string& suffix) {
  auto read = [&] {
    const NothingToSave reading;
    return read_scene(request.scene);
  }();
  if (!read) return read.error();
  SceneFile file = std::move(read).value();
  file.scene.align_mesh = file.scene.align_mesh || request.align_mesh;
  for (Object& object : file.scene.objects) {
    if (request.element_size > 0) object.subdivision.element_size = request.element_size;
  }
  // Opens the module for images, which takes longer than refusing a scene.
  const auto fit =
      check_image_path(request.common.output.empty() ? solution_path(request, suffix + ".png") : request.common.output);
  if (!fit) return fit.error();
  if (const auto known = check_solution_paths(request.written); !known) return known.error();
  if (const auto free = check_outputs(outputs(request, suffix), file.files); !free) return free.error();
  return file;
}

Result<Done> check_memory(const fs::path& scene, const MemoryNeed& need) {
  const auto room = check_memory(need);
  if (!room) return Error{room.error().code, printable(scene.string()) + ": " + room.error().message};
  return Done{};
}

void tell_left_out(std::ostream& err, const SolutionRequest& request, const Scene& scene) {
  if (request.common.quiet) return;
  for (const std::string& line : left_out(scene)) err << "etendue solve: left out: " << line << '\n';
  const auto emits = [&](const Object& object) { return (scene.materials[object.material].emission > 0).any(); };
  if (std::none_of(scene.objects.begin(), scene.objects.end(), emits)) {
    err << "etendue solve: nothing emits: every radiosity is 0\n";
  }
}

Result<Image> drawn(const Scene& scene, const ElementMesh& mesh, const VertexRadiosities& vertices,
                    const SolutionRequest& request, std::ostream& err) {
  Progress progress(err, "picture", request.common);
  return view_radiosities(scene.camera, mesh, vertices, scene.background, request.samples,
                          execution(request.common, progress));
}

double linear_exposure(const ToneOptions& tone, double white_level) {
  return tone.is_linear() && tone.exposure > 0 ? tone.exposure : 1 / white_level;
}

Result<std::vector<NewFile>> encode_pictures(const SolutionFiles& files, const Shown& shown, const ToneMapping& mapping,
                                             ImageMetadata facts) {
  facts.emplace_back("etendue:values", "radiosity [W/m2]");
  auto exr = encode_image(files.exr, shown.radiosities, facts);
  if (!exr) return exr.error();
  facts.back().second =
      mapping.tone == ToneOperator::reinhard ? "radiosity times exposure, compressed" : "radiosity times exposure";
  add_facts(facts, mapping, shown.displayed.scale);
  auto png = encode_image(files.png, shown.displayed.picture, facts);
  if (!png) return png.error();
  return std::vector<NewFile>{std::move(exr).value(), std::move(png).value()};
}

Result<Done> write_pictures(const SolutionFiles& files, const Shown& shown, const ToneMapping& mapping,
                            const ImageMetadata& facts) {
  const auto both = encode_pictures(files, shown, mapping, facts);
  if (!both) return both.error();
  return write_files(*both);
}

Result<Done> write_solutions(const std::vector<fs::path>& files, const SolvedSurfaces& solved) {
  std::vector<NewFile> all;
  for (const fs::path& path : files) all.push_back(solution_file(path, solved));
  return write_files(all);
}

void print_files(std::ostream& out, const SolutionFiles& files) {
  for (const auto& path : {files.exr, files.png, files.json}) {
    if (!path.empty()) out << printable(path.string()) << '\n';
  }
  for (const auto& path : files.written) out << printable(path.string()) << '\n';
}

}  // namespace etendue::cli
