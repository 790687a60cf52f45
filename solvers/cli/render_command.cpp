// SPDX-License-Identifier: Apache-2.0
#include "render_command.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ostream>

#include "etendue/core/version.hpp"
#include "etendue/image/exposure.hpp"
#include "etendue/io/atomic_file.hpp"
#include "etendue/io/image_file.hpp"
#include "etendue/io/scene_reader.hpp"
#include "etendue/raytracing/camera_rays.hpp"
#include "etendue/raytracing/render.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"
#include "memory.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "progress.hpp"
#include "ray_tree_output.hpp"
#include "report_json.hpp"
#include "stop.hpp"
#include "tone_options.hpp"

namespace etendue::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "render";
constexpr int kMostBounces = 1000;  // a ray tree is followed by recursion: deeper ones would need a larger stack
constexpr int kMostSamples = 64;    // a side, 4,096 a pixel
constexpr int kMostColumns = 1 << 14;
constexpr double kMostPixels = 1 << 28;  // as many as a scene's "resolution" may have
/// At most at once: the picture, its copy for the PNG, which is exposed, and the bytes of the PNG.
constexpr double kBytesAPixel = 2 * sizeof(Rgb) + 3;

struct Request {
  CommonOptions common;
  fs::path scene;
  RenderOptions render;
  std::string accelerator = "bvh";
  ToneOptions tone;
  std::optional<std::string> pixel;  ///< of --ray-tree, as typed
  int columns = 0;                   ///< 0: as the scene says
};

/// What identifies the picture; nothing that may differ between runs. So equal PNGs are equal files; an EXR's header also
/// has the time of writing (capDate), which OpenImageIO adds.
ImageMetadata metadata(const Request& request, const SceneFile& file, const Rendering& rendering) {
  const auto done = std::count(rendering.row_done.begin(), rendering.row_done.end(), char{1});
  const std::string rows = std::to_string(done) + " of " + std::to_string(rendering.row_done.size());
  return {{"etendue:version", version()},
          {"etendue:method", "recursive ray tracing"},
          {"etendue:scene", file.scene.name},
          {"etendue:scene_hash", file.hash},
          {"etendue:depth", std::to_string(request.render.limits.depth)},
          {"etendue:cutoff", shortest(request.render.limits.cutoff)},
          {"etendue:samples_per_side", std::to_string(request.render.samples_per_side)},
          {"etendue:rows", rows + (rendering.complete ? "" : " (incomplete: the others are black)")}};
}

struct Written {
  fs::path exr, png;
  double scale = 1;   ///< what the PNG's values are multiplied by
  Brightness bright;  ///< of the PNG, before values above 1 are cut
};

/// The pictures' names, when complete or when stopped.
Written names(const Request& request, bool complete) {
  const std::string name = output_stem(request.common.output, request.scene).string() + (complete ? "" : ".incomplete");
  return {name + ".exr", name + ".png", 1, {}};
}

/// All files that this run may write.
std::vector<fs::path> outputs(const Request& request) {
  if (request.pixel)
    return request.common.output.empty() ? std::vector<fs::path>{} : std::vector{request.common.output};
  const Written whole = names(request, true), stopped = names(request, false);
  return {whole.exr, whole.png, stopped.exr, stopped.png};
}

Result<Written> write_pictures(const Request& request, const SceneFile& file, const Rendering& rendering) {
  Written written = names(request, rendering.complete);
  ImageMetadata facts = metadata(request, file, rendering);
  const auto exr = encode_image(written.exr, rendering.image, facts);
  if (!exr) return exr.error();
  const ToneMapping how = mapping(request.tone, 1);
  const ToneMapped displayed = tone_mapped(rendering.image, how);
  add_facts(facts, how, displayed.scale);
  written.scale = displayed.scale;
  written.bright = brightness(displayed.picture);
  const auto png = encode_image(written.png, displayed.picture, facts);
  if (!png) return png.error();
  if (const auto both = write_files({*exr, *png}); !both) return both.error();
  return written;
}

double per_ray(std::uint64_t tests, const RenderCounts& counts) {
  return counts.rays() == 0 ? 0 : static_cast<double>(tests) / static_cast<double>(counts.rays());
}

