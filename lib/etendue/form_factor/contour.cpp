// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/contour.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <optional>

#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/gauss_legendre.hpp"

namespace etendue {

namespace {

using Complex = std::complex<double>;

struct Segment {
  Vec3 start;
  Vec3 end;
  Vec3 direction;  ///< unit
  double length;
};

Segment segment(const Vec3& start, const Vec3& end) {
  const Vec3 vector = end - start;
  const double length = vector.norm();
  return {start, end, vector / length, length};
}

/// The closed form of coplanar edges: four corners, each z² ln z, divided by the two edges.
constexpr double kCornerRoundings = 24;
/// Below this ellipse parameter halving the interval is cheaper than adding nodes.
constexpr double kNarrowEllipse = 1.7;
/// The contour leaves room between the deformed path and the branch point of the crossing lines.
constexpr double kBranchClearance = 0.7;

/// ∫ over `inner` of ln |x − p|, and a bound on its rounding error in units of u.
struct InnerIntegral {
  double value;
  double roundings;
};

double half_log(double square) {
  return square > 0 ? 0.5 * std::log(square) : 0;
}

/// `coordinates` bounds |p|, whose own rounding moves the integral by its gradient. The count is in NOTES.md §3.
InnerIntegral inner_integral(const Vec3& p, const Segment& inner, double coordinates) {
  const Vec3 to_start = inner.start - p;
  const Vec3 to_end = inner.end - p;
  const double square_start = to_start.squaredNorm(), square_end = to_end.squaredNorm();
  const double r_start = std::sqrt(square_start), r_end = std::sqrt(square_end);
  const double log_start = half_log(square_start), log_end = half_log(square_end);
  const double distance = to_start.cross(to_end).norm() / inner.length;
  const double angle = std::atan2(distance * inner.length, to_start.dot(to_end));
  const double value = to_end.dot(inner.direction) * log_end - to_start.dot(inner.direction) * log_start -
                       inner.length + distance * angle;
  const double roundings = 3 * coordinates * (std::abs(log_end - log_start) + angle) +
                           r_end * (8 * std::abs(log_end) + 3) + r_start * (8 * std::abs(log_start) + 3) +
                           2 * inner.length + 5 * r_start * r_end * angle / inner.length + distance * (8 + 4 * angle);
  return {value, roundings};
}

double joukowski(double semi_axis) {
  return semi_axis <= 1 ? 1 : semi_axis + std::sqrt((semi_axis - 1) * (semi_axis + 1));
}

/// |x − a| + |x − b| for the point at t of a line, and its slope: convex in t.
struct FocalSum {
  double value;
  double slope;
};

FocalSum focal_sum(const Segment& foci, const Segment& line, double t) {
  const Vec3 x = line.start + t * line.direction;
  const Vec3 a = x - foci.start, b = x - foci.end;
  const double ra = a.norm(), rb = b.norm();
  const double slope = (ra > 0 ? a.dot(line.direction) / ra : 0) + (rb > 0 ? b.dot(line.direction) / rb : 0);
  return {ra + rb, slope};
}

/// Lower bound on the least focal sum over the segment `line`: two tangents of a convex function, once refined.
double least_focal_sum(const Segment& foci, const Segment& line, const FocalSum& at_start, const FocalSum& at_end) {
  if (at_start.slope >= 0) return at_start.value;
  if (at_end.slope <= 0) return at_end.value;
  double left = 0, right = line.length;
  FocalSum low = at_start, high = at_end;
  double bound = 0;
  constexpr int kTangents = 4;
  for (int i = 0; i < kTangents; ++i) {
    const double crossing = (high.value - low.value + low.slope * left - high.slope * right) / (low.slope - high.slope);
    bound = low.value + low.slope * (crossing - left);
    const double t = std::clamp(crossing, left, right);
    const FocalSum middle = focal_sum(foci, line, t);
    if (middle.slope == 0) return middle.value;
    (middle.slope < 0 ? left : right) = t;
    (middle.slope < 0 ? low : high) = middle;
  }
  return std::max(bound, foci.length);
}

/// How fast the Chebyshev coefficients of the inner integral fall along `outer`: |a_k| ≤ (2/k) weight rho^(−k).
struct Decay {
  double rho;
  double weight;
};

Decay decay_along(const Segment& outer, const Segment& inner) {
  const FocalSum at_start = focal_sum(outer, inner, 0);
  const FocalSum at_end = focal_sum(outer, inner, inner.length);
  const Decay plain{joukowski(least_focal_sum(outer, inner, at_start, at_end) / outer.length), inner.length};
  if (plain.rho >= kNarrowEllipse) return plain;

  // Path of integration bent around the ellipse: only the ends and the crossing of the lines count (NOTES.md §2).
  const double ends = joukowski(std::min(at_start.value, at_end.value) / outer.length);
  const Vec3 normal = outer.direction.cross(inner.direction);
  const double sine = normal.norm();
  double rho = ends, factor = 1;
  if (sine > 0) {
    const Vec3 gap = inner.start - outer.start;
    const double height = std::abs(gap.dot(normal)) / sine / sine;
    const double foot = gap.cross(inner.direction).dot(normal) / (sine * sine) - 0.5 * outer.length;
    const double half = 0.5 * outer.length;
    const double branch = joukowski((std::hypot(foot - half, height) + std::hypot(foot + half, height)) / outer.length);
    rho = std::min(ends, 1 + kBranchClearance * (branch - 1));
    if (rho <= plain.rho) return plain;
    const double clearance = 0.5 * half * (branch - rho) * (1 - 1 / (branch * rho));
    factor += sine * std::sqrt(1 + height / clearance);
  }
  if (rho <= plain.rho) return plain;
  return {rho, inner.length + 0.25 * std::numbers::pi * outer.length * (rho + 1 / rho) * factor};
}

/// z²/2 (ln z − 3/2): its second derivative is ln z.
Complex corner(Complex z) {
  if (z == 0.0) return 0;
  return 0.5 * z * z * (std::log(z) - 1.5);
}

/// Coordinates in a plane through `outer.start` that contains outer's direction and is nearest to `inner`.
struct Chart {
  Vec3 x, y;
  double deviation;
};

Chart chart_of(const Segment& outer, const Segment& inner) {
  const auto chart = [&](const Vec3& candidate) {
    const Vec3 across = candidate - candidate.dot(outer.direction) * outer.direction;
    // What is left of a nearly parallel candidate is rounding, and need not be orthogonal: Gram and Schmidt once more.
    Vec3 y = across.norm() > 0 ? Vec3(across.normalized()) : Vec3::Zero();
    y -= y.dot(outer.direction) * outer.direction;
    y = y.norm() > 0.5 ? Vec3(y.normalized()) : Vec3(outer.direction.unitOrthogonal());
    const Vec3 normal = outer.direction.cross(y);
    const double deviation =
        std::max(std::abs((inner.start - outer.start).dot(normal)), std::abs((inner.end - outer.start).dot(normal)));
    return Chart{outer.direction, y, deviation};
  };
  const Vec3 middle = 0.5 * (inner.start + inner.end) - outer.start;
  const Chart by_direction = chart(inner.direction);
  const Chart by_middle = chart(middle);
  return by_middle.deviation < by_direction.deviation ? by_middle : by_direction;
}

double cross(Complex a, Complex b) {
  return a.real() * b.imag() - a.imag() * b.real();
}

/// Closed form, or nothing where the two segments cross inside both. Segments within `lateral` of one line count as on
/// it. Moving points by d off a line or plane changes ∬ ln r by at most π d outer.length (NOTES.md §3).
std::optional<QuadratureSum> planar_pair(const Segment& outer, const Segment& inner, const Chart& chart,
                                         double lateral) {
  const auto project = [&](const Vec3& v) { return Complex(v.dot(chart.x), v.dot(chart.y)); };
  const Complex e1(outer.length, 0);
  Complex e2 = project(inner.end - inner.start);
  Complex z[4] = {project(inner.start - outer.start), project(inner.end - outer.start),
                  project(inner.start - outer.end), project(inner.end - outer.end)};
  double reach = 0, side_low = 0, side_high = 0;
  for (const Complex& point : z) {
    reach = std::max(reach, std::abs(point));
    side_low = std::min(side_low, point.imag());
    side_high = std::max(side_high, point.imag());
  }
  const double breadth = std::max(side_high, -side_low);
  const double slack = std::max(8 * kUnitRoundoff * reach, breadth <= lateral ? breadth : 0);
  const bool straddles = side_low < -slack && side_high > slack;
  Complex rotation(1, 0);
  if (straddles) {
    const double turn = cross(e1, e2);
    const double s = cross(z[0], e2) / turn, t = cross(z[0], e1) / turn;
    const double margin = slack / std::min(outer.length, inner.length);
    if (s > margin && s < 1 - margin && t > margin && t < 1 - margin) return std::nullopt;
    const Complex centre = 0.25 * (z[0] + z[1] + z[2] + z[3]);
    rotation = std::conj(centre) / std::abs(centre);
  } else {
    // All corners on one side of outer's line: mirrored to the upper one, where the principal logarithm is continuous.
    const double side = side_high > slack ? 1 : -1;
    // (std::max could return the −0 that selects the wrong side of the cut.)
    for (Complex& point : z) point = {point.real(), side * point.imag() > 0 ? side * point.imag() : +0.0};
    e2 = {e2.real(), side * e2.imag()};
    if (breadth <= slack) {
      for (Complex& point : z) point = {point.real(), +0.0};
      e2 = {std::copysign(inner.length, e2.real()), 0.0};
    }
  }
  Complex sum = 0;
  double size = 0;
  constexpr double kSign[4] = {-1, 1, 1, -1};
  for (int i = 0; i < 4; ++i) {
    const Complex term = corner(z[i] * rotation);
    sum += kSign[i] * term;
    size += std::abs(term) + std::norm(z[i]);
  }
  const Complex scale = e1 * e2 * rotation * rotation;
  const double area = std::abs(scale);
  const double area_lengths = outer.length * inner.length;
  QuadratureSum result;
  result.value = (sum / scale).real() * area_lengths;
  result.rounding = kCornerRoundings * kUnitRoundoff * size / area * area_lengths;
  result.truncation = std::numbers::pi * (chart.deviation + std::min(slack, breadth)) * outer.length;
  return result;
}

class EdgePair {
 public:
  EdgePair(const Segment& outer, const Segment& inner, double goal)
      : inner_(inner), length_(outer.length), density_(goal / outer.length) {
    reach_ = std::max({(inner.start - outer.start).norm(), (inner.start - outer.end).norm(),
                       (inner.end - outer.start).norm(), (inner.end - outer.end).norm()});
    // ∫ |ln r| over a segment no longer than 2 reach, both ends within reach of p.
    coordinates_ = std::max(outer.start.norm(), outer.end.norm());
    largest_ = 2 * reach_ * (2 + std::abs(std::log(reach_)));
  }

