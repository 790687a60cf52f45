// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>

#include "etendue/form_factor/triple.hpp"

// The integrals of ln r over edges, in closed form: once over one edge, and over two that lie in one plane.
namespace etendue {

template <class T>
struct Edge {
  Triple<T> start, end;
  Triple<T> direction;  ///< unit
  T length;
  double coordinates;  ///< bounds |start| and |end|
};

template <class T>
Edge<T> make_edge(const Triple<T>& start, const Triple<T>& end) {
  const Triple<T> vector = end - start;
  const T length = norm(vector);
  const double reach = std::max(leading(norm(start)), leading(norm(end)));
  return {start, end, leading(length) > 0 ? (T(1) / length) * vector : vector, length, reach};
}

/// Distances between two edges, formed from their coordinates, err by less.
template <class T>
double slack_of(const Edge<T>& a, const Edge<T>& b) {
  constexpr double kSlackRoundings = 16;
  return kSlackRoundings * kRounding<T> * (a.coordinates + b.coordinates);
}

/// A value, and a bound on its rounding error in units of kRounding.
template <class T>
struct Rounded {
  T value;
  double roundings;
};

template <class T>
T half_log(const T& square) {
  using std::log;
  return leading(square) > 0 ? T(0.5) * log(square) : T(0);
}

/// ∫ over `inner` of ln |x − p|. `coordinates` bounds |p|, whose own rounding moves the integral by its gradient. The
/// count is in NOTES.md §3.
template <class T>
Rounded<T> inner_integral(const Triple<T>& p, const Edge<T>& inner, double coordinates) {
  const Triple<T> to_start = inner.start - p, to_end = inner.end - p;
  const T square_start = dot(to_start, to_start), square_end = dot(to_end, to_end);
  const T log_start = half_log(square_start), log_end = half_log(square_end);
  const T area = norm(cross(to_start, to_end));
  const T angle = angle_of(area, dot(to_start, to_end));
  const T distance = area / inner.length;
  const T value = dot(to_end, inner.direction) * log_end - dot(to_start, inner.direction) * log_start - inner.length +
                  distance * angle;
  const double r_start = std::sqrt(leading(square_start)), r_end = std::sqrt(leading(square_end));
  const double ls = std::abs(leading(log_start)), le = std::abs(leading(log_end)), w = leading(angle);
  const double length = leading(inner.length), h = leading(distance);
  return {value, 3 * coordinates * (std::abs(leading(log_end) - leading(log_start)) + w) +
                     2 * inner.coordinates * (ls + le + w) + r_end * (8 * le + 3) + r_start * (8 * ls + 3) +
                     2 * length + 5 * r_start * r_end * w / length + h * (8 + 4 * w)};
}

/// A point of the closed upper half-plane beyond an edge that runs along the real axis.
template <class T>
struct Corner {
  T x, y;
};

/// z²/2 (ln z − 3/2): its second derivative is ln z.
template <class T>
Corner<T> twice_integrated_log(const Corner<T>& z) {
  const T square = z.x * z.x + z.y * z.y;
  if (!(leading(square) > 0)) return {};
  const T re = half_log(square) - T(1.5), im = angle_of(z.y, z.x);
  const T a = T(0.5) * (z.x * z.x - z.y * z.y), b = z.x * z.y;
  return {a * re - b * im, a * im + b * re};
}

/// ∬ ln |c + t e − s| over 0 ≤ s ≤ outer and the edge e from c to d.
template <class T>
Rounded<T> half_plane_pair(const T& outer, const Corner<T>& c, const Corner<T>& d, double coordinates) {
  const std::array<Corner<T>, 4> z{c, d, Corner<T>{c.x - outer, c.y}, Corner<T>{d.x - outer, d.y}};
  std::array<Corner<T>, 4> g;
  double roundings = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    g[i] = twice_integrated_log(z[i]);
    const double r = std::hypot(leading(z[i].x), leading(z[i].y));
    const double size = std::hypot(leading(g[i].x), leading(g[i].y));
    // |G'| = |z (ln z − 1)| moves with the corner, which errs by a few roundings of the coordinates.
    constexpr double kOwn = 24, kMoved = 8;
    const double slope = r > 0 ? r * (std::abs(std::log(r)) + 5) : 0;
    roundings += kOwn * (size + r * r) + kMoved * coordinates * slope;
  }
  const T re = g[1].x + g[2].x - g[0].x - g[3].x, im = g[1].y + g[2].y - g[0].y - g[3].y;
  const T ex = d.x - c.x, ey = d.y - c.y;
  const T square = ex * ex + ey * ey;
  if (!(leading(square) > 0)) return {};
  using std::sqrt;
  const T length = sqrt(square);
  // The direction of e errs by the coordinates' rounding over its length.
  const double turned = 8 * coordinates / leading(length) * std::hypot(leading(re), leading(im));
  return {(re * ex + im * ey) / length, roundings + turned};
}

/// ∬ ln r over two edges in one plane: the outer one from the origin along the real axis, the inner one from c to d, which
/// is cut where it passes through the real axis: mirrored to one side, either part keeps to the principal logarithm.
template <class T>
Rounded<T> planar_pair(const T& outer, Corner<T> c, Corner<T> d, double coordinates) {
  const double slack = 8 * kRounding<T> * coordinates;
  double certain = coordinates;
  for (Corner<T>* z : {&c, &d}) {
    if (std::abs(leading(z->y)) > slack) continue;
    z->y = T(0);  // which moves the corner as far again as it may be off
    certain = 2 * coordinates;
  }
  const bool apart = leading(c.y) * leading(d.y) < 0;
  if (leading(c.y) < 0) c.y = -c.y;
  if (leading(d.y) < 0) d.y = -d.y;
  if (!apart) return half_plane_pair(outer, c, d, certain);
  const T t = c.y / (c.y + d.y);
  const Corner<T> crossing{c.x + t * (d.x - c.x), T(0)};
  const Rounded<T> first = half_plane_pair(outer, c, crossing, certain);
  const Rounded<T> second = half_plane_pair(outer, crossing, d, certain);
  return {first.value + second.value, first.roundings + second.roundings};
}

}  // namespace etendue
