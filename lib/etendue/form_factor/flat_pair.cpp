// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/flat_pair.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace etendue {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kNever = std::numeric_limits<double>::infinity();

template <class T>
double to_segment(const Triple<T>& p, const Edge<T>& edge) {
  const Triple<T> r = p - edge.start;
  const double foot = leading(dot(r, edge.direction));
  if (foot <= 0) return leading(norm(r));
  if (foot >= leading(edge.length)) return leading(norm(p - edge.end));
  return leading(norm(cross(r, edge.direction)));
}

/// A lower bound on the distance of two edges: their ends and the lines' crossing; where they are nearly parallel the
/// ends alone, less what turning one of them into the other's direction moves it.
template <class T>
double least_distance(const Edge<T>& a, const Edge<T>& b, double slack) {
  const double ends =
      std::min({to_segment(a.start, b), to_segment(a.end, b), to_segment(b.start, a), to_segment(b.end, a)});
  const auto u = widened(a.direction), v = widened(b.direction);
  const Triple<DoubleDouble> normal = cross(u, v), gap = widened(b.start) - widened(a.start);
  const double sine = leading(norm(normal)), turned = ends - (sine + slack) * leading(b.length);
  const double lines = sine > 0 ? (std::abs(leading(dot(gap, normal))) - slack) / sine : 0;
  return std::max({0.0, turned - slack, std::min(ends, lines) - slack});
}

/// The inner edge as seen along the outer one's line: where its ends are along it, and their vectors off it, turned by
/// a right angle.
struct Ends {
  DoubleDouble x[2];
  Triple<DoubleDouble> off[2];
};

template <class T>
Ends ends_of(const Edge<T>& outer, const Edge<T>& inner) {
  const Triple<DoubleDouble> u = widened(outer.direction);
  Ends ends;
  for (int i = 0; i < 2; ++i) {
    const Triple<DoubleDouble> to = widened((i == 0 ? inner.start : inner.end) - outer.start);
    ends.x[i] = dot(to, u);
    ends.off[i] = cross(u, to);
  }
  return ends;
}

/// ∫ |a + t (b − a)| over 0 ≤ t ≤ 1; relative error below kMeanError.
constexpr double kMeanError = 0x1p-34;
double mean_length(const Triple<double>& a, const Triple<double>& b) {
  const double at_a = norm(a), at_b = norm(b), step = norm(b - a);
  // Simpson's rule errs by at most 3 step⁴/(2880 r³), r the least length; the closed form by some u · r/step.
  constexpr double kShort = 0x1p-8;
  if (step <= kShort * std::max(at_a, at_b)) return (at_a + 4 * norm(0.5 * (a + b)) + at_b) / 6;
  const Triple<double> along = (1 / step) * (b - a);
  const double from = dot(a, along), to = dot(b, along), aside = norm(cross(a, along));
  double doubled = to * at_b - from * at_a;
  if (aside > 0) doubled += aside * aside * (std::asinh(to / aside) - std::asinh(from / aside));
  return 0.5 * doubled / step;
}

/// Laid into the plane along `across`.
template <class T>
FlatPair<T> in_plane(const Edge<T>& outer, const Edge<T>& inner, const Ends& ends, Triple<DoubleDouble> across,
                     double largest) {
  FlatPair<T> flat;
  flat.deviation = kNever;
  const DoubleDouble size = norm(across);
  if (!(size.high > 0)) return flat;
  across = (DoubleDouble(1) / size) * across;
  DoubleDouble y[2];
  double off = 0;
  for (int i = 0; i < 2; ++i) {
    y[i] = dot(ends.off[i], across);
    off = std::max(off, leading(norm(cross(ends.off[i], across))));
  }
  const double slack = slack_of(outer, inner), length = leading(outer.length);
  off += slack;
  const double laid = std::hypot(leading(ends.x[1] - ends.x[0]), leading(y[1] - y[0]));
  if (!(2 * off <= laid)) return flat;
  const double shortened = 2 * off * off / (laid * laid);
  const double gap = least_distance(outer, inner, slack) - off;
  double lifted = kPi * off * length;
  if (gap > off) lifted = std::min(lifted, 0.5 * off * off / (gap * gap) * length * laid);
  flat.start = {narrowed<T>(ends.x[0]), narrowed<T>(y[0])};
  flat.end = {narrowed<T>(ends.x[1]), narrowed<T>(y[1])};
  flat.deviation = (1 + shortened) * lifted + shortened * length * largest;
  return flat;
}

/// Laid onto the outer edge's line.
template <class T>
FlatPair<T> on_line(const Edge<T>& outer, const Edge<T>& inner, const Ends& ends, double largest) {
  FlatPair<T> flat;
  flat.deviation = kNever;
  const double length = leading(outer.length), slack = slack_of(outer, inner);
  const double x_0 = leading(ends.x[0]), x_1 = leading(ends.x[1]), laid = std::abs(leading(ends.x[1] - ends.x[0]));
  const double off = std::max(leading(norm(ends.off[0])), leading(norm(ends.off[1]))) + slack;
  if (!(2 * off <= laid)) return flat;
  flat.start = {narrowed<T>(ends.x[0]), T(0)};
  flat.end = {narrowed<T>(ends.x[1]), T(0)};
  const double from = std::max(0.0, std::min(x_0, x_1)), to = std::min(length, std::max(x_0, x_1));
  if (from < to) {
    // In units of `off`, so that squares of hairs do not underflow.
    const auto scaled = [off](const Triple<DoubleDouble>& a) {
      return Triple<double>{leading(a.x) / off, leading(a.y) / off, leading(a.z) / off};
    };
    const Triple<double> a = scaled(ends.off[0]), b = scaled(ends.off[1]);
    const auto at = [&](double x) { return a + ((x - x_0) / (x_1 - x_0)) * (b - a); };
    flat.lift = kPi * off * (to - from) * mean_length(at(from), at(to));
  }
  const double reach = std::max({std::abs(x_0), std::abs(x_1), std::abs(x_0 - length), std::abs(x_1 - length), off});
  const double shortened = 2 * off * off / (laid * laid);
  const double beyond = 2 * off * off * (kPi + std::log(reach / off)),
               unknown = kPi * length * (slack + kMeanError * off);
  flat.deviation = (1 + shortened) * beyond + unknown + shortened * length * (largest + kPi * off);
  return flat;
}

}  // namespace

template <class T>
FlatPair<T> flat_pair(const Edge<T>& outer, const Edge<T>& inner, double largest) {
  const Ends ends = ends_of(outer, inner);
  FlatPair<T> best = on_line(outer, inner, ends, largest);
  // Through the inner edge's middle, along its direction.
  for (const Triple<DoubleDouble>& across : {ends.off[0] + ends.off[1], ends.off[1] - ends.off[0]}) {
    const FlatPair<T> flat = in_plane(outer, inner, ends, across, largest);
    if (flat.deviation < best.deviation) best = flat;
  }
  return best;
}

template FlatPair<double> flat_pair(const Edge<double>&, const Edge<double>&, double);
template FlatPair<DoubleDouble> flat_pair(const Edge<DoubleDouble>&, const Edge<DoubleDouble>&, double);

}  // namespace etendue
