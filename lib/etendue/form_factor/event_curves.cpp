// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/event_curves.hpp"

#include <algorithm>
#include <cstddef>

namespace etendue {

namespace {

/// The plane over an edge as seen from x.
Vec3 plane_over(const EventCurve::Edge& edge, const Vec2& x) {
  const Vec3 eye(x.x(), x.y(), 0);
  return (edge.start - eye).cross(edge.end - edge.start);
}

/// An edge as seen from a point, with the loop it belongs to.
struct Seen {
  EventCurve::Edge edge;
  Vec3 start, end;
  Vec3 plane;
  std::size_t loop;
};

bool cross(const Seen& a, const Seen& b) {
  if (a.loop == b.loop) return false;
  return a.plane.dot(b.start) * a.plane.dot(b.end) < 0 && b.plane.dot(a.start) * b.plane.dot(a.end) < 0;
}

void add_seen(std::vector<Seen>& all, std::span<const Vec3> loop, std::size_t index, const Vec2& x) {
  const Vec3 eye(x.x(), x.y(), 0);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec3 &a = loop[i], &b = loop[i + 1 < loop.size() ? i + 1 : 0];
    const Vec3 start = a - eye, end = b - eye;
    all.push_back({{a, b}, start, end, start.cross(end), index});
  }
}

}  // namespace

EventCurve::EventCurve(const Edge& first, const Edge& second, const Edge& third) : edges_{first, second, third} {}

bool EventCurve::operator==(const EventCurve& other) const {
  for (int i = 0; i < 3; ++i) {
    if (edges_[i].start != other.edges_[i].start || edges_[i].end != other.edges_[i].end) return false;
  }
  return true;
}

double EventCurve::at(const Vec2& x) const {
  return plane_over(edges_[0], x).cross(plane_over(edges_[1], x)).dot(plane_over(edges_[2], x));
}

bool EventCurve::may_cross(const Cell& cell) const {
  // Edges along the axes make conics of lines that the cells were cut along already, or that vanish everywhere: a value
  // within the rounding of corners and cuts, compared with the planes' own sizes, is on the curve and beside nothing.
  constexpr double kOnCurve = 0x1p-36;
  double size = 0;
  for (int i = 0; i < cell.size(); ++i) {
    double product = 1;
    for (const Edge& edge : edges_) product *= plane_over(edge, cell[i]).norm();
    size = std::max(size, product);
  }
  bool positive = false, negative = false;
  const auto note = [&](double value) {
    positive = positive || value > kOnCurve * size;
    negative = negative || value < -kOnCurve * size;
  };
  // Of the quadratic on each triangle of a fan: values at the corners, 2 f(middle) − (f_i + f_j)/2 at the sides.
  std::array<double, Cell::kMostCorners> values{};
  for (int i = 0; i < cell.size(); ++i) note(values[static_cast<std::size_t>(i)] = at(cell[i]));
  const auto side = [&](int i, int j) {
    const double ends = values[static_cast<std::size_t>(i)] + values[static_cast<std::size_t>(j)];
    note(2 * at(0.5 * (cell[i] + cell[j])) - 0.5 * ends);
  };
  for (int i = 1; i < cell.size() && !(positive && negative); ++i) {
    side(0, i);
    if (i + 1 < cell.size()) side(i, i + 1);
  }
  return positive && negative;
}

namespace {

/// The curves of the edges that cross one another pairwise as seen from x, and may cross the cell.
void add_curves(std::span<const Vec3> receiver, std::span<const Outline> outlines, const Cell& cell, const Vec2& x,
                std::vector<EventCurve>& curves) {
  std::vector<Seen> seen;
  add_seen(seen, receiver, 0, x);
  for (std::size_t k = 0; k < outlines.size(); ++k) add_seen(seen, outlines[k], k + 1, x);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (std::size_t j = i + 1; j < seen.size(); ++j) {
      if (!cross(seen[i], seen[j])) continue;
      for (std::size_t k = j + 1; k < seen.size(); ++k) {
        if (!cross(seen[i], seen[k]) || !cross(seen[j], seen[k])) continue;
        const EventCurve curve(seen[i].edge, seen[j].edge, seen[k].edge);
        if (std::find(curves.begin(), curves.end(), curve) == curves.end() && curve.may_cross(cell)) {
          curves.push_back(curve);
        }
      }
    }
  }
}

}  // namespace

std::vector<EventCurve> event_curves(std::span<const Vec3> receiver, std::span<const Outline> outlines,
                                     const Cell& cell) {
  std::vector<EventCurve> curves;
  if (outlines.size() < 2) return curves;
  const Vec2 centre = cell.centre();
  add_curves(receiver, outlines, cell, centre, curves);
  // Events beyond the receiver's outline are not among the critical lines, and may part the cell near its corners.
  constexpr double kInward = 0.9;
  for (int i = 0; i < cell.size(); ++i) {
    add_curves(receiver, outlines, cell, centre + kInward * (cell[i] - centre), curves);
  }
  return curves;
}

}  // namespace etendue
