// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/certified_contour.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "etendue/form_factor/certified_decay.hpp"
#include "etendue/form_factor/gauss_legendre.hpp"

namespace etendue {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Below this ellipse parameter halving the interval is cheaper than adding nodes.
constexpr double kNarrowEllipse = 1.7;
constexpr int kMaxNodes = 20;

struct Edges : EnclosedEdges {
  double largest = 0;  ///< ∫ |ln r| along the inner edge is below, from any point of the outer one
};

/// |x ln r| where |x| ≤ length · r and r reaches down to zero.
Interval vanishing(const Interval& length, const Interval& square) {
  const Interval r = sqrt(Interval(square.upper));
  constexpr double kRising = 0.36;  // r |ln r| rises up to 1/e
  if (!(r.upper < kRising)) return Interval::everything();
  const double bound = (length * r * abs(log(r))).upper;
  return {-bound, bound};
}

/// x ln r from r².
Interval times_log(const Interval& x, const Interval& length, const Interval& square) {
  if (square.upper == 0) return {};
  if (!(square.lower > 0)) return vanishing(length, square);
  return Interval(0.5) * x * log(square);
}

/// ∫_0^1 ln |start + t inner − p| dt + 1: what is constant vanishes around a closed chain.
Interval inner_integral(const Edges& e, const Interval3& p) {
  const Interval3 to_start = e.start - p, to_end = e.end - p;
  const Interval start_square = square(to_start), end_square = square(to_end);
  const Interval across = norm(cross(start_square.upper < end_square.upper ? to_start : to_end, e.inner));
  const Interval turned = across * angle(across, dot(to_start, to_end));
  const Interval sum = times_log(dot(to_end, e.inner), e.inner_length, end_square) -
                       times_log(dot(to_start, e.inner), e.inner_length, start_square) + turned;
  return sum / e.inner_square;
}

/// ∫_0^1 ds of the inner integral, over pieces of the outer edge that are halved towards its singularities.
class EdgeIntegral {
 public:
  EdgeIntegral(const Edges& edges, double goal, std::int64_t budget) : e_(edges), goal_(goal), budget_(budget) {
    // Pieces that the rounding of the corners blurs, or that weigh less than the goal, are not worth halving.
    smallest_ = std::max({kSmallest, kBlur * blur(edges) / edges.outer_length.lower, kTail * goal / edges.largest});
  }

  Interval integrate() {
    add(0, 1);
    return sum_ + Interval(-left_, left_);
  }
  std::int64_t work() const { return work_; }

 private:
  void add(double from, double to) {
    const double share = to - from;  // exact: dyadic
    const Interval3 a = Interval(from) * e_.outer, b = Interval(to) * e_.outer;
    const Interval length = Interval(share) * e_.outer_length;
    if (work_ < budget_ && share > smallest_) {
      const CertifiedDecay decay = decay_along({a, b, length});
      if (decay.rho >= kNarrowEllipse && add_gauss(from, to, decay)) return;
      const double middle = 0.5 * (from + to);
      ++work_;
      add(from, middle);
      add(middle, to);
      return;
    }
    left_ = above(left_ + above(share * e_.largest));
  }

  CertifiedDecay decay_along(const EnclosedPiece& piece) const {
    const CertifiedDecay plain = certified_plain_decay(e_, piece);
    if (plain.rho >= kNarrowEllipse) return plain;
    const CertifiedDecay bent = certified_bent_decay(e_, piece, plain.rho);
    return bent.rho > plain.rho ? bent : plain;
  }

  bool add_gauss(double from, double to, const CertifiedDecay& decay) {
    const double share = to - from, half = 0.5 * share, middle = 0.5 * (from + to);
    int n = 2;
    double truncation = 0;
    for (;; ++n) {
      const Interval bound = Interval(half) * decay.weight * certain_logarithmic_truncation(n, decay.rho);
      truncation = bound.upper;
      if (truncation <= share * goal_ || n == kMaxNodes) break;
    }
    if (truncation > share * goal_ && truncation > share * kFinest) return false;
    Interval sum;
    for (const QuadratureNode& node : gauss_legendre(n)) {
      // The true node and weight lie between the neighbours of the table's.
      const Interval x(below(node.x), above(node.x)), weight(below(node.weight), above(node.weight));
      const Interval s = Interval(middle) + Interval(half) * x;
      sum = sum + weight * inner_integral(e_, s * e_.outer);
    }
    work_ += n;
    sum_ = sum_ + Interval(half) * sum;
    left_ = above(left_ + above(truncation + above(share * decay.extra)));
    return true;
  }

