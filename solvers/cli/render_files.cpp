// SPDX-License-Identifier: Apache-2.0
#include "render_files.hpp"

#include <algorithm>
#include <bit>

#include "etendue/core/version.hpp"
#include "etendue/io/atomic_file.hpp"
#include "etendue/io/byte_text.hpp"
#include "etendue/io/image_file.hpp"
#include "etendue/raytracing/picture_facts.hpp"
#include "etendue/text/fingerprint.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"
#include "outputs.hpp"

namespace etendue::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "etendue-rendering-1\n";

ImageMetadata raster_metadata(const RenderRequest& request, const SceneFile& file) {
  return {{"etendue:version", version()},
          {"etendue:method", "rasteriser"},
          {"etendue:scene", file.scene.name},
          {"etendue:scene_hash", file.hash},
          {"etendue:shading", request.shading_text()},
          {"etendue:samples_per_side", std::to_string(request.render.sampling.samples_per_side)},
          {"etendue:wavelengths", std::to_string(request.render.wavelengths)}};
}

/// What identifies the picture; nothing that may differ between runs. So equal PNGs are equal files; an EXR's header also
/// has the time of writing (capDate), which OpenImageIO adds.
ImageMetadata metadata(const RenderRequest& request, const SceneFile& file, const Rendering& rendering) {
  const auto done = std::count(rendering.row_done.begin(), rendering.row_done.end(), char{1});
  const std::string rows = std::to_string(done) + " of " + std::to_string(rendering.row_done.size());
  if (request.by_raster()) return raster_metadata(request, file);
  ImageMetadata facts{{"etendue:version", version()},
                      {"etendue:method", "recursive ray tracing"},
                      {"etendue:scene", file.scene.name},
                      {"etendue:scene_hash", file.hash},
                      {"etendue:depth", std::to_string(request.render.limits.depth)},
                      {"etendue:cutoff", shortest(request.render.limits.cutoff)},
                      {"etendue:samples_per_side", std::to_string(request.render.sampling.samples_per_side)},
                      {"etendue:sampling", request.sampling_text()},
                      {"etendue:filter", request.filter_text()},
                      {"etendue:shadows", request.shadows},
                      {"etendue:wavelengths", std::to_string(request.render.wavelengths)},
                      {"etendue:rows", rows + (rendering.complete ? "" : " (incomplete: the others are black)")}};
  if (const auto& window = request.render.crop) {
    facts.emplace_back("etendue:crop", "columns " + std::to_string(window->left) + " to " +
                                           std::to_string(window->right - 1) + ", rows " + std::to_string(window->top) +
                                           " to " + std::to_string(window->bottom - 1) + " of " +
                                           std::to_string(file.scene.camera.columns) + " × " +
                                           std::to_string(file.scene.camera.rows));
  }
  return facts;
}

std::optional<ImagePlace> place(const RenderRequest& request, const SceneFile& file) {
  const auto& window = request.render.crop;
  if (!window) return std::nullopt;
  return ImagePlace{window->left, window->top, file.scene.camera.columns, file.scene.camera.rows};
}

/// The camera of --cube is not the scene's.
void add_eye(ImageMetadata& facts, const RenderRequest& request, const Camera& camera) {
  if (request.hide) facts.emplace_back("etendue:hidden", *request.hide);
  if (!request.cube_eye) return;
  const auto text = [](const Vec3& v) { return shortest(v.x()) + ", " + shortest(v.y()) + ", " + shortest(v.z()); };
  facts.emplace_back("etendue:cube", "from " + text(camera.eye) + " along " + text(camera.gaze));
}

std::vector<ImageChannel> channels(const RenderRequest& request, const Rendering& rendering) {
  std::vector<ImageChannel> all;
  for (std::size_t i = 0; i < rendering.facts.size(); ++i) {
    const auto names = channel_names(request.render.facts[i]);
    for (std::size_t k = 0; k < names.size(); ++k) {
      ImageChannel channel{names[k], {}};
      for (const Rgb& pixel : rendering.facts[i].pixels)
        channel.values.push_back(static_cast<float>(pixel[static_cast<Eigen::Index>(k)]));
      all.push_back(std::move(channel));
    }
  }
  return all;
}

