// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arb.h>
#include <arf.h>

#include <utility>

namespace etendue::oracle {

/// A real number with a rigorous error bar: Arb's midpoint-radius interval at a fixed, generous precision.
class Ball {
 public:
  static constexpr slong kBits = 600;

  Ball(double value = 0) {  // NOLINT(google-explicit-constructor): doubles are exact balls
    arb_init(ball_);
    arb_set_d(ball_, value);
  }
  Ball(const Ball& other) {
    arb_init(ball_);
    arb_set(ball_, other.ball_);
  }
  Ball(Ball&& other) noexcept {
    arb_init(ball_);
    arb_swap(ball_, other.ball_);
  }
  Ball& operator=(const Ball& other) {
    arb_set(ball_, other.ball_);
    return *this;
  }
  Ball& operator=(Ball&& other) noexcept {
    arb_swap(ball_, other.ball_);
    return *this;
  }
  ~Ball() { arb_clear(ball_); }

  arb_ptr get() { return ball_; }
  arb_srcptr get() const { return ball_; }

  /// The midpoint, rounded to nearest.
  double midpoint() const { return arf_get_d(arb_midref(ball_), ARF_RND_NEAR); }
  bool certainly_positive() const { return arb_is_positive(ball_) != 0; }
  bool certainly_negative() const { return arb_is_negative(ball_) != 0; }

 private:
  arb_t ball_;
};

#define ETENDUE_BALL_BINARY(symbol, function)                 \
  inline Ball operator symbol(const Ball& a, const Ball& b) { \
    Ball r;                                                   \
    function(r.get(), a.get(), b.get(), Ball::kBits);         \
    return r;                                                 \
  }
#define ETENDUE_BALL_UNARY(name, function)   \
  inline Ball name(const Ball& a) {          \
    Ball r;                                  \
    function(r.get(), a.get(), Ball::kBits); \
    return r;                                \
  }

ETENDUE_BALL_BINARY(+, arb_add)
ETENDUE_BALL_BINARY(-, arb_sub)
ETENDUE_BALL_BINARY(*, arb_mul)
ETENDUE_BALL_BINARY(/, arb_div)
ETENDUE_BALL_UNARY(sqrt, arb_sqrt)
ETENDUE_BALL_UNARY(log, arb_log)
ETENDUE_BALL_UNARY(exp, arb_exp)
ETENDUE_BALL_UNARY(atan, arb_atan)
ETENDUE_BALL_UNARY(sin, arb_sin)
ETENDUE_BALL_UNARY(cos, arb_cos)
ETENDUE_BALL_UNARY(sinh, arb_sinh)
ETENDUE_BALL_UNARY(cosh, arb_cosh)
ETENDUE_BALL_UNARY(tanh, arb_tanh)
#undef ETENDUE_BALL_BINARY
#undef ETENDUE_BALL_UNARY

inline Ball operator-(const Ball& a) {
  return Ball(0) - a;
}
inline Ball pi() {
  Ball r;
  arb_const_pi(r.get(), Ball::kBits);
  return r;
}

}  // namespace etendue::oracle
