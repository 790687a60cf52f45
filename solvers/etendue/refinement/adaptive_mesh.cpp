// SPDX-License-Identifier: Apache-2.0
#include "etendue/refinement/adaptive_mesh.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

#include "etendue/meshing/contacts.hpp"
#include "etendue/meshing/division.hpp"
#include "etendue/meshing/grading.hpp"

namespace etendue {

namespace {

/// Finds cells by their place.
class Directory {
 public:
  explicit Directory(const AdaptiveMesh& mesh) : mesh_(mesh) {
    for (std::size_t k = 0; k < mesh.cells.size(); ++k) {
      const MeshCell& cell = mesh.cells[k];
      cells_[{cell.face, cell.level, cell.a, cell.b}] = k;
      deepest_ = std::max(deepest_, cell.level);
    }
  }

  /// The cell of this size or larger that covers a place; none: it is covered by smaller ones, or off the face.
  const std::size_t* covering(std::size_t face, int level, std::int64_t a, std::int64_t b) const {
    for (; level >= 0; --level, a >>= 1, b >>= 1) {
      const auto found = cells_.find({face, level, a, b});
      if (found != cells_.end()) return &found->second;
    }
    return nullptr;
  }

  /// All cells beyond a side of a cell: dx, dy is the direction.
  std::vector<std::size_t> beyond(std::size_t k, int dx, int dy) const {
    const MeshCell& cell = mesh_.cells[k];
    const AdaptiveMesh::Grid& grid = mesh_.grids[cell.face];
    std::vector<std::size_t> found;
    const std::int64_t a = cell.a + dx, b = cell.b + dy;
    if (cell.level == kPiece) return found;
    if (a < 0 || b < 0 || a >= std::int64_t{grid.columns} << cell.level || b >= std::int64_t{grid.rows} << cell.level) {
      return found;
    }
    add(found, cell.face, cell.level, a, b, dx, dy);
    return found;
  }

 private:
  /// Adds what covers a place, as far as it touches the side it is looked at from.
  void add(std::vector<std::size_t>& found, std::size_t face, int level, std::int64_t a, std::int64_t b, int dx,
           int dy) const {
    if (const std::size_t* larger = covering(face, level, a, b)) {
      found.push_back(*larger);
      return;
    }
    if (level >= deepest_) return;  // nothing there
    for (std::int64_t part = 0; part < 2; ++part) {
      const std::int64_t x = dx != 0 ? 2 * a + (dx > 0 ? 0 : 1) : 2 * a + part;
      const std::int64_t y = dy != 0 ? 2 * b + (dy > 0 ? 0 : 1) : 2 * b + part;
      add(found, face, level + 1, x, y, dx, dy);
    }
  }

