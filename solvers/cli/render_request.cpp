// SPDX-License-Identifier: Apache-2.0
#include "render_request.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <sstream>
#include <vector>

#include "etendue/raytracing/picture_facts.hpp"
#include "etendue/text/number_text.hpp"

namespace etendue::cli {

namespace {

constexpr double kMostPixels = 1 << 28;  // as many as a scene's "resolution" may have
constexpr int kLongestSide = 65536;      // of a scene's "resolution"
constexpr double kUsualCreaseDeg = 60;   // of TessellationOptions
constexpr double kFarthestCube = 1e50;   // as coordinates of scenes
constexpr int kUsualSamples = 2, kUsualAdaptiveSamples = 4;

std::vector<std::string> parts(const std::string& text, char separator) {
  std::vector<std::string> all;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, separator);) all.push_back(word);
  if (text.empty() || text.back() == separator) all.emplace_back();
  return all;
}

template <class Number>
std::optional<Number> number(const std::string& text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || rest != end) return std::nullopt;
  return value;
}

template <class Number>
std::optional<std::vector<Number>> numbers(const std::string& text, char separator) {
  std::vector<Number> all;
  for (const std::string& part : parts(text, separator)) {
    const auto value = number<Number>(part);
    if (!value) return std::nullopt;
    all.push_back(*value);
  }
  return all;
}

std::string unlike(const std::string& option, const std::string& found, const std::string& expected) {
  return "option '" + option + "': found '" + found + "', expected " + expected;
}

std::optional<std::string> read_threshold(RenderRequest& request) {
  Sampling& sampling = request.render.sampling;
  if (!request.threshold) return std::nullopt;
  const auto values = numbers<double>(*request.threshold, ',');
  const bool fit = values && (values->size() == 1 || values->size() == 3) &&
                   std::all_of(values->begin(), values->end(), [](double v) { return v >= 0 && v <= 1; });
  if (!fit) return unlike("--threshold", *request.threshold, "a contrast in [0, 1], or three: R,G,B");
  for (Eigen::Index i = 0; i < 3; ++i)
    sampling.threshold[i] = (*values)[values->size() == 1 ? 0 : static_cast<std::size_t>(i)];
  return std::nullopt;
}

std::optional<std::string> read_facts(RenderRequest& request) {
  request.render.facts.clear();
  if (!request.facts) return std::nullopt;
  std::string known;
  for (const PictureFact fact : all_picture_facts()) known += (known.empty() ? "" : ", ") + name(fact);
  for (const std::string& word : parts(*request.facts, ',')) {
    const auto& all = all_picture_facts();
    const auto found = std::find_if(all.begin(), all.end(), [&](PictureFact fact) { return name(fact) == word; });
    auto& chosen = request.render.facts;
    if (word == "all") {
      chosen = all;
    } else if (found == all.end()) {
      return unlike("--aov", *request.facts, "some of " + known + ", or all, with commas between them");
    } else if (std::find(chosen.begin(), chosen.end(), *found) == chosen.end()) {
      chosen.push_back(*found);
    }
  }
  return std::nullopt;
}

std::optional<std::string> read_cube(RenderRequest& request) {
  if (!request.cube) return std::nullopt;
  const auto place = numbers<double>(*request.cube, ',');
  const auto is_coordinate = [](double x) { return std::abs(x) <= kFarthestCube; };  // refuses NaN too
  if (!place || place->size() != 3 || !std::all_of(place->begin(), place->end(), is_coordinate))
    return unlike("--cube", *request.cube, "X,Y,Z: three coordinates of the scene, in its unit");
  request.cube_eye = Vec3((*place)[0], (*place)[1], (*place)[2]);
  const std::pair<bool, const char*> without[] = {
      {request.size.has_value(), "--size"},           {request.crop.has_value(), "--crop"},
      {request.scan_line.has_value(), "--scan-line"}, {request.pixel.has_value(), "--ray-tree"},
      {!request.preview.empty(), "--preview"},        {request.resume, "--resume"}};
  for (const auto& [given, option] : without) {
    if (given)
      return "option '" + std::string(option) + "' is for one picture; --cube makes six, --columns wide and high";
  }
  return std::nullopt;
}

