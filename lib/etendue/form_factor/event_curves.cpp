// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/event_curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/critical_lines.hpp"

namespace etendue {

namespace {

/// Three edges whose angles in the view, multiplied, change by more within a cell: no triangle between them is sized.
constexpr double kSteady = 1.0 / 16;

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

/// Bernstein's coefficients, of the quadratic on each triangle of a fan: values at the corners, 2 f(middle) − (f_i + f_j)/2
/// at the sides; until `note` has enough.
template <typename Note>
void EventCurve::note_coefficients(const Cell& cell, const Note& note) const {
  std::array<double, Cell::kMostCorners> values{};
  bool more = true;
  for (int i = 0; i < cell.size(); ++i) more = note(values[static_cast<std::size_t>(i)] = at(cell[i]));
  const auto middle = [&](int i, int j) {
    const double ends = values[static_cast<std::size_t>(i)] + values[static_cast<std::size_t>(j)];
    more = note(2 * at(0.5 * (cell[i] + cell[j])) - 0.5 * ends);
  };
  for (int i = 1; i < cell.size() && more; ++i) {
    middle(0, i);
    if (i + 1 < cell.size()) middle(i, i + 1);
  }
}

// Three planes through the eye, with normals n_i: great circles that almost meet in one point leave a triangle of solid
// angle det²/(2 Π |n_i × n_j|).
double EventCurve::gap(double determinant, const Cell& cell) const {
  double least = std::numeric_limits<double>::infinity(), most = 0, cosine = 0;
  const auto note = [&](const Vec2& x) {
    const Vec3 planes[3] = {plane_over(edges_[0], x), plane_over(edges_[1], x), plane_over(edges_[2], x)};
    double product = 1;
    for (int k = 0; k < 3; ++k) {
      const Vec3 ray = planes[k].cross(planes[(k + 1) % 3]);
      const double size = ray.norm();
      product *= size;
      cosine = std::max(cosine, size > 0 ? std::abs(ray.z()) / size : 1);
    }
    least = std::min(least, product);
    most = std::max(most, product);
  };
  for (int i = 0; i < cell.size(); ++i) note(cell[i]);
  note(cell.centre());
  // No factor exceeds 1.
  if (!(least > kSteady * most)) return 1;
  return std::min(1.0, cosine * determinant * determinant / (2 * std::numbers::pi * least));
}

double EventCurve::stray(const Cell& cell) const {
  const double centre = at(cell.centre());
  double beyond = 0;
  note_coefficients(cell, [&](double value) {
    if (value * centre <= 0) beyond = std::max(beyond, std::abs(value));
    return true;
  });
  return cell.area() * gap(beyond, cell);
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
  note_coefficients(cell, [&](double value) {
    positive = positive || value > off;
    negative = negative || value < -off;
    return !(positive && negative);
  });
  return positive && negative;
}

namespace {

/// 1 or −1 where that is the sign from all of the cell, corners within kTouch of it being on either side; else 0.
int sign_over(const ViewSide& side, const Cell& cell, double reach) {
  const double off = kTouch * reach * side.gradient.norm();
  bool positive = true, negative = true;
  for (int k = 0; k < cell.size(); ++k) {
    const double height = side.at(cell[k]);
    positive = positive && height >= -off;
    negative = negative && height <= off;
  }
  return positive == negative ? 0 : positive ? 1 : -1;
}

}  // namespace

/// What of that holds from all of a cell.
class EventCurves::View {
 public:
  View(const EventCurves& all, const Cell& cell)
      : all_(all), cell_(cell), reach_(cell.reach()), crosses_(all.crossings_.size(), kUnknown) {}

  bool met(const Triple& triple) {
    for (const std::size_t crossing : triple.crossings) {
      if (!may_cross(crossing)) return false;
    }
    return true;
  }

  /// Outlines past which all of the receiver is seen hide nothing that counts.
  bool hides(std::size_t outline) const { return outline == 0 || !outside(0, outline); }
  bool apart(std::size_t one, std::size_t other) const { return outside(one, other) || outside(other, one); }

 private:
  static constexpr signed char kUnknown = -1;