  const AdaptiveMesh& mesh_;
  std::map<std::tuple<std::size_t, int, std::int64_t, std::int64_t>, std::size_t> cells_;
  int deepest_ = 0;
};

constexpr std::array<std::pair<int, int>, 4> kSides{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

bool can_split(const AdaptiveMesh& mesh, const MeshCell& cell) {
  return (mesh.grids[cell.face].divisible || cell.level == kPiece) && cell.halvings() < kDeepestCell;
}

/// Also names the larger neighbours of what is to be split, until none is left.
void keep_balanced(const AdaptiveMesh& mesh, std::vector<bool>& which) {
  const Directory directory(mesh);
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < which.size(); ++k) {
    which[k] = which[k] && can_split(mesh, mesh.cells[k]);
    if (which[k]) open.push_back(k);
  }
  while (!open.empty()) {
    const std::size_t k = open.back();
    open.pop_back();
    for (const auto& [dx, dy] : kSides) {
      for (const std::size_t other : directory.beyond(k, dx, dy)) {
        if (mesh.cells[other].level >= mesh.cells[k].level || which[other]) continue;
        which[other] = true;
        open.push_back(other);
      }
    }
  }
}

// A corner of the grid: the same expression for all cells that meet there. s is a quotient of whole numbers, so that
// halving changes no bit of it; the rest is as in mesh_elements().
Vec3 corner(const std::vector<Vec3>& v, const AdaptiveMesh::Grid& grid, int level, std::int64_t a, std::int64_t b) {
  const double s = division_line(a, std::int64_t{grid.columns} << level, grid.grading);
  const double t = division_line(b, std::int64_t{grid.rows} << level, grid.grading);
  return (1 - t) * ((1 - s) * v[0] + s * v[1]) + t * ((1 - s) * v[3] + s * v[2]);
}

/// A piece cut through its centroid, along its face's first edge and across it.
std::vector<CutPiece> quarters(const Polygon& piece, const Polygon& face, double touching) {
  const Vec3 along = (face.vertices()[1] - face.vertices()[0]).normalized(), across = face.normal().cross(along);
  double reach = 0;
  for (const Vec3& v : piece.vertices()) reach = std::max(reach, (v - piece.centroid()).norm());
  const auto through = [&](const Vec3& way) {
    return Segment{piece.centroid() - 2 * reach * way, piece.centroid() + 2 * reach * way};
  };
  const std::array<Segment, 2> lines{through(along), through(across)};
  return cut_along({&piece, 1}, face.normal(), lines, touching);
}

double touching_of(const AdaptiveMesh& mesh) {
  ElementMesh faces;
  faces.faces = mesh.faces;
  return touching_distance(faces);
}

double distance(const Vec3& point, const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from;
  const double t = std::clamp(way.dot(point - from) / way.squaredNorm(), 0.0, 1.0);
  return (point - from - t * way).norm();
}

/// Do two polygons of a plane share more of a side than a point, and not along one of these segments only?
bool share_a_side(const Polygon& one, const Polygon& other, const std::vector<Segment>& apart, double touching) {
  const std::vector<Vec3>&v = one.vertices(), &w = other.vertices();
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Vec3 &a = v[i], side = v[(i + 1) % v.size()] - a;
    const double length = side.norm();
    for (std::size_t j = 0; j < w.size(); ++j) {
      const Vec3 from = w[(j + 1) % w.size()] - a, to = w[j] - a;  // the neighbour's sides run the other way
      if (from.cross(side).norm() > touching * length || to.cross(side).norm() > touching * length) continue;
      const double low = std::max(0.0, from.dot(side) / length), high = std::min(length, to.dot(side) / length);
      if (high - low <= touching) continue;
      const Vec3 middle = a + (low + high) / 2 / length * side;
      const auto lies_on = [&](const Segment& line) { return distance(middle, line.from, line.to) <= touching; };
      if (std::none_of(apart.begin(), apart.end(), lies_on)) return true;
    }
  }
  return false;
}

/// Adds the pairs of which one at least is a piece.
void add_pieces(const AdaptiveMesh& mesh, std::vector<Neighbours>& pairs) {
  const auto made = elements_of(mesh);
  if (!made) return;  // no mesh that was solved
  const double touching = touching_of(mesh);
  std::vector<std::vector<std::size_t>> members(mesh.faces.size());
  std::vector<double> reach;
  for (std::size_t k = 0; k < mesh.cells.size(); ++k) {
    const Polygon& polygon = made->elements[k].polygon;
    members[mesh.cells[k].face].push_back(k);
    reach.push_back(touching);
    for (const Vec3& v : polygon.vertices()) reach[k] = std::max(reach[k], (v - polygon.centroid()).norm() + touching);
  }
  std::vector<std::vector<Segment>> apart(mesh.faces.size());
  for (const Contact& contact : mesh.contacts) apart[contact.face].push_back(contact.segment);
  for (std::size_t k = 0; k < mesh.cells.size(); ++k) {
    if (mesh.cells[k].level != kPiece) continue;
    const std::size_t face = mesh.cells[k].face;
    const Polygon& own = made->elements[k].polygon;
    for (const std::size_t other : members[face]) {
      if (other == k || (mesh.cells[other].level == kPiece && other < k)) continue;  // once
      const Polygon& its = made->elements[other].polygon;
      if ((own.centroid() - its.centroid()).norm() > reach[k] + reach[other]) continue;
      if (share_a_side(own, its, apart[face], touching)) pairs.push_back({std::min(k, other), std::max(k, other)});
    }
  }
}

}  // namespace

AdaptiveMesh adaptive_mesh(const Scene& scene, const ElementMesh& mesh) {
  AdaptiveMesh adaptive{mesh.faces, {}, {}, mesh.patches, {}, mesh.contacts};
  for (const Face& face : mesh.faces) {
    const Subdivision& asked = scene.objects[face.object].subdivision;
    const auto [columns, rows] = division_of(asked, face.polygon).elements;
    adaptive.grids.push_back({columns, rows, face.polygon.vertices().size() == 4, asked.grading});
  }
  for (const Element& element : mesh.elements) {
    if (element.cell == kNoCell) {
      const auto piece = static_cast<std::int64_t>(adaptive.pieces.size());
      adaptive.pieces.push_back(element.polygon);
      adaptive.cells.push_back({element.face, element.patch, kPiece, piece, 0});
      continue;
    }
    const std::int64_t columns = adaptive.grids[element.face].columns;
    const auto at = static_cast<std::int64_t>(element.cell);
    adaptive.cells.push_back({element.face, element.patch, 0, at % columns, at / columns});
  }
  return adaptive;
}

