// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/form_factor/catalogue/counted.hpp"

namespace etendue::catalogue {

// Howell's C-41, on which discs, cylinders and cones rest.

/// F_12/r2², symmetric in the radii: 2/(r1² + r2² + h² + S), S² = ((r1−r2)²+h²)((r1+r2)²+h²). h may be zero.
inline Counted per_areas(const Counted& r1, const Counted& r2, const Counted& h) {
  return 2 / (square(r1) + square(r2) + square(h) + hypot(r1 - r2, h) * hypot(r1 + r2, h));
}

/// From a disc of radius r1 to a coaxial one of radius r2 at the distance h.
inline Counted disc_to_disc(const Counted& r1, const Counted& r2, const Counted& h) {
  return square(r2) * per_areas(r1, r2, h);
}

/// The same times the first area.
inline Counted disc_exchange(const Counted& r1, const Counted& r2, const Counted& h) {
  return pi() * square(r1 * r2) * per_areas(r1, r2, h);
}

}  // namespace etendue::catalogue
