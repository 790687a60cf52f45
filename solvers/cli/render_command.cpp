// SPDX-License-Identifier: Apache-2.0
#include "render_command.hpp"

#include <algorithm>
#include <chrono>
#include <ostream>

#include "accelerator_option.hpp"
#include "cube_render.hpp"
#include "etendue/io/atomic_file.hpp"
#include "etendue/raytracing/preview.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"
#include "memory.hpp"
#include "outputs.hpp"
#include "progress.hpp"
#include "raster_render.hpp"
#include "ray_tree_output.hpp"
#include "render_report.hpp"
#include "stop.hpp"

namespace etendue::cli {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kName = "render";
/// At most at once: the picture, its copy for the PNG, which is exposed, and the bytes of the PNG.
constexpr double kBytesAPixel = 2 * sizeof(Rgb) + 3;
/// For each further fact a pixel, and what the EXR wants.
constexpr double kBytesAFact = sizeof(Rgb) + 3 * sizeof(float);
/// Squares of the preview, each pass a quarter of the last one's area.
constexpr int kPreviewSquares[] = {16, 8, 4, 2};
constexpr std::chrono::seconds kPreviewPause{1};

/// Refuses a picture that this machine cannot hold, before it is begun.
Result<Done> check_room(const RenderRequest& request, const Camera& camera) {
  const PixelWindow window = request.render.crop.value_or(PixelWindow{0, 0, camera.columns, camera.rows});
  const double bytes = (request.by_raster() ? kBytesAShadedPixel : 0) + kBytesAPixel +
                       kBytesAFact * static_cast<double>(request.render.facts.size());
  return check_memory(
      {static_cast<double>(window.columns()) * window.rows() * bytes,
       "a picture of " + std::to_string(window.columns()) + " × " + std::to_string(window.rows()) + " pixels needs",
       shortest(bytes) + " bytes a pixel", "make it smaller (--columns)"});
}

/// --ray-tree: the tree of the ray through a pixel's centre, as text or JSON, or, with --output NAME.dot, as a graph.
int explain_pixel(const RenderRequest& request, const Options& options, const SceneFile& file,
                  const Accelerator& accelerator, std::ostream& out, std::ostream& err) {
  const Scene& scene = file.scene;
  const auto pixel = read_pixel(*request.pixel, scene.camera);
  if (!pixel) {
    return options.usage_error(
        err, "option '--ray-tree': found '" + *request.pixel + "', expected COLUMN,ROW from 0,0 to " +
                 std::to_string(scene.camera.columns - 1) + "," + std::to_string(scene.camera.rows - 1));
  }
  const auto traced = pixel_tree(accelerator, *pixel, request.render.limits);
  if (!traced) return fail(err, kName, traced.error());
  const RayTree& tree = *traced;
  if (!request.common.output.empty()) {
    const auto written = write_file(request.common.output, to_dot(tree, scene));
    if (!written) return fail(err, kName, written.error());
  }
  if (request.common.json) {
    out << ray_tree_json(tree, file, *pixel, request.render.limits);
  } else if (request.common.output.empty()) {
    out << to_text(tree, scene);
  } else if (!request.common.quiet) {
    out << printable(request.common.output.string()) << '\n';
  }
  return 0;
}

/// Shows a coarse picture that becomes finer, then the rows that are done over it.
class Preview {
 public:
  Preview(const RenderRequest& request, const Accelerator& accelerator)
      : request_(request), accelerator_(accelerator) {}

  /// The passes before the picture itself is begun.
  Result<Done> begin(const Execution& execution) {
    Execution quiet = execution;
    quiet.progress = nullptr;
    for (const int step : kPreviewSquares) {
      const auto coarse = etendue::preview(accelerator_, request_.render, step, quiet);
      if (!coarse) return coarse.error();
      if (!*coarse) break;  // stopped
      image_ = **coarse;
      if (const auto written = write_preview(request_, image_); !written) return written;
    }
    last_ = Clock::now();
    return Done{};
  }

  void show(const Rendering& rendering) {
    if (!rendering.complete && Clock::now() - last_ < kPreviewPause) return;
    for (int row = 0; row < rendering.image.rows && image_.columns > 0; ++row) {
      if (!rendering.row_done[static_cast<std::size_t>(row)]) continue;
      for (int column = 0; column < rendering.image.columns; ++column)
        image_.at(column, row) = rendering.image.at(column, row);
    }
    if (image_.columns > 0 && failure_.ok()) failure_ = write_preview(request_, image_);
    last_ = Clock::now();
  }

  const Result<Done>& outcome() const { return failure_; }

