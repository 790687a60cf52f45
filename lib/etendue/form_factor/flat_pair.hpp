// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/form_factor/edge_terms.hpp"

namespace etendue {

/// Two edges as in one plane, or along one line: the outer one from the origin along the real axis.
template <class T>
struct FlatPair {
  Corner<T> start, end;  ///< of the inner edge, laid into the plane; y has either sign
  double lift = 0;       ///< what edges along one line, but hairs apart, add to ∬ ln r
  double deviation = 0;  ///< bound on |∬ ln r − that of the plane − lift|: NOTES.md §3
};

/// Of the planes through the outer edge's line, and that line itself, the one with the least deviation.
/// `largest` bounds ∫ |ln r| over the inner edge from any point of the outer one.
template <class T>
[[nodiscard]] FlatPair<T> flat_pair(const Edge<T>& outer, const Edge<T>& inner, double largest);

}  // namespace etendue
