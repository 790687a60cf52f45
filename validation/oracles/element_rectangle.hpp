// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace etendue::oracle {

/// Factor from an element to a parallel rectangle a × b at distance one whose corner lies on the element's normal
/// (B-4), at 600 bits.
double element_to_corner_rectangle(double a, double b);

}  // namespace etendue::oracle
