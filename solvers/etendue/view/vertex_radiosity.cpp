// SPDX-License-Identifier: Apache-2.0
#include "etendue/view/vertex_radiosity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "etendue/meshing/contacts.hpp"

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
  Welder welder(touching_distance(mesh));
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

/// Segments of the mesh's contacts, by face.
std::vector<std::vector<Segment>> creases_of(const ElementMesh& mesh) {
  std::vector<std::vector<Segment>> creases(mesh.faces.size());
  for (const Contact& contact : mesh.contacts) creases[contact.face].push_back(contact.segment);
  return creases;
}

bool lies_on(const Vec3& point, const Segment& segment, double touching) {
  const Vec3 along = segment.to - segment.from;
  const double t = std::clamp(along.dot(point - segment.from) / along.squaredNorm(), 0.0, 1.0);
  return (point - segment.from - t * along).norm() <= touching;
}

/// Splits the vertices on contacts: elements that are joined there by no side but those along a contact have one each.
class Separation {
 public:
  Separation(const ElementMesh& mesh, Topology& topology)
      : mesh_(mesh), topology_(topology), creases_(creases_of(mesh)), touching_(touching_distance(mesh)) {}

  void apply() {
    for (std::size_t k = topology_.vertices.size(); k-- > 0;) separate(k);
  }

 private:
  using Sides = std::map<std::size_t, std::vector<std::size_t>>;  // neighbour along a side → elements with that side

  void separate(std::size_t index) {
    const Vec3 position = topology_.vertices[index].position;
    const auto here = [&](const Segment& segment) { return lies_on(position, segment, touching_); };
    std::vector<Segment> passing;
    const std::vector<std::size_t> elements = topology_.vertices[index].elements;
    for (const std::size_t element : elements) {
      const auto& creases = creases_[mesh_.elements[element].face];
      std::copy_if(creases.begin(), creases.end(), std::back_inserter(passing), here);
    }
    if (passing.empty()) return;
    Sides sides;
    for (const std::size_t element : elements) {
      const auto& ring = topology_.corners[element];
      const auto at = static_cast<std::size_t>(std::find(ring.begin(), ring.end(), index) - ring.begin());
      sides[ring[(at + 1) % ring.size()]].push_back(element);
      sides[ring[(at + ring.size() - 1) % ring.size()]].push_back(element);
    }
    std::map<std::size_t, std::size_t> group;  // element → the first element it is joined to
    for (const std::size_t element : elements) group[element] = element;
    for (const auto& [other, both] : sides) {
      const Vec3& end = topology_.vertices[other].position;
      const auto along = [&](const Segment& segment) { return lies_on(end, segment, touching_); };
      if (both.size() < 2 || std::any_of(passing.begin(), passing.end(), along)) continue;
      const std::size_t from = group[both[1]], to = group[both[0]];
      for (auto& [element, first] : group) first = first == from ? to : first;
    }
    give_own(index, group);
  }

  /// All groups but that of the first element get a vertex of their own.
  void give_own(std::size_t index, const std::map<std::size_t, std::size_t>& group) {
    const std::vector<std::size_t> elements = topology_.vertices[index].elements;
    std::map<std::size_t, std::size_t> vertex_of{{group.at(elements.front()), index}};
    topology_.vertices[index].elements.clear();
    for (const std::size_t element : elements) {
      const auto [found, added] = vertex_of.emplace(group.at(element), topology_.vertices.size());
      if (added) {
        Vertex copy = topology_.vertices[index];
        copy.elements.clear();
        topology_.vertices.push_back(std::move(copy));
      }
      topology_.vertices[found->second].elements.push_back(element);
      auto& ring = topology_.corners[element];
      std::replace(ring.begin(), ring.end(), index, found->second);
    }
  }

  const ElementMesh& mesh_;
  Topology& topology_;
  std::vector<std::vector<Segment>> creases_;
  double touching_;
};

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

/// The gradient over a plane of the affine function that is nearest to the radiosities of some elements at their centroids
/// (least squares, weighted by area); the smallest one where several are: across a row of elements there is none.
struct Gradient {
  Vec3 along[2];  // unit vectors of the plane
  Rgb slope[2];

