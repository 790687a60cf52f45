// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/certified.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "etendue/core/contract.hpp"
#include "etendue/form_factor/blocker.hpp"
#include "etendue/form_factor/certified_flux.hpp"
#include "etendue/form_factor/certified_outline.hpp"
#include "etendue/form_factor/certified_parts.hpp"
#include "etendue/form_factor/certified_shadows.hpp"
#include "etendue/form_factor/hull_flux.hpp"

namespace etendue {

namespace {

void require_sane(const CertifiedGoal& goal) {
  require(goal.tolerance.relative >= 0 && goal.tolerance.absolute >= 0,
          "certified_form_factor: tolerances are not negative");
  require(goal.work > 0, "certified_form_factor: there is some work to spend");
}

}  // namespace

CertifiedFactor certified_form_factor(const Polygon& from, const Polygon& to, const CertifiedGoal& goal) {
  require_sane(goal);
  const EnclosedPair pair = enclosed_pair(from, to);
  return enclosed_factor(pair, goal);
}

namespace {

/// No corner of `blocker` lies in front: exactly decided.
bool behind(const std::vector<Vec3>& blocker, const ExactPlane& plane) {
  return std::all_of(blocker.begin(), blocker.end(),
                     [&](const Vec3& v) { return !plane.height(v).certainly_positive(); });
}

/// Vertices of a blocker this near to a plane, in units of the scaled scene, may be in it but for rounding.
constexpr double kInPlane = 0x1p-40;

bool same_outline(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return a.size() == b.size() && std::is_permutation(a.begin(), a.end(), b.begin());
}

/// Upper bound on the flux that a blocker in `polygon`'s plane but for rounding, and beside the polygon, can take: what
/// passes below the blocker's height over its outline, and what starts below the blocker. No surface hands on more
/// than its area. Nothing where the blocker is elsewhere or over the polygon.
std::optional<double> taken_beside(const std::vector<Vec3>& blocker, const std::vector<Vec3>& polygon,
                                   const ExactPlane& plane) {
  const Interval area = norm(plane.normal());
  double highest = 0;
  Interval outline, extent;
  for (std::size_t i = 0; i < blocker.size(); ++i) {
    highest = std::max(highest, (abs(plane.height(blocker[i])) / area).upper);
    outline = outline + norm(Interval3(blocker[(i + 1) % blocker.size()]) - Interval3(blocker[i]));
  }
  if (!(highest <= kInPlane)) return std::nullopt;
  for (const Vec3& v : polygon) extent = max(extent, norm(Interval3(v) - Interval3(polygon.front())));
  double narrowest = std::numeric_limits<double>::infinity();
  for (const auto* edges : {&blocker, &polygon}) {
    for (std::size_t i = 0; i < edges->size(); ++i) {
      const Interval3 start((*edges)[i]), way = Interval3((*edges)[(i + 1) % edges->size()]) - start;
      const Interval3 left = cross(plane.normal(), way);
      const Interval length = norm(left);
      // The strip between the two that an edge's line fails to keep apart, whichever side either is on.
      double polygon_low = 0, polygon_high = 0, blocker_low = 0, blocker_high = 0;
      const auto range = [&](const std::vector<Vec3>& points, double& low, double& high) {
        for (std::size_t k = 0; k < points.size(); ++k) {
          const Interval offset = dot(left, Interval3(points[k]) - start) / length;
          low = k == 0 ? offset.lower : std::min(low, offset.lower);
          high = k == 0 ? offset.upper : std::max(high, offset.upper);
        }
      };
      range(polygon, polygon_low, polygon_high);
      range(blocker, blocker_low, blocker_high);
      const double overlap =
          std::min((Interval(polygon_high) - blocker_low).upper, (Interval(blocker_high) - polygon_low).upper);
      narrowest = std::min(narrowest, std::max(0.0, overlap));
    }
  }
  if (!(narrowest <= kInPlane)) return std::nullopt;
  return (Interval(highest) * outline + Interval(narrowest) * Interval(4) * extent).upper;
}

/// Of the part of a polygon on one side of a plane, the area at most.
double area_beyond(const std::vector<Vec3>& polygon, const ExactPlane& plane, double side) {
  std::vector<Interval> heights;
  for (const Vec3& v : polygon) heights.push_back(side > 0 ? plane.height(v) : -plane.height(v));
  const EnclosedOutline part = clipped(EnclosedOutline(polygon.begin(), polygon.end()), heights);
  Interval sum;  // whatever the order of the corners
  for (std::size_t i = 1; i + 1 < part.size(); ++i) sum = sum + norm(cross(part[i] - part[0], part[i + 1] - part[0]));
  return (Interval(0.5) * sum).upper;
}

/// What a blocker with both on one side of its plane, but for slices that rounding makes, can take: only lines that start or
/// end in these cross the plane. Nothing where there is more than slices.
std::optional<double> taken_by_slices(const std::vector<Vec3>& from, const std::vector<Vec3>& to,
                                      const ExactPlane& plane) {
  constexpr double kSlice = 0x1p-36;  // of either area
  for (const double side : {1.0, -1.0}) {
    const double a = area_beyond(from, plane, side), b = area_beyond(to, plane, side);
    const double least = std::min(area_beyond(from, plane, -side), area_beyond(to, plane, -side));
    if (above(a + b) <= kSlice * least) return above(a + b);
  }
  return std::nullopt;
}

/// Is the outline convex for certain, but for straight corners?
bool certainly_convex(const std::vector<Vec3>& v, const ExactPlane& plane) {
  const std::size_t n = v.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Interval3 here(v[i]), next(v[(i + 1) % n]), last(v[(i + 2) % n]);
    if (dot(plane.normal(), cross(next - here, last - next)).certainly_negative()) return false;
  }
  return true;
}

bool exactly_flat(const std::vector<Vec3>& outline) {
  const ExactPlane plane(outline);
  return outline.size() == 3 ||
         std::all_of(outline.begin(), outline.end(), [&](const Vec3& v) { return plane.height(v).is_zero(); });
}

/// The pair, and what stands between for certain or perhaps.
class ObstructedEnclosure {
 public:
  ObstructedEnclosure(const Polygon& from, const Polygon& to, const CertifiedGoal& goal)
      : goal_(goal),
        pair_(enclosed_pair(from, to)),
        from_(scaled(from.vertices(), pair_.scale)),
        to_(scaled(to.vertices(), pair_.scale)),
        from_plane_(from_),
        to_plane_(to_) {
    // A cut by the other's plane leaves corners that are known within boxes.
    const bool whole = std::all_of(pair_.to.begin(), pair_.to.end(), [](const Interval3& v) {
      return v.x.width() == 0 && v.y.width() == 0 && v.z.width() == 0;
    });
    pair_.flat = pair_.to.size() == 3 || (whole && exactly_flat(to_));
  }