  QuadratureSum integrate(const Segment& outer) {
    add(outer);
    return sum_;
  }

 private:
  void add(const Segment& outer) {
    const double goal = density_ * outer.length;
    const Decay decay = decay_along(outer, inner_);
    if (decay.rho >= kNarrowEllipse && add_gauss(outer, decay, goal)) return;
    const Chart chart = chart_of(outer, inner_);
    const double allowed = std::max(goal / outer.length, kFlattening * kUnitRoundoff * reach_) / (2 * std::numbers::pi);
    if (chart.deviation <= allowed) {
      if (const auto closed = planar_pair(outer, inner_, chart, allowed)) {
        sum_.value += closed->value;
        sum_.truncation += closed->truncation;
        sum_.rounding += closed->rounding;
        return;
      }
    }
    if (2 * outer.length * largest_ <= std::max(goal, kUnitRoundoff * length_ * largest_)) {
      sum_.truncation += 2 * outer.length * largest_;
      sum_.value += outer.length * inner_integral(0.5 * (outer.start + outer.end), inner_, coordinates_).value;
      return;
    }
    const Vec3 middle = 0.5 * (outer.start + outer.end);
    const double half = 0.5 * outer.length;
    add({outer.start, middle, outer.direction, half});
    add({middle, outer.end, outer.direction, half});
  }

