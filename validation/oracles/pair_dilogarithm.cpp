// SPDX-License-Identifier: Apache-2.0
#include "oracles/pair_dilogarithm.hpp"

#include <acb.h>
#include <acb_hypgeom.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "oracles/ball.hpp"

// A₁ F₁₂ = 1/(4π) Σ cos α ∬ ln f ds dt over the pairs of edges, f the squared distance. With s and t counted along the two
// lines from the feet of their common perpendicular, h its length, c = cos α and σ = sin α,
//
//     f = s² + t² − 2cst + h²,   R² = h² + σ²t²,   S² = h² + σ²s²,   τ = t − cs.
//
// A function D with ∂²D/∂s∂t = ln f gives the double integral as its mixed difference over four corners. Along s,
// ∫ ln f ds = (s − ct) ln f − 2s + 2R atan((s − ct)/R). Along t the first term is elementary; the last one by parts with K' = R,
// K = (tR + (h²/σ) w)/2, w = asinh(σt/h), leaves ∫ t(ch² + σ²st)/f dt, which is rational, and
//
//     (h²/σ) ∫ w (ch² + σ²st)/(R f) dt,   dt/R = dw/σ.
//
// In z = e^w the quotient has four poles: with w_s = asinh(σs/h) they are e^(w_s ± iα) and −e^(−w_s ± iα), since
// h² + σ²t² is a perfect square, (cS + iσ²s)², at the zeros t = cs ± iS of f. All residues have the same size, and
//
//     ∫ ln z/(z − a) dz = ln z ln(1 − z/a) + Li₂(z/a)
//
// ends it: (h²/σ) Im(w ln((1 − p)/(1 − q)) + Li₂(p) − Li₂(q)), p = e^(w − w_s − iα), q = −e^(w + w_s + iα). Neither p nor q
// meets the cut [1, ∞), because 0 < α < π.
namespace etendue::oracle {

namespace {

using Exact = BallAt<2400>;  // products of six differences of doubles of like size are exact in it
using Real = BallAt<448>;

template <class T>
using Point3 = std::array<T, 3>;
using Corner = Point3<Exact>;

template <class T>
Point3<T> operator-(const Point3<T>& a, const Point3<T>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <class T>
T dot(const Point3<T>& a, const Point3<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class T>
Point3<T> cross(const Point3<T>& a, const Point3<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Real asinh(const Real& x) {
  Real r;
  arb_asinh(r.get(), x.get(), Real::kBits);
  return r;
}

Real magnitude(const Real& x) {
  Real r;
  arb_abs(r.get(), x.get());
  return r;
}

class Complex {
 public:
  Complex(const Real& re, const Real& im) {
    acb_init(z_);
    acb_set_arb_arb(z_, re.get(), im.get());
  }
  Complex(const Complex&) = delete;
  Complex& operator=(const Complex&) = delete;
  ~Complex() { acb_clear(z_); }

  Real imaginary_dilogarithm() const {
    acb_t r;
    acb_init(r);
    acb_hypgeom_dilog(r, z_, Real::kBits);
    Real result;
    arb_set(result.get(), acb_imagref(r));
    acb_clear(r);
    return result;
  }
  /// arg(1 − z)
  Real argument_of_rest() const {
    acb_t r;
    acb_init(r);
    acb_sub_ui(r, z_, 1, Real::kBits);
    acb_neg(r, r);
    Real result;
    acb_arg(result.get(), r, Real::kBits);
    acb_clear(r);
    return result;
  }

 private:
  acb_t z_;
};

/// Two lines that are not parallel.
struct Skew {
  Real c, sine, h;
  bool meet = false;  ///< h is zero

  /// (h²/σ) Im(w ln((1 − p)/(1 − q)) + Li₂(p) − Li₂(q))
  Real dilogarithms(const Real& s, const Real& t) const {
    const Real w = asinh(sine * t / h), other = asinh(sine * s / h);
    const Real near = exp(w - other), far = exp(w + other);
    const Complex p(near * c, -(near * sine)), q(-(far * c), -(far * sine));
    return h * h / sine *
           (w * (p.argument_of_rest() - q.argument_of_rest()) + p.imaginary_dilogarithm() - q.imaginary_dilogarithm());
  }

  Real antiderivative(const Real& s, const Real& t) const {
    const Real two(2), half(0.5), square = sine * sine;
    if (meet && s.exactly_zero() && t.exactly_zero()) return Real(0);
    const Real tau = t - c * s, f = tau * tau + h * h + square * s * s, log_f = log(f);
    const Real root_s = meet ? sine * magnitude(s) : sqrt(h * h + square * s * s);
    const Real root_t = meet ? sine * magnitude(t) : sqrt(h * h + square * t * t);
    const Real st = s * t;
    Real sum = square * s * (tau * log_f - two * tau) - half * c * (f * log_f - f) - two * st + square * st;
    sum = sum + half * (c * h * h + two * c * square * s * s) * log_f;
    if (!(meet && s.exactly_zero())) {
      const Real rest = s * (c * c * h * h + square * (two * c * c - Real(1)) * s * s - square * h * h);
      sum = sum + (two * square * s * root_s + rest / root_s) * atan(tau / root_s);
    }
    if (!(meet && t.exactly_zero())) {
      Real twice_k = t * root_t;
      if (!meet) twice_k = twice_k + h * h / sine * asinh(sine * t / h);
      sum = sum + twice_k * atan((s - c * t) / root_t);
    }
    return meet ? sum : sum + dilogarithms(s, t);
  }
};

/// −P(s − ct)/c with P'' = ln(u² + h²): parallel lines, c = ±1.
Real parallel_antiderivative(const Real& u, const Real& h) {
  const Real half(0.5);
  if (h.exactly_zero()) {
    if (u.exactly_zero()) return Real(0);
    return half * u * u * log(u * u) - Real(1.5) * u * u;
  }
  const Real f = u * u + h * h;
  return half * (f * log(f) - f) - u * u + Real(2) * h * u * atan(u / h) - h * h * log(f);
}

/// What cuts have made is a ball; nothing that is not zero is as small as this, since every coordinate is a double of size
/// order one, or zero: the degree of what is formed from them and from cuts is below eighteen.
constexpr double kZero = 0x1p-900;

Exact settled(const Exact& x) {
  return std::abs(x.midpoint()) + x.radius() < kZero ? Exact(0) : x;
}

/// ∬ ln f times U·V over the edges a + λU and b + μV, λ and μ in [0, 1].
Real edge_pair(const Corner& a, const Corner& u, const Corner& b, const Corner& v) {
  const Exact product = settled(dot(u, v));
  if (product.exactly_zero()) return Real(0);
  const Corner w = b - a, normal = cross(u, v);
  const Exact square = settled(dot(normal, normal)), uu = dot(u, u), vv = dot(v, v), wu = dot(w, u), wv = dot(w, v);
  const Real length_u = sqrt(Real(uu)), length_v = sqrt(Real(vv)), cosine = Real(product) / (length_u * length_v);
  Real total;
  if (square.exactly_zero()) {
    const Corner off = cross(w, u);
    const Exact off_square = settled(dot(off, off));
    const Real h = off_square.exactly_zero() ? Real(0) : sqrt(Real(off_square / uu));
    const Real sign = product.certainly_positive() ? Real(1) : Real(-1);
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        // along U from a: λ|U| − (w + μV)·U/|U|, its numerator exact
        const Exact along = settled(Exact(i) * uu - wu - Exact(j) * product);
        const Real p = parallel_antiderivative(along.exactly_zero() ? Real(0) : Real(along) / length_u, h);
        total = i == j ? total + p : total - p;
      }
    }
    return cosine * (-sign * total);
  }
  const Exact volume = settled(dot(w, normal));
  Skew lines{cosine, sqrt(Real(square)) / (length_u * length_v), Real(0), volume.exactly_zero()};
  if (!lines.meet) lines.h = magnitude(Real(volume)) / sqrt(Real(square));
  // The feet's parameters are λ₀/square and μ₀/square.
  const Exact foot_u = wu * vv - product * wv, foot_v = product * wu - wv * uu;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      const Exact from_foot_u = settled(Exact(i) * square - foot_u), from_foot_v = settled(Exact(j) * square - foot_v);
      const Real s = from_foot_u.exactly_zero() ? Real(0) : length_u * Real(from_foot_u) / Real(square);
      const Real t = from_foot_v.exactly_zero() ? Real(0) : length_v * Real(from_foot_v) / Real(square);
      const Real d = lines.antiderivative(s, t);
      total = i == j ? total + d : total - d;
    }
  }
  return cosine * total;
}

using Region = std::vector<std::vector<Corner>>;

Region exact(const Loops& loops) {
  Region region;
  for (const auto& loop : loops) {
    region.emplace_back();
    for (const auto& p : loop) region.back().push_back({Exact(p[0]), Exact(p[1]), Exact(p[2])});
  }
  return region;
}

Corner area_vector(const Region& region) {
  Corner sum{};
  for (const auto& v : region) {
    for (std::size_t i = 1; i + 1 < v.size(); ++i) {
      const Corner part = cross(v[i] - v[0], v[i + 1] - v[0]);
      for (std::size_t k = 0; k < 3; ++k) sum[k] = sum[k] + part[k];
    }
  }
  return sum;
}

/// What of the region lies in front of the other's plane, at its first vertex (Sutherland and Hodgman 1974); every sign exact.
Region in_front(const Region& region, const Region& plane) {
  const Corner normal = area_vector(plane);
  Region kept;
  for (const auto& loop : region) {
    std::vector<Exact> heights;
    for (const Corner& p : loop) heights.push_back(dot(p - plane[0][0], normal));
    std::vector<Corner> part;
    bool any = false;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::size_t j = (i + 1) % loop.size();
      const Exact &here = heights[i], &there = heights[j];
      any = any || here.certainly_positive();
      if (!here.certainly_negative()) part.push_back(loop[i]);
      const bool leaves = here.certainly_positive() && there.certainly_negative();
      if (!leaves && !(here.certainly_negative() && there.certainly_positive())) continue;
      const Exact share = here / (here - there);
      Corner cut;
      for (std::size_t k = 0; k < 3; ++k) cut[k] = loop[i][k] + share * (loop[j][k] - loop[i][k]);
      part.push_back(cut);
    }
    if (any) kept.push_back(part);
  }
  return kept;
}

}  // namespace

FactorBall pair_dilogarithm(const Loops& from, const Loops& to) {
  const Region whole_1 = exact(from), whole_2 = exact(to);
  const Region first = in_front(whole_1, whole_2), second = in_front(whole_2, whole_1);
  Real sum;
  for (const auto& p : first) {
    for (const auto& q : second) {
      for (std::size_t i = 0; i < p.size(); ++i) {
        for (std::size_t j = 0; j < q.size(); ++j) {
          sum = sum + edge_pair(p[i], p[(i + 1) % p.size()] - p[i], q[j], q[(j + 1) % q.size()] - q[j]);
        }
      }
    }
  }
  const Corner area = area_vector(whole_1);
  Real circle;
  arb_const_pi(circle.get(), Real::kBits);
  const Real factor = sum / (Real(2) * circle * sqrt(Real(dot(area, area))));  // 4π A, A half the vector's length
  const TwoDoubles split = two_doubles(factor);
  return FactorBall{split.high, split.low, split.radius};
}

}  // namespace etendue::oracle
