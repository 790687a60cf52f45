// SPDX-License-Identifier: Apache-2.0
#include "etendue/view/shaded_view.hpp"

#include <algorithm>
#include <optional>

#include "etendue/core/contract.hpp"
#include "etendue/raster/projection.hpp"
#include "etendue/text/utf8.hpp"
#include "etendue/view/drawing.hpp"
#include "etendue/view/facet_shader.hpp"
#include "etendue/view/facets.hpp"
#include "etendue/view/phong_run.hpp"
#include "etendue/view/radiosity_view.hpp"

namespace etendue {

namespace {

constexpr int kLargestPicture = 1 << 16;  // samples along an edge: half of kLargestCoordinate, as Projection wants
constexpr int kBand = 32;                 // rows of samples that are drawn at a time: they stay in the cache

/// Facets on the picture, and what each pixel of it then shows.
class Picture {
 public:
  Picture(const Scene& scene, const ShadingOptions& options, const std::vector<Facet>& facets)
      : scene_(scene), options_(options), facets_(facets), shader_(scene, options.shading) {}

  void project(const Projection& projection) {
    std::vector<std::array<GouraudVertex, 3>> parts;
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      const auto& corners = facets_[f].corners;
      projection.project({projection.seen(corners[0], {1, 0, 0}), projection.seen(corners[1], {0, 1, 0}),
                          projection.seen(corners[2], {0, 0, 1})},
                         parts);
      const bool clear = shader_.material(facets_[f]).see_through.has_value();
      for (const auto& part : parts) seen_.push_back({part, static_cast<std::uint32_t>(f), clear});
      shader_.prepare(facets_[f], light_, cosines_);
      in_runs_.push_back(options_.shading == Shading::phong && PhongRun::takes(shader_.material(facets_[f])));
    }
  }

  /// Adds to the picture's rows [first, last) what some of its samples show, `white` being the light's.
  void draw(int first, int last, Which which, const Rgb& white, Image& image) const {
    const int n = options_.samples;
    const ScanWindow window{image.columns * n, first * n, last * n};
    static thread_local FacetRaster raster(window);  // bands are drawn one after the other: memory is asked for once
    raster.look(window, options_.stepping);
    std::vector<LightCosines> cosines;
    const Rgb share = white / (n * n);
    std::vector<Fragment> fragments;  // stays empty where nothing is transparent
    for (const bool clear : {false, true}) {
      for (const SeenFacet& seen : seen_) {
        const auto [high, low] =
            std::minmax({seen.part[0].position.y(), seen.part[1].position.y(), seen.part[2].position.y()});
        if (seen.clear != clear || low < window.first_row || high > window.last_row) continue;
        clear ? raster.collect(seen.part, seen.facet, fragments) : raster.draw(seen.part, seen.facet);
      }
    }
    sort_back_to_front(fragments);
    const auto is_drawn = [&](int x, int y) {
      return which == Which::all || is_spectral(raster, x, y, fragments) == (which == Which::spectral);
    };
    Line line(shader_, static_cast<std::size_t>(window.columns) * static_cast<std::size_t>(n));
    for (int row = first; row < last; ++row) {
      if (options_.shading == Shading::phong) shade(raster, row * n, n, is_drawn, line);
      for (int column = 0; column < image.columns; ++column) {
        Rgb sum = Rgb::Zero();
        for (int down = 0; down < n; ++down) {
          for (int across = 0; across < n; ++across) {
            const int x = column * n + across, y = row * n + down;
            if (!is_drawn(x, y)) continue;
            const Rgb drawn =
                at(raster, x, y, line.colours[static_cast<std::size_t>(down * window.columns + x)], cosines);
            sum += fragments.empty() ? drawn : through(fragments, raster.place(x, y), drawn, cosines);
          }
        }
        image.at(column, row) += sum * share;
      }
    }
  }

 private:
  struct SeenFacet {
    std::array<GouraudVertex, 3> part;
    std::uint32_t facet;
    bool clear;
  };

  /// Does it show, or is it seen through, a surface that reflects by wavelength?
  bool is_spectral(const FacetRaster& raster, int column, int row, const std::vector<Fragment>& fragments) const {
    const std::uint32_t f = raster.facet(column, row);
    if (f != kNoFacet && shader_.material(facets_[f]).reflectance) return true;
    const std::size_t place = raster.place(column, row);
    return std::any_of(first_at(fragments, place), fragments.end(), [&](const Fragment& fragment) {
      return fragment.place == place && shader_.material(facets_[fragment.facet]).reflectance.has_value();
    });
  }

