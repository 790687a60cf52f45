// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "etendue/core/result.hpp"
#include "etendue/meshing/elements.hpp"

namespace etendue {

/// Level of an element that is no cell of a grid: a is its index in AdaptiveMesh::pieces, b how often it was halved.
inline constexpr int kPiece = -1;

/// An element of a subdivided face: the quadrilateral s in [a, a+1]/(columns·2^level), t in [b, b+1]/(rows·2^level).
struct MeshCell {
  std::size_t face = 0;   ///< index into ElementMesh::faces
  std::size_t patch = 0;  ///< it is a part of this one
  int level = 0;          ///< how often it was halved, or kPiece
  std::int64_t a = 0, b = 0;

  std::int64_t halvings() const { return level == kPiece ? b : level; }
};
inline bool operator==(const MeshCell& x, const MeshCell& y) {
  return x.face == y.face && x.patch == y.patch && x.level == y.level && x.a == y.a && x.b == y.b;
}

/// Halved at most so often: parameters stay far from the resolution of double.
inline constexpr int kDeepestCell = 16;

/// Faces divided into cells of different sizes: a quadtree on each cell of the objects' subdivision.  @eq IU.6.7.2
struct AdaptiveMesh {
  /// How a face was divided to begin with.
  struct Grid {
    int columns = 1, rows = 1;
    bool divisible = false;
    double grading = 0;  ///< Subdivision::grading
  };
  std::vector<Face> faces;
  std::vector<Grid> grids;      ///< one a face
  std::vector<MeshCell> cells;  ///< those of a patch follow one another
  std::size_t patches = 0;
  std::vector<Polygon> pieces = {};    ///< elements that are no cells, in the order of their cells: convex
  std::vector<Contact> contacts = {};  ///< as of the ElementMesh
};

/// The cells of mesh_elements(), in its order.
///
/// Contract  `mesh` was made of `scene` by mesh_elements()
[[nodiscard]] AdaptiveMesh adaptive_mesh(const Scene& scene, const ElementMesh& mesh);
/// Quadrilaterals of a single element divided into 2 × 2, unless they emit: without neighbours there is no gradient.
[[nodiscard]] AdaptiveMesh with_halved_singles(const Scene& scene, const AdaptiveMesh& mesh);

/// The elements: cell k is element k. Neighbouring cells share their corners to the last bit, whatever their levels.
///
/// Errors    a cell whose corners round to a line
[[nodiscard]] Result<ElementMesh> elements_of(const AdaptiveMesh& mesh);

/// Quarters the cells that are named, in place, and then larger neighbours on the same face until levels differ by one at
/// most (a restricted quadtree: Baum and others 1991). What cannot be divided, or is kDeepestCell deep, stays. Pieces are cut
/// through their centroids, along the first edge of their face and across it, whatever their neighbours' levels; what is too
/// narrow for that counts as halved all the same.
///
/// Returns   the mesh, and of each of its cells the cell it was cut from
struct SplitMesh {
  AdaptiveMesh mesh;
  std::vector<std::size_t> parents;
};
[[nodiscard]] SplitMesh split(const AdaptiveMesh& mesh, std::vector<bool> which);

/// Pairs of cells of a face that share more than a point of their sides, each pair once, first < second. Pieces on the two sides
/// of a contact are none: light may change abruptly there, whatever their size.
struct Neighbours {
  std::size_t first, second;
};
[[nodiscard]] std::vector<Neighbours> neighbours(const AdaptiveMesh& mesh);

}  // namespace etendue
