// SPDX-License-Identifier: Apache-2.0
#include "etendue/meshing/shared_vertices.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "etendue/meshing/contacts.hpp"

namespace etendue {

namespace {

/// Sine of the largest angle between normals of one plane; that of vertex_radiosities().
constexpr double kOnePlane = 0x1p-20;

struct Vertex {
  Vec3 place;
  Vec3 normal;
  std::size_t material;
};

/// Vertices by cells of space.
class VertexMap {
 public:
  explicit VertexMap(double cell) : cell_(cell) {}

  void add(const Vertex& vertex) { cells_[cell_of(vertex.place)].push_back(vertex); }

  /// Calls visit(vertex) for all within half a cell of a place, and for some others.
  template <class Visit>
  void near(const Vec3& place, const Visit& visit) const {
    const Cell low = cell_of(place.array() - 0.5 * cell_), high = cell_of(place.array() + 0.5 * cell_);
    for (std::int64_t x = low[0]; x <= high[0]; ++x) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          const auto found = cells_.find({x, y, z});
          if (found == cells_.end()) continue;
          for (const Vertex& vertex : found->second) visit(vertex);
        }
      }
    }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  Cell cell_of(const Eigen::Array3d& place) const {
    Cell cell;
    for (int k = 0; k < 3; ++k) {
      cell[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::floor(place(k) / cell_));
    }
    return cell;
  }

  double cell_;
  std::map<Cell, std::vector<Vertex>> cells_;
};

/// Half of the sides are longer: walking along sides in steps of this meets few vertices at a time, and takes few steps.
double median_side(const ElementMesh& mesh) {
  std::vector<double> lengths;
  for (const Element& element : mesh.elements) {
    const auto& v = element.polygon.vertices();
    for (std::size_t k = 0; k < v.size(); ++k) lengths.push_back((v[(k + 1) % v.size()] - v[k]).norm());
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

class Sharer {
 public:
  explicit Sharer(const ElementMesh& mesh)
      : mesh_(mesh), touching_(touching_distance(mesh)), step_(median_side(mesh)), vertices_(step_) {
    for (const Element& element : mesh.elements) {
      for (const Vec3& place : element.polygon.vertices()) vertices_.add(vertex(place, element));
    }
    // Where a contact ends within a side, that side is one of two elements on both sides of it in part only.
    for (const Contact& contact : mesh.contacts) {
      const Face& face = mesh.faces[contact.face];
      for (const Vec3& end : {contact.segment.from, contact.segment.to}) {
        vertices_.add({end, face.polygon.normal(), face.material});
      }
    }
  }

  Polygon shared(const Element& element) const {
    const auto& v = element.polygon.vertices();
    std::vector<Vec3> ring;
    for (std::size_t k = 0; k < v.size(); ++k) {
      ring.push_back(v[k]);
      add_between(ring, v[k], v[(k + 1) % v.size()], element);
    }
    if (ring.size() == v.size()) return element.polygon;
    auto made = Polygon::make(std::move(ring));
    return made ? std::move(made).value() : element.polygon;  // too narrow for more corners than it has
  }

 private:
  Vertex vertex(const Vec3& place, const Element& element) const {
    return {place, element.polygon.normal(), mesh_.face_of(element).material};
  }

  void add_between(std::vector<Vec3>& ring, const Vec3& from, const Vec3& to, const Element& element) const {
    const Vec3 side = to - from;
    const double length = side.norm();
    const Vertex own = vertex(from, element);
    std::vector<std::pair<double, Vec3>> found;
    const auto visit = [&](const Vertex& other) {
      const double along = (other.place - from).dot(side) / length;
      if (along <= touching_ || along >= length - touching_) return;
      if ((other.place - from - (along / length) * side).norm() > touching_) return;
      if (other.material != own.material || !(other.normal.dot(own.normal) > 0)) return;
      if (other.normal.cross(own.normal).norm() <= kOnePlane) found.emplace_back(along, other.place);
    };
    const int steps = static_cast<int>(std::ceil(length / step_));
    for (int k = 0; k <= steps; ++k) vertices_.near(from + (static_cast<double>(k) / steps) * side, visit);
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    double last = 0;
    for (const auto& [along, place] : found) {
      if (along - last <= touching_) continue;  // the same vertex of another element
      ring.push_back(place);
      last = along;
    }
  }

  const ElementMesh& mesh_;
  double touching_, step_;
  VertexMap vertices_;
};

}  // namespace

ElementMesh with_shared_vertices(const ElementMesh& mesh) {
  if (mesh.elements.empty()) return mesh;
  const Sharer sharer(mesh);
  ElementMesh shared{mesh.faces, {}, mesh.patches, mesh.contacts};
  for (const Element& element : mesh.elements) {
    shared.elements.push_back({sharer.shared(element), element.face, element.patch, element.cell});
  }
  return shared;
}

}  // namespace etendue
