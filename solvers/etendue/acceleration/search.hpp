// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
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
///
/// What sight() can tell comes first: a surface that is surely missed, or met surely later than another, is not intersected;
/// the others wait until all are known, so that mostly one of them is left.
class NearestSearch {
 public:
  NearestSearch(const Scene& scene, const Ray& ray) : scene_(scene), ray_(ray), limit_(ray.t_max) {}

  void try_surface(const Surface& surface) {
    const Sight seen = sight(ray_, scene_, surface);
    if (seen.kind == Sight::Kind::miss || seen.first > limit_) return;
    if (seen.kind == Sight::Kind::hit) limit_ = std::min(limit_, seen.last);
    if (waiting_count_ == waiting_.size()) resolve();
    waiting_[waiting_count_++] = {surface, seen.first};
  }
  /// The same for one that is this triangle, at once; whether it is the best so far.
  bool try_triangle(const Triangle& triangle, const Surface& surface) {
    return consider(intersect(ray_, triangle), surface);
  }
  void try_counted(const Surface& surface) {
    ++answer_.tests.surfaces;
    try_surface(surface);
  }

  /// No less than t of the best hit so far, or the ray's end.
  const double& limit() const { return limit_; }
  TestCount& tests() { return answer_.tests; }
  Nearest& answer() {
    resolve();
    return answer_;
  }

 private:
  struct Waiting {
    Surface surface;
    double first;  ///< it is not met before
  };

  /// The ray itself is never shortened: a hit would else depend on the order of the tests.
  void resolve() {
    for (std::size_t i = 0; i < waiting_count_; ++i) {
      const Surface& surface = waiting_[i].surface;
      if (!(waiting_[i].first > limit_)) consider(intersect(ray_, scene_, surface), surface);
    }
    waiting_count_ = 0;
  }

  bool consider(const std::optional<Hit>& hit, const Surface& surface) {
    if (!hit) return false;
    const SceneHit candidate{*hit, surface.object, surface.part};
    if (answer_.hit && !precedes(candidate, *answer_.hit)) return false;
    answer_.hit = candidate;
    limit_ = std::min(limit_, hit->t);
    return true;
  }

  const Scene& scene_;
  const Ray& ray_;
  double limit_;
  Nearest answer_;
  std::array<Waiting, 4> waiting_;
  std::size_t waiting_count_ = 0;
};

/// Whether any of the surfaces tried is hit.
class ObstructionSearch {
 public:
  ObstructionSearch(const Scene& scene, const Ray& ray) : scene_(scene), ray_(ray) {}

  bool blocks(const Surface& surface) {
    const Sight::Kind seen = sight(ray_, scene_, surface).kind;
    answer_.blocked =
        seen == Sight::Kind::hit || (seen == Sight::Kind::unsure && intersect(ray_, scene_, surface).has_value());
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

  TestCount& tests() { return answer_.tests; }
  Obstruction& answer() { return answer_; }

 private:
  const Scene& scene_;
  const Ray& ray_;
  Obstruction answer_;
};

}  // namespace etendue
