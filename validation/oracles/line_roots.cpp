// SPDX-License-Identifier: Apache-2.0
#include "oracles/line_roots.hpp"

#include <acb.h>
#include <arb_fmpz_poly.h>
#include <flint/fmpq.h>
#include <flint/fmpq_poly.h>
#include <flint/fmpz_mpoly.h>
#include <flint/fmpz_poly_factor.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "oracles/ball.hpp"

namespace etendue::oracle {

namespace {

constexpr slong kBits = 240;

/// A polynomial in the line's parameter with rational coefficients.
class Polynomial {
 public:
  Polynomial(double constant = 0) : Polynomial(constant, 0) {}
  /// a + b t
  Polynomial(double a, double b) {
    fmpq_poly_init(value_);
    set(0, a);
    set(1, b);
  }
  Polynomial(const Polynomial& other) {
    fmpq_poly_init(value_);
    fmpq_poly_set(value_, other.value_);
  }
  Polynomial& operator=(const Polynomial& other) {
    fmpq_poly_set(value_, other.value_);
    return *this;
  }
  ~Polynomial() { fmpq_poly_clear(value_); }

  friend Polynomial operator+(const Polynomial& a, const Polynomial& b) { return made(fmpq_poly_add, a, b); }
  friend Polynomial operator-(const Polynomial& a, const Polynomial& b) { return made(fmpq_poly_sub, a, b); }
  friend Polynomial operator*(const Polynomial& a, const Polynomial& b) { return made(fmpq_poly_mul, a, b); }

  const fmpq_poly_struct* get() const { return value_; }

 private:
  void set(slong power, double coefficient) {
    if (coefficient == 0) return;
    int exponent = 0;
    const double digits = std::ldexp(std::frexp(coefficient, &exponent), 53);
    fmpq_t q;
    fmpq_init(q);
    fmpz_set_d(fmpq_numref(q), digits);
    exponent -= 53;
    if (exponent >= 0) {
      fmpz_mul_2exp(fmpq_numref(q), fmpq_numref(q), static_cast<ulong>(exponent));
    } else {
      fmpz_one(fmpq_denref(q));
      fmpz_mul_2exp(fmpq_denref(q), fmpq_denref(q), static_cast<ulong>(-exponent));
    }
    fmpq_canonicalise(q);
    fmpq_poly_set_coeff_fmpq(value_, power, q);
    fmpq_clear(q);
  }
  template <class Function>
  static Polynomial made(Function function, const Polynomial& a, const Polynomial& b) {
    Polynomial r;
    function(r.value_, a.value_, b.value_);
    return r;
  }
  fmpq_poly_t value_;
};

using Line = std::array<Polynomial, 3>;

/// Origin − from + t direction: the subtraction is exact, too.
Line line_from(const Point& origin, const Point& direction, const Point& from) {
  Line line;
  for (std::size_t i = 0; i < 3; ++i) line[i] = Polynomial(origin[i], direction[i]) - Polynomial(from[i]);
  return line;
}

Line constant(const Point& p) {
  return {Polynomial(p[0]), Polynomial(p[1]), Polynomial(p[2])};
}

Polynomial dot(const Line& a, const Line& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Wide wide(const arb_t x) {
  arf_t rest;
  arf_init(rest);
  Wide result;
  result.high = arf_get_d(arb_midref(x), ARF_RND_NEAR);
  arf_set_d(rest, result.high);
  arf_sub(rest, arb_midref(x), rest, kBits, ARF_RND_NEAR);
  result.low = arf_get_d(rest, ARF_RND_NEAR);
  arf_clear(rest);
  return result;
}

void add_real_roots(const fmpz_poly_t p, std::vector<Wide>& roots) {
  const slong degree = fmpz_poly_degree(p);
  acb_ptr all = _acb_vec_init(degree);
  arb_fmpz_poly_complex_roots(all, p, 0, kBits);
  for (slong k = 0; k < degree; ++k) {
    if (arb_is_zero(acb_imagref(all + k))) roots.push_back(wide(acb_realref(all + k)));
  }
  _acb_vec_clear(all, degree);
}

/// A polynomial in u and v with integer coefficients, coefficient[i][j] of u^i v^j, up to degree 3 in each.
struct Bicubic {
  std::array<std::array<long, 4>, 4> coefficient{};
};

/// Power form of Σ B_i(u) B_j(v) c_ij: B_i = Σ_k m[i][k] t^k.
Bicubic power_form(const std::array<std::array<long, 4>, 4>& c) {
  constexpr long m[4][4] = {{1, -3, 3, -1}, {0, 3, -6, 3}, {0, 0, 3, -3}, {0, 0, 0, 1}};
  Bicubic f;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t l = 0; l < 4; ++l) f.coefficient[k][l] += m[i][k] * m[j][l] * c[i][j];
      }
    }
  }
  return f;
}

