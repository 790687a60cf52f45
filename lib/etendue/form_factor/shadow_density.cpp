// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <limits>

#include "etendue/form_factor/shadow_term.hpp"

namespace etendue {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

Interval ShadowTerm::arc_density(const Arc& arc, const Interval3& x, const Interval& from, const Interval& to,
                                 bool signed_length) const {
  const Edge& e = edges_[arc.edge];
  const Interval3 start = vertices_[e.begin] - x, way = vertices_[e.end] - vertices_[e.begin];
  const Interval3 p = start + from * way, q = start + to * way;
  const Interval3 across = cross(way, start);
  const Interval size = norm(across), difference = to - from;
  const Interval length = signed_length ? difference : max(Interval(), difference);
  const Interval turn = angle(size * abs(length), dot(p, q));
  // Lambert's term is the angle times a cosine; where rounding hides which way the arc runs, anything up to that.
  if (!(size.lower > 0) || (length.lower < 0 && length.upper > 0)) {
    const double most = (Interval(turn.upper) * norm(source_.normal)).upper;
    return {-most, most};
  }
  const Interval term = turn * dot(source_.normal, across) / size;
  return length.lower >= 0 ? term : -term;
}

Interval ShadowTerm::flux_density(const std::vector<Arc>& arcs, const Interval& u, const Interval& v) const {
  const Interval3 x = u * source_.along + v * source_.across;
  Interval sum;
  for (const Arc& arc : arcs) {
    const Interval from = arc.begins.empty() ? Interval(0) : crossing(arc.edge, arc.begins.front(), u, v);
    const Interval to = arc.ends.empty() ? Interval(1) : crossing(arc.edge, arc.ends.front(), u, v);
    sum = sum + arc_density(arc, x, from, to, true);
  }
  return sum / (Interval(2) * pi());
}

Interval ShadowTerm::flux_density_over(const std::vector<Arc>& arcs, const SourceCell& cell) const {
  const auto coordinate = [&](Interval Interval3::*axis) {
    return range_over({Interval(), source_.along.*axis, source_.across.*axis}, cell);
  };
  const Interval3 x(coordinate(&Interval3::x), coordinate(&Interval3::y), coordinate(&Interval3::z));
  Interval sum;
  for (const Arc& arc : arcs) {
    Interval from(0), to(1);
    for (const int o : arc.begins) from = max(from, crossing_over(arc.edge, o, cell));
    for (const int o : arc.ends) to = min(to, crossing_over(arc.edge, o, cell));
    sum = sum + arc_density(arc, x, from, to, false);
  }
  return sum / (Interval(2) * pi());
}

namespace {

struct Complex {
  Interval re, im;
};

Complex operator-(const Complex& a, const Complex& b) {
  return {a.re - b.re, a.im - b.im};
}
Interval squared(const Complex& a) {
  return square(a.re) + square(a.im);
}
Complex quotient(const Complex& a, const Complex& b) {
  const Interval size = squared(b);
  return {(a.re * b.re + a.im * b.im) / size, (a.im * b.re - a.re * b.im) / size};
}
/// The values of linear functions where one variable of a cell is complex.
class ComplexCell {
 public:
  ComplexCell(const SourceCell& cell, ShadowTerm::Variable variable, double rho) : cell_(cell), variable_(variable) {
    // The ellipse of [0, 1] lies in a box around 1/2.
    const Interval wide = Interval(0.25) * (Interval(rho) + Interval(1) / rho);
    const Interval high = Interval(0.25) * (Interval(rho) - Interval(1) / rho);
    re_ = Interval(0.5) + Interval(-wide.upper, wide.upper);
    im_ = {-high.upper, high.upper};
  }

  Complex value(const Interval& a, const Interval& b, const Interval& c) const {
    if (variable_ == ShadowTerm::Variable::r) {
      const Interval way = hull(b - a, c - a);
      return {a + re_ * way, im_ * way};
    }
    // For each r a point of the way from A to one beyond the side B C, which s runs along.
    const Interval side = c - b;
    return {hull(a, b + re_ * side), hull(Interval(), im_ * side)};
  }
  Complex value(const Affine& f) const { return value(corner(f, 0), corner(f, 1), corner(f, 2)); }

 private:
  Interval corner(const Affine& f, std::size_t i) const { return f(cell_.corners[i].x(), cell_.corners[i].y()); }
  const SourceCell& cell_;
  ShadowTerm::Variable variable_;
  Interval re_, im_;
};

}  // namespace

double ShadowTerm::largest(const std::vector<Arc>& arcs, const SourceCell& cell, Variable variable, double rho) const {
  const ComplexCell complex(cell, variable, rho);
  const auto coordinate = [&](Interval Interval3::*axis) {
    return complex.value(Affine{Interval(), source_.along.*axis, source_.across.*axis});
  };
  const Complex c[3] = {coordinate(&Interval3::x), coordinate(&Interval3::y), coordinate(&Interval3::z)};
  const Interval3 x(c[0].re, c[1].re, c[2].re), aside(c[0].im, c[1].im, c[2].im);
  const auto end_of = [&](std::size_t edge, const std::vector<int>& others, int end) -> Complex {
    if (others.empty()) return {Interval(end), Interval()};
    const auto o = static_cast<std::size_t>(others.front());
    if (const auto fixed = fixed_crossing(edge, o)) return {*fixed, Interval()};
    const Affine &begin = height(o, edges_[edge].begin), &last = height(o, edges_[edge].end);
    const Affine fall{begin.at - last.at, begin.du - last.du, begin.dv - last.dv};
    return quotient(complex.value(begin), complex.value(fall));
  };
  Interval sum;
  for (const Arc& arc : arcs) {
    const Edge& e = edges_[arc.edge];
    const Interval3 start = vertices_[e.begin] - x, way = vertices_[e.end] - vertices_[e.begin];
    const Complex from = end_of(arc.edge, arc.begins, 0), to = end_of(arc.edge, arc.ends, 1);
    // normal · (way × (start − x)), linear in x.
    const Interval3 turned = cross(source_.normal, way);  // normal · (way × p) = (normal × way) · p
    const Complex across = complex.value(
        Affine{dot(turned, vertices_[e.begin]), -dot(turned, source_.along), -dot(turned, source_.across)});
    const double line_square = (square(cross(start, way)) / square(way)).lower;
    double nearest = kInfinity;
    constexpr int kPieces = 4;
    for (int k = 0; k < kPieces; ++k) {
      const Interval share(k / double(kPieces), (k + 1) / double(kPieces));
      const Complex step = to - from;
      const Complex t{from.re + share * step.re, from.im + share * step.im};
      const Interval real = square(start + t.re * way), imaginary = square(t.im * way - aside);
      nearest = std::min(nearest, (Interval(std::max(real.lower, line_square)) - imaginary).lower);
    }
    if (!(nearest > 0)) return kInfinity;
    sum = sum + sqrt(squared(across) * squared(to - from)) / nearest;
  }
  const double bound = (sum / (Interval(2) * pi())).upper;
  return bound == bound ? bound : kInfinity;
}

}  // namespace etendue
