// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace etendue::oracle {

/// Form factor between aligned, equal, parallel rectangles with sides x·distance and y·distance, correctly rounded up
/// to one unit in the last place: Howell's C-11 in ball arithmetic of 600 bits.
double parallel_plates(double x, double y);

/// Form factor from a rectangle of width w to one of height h at a right angle to it, their common edge of length one:
/// Howell's C-14 in the same arithmetic.
double perpendicular_plates(double h, double w);

}  // namespace etendue::oracle
