// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/flat_part.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace etendue {

namespace {

constexpr double kPi = std::numbers::pi;
/// Nearer to a line than this share of their distance, points are on it.
constexpr double kOnLine = 0x1p-40;
/// Narrower wedges [rad] hold less than rounding.
constexpr double kThinnest = 0x1p-50;

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}
double angle_of(const Vec2& p) {
  return std::atan2(p.y(), p.x());
}
Vec2 heading(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

/// The same angle, not before `begin` and less than a turn after it.
double after(double begin, double angle) {
  while (angle < begin) angle += 2 * kPi;
  while (angle >= begin + 2 * kPi) angle -= 2 * kPi;
  return angle;
}

}  // namespace

double PolarReach::along(const Vec2& direction) const {
  if (kind == Kind::distance) return size;
  const double slope = from.dot(direction);
  if (kind == Kind::line) return size / slope;
  const double square = slope * slope + (size * size - from.squaredNorm());
  return slope + root * std::sqrt(std::max(0.0, square));
}

FlatPart FlatPart::polygon(std::vector<Vec2> corners) {
  FlatPart part;
  part.arcs_.assign(corners.size(), false);
  part.corners_ = std::move(corners);
  return part;
}

FlatPart FlatPart::disc(double radius) {
  FlatPart part;
  part.rim_ = radius;
  for (const Vec2& corner : {Vec2(radius, 0), Vec2(0, radius), Vec2(-radius, 0), Vec2(0, -radius)}) {
    part.add(corner, true);
  }
  return part;
}

void FlatPart::add(const Vec2& corner, bool arc) {
  corners_.push_back(corner);
  arcs_.push_back(arc);
}

bool FlatPart::straight() const {
  return std::none_of(arcs_.begin(), arcs_.end(), [](bool arc) { return arc; });
}

FlatPart::Span FlatPart::arc(std::size_t k) const {
  const double begin = angle_of(corners_[k]);
  return {begin, after(begin, angle_of(next(k)))};
}

Vec2 FlatPart::middle() const {
  Vec2 sum = Vec2::Zero();
  double count = 0;
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    sum += corners_[k];
    count += 1;
    if (!arcs_[k]) continue;
    const Span span = arc(k);
    sum += rim_ * heading(0.5 * (span.begin + span.end));
    count += 1;
  }
  return sum / count;
}

/// With corners where the rim is farthest beyond the line and before it: between these every arc rises or falls.
FlatPart FlatPart::cut_at_extremes(const Vec2& normal) const {
  FlatPart part;
  part.rim_ = rim_;
  const double towards = angle_of(normal);
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    part.add(corners_[k], arcs_[k]);
    if (!arcs_[k]) continue;
    const Span span = arc(k);
    std::array<double, 2> extremes{after(span.begin, towards), after(span.begin, towards + kPi)};
    std::sort(extremes.begin(), extremes.end());
    for (const double extreme : extremes) {
      if (extreme > span.begin + kThinnest && extreme < span.end - kThinnest) part.add(rim_ * heading(extreme), true);
    }
  }
  return part;
}

void FlatPart::drop_unless_wide() {
  if (corners_.size() >= 3 || (corners_.size() == 2 && !straight())) return;
  corners_.clear();
  arcs_.clear();
}

std::pair<FlatPart, FlatPart> FlatPart::split(const Vec2& normal, double offset) const {
  const FlatPart whole = cut_at_extremes(normal);
  const std::size_t count = whole.corners_.size();
  FlatPart beyond, before;
  beyond.rim_ = before.rim_ = rim_;
  std::vector<double> heights;
  const double size = normal.norm();
  bool above = false, below = false;
  for (const Vec2& p : whole.corners_) {
    const double height = normal.dot(p) - offset;
    heights.push_back(std::abs(height) <= kOnLine * (size * p.norm() + std::abs(offset)) ? 0 : height);
    above = above || heights.back() > 0;
    below = below || heights.back() < 0;
  }
  if (!above || !below) return above ? std::pair(*this, before) : std::pair(beyond, *this);
  for (std::size_t k = 0; k < count; ++k) {
    const double here = heights[k], there = heights[(k + 1) % count];
    const bool arc = whole.arcs_[k];
    // What follows a corner on the line is that line where the next corner is on the other side.
    if (here >= 0) beyond.add(whole.corners_[k], arc && !(here == 0 && there < 0));
    if (here <= 0) before.add(whole.corners_[k], arc && !(here == 0 && there > 0));
    if (!(here * there < 0)) continue;
    Vec2 crossing = (there * whole.corners_[k] - here * whole.next(k)) / (there - here);
    if (arc) {
      const Span span = whole.arc(k);
      const double towards = angle_of(normal), half = std::acos(std::clamp(offset / (size * rim_), -1.0, 1.0));
      const double first = after(span.begin, towards - half), second = after(span.begin, towards + half);
      crossing = rim_ * heading(std::min(first, second));  // the only one before the arc ends
    }
    beyond.add(crossing, arc && there > 0);
    before.add(crossing, arc && there < 0);
  }
  beyond.drop_unless_wide();
  before.drop_unless_wide();
  return {beyond, before};
}

