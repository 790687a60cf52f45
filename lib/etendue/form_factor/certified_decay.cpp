// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/certified_decay.hpp"

#include <algorithm>
#include <cmath>

namespace etendue {

namespace {

/// The deformed path keeps this share of the way to the branch point of the crossing lines.
constexpr double kBranchClearance = 0.7;
/// Up to this sine, of the order of rounding, lines count as parallel, at a price.
constexpr double kParallel = 0x1p-46;

/// Distances from both ends of a piece of the outer edge.
struct FocalSum {
  Interval value, slope;
};

FocalSum focal_sum(const EnclosedEdges& e, const EnclosedPiece& piece, double t) {
  const Interval3 point = e.start + Interval(t) * e.inner;
  const Interval3 from_a = point - piece.from, from_b = point - piece.to;
  const Interval ra = norm(from_a), rb = norm(from_b);
  const auto slope = [&](const Interval3& way, const Interval& r) {
    // |way · inner| ≤ r |inner|
    const Interval steepest(-e.inner_length.upper, e.inner_length.upper);
    return r.lower > 0 ? dot(way, e.inner) / r : steepest;
  };
  return {ra + rb, slope(from_a, ra) + slope(from_b, rb)};
}

/// Where on the inner edge, about, the focal sum is least: the mirror point of the two ends' heights above its line.
double least_at(const EnclosedEdges& e, const Vec3& a, const Vec3& b) {
  const Vec3 origin = e.start.middle(), along = e.inner.middle();
  const double square = along.squaredNorm();
  const double foot_a = (a - origin).dot(along) / square, foot_b = (b - origin).dot(along) / square;
  const double height_a = (a - origin - foot_a * along).norm(), height_b = (b - origin - foot_b * along).norm();
  const double sum = height_a + height_b;
  const double t = sum > 0 ? (foot_a * height_b + foot_b * height_a) / sum : 0.5 * (foot_a + foot_b);
  return std::isfinite(t) ? std::clamp(t, 0.0, 1.0) : 0.5;
}

}  // namespace

EnclosedEdges enclosed_edges(const Interval3& a, const Interval3& b, const Interval3& c, const Interval3& d) {
  EnclosedEdges e;
  e.outer = b - a;
  e.inner = d - c;
  e.start = c - a;
  e.end = d - a;
  e.outer_length = norm(e.outer);
  e.inner_square = square(e.inner);
  e.inner_length = sqrt(e.inner_square);
  return e;
}

double certain_ellipse(const Interval& semi_axis) {
  const Interval a(semi_axis.lower);
  if (!(a.lower > 1)) return 1;
  return std::max(1.0, (a + sqrt((a - 1.0) * (a + 1.0))).lower);
}

CertifiedDecay certified_plain_decay(const EnclosedEdges& e, const EnclosedPiece& piece) {
  const double t = least_at(e, piece.from.middle(), piece.to.middle());
  const FocalSum there = focal_sum(e, piece, t);
  // Convex: the tangent lies below, whatever its slope.
  const double falls =
      std::min({0.0, (there.slope.lower * (Interval(1) - t)).lower, (-there.slope.upper * Interval(t)).lower});
  const Interval least = max(Interval((there.value + Interval(falls)).lower), Interval(piece.length.lower));
  return {certain_ellipse(least / piece.length), 1, 0};
}

CertifiedDecay certified_bent_decay(const EnclosedEdges& e, const EnclosedPiece& piece, double above) {
  const Interval& length = piece.length;
  const Interval3 normal = cross(e.outer, e.inner);
  const Interval sine = norm(normal) / (e.outer_length * e.inner_length);
  const Interval normal_square = square(normal);
  const bool parallel = sine.upper <= kParallel || !(normal_square.lower > 0);
  // Lines that are parallel but for rounding (of cuts, too) count as parallel: the points of the inner edge move across the outer line
  // by at most `moved`, ∫ ln r by 2π times that at every node and in the integral (NOTES.md §10).
  const Interval moved = parallel ? sine * e.inner_length : Interval();
  const Interval ends =
      min(norm(e.start - piece.from) + norm(e.start - piece.to), norm(e.end - piece.from) + norm(e.end - piece.to)) -
      Interval(2) * moved;
  double rho = certain_ellipse(ends / length);
  if (!(rho > above)) return {};
  Interval slope, extra;
  if (parallel) {
    constexpr double kAlmostOne = 1 + 0x1p-40;  // the moved edge is shorter by the cosine of that angle
    slope = kAlmostOne;
    extra = Interval(4) * pi() * moved * kAlmostOne / e.inner_length;
  } else {
    const Interval3 gap = e.start - piece.from;
    // In units of length along the outer line, from the middle of the piece.
    const Interval height = abs(dot(gap, normal)) * e.outer_length * e.inner_length / normal_square;
    const Interval half = Interval(0.5) * length;
    const Interval foot = dot(cross(gap, e.inner), normal) / normal_square * e.outer_length - half;
    const Interval branch_axis =
        (sqrt(square(foot - half) + square(height)) + sqrt(square(foot + half) + square(height))) / length;
    const double branch = certain_ellipse(branch_axis);
    rho = std::min(rho, 1 + kBranchClearance * (branch - 1));
    if (!(rho > above)) return {};
    const Interval clearance =
        Interval(0.5) * half * (Interval(branch) - rho) * (Interval(1) - Interval(1) / (Interval(branch) * rho));
    if (!(clearance.lower > 0)) return {};
    slope = Interval(1) + sine * sqrt(Interval(1) + height / clearance);
  }
  const Interval weight =
      Interval(1) + Interval(0.25) * pi() * length * (Interval(rho) + Interval(1) / rho) * slope / e.inner_length;
  return {rho, weight.upper, extra.upper};
}

}  // namespace etendue