  bool add_gauss(const Segment& outer, const Decay& decay, double goal) {
    const double half = 0.5 * outer.length;
    int n = 2;
    double truncation = 0;
    for (;; ++n) {
      truncation = half * decay.weight * logarithmic_truncation(n, decay.rho);
      if (truncation <= goal || n == kMaxNodes) break;
    }
    if (truncation > goal && truncation > kUnitRoundoff * outer.length * largest_) return false;
    const Vec3 middle = 0.5 * (outer.start + outer.end);
    double value = 0, roundings = 0;
    for (const QuadratureNode& node : gauss_legendre(n)) {
      const InnerIntegral g = inner_integral(middle + (half * node.x) * outer.direction, inner_, coordinates_);
      value += node.weight * g.value;
      roundings += node.weight * g.roundings;
    }
    sum_.value += half * value;
    sum_.truncation += truncation;
    sum_.rounding += half * kUnitRoundoff * (roundings + kSumRoundings * std::abs(value));
    return true;
  }

  static constexpr int kMaxNodes = 20;
  static constexpr double kSumRoundings = kMaxNodes + 4;  // of the weights, the products, the sum and the half length
  /// Deviations from a common plane that rounding alone makes, as multiples of u · reach.
  static constexpr double kFlattening = 32;
  const Segment& inner_;
  double length_;
  double density_;
  double reach_ = 0;
  double coordinates_ = 0;
  double largest_ = 0;
  QuadratureSum sum_;
};

}  // namespace

QuadratureSum double_contour(std::span<const Vec3> first, std::span<const Vec3> second, double goal) {
  const double share = goal / static_cast<double>(first.size() * second.size());
  QuadratureSum total;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const Segment a = segment(first[i], first[(i + 1) % first.size()]);
    if (!(a.length > 0)) continue;
    for (std::size_t j = 0; j < second.size(); ++j) {
      const Segment b = segment(second[j], second[(j + 1) % second.size()]);
      if (!(b.length > 0)) continue;
      const double cosine = a.direction.dot(b.direction);
      if (cosine == 0) continue;
      const double weight = std::abs(cosine);
      // The integral is symmetric; the shorter edge outside keeps the ellipses wide.
      const bool swap = a.length > b.length;
      const QuadratureSum pair = EdgePair(swap ? b : a, swap ? a : b, share / weight).integrate(swap ? b : a);
      total.value += cosine * pair.value;
      total.truncation += weight * pair.truncation;
      total.rounding += weight * pair.rounding + 8 * kUnitRoundoff * std::abs(pair.value);
    }
  }
  return total;
}

}  // namespace etendue