  void add(const Polygon& blocker) {
    if (pair_.to.empty()) return;
    std::vector<Vec3> vertices = scaled(blocker.vertices(), pair_.scale);
    if (same_outline(vertices, from_) || same_outline(vertices, to_)) return;
    if (behind(vertices, from_plane_) || behind(vertices, to_plane_)) return;
    const ExactPlane plane(vertices);
    if (const auto slices = taken_by_slices(from_, to_, plane)) {
      taken_ = above(taken_ + *slices);
      return;
    }
    if (certainly_convex(vertices, plane)) return add_convex(std::move(vertices));
    // The chains of the triangles add up to the outline's. If none turns the other way, no two overlap and they are the
    // polygon: the outline of a simple one winds around any point once at most.
    for (const auto& piece : convex_pieces(vertices, plane.normal().middle().normalized())) {
      std::vector<Vec3> part;
      for (const std::size_t k : piece) part.push_back(vertices[k]);
      const Interval turn = dot(plane.normal(), doubled_area_of(EnclosedOutline(part.begin(), part.end())));
      untold_ = untold_ || turn.certainly_negative();
      add_convex(std::move(part));
    }
  }

  CertifiedFactor enclose() {
    if (pair_.to.empty()) return {Interval(), true, 0};
    result_ = enclosed_factor(pair_, goal_);
    free_ = result_.factor;
    if (untold_) {
      result_.factor.lower = 0;
      return judged();
    }
    const HullPair hulls(pair_, from_plane_, to_plane_);
    std::erase_if(standing_, [&](const std::vector<Vec3>& blocker) {
      const std::optional<double> lost = hulls.lost_past(blocker);
      if (lost) taken_ = above(taken_ + *lost);
      return lost.has_value();
    });
    if (standing_.empty() && taken_ == 0) return judged();
    result_.factor.lower = 0;
    result_.blockers = standing_.size();
    if (standing_.empty()) narrow(Interval(0, taken_));
    if (standing_.empty() || judged().reached) return judged();
    result_.by = EnclosedBy::shadow_hulls;
    const EnclosedPair back{pair_.to, pair_.from, Interval(), pair_.scale};
    const HullPair turned(back, to_plane_, from_plane_);
    // A first look from both sides: shadows are sharper from one of the two.
    const std::int64_t look = std::max<std::int64_t>(1, goal_.work / kLookShare);
    const double there = width_after(hulls.hidden_flux(standing_, asked_flux(), look));
    if (judged().reached) return judged();
    const double here = width_after(turned.hidden_flux(standing_, asked_flux(), look));
    if (judged().reached) return judged();
    // Hulls narrow like one over the root of the work. Where that will not do, event lines are tried before.
    const double to_come = std::min(there, here) / std::sqrt(static_cast<double>(kLookShare));
    constexpr double kHopeful = 1.5;
    if (!(0.5 * to_come <= kHopeful * 2 * asked_flux())) split_along_events();
    if (judged().reached) return judged();
    const std::int64_t left = std::max<std::int64_t>(1, goal_.work - result_.work);
    width_after((there <= here ? hulls : turned).hidden_flux(standing_, asked_flux(), left));
    return judged();
  }

