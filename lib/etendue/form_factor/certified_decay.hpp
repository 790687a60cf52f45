// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/geometry/interval3.hpp"

// How fast the Chebyshev coefficients of a contour's inner integral fall, in intervals: the bounds of edge_decay.hpp, proved.
namespace etendue {

/// Two edges: the outer starts at the origin, the inner at `start`.
struct EnclosedEdges {
  Interval3 outer, inner;
  Interval3 start, end;
  Interval outer_length, inner_length, inner_square;
};
/// Those from a to b and from c to d.
[[nodiscard]] EnclosedEdges enclosed_edges(const Interval3& a, const Interval3& b, const Interval3& c,
                                           const Interval3& d);

/// A piece of the outer edge, whose start is the origin.
struct EnclosedPiece {
  Interval3 from, to;
  Interval length;
};

/// Along a piece of the outer edge the coefficients of ∫_0^1 ln |p − inner(t)| dt + 1 obey |a_k| ≤ (2/k) weight ρ^(−k);
/// `extra` bounds what was changed to make it so.
struct CertifiedDecay {
  double rho = 1;
  double weight = 1;
  double extra = 0;
};

/// From the singularities themselves: the ellipse through the inner edge's point that is nearest to the piece.
///
/// Accuracy  inclusion proved: NOTES.md §2, §10. ρ is never larger than that of the truth
[[nodiscard]] CertifiedDecay certified_plain_decay(const EnclosedEdges& edges, const EnclosedPiece& piece);

/// With the path of integration bent around the ellipse: only the inner edge's ends and the crossing of the two lines
/// count. Lines that are parallel but for rounding are made parallel, which `extra` counts.
///
/// Symbols   above: no ellipse is of use that is not larger than this; at least 1
/// Domain    inner_length.lower > 0
/// Returns   ρ = 1 where no larger one can be shown
/// Accuracy  inclusion proved: NOTES.md §2, §10
[[nodiscard]] CertifiedDecay certified_bent_decay(const EnclosedEdges& edges, const EnclosedPiece& piece,
                                                  double above = 1);

/// Lower bound on the parameter of the Bernstein ellipse with that semi-axis.
[[nodiscard]] double certain_ellipse(const Interval& semi_axis);

}  // namespace etendue