/// Real zeros in [0, 1] of the resultant of f and g with respect to the other variable (0: u is left, 1: v).
std::vector<BallAt<kBits>> shared_zeros(const Bicubic& f, const Bicubic& g, int left) {
  fmpz_mpoly_ctx_t ring;
  fmpz_mpoly_ctx_init(ring, 2, ORD_LEX);
  fmpz_mpoly_t a, b, r;
  for (auto* p : {a, b, r}) fmpz_mpoly_init(p, ring);
  for (const auto& [p, from] : {std::pair{a, &f}, std::pair{b, &g}}) {
    for (ulong i = 0; i < 4; ++i) {
      for (ulong j = 0; j < 4; ++j) {
        const ulong power[2] = {i, j};
        fmpz_mpoly_set_coeff_si_ui(p, from->coefficient[i][j], power, ring);
      }
    }
  }
  fmpz_mpoly_resultant(r, a, b, 1 - left, ring);
  fmpz_poly_t p;
  fmpz_poly_init(p);
  for (slong k = 0; k < fmpz_mpoly_length(r, ring); ++k) {
    ulong power[2];
    fmpz_t coefficient;
    fmpz_init(coefficient);
    fmpz_mpoly_get_term_exp_ui(power, r, k, ring);
    fmpz_mpoly_get_term_coeff_fmpz(coefficient, r, k, ring);
    fmpz_poly_set_coeff_fmpz(p, static_cast<slong>(power[left]), coefficient);
    fmpz_clear(coefficient);
  }
  std::vector<BallAt<kBits>> zeros;
  fmpz_poly_factor_t factors;
  fmpz_poly_factor_init(factors);
  if (fmpz_poly_degree(p) > 0) fmpz_poly_factor_squarefree(factors, p);
  for (slong k = 0; k < factors->num; ++k) {
    const slong degree = fmpz_poly_degree(factors->p + k);
    if (degree < 1) continue;
    acb_ptr all = _acb_vec_init(degree);
    arb_fmpz_poly_complex_roots(all, factors->p + k, 0, kBits);
    for (slong i = 0; i < degree; ++i) {
      BallAt<kBits> x;
      arb_set(x.get(), acb_realref(all + i));
      if (arb_is_zero(acb_imagref(all + i)) && x.midpoint() >= 0 && x.midpoint() <= 1) zeros.push_back(x);
    }
    _acb_vec_clear(all, degree);
  }
  fmpz_poly_factor_clear(factors);
  fmpz_poly_clear(p);
  for (auto* q : {a, b, r}) fmpz_mpoly_clear(q, ring);
  fmpz_mpoly_ctx_clear(ring);
  return zeros;
}

BallAt<kBits> value(const Bicubic& f, const BallAt<kBits>& u, const BallAt<kBits>& v) {
  BallAt<kBits> sum;
  for (std::size_t i = 4; i-- > 0;) {
    BallAt<kBits> row;
    for (std::size_t j = 4; j-- > 0;) row = row * v + BallAt<kBits>(static_cast<double>(f.coefficient[i][j]));
    sum = sum * u + row;
  }
  return sum;
}

/// Calls `use` with each factor of f that has no root twice and with its exponent in f.
template <class Use>
void for_each_factor(const Polynomial& f, Use use) {
  fmpz_poly_t p;
  fmpz_poly_init(p);
  fmpq_poly_get_numerator(p, f.get());
  if (fmpz_poly_degree(p) > 0) {
    fmpz_poly_factor_t factors;
    fmpz_poly_factor_init(factors);
    fmpz_poly_factor_squarefree(factors, p);
    for (slong k = 0; k < factors->num; ++k) {
      if (fmpz_poly_degree(factors->p + k) > 0) use(factors->p + k, factors->exp[k]);
    }
    fmpz_poly_factor_clear(factors);
  }
  fmpz_poly_clear(p);
}

LineRoots roots_of(const Polynomial& f) {
  LineRoots result;
  for_each_factor(f, [&](const fmpz_poly_struct* factor, slong exponent) {
    result.distinct += fmpz_poly_num_real_roots_sturm(factor);
    if (exponent % 2 == 1) add_real_roots(factor, result.changes);
  });
  std::sort(result.changes.begin(), result.changes.end(),
            [](const Wide& a, const Wide& b) { return a.high < b.high || (a.high == b.high && a.low < b.low); });
  return result;
}

