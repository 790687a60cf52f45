// SPDX-License-Identifier: Apache-2.0
#include "oracles/pair_contour.hpp"

#include <acb.h>
#include <arb_hypgeom.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

#include "oracles/ball.hpp"

namespace etendue::oracle {

namespace {

using Exact = BallAt<600>;  // products of three differences of doubles are exact in it
using Real = BallAt<224>;

template <class T>
struct Vector {
  T x, y, z;

  friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector operator*(const T& k, const Vector& a) { return {k * a.x, k * a.y, k * a.z}; }
  friend T dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
};

Vector<Real> narrowed(const Vector<Exact>& a) {
  return {Real(a.x), Real(a.y), Real(a.z)};
}

double upper(const Real& a) {
  return (std::abs(a.midpoint()) + a.radius()) * (1 + 0x1p-50);
}

/// A lower bound of a number that is not negative.
double lower(const Real& a) {
  return std::max(0.0, (a.midpoint() - a.radius()) * (1 - 0x1p-50));
}

Real length(const Vector<Real>& a) {
  Real root;  // of a ball that may reach below zero by its rounding
  arb_sqrtpos(root.get(), dot(a, a).get(), Real::kBits);
  return root;
}

Real with_error(Real value, double error) {
  mag_t radius;
  mag_init(radius);
  mag_set_d(radius, error);
  arb_add_error_mag(value.get(), radius);
  mag_clear(radius);
  return value;
}

Real circle_constant() {
  Real r;
  arb_const_pi(r.get(), Real::kBits);
  return r;
}

using Chain = std::vector<Vector<Exact>>;

Vector<Exact> area_vector(const std::vector<Chain>& region) {
  Vector<Exact> sum;
  for (const Chain& v : region) {
    for (std::size_t i = 1; i + 1 < v.size(); ++i) sum = sum + cross(v[i] - v[0], v[i + 1] - v[0]);
  }
  return sum;
}

std::vector<Chain> in_front(const std::vector<Chain>& region, const std::vector<Chain>& plane, double planarity,
                            double& margin) {
  const Vector<Exact> area = area_vector(plane);
  const Exact size = sqrt(dot(area, area));
  const double extent = std::sqrt(size.midpoint());
  std::vector<Chain> kept;
  for (const Chain& chain : region) {
    std::vector<Exact> heights;
    bool any = false;
    for (const auto& v : chain) {
      const Vector<Exact> r = v - plane[0][0];
      Exact height = dot(r, area) / size;
      const double relative = std::abs(height.midpoint()) / std::max(extent, std::sqrt(dot(r, r).midpoint()));
      if (relative <= planarity) {
        height = Exact(0);
      } else {
        margin = std::min(margin, relative);
      }
      any = any || height.certainly_positive();
      heights.push_back(height);
    }
    if (!any) continue;
    Chain part;
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const std::size_t j = (i + 1) % chain.size();
      if (!heights[i].certainly_negative()) part.push_back(chain[i]);
      if ((heights[i].certainly_positive() && heights[j].certainly_negative()) ||
          (heights[i].certainly_negative() && heights[j].certainly_positive())) {
        part.push_back(chain[i] + heights[i] / (heights[i] - heights[j]) * (chain[j] - chain[i]));
      }
    }
    if (part.size() >= 3) kept.push_back(part);
  }
  return kept;
}

struct Node {
  Real x, weight;
};

const std::vector<Node>& gauss_rule(unsigned n) {
  static std::map<unsigned, std::vector<Node>> rules;
  auto& rule = rules[n];
  if (rule.empty()) {
    rule.resize(n);
    for (unsigned k = 0; k < n; ++k) {
      arb_hypgeom_legendre_p_ui_root(rule[k].x.get(), rule[k].weight.get(), n, k, Real::kBits);
    }
  }
  return rule;
}

/// z²/2 (ln z − 3/2) for z = x + iy in the closed upper half-plane; y is exactly zero or certainly positive.
struct Complex {
  Real re, im;
};

Complex corner(const Complex& z, double& error) {
  if (z.re.exactly_zero() && z.im.exactly_zero()) return {};
  const Real square = z.re * z.re + z.im * z.im;
  if (!square.certainly_positive()) {  // |z²/2 (ln z − 3/2)| near zero
    const double s = std::max(upper(square), 0x1p-900);
    error += s * (std::abs(std::log(s)) + 4);
    return {};
  }
  const Real half(0.5);
  const Real re = half * log(square) - Real(1.5), im = atan2(z.im, z.re);
  const Real a = half * (z.re * z.re - z.im * z.im), b = z.re * z.im;
  return {a * re - b * im, a * im + b * re};
}

/// ∬ ln |z_c + t e − s| over 0 ≤ s ≤ outer, 0 ≤ t ≤ |e|; both ends of e in the closed upper half-plane.
Real half_plane_pair(const Real& outer, const Complex& c, const Complex& d) {
  double error = 0;
  const Complex g[4] = {corner(c, error), corner(d, error), corner({c.re - outer, c.im}, error),
                        corner({d.re - outer, d.im}, error)};
  const Real re = g[1].re + g[2].re - g[0].re - g[3].re, im = g[1].im + g[2].im - g[0].im - g[3].im;
  const Real ex = d.re - c.re, ey = d.im - c.im;
  const Real square = ex * ex + ey * ey;
  // Re(sum / (outer e)) · outer |e|
  return with_error((re * ex + im * ey) / sqrt(square), 4 * error / lower(sqrt(square)));
}

/// The edges a–b and c–d as the integrals see them.
struct Edges {
  Vector<Real> a, u, c, d, v;  ///< u, v of length one
  Real outer, inner;
};

/// Both taken as in one plane; `deviation` bounds by how much they are not.
Real planar_pair(const Edges& e, double deviation) {
  Real total;
  const Vector<Real> to_c = e.c - e.a, to_d = e.d - e.a;
  const Vector<Real> across_c = cross(e.u, to_c), across_d = cross(e.u, to_d);
  Complex c{dot(to_c, e.u), length(across_c)}, d{dot(to_d, e.u), length(across_d)};
  for (Complex* z : {&c, &d}) {
    if (lower(z->im) > 0x1p-150 * upper(e.inner)) continue;  // else on the outer line, but for the balls' radii
    deviation += upper(z->im);
    z->im = Real(0);
  }
  const bool apart =
      c.im.certainly_positive() && d.im.certainly_positive() && dot(across_c, across_d).certainly_negative();
  if (apart) {
    const Real t = c.im / (c.im + d.im);
    const Complex crossing{c.re + t * (d.re - c.re), Real(0)};
    total = half_plane_pair(e.outer, c, crossing) + half_plane_pair(e.outer, crossing, d);
  } else {
    total = half_plane_pair(e.outer, c, d);
  }
  return with_error(total, 3.2 * deviation * upper(e.outer));
}

/// ∫ over c–d of ln |x − p|.
Real inner_integral(const Vector<Real>& p, const Edges& e) {
  const Vector<Real> to_c = e.c - p, to_d = e.d - p;
  const Real r0 = dot(to_c, to_c), r1 = dot(to_d, to_d), half(0.5);
  const Real area = length(cross(to_c, e.v));
  return half * (dot(to_d, e.v) * log(r1) - dot(to_c, e.v) * log(r0)) - e.inner +
         area * atan2(area * e.inner, dot(to_c, to_d));
}

class SkewPair {
 public:
  SkewPair(const Edges& edges, double goal) : e_(edges), goal_(goal) {}