bool is_adaptive(const RenderRequest& request) {
  return request.sampling == "adaptive" || request.sampling == "adaptive-jittered";
}

/// Gives the picture so many columns, and rows in proportion, at least one; or says why that cannot be.
std::optional<std::string> resize(Camera& camera, int columns) {
  const double rows = std::max(1.0, std::round(static_cast<double>(columns) * camera.rows / camera.columns));
  if (columns * rows > kMostPixels) {
    return unlike("--columns", std::to_string(columns),
                  "at most 2^28 pixels in all; in the scene's proportions these are " + std::to_string(columns) +
                      " × " + shortest(rows));
  }
  camera.columns = columns;
  camera.rows = static_cast<int>(rows);  // at most 2^28
  return std::nullopt;
}

std::string fixed_text(const Eigen::Array3d& values) {
  return shortest(values[0]) + ", " + shortest(values[1]) + ", " + shortest(values[2]);
}

Shadows shadows_named(const std::string& kind, const std::string& cure) {
  Shadows shadows;
  if (kind == "opaque") shadows.kind = ShadowKind::opaque;
  if (cure == "tolerance") shadows.cure = AcneCure::tolerance;
  if (cure == "moved-origin") shadows.cure = AcneCure::moved_origin;
  if (cure == "convex") shadows.cure = AcneCure::convex_left_out;
  if (cure == "none") shadows.cure = AcneCure::none;
  return shadows;
}

/// Flat shading takes the facets' own normals.
std::optional<std::string> of_other_shadings(const RenderRequest& request) {
  if (request.shading != "flat" || (request.vertex_normals.empty() && request.crease_deg < 0)) return std::nullopt;
  return "option '" + std::string(request.crease_deg < 0 ? "--vertex-normals" : "--crease") +
         "' says how normals at corners are made; --shading flat takes those of the facets";
}

/// What was asked of the other method.
std::optional<std::string> of_the_other_method(const RenderRequest& request) {
  std::vector<std::string> strange;
  const auto note = [&](bool given, const char* option) {
    if (given) strange.emplace_back(option);
  };
  if (!request.by_raster()) {
    note(!request.shading.empty(), "--shading");
    note(!request.vertex_normals.empty(), "--vertex-normals");
    note(request.facets > 0, "--facets");
    note(request.crease_deg >= 0, "--crease");
    note(!request.stepping.empty(), "--stepping");
    if (strange.empty()) return std::nullopt;
    return "option '" + strange.front() + "' is for --method raster: rays meet the surfaces themselves";
  }
  const RenderRequest usual;
  note(request.render.limits.depth != kUsualTreeDepth, "--depth");
  note(request.render.limits.cutoff != 0, "--cutoff");
  note(request.sampling != usual.sampling, "--sampling");
  note(request.threshold.has_value(), "--threshold");
  note(request.seed != usual.seed, "--seed");
  note(request.filter != usual.filter, "--filter");
  note(request.filter_width > 0, "--filter-width");
  note(request.shadows != usual.shadows, "--shadows");
  note(request.acne_cure != usual.acne_cure, "--acne-cure");
  note(request.facts.has_value(), "--aov");
  note(request.accelerator != usual.accelerator, "--accelerator");
  note(request.pixel.has_value(), "--ray-tree");
  note(request.crop.has_value(), "--crop");
  note(!request.preview.empty(), "--preview");
  note(request.resume, "--resume");
  if (strange.empty()) return std::nullopt;
  return "option '" + strange.front() + "' is for --method raytrace: the rasteriser follows no rays";
}

