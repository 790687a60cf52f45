// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/mesh_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "etendue/text/number_text.hpp"

namespace etendue {

namespace {

/// Indices are 32 bits wide.
constexpr std::size_t kMostVertices = std::numeric_limits<std::uint32_t>::max();

/// How far corners of a quad may be off its plane without a word, as a share of its diagonals: more than the rounding of
/// coordinates to single precision moves them, and less than can be seen.
constexpr double kFlatQuad = 0x1p-20;

/// The corners of one face; an index that names no vertex is reported where it stands.
std::optional<std::vector<std::uint32_t>> read_face(const SceneNode& face, std::size_t corners, std::size_t vertices) {
  const auto nodes = face.items(corners, corners, "vertex indices");
  std::vector<std::uint32_t> indices;
  for (const SceneNode& node : nodes) {
    if (const auto index = node.integer(0, static_cast<long>(vertices) - 1)) {
      indices.push_back(static_cast<std::uint32_t>(*index));
    }
  }
  return nodes.size() == corners && indices.size() == corners ? std::optional(indices) : std::nullopt;
}

/// Appends the triangles of one kind of face (a fan from the first corner), whose indices name one of `vertices`. Where
/// the mesh has none of them, since one is wrong, areas are not looked at.
bool read_faces(const SceneNode& faces, std::size_t corners, std::size_t vertices, Mesh& mesh) {
  bool sound = true;
  for (const SceneNode& node : faces.items(1, kMostVertices, "faces")) {
    const auto face = read_face(node, corners, vertices);
    sound = sound && face.has_value();
    for (std::size_t i = 2; face && i < corners; ++i) {
      mesh.triangles.push_back({(*face)[0], (*face)[i - 1], (*face)[i]});
      const auto fault = mesh.vertices.empty() ? std::nullopt : fault_of_area(mesh.triangle(mesh.triangles.size() - 1));
      if (!fault) continue;
      node.complain("found a face whose corners " + std::string(corners == 3 ? "" : "(split into triangles) ") +
                    *fault + ", expected a face with an area");
      sound = false;
    }
  }
  return sound;
}

/// How far each corner of the quad of two triangles, a b c and a c d, is off the plane that lies evenly among them, as a
/// share of the longer diagonal: half the distance of the diagonals' lines.
double unevenness(const Triangle& first, const Triangle& second) {
  const Vec3 one = first.c - first.a, other = second.c - first.b;
  const double size = std::max(one.stableNorm(), other.stableNorm());
  const Vec3 across = (one / size).cross(other / size);
  return std::abs(across.stableNormalized().dot((first.b - first.a) / size)) / 2;
}

/// Quads whose corners lie in no plane are used as two triangles each; one warning says how many, and how far.
void warn_of_uneven_quads(const SceneNode& quads, std::size_t first, const Mesh& mesh) {
  std::size_t uneven = 0, worst = 0;
  double farthest = 0;
  for (std::size_t i = first; i + 1 < mesh.triangles.size(); i += 2) {
    const double off = unevenness(mesh.triangle(i), mesh.triangle(i + 1));
    if (off > kFlatQuad) ++uneven;
    if (off > farthest) farthest = off, worst = (i - first) / 2;
  }
  if (uneven == 0) return;
  quads.warn("found " + std::to_string(uneven) + (uneven == 1 ? " quad" : " quads") +
             " whose corners do not lie in a plane, the most uneven " + std::to_string(worst) + " with corners " +
             rounded(farthest, 3) +
             " of its diagonal off; each is used as two triangles, folded along the diagonal from "
             "its first corner");
}

bool read_texture_coordinates(const SceneNode& node, std::size_t vertices, Mesh& mesh) {
  const auto places = node.items(1, kMostVertices, "pairs of numbers");
  for (const SceneNode& place : places) {
    const auto pair = place.items(2, 2, "numbers");
    if (pair.size() != 2) continue;
    const auto u = pair[0].number(kAnyNumber), v = pair[1].number(kAnyNumber);
    if (u && v) mesh.texture.emplace_back(*u, *v);
  }
  if (!places.empty() && places.size() != vertices) {
    node.complain("found " + std::to_string(places.size()) + " pairs of numbers, expected one for each of the " +
                  std::to_string(vertices) + " vertices");
    return false;
  }
  return mesh.texture.size() == places.size() && !places.empty();
}

}  // namespace

std::optional<std::vector<Vec3>> read_vertices(const SceneNode& node, std::size_t fewest, std::size_t most) {
  const auto nodes = node.items(fewest, most, "vertices");
  std::vector<Vec3> vertices;
  vertices.reserve(nodes.size());
  for (const SceneNode& item : nodes) {
    if (const auto vertex = item.vector()) vertices.push_back(*vertex);
  }
  const bool sound = vertices.size() == nodes.size() && nodes.size() >= fewest && nodes.size() <= most;
  return sound ? std::optional(std::move(vertices)) : std::nullopt;
}

std::optional<std::string> fault_of_area(const Triangle& triangle) {
  const Vec3 one = triangle.b - triangle.a, other = triangle.c - triangle.a;
  const double size = std::max(one.lpNorm<Eigen::Infinity>(), other.lpNorm<Eigen::Infinity>());
  if (size > 0 && size < kLeastTriangle) {
    return "lie within " + rounded(size, 3) + " of each other, less than 2^-120 = " + rounded(kLeastTriangle, 3);
  }
  if (one.cross(other).stableNorm() > 0) return std::nullopt;
  return "lie on one line";
}

std::optional<Mesh> read_mesh(const SceneNode& node) {
  const auto vertices = node.member("vertices");
  auto points = vertices ? read_vertices(*vertices, 3, kMostVertices) : std::nullopt;
  const auto triangles = node.member("triangles"), quads = node.member("quads");
  if (!triangles && !quads) node.complain("found neither \"triangles\" nor \"quads\", expected one of them or both");
  const std::size_t written = vertices ? vertices->json().items.size() : 0;
  const std::size_t count = written > 0 ? written : kMostVertices;  // without any, no index is wrong for that
  Mesh mesh;
  if (points) mesh.vertices = std::move(*points);
  const bool sound_triangles = !triangles || read_faces(*triangles, 3, count, mesh);
  const std::size_t folded = mesh.triangles.size();
  const bool sound_quads = !quads || read_faces(*quads, 4, count, mesh);
  if (quads && sound_quads && !mesh.vertices.empty()) warn_of_uneven_quads(*quads, folded, mesh);
  const auto texture = node.member("texture");
  const bool sound_texture = !texture || read_texture_coordinates(*texture, written, mesh);
  const bool sound =
      !mesh.vertices.empty() && !mesh.triangles.empty() && sound_triangles && sound_quads && sound_texture;
  return sound ? std::optional(std::move(mesh)) : std::nullopt;
}

}  // namespace etendue
