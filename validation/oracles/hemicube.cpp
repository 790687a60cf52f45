// SPDX-License-Identifier: Apache-2.0
#include "oracles/hemicube.hpp"

#include <acb.h>
#include <acb_calc.h>
#include <arb.h>

#include <stdexcept>

namespace etendue::oracle {

namespace {

constexpr slong kBits = 128;
constexpr slong kGoalBits = 90;  // asked of the quadrature, absolute
constexpr slong kWidestBall = -70;

struct Heights {
  arb_t low;
  arb_t high;
};

class Complex {
 public:
  Complex() { acb_init(value); }
  Complex(const Complex&) = delete;
  Complex& operator=(const Complex&) = delete;
  ~Complex() { acb_clear(value); }
  acb_t value;
};

/// w ↦ atan(w), refused where the ball could touch the branch cuts beyond ±i.
void analytic_atan(acb_t result, const acb_t w, bool analytic) {
  mag_t size;
  mag_init(size);
  arb_get_mag(size, acb_imagref(w));
  if (analytic && mag_cmp_2exp_si(size, 0) >= 0) {
    acb_indeterminate(result);
  } else {
    acb_atan(result, w, kBits);
  }
  mag_clear(size);
}

/// ∫_0^y dy'/(s² + y'²)² = y/(2 s² (s² + y²)) + atan(y/s)/(2 s³) with s² = 1 + x²
void inner_top(acb_t result, const acb_t x, const arb_t y, bool analytic) {
  Complex s2, s, denominator, first, second;
  acb_mul(s2.value, x, x, kBits);
  acb_add_ui(s2.value, s2.value, 1, kBits);
  acb_sqrt_analytic(s.value, s2.value, analytic, kBits);
  acb_set_arb(denominator.value, y);
  acb_mul(denominator.value, denominator.value, denominator.value, kBits);
  acb_add(denominator.value, denominator.value, s2.value, kBits);
  acb_mul(denominator.value, denominator.value, s2.value, kBits);
  acb_set_arb(first.value, y);
  acb_div(first.value, first.value, denominator.value, kBits);
  acb_set_arb(second.value, y);
  acb_div(second.value, second.value, s.value, kBits);
  analytic_atan(second.value, second.value, analytic);
  acb_div(second.value, second.value, s2.value, kBits);
  acb_div(second.value, second.value, s.value, kBits);
  acb_add(result, first.value, second.value, kBits);
  acb_mul_2exp_si(result, result, -1);
}

int top_integrand(acb_ptr result, const acb_t x, void* parameter, slong order, slong) {
  const auto* heights = static_cast<const Heights*>(parameter);
  Complex low;
  inner_top(result, x, heights->high, order != 0);
  inner_top(low.value, x, heights->low, order != 0);
  acb_sub(result, result, low.value, kBits);
  return 0;
}

/// ∫_z0^z1 z dz/(1 + x² + z²)² = ½ [1/(1 + x² + z0²) − 1/(1 + x² + z1²)]
void inner_side(acb_t result, const acb_t x, const arb_t z) {
  Complex z2;
  acb_set_arb(z2.value, z);
  acb_mul(z2.value, z2.value, z2.value, kBits);
  acb_mul(result, x, x, kBits);
  acb_add(result, result, z2.value, kBits);
  acb_add_ui(result, result, 1, kBits);
  acb_inv(result, result, kBits);
  acb_mul_2exp_si(result, result, -1);
}

int side_integrand(acb_ptr result, const acb_t x, void* parameter, slong, slong) {
  const auto* heights = static_cast<const Heights*>(parameter);
  Complex high;
  inner_side(result, x, heights->low);
  inner_side(high.value, x, heights->high);
  acb_sub(result, result, high.value, kBits);
  return 0;
}

double integrate(acb_calc_func_t integrand, double x0, double x1, double y0, double y1) {
  Heights heights;
  arb_init(heights.low);
  arb_init(heights.high);
  arb_set_d(heights.low, y0);
  arb_set_d(heights.high, y1);
  Complex from, to, integral;
  acb_set_d(from.value, x0);
  acb_set_d(to.value, x1);
  mag_t tolerance;
  mag_init(tolerance);
  mag_set_ui_2exp_si(tolerance, 1, -kGoalBits);
  acb_calc_integrate(integral.value, integrand, &heights, from.value, to.value, kGoalBits, tolerance, nullptr, kBits);
  arb_t pi;
  arb_init(pi);
  arb_const_pi(pi, kBits);
  arb_div(acb_realref(integral.value), acb_realref(integral.value), pi, kBits);
  const bool narrow = mag_cmp_2exp_si(arb_radref(acb_realref(integral.value)), kWidestBall) < 0;
  const double value = arf_get_d(arb_midref(acb_realref(integral.value)), ARF_RND_NEAR);
  arb_clear(pi);
  mag_clear(tolerance);
  arb_clear(heights.low);
  arb_clear(heights.high);
  if (!narrow) throw std::runtime_error("hemicube oracle: the ball is too wide");
  return value;
}

}  // namespace

double hemicube_top(double x0, double x1, double y0, double y1) {
  return integrate(top_integrand, x0, x1, y0, y1);
}

double hemicube_side(double x0, double x1, double z0, double z1) {
  return integrate(side_integrand, x0, x1, z0, z1);
}

}  // namespace etendue::oracle