 private:
  const RenderRequest& request_;
  const Accelerator& accelerator_;
  Image image_;
  Result<Done> failure_ = Done{};
  Clock::time_point last_{};
};

/// The rendering, from the start or from where a stopped run has left it.
Result<Rendering> rendered(const RenderRequest& request, const SceneFile& file, const Accelerator& accelerator,
                           std::ostream& err) {
  RenderSession session;
  Rendering before;
  std::error_code absent;
  const fs::path saved = render_files(request, false).saved;
  if (request.resume && !fs::exists(saved, absent)) {
    if (!request.common.quiet) err << "etendue render: nothing to resume: there is no " << quoted_path(saved) << '\n';
  } else if (request.resume) {
    auto read = read_saved(request, file);
    if (!read) return read.error();
    before = std::move(read).value();
    session.before = &before;
  }
  Progress progress(err, "render", request.common);  // wiped before anything is printed
  if (request.progress) progress.tell_tenths();
  const Execution how = execution(request.common, progress);
  Preview shown(request, accelerator);
  if (!request.preview.empty()) {
    if (const auto begun = shown.begin(how); !begun) return begun.error();
    session.watch = [&](const Rendering& rendering) { shown.show(rendering); };
  }
  auto rendering = etendue::render(accelerator, request.render, how, session);
  if (rendering.ok() && !shown.outcome().ok()) return shown.outcome().error();
  return rendering;
}

/// --method raytrace, with all options settled: renders, writes, reports; returns the exit code.
/// Warns of each material of an object that the rasteriser sees through, and no ray.
void tell_opaque_to_rays(const Scene& scene, std::ostream& err) {
  std::vector<std::string> warnings;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const Material& material = scene.materials[m];
    const bool used =
        std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& o) { return o.material == m; });
    if (!used || !material.see_through || material.k_t > 0) continue;
    warnings.push_back("rays do not see through '" + printable(material.name) +
                       "': its \"see_through\" is for --method raster, rays pass by \"k_t\"");
  }
  warn(err, kName, warnings);
}

int render_by_rays(const RenderRequest& request, const Options& options, const SceneFile& file, std::ostream& out,
                   std::ostream& err) {
  const auto made = named_accelerator(request.accelerator, file.scene);
  if (!made) return fail(err, kName, made.error());
  const Accelerator& accelerator = **made;
  if (!request.common.quiet) tell_opaque_to_rays(file.scene, err);
  if (request.pixel) return explain_pixel(request, options, file, accelerator, out, err);

  const auto begin = Clock::now();
  const auto rendering = rendered(request, file, accelerator, err);
  if (!rendering) return fail(err, kName, rendering.error());
  const std::chrono::duration<double> elapsed = Clock::now() - begin;
  if (!rendering->complete && request.cube)
    return fail(err, kName, {ErrorCode::stopped, "stopped; the images that were complete are kept"});
  const auto written = write_rendering(request, file, *rendering);
  if (!written) return fail(err, kName, written.error());

  if (request.common.json) {
    print_json(out, request, file, *rendering, *written, elapsed.count());
  } else if (!request.common.quiet) {
    print_text(out, request, file, *rendering, *written, elapsed.count());
  }
  if (rendering->complete) return 0;
  return fail(err, kName,
              {ErrorCode::stopped, "stopped; the rows that were done are in " + quoted_path(written->exr) +
                                       ", and --resume goes on from " + quoted_path(written->saved)});
}

std::vector<fs::path> all_outputs(const RenderRequest& request) {
  if (!request.cube) return render_outputs(request);
  std::vector<fs::path> all;
  for (const RenderRequest& face : cube_requests(request)) {
    const RenderFiles files = render_files(face, true);
    all.push_back(files.exr);
    all.push_back(files.png);
  }
  return all;
}

}  // namespace

int render(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  RenderRequest request;
  Options options(kName, "Render a scene by recursive ray tracing, or by rasteriser.");
  declare(options, request);
  if (const auto code = options.parse(arguments, out, err)) return *code;
  if (const auto complaint = settle(request)) return options.usage_error(err, *complaint);
  auto read = [&] {
    const NothingToSave reading;
    return read_scene(request.scene);
  }();
  if (!read) return fail(err, kName, read.error());
  SceneFile file = std::move(read).value();
  if (!request.common.quiet) warn(err, kName, file.warnings);
  if (!request.pixel) {  // opens the module for images, which takes longer than refusing a scene
    const fs::path picture = request.common.output.empty() ? render_files(request, true).png : request.common.output;
    if (const auto fit = check_image_path(picture); !fit) return fail(err, kName, fit.error());
  }
  if (const auto free = check_outputs(all_outputs(request), file.files); !free) return fail(err, kName, free.error());
  if (request.hide) {
    if (const auto hidden = hide(*request.hide, file.scene); !hidden) return fail(err, kName, hidden.error());
  }
  if (request.cube) file.scene.camera.rows = file.scene.camera.columns;
  if (const auto complaint = settle_size(request, file.scene.camera)) return options.usage_error(err, *complaint);
  if (!request.pixel) {
    if (const auto room = check_room(request, file.scene.camera); !room) {
      return fail(err, kName, {room.error().code, printable(request.scene.string()) + ": " + room.error().message});
    }
  }
  const auto picture = [&](const RenderRequest& each, const SceneFile& seen) {
    return each.by_raster() ? render_by_raster(each, seen, out, err) : render_by_rays(each, options, seen, out, err);
  };
  return request.cube ? render_cube(request, std::move(file), out, picture) : picture(request, file);
}

}  // namespace etendue::cli
