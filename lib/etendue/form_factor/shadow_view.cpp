// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/shadow_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/point_polygon.hpp"

namespace etendue {

namespace {

/// atan(√q)/√q for q up to kShortArc: what Taylor's series leaves out, q⁹/19, is below 2^-58.
constexpr double kShortArc = 1.0 / 64;
double arc_over_tangent(double q) {
  constexpr std::array<double, 9> kTaylor{1.0 / 17, 1.0 / 15, 1.0 / 13, 1.0 / 11, 1.0 / 9,
                                          1.0 / 7,  1.0 / 5,  1.0 / 3,  1};
  double sum = 0;
  for (const double coefficient : kTaylor) sum = coefficient - q * sum;
  return sum;
}

/// Lambert's sum of a loop seen from the origin, clockwise, by a surface across z.
double factor_of(const std::vector<Vec3>& loop) {
  double sum = 0;
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& a = loop[i];
    const Vec3& b = loop[i + 1 < n ? i + 1 : 0];
    const Vec3 across = (b - a).cross(a);
    const double square = across.squaredNorm();
    if (!(square > 0)) continue;
    const double dot = a.dot(b), tangent_square = square / (dot * dot);
    if (dot > 0 && tangent_square < kShortArc) {
      sum += across.z() / dot * arc_over_tangent(tangent_square);
      continue;
    }
    const double size = std::sqrt(square);
    sum += std::atan2(size, dot) * across.z() / size;
  }
  return sum * (0.5 / std::numbers::pi);
}

/// Splits the part by heights h: what lies at h ≥ 0 replaces it, what lies at h ≤ 0 goes to `outside`, if one is given.
void split(std::vector<Vec3>& part, const std::vector<double>& heights, std::vector<Vec3>& inside,
           std::vector<Vec3>* outside) {
  inside.clear();
  if (outside) outside->clear();
  const std::size_t n = part.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = i + 1 < n ? i + 1 : 0;
    const double h = heights[i], next = heights[j];
    if (h >= 0) inside.push_back(part[i]);
    if (h <= 0 && outside) outside->push_back(part[i]);
    if ((h > 0 && next < 0) || (h < 0 && next > 0)) {
      const Vec3 corner = part[i] + h / (h - next) * (part[j] - part[i]);
      inside.push_back(corner);
      if (outside) outside->push_back(corner);
    }
  }
  part.swap(inside);
}

/// Of the origin from the edge from a to b.
double distance(const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double share = std::clamp(-a.dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (a + share * along).norm();
}

}  // namespace

ShadowView::ShadowView(std::span<const Vec3> receiver, std::span<const Outline> outlines)
    : receiver_(receiver), outlines_(outlines) {}

void ShadowView::take_shadow(std::size_t outline, const Vec3& eye, bool last, Want want, Seen& seen) {
  const Outline& loop = outlines_[outline];
  const std::size_t m = loop.size();
  planes_.clear();
  for (std::size_t k = 0; k < m; ++k) {
    const Vec3& a = loop[k];
    const Vec3& b = loop[k + 1 < m ? k + 1 : 0];
    planes_.push_back((a - eye).cross(b - a));
  }
  kept_ = 0;
  const auto keep = [&]() -> Part& {
    if (kept_ == remaining_.size()) remaining_.emplace_back();
    return remaining_[kept_++];
  };
  for (std::size_t p = 0; p < used_; ++p) {
    Part& part = parts_[p];
    // Wholly beside one of the planes: no shadow falls on it.
    bool misses = false;
    for (std::size_t k = 0; k < m && !misses; ++k) {
      bool any = false;
      for (std::size_t i = 0; i < part.size() && !any; ++i) any = planes_[k].dot(part[i]) > 0;
      misses = !any;
    }
    if (misses) {
      if (!last) keep().swap(part);
      continue;
    }
    for (std::size_t k = 0; k < m && part.size() >= 3; ++k) {
      heights_.clear();
      bool in = false, out = false;
      for (const Vec3& v : part) {
        heights_.push_back(planes_[k].dot(v));
        in = in || heights_.back() > 0;
        out = out || heights_.back() < 0;
      }
      if (!out) continue;
      if (!in) {
        if (!last) keep().swap(part);
        part.clear();
        break;
      }
      if (trace_) {
        const double length = (loop[k + 1 < m ? k + 1 : 0] - loop[k]).norm();
        trace_->to_lines = std::min(trace_->to_lines, planes_[k].norm() / length);
      }
      split(part, heights_, buffer_, last ? nullptr : &keep());
      if (!last && remaining_[kept_ - 1].size() < 3) --kept_;
    }
    if (part.size() < 3) continue;
    if (trace_) note_shadow(loop, part, eye);
    if (want == Want::both_bounded) {
      const Bounded sum = lambert_sum(part, Vec3::UnitZ());
      seen.hidden += sum.value;
      seen.bound += sum.bound + turning_of(loop, eye);
    } else {
      seen.hidden += factor_of(part);
    }
  }
  parts_.swap(remaining_);
  used_ = kept_;
}

