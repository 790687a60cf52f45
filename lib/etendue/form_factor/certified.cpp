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
#include "etendue/form_factor/certified_area.hpp"
#include "etendue/form_factor/certified_contour.hpp"
#include "etendue/form_factor/certified_outline.hpp"
#include "etendue/form_factor/certified_shadows.hpp"

namespace etendue {

namespace {

/// What both of two enclosures of one number hold.
Interval common(const Interval& a, const Interval& b) {
  return {std::max(a.lower, b.lower), std::min(a.upper, b.upper)};
}

/// A first idea of 2π A_1 F, and of the size of the pair over its distance: sets goals, never a bound.
struct Rough {
  double size = 0;
  double nearness = 0;
};

struct Middle {
  Vec3 centre = Vec3::Zero();
  Vec3 area = Vec3::Zero();
  double radius = 0;
};

Middle middle_of(const EnclosedOutline& outline) {
  Middle result;
  for (const Interval3& v : outline) result.centre += v.middle() / static_cast<double>(outline.size());
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3 a = outline[i].middle() - result.centre, b = outline[(i + 1) % outline.size()].middle() - result.centre;
    result.area += 0.5 * a.cross(b);
    result.radius = std::max(result.radius, a.norm());
  }
  return result;
}

Rough rough_size(const EnclosedPair& pair) {
  const Middle a = middle_of(pair.from), b = middle_of(pair.to);
  const Vec3 r = b.centre - a.centre;
  const double square = r.squaredNorm();
  const double kernel = std::abs(r.dot(a.area)) * std::abs(r.dot(b.area)) / (square * square);
  constexpr double kPi = 3;  // about
  return {2 * std::min(kernel, kPi * std::min(a.area.norm(), b.area.norm())), (a.radius + b.radius) / r.norm()};
}

/// 2π A_1 F, narrower with every attempt.
class PairEnclosure {
 public:
  PairEnclosure(const EnclosedPair& pair, const CertifiedGoal& goal) : pair_(pair), goal_(goal) {
    scale_ = Interval(1) / (Interval(2) * pi() * pair.area);
  }

  CertifiedFactor enclose() {
    const Rough rough = rough_size(pair_);
    double wanted = 0.25 * asked(rough.size);
    // A contour loses digits like the square of the distance over the size, an area needs nodes when near.
    constexpr double kFar = 0.4;
    const bool area_first = rough.nearness < kFar;
    for (int attempt = 0; attempt < kAttempts && !reached() && work_ < goal_.work; ++attempt) {
      if (area_first) add_area(wanted);
      if (!reached()) add_contour(wanted);
      if (!area_first && !reached()) add_area(wanted);
      const double half = 0.5 * (sum_.upper - sum_.lower), least = std::min(std::abs(sum_.lower), std::abs(sum_.upper));
      // A quarter of the goal for what is known now; the rounding that is left is none of the quadrature's. Where the sum
      // may still be zero, its size is taken for this share of what is not known.
      constexpr double kLeastShare = 1e-3;
      wanted = std::min(0.25 * asked(std::max(least, kLeastShare * half)), 0.125 * wanted);
    }
    return {factor(), reached(), work_};
  }

 private:
  double asked(double size) const {
    return std::max(goal_.tolerance.absolute / scale_.middle(), goal_.tolerance.relative * size);
  }
  Interval factor() const {
    const Interval f = sum_ * scale_;
    // 0 ≤ F ≤ 1 holds for the truth, and F A_1 is at most the other's area.
    const double most = std::min(1.0, f.upper);
    return {std::min(std::max(0.0, f.lower), most), std::max(0.0, most)};
  }
  bool reached() const {
    const Interval f = factor();
    return 0.5 * f.width() <= std::max(goal_.tolerance.absolute, goal_.tolerance.relative * f.middle());
  }
  void add_contour(double wanted) {
    sum_ = common(sum_, enclosed_contour(pair_.from, pair_.to, wanted, goal_.work, work_));
  }
  void add_area(double wanted) {
    if (const auto area = enclosed_area(pair_.from, pair_.to, wanted, goal_.work - work_, work_)) {
      sum_ = common(sum_, *area);
    }
  }