void print_text(std::ostream& out, const Request& request, const SceneFile& file, const Rendering& rendering,
                const Written& written, double seconds) {
  const RenderCounts& counts = rendering.counts;
  const TreeLimits& limits = request.render.limits;
  const int side = request.render.samples_per_side;
  const Brightness& bright = written.bright;
  const ToneMapping how = mapping(request.tone, 1);
  out << "scene       " << scene_line(file) << '\n'
      << "picture     " << rendering.image.columns << " × " << rendering.image.rows << " pixels, " << side << " × "
      << side << " rays a pixel, depth " << limits.depth << ", cutoff " << shortest(limits.cutoff) << '\n'
      << "rays        " << counts.eye_rays << " from the eye, " << counts.reflected_rays << " reflected, "
      << counts.transmitted_rays << " transmitted, " << counts.shadow_rays << " to lights\n"
      << "tests       " << rounded(per_ray(counts.tests.surfaces, counts)) << " surfaces and "
      << rounded(per_ray(counts.tests.volumes, counts)) << " boxes a ray, by " << request.accelerator << '\n'
      << "left out    " << counts.cut_by_depth << " rays by depth, " << counts.cut_by_cutoff
      << " by cutoff; together at most " << rounded(counts.largest_cut_weight) << " of the weight of a sample\n"
      << "brightness  " << rounded(bright.largest) << " at most";
  if (bright.overflow > 0) {
    out << "; " << counted(bright.overflow, "pixel") << (bright.overflow == 1 ? " is" : " are")
        << " cut off in the PNG (";
    if (how.tone == ToneOperator::reinhard) {
      out << "a smaller --exposure would show them)";
    } else {
      out << "--exposure " << rounded(how.exposure / bright.largest) << " would show them)";
    }
  }
  out << "\ntime        " << rounded(seconds) << " s\n"
      << printable(written.exr.string()) << '\n'
      << printable(written.png.string()) << '\n';
}

void print_json(std::ostream& out, const Request& request, const SceneFile& file, const Rendering& rendering,
                const Written& written, double seconds) {
  const RenderCounts& counts = rendering.counts;
  const Brightness bright = brightness(rendering.image);
  Json report;
  report["program"] = std::string("etendue ") + version();
  report["scene"] = {{"file", request.scene.string()}, {"name", file.scene.name}, {"hash", file.hash}};
  report["settings"] = {{"depth", request.render.limits.depth},
                        {"cutoff", request.render.limits.cutoff},
                        {"samples_per_side", request.render.samples_per_side},
                        {"accelerator", request.accelerator},
                        {"exposure", written.scale},
                        {"tone", tone_text(mapping(request.tone, 1))}};
  report["picture"] = {{"columns", rendering.image.columns}, {"rows", rendering.image.rows},
                       {"complete", rendering.complete},     {"largest_value", bright.largest},
                       {"exr", written.exr.string()},        {"png", written.png.string()}};
  report["rays"] = {{"eye", counts.eye_rays},
                    {"reflected", counts.reflected_rays},
                    {"transmitted", counts.transmitted_rays},
                    {"shadow", counts.shadow_rays}};
  report["tests"] = {{"surfaces", counts.tests.surfaces}, {"boxes", counts.tests.volumes}};
  report["left_out"] = {{"by_depth", counts.cut_by_depth},
                        {"by_cutoff", counts.cut_by_cutoff},
                        {"largest_weight", counts.largest_cut_weight}};
  report["seconds"] = seconds;
  out << dumped(report, 2) << '\n';
}

/// Gives the picture so many columns, and rows in proportion, at least one; or says why that cannot be.
std::optional<std::string> resize(Camera& camera, int columns) {
  const double rows = std::max(1.0, std::round(static_cast<double>(columns) * camera.rows / camera.columns));
  if (columns * rows > kMostPixels) {
    return "option '--columns': found '" + std::to_string(columns) +
           "', expected at most 2^28 pixels in all; in the scene's proportions these are " + std::to_string(columns) +
           " × " + shortest(rows);
  }
  camera.columns = columns;
  camera.rows = static_cast<int>(rows);  // at most 2^28
  return std::nullopt;
}

/// Refuses a picture that this machine cannot hold, before it is begun.
Result<Done> check_room(const Camera& camera) {
  return check_memory(
      {static_cast<double>(camera.columns) * camera.rows * kBytesAPixel,
       "a picture of " + std::to_string(camera.columns) + " × " + std::to_string(camera.rows) + " pixels needs",
       shortest(kBytesAPixel) + " bytes a pixel", "make it smaller (--columns)"});
}

/// What --ray-tree does not go with, if asked for.
std::optional<std::string> misuse(const Request& request) {
  if (!request.pixel || request.common.output.empty() || request.common.output.extension() == ".dot")
    return std::nullopt;
  return "option '--output': found '" + request.common.output.string() +
         "', expected a name that ends in .dot, since --ray-tree makes a graph";
}

