// SPDX-License-Identifier: Apache-2.0
#include "view_command.hpp"

#include <chrono>
#include <map>
#include <ostream>

#include "etendue/core/version.hpp"
#include "etendue/image/exposure.hpp"
#include "etendue/io/atomic_file.hpp"
#include "etendue/meshing/shared_vertices.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"
#include "etendue/view/gathered_view.hpp"
#include "etendue/view/mesh_lines.hpp"
#include "etendue/view/radiosity_view.hpp"
#include "etendue/view/traced_view.hpp"
#include "outputs.hpp"
#include "progress.hpp"
#include "report_json.hpp"
#include "stop.hpp"
#include "view_request.hpp"

namespace etendue::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "view";

struct View {
  NamedCamera camera;
  SolutionFiles files;
  ToneMapping how;
  double scale = 1;
  Brightness bright;
};

/// The solution on the mesh that is shown, and what to draw.
struct Prepared {
  SavedSolution solution;
  ElementMesh shown;
  VertexRadiosities vertices;
  RadiosityField field;  ///< on the solution's own mesh, for --method gather
  double exposure = 1;
  std::vector<View> views;
};

fs::path with_ending(const fs::path& stem, const std::string& ending) {
  return fs::path(stem.string() + ending);
}

/// The pictures' names: an --output for each, or one that all begin with.
Result<Done> name_views(const ViewRequest& request, std::vector<View>& views) {
  const std::size_t count = request.outputs.size();
  if (count > 1 && count != views.size()) {
    return Error{ErrorCode::usage, counted(count, "--output") + " for " + counted(views.size(), "camera") +
                                       "; expected one for each, or one in all"};
  }
  std::map<std::string, std::size_t> taken;
  for (std::size_t k = 0; k < views.size(); ++k) {
    fs::path stem = request.solution.stem().string() + "-view";
    if (count > 0) stem = fs::path(request.outputs[count == 1 ? 0 : k]).replace_extension();
    if (count <= 1 && views.size() > 1) stem += "-" + views[k].camera.name;
    if (!taken.emplace(stem.string(), k).second) {
      return Error{ErrorCode::usage, "two pictures would be named " + quoted_path(with_ending(stem, ".png"))};
    }
    views[k].files.exr = with_ending(stem, ".exr");
    views[k].files.png = with_ending(stem, ".png");
  }
  return Done{};
}

/// Can all pictures be written, over no file that is read, and held?
Result<Done> check(const ViewRequest& request, const Prepared& prepared, const std::vector<fs::path>& inputs) {
  std::vector<fs::path> all;
  double most = 0;
  for (const View& one : prepared.views) {
    all.push_back(one.files.exr);
    all.push_back(one.files.png);
    most = std::max(most, static_cast<double>(one.camera.camera.columns) * one.camera.camera.rows);
  }
  if (request.outputs.empty()) {
    if (const auto fit = check_image_path(all.back()); !fit) return fit.error();
  }
  for (const auto& path : request.outputs) {
    if (const auto fit = check_image_path(path); !fit) return fit.error();
  }
  if (const auto free = check_outputs(all, inputs); !free) return free.error();
  const double samples = request.method == "raster" ? request.samples * request.samples : 1;
  const double bytes_a_pixel =
      (sizeof(Rgb) + 8) * samples + 3 * sizeof(Rgb);  // samples with their depths; the pictures
  return check_memory({most * bytes_a_pixel, "a picture of " + shortest(most) + " pixels needs",
                       shortest(bytes_a_pixel) + " bytes a pixel", "make it smaller (--resolution, --samples)"});
}

