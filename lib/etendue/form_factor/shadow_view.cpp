// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/shadow_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/point_polygon.hpp"

namespace etendue {

namespace {

/// The plane over an edge as seen from the eye.
Vec3 plane_over(const ViewEdge& edge, const Vec3& eye) {
  return (edge.start - eye).cross(edge.along);
}

/// Square of the distance of the origin from an edge that starts at `start`.
double square_distance(const Vec3& start, const Vec3& along) {
  const double share = std::clamp(-start.dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (start + share * along).squaredNorm();
}

}  // namespace

ShadowView::ShadowView(std::span<const Vec3> receiver, std::span<const Outline> outlines)
    : receiver_(receiver), outlines_(outlines) {
  std::size_t count = receiver.size();
  for (const Outline& outline : outlines) count += outline.size();
  edges_.reserve(count);
  next_.reserve(count);
  receiver_form_.reserve(receiver.size() + 1);
  add_loop(receiver);
  for (std::uint32_t i = 0; i < receiver.size(); ++i) receiver_form_.push_back({i, i, false});
  receiver_form_.push_back({0, 0, true});
  for (const Outline& outline : outlines) add_loop(outline);
}

void ShadowView::add_loop(std::span<const Vec3> loop) {
  const auto first = static_cast<std::uint32_t>(edges_.size());
  for (std::size_t i = 0; i < loop.size(); ++i) {
    edges_.push_back({loop[i], loop[i + 1 < loop.size() ? i + 1 : 0] - loop[i]});
    next_.push_back(static_cast<std::uint32_t>(edges_.size()));
  }
  if (!loop.empty()) next_.back() = first;
}

/// Lambert's sum of a part seen from the origin, clockwise, by a surface across z.
double ShadowView::factor_of(const Part& part) {
  double sum = 0;
  const std::size_t n = part.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3& a = part[i].at;
    const Vec3& b = part[i + 1 < n ? i + 1 : 0].at;
    const Vec3 across = (b - a).cross(a);
    const double square = across.squaredNorm();
    if (!(square > 0)) continue;
    const double dot = a.dot(b), tangent_square = square / (dot * dot);
    if (dot > 0 && tangent_square < kShortArc) {
      double arc = 0;
      arc_over_tangent(tangent_square, arc);
      sum += across.z() / dot * arc;
      continue;
    }
    const double size = std::sqrt(square);
    sum += std::atan2(size, dot) * across.z() / size;
  }
  return sum * (0.5 / std::numbers::pi);
}

/// Where a part's edge and another cross; the corner of an outline, where the two follow one another along it.
ViewCorner ShadowView::crossing(std::uint32_t part_edge, std::uint32_t edge, const Vec3& at, const Vec3& eye) const {
  const auto meet = [&](std::uint32_t corner) { return (edges_[corner].start - eye).dot(at) > 0; };
  if (next_[part_edge] == edge && meet(edge)) return {edge, edge};
  if (next_[edge] == part_edge && meet(part_edge)) return {part_edge, part_edge};
  const bool ahead = plane_over(edges_[part_edge], eye).cross(plane_over(edges_[edge], eye)).dot(at) > 0;
  return ahead ? ViewCorner{part_edge, edge} : ViewCorner{edge, part_edge};
}

// Splits by the heights over the plane of an edge: what lies at h ≥ 0 replaces the part, what lies at h ≤ 0 goes to
// `outside`, if one is given.
void ShadowView::split(Part& part, std::uint32_t edge, const Vec3& eye, Part* outside) {
  buffer_.clear();
  if (outside) outside->clear();
  const std::size_t n = part.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Corner& corner = part[i];
    const std::size_t j = i + 1 < n ? i + 1 : 0;
    const double h = heights_[i], next = heights_[j];
    if (h >= 0) buffer_.push_back({corner.at, corner.name, h == 0 && next < 0 ? edge : corner.edge});
    if (h <= 0 && outside) outside->push_back({corner.at, corner.name, h == 0 && next > 0 ? edge : corner.edge});
    if ((h > 0 && next < 0) || (h < 0 && next > 0)) {
      const Vec3 at = corner.at + h / (h - next) * (part[j].at - corner.at);
      const ViewCorner name = trace_ ? crossing(corner.edge, edge, at, eye) : ViewCorner{};
      buffer_.push_back({at, name, h > 0 ? edge : corner.edge});
      if (outside) outside->push_back({at, name, h > 0 ? corner.edge : edge});
    }
  }
  part.swap(buffer_);
}

