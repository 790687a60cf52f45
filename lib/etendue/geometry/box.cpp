// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/box.hpp"

#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/core/processor.hpp"
#include "etendue/geometry/meeting.hpp"
#include "etendue/geometry/resolved.hpp"
#include "etendue/geometry/sight.hpp"

namespace etendue {

namespace {

// Where the ray enters or leaves the box: through the face whose outward normal is sign · axes.col(axis).
struct Crossing {
  DoubleDouble t;
  int axis = -1;
  double sign = 0;
};

Expansion exact_dot(const DoubleDouble3& a, const Vec3& b) {
  return Expansion(a.x) * b.x() + Expansion(a.y) * b.y() + Expansion(a.z) * b.z();
}

// The ray and the slab along one axis: the heights of the origin above the two faces and the speed, all with exact signs.
class Slab {
 public:
  Slab(const Ray& ray, const Box& box, int axis)
      : axis_(axis),
        normal_(box.axes.col(axis)),
        half_(box.half_edges[axis]),
        v_(exact_difference(ray.origin, box.centre)) {
    scale_ = normal_.cwiseProduct(ray.origin - box.centre).lpNorm<1>() + half_;
    height_ = dot(v_, normal_);
    const DoubleDouble3 direction = widened(ray.direction);
    speed_ = resolved(dot(direction, normal_), normal_.cwiseProduct(ray.direction).lpNorm<1>(),
                      [&] { return exact_dot(direction, normal_); });
  }

  DoubleDouble above_low() const {
    return resolved(height_ + half_, scale_, [&] { return exact_dot(v_, normal_) + half_; });
  }
  DoubleDouble above_high() const {
    return resolved(height_ - half_, scale_, [&] { return exact_dot(v_, normal_) - half_; });
  }
  bool is_parallel() const { return speed_.high == 0; }
  Crossing entering() const {
    return {-(rising() ? above_low() : above_high()) / speed_, axis_, rising() ? -1.0 : 1.0};
  }
  Crossing leaving() const { return {-(rising() ? above_high() : above_low()) / speed_, axis_, rising() ? 1.0 : -1.0}; }

 private:
  bool rising() const { return speed_.high > 0; }

  int axis_;
  Vec3 normal_;
  double half_, scale_;
  DoubleDouble3 v_;
  DoubleDouble height_, speed_;
};

// The crossing that is the hit, if there is one: the last entry or, from inside, the first exit.
std::optional<Crossing> hit_of_slabs(const Ray& ray, const Box& box) {
  Crossing enter, leave;
  for (int axis = 0; axis < 3; ++axis) {
    const Slab slab(ray, box, axis);
    if (slab.is_parallel()) {
      if (slab.above_low().high >= 0 && slab.above_high().high <= 0) continue;
      return std::nullopt;
    }
    const Crossing first = slab.entering(), last = slab.leaving();
    if (enter.axis < 0 || enter.t < first.t) enter = first;
    if (leave.axis < 0 || last.t < leave.t) leave = last;
  }
  if (leave.t < enter.t) return std::nullopt;
  const Crossing& met = looks_at(ray, enter.t.high) ? enter : leave;
  return looks_at(ray, met.t.high) ? std::optional(met) : std::nullopt;
}

}  // namespace

ETENDUE_USES_FMA std::optional<Hit> intersect(const Ray& ray, const Box& box) {
  require_direction(ray);
  require(box.half_edges.minCoeff() > 0, "intersect: the box's edges are positive");
  require(box.centre.allFinite() && box.axes.allFinite() && box.half_edges.allFinite(), "intersect: the box is finite");
  const BoxSight seen = box_sight(ray, box);
  if (seen.sight.kind == Sight::Kind::miss) return std::nullopt;
  Crossing met;
  if (seen.axis >= 0) {
    const Slab slab(ray, box, seen.axis);
    met = seen.entering ? slab.entering() : slab.leaving();
  } else if (const auto found = hit_of_slabs(ray, box)) {
    met = *found;
  } else {
    return std::nullopt;
  }
  Hit hit = flat_hit(ray, met.t, met.sign * box.axes.col(met.axis));
  const Vec3 offset = hit.point - box.centre;
  const int u = (met.axis + 1) % 3, v = (met.axis + 2) % 3;
  hit.uv = {box.axes.col(u).dot(offset) / box.half_edges[u], box.axes.col(v).dot(offset) / box.half_edges[v]};
  return hit;
}

}  // namespace etendue
