// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/acceleration/accelerator.hpp"
#include "etendue/reflectance/surface_parameters.hpp"

namespace etendue {

/// Diffuse and ambient reflection of a surface at a point.                                          @eq IU.4-1
struct SurfaceColour {
  Rgb k_d, k_a;
};

/// Where a material's pattern, if it has one, shows what it shows. Patterns move with their objects: the point is that of
/// at_rest().
[[nodiscard]] SurfaceColour colour_at(const Material& material, const Vec3& point);

/// A point of a surface, at rest, as a ray sees it.
struct Sighting {
  Vec3 point;
  Vec3 normal;     ///< unit vector, on either side
  Vec3 direction;  ///< of the ray, a unit vector
  double path;     ///< length of the way from the eye, by mirrors and through glass
};

/// Diameters of the ellipse that a pixel covers on the surface, seen along the ray as a disc of the size s of its way.
///
///     s = 2 tan θ / columns · path;   s N × D/|N × D|,   s/|N·D| (D − (N·D) N)/|…|
///
/// Symbols   θ half of the camera's angle. Curved mirrors and glass change the size of what they show; this does not
struct PixelOnSurface {
  Vec3 across, along;
};
[[nodiscard]] PixelOnSurface pixel_on_surface(const Camera& camera, const Sighting& seen);

/// Colours of a material with a texture: filtered() over the pixel, or those of the square. By the surface's own parameters,
/// which then must be given, or as it is laid in the object's own coordinates.                     @eq IU.4-1, IU.4.1.2
///
/// Around spheres the image is held (Wrap::clamp) at the poles even where it repeats, unless `tiles` has it several times
/// from pole to pole: what lies beyond a pole is not the other one
[[nodiscard]] SurfaceColour textured_colour(const Scene& scene, const Object& object, const Sighting& seen,
                                            const PatternPlace& by_parameters);

/// parameters() of the shape; of a material whose texture is laid otherwise, or that has none, nothing in particular.
[[nodiscard]] PatternPlace parameters_if_wanted(const Scene& scene, const SceneHit& met, const Vec3& at_rest);

/// What a ray meets, `path` from the eye.
[[nodiscard]] inline SurfaceColour colour_at(const Scene& scene, const SceneHit& met, const Ray& ray, double path) {
  const Object& object = scene.objects[met.object];
  const Material& material = scene.materials[object.material];
  const Vec3 point = at_rest(object, met.hit.point, ray.time);
  if (!material.texture) return colour_at(material, point);
  return textured_colour(scene, object, {point, met.hit.normal, ray.direction, path},
                         parameters_if_wanted(scene, met, point));
}

}  // namespace etendue
