// SPDX-License-Identifier: Apache-2.0
#include "oracles/parallel_plates.hpp"

#include "oracles/ball.hpp"

namespace etendue::oracle {

// Both cancel to x²y² of terms of order one: ratios of 1e-4 lose 54 of the 600 bits.
double parallel_plates(double x, double y) {
  const Ball X(x), Y(y), one(1), two(2);
  const Ball X2 = X * X, Y2 = Y * Y;
  const Ball sx = sqrt(one + X2), sy = sqrt(one + Y2);
  const Ball sum = log((one + X2) * (one + Y2) / (one + X2 + Y2)) / two + X * sy * atan(X / sy) +
                   Y * sx * atan(Y / sx) - X * atan(X) - Y * atan(Y);
  return (two / (pi() * X * Y) * sum).midpoint();
}

double perpendicular_plates(double h, double w) {
  const Ball H(h), W(w), one(1);
  const Ball H2 = H * H, W2 = W * W, both = H2 + W2, all = one + both;
  const Ball root = sqrt(both);
  const Ball logs = log((one + W2) * (one + H2) / all) + W2 * log(W2 * all / ((one + W2) * both)) +
                    H2 * log(H2 * all / ((one + H2) * both));
  const Ball sum = W * atan(one / W) + H * atan(one / H) - root * atan(one / root) + logs / Ball(4);
  return (sum / (pi() * W)).midpoint();
}

}  // namespace etendue::oracle
