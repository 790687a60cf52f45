// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arb.h>
#include <arf.h>

#include <cmath>
#include <utility>

namespace etendue::oracle {

/// A real number with a rigorous error bar: Arb's midpoint-radius interval at a fixed precision.
template <slong Bits>
class BallAt {
 public:
  static constexpr slong kBits = Bits;

  BallAt(double value = 0) {  // NOLINT(google-explicit-constructor): doubles are exact balls
    arb_init(ball_);
    arb_set_d(ball_, value);
  }
  BallAt(const BallAt& other) {
    arb_init(ball_);
    arb_set(ball_, other.ball_);
  }
  BallAt(BallAt&& other) noexcept {
    arb_init(ball_);
    arb_swap(ball_, other.ball_);
  }
  /// From another precision, rounded.
  template <slong Other>
  explicit BallAt(const BallAt<Other>& other) {
    arb_init(ball_);
    arb_set_round(ball_, other.get(), Bits);
  }
  BallAt& operator=(const BallAt& other) {
    arb_set(ball_, other.ball_);
    return *this;
  }
  BallAt& operator=(BallAt&& other) noexcept {
    arb_swap(ball_, other.ball_);
    return *this;
  }
  ~BallAt() { arb_clear(ball_); }

  arb_ptr get() { return ball_; }
  arb_srcptr get() const { return ball_; }

  /// The midpoint, rounded to nearest.
  double midpoint() const { return arf_get_d(arb_midref(ball_), ARF_RND_NEAR); }
  /// An upper bound of the radius.
  double radius() const { return mag_get_d(arb_radref(ball_)); }
  bool certainly_positive() const { return arb_is_positive(ball_) != 0; }
  bool certainly_negative() const { return arb_is_negative(ball_) != 0; }
  bool exactly_zero() const { return arb_is_zero(ball_) != 0; }

#define ETENDUE_BALL_BINARY(symbol, function)                       \
  friend BallAt operator symbol(const BallAt& a, const BallAt& b) { \
    BallAt r;                                                       \
    function(r.get(), a.get(), b.get(), Bits);                      \
    return r;                                                       \
  }
#define ETENDUE_BALL_UNARY(name, function) \
  friend BallAt name(const BallAt& a) {    \
    BallAt r;                              \
    function(r.get(), a.get(), Bits);      \
    return r;                              \
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

  friend BallAt operator-(const BallAt& a) {
    return BallAt(0) - a;
  }
  friend BallAt atan2(const BallAt& y, const BallAt& x) {
    BallAt r;
    arb_atan2(r.get(), y.get(), x.get(), Bits);
    return r;
  }

 private:
  arb_t ball_;
};

/// The generous precision of the oracles.
using Ball = BallAt<600>;

inline Ball pi() {
  Ball r;
  arb_const_pi(r.get(), Ball::kBits);
  return r;
}

/// A ball as two doubles and what they are off: |high + low − x| ≤ radius.
struct TwoDoubles {
  double high, low, radius;
};
template <slong Bits>
TwoDoubles two_doubles(const BallAt<Bits>& x) {
  const double high = x.midpoint();
  const BallAt<Bits> rest = x - BallAt<Bits>(high);
  const double low = rest.midpoint();
  return {high, low, rest.radius() + 0x1p-53 * std::abs(low)};
}

}  // namespace etendue::oracle
