// SPDX-License-Identifier: Apache-2.0
#include "oracles/parallel_plates.hpp"

#include <arb.h>
#include <arf.h>

namespace etendue::oracle {

namespace {

constexpr slong kBits = 600;  // C-11 cancels to x²y² of terms of order one: 1e-4 loses 54 bits, 1e-12 would lose 160

class Ball {
 public:
  explicit Ball(double value = 0) { arb_init(ball_); arb_set_d(ball_, value); }
  Ball(const Ball& other) { arb_init(ball_); arb_set(ball_, other.ball_); }
  Ball& operator=(const Ball& other) { arb_set(ball_, other.ball_); return *this; }
  ~Ball() { arb_clear(ball_); }
  arb_ptr get() { return ball_; }
  arb_srcptr get() const { return ball_; }

 private:
  arb_t ball_;
};

Ball operator+(const Ball& a, const Ball& b) { Ball r; arb_add(r.get(), a.get(), b.get(), kBits); return r; }
Ball operator-(const Ball& a, const Ball& b) { Ball r; arb_sub(r.get(), a.get(), b.get(), kBits); return r; }
Ball operator*(const Ball& a, const Ball& b) { Ball r; arb_mul(r.get(), a.get(), b.get(), kBits); return r; }
Ball operator/(const Ball& a, const Ball& b) { Ball r; arb_div(r.get(), a.get(), b.get(), kBits); return r; }
Ball sqrt(const Ball& a) { Ball r; arb_sqrt(r.get(), a.get(), kBits); return r; }
Ball log(const Ball& a) { Ball r; arb_log(r.get(), a.get(), kBits); return r; }
Ball atan(const Ball& a) { Ball r; arb_atan(r.get(), a.get(), kBits); return r; }
Ball pi() { Ball r; arb_const_pi(r.get(), kBits); return r; }

}  // namespace

double parallel_plates(double x, double y) {
  const Ball X(x), Y(y), one(1), two(2);
  const Ball X2 = X * X, Y2 = Y * Y;
  const Ball sx = sqrt(one + X2), sy = sqrt(one + Y2);
  const Ball sum = log((one + X2) * (one + Y2) / (one + X2 + Y2)) / two + X * sy * atan(X / sy) + Y * sx * atan(Y / sx) -
                   X * atan(X) - Y * atan(Y);
  const Ball factor = two / (pi() * X * Y) * sum;
  return arf_get_d(arb_midref(factor.get()), ARF_RND_NEAR);
}

}  // namespace etendue::oracle