std::optional<std::string> settle_line(RenderRequest& request, int columns, int rows) {
  const auto values = numbers<int>(*request.scan_line, ',');
  const std::size_t count = values ? values->size() : 0;
  const int row = count > 0 ? (*values)[0] : -1;
  const int first = count == 3 ? (*values)[1] : 0, last = count == 3 ? (*values)[2] : columns;
  if ((count != 1 && count != 3) || row < 0 || row >= rows || first < 0 || first >= last || last > columns) {
    return unlike("--scan-line", *request.scan_line,
                  "ROW or ROW,FIRST,LAST with ROW from 0 to " + std::to_string(rows - 1) +
                      " and 0 <= FIRST < LAST <= " + std::to_string(columns));
  }
  request.line = RenderRequest::LinePart{row, first, last};
  return std::nullopt;
}

}  // namespace

ShadingOptions RenderRequest::shading_options() const {
  ShadingOptions options;
  if (shading == "flat") options.shading = Shading::flat;
  if (shading == "gouraud") options.shading = Shading::gouraud;
  if (shading == "dot") options.shading = Shading::dot;
  if (vertex_normals == "equal") options.weight = NormalWeight::equal;
  if (vertex_normals == "area") options.weight = NormalWeight::area;
  if (stepping == "incremental") options.stepping = Stepping::incremental;
  if (facets > 0) options.net.facets = facets;
  if (crease_deg >= 0) options.net.crease_angle = std::min(crease_deg / 180, 1.0) * std::numbers::pi;
  options.samples = render.sampling.samples_per_side;
  options.wavelengths = render.wavelengths;
  return options;
}

Overflow RenderRequest::overflow_treatment() const {
  if (overflow == "scale-image") return Overflow::scale_image;
  return overflow == "scale-pixel" ? Overflow::scale_pixel : Overflow::clamp;
}

std::string RenderRequest::sampling_text() const {
  const std::string n = std::to_string(render.sampling.samples_per_side);
  std::string text = sampling + (is_adaptive(*this) ? " to " : " ") + n + " × " + n;
  if (is_adaptive(*this)) text += ", contrast " + fixed_text(render.sampling.threshold);
  if (sampling != "uniform") text += ", seed " + std::to_string(seed);
  return text;
}

std::string RenderRequest::filter_text() const {
  return filter + ", " + shortest(2 * render.filter.radius) + (render.filter.radius == 0.5 ? " pixel" : " pixels") +
         " wide";
}

std::string RenderRequest::shading_text() const {
  const ShadingOptions options = shading_options();
  return (shading.empty() ? "phong" : shading) + ", " + std::to_string(options.net.facets) + " facets, normals by " +
         (vertex_normals.empty() ? "angle" : vertex_normals) + ", creases of " +
         shortest(crease_deg < 0 ? kUsualCreaseDeg : crease_deg) + "°" +
         (options.stepping == Stepping::incremental ? ", by additions along rows" : "");
}

std::string RenderRequest::settings(const Camera& camera) const {
  std::string text = std::to_string(camera.columns) + " × " + std::to_string(camera.rows) + ", depth " +
                     std::to_string(render.limits.depth) + ", cutoff " + shortest(render.limits.cutoff) + ", " +
                     sampling_text() + ", seed " + std::to_string(seed) + ", filter " + filter_text();
  if (shadows != "attenuated") text += ", shadows " + shadows;
  if (acne_cure != "bound") text += ", acne cure " + acne_cure;
  if (render.wavelengths > 0) text += ", wavelengths " + std::to_string(render.wavelengths);
  if (hide) text += ", without " + *hide;
  if (const auto& window = render.crop) {
    text += ", crop " + std::to_string(window->left) + "," + std::to_string(window->top) + "," +
            std::to_string(window->right) + "," + std::to_string(window->bottom);
  }
  for (const PictureFact fact : render.facts) text += ", " + name(fact);
  return text;
}