  bool may_cross(std::size_t index) {
    signed char& known = crosses_[index];
    if (known == kUnknown) {
      const auto& sides = all_.crossings_[index].sides;
      const auto beside = [&](std::size_t k) {
        const int start = sign_over(sides[k], cell_, reach_);
        return start != 0 && start == sign_over(sides[k + 1], cell_, reach_);
      };
      known = beside(0) || beside(2) ? 0 : 1;
    }
    return known != 0;
  }

  /// Whether all corners of a loop lie outside of one edge of an outline.
  bool outside(std::size_t loop, std::size_t outline) const {
    LoopSides& sides = all_.sides_;
    for (std::size_t j = 0; j < sides.loop(outline).size(); ++j) {
      bool all = true;
      for (std::size_t c = 0; c < sides.loop(loop).size() && all; ++c) {
        const Edge edge{outline, j};
        const int sign = sides.sign(edge, loop, c);
        all = sign < 0 || (sign == 0 && sign_over(sides.side(edge, loop, c), cell_, reach_) < 0);
      }
      if (all) return true;
    }
    return false;
  }

  const EventCurves& all_;
  const Cell& cell_;
  double reach_;
  std::vector<signed char> crosses_;
};

EventCurves::EventCurves(LoopSides& sides) : sides_(sides) {
  for (std::size_t first = 1; first < sides.size(); ++first) {
    for (std::size_t second = first + 1; second < sides.size(); ++second) {
      if (!sides.apart(first, second)) add_triples(first, second);
    }
  }
}

std::size_t EventCurves::add_crossing(const Edge& one, const Edge& other) {
  const auto same = [](const Edge& a, const Edge& b) { return a.loop == b.loop && a.index == b.index; };
  for (std::size_t k = 0; k < crossings_.size(); ++k) {
    if (same(crossings_[k].one, one) && same(crossings_[k].other, other)) return k;
  }
  const auto side = [&](const Edge& edge, const Edge& by, bool end) {
    return sides_.side(by, edge.loop, end ? sides_.after(edge.loop, edge.index) : edge.index);
  };
  crossings_.push_back(
      {one, other, {side(one, other, false), side(one, other, true), side(other, one, false), side(other, one, true)}});
  return crossings_.size() - 1;
}

void EventCurves::add_triples(std::size_t first, std::size_t second) {
  std::vector<std::pair<Edge, Edge>> pairs;
  for (std::size_t i = 0; i < sides_.loop(first).size(); ++i) {
    for (std::size_t j = 0; j < sides_.loop(second).size(); ++j) {
      const Edge one{first, i}, other{second, j};
      if (sides_.never_cross(one, other) || sides_.beyond_receiver(one) != 0 || sides_.beyond_receiver(other) != 0) {
        continue;
      }
      pairs.push_back({one, other});
    }
  }
  for (std::size_t third = 0; third < sides_.size() && !pairs.empty(); third = std::max(third, second) + 1) {
    if (sides_.apart(third, first) || sides_.apart(third, second)) continue;
    for (std::size_t k = 0; k < sides_.loop(third).size(); ++k) {
      const Edge edge{third, k};
      for (const auto& [one, other] : pairs) {
        if (sides_.never_cross(edge, one) || sides_.never_cross(edge, other)) continue;
        const std::size_t meets = add_crossing(one, other), by_one = add_crossing(one, edge);
        triples_.push_back({{meets, by_one, add_crossing(other, edge)}, one, other, edge});
      }
    }
  }
}

std::vector<EventCurve> EventCurves::across(const Cell& cell) const {
  std::vector<EventCurve> found;
  if (triples_.empty()) return found;
  View view(*this, cell);
  for (const Triple& triple : triples_) {
    if (!view.met(triple)) continue;
    const auto [first, second, third] = std::array{triple.first, triple.second, triple.third};
    const EventCurve curve(ends(third), ends(first), ends(second));
    if (!curve.may_cross(cell)) continue;
    if (!view.hides(first.loop) || !view.hides(second.loop) || !view.hides(third.loop)) continue;
    if (!view.apart(first.loop, second.loop)) found.push_back(curve);
  }
  return found;
}

}  // namespace etendue
