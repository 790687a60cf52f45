// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "etendue/acceleration/huge_pages.hpp"
#include "etendue/acceleration/surface_list.hpp"

namespace etendue {

/// The groups of BoxTree, eight at a time: boxes in a byte a coordinate, leaves of up to four surfaces, of which
/// triangles stand in single precision as well, side by side.
///
/// Coordinates here are (x − middle) · unit, so that the scene lies in [−1, 1]; `unit` is a power of two. Boxes are rounded
/// outward; corners are rounded.
struct WideTree {
  /// Of these surfaces of the scene.
  WideTree(const Scene& scene, const std::vector<Surface>& all);

  static constexpr std::size_t kWidth = 8;
  static constexpr std::size_t kLeaf = 4;

  /// A coordinate is origin + step · byte; `step` is a power of two.
  struct alignas(32) Node {
    std::array<float, 3> origin, step;
    std::uint32_t first_node, first_leaf;                       ///< of the parts, in their order
    std::array<std::array<std::uint8_t, kWidth>, 3> low, high;  ///< by axis
    std::array<std::uint8_t, kWidth> part;                      ///< see below; 0: none
  };
  static constexpr unsigned kInner = 0x80;      ///< a node: first_node + offset
  static constexpr unsigned kTriangles = 0x40;  ///< a leaf of triangles only
  static constexpr unsigned offset_of(unsigned part) { return part >> 3 & 7U; }
  static constexpr unsigned count_of(unsigned part) { return part & 7U; }  ///< surfaces of a leaf

  /// Corners of the triangles of a leaf, by corner and axis.
  struct alignas(16) Corners {
    std::array<std::array<std::array<float, kLeaf>, 3>, 3> at;
  };

  /// A surface of a leaf, and its triangle, if it is one.
  struct Member {
    Triangle triangle;
    Surface surface;
  };

  HugeVector<Node> nodes;          ///< the root first; empty when nothing is bounded
  HugeVector<Corners> corners;     ///< of each leaf; empty where no leaf is of triangles only
  HugeVector<Member> members;      ///< kLeaf a leaf; what a leaf lacks repeats its last one
  std::vector<Surface> unbounded;  ///< planes
  Aabb box;                        ///< of all that is bounded
  Vec3 middle = Vec3::Zero();
  double unit = 1;
};

/// Of a triangle, or of one of a mesh, that stands still.
[[nodiscard]] std::optional<Triangle> triangle_of(const Scene& scene, const Surface& surface);

}  // namespace etendue