void ShadowView::take_shadow(std::size_t outline, const Vec3& eye, bool last, Want want, Seen& seen) {
  const std::size_t m = outlines_[outline].size();
  std::size_t first = receiver_.size();
  for (std::size_t k = 0; k < outline; ++k) first += outlines_[k].size();
  planes_.clear();
  for (std::size_t k = first; k < first + m; ++k) planes_.push_back(plane_over(edges_[k], eye));
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
      for (std::size_t i = 0; i < part.size() && !any; ++i) any = planes_[k].dot(part[i].at) > 0;
      misses = !any;
    }
    if (misses) {
      if (!last) keep().swap(part);
      continue;
    }
    for (std::size_t k = 0; k < m && part.size() >= 3; ++k) {
      heights_.clear();
      bool in = false, out = false;
      for (const Corner& corner : part) {
        heights_.push_back(planes_[k].dot(corner.at));
        in = in || heights_.back() > 0;
        out = out || heights_.back() < 0;
      }
      if (!out) continue;
      if (!in) {
        if (!last) keep().swap(part);
        part.clear();
        break;
      }
      split(part, static_cast<std::uint32_t>(first + k), eye, last ? nullptr : &keep());
      if (!last && remaining_[kept_ - 1].size() < 3) --kept_;
    }
    if (part.size() < 3) continue;
    if (trace_) note_shadow(first, first + m, part, eye);
    if (want == Want::both_bounded) {
      std::vector<Vec3> corners;
      for (const Corner& corner : part) corners.push_back(corner.at);
      const Bounded sum = lambert_sum(corners, Vec3::UnitZ());
      seen.hidden += sum.value;
      seen.bound += sum.bound + turning_of(outlines_[outline], eye);
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

void ShadowView::note_shadow(std::size_t first, std::size_t last, const Part& hidden, const Vec3& eye) {
  for (std::size_t k = first; k < last; ++k) {
    trace_->to_edges = std::min(trace_->to_edges, square_distance(edges_[k].start - eye, edges_[k].along));
  }
  for (const Corner& corner : hidden) {
    trace_->form.push_back(corner.name);
    trace_->to_crossings = std::min(trace_->to_crossings, square_to_crossing(corner.name, eye));
  }
  trace_->form.push_back(hidden[0].name);
  trace_->form.back().closes = true;
}

// Planes over edges whose lines are at the distances d₁ and d₂ turn by no more than 1/d₁ + 1/d₂ a length: as long as that
// is less than the sine of the angle between them, two that cross stay apart. With the edges' lengths e and the planes'
// normals n, d = |n|/e.
double ShadowView::square_to_crossing(const ViewCorner& corner, const Vec3& eye) const {
  if (corner.first == corner.second) return std::numeric_limits<double>::infinity();
  const ViewEdge &one = edges_[corner.first], &other = edges_[corner.second];
  const Vec3 n = plane_over(one, eye), m = plane_over(other, eye);
  const double turns =
      std::sqrt(one.along.squaredNorm() * m.squaredNorm()) + std::sqrt(other.along.squaredNorm() * n.squaredNorm());
  return turns > 0 ? n.cross(m).squaredNorm() / (turns * turns) : 0;
}

ShadowView::Survey ShadowView::survey(const Vec2& x, ViewForm& form) {
  const Vec3 eye(x.x(), x.y(), 0);
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Trace trace{form, kFar, kFar};
  trace_ = &trace;
  const Seen seen = from(x, Want::both);
  trace_ = nullptr;
  double edges = trace.to_edges;
  for (std::size_t i = 0; i < receiver_.size(); ++i) {
    edges = std::min(edges, square_distance(edges_[i].start - eye, edges_[i].along));
  }
  return {seen.free, seen.hidden, trace.to_edges == kFar, used_ == 0, std::sqrt(edges), std::sqrt(trace.to_crossings)};
}

ShadowView::Seen ShadowView::from(const Vec2& x, Want want) {
  const Vec3 eye(x.x(), x.y(), 0);
  if (parts_.empty()) {
    parts_.emplace_back();
    parts_[0].reserve(2 * receiver_.size() + 8);
    buffer_.reserve(2 * receiver_.size() + 8);
  }
  parts_[0].clear();
  for (std::uint32_t i = 0; i < receiver_.size(); ++i) parts_[0].push_back({receiver_[i] - eye, {i, i}, i});
  used_ = 1;
  Seen seen;
  if (want == Want::both) seen.free = factor_of(parts_[0]);
  if (want == Want::both_bounded) {
    std::vector<Vec3> corners;
    for (const Vec3& v : receiver_) corners.push_back(v - eye);
    const Bounded sum = lambert_sum(corners, Vec3::UnitZ());
    seen.free = sum.value;
    seen.bound = sum.bound;
  }
  for (std::size_t k = 0; k < outlines_.size() && used_ > 0; ++k) {
    take_shadow(k, eye, !trace_ && k + 1 == outlines_.size(), want, seen);
  }
  return seen;
}

}  // namespace etendue