  static std::vector<Fragment>::const_iterator first_at(const std::vector<Fragment>& fragments, std::size_t place) {
    const auto is_before = [](const Fragment& fragment, std::size_t at) { return fragment.place < at; };
    return std::lower_bound(fragments.begin(), fragments.end(), place, is_before);
  }

  /// Colours of the samples of a line of pixels, those that PhongRun shades.
  struct Line {
    Line(const FacetShader& shader, std::size_t samples) : run(shader), colours(samples) {}
    PhongRun run;
    std::vector<Rgb> colours;
  };

  template <class IsDrawn>
  void shade(const FacetRaster& raster, int first, int rows, const IsDrawn& is_drawn, Line& line) const {
    Rgb* colour = line.colours.data();
    for (int y = first; y < first + rows; ++y) {
      for (int x = 0; x < raster.columns(); ++x, ++colour) {
        const std::uint32_t f = raster.facet(x, y);
        if (f != kNoFacet && in_runs_[f] && is_drawn(x, y)) line.run.add(facets_[f], raster.weights(x, y), *colour);
      }
    }
    line.run.finish();
  }

  Rgb at(const FacetRaster& raster, int column, int row, const Rgb& in_line, std::vector<LightCosines>& cosines) const {
    const std::uint32_t f = raster.facet(column, row);
    if (f == kNoFacet) return scene_.background;
    return in_runs_[f] ? in_line : shown(f, raster.weights(column, row), cosines);
  }

  /// What is seen through the fragments of a place, from the farthest to the nearest.               @eq IU.4.4a, IU.4.4b
  Rgb through(const std::vector<Fragment>& fragments, std::size_t place, Rgb behind,
              std::vector<LightCosines>& cosines) const {
    for (auto next = first_at(fragments, place); next != fragments.end() && next->place == place; ++next) {
      const Facet& facet = facets_[next->facet];
      const Vec3 point = mixed(next->weights, facet.corners);
      const Vec3 normal = options_.shading == Shading::flat ? facet.normal : normal_at(facet, next->weights);
      // Averaged normals may lean away from the viewer; and unit vectors are rounded.
      const double n_z = std::clamp(normal.dot(shader_.to_viewer(point)), 0.0, 1.0);
      const double t = transparency(n_z, *shader_.material(facet).see_through);
      behind = see_through(shown(next->facet, next->weights, cosines), behind, t);
    }
    return behind;
  }

  /// A facet's own colour at a point of it.
  Rgb shown(std::uint32_t f, const Eigen::Array3d& weights, std::vector<LightCosines>& cosines) const {
    const Facet& facet = facets_[f];
    if (options_.shading == Shading::flat) {
      return shader_.has_pattern(facet) ? shader_.patterned(facet, weights, light_[f]) : light_[f].intensity;
    }
    if (options_.shading == Shading::gouraud) {
      const FacetShader::Interpolated* corners = &light_[std::size_t{3} * f];
      const auto between_corners = [&](Rgb FacetShader::Interpolated::*part) -> Rgb {
        return weights[0] * corners[0].*part + weights[1] * corners[1].*part + weights[2] * corners[2].*part;
      };
      const Rgb intensity = between_corners(&FacetShader::Interpolated::intensity);
      if (!shader_.has_pattern(facet)) return intensity;
      return shader_.patterned(facet, weights, {intensity, between_corners(&FacetShader::Interpolated::diffuse)});
    }
    if (options_.shading == Shading::dot) {
      shader_.mix(weights, cosines_.data() + 3 * shader_.lights() * f, cosines);
      return shader_.reflected(facet, weights, mixed(weights, facet.corners), cosines);
    }
    return shader_.phong(facet, weights, cosines);
  }