AdaptiveMesh with_halved_singles(const Scene& scene, const AdaptiveMesh& mesh) {
  std::vector<bool> which;
  for (const MeshCell& cell : mesh.cells) {
    const AdaptiveMesh::Grid& grid = mesh.grids[cell.face];
    const bool emits = (scene.materials[mesh.faces[cell.face].material].emission > 0).any();
    which.push_back(grid.columns == 1 && grid.rows == 1 && cell.level == 0 && !emits);
  }
  return split(mesh, std::move(which)).mesh;
}

Result<ElementMesh> elements_of(const AdaptiveMesh& mesh) {
  ElementMesh elements;
  elements.faces = mesh.faces;
  elements.patches = mesh.patches;
  elements.contacts = mesh.contacts;
  for (const MeshCell& cell : mesh.cells) {
    if (cell.level == kPiece) {
      elements.elements.push_back({mesh.pieces[static_cast<std::size_t>(cell.a)], cell.face, cell.patch});
      continue;
    }
    const Polygon& face = mesh.faces[cell.face].polygon;
    const AdaptiveMesh::Grid& grid = mesh.grids[cell.face];
    if (!grid.divisible || (grid.columns == 1 && grid.rows == 1 && cell.level == 0)) {
      elements.elements.push_back({face, cell.face, cell.patch});
      continue;
    }
    const auto at = [&](std::int64_t a, std::int64_t b) { return corner(face.vertices(), grid, cell.level, a, b); };
    auto made =
        Polygon::make({at(cell.a, cell.b), at(cell.a + 1, cell.b), at(cell.a + 1, cell.b + 1), at(cell.a, cell.b + 1)});
    if (!made) return Error{made.error().code, "an element cannot be divided further: " + made.error().message};
    elements.elements.push_back({std::move(made).value(), cell.face, cell.patch});
  }
  return elements;
}

SplitMesh split(const AdaptiveMesh& mesh, std::vector<bool> which) {
  require(which.size() == mesh.cells.size(), "split: yes or no for each cell");
  keep_balanced(mesh, which);
  SplitMesh result{{mesh.faces, mesh.grids, {}, mesh.patches, {}, mesh.contacts}, {}};
  const double touching = mesh.pieces.empty() ? 0 : touching_of(mesh);
  const auto add_piece = [&](const MeshCell& of, Polygon polygon, std::int64_t halvings) {
    const auto index = static_cast<std::int64_t>(result.mesh.pieces.size());
    result.mesh.cells.push_back({of.face, of.patch, kPiece, index, halvings});
    result.mesh.pieces.push_back(std::move(polygon));
  };
  for (std::size_t k = 0; k < mesh.cells.size(); ++k) {
    const MeshCell& cell = mesh.cells[k];
    if (cell.level == kPiece) {
      const Polygon& piece = mesh.pieces[static_cast<std::size_t>(cell.a)];
      if (!which[k]) {
        add_piece(cell, piece, cell.b);
      } else {
        for (CutPiece& part : quarters(piece, mesh.faces[cell.face].polygon, touching)) {
          add_piece(cell, std::move(part.polygon), cell.b + 1);
        }
      }
    } else {
      for (std::int64_t part = 0; part < (which[k] ? 4 : 1); ++part) {
        result.mesh.cells.push_back(
            which[k] ? MeshCell{cell.face, cell.patch, cell.level + 1, 2 * cell.a + part % 2, 2 * cell.b + part / 2}
                     : cell);
      }
    }
    result.parents.resize(result.mesh.cells.size(), k);
  }
  return result;
}

std::vector<Neighbours> neighbours(const AdaptiveMesh& mesh) {
  const Directory directory(mesh);
  std::vector<Neighbours> pairs;
  for (std::size_t k = 0; k < mesh.cells.size(); ++k) {
    for (std::size_t side = 0; side < 2; ++side) {  // right and up: each pair once, seen from the left or from below
      for (const std::size_t other : directory.beyond(k, kSides[side].first, kSides[side].second)) {
        pairs.push_back({std::min(k, other), std::max(k, other)});
      }
    }
  }
  if (!mesh.pieces.empty()) add_pieces(mesh, pairs);
  return pairs;
}

}  // namespace etendue