  /// False where the edges are nearly parallel at a distance so small that the pieces become too many.
  bool integrate() {
    add(Real(0), 1, 0);
    return pieces_ <= kMostPieces;
  }
  const Real& total() const { return total_; }

 private:
  Vector<Real> at(const Real& s) const { return e_.a + (s * e_.outer) * e_.u; }

  /// A lower bound on |x − p| + |x − q| over the points x of the inner edge: the unfolded straight way, or an end.
  double least_focal_sum(const Vector<Real>& p, const Vector<Real>& q) const {
    const Vector<Real> pc = p - e_.c, qc = q - e_.c;
    const Real xp = dot(pc, e_.v), xq = dot(qc, e_.v);
    const Real hp = length(cross(pc, e_.v)), hq = length(cross(qc, e_.v));
    const Real weighted = xp * hq + xq * hp, heights = hp + hq;
    const double at_start = lower(length(pc) + length(qc));
    const double at_end = lower(length(p - e_.d) + length(q - e_.d));
    if (weighted.certainly_negative() || (weighted - e_.inner * heights).certainly_positive()) {
      return std::min(at_start, at_end);
    }
    return lower(length({xp - xq, heights, Real(0)}));
  }

  void add(const Real& s0, double width, int depth) {
    if (++pieces_ > kMostPieces) return;
    const Vector<Real> p = at(s0), q = at(s0 + Real(width));
    const double len = width * upper(e_.outer), inner = upper(e_.inner);
    const double goal = goal_ * width;
    const double axis = 0.999999 * least_focal_sum(p, q) / len;
    const double far = upper(length(p - e_.c)) + inner + len;
    if (axis > 1.25) {
      const double rho_z = axis + std::sqrt(axis * axis - 1);
      const double rho = 1 + 0.8 * (rho_z - 1), half = 0.5 * len;
      const double nearest = half * 0.5 * (rho_z - rho) * (1 - 1 / (rho_z * rho));
      const double farthest = half * 0.5 * (rho + 1 / rho) + far;
      const double most = inner * (std::max(std::abs(std::log(nearest)), std::abs(std::log(farthest))) + 6.3);
      for (unsigned n : {3u, 4u, 5u, 6u, 8u, 10u, 12u, 16u, 20u, 24u, 28u, 32u, 40u, 48u, 64u, 80u}) {
        const double error = half * 64 / 15 * most * std::pow(rho, -2.0 * n) / (1 - 1 / (rho * rho)) * 1.0001;
        if (error > goal) continue;
        Real sum;
        const Real half_step(0.5 * width), middle = s0 + half_step;
        for (const Node& node : gauss_rule(n)) {
          const Vector<Real> point = e_.a + ((middle + half_step * node.x) * e_.outer) * e_.u;
          sum = sum + node.weight * inner_integral(point, e_);
        }
        total_ = total_ + with_error(half_step * e_.outer * sum, error);
        return;
      }
    }
    constexpr int kDeepest = 120;
    const double most = 2 * len * far * (2 + std::abs(std::log(far)));  // ∫ |ln r| over no more than 2 far
    if (most <= goal || depth == kDeepest) {
      total_ = with_error(total_, most);
      return;
    }
    add(s0, 0.5 * width, depth + 1);
    add(s0 + Real(0.5 * width), 0.5 * width, depth + 1);
  }