  const Scene& scene_;
  const ShadingOptions& options_;
  const std::vector<Facet>& facets_;
  FacetShader shader_;
  std::vector<SeenFacet> seen_;
  std::vector<char> in_runs_;                     // of each facet: whether PhongRun shades it
  std::vector<FacetShader::Interpolated> light_;  // one of each facet, or three
  std::vector<LightCosines> cosines_;             // of each facet, corner and light
};

/// "'a', 'b' and 3 more": of the materials that fulfil a condition and that an object is made of.
template <class Condition>
std::string materials_with(const Scene& scene, const Condition& condition) {
  constexpr int kNamed = 3;
  std::string names;
  int count = 0;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const bool used = std::any_of(scene.objects.begin(), scene.objects.end(),
                                  [&](const Object& object) { return object.material == m; });
    if (!used || !condition(scene.materials[m])) continue;
    if (++count <= kNamed) names += (count > 1 ? ", '" : "'") + printable(scene.materials[m].name) + "'";
  }
  return count > kNamed ? names + " and " + std::to_string(count - kNamed) + " more" : names;
}

}  // namespace

Result<ShadedView> view_shaded(const Scene& scene, const ShadingOptions& options, const Execution& execution) {
  require(options.samples >= 1, "view_shaded: at least one sample a pixel");
  require(options.wavelengths >= 0, "view_shaded: no less than no wavelength");
  const Camera& camera = scene.camera;
  const auto frame = camera_frame(camera);
  if (!frame) return frame.error();
  if (std::max(camera.columns, camera.rows) > kLargestPicture / options.samples) {
    return Error{ErrorCode::invalid_input, "camera: " + std::to_string(camera.columns) + " × " +
                                               std::to_string(camera.rows) + " pixels are, with their samples, more " +
                                               "than " + std::to_string(kLargestPicture) + " along an edge"};
  }
  const auto facets = facets_of(scene, options);
  if (!facets) return facets.error();
  const Projection projection(*frame, camera.columns * options.samples, camera.rows * options.samples,
                              kNearPlane * length_to_see(scene, *facets));
  ShadedView view{Image(camera.columns, camera.rows), facets->size()};
  const int rows = std::max(1, kBand / options.samples);
  const auto bands = static_cast<std::size_t>((camera.rows + rows - 1) / rows);
  const std::vector<Drawing> all = drawings(scene, options.wavelengths);
  std::optional<Scene> coloured;  // a copy of everything for the sake of its materials, where wavelengths ask for it
  if (all.size() > 1) coloured = scene;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (coloured) colour_for(all[k].wavelength, scene, coloured->materials);
    Picture picture(coloured ? *coloured : scene, options, *facets);
    picture.project(projection);
    const auto draw = [&](std::size_t band) {
      const int first = static_cast<int>(band) * rows;
      picture.draw(first, std::min(first + rows, camera.rows), all[k].which, all[k].weight, view.image);
    };
    Execution part = execution;
    if (execution.progress)
      part.progress = [&](std::size_t done, std::size_t of) { execution.progress(k * of + done, all.size() * of); };
    if (!parallel_for(bands, part, draw)) return Error{ErrorCode::stopped, "the picture was stopped"};
  }
  return view;
}

std::vector<std::string> left_out(const Scene& scene, Shading shading) {
  std::vector<std::string> all;
  const std::string mirrors =
      materials_with(scene, [](const Material& m) { return !m.environment && (m.k_r > 0 || m.fresnel); });
  const std::string clear = materials_with(scene, [](const Material& m) { return m.k_t > 0; });
  if (!mirrors.empty()) all.push_back("reflection (k_r of " + mirrors + ")");
  if (!clear.empty()) all.push_back("refraction (k_t of " + clear + ")");
  const std::string rough = materials_with(scene, [](const Material& m) { return m.bump.has_value(); });
  const std::string mapped = materials_with(scene, [](const Material& m) { return m.environment != nullptr; });
  if (!mapped.empty() && shading != Shading::phong) all.push_back("environments (of " + mapped + ")");
  if (!rough.empty() && shading != Shading::phong) all.push_back("bumps (of " + rough + ")");
  if (!scene.lights.empty()) all.emplace_back("shadows");
  const bool has_area = std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& light) {
    return std::holds_alternative<RectangleLight>(light) || std::holds_alternative<SphereLight>(light);
  });
  if (has_area) all.emplace_back("the areas of lights");
  if (scene.camera.lens_radius > 0) all.emplace_back("depth of field");
  const bool moving = std::any_of(scene.objects.begin(), scene.objects.end(),
                                  [&](const Object& object) { return moves(scene, object); });
  if (moving) all.emplace_back("movement");
  return all;
}

}  // namespace etendue
