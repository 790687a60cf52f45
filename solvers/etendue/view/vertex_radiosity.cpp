// SPDX-License-Identifier: Apache-2.0
#include "etendue/view/vertex_radiosity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>

namespace etendue {

namespace {

struct Vertex {
  Vec3 position;
  Vec3 normal;
  std::size_t material;
  std::vector<std::size_t> elements;
  bool inner = false;
  Rgb value = Rgb::Zero();
};

// Finds vertices by place: cells much wider than the tolerance, so that at most the neighbours need a look.
class Welder {
 public:
  explicit Welder(double tolerance) : tolerance_(tolerance), cell_(tolerance * 1024) {}

  std::size_t find_or_add(const Vec3& position, const Vec3& normal, std::size_t material) {
    const Cell low = cell_of(position.array() - tolerance_), high = cell_of(position.array() + tolerance_);
    for (std::int64_t x = low[0]; x <= high[0]; ++x) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          const auto found = cells_.find({x, y, z});
          if (found == cells_.end()) continue;
          for (const std::size_t index : found->second) {
            const Vertex& vertex = vertices[index];
            if (vertex.material == material && (vertex.position - position).norm() <= tolerance_ &&
                vertex.normal.dot(normal) > 0 && vertex.normal.cross(normal).norm() <= kSamePlane) {
              return index;
            }
          }
        }
      }
    }
    vertices.push_back({position, normal, material, {}});
    cells_[cell_of(position)].push_back(vertices.size() - 1);
    return vertices.size() - 1;
  }

  std::vector<Vertex> vertices;

 private:
  using Cell = std::array<std::int64_t, 3>;
  Cell cell_of(const Eigen::Array3d& p) const {
    Cell cell;
    for (int k = 0; k < 3; ++k) cell[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::floor(p(k) / cell_));
    return cell;
  }

  double tolerance_, cell_;
  std::map<Cell, std::vector<std::size_t>> cells_;
};

// The elements of a mesh over their distinct vertices.
struct Topology {
  std::vector<Vertex> vertices;
  std::vector<std::vector<std::size_t>> corners;  // of each element, indices of vertices; empty when it is left out
};

Topology weld(const ElementMesh& mesh, const std::vector<bool>& left_out) {
  Welder welder(kTouching * diagonal(mesh));
  Topology topology;
  topology.corners.resize(mesh.elements.size());
  for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
    if (left_out[k]) continue;
    const Element& element = mesh.elements[k];
    for (const Vec3& position : element.polygon.vertices()) {
      const std::size_t vertex = welder.find_or_add(position, element.polygon.normal(), mesh.face_of(element).material);
      welder.vertices[vertex].elements.push_back(k);
      topology.corners[k].push_back(vertex);
    }
  }
  topology.vertices = std::move(welder.vertices);
  return topology;
}

bool is_inner(const Topology& topology, std::size_t index) {
  std::map<std::size_t, int> edges;  // neighbour along an edge → elements that have this edge
  for (const std::size_t element : topology.vertices[index].elements) {
    const auto& ring = topology.corners[element];
    const auto at = static_cast<std::size_t>(std::find(ring.begin(), ring.end(), index) - ring.begin());
    ++edges[ring[(at + 1) % ring.size()]];
    ++edges[ring[(at + ring.size() - 1) % ring.size()]];
  }
  return std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 2; });
}

Rgb mean(const std::vector<std::size_t>& elements, const std::vector<Rgb>& radiosity) {
  Rgb sum = Rgb::Zero();
  for (const std::size_t element : elements) sum += radiosity[element];
  return sum / static_cast<double>(elements.size());
}

// 2 mean − B_e, averaged over the nearest inner vertices; nothing where there is none.
std::optional<Rgb> extrapolated(const Topology& topology, const Vertex& vertex, const std::vector<Rgb>& radiosity) {
  std::map<std::size_t, std::vector<std::size_t>> shared;  // inner vertex → elements that touch both
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::size_t element : vertex.elements) {
    for (const std::size_t other : topology.corners[element]) {
      if (!topology.vertices[other].inner) continue;
      shared[other].push_back(element);
      nearest = std::min(nearest, (topology.vertices[other].position - vertex.position).norm());
    }
  }
  Rgb sum = Rgb::Zero();
  int count = 0;
  for (const auto& [other, elements] : shared) {
    const Vertex& inner = topology.vertices[other];
    if ((inner.position - vertex.position).norm() > nearest * (1 + kEquallyNear)) continue;
    sum += 2 * mean(elements, radiosity) - inner.value;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return Rgb(sum / count);
}

}  // namespace

VertexRadiosities vertex_radiosities(const ElementMesh& mesh, const std::vector<Rgb>& radiosity,
                                     const std::vector<std::size_t>& covered) {
  require(radiosity.size() == mesh.elements.size(), "vertex_radiosities: one radiosity an element");
  std::vector<bool> left_out(mesh.elements.size(), false);
  for (const std::size_t element : covered) left_out.at(element) = true;
  Topology topology = weld(mesh, left_out);

  for (std::size_t k = 0; k < topology.vertices.size(); ++k) {
    Vertex& vertex = topology.vertices[k];
    vertex.inner = is_inner(topology, k);
    vertex.value = mean(vertex.elements, radiosity);
  }
  VertexRadiosities result;
  result.vertices = topology.vertices.size();
  for (Vertex& vertex : topology.vertices) {
    if (vertex.inner) continue;
    const auto value = extrapolated(topology, vertex, radiosity);
    if (!value) ++result.without_interior;
    if (value) vertex.value = value->max(0.0);
    if (value && (*value < 0).any()) ++result.clamped;
  }
  for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
    std::vector<Rgb> values(mesh.elements[k].polygon.vertices().size(), radiosity[k]);
    for (std::size_t c = 0; c < topology.corners[k].size(); ++c)
      values[c] = topology.vertices[topology.corners[k][c]].value;
    result.corners.push_back(std::move(values));
  }
  return result;
}

}  // namespace etendue