 private:
  void add_convex(std::vector<Vec3> vertices) {
    const auto beside_from = taken_beside(vertices, from_, from_plane_);
    const auto beside_to = beside_from ? beside_from : taken_beside(vertices, to_, to_plane_);
    if (beside_to) {
      taken_ = above(taken_ + *beside_to);
    } else {
      standing_.push_back(std::move(vertices));
    }
  }

  double asked() const {
    return std::max(goal_.tolerance.absolute, goal_.tolerance.relative * result_.factor.middle());
  }
  double asked_flux() const { return 0.5 * asked() * pair_.area.lower; }
  CertifiedFactor judged() {
    result_.reached = 0.5 * result_.factor.width() <= asked();
    return result_;
  }
  /// 0 ≤ F ≤ F_free holds for the truth; so does every enclosure that was found.
  void narrow(const Interval& hidden) {
    const Interval past = free_ - hidden / pair_.area;
    Interval& f = result_.factor;
    f.upper = std::clamp(past.upper, f.lower, f.upper);
    f.lower = std::clamp(past.lower, f.lower, f.upper);
  }
  double width_after(const HiddenFlux& hidden) {
    result_.work += hidden.work;
    narrow(hidden.flux + Interval(0, taken_));
    return hidden.flux.width();
  }
  void split_along_events() {
    // Inclusion and exclusion over more blockers than this is not worth its sets.
    constexpr std::size_t kMostInSets = 6;
    constexpr int kAttempts = 3;
    const std::int64_t budget = std::max<std::int64_t>(1, goal_.work / 2);
    const double before = result_.factor.width();
    std::vector<std::vector<Vec3>> flat;
    for (const std::vector<Vec3>& blocker : standing_) {
      if (exactly_flat(blocker)) {
        flat.push_back(blocker);
        continue;
      }
      for (std::size_t i = 1; i + 1 < blocker.size(); ++i) flat.push_back({blocker[0], blocker[i], blocker[i + 1]});
    }
    if (flat.size() > kMostInSets) return;
    for (int attempt = 0; attempt < kAttempts && !judged().reached; ++attempt) {
      const HiddenFlux hidden = etendue::hidden_flux(pair_, flat, asked_flux(), budget);
      if (!hidden.enclosed) {
        result_.work += hidden.work;
        return;
      }
      width_after(hidden);
      // What is left may be less than was thought, and so what is asked; without work to spare there is no better.
      if (4 * hidden.work > budget) break;
    }
    if (result_.factor.width() < before) result_.by = EnclosedBy::event_lines;
  }

  static constexpr std::int64_t kLookShare = 16;
  CertifiedGoal goal_;
  EnclosedPair pair_;
  std::vector<Vec3> from_, to_;
  ExactPlane from_plane_, to_plane_;
  std::vector<std::vector<Vec3>> standing_;
  double taken_ = 0;
  bool untold_ = false;
  Interval free_;
  CertifiedFactor result_;
};

}  // namespace

CertifiedFactor certified_form_factor(const Polygon& from, const Polygon& to, std::span<const Polygon> blockers,
                                      const CertifiedGoal& goal) {
  require_sane(goal);
  ObstructedEnclosure enclosure(from, to, goal);
  for (const Polygon& blocker : blockers) enclosure.add(blocker);
  return enclosure.enclose();
}

}  // namespace etendue
