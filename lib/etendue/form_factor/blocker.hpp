// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "etendue/geometry/polygon.hpp"

namespace etendue {

/// Which sides of a plate stop light. A plate that is open at the back stops what arrives at its front only: what it
/// hides from one polygon it does not hide from the other, and reciprocity is lost.
enum class BlockingSides { both, front };

/// What stands in the way of light: a flat plate, or a convex solid, whose shadow is one convex cone from every point
/// outside instead of the union of its faces' shadows.
class Blocker {
 public:
  /// A face of a solid, or a convex part of a plate; counter-clockwise as seen from the front.
  struct Face {
    std::vector<std::size_t> corners;  ///< into points()
    Vec3 normal;                       ///< unit
  };
  /// Between two faces of a solid: runs from `start` to `end` around `left`, the other way around `right`.
  struct Edge {
    std::size_t start, end, left, right;
  };

  /// Any simple polygon; a concave one is cut into triangles.
  static Blocker plate(const Polygon& polygon, BlockingSides sides = BlockingSides::both);

  /// The solid whose faces, seen from outside, are `faces`; nothing where they do not close (corners shared to the last
  /// bit, each edge by two of them) or do not bound a convex solid.
  static std::optional<Blocker> solid(std::span<const Polygon> faces);

  const std::vector<Vec3>& points() const { return points_; }
  const std::vector<Face>& faces() const { return faces_; }
  const std::vector<Edge>& edges() const { return edges_; }  ///< empty for a plate
  bool is_solid() const { return !edges_.empty(); }
  BlockingSides sides() const { return sides_; }

 private:
  Blocker() = default;
  std::vector<Vec3> points_;
  std::vector<Face> faces_;
  std::vector<Edge> edges_;
  BlockingSides sides_ = BlockingSides::both;
};

/// The triangles (indices into `corners`) of a simple polygon that runs counter-clockwise around `normal`; the polygon
/// itself, as one piece, where it is convex.
[[nodiscard]] std::vector<std::vector<std::size_t>> convex_pieces(std::span<const Vec3> corners, const Vec3& normal);

}  // namespace etendue