/// Roots t > 0 of odd order. Those of f(x²) are ±√t, and 0 where it is one of f.
long crossings_ahead(const Polynomial& f) {
  long count = 0;
  for_each_factor(f, [&](const fmpz_poly_struct* factor, slong exponent) {
    if (exponent % 2 == 0) return;
    fmpz_poly_t of_square;
    fmpz_poly_init(of_square);
    fmpz_poly_inflate(of_square, factor, 2);
    const bool at_zero = fmpz_is_zero(factor->coeffs);
    if (at_zero) fmpz_poly_shift_right(of_square, of_square, 2);  // Sturm's sequence wants no root twice
    count += fmpz_poly_num_real_roots_sturm(of_square) / 2;
    fmpz_poly_clear(of_square);
  });
  return count;
}

Polynomial torus_quartic(const Point& origin, const Point& direction, const Point& centre, const Point& axis,
                         double ring, double tube) {
  const Line x = line_from(origin, direction, centre), a = constant(axis);
  const Polynomial square = dot(x, x), n2 = dot(a, a), height = dot(a, x), big(ring), small(tube);
  const Polynomial sum = square + big * big - small * small;
  return sum * sum * n2 - Polynomial(4) * big * big * (square * n2 - height * height);
}

Polynomial quadratic(const Point& origin, const Point& direction, const Point& centre,
                     const std::array<Point, 3>& square, const Point& linear, double k) {
  const Line x = line_from(origin, direction, centre);
  const Line qx = {dot(constant(square[0]), x), dot(constant(square[1]), x), dot(constant(square[2]), x)};
  return dot(x, qx) + Polynomial(2) * dot(constant(linear), x) + Polynomial(k);
}

}  // namespace

LineRoots torus_roots(const Point& origin, const Point& direction, const Point& centre, const Point& axis, double ring,
                      double tube) {
  return roots_of(torus_quartic(origin, direction, centre, axis, ring, tube));
}

long torus_crossings(const Point& origin, const Point& direction, const Point& centre, const Point& axis, double ring,
                     double tube) {
  return crossings_ahead(torus_quartic(origin, direction, centre, axis, ring, tube));
}

LineRoots cone_roots(const Point& origin, const Point& direction, const Point& base, const Point& top,
                     double base_radius, double top_radius) {
  const Line x = line_from(origin, direction, base);
  Line a = constant(top);
  for (std::size_t i = 0; i < 3; ++i) a[i] = a[i] - Polynomial(base[i]);
  const Polynomial n2 = dot(a, a), height = dot(a, x), low(base_radius), high(top_radius);
  const Polynomial radius = low * n2 + (high - low) * height;
  return roots_of(n2 * (n2 * dot(x, x) - height * height) - radius * radius);
}

LineRoots quadric_roots(const Point& origin, const Point& direction, const Point& centre,
                        const std::array<Point, 3>& square, const Point& linear, double k) {
  return roots_of(quadratic(origin, direction, centre, square, linear, k));
}

long quadric_crossings(const Point& origin, const Point& direction, const Point& centre,
                       const std::array<Point, 3>& square, const Point& linear, double k) {
  return crossings_ahead(quadratic(origin, direction, centre, square, linear, k));
}

std::vector<SurfaceCrossing> bezier_crossings(const Point& origin, const Point& direction,
                                              const std::array<std::array<Point, 4>, 4>& control) {
  using Number = BallAt<kBits>;
  using Whole = std::array<long, 3>;
  const auto whole = [](const Point& p) { return Whole{std::lround(p[0]), std::lround(p[1]), std::lround(p[2])}; };
  const auto cross = [](const Whole& a, const Whole& b) {
    return Whole{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const Whole d = whole(direction), o = whole(origin);
  const Whole first = cross(d, d[0] == 0 && d[1] == 0 ? Whole{1, 0, 0} : Whole{0, 0, 1});
  const auto height = [&](const Whole& normal) {
    std::array<std::array<long, 4>, 4> c{};
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        const Whole p = whole(control[i][j]);
        for (std::size_t k = 0; k < 3; ++k) c[i][j] += normal[k] * (p[k] - o[k]);
      }
    }
    return power_form(c);
  };
  const Bicubic f = height(first), g = height(cross(d, first)), along = height(d);
  const double square = static_cast<double>(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  std::vector<SurfaceCrossing> crossings;
  const auto all_v = shared_zeros(f, g, 1);
  for (const Number& u : shared_zeros(f, g, 0)) {
    for (const Number& v : all_v) {
      const Number at_f = value(f, u, v), at_g = value(g, u, v);
      if (arb_contains_zero(at_f.get()) == 0 || arb_contains_zero(at_g.get()) == 0) continue;
      const Number t = value(along, u, v) / Number(square);
      crossings.push_back({wide(t.get()), u.midpoint(), v.midpoint()});
    }
  }
  std::sort(crossings.begin(), crossings.end(), [](const auto& a, const auto& b) { return a.t.high < b.t.high; });
  return crossings;
}

}  // namespace etendue::oracle