/// Everything that can be wrong is found here, before anything is drawn.
Result<Prepared> prepared(const ViewRequest& request) {
  Prepared result;
  const NothingToSave reading;
  auto solution = read_saved_solution(request.solution);
  if (!solution) return solution.error();
  result.solution = std::move(solution).value();
  const SavedSolution& saved = result.solution;
  std::vector<fs::path> inputs = request.cameras;
  inputs.push_back(request.solution);
  if (!request.scene.empty()) {
    const auto scene = read_scene(request.scene);
    if (!scene) return scene.error();
    if (scene->hash != saved.hash) {
      return Error{ErrorCode::invalid_input, quoted_path(request.solution) + ": a solution of another scene than " +
                                                 quoted_path(request.scene) +
                                                 ", or of it before it was changed (hash " + saved.hash +
                                                 ", the scene's is " + scene->hash + "); solve it again"};
    }
    inputs.insert(inputs.end(), scene->files.begin(), scene->files.end());
  }
  if (request.ambient && (saved.ambient == 0).all()) {
    return Error{ErrorCode::invalid_input,
                 quoted_path(request.solution) + ": it holds no ambient term; 'etendue solve --ambient' finds it"};
  }
  const auto cameras = cameras_of(request, saved.scene);
  if (!cameras) return cameras.error();
  for (const NamedCamera& camera : *cameras) result.views.push_back({camera, {}, {}, 1, {}});
  if (const auto named = name_views(request, result.views); !named) return named.error();
  if (const auto good = check(request, result, inputs); !good) return good.error();
  return result;
}

/// Values at the corners, as solve shows them, and the exposure that all views share.
void prepare_view(const ViewRequest& request, Prepared& prepared) {
  const SavedSolution& saved = prepared.solution;
  prepared.shown = with_shared_vertices(saved.mesh);
  std::vector<Rgb> values = saved.radiosity;
  for (std::size_t k = 0; request.ambient && k < values.size(); ++k) {
    values[k] += saved.scene.materials[saved.mesh.face_of(saved.mesh.elements[k]).material].rho * saved.ambient;
  }
  prepared.vertices = vertex_radiosities(prepared.shown, values, saved.covered);
  const double white = white_level(saved.scene, prepared.shown, prepared.vertices);
  prepared.exposure = saved.exposure > 0 ? saved.exposure : 1 / white;
  if (request.method == "gather") {
    prepared.field = linear_field(saved.mesh, saved.radiosity, saved.covered, Rgb(Rgb::Zero()));
  }
}

const char* drawn_by(const ViewRequest& request) {
  if (request.method == "gather") return "; final gather";
  return request.method == "raster" ? "; Gouraud" : "; Gouraud, by rays";
}

ImageMetadata metadata(const ViewRequest& request, const Prepared& prepared, const View& one) {
  const SavedSolution& saved = prepared.solution;
  ImageMetadata facts{{"etendue:version", version()},
                      {"etendue:method", saved.method + (saved.finished ? "" : " (stopped)") + drawn_by(request)},
                      {"etendue:scene", saved.scene.name},
                      {"etendue:scene_hash", saved.hash},
                      {"etendue:samples_per_side", std::to_string(request.samples)}};
  if (!one.camera.name.empty()) facts.emplace_back("etendue:camera", one.camera.name);
  if (request.ambient) facts.emplace_back("etendue:ambient", "added");
  return facts;
}

Result<Image> picture_of(const ViewRequest& request, const Prepared& prepared, const Camera& camera,
                         const Execution& how) {
  const SavedSolution& saved = prepared.solution;
  const Rgb& background = saved.scene.background;
  if (request.method == "gather") {
    return gather_radiosities(camera, saved.scene, saved.mesh, prepared.field, background, request.samples, how);
  }
  if (request.method == "raytrace") {
    return trace_radiosities(camera, prepared.shown, prepared.vertices, background, request.samples, how);
  }
  return view_radiosities(camera, prepared.shown, prepared.vertices, background, request.samples, how);
}