  Rgb times(const Vec3& way) const { return along[0].dot(way) * slope[0] + along[1].dot(way) * slope[1]; }
};

Gradient gradient_over(const ElementMesh& mesh, const std::set<std::size_t>& elements,
                       const std::vector<Rgb>& radiosity, const Vec3& normal) {
  Vec3 middle = Vec3::Zero();
  Rgb mean_radiosity = Rgb::Zero();
  double area = 0;
  for (const std::size_t k : elements) {
    const Polygon& polygon = mesh.elements[k].polygon;
    middle += polygon.area() * polygon.centroid();
    mean_radiosity += polygon.area() * radiosity[k];
    area += polygon.area();
  }
  middle /= area;
  mean_radiosity /= area;
  const Vec3 u = normal.unitOrthogonal(), w = normal.cross(u);
  double uu = 0, uw = 0, ww = 0;
  Rgb u_slope = Rgb::Zero(), w_slope = Rgb::Zero();
  for (const std::size_t k : elements) {
    const Polygon& polygon = mesh.elements[k].polygon;
    const double x = u.dot(polygon.centroid() - middle), y = w.dot(polygon.centroid() - middle);
    uu += polygon.area() * x * x;
    uw += polygon.area() * x * y;
    ww += polygon.area() * y * y;
    u_slope += polygon.area() * x * (radiosity[k] - mean_radiosity);
    w_slope += polygon.area() * y * (radiosity[k] - mean_radiosity);
  }
  // The spread of the centroids along its two axes, and the longer axis.
  const double half = std::hypot((uu - ww) / 2, uw), longer = (uu + ww) / 2 + half, shorter = (uu + ww) / 2 - half;
  const double angle = std::atan2(uw, (uu - ww) / 2) / 2, c = std::cos(angle), s = std::sin(angle);
  Gradient gradient{{c * u + s * w, c * w - s * u}, {Rgb::Zero(), Rgb::Zero()}};
  if (longer > kInARow * area * area) gradient.slope[0] = (c * u_slope + s * w_slope) / longer;
  if (shorter > kInARow * longer) gradient.slope[1] = (c * w_slope - s * u_slope) / shorter;
  return gradient;
}

/// Where there is no inner vertex: the mean, and the gradient around it.
Rgb fitted(const ElementMesh& mesh, const Topology& topology, const Vertex& vertex, const std::vector<Rgb>& radiosity) {
  std::set<std::size_t> around;
  Vec3 middle = Vec3::Zero();
  for (const std::size_t element : vertex.elements) {
    middle += mesh.elements[element].polygon.centroid() / static_cast<double>(vertex.elements.size());
    for (const std::size_t corner : topology.corners[element]) {
      around.insert(topology.vertices[corner].elements.begin(), topology.vertices[corner].elements.end());
    }
  }
  const Gradient gradient = gradient_over(mesh, around, radiosity, vertex.normal);
  return vertex.value + gradient.times(vertex.position - middle);
}

}  // namespace

VertexRadiosities vertex_radiosities(const ElementMesh& mesh, const std::vector<Rgb>& radiosity,
                                     const std::vector<std::size_t>& covered) {
  require(radiosity.size() == mesh.elements.size(), "vertex_radiosities: one radiosity an element");
  std::vector<bool> left_out(mesh.elements.size(), false);
  for (const std::size_t element : covered) left_out.at(element) = true;
  Topology topology = weld(mesh, left_out);
  if (!mesh.contacts.empty()) Separation(mesh, topology).apply();

  for (std::size_t k = 0; k < topology.vertices.size(); ++k) {
    Vertex& vertex = topology.vertices[k];
    vertex.inner = is_inner(topology, k);
    vertex.value = mean(vertex.elements, radiosity);
  }
  VertexRadiosities result;
  result.vertices = topology.vertices.size();
  for (Vertex& vertex : topology.vertices) {
    if (vertex.inner) continue;
    const auto printed = extrapolated(topology, vertex, radiosity);
    if (!printed) ++result.without_interior;
    const Rgb value = printed ? *printed : fitted(mesh, topology, vertex, radiosity);
    if ((value < 0).any()) ++result.clamped;
    vertex.value = value.max(0.0);
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
