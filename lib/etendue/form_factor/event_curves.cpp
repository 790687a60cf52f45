// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/event_curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

/// The plane over an edge as seen from x.
Vec3 plane_over(const EventCurve::Edge& edge, const Vec2& x) {
  const Vec3 eye(x.x(), x.y(), 0);
  return (edge.start - eye).cross(edge.end - edge.start);
}

/// On which side of the plane over the edge from a to b a point lies as seen from the cell: 1 or −1 where that is the same
/// from all of it, 0 where it changes or the point is on the plane.
int side(const Vec3& a, const Vec3& b, const Vec3& point, const Cell& cell, double reach) {
  const Vec3 normal = (b - a).cross(point - a);
  const double level = normal.dot(point), off = kTouch * reach * normal.head<2>().norm();
  bool positive = true, negative = true;
  for (int k = 0; k < cell.size(); ++k) {
    const double height = level - normal.head<2>().dot(cell[k]);
    positive = positive && height >= -off;
    negative = negative && height <= off;
  }
  return positive == negative ? 0 : positive ? 1 : -1;
}

/// Whether all of `edge` lies on one side of `other`, the same from all of the cell.
bool beside(const EventCurve::Edge& edge, const EventCurve::Edge& other, const Cell& cell, double reach) {
  const int start = side(other.start, other.end, edge.start, cell, reach);
  return start != 0 && start == side(other.start, other.end, edge.end, cell, reach);
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
  const double size = cell.reach();
  for (int k = 0; k < 3; ++k) {
    const Edge &one = edges_[k], &other = edges_[(k + 1) % 3];
    if (beside(one, other, cell, size) || beside(other, one, cell, size)) return false;
  }
  // Corners of cells lie off the lines that they were cut along, by rounding or because no line is drawn within kTouch of
  // a corner. A value that such a move or the rounding of the determinant may have made is on the curve and beside nothing.
  constexpr double kRoundings = 64 * kUnitRoundoff;
  double off = 0;
  for (int i = 0; i < cell.size(); ++i) {
    const Vec3 eye(cell[i].x(), cell[i].y(), 0);
    std::array<double, 3> plane{}, length{}, reach{};
    for (std::size_t k = 0; k < 3; ++k) {
      plane[k] = plane_over(edges_[k], cell[i]).norm();
      length[k] = (edges_[k].end - edges_[k].start).norm();
      reach[k] = (edges_[k].start - eye).norm() * length[k];
    }
    const double slope =
        length[0] * plane[1] * plane[2] + plane[0] * length[1] * plane[2] + plane[0] * plane[1] * length[2];
    off = std::max(off, kTouch * size * slope + kRoundings * reach[0] * reach[1] * reach[2]);
  }
  bool positive = false, negative = false;
  const auto note = [&](double value) {
    positive = positive || value > off;
    negative = negative || value < -off;
  };
  // Of the quadratic on each triangle of a fan: values at the corners, 2 f(middle) − (f_i + f_j)/2 at the sides.
  std::array<double, Cell::kMostCorners> values{};
  for (int i = 0; i < cell.size(); ++i) note(values[static_cast<std::size_t>(i)] = at(cell[i]));
  const auto middle = [&](int i, int j) {
    const double ends = values[static_cast<std::size_t>(i)] + values[static_cast<std::size_t>(j)];
    note(2 * at(0.5 * (cell[i] + cell[j])) - 0.5 * ends);
  };
  for (int i = 1; i < cell.size() && !(positive && negative); ++i) {
    middle(0, i);
    if (i + 1 < cell.size()) middle(i, i + 1);
  }
  return positive && negative;
}

