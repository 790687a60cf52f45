// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace etendue::oracle {

/// Form factor of the rectangle [x0, x1] × [y0, y1] of a hemicube's top, correctly rounded: the outer integral by Arb's
/// rigorous quadrature, the inner one in closed form. Throws where the ball is wider than 2^-70.
double hemicube_top(double x0, double x1, double y0, double y1);

/// The same for [x0, x1] × [z0, z1] of a side.
double hemicube_side(double x0, double x1, double z0, double z1);

}  // namespace etendue::oracle