bool FlatPart::meets(const FlatCircle& circle) const {
  bool within = straight() || circle.centre.norm() < rim_;
  double nearest = HUGE_VAL;
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    nearest = std::min(nearest, (corners_[k] - circle.centre).norm());
    if (arcs_[k]) {
      const Span span = arc(k);
      if (after(span.begin, angle_of(circle.centre)) < span.end) {
        nearest = std::min(nearest, std::abs(circle.centre.norm() - rim_));
      }
      continue;
    }
    const Vec2 edge = next(k) - corners_[k], way = circle.centre - corners_[k];
    within = within && cross(edge, way) > 0;
    const double share = std::clamp(way.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (way - share * edge).norm());
  }
  return !corners_.empty() && (within || nearest < circle.radius * (1 - kOnLine));
}

/// Angles around the apex at which the form of a wedge may change: corners, and where the hole's circle crosses.
std::vector<double> FlatPart::turns(const Vec2& apex, double hole) const {
  std::vector<double> all;
  const auto add = [&](const Vec2& p) { all.push_back(angle_of(p - apex)); };
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    add(corners_[k]);
    if (!(hole > 0)) continue;
    if (arcs_[k]) {
      // Both circles: along the way from the rim's centre to the apex, and aside.
      const double distance = apex.norm(), along = (distance * distance + rim_ * rim_ - hole * hole) / (2 * distance);
      if (!(std::abs(along) < rim_)) continue;
      const double half = std::acos(along / rim_), towards = angle_of(apex);
      add(rim_ * heading(towards + half)), add(rim_ * heading(towards - half));
      continue;
    }
    const Vec2 edge = next(k) - corners_[k], way = corners_[k] - apex;
    const double a = edge.squaredNorm(), b = way.dot(edge), square = b * b - a * (way.squaredNorm() - hole * hole);
    if (!(square > 0)) continue;
    add(corners_[k] + (-b - std::sqrt(square)) / a * edge), add(corners_[k] + (-b + std::sqrt(square)) / a * edge);
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::vector<FlatPart::Hit> FlatPart::hits(const Vec2& apex, const Vec2& direction) const {
  std::vector<Hit> found;
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    if (!arcs_[k]) {
      const Vec2 edge = next(k) - corners_[k], way = corners_[k] - apex;
      const double turn = cross(direction, edge), share = cross(way, direction) / turn;
      if (!(turn != 0 && share >= 0 && share <= 1)) continue;
      const double distance = cross(way, edge) / turn;
      const Vec2 normal = Vec2(edge.y(), -edge.x()).normalized();
      if (distance > 0) found.push_back({distance, {PolarReach::Kind::line, normal.dot(way), normal, 1}});
      continue;
    }
    const Span span = arc(k);
    for (const double root : {-1.0, 1.0}) {
      const PolarReach reach{PolarReach::Kind::circle, rim_, -apex, root};
      const double distance = reach.along(direction);
      if (distance > 0 && after(span.begin, angle_of(apex + distance * direction)) <= span.end) {
        found.push_back({distance, reach});
      }
    }
  }
  std::sort(found.begin(), found.end(), [](const Hit& a, const Hit& b) { return a.distance < b.distance; });
  return found;
}

std::vector<Wedge> FlatPart::wedges(const Vec2& apex, double hole) const {
  std::vector<Wedge> found;
  const std::vector<double> all = turns(apex, hole);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const double turn = all[k], turns = (k + 1 < all.size() ? all[k + 1] : all.front() + 2 * kPi) - turn;
    if (!(turns > kThinnest)) continue;
    const std::vector<Hit> met = hits(apex, heading(turn + 0.5 * turns));
    if (met.empty() || met.back().distance <= hole) continue;
    const bool front = met.size() > 1 && met.front().distance > hole;
    found.push_back({apex, turn, turns,
                     front ? met.front().reach : PolarReach{PolarReach::Kind::distance, hole, Vec2::Zero(), 1},
                     met.back().reach});
  }
  return found;
}

}  // namespace etendue