  /// Shorter pieces, as shares of the edge, count as unknown: ∫ |ln r| over them is of the order of rounding.
  /// (Halves of them would end at numbers near 1 that no double can be.)
  static constexpr double kSmallest = 0x1p-53;
  static constexpr double kFinest = 0x1p-54;
  static constexpr double kBlur = 4, kTail = 0x1p-5;
  static double blur(const Edges& e) {
    double widest = 0;
    for (const Interval3* p : {&e.outer, &e.start, &e.end}) {
      widest = std::max({widest, p->x.width(), p->y.width(), p->z.width()});
    }
    return widest;
  }

  const Edges& e_;
  double smallest_ = 0;
  double goal_;
  std::int64_t budget_;
  std::int64_t work_ = 0;
  Interval sum_;
  double left_ = 0;
};

/// ∫ |ln r| / length along a segment no point of which is farther than `reach`: at most that over |x| ≤ reach on its
/// line, of the larger of |ln |x|| and |ln reach| (NOTES.md §10).
double largest_logarithm(double farthest, const Interval& length) {
  const Interval reach(farthest);
  return (Interval(2) * reach * (Interval(2) + abs(log(reach))) / length + Interval(1)).upper;
}

Edges edges(const Interval3& a, const Interval3& b, const Interval3& c, const Interval3& d) {
  Edges e{enclosed_edges(a, b, c, d)};
  const Interval reach = max(max(norm(e.start), norm(e.end)), max(norm(c - b), norm(d - b)));
  e.largest = largest_logarithm(reach.upper, e.inner_length);
  return e;
}

/// |u·v| ∫∫ |ln r| for a pair of edges too short to be told from points.
Interval negligible(const Edges& e) {
  const Interval reach((norm(e.start) + norm(e.outer) + norm(e.inner)).upper);
  if (reach.upper == 0) return {};
  const double bound = (e.outer_length * Interval(2) * reach * (Interval(3) + abs(log(reach)))).upper;
  return {-bound, bound};
}

Interval power_bound(int n, double rho) {
  const Interval inverse = Interval(1) / (Interval(rho) * rho);
  Interval power(1);
  for (int k = 0; k < n; ++k) power = power * inverse;
  return power / (Interval(1) - inverse);
}

}  // namespace

double certain_logarithmic_truncation(int n, double rho) {
  return rho > 1 ? (Interval(32) / 15.0 / static_cast<double>(n) * power_bound(n, rho)).upper : kInfinity;
}

double certain_analytic_truncation(int n, double rho) {
  return rho > 1 ? (Interval(64) / 15.0 * power_bound(n, rho)).upper : kInfinity;
}

Interval enclosed_contour(const EnclosedOutline& first, const EnclosedOutline& second, double goal, std::int64_t budget,
                          std::int64_t& work) {
  const double share = goal / static_cast<double>(first.size() * second.size());
  Interval total;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const Interval3 &a = first[i], &b = first[(i + 1) % first.size()];
    for (std::size_t j = 0; j < second.size(); ++j) {
      const Interval3 &c = second[j], &d = second[(j + 1) % second.size()];
      Edges e = edges(a, b, c, d);
      const Interval along = dot(e.outer, e.inner);
      if (along.is_zero()) continue;
      // The integral is symmetric; the shorter edge outside keeps the ellipses wide.
      if (e.outer_length.upper > e.inner_length.upper) e = edges(c, d, a, b);
      if (!(e.outer_length.lower > 0 && e.inner_length.lower > 0)) {
        total = total + negligible(e);
        ++work;
        continue;
      }
      EdgeIntegral integral(e, share / along.magnitude(), budget - work);
      total = total + along * integral.integrate();
      work += integral.work();
    }
  }
  return total;
}

}  // namespace etendue
