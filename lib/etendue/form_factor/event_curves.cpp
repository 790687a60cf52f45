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
  if (!(least > kSteady * most)) return std::numeric_limits<double>::infinity();
  return cosine * determinant * determinant / (2 * std::numbers::pi * least);
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

std::size_t after(std::size_t i, std::size_t size) {
  return i + 1 < size ? i + 1 : 0;
}

/// 1 or −1 where that is the sign at all corners, those within `off` being on either side; else 0.
template <typename Corners>
signed char sign_over(const ViewSide& side, const Corners& corners, std::size_t count, double off) {
  bool positive = true, negative = true;
  for (std::size_t k = 0; k < count; ++k) {
    const double height = side.at(corners(k));
    positive = positive && height >= -off;
    negative = negative && height <= off;
  }
  return static_cast<signed char>(positive == negative ? 0 : positive ? 1 : -1);
}

}  // namespace

/// What is told of the sides from all of a zone, or of a cell.
class EventCurves::View {
 public:
  explicit View(const EventCurves& all) : all_(all), signs_(all.signs_) {}
  View(const EventCurves& all, const Cell& cell) : View(all) {
    cell_ = &cell;
    reach_ = cell.reach();
    for (signed char& sign : signs_) sign = sign == 0 ? kUnknown : sign;
    hides_.assign(all.loops_.size(), kUnknown);
    passing_.assign(signs_.size(), kUnknown);
    centre_ = cell.centre();
  }

  /// Outlines past which all of the receiver is seen hide nothing that counts.
  bool hides(std::size_t loop) const {
    if (loop == 0 || cell_ == nullptr) return true;
    if (hides_[loop] == kUnknown) hides_[loop] = outside(0, loop) ? 0 : 1;
    return hides_[loop] != 0;
  }

  /// Whether two edges may cross in the view. Where neither's end passes the other within the cell, one look tells.
  bool cross(const Edge& one, const Edge& other) const {
    if (beside(one, other) || beside(other, one)) return false;
    if (cell_ == nullptr) return true;
    const Passing there = passing(one, other), back = passing(other, one);
    if (there == Passing::never || back == Passing::never) return false;
    return there == Passing::some || back == Passing::some || cross_at_centre(one, other);
  }

  /// Whether two loops lie beside one another in the view. An outline is the same way round as a convex region.
  bool apart(std::size_t one, std::size_t other) const {
    return (other > 0 && outside(one, other)) || (one > 0 && outside(other, one));
  }

 private:
  static constexpr signed char kUnknown = 3;

  std::size_t size(std::size_t loop) const { return all_.loops_[loop].size(); }

  /// Of the corner of one loop over an edge of another, in the tables.
  std::size_t index_of(std::size_t edges, std::size_t j, std::size_t corners, std::size_t corner) const {
    return all_.tables_[edges * all_.loops_.size() + corners] + j * size(corners) + corner;
  }

  signed char sign(std::size_t edges, std::size_t j, std::size_t corners, std::size_t corner) const {
    const std::size_t index = index_of(edges, j, corners, corner);
    if (signs_[index] == kUnknown) {
      const ViewSide& side = all_.sides_[index];
      const auto at = [&](std::size_t k) -> const Vec2& { return (*cell_)[static_cast<int>(k)]; };
      signs_[index] =
          sign_over(side, at, static_cast<std::size_t>(cell_->size()), kTouch * reach_ * side.gradient.norm());
    }
    return signs_[index];
  }

  /// Whether all corners of a loop lie outside of one edge of an outline.
  bool outside(std::size_t loop, std::size_t outline) const {
    for (std::size_t j = 0; j < size(outline); ++j) {
      bool all = true;
      for (std::size_t c = 0; c < size(loop) && all; ++c) all = sign(outline, j, loop, c) < 0;
      if (all) return true;
    }
    return false;
  }

  /// Whether the ends of `edge` lie on one side of `other`.
  bool beside(const Edge& edge, const Edge& other) const {
    const signed char start = sign(other.loop, other.index, edge.loop, edge.index);
    return start != 0 && start == sign(other.loop, other.index, edge.loop, after(edge.index, size(edge.loop)));
  }

  /// Whether an end of one edge passes the other within the cell; `never`, where it lies in line with it, but beside.
  enum class Passing : signed char { none, some, never };

  Passing passing(const Edge& edge, const Edge& other) const {
    Passing found = Passing::none;
    for (const std::size_t corner : {edge.index, after(edge.index, size(edge.loop))}) {
      if (sign(other.loop, other.index, edge.loop, corner) != 0) continue;
      const Passing one = passes(edge.loop, corner, other);
      if (one == Passing::never) return one;
      if (one == Passing::some) found = one;
    }
    return found;
  }

