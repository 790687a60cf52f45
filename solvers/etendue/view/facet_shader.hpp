// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "etendue/raytracing/surface_colour.hpp"
#include "etendue/reflectance/cosines.hpp"
#include "etendue/view/facets.hpp"

namespace etendue {

/// Of values at a facet's corners that at the weights' point: barycentric coordinates on the surface.
inline Vec3 mixed(const Eigen::Array3d& weights, const std::array<Vec3, 3>& values) {
  return weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2];
}

/// The local model at points of facets.
class FacetShader {
 public:
  /// What flat and Gouraud's shading compute once and interpolate: the intensity; of a surface with a pattern, whose
  /// colours are those of each pixel, the light that they then reflect.
  struct Interpolated {
    Rgb intensity = Rgb::Zero();
    Rgb diffuse = Rgb::Zero();  ///< of a pattern: what k_d is multiplied by; the rest is in `intensity`
  };

  FacetShader(const Scene& scene, Shading shading);

  const Scene& scene() const { return scene_; }
  std::size_t lights() const { return intensities_.size(); }
  const Material& material(const Facet& facet) const { return scene_.materials[scene_.objects[facet.object].material]; }
  bool has_pattern(const Facet& facet) const { return material(facet).pattern || material(facet).texture; }
  Vec3 to_viewer(const Vec3& point) const;

  /// What is known of a facet before its pixels are.
  void prepare(const Facet& facet, std::vector<Interpolated>& colours, std::vector<LightCosines>& cosines) const;

  /// What a point shows, its normal interpolated, with bumps and environment.                        @eq IU.3.3
  Rgb phong(const Facet& facet, const Eigen::Array3d& weights, std::vector<LightCosines>& cosines) const;

  /// The scalar products of all lights between the corners of a facet, into `cosines`.                @eq IU.3.4
  void mix(const Eigen::Array3d& weights, const LightCosines* at_corners, std::vector<LightCosines>& cosines) const;

  Rgb reflected(const Facet& facet, const Eigen::Array3d& weights, const Vec3& point,
                std::span<const LightCosines> cosines) const;

  /// Colours of a pixel, of light that was interpolated.
  Rgb patterned(const Facet& facet, const Eigen::Array3d& weights, const Interpolated& light) const;

 private:
  void see(const Facet& facet, const Vec3& point, const Vec3& normal, std::vector<LightCosines>& cosines) const;
  void append(const Facet& facet, const Vec3& point, const Vec3& normal, std::vector<LightCosines>& cosines) const;
  Vec3 bumped(const MaterialBump& bump, const Facet& facet, const Vec3& point, const Vec3& normal,
              std::vector<LightCosines>& cosines) const;
  Interpolated light(const Facet& facet, const std::vector<LightCosines>& cosines) const;
  SurfaceColour colour(const Facet& facet, const Eigen::Array3d& weights, const Vec3& point) const;

  const Scene& scene_;
  Shading shading_;
  std::vector<Rgb> intensities_;
  std::vector<LocalReflection> surfaces_;  // of each material, where it has no pattern
};

/// The unit normal between those of the corners; the facet's own half way between opposite ones.     @eq IU.3.3
[[nodiscard]] Vec3 normal_at(const Facet& facet, const Eigen::Array3d& weights);

}  // namespace etendue
