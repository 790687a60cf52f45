// SPDX-License-Identifier: Apache-2.0
#include "etendue/view/facet_shader.hpp"

#include "etendue/raytracing/shade.hpp"
#include "etendue/raytracing/shading_normal.hpp"
#include "etendue/view/mirrored_environment.hpp"

namespace etendue {

FacetShader::FacetShader(const Scene& scene, Shading shading) : scene_(scene), shading_(shading) {
  for (const Light& light : scene.lights)
    intensities_.push_back(std::visit([](const auto& each) { return each.intensity; }, light));
  for (const Material& of : scene.materials)
    surfaces_.push_back({of.k_a, of.k_d, of.k_s, of.phong_exponent, of.highlight ? &*of.highlight : nullptr});
}

Vec3 normal_at(const Facet& facet, const Eigen::Array3d& weights) {
  const Vec3 sum = mixed(weights, facet.normals);
  const double length = sum.norm();
  return length > 0 ? Vec3(sum / length) : facet.normal;
}

Vec3 FacetShader::to_viewer(const Vec3& point) const {
  const Vec3 way = scene_.camera.eye - point;
  const double length = way.norm();
  return length > 0 ? Vec3(way / length) : Vec3(-scene_.camera.gaze.normalized());
}

void FacetShader::prepare(const Facet& facet, std::vector<Interpolated>& colours,
                          std::vector<LightCosines>& cosines) const {
  if (shading_ == Shading::flat) {
    see(facet, facet.centre(), facet.normal, cosines);
    colours.push_back(light(facet, cosines));
  }
  for (std::size_t k = 0; k < 3 && shading_ == Shading::gouraud; ++k) {
    see(facet, facet.corners[k], facet.normals[k], cosines);
    colours.push_back(light(facet, cosines));
  }
  if (shading_ != Shading::dot) return cosines.clear();
  for (std::size_t k = 0; k < 3; ++k) append(facet, facet.corners[k], facet.normals[k], cosines);
}

Rgb FacetShader::phong(const Facet& facet, const Eigen::Array3d& weights, std::vector<LightCosines>& cosines) const {
  const Material& of = material(facet);
  const Vec3 point = mixed(weights, facet.corners), normal = normal_at(facet, weights);
  see(facet, point, normal, cosines);
  const Vec3 shaded = of.bump ? bumped(*of.bump, facet, point, normal, cosines) : normal;
  Rgb colour = reflected(facet, weights, point, cosines);
  if (of.environment) colour += mirrored_environment(of, -to_viewer(point), normal, shaded);
  return colour;
}

void FacetShader::see(const Facet& facet, const Vec3& point, const Vec3& normal,
                      std::vector<LightCosines>& cosines) const {
  cosines.clear();
  append(facet, point, normal, cosines);
}

void FacetShader::mix(const Eigen::Array3d& weights, const LightCosines* at_corners,
                      std::vector<LightCosines>& cosines) const {
  cosines.clear();
  for (std::size_t i = 0; i < lights(); ++i) {
    const LightCosines &a = at_corners[i], &b = at_corners[lights() + i], &c = at_corners[2 * lights() + i];
    const auto between = [&](double LightCosines::*product) {
      return weights[0] * a.*product + weights[1] * b.*product + weights[2] * c.*product;
    };
    cosines.push_back({between(&LightCosines::incidence), between(&LightCosines::mirror),
                       between(&LightCosines::halfway), between(&LightCosines::tilt), between(&LightCosines::view),
                       between(&LightCosines::share)});
  }
}

Rgb FacetShader::reflected(const Facet& facet, const Eigen::Array3d& weights, const Vec3& point,
                           std::span<const LightCosines> cosines) const {
  const std::size_t m = scene_.objects[facet.object].material;
  const Rgb& emission = scene_.materials[m].emission;
  if (!has_pattern(facet)) return reflection_of_cosines(surfaces_[m], scene_.ambient, cosines, intensities_) + emission;
  const SurfaceColour colour = this->colour(facet, weights, point);
  LocalReflection surface = surfaces_[m];
  surface.k_a = colour.k_a;
  surface.k_d = colour.k_d;
  return reflection_of_cosines(surface, scene_.ambient, cosines, intensities_) + emission;
}

Rgb FacetShader::patterned(const Facet& facet, const Eigen::Array3d& weights, const Interpolated& light) const {
  const SurfaceColour colour = this->colour(facet, weights, mixed(weights, facet.corners));
  return colour.k_a * scene_.ambient + colour.k_d * light.diffuse + light.intensity;
}

// The normal of a bump. In place of the products of the smooth surface stand its own, for the lights that stand before both.
Vec3 FacetShader::bumped(const MaterialBump& bump, const Facet& facet, const Vec3& point, const Vec3& normal,
                         std::vector<LightCosines>& cosines) const {
  const Vec3 outward = facet.turned ? Vec3(-normal) : normal;
  const Vec3 rough = shading_normal(bump, scene_.objects[facet.object].shape, point, outward);
  const Vec3 seen = facet.turned ? Vec3(-rough) : rough;
  const std::size_t smooth = cosines.size();
  append(facet, point, seen, cosines);
  for (std::size_t i = 0; i < smooth; ++i) cosines[i] = cosines[i].incidence > 0 ? cosines[smooth + i] : LightCosines{};
  cosines.resize(smooth);
  return seen;
}

FacetShader::Interpolated FacetShader::light(const Facet& facet, const std::vector<LightCosines>& cosines) const {
  const Material& of = material(facet);
  const auto reflection = [&](const Rgb& k_a, const Rgb& k_d, double k_s) {
    LocalReflection surface = surfaces_[scene_.objects[facet.object].material];
    surface.k_a = k_a;
    surface.k_d = k_d;
    surface.k_s = k_s;
    return reflection_of_cosines(surface, scene_.ambient, cosines, intensities_);
  };
  if (!has_pattern(facet)) return {reflection(of.k_a, of.k_d, of.k_s) + of.emission, Rgb::Zero()};
  return {reflection(Rgb::Zero(), Rgb::Zero(), of.k_s) + of.emission, reflection(Rgb::Zero(), Rgb::Ones(), 0)};
}

SurfaceColour FacetShader::colour(const Facet& facet, const Eigen::Array3d& weights, const Vec3& point) const {
  const Material& of = material(facet);
  if (!of.texture) return colour_at(of, point);
  PatternPlace place;
  if (!of.texture->laid) {
    const Triangle triangle{facet.corners[0], facet.corners[1], facet.corners[2]};
    place = between(triangle, facet.parameters, {weights[1], weights[2]});
  }
  const Vec3 way = point - scene_.camera.eye;
  const double path = way.norm();
  const Vec3 direction = path > 0 ? Vec3(way / path) : Vec3(-facet.normal);
  return textured_colour(scene_, scene_.objects[facet.object], {point, facet.normal, direction, path}, place);
}

void FacetShader::append(const Facet& facet, const Vec3& point, const Vec3& normal,
                         std::vector<LightCosines>& cosines) const {
  const Vec3 view = to_viewer(point);
  const bool all = material(facet).highlight.has_value();
  for (std::size_t i = 0; i < lights(); ++i) {
    const LightSample light = towards(scene_.lights[i], point);
    // A point that is the light itself has none of it: it would come from everywhere.
    if (light.to_light.isZero(0)) {
      cosines.emplace_back();
      continue;
    }
    cosines.push_back(all ? all_light_cosines(normal, light.to_light, view)
                          : light_cosines(normal, light.to_light, view));
    cosines.back().share = arriving_share(scene_.lights[i], light.distance);
  }
}

}  // namespace etendue
