// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/form_factor/edge_terms.hpp"

namespace etendue {

/// How fast the Chebyshev coefficients of the inner integral fall along an outer edge: |a_k| ≤ (2/k) weight rho^(−k).
struct Decay {
  double rho = 1;
  double weight = 0;
};

/// From the singularities themselves (NOTES.md §2); `inner` seen from the outer edge's ends.
template <class T>
[[nodiscard]] Decay plain_decay(const Edge<T>& outer, const Edge<T>& inner);

/// With the path of integration bent around the ellipse: only the inner edge's ends and the crossing of the two lines
/// count (NOTES.md §2). rho = 1 where the lines are parallel or nearly so.
template <class T>
[[nodiscard]] Decay bent_decay(const Edge<T>& outer, const Edge<T>& inner);

}  // namespace etendue
