// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/surface_colour.hpp"

#include <cmath>

#include "etendue/geometry/meeting.hpp"

namespace etendue {

namespace {

PatternPlace place_of(const MaterialTexture& texture, const Object& object, const Vec3& point,
                      const PatternPlace& by_parameters) {
  PatternPlace place = by_parameters;
  if (texture.laid) {
    const Mat3& to_own = object.own.to_own;
    place = place_in(*texture.laid, to_own * (point - object.own.origin));
    place.u_slope = to_own.transpose() * place.u_slope;
    place.v_slope = to_own.transpose() * place.v_slope;
  }
  place.at.u *= texture.tiles[0];
  place.at.v *= texture.tiles[1];
  place.u_slope *= texture.tiles[0];
  place.v_slope *= texture.tiles[1];
  return place;
}

bool has_poles(const MaterialTexture& texture, const Object& object) {
  return texture.laid ? std::holds_alternative<LaidOnSphere>(*texture.laid)
                      : std::holds_alternative<Sphere>(object.shape);
}

}  // namespace

SurfaceColour colour_at(const Material& material, const Vec3& point) {
  if (!material.pattern) return {material.k_d, material.k_a};
  const double share = second_share(material.pattern->pattern, point);
  return {(1 - share) * material.k_d + share * material.pattern->k_d,
          (1 - share) * material.k_a + share * material.pattern->k_a};
}

PixelOnSurface pixel_on_surface(const Camera& camera, const Sighting& seen) {
  const double size = 2 * std::tan(camera.horizontal_half_angle) / camera.columns * seen.path;
  const Vec3 across = seen.normal.cross(seen.direction);
  const double sine = across.norm();
  if (!(sine > 0)) {
    const TangentFrame frame = tangent_frame(seen.normal);
    return {size * frame.u, size * frame.v};
  }
  const double cosine = seen.normal.dot(seen.direction);
  const Vec3 along = (seen.direction - cosine * seen.normal).normalized();
  return {size / sine * across, size / std::abs(cosine) * along};
}

SurfaceColour textured_colour(const Scene& scene, const Object& object, const Sighting& seen,
                              const PatternPlace& by_parameters) {
  const Material& material = scene.materials[object.material];
  const MaterialTexture& texture = *material.texture;
  const PatternPlace place = place_of(texture, object, seen.point, by_parameters);
  Rgb colour;
  if (const auto* squares = std::get_if<ColourSquares>(&texture.colours)) {
    colour = colour_of_square(*squares, place.at);
  } else {
    const TextureImage& image = std::get<TextureImage>(texture.colours);
    const PixelOnSurface pixel = pixel_on_surface(scene.camera, seen);
    const PatternFootprint footprint{{place.u_slope.dot(pixel.across), place.v_slope.dot(pixel.across)},
                                     {place.u_slope.dot(pixel.along), place.v_slope.dot(pixel.along)}};
    Wraps wraps = image.wraps;
    if (wraps.v == Wrap::repeat && texture.tiles[1] == 1 && has_poles(texture, object)) wraps.v = Wrap::clamp;
    colour = filtered(*image.pyramid, place.at, footprint, wraps);
  }
  return {colour * material.k_d, colour * material.k_a};
}

PatternPlace parameters_if_wanted(const Scene& scene, const SceneHit& met, const Vec3& at_rest) {
  const Object& object = scene.objects[met.object];
  const auto& texture = scene.materials[object.material].texture;
  if (!texture || texture->laid) return {};
  Hit hit = met.hit;
  hit.point = at_rest;
  return std::visit([&](const auto& shape) { return parameters(shape, hit, met.part); }, object.shape);
}

}  // namespace etendue
