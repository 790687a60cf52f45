// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace etendue::oracle {

/// Form factor between aligned, equal, parallel rectangles with sides x·distance and y·distance, correctly rounded up
/// to one unit in the last place: Howell's C-11 in ball arithmetic of 600 bits.
double parallel_plates(double x, double y);

}  // namespace etendue::oracle