  Passing passes(std::size_t loop, std::size_t corner, const Edge& edge) const {
    signed char& known = passing_[index_of(edge.loop, edge.index, loop, corner)];
    if (known == kUnknown) known = static_cast<signed char>(find_passing(all_.loops_[loop][corner], all_.ends(edge)));
    return static_cast<Passing>(known);
  }

  Passing find_passing(const Vec3& corner, const EventCurve::Edge& edge) const {
    const Vec3 to_start = edge.start - corner, to_end = edge.end - corner;
    const double across = to_start.cross(to_end).squaredNorm(), along = to_start.dot(to_end);
    if (across <= kTouch * kTouch * to_start.squaredNorm() * to_end.squaredNorm()) {
      return along > 0 ? Passing::never : Passing::some;
    }
    const auto line = meeting_line(corner, edge.start, edge.end);
    return line && crosses(*line, *cell_) ? Passing::some : Passing::none;
  }

  bool cross_at_centre(const Edge& one, const Edge& other) const {
    const auto astride = [&](const Edge& edge, const Edge& by) {
      const std::size_t end = after(edge.index, size(edge.loop));
      const double first = all_.sides_[index_of(by.loop, by.index, edge.loop, edge.index)].at(centre_);
      return first * all_.sides_[index_of(by.loop, by.index, edge.loop, end)].at(centre_) <= 0;
    };
    return astride(one, other) && astride(other, one);
  }

  const EventCurves& all_;
  const Cell* cell_ = nullptr;
  Vec2 centre_ = Vec2::Zero();
  double reach_ = 0;
  mutable std::vector<signed char> signs_;  ///< found when they are asked for
  mutable std::vector<signed char> hides_;
  mutable std::vector<signed char> passing_;
};

EventCurves::EventCurves(std::span<const Vec3> receiver, const SightZone& zone) {
  if (zone.outlines.size() < 2) return;
  loops_.push_back(receiver);
  for (const Outline& outline : zone.outlines) loops_.push_back(outline);
  tables_.assign(loops_.size() * loops_.size(), 0);
  for (std::size_t i = 0; i < loops_.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      add_table(i, j, zone.corners);
      add_table(j, i, zone.corners);
    }
  }
  find_triples(View(*this));
}

void EventCurves::add_table(std::size_t edges, std::size_t corners, std::span<const Vec2> zone) {
  tables_[edges * loops_.size() + corners] = sides_.size();
  const auto at = [&](std::size_t k) -> const Vec2& { return zone[k]; };
  for (std::size_t j = 0; j < loops_[edges].size(); ++j) {
    for (const Vec3& corner : loops_[corners]) {
      sides_.push_back(view_side(loops_[edges][j], loops_[edges][after(j, loops_[edges].size())], corner));
      signs_.push_back(sign_over(sides_.back(), at, zone.size(), 0));
    }
  }
}

void EventCurves::find_triples(const View& view) {
  const std::size_t count = loops_.size();
  for (std::size_t first = 1; first < count; ++first) {
    for (std::size_t second = first + 1; second < count; ++second) {
      if (view.apart(first, second)) continue;
      std::vector<std::pair<Edge, Edge>> pairs;
      for (std::size_t i = 0; i < loops_[first].size(); ++i) {
        for (std::size_t j = 0; j < loops_[second].size(); ++j) {
          if (view.cross({first, i}, {second, j})) pairs.push_back({{first, i}, {second, j}});
        }
      }
      for (std::size_t third = 0; third < count && !pairs.empty(); third = std::max(third, second) + 1) {
        if (view.apart(third, first) || view.apart(third, second)) continue;
        for (std::size_t k = 0; k < loops_[third].size(); ++k) {
          for (const auto& [one, other] : pairs) {
            const Edge edge{third, k};
            if (view.cross(edge, one) && view.cross(edge, other)) triples_.push_back({one, other, edge});
          }
        }
      }
    }
  }
}

EventCurve::Edge EventCurves::ends(const Edge& edge) const {
  const std::span<const Vec3> loop = loops_[edge.loop];
  return {loop[edge.index], loop[after(edge.index, loop.size())]};
}

std::vector<EventCurve> EventCurves::across(const Cell& cell) const {
  std::vector<EventCurve> found;
  if (triples_.empty()) return found;
  const View view(*this, cell);
  for (const auto& [first, second, third] : triples_) {
    if (!view.hides(first.loop) || !view.hides(second.loop) || !view.hides(third.loop)) continue;
    if (!view.cross(first, second) || !view.cross(third, first) || !view.cross(third, second)) continue;
    if (view.apart(first.loop, second.loop)) continue;
    const EventCurve curve(ends(third), ends(first), ends(second));
    if (curve.may_cross(cell)) found.push_back(curve);
  }
  return found;
}

}  // namespace etendue
