// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/form_factor/catalogue/counted.hpp"

namespace etendue::catalogue {

// Closed forms that entries of the catalogue share with elements in general position (point_round.hpp).

/// √(z² − 4 l² r²) for z = l² + h² + r², as a product of two distances: from the element to the disc's near and far end.
[[nodiscard]] Counted near_by_far(const Counted& l, const Counted& h, const Counted& r);

/// Element at the lateral distance l from the axis and h before the plane of a disc of radius r: the part of Lambert's
/// vector across the disc, and that towards the axis, divided by l.
[[nodiscard]] Counted facing_disc(const Counted& l, const Counted& h, const Counted& r);
[[nodiscard]] Counted beside_disc(const Counted& l, const Counted& h, const Counted& r);

/// Element whose sphere is `h` radii above its plane and `l` aside, cut by the horizon where |h| < 1; h > −1.
[[nodiscard]] Counted cut_sphere(const Counted& h, const Counted& l);

}  // namespace etendue::catalogue
