// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/shadow.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/optics/absorption.hpp"
#include "etendue/optics/fresnel.hpp"

namespace etendue {

namespace {

bool is_convex(const Shape& shape) {
  return std::holds_alternative<Sphere>(shape) || std::holds_alternative<Box>(shape) ||
         std::holds_alternative<Plane>(shape) || std::holds_alternative<Disc>(shape) ||
         std::holds_alternative<Polygon>(shape) || std::holds_alternative<PolygonWithHoles>(shape) ||
         std::holds_alternative<Triangle>(shape);
}

class Walk {
 public:
  Walk(const Ray& ray, const ShadowStart& start, const Accelerator& accelerator, const Shadows& shadows)
      : ray_(ray), start_(start), accelerator_(accelerator), scene_(accelerator.scene()), shadows_(shadows) {}

  Passage passage() {
    const bool leaves_out =
        shadows_.cure == AcneCure::convex_left_out && is_convex(scene_.objects[start_.object].shape);
    const bool attenuates = shadows_.kind == ShadowKind::attenuated && accelerator_.has_transparent_surfaces();
    if (!leaves_out && !attenuates) {
      const Obstruction obstruction = accelerator_.obstruction(ray_);
      result_.tests = obstruction.tests;
      if (obstruction.blocked) result_.share = Rgb::Zero();
      return result_;
    }
    Media media = start_.media;
    for (;;) {
      const Nearest nearest = accelerator_.nearest(ray_);
      result_.tests += nearest.tests;
      if (!nearest.hit) break;
      const double length = nearest.hit->hit.t - ray_.t_min;
      ray_.t_min = nearest.hit->hit.t;  // the same ray goes on: what it has met it does not meet again
      if (leaves_out && nearest.hit->object == start_.object) continue;
      const Material& material = scene_.materials[scene_.objects[nearest.hit->object].material];
      if (!attenuates || !is_transparent(material)) return blocked();
      Crossing crossing = cross(media, *nearest.hit, ray_.direction, scene_);
      absorb(crossing.before, length);
      if (crossing.visible()) {
        result_.share *= transmitted(material, crossing, std::abs(ray_.direction.dot(nearest.hit->hit.normal)));
      }
      if (!(result_.share > 0).any()) return result_;
      media = std::move(crossing.behind);
    }
    absorb(media.present(scene_), ray_.t_max - ray_.t_min);
    return result_;
  }

 private:
  Passage blocked() {
    result_.share = Rgb::Zero();
    return result_;
  }

  void absorb(const std::optional<Media::Body>& body, double length) {
    if (body) result_.share *= transmittance(scene_.materials[body->material].absorption, length);
  }

  double index_of(const std::optional<Media::Body>& body) const {
    return body ? refractive_index(scene_.materials[body->material], start_.wavelength) : 1;
  }

  double transmitted(const Material& material, const Crossing& crossing, double cosine) const {
    if (!material.fresnel) return material.k_t;
    const double before = index_of(crossing.before), afterwards = index_of(crossing.afterwards);
    const double ratio = std::min(before, afterwards) / std::max(before, afterwards);
    return (material.k_r + material.k_t) * (1 - fresnel_reflectance(std::min(cosine, 1.0), ratio));
  }

  Ray ray_;
  const ShadowStart& start_;
  const Accelerator& accelerator_;
  const Scene& scene_;
  const Shadows shadows_;
  Passage result_;
};

}  // namespace

Passage passage(const Ray& shadow_ray, const ShadowStart& start, const Accelerator& accelerator,
                const Shadows& shadows) {
  return Walk(shadow_ray, start, accelerator, shadows).passage();
}

}  // namespace etendue