  static constexpr int kAttempts = 3;
  const EnclosedPair& pair_;
  const CertifiedGoal& goal_;
  Interval scale_;
  Interval sum_ = Interval::everything();
  std::int64_t work_ = 0;
};

void require_sane(const CertifiedGoal& goal) {
  require(goal.tolerance.relative >= 0 && goal.tolerance.absolute >= 0,
          "certified_form_factor: tolerances are not negative");
  require(goal.work > 0, "certified_form_factor: there is some work to spend");
}

}  // namespace

CertifiedFactor certified_form_factor(const Polygon& from, const Polygon& to, const CertifiedGoal& goal) {
  require_sane(goal);
  const EnclosedPair pair = enclosed_pair(from, to);
  if (pair.to.empty()) return {Interval(), true, 0};
  return PairEnclosure(pair, goal).enclose();
}

namespace {

/// No corner of `blocker` lies in front: exactly decided.
bool behind(const std::vector<Vec3>& blocker, const ExactPlane& plane) {
  return std::all_of(blocker.begin(), blocker.end(),
                     [&](const Vec3& v) { return !plane.height(v).certainly_positive(); });
}

constexpr std::size_t kMostBlockers = 32;  // one bit each

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

void require_convex(const std::vector<Vec3>& v) {
  const ExactPlane plane(v);
  const std::size_t n = v.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Interval3 here(v[i]), next(v[(i + 1) % n]), last(v[(i + 2) % n]);
    require(!dot(plane.normal(), cross(next - here, last - next)).certainly_negative(),
            "certified_form_factor: blockers are convex");
  }
}

}  // namespace

CertifiedFactor certified_form_factor(const Polygon& from, const Polygon& to, std::span<const Polygon> blockers,
                                      const CertifiedGoal& goal) {
  require_sane(goal);
  const EnclosedPair pair = enclosed_pair(from, to);
  if (pair.to.empty()) return {Interval(), true, 0};
  const std::vector<Vec3> from_vertices = scaled(from.vertices(), pair.scale);
  const std::vector<Vec3> to_vertices = scaled(to.vertices(), pair.scale);
  const ExactPlane from_plane(from_vertices), to_plane(to_vertices);
  std::vector<std::vector<Vec3>> standing;
  double taken = 0;
  for (const Polygon& blocker : blockers) {
    std::vector<Vec3> vertices = scaled(blocker.vertices(), pair.scale);
    require_convex(vertices);
    if (same_outline(vertices, from_vertices) || same_outline(vertices, to_vertices)) continue;
    if (behind(vertices, from_plane) || behind(vertices, to_plane)) continue;
    const auto beside_from = taken_beside(vertices, from_vertices, from_plane);
    const auto beside_to = beside_from ? beside_from : taken_beside(vertices, to_vertices, to_plane);
    if (beside_to) {
      taken = above(taken + *beside_to);
    } else {
      standing.push_back(std::move(vertices));
    }
  }
  require(standing.size() < kMostBlockers, "certified_form_factor: fewer than 32 blockers are in the way");
  CertifiedFactor result = PairEnclosure(pair, goal).enclose();
  if (standing.empty() && taken == 0) return result;
  const CertifiedFactor free = result;
  const auto asked = [&] {
    return std::max(goal.tolerance.absolute, goal.tolerance.relative * result.factor.middle());
  };
  constexpr int kAttempts = 3;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    HiddenFlux hidden;
    if (!standing.empty()) hidden = hidden_flux(pair, standing, 0.5 * asked() * pair.area.lower, goal.work);
    const Interval past = free.factor - (hidden.flux + Interval(0, taken)) / pair.area;
    // 0 ≤ F ≤ F_free holds for the truth.
    const double most = std::max(0.0, std::min(past.upper, result.factor.upper));
    result.factor = {std::clamp(past.lower, 0.0, most), most};
    result.work += hidden.work;
    result.reached = 0.5 * result.factor.width() <= asked();
    // What is left may be less than was thought, and so what is asked; without work to spare there is no better.
    if (result.reached || standing.empty() || 4 * hidden.work > goal.work) break;
  }
  return result;
}

}  // namespace etendue
