// SPDX-License-Identifier: Apache-2.0
#include "oracles/element_rectangle.hpp"

#include "oracles/ball.hpp"

namespace etendue::oracle {

double element_to_corner_rectangle(double a, double b) {
  const Ball A(a), B(b), one(1), two(2);
  const Ball sa = sqrt(one + A * A), sb = sqrt(one + B * B);
  return ((A / sa * atan(B / sa) + B / sb * atan(A / sb)) / (two * pi())).midpoint();
}

}  // namespace etendue::oracle