/// What tells a saved state from those of other scenes and settings.
std::string identity(const RenderRequest& request, const SceneFile& file) {
  return std::string(version()) + ", scene " + file.hash + ", " + request.settings(file.scene.camera);
}

void append(std::string& bytes, const Image& image) {
  for (const Rgb& pixel : image.pixels) {
    for (Eigen::Index k = 0; k < 3; ++k) append_little(bytes, pixel[k]);
  }
}

/// The numbers of a row's counts, in a fixed order.
std::vector<std::uint64_t*> numbers(RenderCounts& counts) {
  return {&counts.eye_rays,     &counts.reflected_rays, &counts.transmitted_rays,
          &counts.shadow_rays,  &counts.tests.surfaces, &counts.tests.volumes,
          &counts.tests.voxels, &counts.cut_by_depth,   &counts.cut_by_cutoff};
}

std::string state_of(const RenderRequest& request, const SceneFile& file, const Rendering& rendering) {
  std::string bytes(kMagic);
  const std::string who = identity(request, file);
  append_little(bytes, static_cast<std::uint64_t>(who.size()));
  bytes += who;
  bytes.append(rendering.row_done.begin(), rendering.row_done.end());
  append(bytes, rendering.image);
  for (const Image& fact : rendering.facts) append(bytes, fact);
  for (RowCounts row : rendering.row_counts) {
    for (RenderCounts* counts : {&row.begun, &row.completed}) {
      for (const std::uint64_t* number : numbers(*counts)) append_little(bytes, *number);
      append_little(bytes, counts->largest_cut_weight);
    }
  }
  append_little(bytes, Fingerprint().add(bytes).value());
  return bytes;
}

/// Takes numbers from the front of bytes that were checked to be enough.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  std::uint64_t integer() {
    const auto value = read_little<std::uint64_t>(rest_);
    rest_.remove_prefix(8);
    return value;
  }
  double real() { return std::bit_cast<double>(integer()); }
  std::string_view text(std::size_t size) {
    const std::string_view front = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return front;
  }
  void image(Image& image) {
    for (Rgb& pixel : image.pixels) {
      for (Eigen::Index k = 0; k < 3; ++k) pixel[k] = real();
    }
  }

 private:
  std::string_view rest_;
};

Error unfit(const fs::path& path, const std::string& what) {
  return {ErrorCode::invalid_input, quoted_path(path) + ": " + what};
}

}  // namespace

RenderFiles render_files(const RenderRequest& request, bool complete) {
  const std::string stem = output_stem(request.common.output, request.scene).string();
  const std::string name = stem + (complete ? "" : ".incomplete");
  RenderFiles files{name + ".exr", name + ".png", stem + ".resume", 1, {}, {}, {}};
  if (request.line) files.svg = name + ".row-" + std::to_string(request.line->row) + ".svg";
  return files;
}

std::vector<fs::path> render_outputs(const RenderRequest& request) {
  if (request.pixel)
    return request.common.output.empty() ? std::vector<fs::path>{} : std::vector{request.common.output};
  const RenderFiles whole = render_files(request, true), stopped = render_files(request, false);
  std::vector<fs::path> all{whole.exr, whole.png, stopped.exr, stopped.png, whole.saved};
  if (!request.preview.empty()) all.push_back(request.preview);
  for (const fs::path& svg : {whole.svg, stopped.svg}) {
    if (!svg.empty()) all.push_back(svg);
  }
  return all;
}