namespace {

std::size_t after(std::size_t i, std::size_t size) {
  return i + 1 < size ? i + 1 : 0;
}

/// The sides of the corners of one loop of the edges of another.
class Sides {
 public:
  Sides(std::span<const Vec3> corners, std::span<const Vec3> loop, const Cell& cell) : edges_(loop.size()) {
    const double reach = cell.reach();
    signs_.reserve(corners.size() * loop.size());
    for (std::size_t j = 0; j < loop.size(); ++j) {
      bool outside = true;
      for (const Vec3& corner : corners) {
        signs_.push_back(side(loop[j], loop[after(j, loop.size())], corner, cell, reach));
        outside = outside && signs_.back() < 0;
      }
      apart_ = apart_ || outside;
    }
  }
  /// Whether all corners lie outside of one edge, from all of the cell.
  bool apart() const { return apart_; }
  /// Whether the ends of the corners' edge i lie on one side of edge j from all of the cell.
  bool beside(std::size_t i, std::size_t j) const {
    const std::size_t corners = signs_.size() / edges_;
    const int start = signs_[j * corners + i], end = signs_[j * corners + after(i, corners)];
    return start != 0 && start == end;
  }

 private:
  std::size_t edges_;
  std::vector<int> signs_;
  bool apart_ = false;
};

/// Pairs of edges of two loops that may cross in the view.
struct Crossings {
  /// `second` is an outline: seen from the cell, it is the same way round as a convex region.
  Crossings(std::span<const Vec3> first, std::span<const Vec3> second, const Cell& cell) : size(second.size()) {
    const Sides there(first, second, cell);
    if (there.apart()) {
      may.assign(first.size() * second.size(), false);
      return;
    }
    const Sides back(second, first, cell);
    for (std::size_t i = 0; i < first.size(); ++i) {
      for (std::size_t j = 0; j < second.size(); ++j) may.push_back(!there.beside(i, j) && !back.beside(j, i));
    }
  }
  bool operator()(std::size_t i, std::size_t j) const { return may[i * size + j]; }
  bool any() const { return std::find(may.begin(), may.end(), true) != may.end(); }
  std::size_t size;
  std::vector<bool> may;
};

EventCurve::Edge edge(std::span<const Vec3> loop, std::size_t i) {
  return {loop[i], loop[after(i, loop.size())]};
}

/// Of edges of `third` with the pairs of `first` and `second` that cross one another.
void add_curves(std::span<const Vec3> first, std::span<const Vec3> second, const Crossings& pairs,
                std::span<const Vec3> third, const Cell& cell, std::vector<EventCurve>& curves) {
  const Crossings with_first(third, first, cell);
  if (!with_first.any()) return;
  const Crossings with_second(third, second, cell);
  for (std::size_t i = 0; i < first.size(); ++i) {
    for (std::size_t j = 0; j < second.size(); ++j) {
      if (!pairs(i, j)) continue;
      for (std::size_t k = 0; k < third.size(); ++k) {
        if (!with_first(k, i) || !with_second(k, j)) continue;
        const EventCurve curve(edge(third, k), edge(first, i), edge(second, j));
        if (curve.may_cross(cell)) curves.push_back(curve);
      }
    }
  }
}

}  // namespace

std::vector<EventCurve> event_curves(std::span<const Vec3> receiver, std::span<const Outline> outlines,
                                     const Cell& cell) {
  std::vector<EventCurve> curves;
  // Outlines past which all of the receiver is seen, from all of the cell, hide nothing that counts.
  std::vector<std::span<const Vec3>> hiding;
  if (outlines.size() < 2) return curves;
  for (const Outline& outline : outlines) {
    if (!Sides(receiver, outline, cell).apart()) hiding.push_back(outline);
  }
  for (std::size_t i = 0; i < hiding.size(); ++i) {
    for (std::size_t j = i + 1; j < hiding.size(); ++j) {
      const Crossings pairs(hiding[i], hiding[j], cell);
      if (!pairs.any()) continue;
      add_curves(hiding[i], hiding[j], pairs, receiver, cell, curves);
      for (std::size_t k = j + 1; k < hiding.size(); ++k) {
        add_curves(hiding[i], hiding[j], pairs, hiding[k], cell, curves);
      }
    }
  }
  return curves;
}

}  // namespace etendue
