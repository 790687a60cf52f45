// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/point_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/loop.hpp"
#include "etendue/form_factor/point_polygon.hpp"

namespace etendue {

namespace {

// As for ShadowView (NOTES.md §5): a plane over an edge is turned by rounding, a corner that it cuts is off its edge.
constexpr int kCrossRoundings = 8;
constexpr int kCornerRoundings = 8;

/// Sine of the angle below which two corners lie in one direction: the plane over the edge between them would be made of
/// rounding, and to leave it out moves the outline by less than that angle.
constexpr double kOneDirection = 0x1p-44;

bool spans_plane(const Vec3& normal, const Vec3& a, const Vec3& b) {
  return normal.squaredNorm() > kOneDirection * kOneDirection * a.squaredNorm() * b.squaredNorm();
}

/// The turn into the frame moves a direction by 4u at most: less than Lambert's sum counts anyway (NOTES.md §15).
constexpr double kTurnedFrame = 2;

}  // namespace

PointView::PointView(const Vec3& point, const Vec3& normal, std::span<const Blocker* const> blockers)
    : frame_(frame_of(point, normal.normalized())) {
  require(point.allFinite(), "PointView: the point is finite");
  require(std::abs(normal.squaredNorm() - 1) <= 32 * kUnitRoundoff, "PointView: normal is a unit vector");
  for (std::vector<Outline>& outlines : point_outlines(frame_, blockers)) {
    cones_.emplace_back();
    for (Outline& outline : outlines) {
      Cone cone{std::move(outline), {}, 0};
      for (std::size_t k = 0; k < cone.corners.size(); ++k) {
        const Vec3 &a = cone.corners[k], &b = cone.corners[k + 1 < cone.corners.size() ? k + 1 : 0];
        const Vec3 edge = b - a;
        const Vec3 plane = a.cross(edge);
        if (!spans_plane(plane, a, b)) {
          cone.turned += kOneDirection / kUnitRoundoff;
          continue;
        }
        cone.planes.push_back(plane);
        const double across = plane.norm();
        cone.turned += kCrossRoundings * edge.norm() * std::min(a.norm(), b.norm()) / across;
      }
      // Fewer planes bound no cone: an outline seen edge-on hides nothing.
      if (cone.planes.size() >= 3) cones_.back().push_back(std::move(cone));
    }
  }
}

// Two convex cones are apart where a plane over an edge of either says so.
bool PointView::misses(const Cone& cone, const Part& part) const {
  for (const Vec3& plane : cone.planes) {
    const auto outside = [&](const Vec3& corner) { return plane.dot(corner) <= 0; };
    if (std::all_of(part.begin(), part.end(), outside)) return true;
  }
  for (std::size_t i = 0; i < part.size(); ++i) {
    const Vec3& a = part[i];
    const Vec3& b = part[i + 1 < part.size() ? i + 1 : 0];
    const Vec3 plane = b.cross(a);  // a part runs counter-clockwise as seen from its front: inwards
    if (!spans_plane(plane, a, b)) continue;
    const auto outside = [&](const Vec3& corner) { return plane.dot(corner) <= 0; };
    if (std::all_of(cone.corners.begin(), cone.corners.end(), outside)) return true;
  }
  return false;
}

// Splits by heights_ over a plane.
void PointView::split(Part& inside, Part& outside) {
  buffer_.clear();
  outside.clear();
  const std::size_t n = inside.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = i + 1 < n ? i + 1 : 0;
    const double h = heights_[i], next = heights_[j];
    if (h >= 0) buffer_.push_back(inside[i]);
    if (h <= 0) outside.push_back(inside[i]);
    if ((h > 0 && next < 0) || (h < 0 && next > 0)) {
      const Vec3 at = inside[i] + h / (h - next) * (inside[j] - inside[i]);
      buffer_.push_back(at);
      outside.push_back(at);
    }
  }
  inside.swap(buffer_);
}

// Takes off what is inside of the cone, one half-space after the other; whether there was any.
bool PointView::take(const Cone& cone) {
  std::size_t kept = 0;
  bool any = false;
  const auto keep = [&]() -> Part& {
    if (kept == kept_.size()) kept_.emplace_back();
    return kept_[kept++];
  };
  for (std::size_t p = 0; p < used_; ++p) {
    Part& part = parts_[p];
    if (misses(cone, part)) {
      keep().swap(part);
      continue;
    }
    any = true;
    for (std::size_t k = 0; k < cone.planes.size() && part.size() >= 3; ++k) {
      heights_.clear();
      bool in = false, out = false;
      for (const Vec3& corner : part) {
        heights_.push_back(cone.planes[k].dot(corner));
        in = in || heights_.back() > 0;
        out = out || heights_.back() < 0;
      }
      if (!out) continue;
      if (!in) {
        keep().swap(part);
        part.clear();
        break;
      }
      split(part, keep());
      if (kept_[kept - 1].size() < 3) --kept;
    }
  }
  parts_.swap(kept_);
  used_ = kept;
  return any;
}

Bounded PointView::factor(std::span<const Vec3> corners, std::span<const std::size_t> hiding) {
  if (parts_.empty()) parts_.emplace_back();
  Part& whole = parts_[0];
  whole.clear();
  heights_.clear();
  bool behind = false;
  for (const Vec3& v : corners) {
    whole.push_back(frame_.placed(v));
    heights_.push_back(whole.back().z());
    behind = behind || heights_.back() < 0;
  }
  if (behind) {
    whole = clip(whole, heights_);
    if (whole.size() < 3) return {0, 0};
  }
  double nearest = whole[0].norm(), farthest = nearest;
  for (const Vec3& v : whole) {
    nearest = std::min(nearest, v.norm());
    farthest = std::max(farthest, v.norm());
  }
  used_ = 1;
  double turned = 0;
  for (const std::size_t blocker : hiding) {
    for (const Cone& cone : cones_[blocker]) {
      if (used_ == 0 || !take(cone)) continue;
      const double moved = nearest > 0 ? farthest / nearest : 0;
      turned += cone.turned + 2 * kCornerRoundings * static_cast<double>(cone.planes.size()) * moved;
    }
  }
  Bounded sum{0, turned * kUnitRoundoff * (2 / std::numbers::pi)};
  for (std::size_t p = 0; p < used_; ++p) {
    const Bounded part = lambert_sum(parts_[p], Vec3::UnitZ());
    sum = {sum.value + part.value, sum.bound + kTurnedFrame * part.bound};
  }
  // 0 ≤ F ≤ 1 holds for the truth: moving the value into the range by at most its error only brings it nearer.
  return {std::clamp(sum.value, 0.0, 1.0), std::min(sum.bound, 1.0)};
}

}  // namespace etendue
