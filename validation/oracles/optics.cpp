// SPDX-License-Identifier: Apache-2.0
#include "oracles/optics.hpp"

#include <arb.h>
#include <arf.h>

#include <stdexcept>

namespace etendue::oracle {

namespace {

constexpr slong kBits = 600;  // one ulp beside the critical angle costs 53, a millionth of an ulp 80: ample

class Ball {
 public:
  explicit Ball(double value = 0) {
    arb_init(ball_);
    arb_set_d(ball_, value);
  }
  Ball(const Ball& other) {
    arb_init(ball_);
    arb_set(ball_, other.ball_);
  }
  Ball& operator=(const Ball& other) {
    arb_set(ball_, other.ball_);
    return *this;
  }
  ~Ball() { arb_clear(ball_); }
  arb_ptr get() { return ball_; }
  arb_srcptr get() const { return ball_; }
  bool positive() const { return arb_is_positive(ball_) != 0; }
  bool negative() const { return arb_is_negative(ball_) != 0; }

 private:
  arb_t ball_;
};

template <class Operation>
Ball apply(Operation operation, const Ball& a, const Ball& b, slong bits) {
  Ball result;
  operation(result.get(), a.get(), b.get(), bits);
  return result;
}
template <class Operation>
Ball apply(Operation operation, const Ball& a) {
  Ball result;
  operation(result.get(), a.get(), kBits);
  return result;
}
Ball operator+(const Ball& a, const Ball& b) {
  return apply(arb_add, a, b, kBits);
}
Ball operator-(const Ball& a, const Ball& b) {
  return apply(arb_sub, a, b, kBits);
}
Ball operator*(const Ball& a, const Ball& b) {
  return apply(arb_mul, a, b, kBits);
}
Ball operator/(const Ball& a, const Ball& b) {
  return apply(arb_div, a, b, kBits);
}
Ball sqrt(const Ball& a) {
  return apply(arb_sqrtpos, a);
}
Ball square(const Ball& a) {
  return a * a;
}
Ball abs(const Ball& a) {
  Ball result;
  arb_abs(result.get(), a.get());
  return result;
}

double upper(const Ball& a) {
  arf_t bound;
  arf_init(bound);
  arb_get_ubound_arf(bound, a.get(), kBits);
  const double value = arf_get_d(bound, ARF_RND_UP);
  arf_clear(bound);
  return value;
}

using Vector = std::array<Ball, 3>;

Vector balls(const Triple& v) {
  return {Ball(v[0]), Ball(v[1]), Ball(v[2])};
}
Ball dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector scaled(const Vector& v, const Ball& s) {
  return {v[0] * s, v[1] * s, v[2] * s};
}
Vector minus(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vector unit(const Triple& v) {
  return scaled(balls(v), Ball(1) / sqrt(dot(balls(v), balls(v))));
}
Vector negated(const Vector& v) {
  return scaled(v, Ball(-1));
}
double distance(const Vector& a, const Vector& b) {
  const Vector d = minus(a, b);
  return upper(sqrt(dot(d, d)));
}

// Sums and products of doubles without any rounding: their values are dyadic, and the mantissas may grow.
Ball exact_product(const Ball& a, const Ball& b) {
  return apply(arb_mul, a, b, ARF_PREC_EXACT);
}
Ball exact_dot(const Triple& a, const Triple& b) {
  Ball sum(0);
  for (std::size_t i = 0; i < 3; ++i) sum = apply(arb_add, sum, exact_product(Ball(a[i]), Ball(b[i])), ARF_PREC_EXACT);
  return sum;
}
Ball exact_lengths(const Triple& a, const Triple& b) {
  return exact_product(exact_dot(a, a), exact_dot(b, b));
}

// (1 − η² sin²θ) |δ|²|s|², exactly.
Ball exact_radicand(const Triple& direction, const Triple& normal, double eta) {
  const Ball lengths = exact_lengths(direction, normal);
  const Ball dot = exact_dot(direction, normal);
  const Ball sine = apply(arb_sub, lengths, exact_product(dot, dot), ARF_PREC_EXACT);
  const Ball eta_squared = exact_product(Ball(eta), Ball(eta));
  return apply(arb_sub, lengths, exact_product(eta_squared, sine), ARF_PREC_EXACT);
}

Ball refracted_cosine(const Triple& direction, const Triple& normal, double eta) {
  const Ball radicand = exact_radicand(direction, normal, eta);
  if (radicand.negative()) throw std::domain_error("oracle: total internal reflection has no refracted ray");
  return sqrt(radicand / exact_lengths(direction, normal));
}

Vector reflection(const Vector& towards, const Vector& normal) {
  return minus(scaled(normal, Ball(2) * dot(normal, towards)), towards);
}

}  // namespace

double distance_to_reflection(const Triple& direction, const Triple& normal, const Triple& candidate) {
  return distance(balls(candidate), reflection(negated(unit(direction)), unit(normal)));
}

int sign_of_radicand(const Triple& direction, const Triple& normal, double eta) {
  const Ball radicand = exact_radicand(direction, normal, eta);
  return radicand.positive() ? 1 : radicand.negative() ? -1 : 0;
}

double distance_to_refracted_cosine(const Triple& direction, const Triple& normal, double eta, double candidate) {
  return upper(abs(Ball(candidate) - refracted_cosine(direction, normal, eta)));
}

double distance_to_refraction(const Triple& direction, const Triple& normal, double eta, const Triple& candidate) {
  const Vector towards = negated(unit(direction));
  const bool outward = !exact_dot(direction, normal).positive();
  const Vector facing = outward ? unit(normal) : negated(unit(normal));
  const Vector sine = minus(scaled(facing, dot(facing, towards)), towards);
  const Vector refracted = minus(scaled(sine, Ball(eta)), scaled(facing, refracted_cosine(direction, normal, eta)));
  return distance(balls(candidate), refracted);
}

double relative_distance_to_fresnel(double cosine, double eta, double candidate) {
  const Ball theta = apply(arb_acos, Ball(cosine));
  const Ball sine = Ball(eta) * apply(arb_sin, theta);
  if ((sine - Ball(1)).positive()) return upper(abs(Ball(candidate) - Ball(1)));
  Ball factor;
  if (cosine == 1) {
    factor = square((Ball(eta) - Ball(1)) / (Ball(eta) + Ball(1)));
  } else if (cosine == 0) {
    factor = Ball(1);
  } else {
    const Ball phi = apply(arb_asin, sine);
    factor = square(apply(arb_sin, phi - theta) / apply(arb_sin, phi + theta)) +
             square(apply(arb_tan, phi - theta) / apply(arb_tan, phi + theta));
    factor = factor / Ball(2);
  }
  return upper(abs(Ball(candidate) / factor - Ball(1)));
}

double fresnel_transmittance(double cosine, double eta) {
  const Ball c(cosine), n(eta);
  const Ball behind = sqrt(Ball(1) - square(n) * (Ball(1) - square(c)));
  const Ball t_s = Ball(2) * n * c / (n * c + behind);
  const Ball t_p = Ball(2) * n * c / (c + n * behind);
  return upper(behind / (n * c) * (square(t_s) + square(t_p)) / Ball(2));
}

double distance_to_phong(const Triple& normal, const Triple& to_light, const Triple& to_viewer, double exponent,
                         double candidate) {
  Ball truth(0);
  if (exact_dot(normal, to_light).positive()) {
    const Ball cosine = dot(reflection(unit(to_light), unit(normal)), balls(to_viewer));
    if (!(Ball(1) - cosine).positive()) {
      truth = Ball(1);
    } else if (cosine.positive()) {
      truth = apply(arb_pow, cosine, Ball(exponent), kBits);
    }
  }
  return upper(abs(Ball(candidate) - truth));
}

double distance_to_lambert(const Triple& normal, const Triple& to_light, double candidate) {
  const Ball cosine = exact_dot(normal, to_light);
  return upper(abs(Ball(candidate) - (cosine.positive() ? cosine : Ball(0))));
}

}  // namespace etendue::oracle
