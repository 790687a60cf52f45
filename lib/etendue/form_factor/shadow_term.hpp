// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "etendue/geometry/interval3.hpp"

namespace etendue {

/// A function u, v ↦ at + u du + v dv.
struct Affine {
  Interval at, du, dv;

  Interval operator()(const Interval& u, const Interval& v) const { return at + u * du + v * dv; }
};

/// A triangle of source parameters (u, v), counter-clockwise.
struct SourceCell {
  std::array<Vec2, 3> corners;
};

/// Twice the signed area of the parameters a, b, c.
[[nodiscard]] Interval doubled_area(const Vec2& a, const Vec2& b, const Vec2& c);

/// What a function that is linear over a cell can be told to be there; weakly: a rounding's width beyond zero counts
/// as zero.
struct CellSign {
  int sign = 0;        ///< 1, −1, or 0 where it changes inside or cannot be told
  double share = 0;    ///< bound on the share of the cell where the sign is wrong
  bool mixed = false;  ///< it certainly changes
};
[[nodiscard]] CellSign sign_over(const Affine& function, const SourceCell& cell);

/// All values over a cell; tight, since the function is linear.
[[nodiscard]] Interval range_over(const Affine& function, const SourceCell& cell);

/// The source: the triangle of the points corner + u along + v across, u, v ≥ 0, u + v ≤ 1. All else is given
/// relative to that corner.
struct SourceTriangle {
  Interval3 along, across;
  Interval3 normal;  ///< along × across
};

/// What several convex outlines hide together: the part of directions that lies within all of them. As seen from the
/// source each runs counter-clockwise and is convex.
class ShadowTerm {
 public:
  ShadowTerm(const SourceTriangle& source, std::vector<std::vector<Interval3>> loops);

  /// The part's boundary from everywhere in a cell: pieces of the loops' edges, each between two crossings.
  struct Arc {
    std::size_t edge = 0;
    /// The edges that are crossed there as seen from the source: the last of the first and the first of the last
    /// crossings count. Where there is none, the edge's own end.
    std::vector<int> begins, ends;
  };
  struct Topology {
    bool known = false;  ///< every arc has at most one edge at either end, and is certainly there
    bool loose = false;  ///< not known, but for which of several crossings comes first
    std::vector<Arc> arcs;
    std::optional<Affine> cut;  ///< a line across the cell along which to cut it, where that is what is missing
    double share = 0;           ///< bound on the share of the cell where `arcs` is wrong
  };
  Topology topology(const SourceCell& cell) const;

  /// Lambert's sum times the source's doubled area, from the point (u, v).
  Interval flux_density(const std::vector<Arc>& arcs, const Interval& u, const Interval& v) const;

  /// Encloses flux_density from all of a cell for arcs that are known or loose.
  Interval flux_density_over(const std::vector<Arc>& arcs, const SourceCell& cell) const;

  /// Upper bound on |flux_density| over the Bernstein ellipse `rho` of one variable of the cell's points
  /// A + r (B − A + s (C − B)), r and s in [0, 1], the other real; infinite where none is found. NOTES.md §11.
  enum class Variable { r, s };
  double largest(const std::vector<Arc>& arcs, const SourceCell& cell, Variable variable, double rho) const;

  /// Bound on what leaving out corners next to others does to the flux: the area swept.
  double slack() const { return slack_; }
  /// Does some corner lie on another outline's edge but for rounding, not exactly? All here then is as if it did, which is
  /// no enclosure.
  bool touching() const { return touching_; }

 private:
  struct Edge {
    std::size_t loop, begin, end;
  };
  struct Bounds {
    std::vector<int> lower, upper;
    bool empty = false;
  };
  const Affine& height(std::size_t edge, std::size_t vertex) const {
    return heights_[edge * vertices_.size() + vertex];
  }
  bool on_line(std::size_t edge, std::size_t vertex) const { return on_line_[edge * vertices_.size() + vertex]; }
  std::optional<Interval> fixed_crossing(std::size_t edge, std::size_t other) const;
  Interval crossing(std::size_t edge, int other, const Interval& u, const Interval& v) const;
  Interval crossing_over(std::size_t edge, int other, const SourceCell& cell) const;
  Interval arc_density(const Arc& arc, const Interval3& x, const Interval& from, const Interval& to,
                       bool signed_length) const;
  std::optional<Bounds> clip(std::size_t edge, const SourceCell& cell, Topology& result) const;
  int compare(std::size_t edge, int first, int second, const SourceCell& cell, Topology& result) const;
  int order_in_middle(std::size_t edge, int first, int second, const SourceCell& cell) const;
  Affine meeting_height(std::size_t edge, const Edge& first, const Edge& second) const;
  int shared_vertex(int first, int second) const;

  SourceTriangle source_;
  std::vector<Interval3> vertices_;
  std::vector<std::size_t> loop_of_;
  std::vector<Edge> edges_;
  std::vector<Affine> heights_;
  std::vector<bool> on_line_;
  double slack_ = 0;
  bool touching_ = false;
};

}  // namespace etendue
