// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>

#include "etendue/acceleration/surface_list.hpp"

// What the accelerators share: they choose which surfaces are tested, these do the testing.
namespace etendue {

/// RayBoxTest asks for hits below a limit; hits at the limit itself have to be compared, too.
inline double beyond(double t) {
  return std::nextafter(t, std::numeric_limits<double>::infinity());
}

/// The nearest hit among the surfaces tried, ties as Accelerator says.
class NearestSearch {
 public:
  NearestSearch(const Scene& scene, const Ray& ray) : scene_(scene), ray_(ray), limit_(ray.t_max) {}

  /// The ray itself is never shortened: a hit would else depend on the order of the tests.
  void try_surface(const Surface& surface) { consider(intersect(ray_, scene_, surface), surface); }
  /// The same for one that is this triangle; whether it is the best so far.
  bool try_triangle(const Triangle& triangle, const Surface& surface) {
    return consider(intersect(ray_, triangle), surface);
  }
  void try_counted(const Surface& surface) {
    ++answer_.tests.surfaces;
    try_surface(surface);
  }

  /// t of the best hit so far, or the ray's end.
  const double& limit() const { return limit_; }
  Nearest& answer() { return answer_; }

 private:
  bool consider(const std::optional<Hit>& hit, const Surface& surface) {
    if (!hit) return false;
    const SceneHit candidate{*hit, surface.object, surface.part};
    if (answer_.hit && !precedes(candidate, *answer_.hit)) return false;
    answer_.hit = candidate;
    limit_ = hit->t;
    return true;
  }

  const Scene& scene_;
  const Ray& ray_;
  double limit_;
  Nearest answer_;
};

/// Whether any of the surfaces tried is hit.
class ObstructionSearch {
 public:
  ObstructionSearch(const Scene& scene, const Ray& ray) : scene_(scene), ray_(ray) {}

  bool blocks(const Surface& surface) {
    answer_.blocked = intersect(ray_, scene_, surface).has_value();
    return answer_.blocked;
  }
  bool blocks(const Triangle& triangle) {
    answer_.blocked = intersect(ray_, triangle).has_value();
    return answer_.blocked;
  }
  bool any_blocks(const std::vector<Surface>& surfaces) {
    for (const Surface& surface : surfaces) {
      ++answer_.tests.surfaces;
      if (blocks(surface)) return true;
    }
    return false;
  }

  Obstruction& answer() { return answer_; }

 private:
  const Scene& scene_;
  const Ray& ray_;
  Obstruction answer_;
};

}  // namespace etendue