std::optional<std::string> settle(RenderRequest& request) {
  if (const auto wrong = of_the_other_method(request)) return wrong;
  if (const auto wrong = of_other_shadings(request)) return wrong;
  Sampling& sampling = request.render.sampling;
  if (request.sampling == "jittered") sampling.scheme = SamplingScheme::jittered;
  if (request.sampling == "adaptive") sampling.scheme = SamplingScheme::adaptive;
  if (request.sampling == "adaptive-jittered") sampling.scheme = SamplingScheme::adaptive_jittered;
  sampling.seed = static_cast<std::uint64_t>(request.seed);
  if (sampling.samples_per_side == 0)
    sampling.samples_per_side = is_adaptive(request) ? kUsualAdaptiveSamples : kUsualSamples;
  if (const auto wrong = read_threshold(request)) return wrong;
  if (request.threshold && !is_adaptive(request))
    return "option '--threshold' is for --sampling adaptive and adaptive-jittered";
  if (const auto wrong = fault(sampling)) return "option '--samples': " + *wrong;
  request.render.shadows = shadows_named(request.shadows, request.acne_cure);
  FilterKind kind = FilterKind::box;
  if (request.filter == "tent") kind = FilterKind::tent;
  if (request.filter == "gaussian") kind = FilterKind::gaussian;
  if (request.filter == "mitchell") kind = FilterKind::mitchell;
  request.render.filter = usual_filter(kind);
  if (request.filter_width > 0) request.render.filter.radius = request.filter_width / 2;
  if (const auto wrong = read_facts(request)) return wrong;
  if (const auto wrong = read_cube(request)) return wrong;
  if (request.size && request.columns > 0) return "options '--columns' and '--size' both say how wide the picture is";
  const bool tree = request.pixel.has_value();
  if (tree && !request.common.output.empty() && request.common.output.extension() != ".dot") {
    return unlike("--output", request.common.output.string(),
                  "a name that ends in .dot, since --ray-tree makes a graph");
  }
  if (tree && (request.resume || !request.preview.empty() || request.crop || request.facts))
    return "option '--ray-tree' makes no picture: neither --resume nor --preview, --crop or --aov";
  if (!request.preview.empty() && request.preview.extension() != ".png")
    return unlike("--preview", request.preview.string(), "a name that ends in .png");
  return contradiction(request.tone);
}

std::optional<std::string> settle_size(RenderRequest& request, Camera& camera) {
  if (request.columns > 0) {
    if (auto wrong = resize(camera, request.columns)) return wrong;
  }
  if (request.size) {
    const auto sides = numbers<int>(*request.size, 'x');
    const bool fit = sides && sides->size() == 2 && std::min((*sides)[0], (*sides)[1]) >= 1 &&
                     std::max((*sides)[0], (*sides)[1]) <= kLongestSide &&
                     static_cast<double>((*sides)[0]) * (*sides)[1] <= kMostPixels;
    if (!fit) {
      return unlike("--size", *request.size,
                    "COLUMNSxROWS, each from 1 to " + std::to_string(kLongestSide) + ", at most 2^28 pixels in all");
    }
    camera.columns = (*sides)[0];
    camera.rows = (*sides)[1];
  }
  if (request.crop) {
    const auto edges = numbers<int>(*request.crop, ',');
    const bool fit = edges && edges->size() == 4 && (*edges)[0] >= 0 && (*edges)[1] >= 0 && (*edges)[0] < (*edges)[2] &&
                     (*edges)[1] < (*edges)[3] && (*edges)[2] <= camera.columns && (*edges)[3] <= camera.rows;
    if (!fit) {
      return unlike("--crop", *request.crop,
                    "LEFT,TOP,RIGHT,BOTTOM with 0 <= LEFT < RIGHT <= " + std::to_string(camera.columns) +
                        " and 0 <= TOP < BOTTOM <= " + std::to_string(camera.rows));
    }
    request.render.crop = PixelWindow{(*edges)[0], (*edges)[1], (*edges)[2], (*edges)[3]};
  }
  if (request.scan_line) {
    const PixelWindow window = request.render.crop.value_or(PixelWindow{0, 0, camera.columns, camera.rows});
    return settle_line(request, window.columns(), window.rows());
  }
  return std::nullopt;
}

}  // namespace etendue::cli