/// --ray-tree: the tree of the ray through a pixel's centre, as text or JSON, or, with --output NAME.dot, as a graph.
int explain_pixel(const Request& request, const Options& options, const SceneFile& file, const Accelerator& accelerator,
                  std::ostream& out, std::ostream& err) {
  const Scene& scene = file.scene;
  const auto pixel = read_pixel(*request.pixel, scene.camera);
  if (!pixel) {
    return options.usage_error(
        err, "option '--ray-tree': found '" + *request.pixel + "', expected COLUMN,ROW from 0,0 to " +
                 std::to_string(scene.camera.columns - 1) + "," + std::to_string(scene.camera.rows - 1));
  }
  const auto frame = camera_frame(scene.camera);
  if (!frame) return fail(err, kName, frame.error());
  const Ray ray = eye_ray(*frame, picture_point(scene.camera, pixel->column, pixel->row));
  const RayTree tree = trace(ray, accelerator, request.render.limits);
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

AcceleratorKind accelerator_named(const std::string& name) {
  if (name == "spheres") return AcceleratorKind::bounding_spheres;
  if (name == "grid") return AcceleratorKind::grid;
  if (name == "octree") return AcceleratorKind::octree;
  return name == "brute" ? AcceleratorKind::brute_force : AcceleratorKind::bounding_volumes;
}

void declare(Options& options, Request& request) {
  options.argument("SCENE", "scene file (JSON)", request.scene);
  options.integer("--depth", "D", "greatest level of a ray; rays from the eye are of level 0 (default: 12)",
                  request.render.limits.depth, 0, kMostBounces);
  options.real("--cutoff", "C", "do not follow rays whose weight in the pixel is below C (default: 0, follow all)",
               request.render.limits.cutoff, 0, 1);
  options.integer("--samples", "N", "N × N rays a pixel (default: 2)", request.render.samples_per_side, 1,
                  kMostSamples);
  options.integer("--columns", "N", "make the picture N pixels wide, in the scene's proportions (default: the scene's)",
                  request.columns, 1, kMostColumns);
  options.choice("--accelerator", {"bvh", "spheres", "grid", "octree", "brute"},
                 "how surfaces are found: hierarchy of boxes, of spheres, grid, octree, or every one; same picture "
                 "(default: bvh)",
                 request.accelerator);
  add_tone(options, request.tone, "1");
  options.text("--ray-tree", "COLUMN,ROW",
               "no picture: print the tree of rays of one pixel, also as --json (--output NAME.dot: draw it)",
               request.pixel);
  add_common(options, request.common,
             "NAME.exr or NAME.png: both are written (default: the scene's name, in this folder)");
  options.note(
      "The EXR holds linear values and, like the PNG, says in its metadata how it was made. After Ctrl-C the rows "
      "that\n"
      "are done are saved as NAME.incomplete.exr and .png, and the exit code is 6.");
  options.example("etendue render scenes/mirrors/scene.json --output mirrors.png");
  options.example("etendue render scenes/mirrors/scene.json --depth 1 --samples 1 --json --output mirrors-1.png");
  options.example("etendue render scenes/mirrors/scene.json --ray-tree 250,200");
}

}  // namespace

int render(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  Request request;
  request.render.limits.depth = 12;
  request.render.samples_per_side = 2;
  Options options(kName, "Render a scene by recursive ray tracing.");
  declare(options, request);
  if (const auto code = options.parse(arguments, out, err)) return *code;
  if (const auto complaint = misuse(request)) return options.usage_error(err, *complaint);
  if (const auto complaint = contradiction(request.tone)) return options.usage_error(err, *complaint);
  auto read = [&] {
    const NothingToSave reading;
    return read_scene(request.scene);
  }();
  if (!read) return fail(err, kName, read.error());
  SceneFile file = std::move(read).value();
  if (!request.pixel) {  // opens the module for images, which takes longer than refusing a scene
    const fs::path picture = request.common.output.empty() ? names(request, true).png : request.common.output;
    if (const auto fit = check_image_path(picture); !fit) return fail(err, kName, fit.error());
  }
  if (const auto free = check_outputs(outputs(request), file.files); !free) return fail(err, kName, free.error());
  if (request.columns > 0) {
    if (const auto complaint = resize(file.scene.camera, request.columns)) return options.usage_error(err, *complaint);
  }
  if (!request.pixel) {
    if (const auto room = check_room(file.scene.camera); !room) {
      return fail(err, kName, {room.error().code, printable(request.scene.string()) + ": " + room.error().message});
    }
  }
  const auto accelerator = make_accelerator(file.scene, accelerator_named(request.accelerator));
  if (request.pixel) return explain_pixel(request, options, file, *accelerator, out, err);

  const auto begin = std::chrono::steady_clock::now();
  const auto rendering = [&] {
    Progress progress(err, "render", request.common);  // wiped before anything is printed
    return etendue::render(*accelerator, request.render, execution(request.common, progress));
  }();
  if (!rendering) return fail(err, kName, rendering.error());
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  const auto written = write_pictures(request, file, *rendering);
  if (!written) return fail(err, kName, written.error());

  if (request.common.json) {
    print_json(out, request, file, *rendering, *written, elapsed.count());
  } else if (!request.common.quiet) {
    print_text(out, request, file, *rendering, *written, elapsed.count());
  }
  if (rendering->complete) return 0;
  return fail(err, kName, {ErrorCode::stopped, "stopped; the rows that were done are in " + quoted_path(written->exr)});
}

}  // namespace etendue::cli