/// One picture, as two files.
Result<std::vector<NewFile>> drawn(const ViewRequest& request, const Prepared& prepared, View& one, std::ostream& err) {
  Progress progress(err, one.camera.name.empty() ? "picture" : one.camera.name, request.common);
  const Execution how = execution(request.common, progress);
  const Camera& camera = one.camera.camera;
  auto picture = picture_of(request, prepared, camera, how);
  if (!picture) return picture.error();
  one.how = mapping(request.tone, prepared.exposure);
  Shown shown{std::move(picture).value(), {}};
  shown.displayed = tone_mapped(shown.radiosities, one.how);
  one.scale = shown.displayed.scale;
  one.bright = brightness(shown.displayed.picture);
  if (request.draw_mesh) {
    const auto lines = mesh_lines(camera, prepared.solution.mesh, request.samples);
    if (!lines) return lines.error();
    shown.displayed.picture = drawn_over(shown.displayed.picture, *lines, 1);
  }
  return encode_pictures(one.files, shown, one.how, metadata(request, prepared, one));
}

void print_json(std::ostream& out, const ViewRequest& request, const Prepared& prepared, double seconds) {
  const SavedSolution& saved = prepared.solution;
  Json json;
  json["program"] = std::string("etendue ") + version();
  json["solution"] = request.solution.string();
  json["scene"] = {{"name", saved.scene.name}, {"hash", saved.hash}};
  json["solved_by"] = saved.method;
  json["finished"] = saved.finished;
  json["elements"] = saved.mesh.elements.size();
  json["method"] = request.method;
  json["pictures"] = Json::array();
  for (const View& one : prepared.views) {
    json["pictures"].push_back({{"camera", one.camera.name},
                                {"resolution", {one.camera.camera.columns, one.camera.camera.rows}},
                                {"exr", one.files.exr.string()},
                                {"png", one.files.png.string()},
                                {"tone", tone_text(one.how)},
                                {"exposure", one.scale},
                                {"pixels_cut", one.bright.overflow}});
  }
  json["seconds"] = seconds;
  out << dumped(json) << '\n';
}

void print_text(std::ostream& out, const Prepared& prepared, double seconds) {
  const SavedSolution& saved = prepared.solution;
  out << "scene        " << (saved.scene.name.empty() ? "(no name)" : printable(saved.scene.name)) << ", hash "
      << printable(saved.hash) << '\n'
      << "solution     " << printable(saved.method) << ", " << counted(saved.mesh.elements.size(), "element")
      << (saved.finished ? "" : "; stopped, what there was so far") << '\n';
  for (const View& one : prepared.views) {
    const Camera& camera = one.camera.camera;
    out << "picture      " << (one.camera.name.empty() ? "" : one.camera.name + ", ") << camera.columns << " × "
        << camera.rows << " pixels; " << tone_text(one.how) << ", exposure " << rounded(one.scale) << "; "
        << counted(one.bright.overflow, "pixel") << " brighter than white\n";
  }
  out << "time         " << rounded(seconds) << " s\n";
  for (const View& one : prepared.views) print_files(out, one.files);
}

}  // namespace

int view(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  ViewRequest request;
  Options options(kName, "Show a saved radiosity solution from any side, without solving again.");
  declare(options, request);
  if (const auto code = options.parse(arguments, out, err)) return *code;
  if (const auto wrong = contradiction(request)) return options.usage_error(err, *wrong);
  const auto begin = std::chrono::steady_clock::now();
  auto start = prepared(request);
  if (!start) return fail(err, kName, start.error());
  Prepared all = std::move(start).value();
  prepare_view(request, all);
  std::vector<NewFile> files;
  for (View& one : all.views) {
    auto both = drawn(request, all, one, err);
    if (!both) {
      const bool stopped = both.error().code == ErrorCode::stopped;
      return fail(err, kName, stopped ? Error{ErrorCode::stopped, "stopped; no picture was written"} : both.error());
    }
    for (const NewFile& file : *both) files.push_back(file);
  }
  if (const auto written = write_files(files); !written) return fail(err, kName, written.error());
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (request.common.json) {
    print_json(out, request, all, seconds);
  } else if (!request.common.quiet) {
    print_text(out, all, seconds);
  }
  return 0;
}

}  // namespace etendue::cli