  static constexpr int kMostPieces = 250;
  const Edges& e_;
  double goal_;
  int pieces_ = 0;
  Real total_;
};

/// |p − x| for the nearest x of the segment from `start` along the unit vector `direction`.
Real to_segment(const Vector<Real>& p, const Vector<Real>& start, const Vector<Real>& direction, const Real& extent) {
  const Vector<Real> r = p - start;
  const Real foot = dot(r, direction);
  if (!foot.certainly_positive()) return length(r);
  if (!(extent - foot).certainly_positive()) return length(r - extent * direction);
  return length(cross(r, direction));
}

/// A lower bound on the distance of two segments.
double least_distance(const Edges& e) {
  const Vector<Real> b = e.a + e.outer * e.u;
  const double ends = std::min({lower(to_segment(e.a, e.c, e.v, e.inner)), lower(to_segment(b, e.c, e.v, e.inner)),
                                lower(to_segment(e.c, e.a, e.u, e.outer)), lower(to_segment(e.d, e.a, e.u, e.outer))});
  const Vector<Real> n = cross(e.u, e.v), w = e.c - e.a;
  const Real square = dot(n, n);
  if (!square.certainly_positive()) return ends;
  const Real s = dot(cross(w, e.v), n), t = dot(cross(w, e.u), n);
  const bool outside = s.certainly_negative() || (s - e.outer * square).certainly_positive() ||
                       t.certainly_negative() || (t - e.inner * square).certainly_positive();
  const Real det = dot(w, n);
  return outside ? ends : std::min(ends, lower(length({det, Real(0), Real(0)}) / sqrt(square)));
}

Real pair_integral(const Vector<Exact>& a, const Vector<Exact>& b, const Vector<Exact>& c, const Vector<Exact>& d) {
  const Vector<Exact> u = b - a, v = d - c, w = c - a;
  const Exact product = dot(u, v);
  if (product.exactly_zero()) return Real(0);
  Edges e{narrowed(a), narrowed(u), narrowed(c), narrowed(d), narrowed(v), Real(), Real()};
  e.outer = length(e.u);
  e.inner = length(e.v);
  const Real weight = Real(product) / (e.outer * e.inner);
  e.u = (Real(1) / e.outer) * e.u;
  e.v = (Real(1) / e.inner) * e.v;
  const Exact det = dot(w, cross(u, v));
  if (det.exactly_zero()) return weight * planar_pair(e, 0);
  const double scale = upper(e.outer) * upper(e.inner), goal = 0x1p-112 * scale;
  // Nearly in one line; in one plane through the outer line and the inner edge's middle, or along its direction.
  const Vector<Real> middle = Real(0.5) * ((e.c - e.a) + (e.d - e.a));
  const Real turn = length(cross(e.u, middle)), lean = length(cross(e.u, e.v));
  double off = std::max(upper(length(cross(e.u, e.c - e.a))), upper(length(cross(e.u, e.d - e.a))));
  if (turn.certainly_positive()) off = std::min(off, 0.5 * upper(e.inner * dot(e.v, cross(e.u, middle)) / turn));
  if (lean.certainly_positive()) off = std::min(off, upper(dot(e.c - e.a, cross(e.u, e.v)) / lean));
  const double gap = std::max(0.0, least_distance(e) - off);
  double moved = 3.2 * off * upper(e.outer);
  if (gap > 0) moved = std::min(moved, 0.5 * off * off / (gap * gap) * scale);
  if (moved <= goal) return weight * with_error(planar_pair(e, 0), moved);
  SkewPair skew(e, goal);
  // Rounded frames leave nearly parallel edges at hair's distances: there the bound of the plane case is all there is.
  return weight * (skew.integrate() ? skew.total() : with_error(planar_pair(e, 0), moved));
}

std::vector<Chain> exact(const Loops& loops) {
  std::vector<Chain> region;
  for (const auto& loop : loops) {
    Chain chain;
    for (const auto& p : loop) chain.push_back({Exact(p[0]), Exact(p[1]), Exact(p[2])});
    region.push_back(chain);
  }
  return region;
}

}  // namespace

FactorBall pair_contour(const Loops& from, const Loops& to, double planarity) {
  const std::vector<Chain> whole_1 = exact(from), whole_2 = exact(to);
  FactorBall result;
  const std::vector<Chain> second = in_front(whole_2, whole_1, planarity, result.margin);
  const std::vector<Chain> first = in_front(whole_1, whole_2, planarity, result.margin);
  if (first.empty() || second.empty()) return result;
  Real sum;
  for (const Chain& p : first) {
    for (const Chain& q : second) {
      for (std::size_t i = 0; i < p.size(); ++i) {
        for (std::size_t j = 0; j < q.size(); ++j) {
          sum = sum + pair_integral(p[i], p[(i + 1) % p.size()], q[j], q[(j + 1) % q.size()]);
        }
      }
    }
  }
  const Vector<Exact> area = area_vector(whole_1);
  const Real factor = sum / (circle_constant() * Real(sqrt(dot(area, area))));
  const TwoDoubles split = two_doubles(factor);
  result.high = split.high, result.low = split.low, result.radius = split.radius;
  return result;
}

}  // namespace etendue::oracle