// Rounding turns the plane over an edge by an angle ε, and moves what it cuts by no more than the lune between the two
// planes, of solid angle 2ε: at most 2ε/π of the factor, at whatever angle it meets the outline that it cuts. A new corner
// lies off its edge by the rounding of the edge's ends, an angle of that over its distance.
double ShadowView::turning_of(const Outline& loop, const Vec3& eye) const {
  constexpr int kCrossRoundings = 8;   // two differences and their product, twice: the plane, and the heights over it
  constexpr int kCornerRoundings = 8;  // the share, its product, the sum, the differences from the eye
  double nearest = (receiver_[0] - eye).norm(), farthest = nearest, sum = 0;
  for (const Vec3& v : receiver_) {
    nearest = std::min(nearest, (v - eye).norm());
    farthest = std::max(farthest, (v - eye).norm());
  }
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec3 a = loop[k] - eye, b = loop[k + 1 < loop.size() ? k + 1 : 0] - eye;
    const double across = a.cross(b).norm();
    const double turned = across > 0 ? (b - a).norm() * std::min(a.norm(), b.norm()) / across : 0;
    const double moved = nearest > 0 ? farthest / nearest : 0;
    sum += kUnitRoundoff * (kCrossRoundings * turned + 2 * kCornerRoundings * moved);
  }
  return sum * (2 / std::numbers::pi);
}

void ShadowView::note_shadow(const Outline& loop, const Part& hidden, const Vec3& eye) {
  for (std::size_t k = 0; k < loop.size(); ++k) {
    trace_->to_edges = std::min(trace_->to_edges, distance(loop[k] - eye, loop[k + 1 < loop.size() ? k + 1 : 0] - eye));
  }
  const std::size_t n = hidden.size();
  Vec3 before = hidden[n - 1].cross(hidden[0]);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 next = hidden[i].cross(hidden[i + 1 < n ? i + 1 : 0]);
    const double sizes = before.norm() * next.norm();
    if (sizes > 0) trace_->least_sine = std::min(trace_->least_sine, before.cross(next).norm() / sizes);
    before = next;
  }
}

ShadowView::Survey ShadowView::survey(const Vec2& x) {
  const Vec3 eye(x.x(), x.y(), 0);
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Trace trace{kFar, kFar};
  trace_ = &trace;
  const Seen seen = from(x, Want::both);
  trace_ = nullptr;
  Survey survey{seen.free, seen.hidden, trace.to_edges == kFar, used_ == 0, kFar};
  double lines = kFar;
  for (std::size_t i = 0; i < receiver_.size(); ++i) {
    const Vec3 a = receiver_[i] - eye, b = receiver_[i + 1 < receiver_.size() ? i + 1 : 0] - eye;
    survey.reach = std::min(survey.reach, distance(a, b));
    lines = std::min(lines, a.cross(b).norm() / (b - a).norm());
  }
  survey.reach = std::min(survey.reach, trace.to_edges);
  // Planes over edges at these distances turn by no more than 1/d₁ + 1/d₂ a length: until then they stay apart.
  if (trace.to_lines < kFar) {
    survey.reach = std::min(survey.reach, trace.least_sine / (1 / lines + 1 / trace.to_lines));
  }
  return survey;
}

ShadowView::Seen ShadowView::from(const Vec2& x, Want want) {
  const Vec3 eye(x.x(), x.y(), 0);
  if (parts_.empty()) parts_.emplace_back();
  parts_[0].clear();
  for (const Vec3& v : receiver_) parts_[0].push_back(v - eye);
  used_ = 1;
  Seen seen;
  if (want == Want::both) seen.free = factor_of(parts_[0]);
  if (want == Want::both_bounded) {
    const Bounded sum = lambert_sum(parts_[0], Vec3::UnitZ());
    seen.free = sum.value;
    seen.bound = sum.bound;
  }
  for (std::size_t k = 0; k < outlines_.size() && used_ > 0; ++k) {
    take_shadow(k, eye, !trace_ && k + 1 == outlines_.size(), want, seen);
  }
  return seen;
}

}  // namespace etendue