Result<RenderFiles> write_rendering(const RenderRequest& request, const SceneFile& file, const Rendering& rendering) {
  RenderFiles files = render_files(request, rendering.complete);
  ImageMetadata facts = metadata(request, file, rendering);
  add_eye(facts, request, file.scene.camera);
  const auto exr = encode_image(files.exr, rendering.image, facts, channels(request, rendering), place(request, file));
  if (!exr) return exr.error();
  const ToneMapping how = mapping(request.tone, 1);
  const ToneMapped displayed = tone_mapped(rendering.image, how);
  add_facts(facts, how, displayed.scale);
  files.scale = displayed.scale;
  files.bright = brightness(displayed.picture);
  facts.emplace_back("etendue:overflow", request.overflow);
  // What an exposure has made infinite is refused as it is, by name of its pixel.
  const auto& pixels = displayed.picture.pixels;
  const bool finite = std::all_of(pixels.begin(), pixels.end(), [](const Rgb& p) { return p.isFinite().all(); });
  const auto png = encode_image(
      files.png, finite ? limited(displayed.picture, request.overflow_treatment()) : displayed.picture, facts);
  if (!png) return png.error();
  std::vector<NewFile> all{*exr, *png};
  if (request.line) {
    const ScanLine line = scan_line(rendering.image, request.line->row, request.line->first, request.line->last);
    files.jumps = jumps(line.intensities);
    all.push_back({files.svg, to_svg(line)});
  }
  if (!rendering.complete) all.push_back({files.saved, state_of(request, file, rendering)});
  if (const auto written = write_files(all); !written) return written.error();
  if (rendering.complete && request.resume) {
    const RenderFiles stopped = render_files(request, false);
    std::error_code absent;
    for (const fs::path& path : {stopped.exr, stopped.png, stopped.saved}) fs::remove(path, absent);
  }
  return files;
}

Result<Rendering> read_saved(const RenderRequest& request, const SceneFile& file) {
  const fs::path path = render_files(request, false).saved;
  const auto read = read_file(path);
  if (!read) return read.error();
  const std::string& bytes = *read;
  if (bytes.compare(0, kMagic.size(), kMagic) != 0 || bytes.size() < kMagic.size() + 16)
    return unfit(path, "not what a stopped etendue render has saved");
  Reader reader(bytes);
  (void)reader.text(kMagic.size());
  const std::uint64_t size = reader.integer();
  const std::string_view body = std::string_view(bytes).substr(0, bytes.size() - 8);
  if (Fingerprint().add(body).value() != Reader(std::string_view(bytes).substr(body.size())).integer() ||
      size > bytes.size())
    return unfit(path, "damaged");
  const std::string_view who = reader.text(size);
  const std::string asked = identity(request, file);
  if (who != asked) {
    return unfit(path, "saved from another scene or by other settings: " + printable(std::string(who)) +
                           "; asked for: " + printable(asked));
  }
  const Camera& camera = file.scene.camera;
  const PixelWindow window = request.render.crop.value_or(PixelWindow{0, 0, camera.columns, camera.rows});
  Rendering saved;
  saved.image = Image(window.columns(), window.rows());
  saved.facts.assign(request.render.facts.size(), saved.image);
  saved.row_counts.resize(static_cast<std::size_t>(camera.rows));
  const std::string_view done = reader.text(static_cast<std::size_t>(window.rows()));
  saved.row_done.assign(done.begin(), done.end());
  reader.image(saved.image);
  for (Image& fact : saved.facts) reader.image(fact);
  for (RowCounts& row : saved.row_counts) {
    for (RenderCounts* counts : {&row.begun, &row.completed}) {
      for (std::uint64_t* number : numbers(*counts)) *number = reader.integer();
      counts->largest_cut_weight = reader.real();
    }
  }
  return saved;
}

Result<Done> write_preview(const RenderRequest& request, const Image& image) {
  const auto png = encode_image(request.preview, tone_mapped(image, mapping(request.tone, 1)).picture);
  if (!png) return png.error();
  return write_files({*png});
}

}  // namespace etendue::cli
