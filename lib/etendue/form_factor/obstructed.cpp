// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/obstructed.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/outer_integral.hpp"
#include "etendue/form_factor/point_polygon.hpp"
#include "etendue/form_factor/polygon_polygon.hpp"
#include "etendue/geometry/extent.hpp"

namespace etendue {

namespace {

struct Plates {
  Plates(std::span<const Polygon> plates, BlockingSides sides) {
    made.reserve(plates.size());
    for (const Polygon& plate : plates) {
      made.push_back(Blocker::plate(plate, sides));
      pointers.push_back(&made.back());
    }
  }
  Plates(const Plates&) = delete;
  Plates& operator=(const Plates&) = delete;
  std::vector<Blocker> made;
  std::vector<const Blocker*> pointers;
};

/// facing_pair() of two polygons that lie clearly in front of one another, as most do: nothing is cut, so nothing has to
/// be exact. Nothing where that is in doubt.
std::optional<FacingPair> whole_pair(const Polygon& from, const Polygon& to) {
  constexpr double kClear = 0x1p-40;  // of the distance; rounding moves heights by a few u of it
  const auto in_front = [](const Polygon& plane, const Polygon& polygon) {
    const Vec3& base = plane.vertices().front();
    for (const Vec3& v : polygon.vertices()) {
      if (!(plane.normal().dot(v - base) > kClear * ((v - base).cwiseAbs().sum() + base.cwiseAbs().sum())))
        return false;
    }
    return true;
  };
  if (!in_front(from, to) || !in_front(to, from)) return std::nullopt;
  const Vec3 &a = from.vertices().front(), &b = to.vertices().front();
  const double size =
      std::max({extent_of(from.vertices()).size, extent_of(to.vertices()).size, (b - a).cwiseAbs().maxCoeff()});
  FacingPair pair;
  pair.scale = std::ldexp(1.0, -std::ilogb(size));
  pair.from = make_loop(localised(from.vertices(), a, pair.scale));
  pair.to = make_loop(localised(to.vertices(), b, pair.scale));
  pair.from.normal = from.normal();
  pair.to.normal = to.normal();
  pair.offset = pair.scale * (b - a);
  pair.from_area = pair.scale * pair.scale * from.area();
  return pair;
}

/// F lies in [0, free]: moving the value into the range by at most its error only brings it nearer to the truth.
void clamp(ObstructedFormFactor& f) {
  const double computed = f.value;
  f.value = std::clamp(computed, 0.0, f.free.value);
  if (f.value != computed) {
    f.clamp = computed < 0 ? Clamp::to_zero : Clamp::to_free;
    f.clamped_by = std::abs(computed - f.value);
  }
  f.bound = std::min(f.bound, std::max(f.value, f.free.value + f.free.bound - f.value));
}

}  // namespace

ObstructedFormFactor obstructed_form_factor(const Polygon& from, const Polygon& to,
                                            std::span<const Blocker* const> blockers, Tolerance tolerance) {
  require(tolerance.relative >= 0 && tolerance.absolute >= 0, "obstructed_form_factor: tolerances are not negative");
  return obstructed_form_factor(from, to, blockers, tolerance, form_factor(from, to, free_share(tolerance)));
}

ObstructedFormFactor obstructed_form_factor(const Polygon& from, const Polygon& to,
                                            std::span<const Blocker* const> blockers, Tolerance tolerance,
                                            const Bounded& free) {
  require(tolerance.relative >= 0 && tolerance.absolute >= 0, "obstructed_form_factor: tolerances are not negative");
  ObstructedFormFactor result;
  result.free = free;
  result.free.value = std::min(result.free.value, to.area() / from.area());
  static_cast<Bounded&>(result) = result.free;
  if (result.free.value == 0 || blockers.empty()) return result;
  const auto whole = whole_pair(from, to);
  const FacingPair pair = whole ? *whole : facing_pair(from, to);
  if (!pair.sees()) return result;
  if (result.free.value + result.free.bound <= tolerance.absolute) {
    result.value = 0.5 * result.free.value;
    result.bound = result.value + result.free.bound;
    return result;
  }
  const SightSpace space = sight_space(pair, from.vertices().front(), blockers);
  const auto clear = [](const SightZone& zone) { return !zone.dark && zone.outlines.empty(); };
  if (std::all_of(space.zones.begin(), space.zones.end(), clear)) return result;
  const auto asked = [&] { return std::max(tolerance.absolute, tolerance.relative * result.value); };
  OuterIntegral outer(space, result.free.value * pair.from_area, 0.5 * asked() * pair.from_area);
  for (;;) {
    const double integral = outer.value() / pair.from_area;
    result.bound = (outer.error() + outer.rounding()) / pair.from_area;
    if (outer.integrand() == Integrand::hidden) {
      result.value = result.free.value - integral;
      result.bound += result.free.bound;
    } else {
      result.value = integral;
    }
    if (result.bound <= asked() || outer.error() <= outer.rounding() || outer.exhausted()) break;
    outer.refine();
  }
  result.reached = result.bound <= asked();
  result.cells = outer.cells();
  result.evaluations = outer.evaluations();
  result.curved = outer.curved();
  clamp(result);
  return result;
}

ObstructedFormFactor obstructed_form_factor(const Polygon& from, const Polygon& to, std::span<const Polygon> plates,
                                            Tolerance tolerance, BlockingSides sides) {
  const Plates blockers(plates, sides);
  return obstructed_form_factor(from, to, blockers.pointers, tolerance);
}

Bounded visible_point_to_polygon(const Vec3& point, const Vec3& normal, const Polygon& polygon,
                                 std::span<const Polygon> plates) {
  const Plates blockers(plates, BlockingSides::both);
  return visible_point_to_polygon(point, normal, polygon, blockers.pointers);
}

Bounded visible_point_to_polygon(const Vec3& point, const Vec3& normal, const Polygon& polygon,
                                 std::span<const Blocker* const> blockers) {
  const Bounded free = point_to_polygon(point, normal, polygon);
  if (free.value == 0 || blockers.empty()) return free;
  const SightSpace space = sight_space(point, normal.normalized(), polygon, blockers);
  if (space.zones.front().dark) return {0, 0};  // it lies under a solid that stands on the surface
  ShadowView view(space.receiver, space.zones.front().outlines);
  const ShadowView::Seen seen = view.from(Vec2::Zero(), ShadowView::Want::both_bounded);
  // What no outline touches keeps the digits of the free factor.
  if (seen.hidden == 0) return free;
  return {std::clamp(seen.free - seen.hidden, 0.0, free.value), std::min(seen.bound, free.value + free.bound)};
}

}  // namespace etendue
