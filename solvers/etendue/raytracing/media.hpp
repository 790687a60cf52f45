// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "etendue/acceleration/accelerator.hpp"

namespace etendue {

/// Whether light goes through, so that the material fills a body: k_t > 0.
[[nodiscard]] inline bool is_transparent(const Material& material) {
  return material.k_t > 0;
}

/// η of a material for light of a wavelength [nm]; 0 stands for all light at once: then it is Material::eta.    @eq IU.4-6
[[nodiscard]] double refractive_index(const Material& material, double wavelength);

/// The transparent bodies that a point of a ray lies in, in the order in which they were entered.     @eq IU.4-6, IU.5-7
///
/// A body is a sphere, box, mesh or other closed object; or all planes, polygons, discs and other open objects of one
/// material together, which bound it from several sides. What counts at a point is the body of the highest priority, of
/// equal ones the one that was entered last: a bubble in glass in water is air, the water in a glass may reach a little
/// into its wall. Where there is none, the index is 1.
class Media {
 public:
  /// A body: an object's index, or, beyond all objects, a material's.
  struct Body {
    std::size_t id;
    std::size_t material;
    bool operator==(const Body& other) const { return id == other.id; }
  };
  [[nodiscard]] static Body body_of(const Scene& scene, std::size_t object);

  /// Entering a body twice is entering it once, as at an edge that two faces report.
  void enter(const Body& body);
  void leave(const Body& body);
  [[nodiscard]] bool holds(const Body& body) const;
  [[nodiscard]] bool empty() const { return bodies_.empty(); }

  /// The body that counts, or nothing.
  [[nodiscard]] std::optional<Body> present(const Scene& scene) const;

 private:
  std::vector<Body> bodies_;
};

/// The media on both sides of a transparent surface that a ray meets.
struct Crossing {
  Media behind;                                          ///< those after the surface
  std::optional<Media::Body> before, afterwards;         ///< what counts on each side
  bool visible() const { return before != afterwards; }  ///< otherwise the surface lies hidden in another body
};

/// What a ray passes from and to at a hit on a transparent surface: against the geometric normal it enters the object's
/// body, along it it leaves. A body that is left without having been entered was there from the beginning.
[[nodiscard]] Crossing cross(const Media& around, const SceneHit& hit, const Vec3& direction, const Scene& scene);

/// The media around a point at a time, as an eye there needs them: found by following a line through the point to both sides. What
/// either side leaves before entering it holds the point; a plane is seen from one side only.
/// Domain    a point that lies on no surface
/// Returns   in the order from outside to inside; nothing where nothing is transparent
[[nodiscard]] Media media_around(const Vec3& point, const Accelerator& accelerator, double time = 0);

}  // namespace etendue
