// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <bit>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "etendue/geometry/mesh.hpp"
#include "geometry/families.hpp"
#include "support/evidence.hpp"
#include "support/long_run.hpp"

// This file alone, with lib's geometry and support/, is also built with contraction switched on: it must fail then.
namespace etendue::validation {
namespace {

std::uint64_t rays() {
  return long_run(1'000'000);
}

// Far from the origin compared with the mesh's own size (1): half of the digits of a coordinate are gone.
constexpr double kFarAway = 2.7e5;

// Icosahedron, every face split in four, the corners pushed to the unit sphere.
Mesh round_mesh() {
  const double g = std::numbers::phi;
  Mesh solid;
  solid.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                    {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  solid.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  Mesh mesh;
  mesh.vertices = solid.vertices;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t i, std::uint32_t j) {
    const auto [entry, is_new] =
        middles.try_emplace(std::minmax(i, j), static_cast<std::uint32_t>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back(mesh.vertices[i] + mesh.vertices[j]);
    return entry->second;
  };
  for (const auto& corner : solid.triangles) {
    const std::uint32_t a = corner[0], b = corner[1], c = corner[2];
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    mesh.triangles.insert(mesh.triangles.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  for (Vec3& v : mesh.vertices) v.normalize();
  return mesh;
}

Mesh moved(Mesh mesh, const Mat3& rotation, const Vec3& offset) {
  for (Vec3& v : mesh.vertices) v = rotation * v + offset;
  return mesh;
}

// Closed: every directed edge occurs once, and its opposite too.
bool is_closed(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& corner : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++uses[{corner[k], corner[(k + 1) % 3]}];
  }
  for (const auto& [edge, count] : uses) {
    if (count != 1 || uses.count({edge.second, edge.first}) != 1) return false;
  }
  return true;
}

// From `origin` to a point anywhere on an edge. The ends are taken relative to the origin before anything is rounded,
// so that the ray passes the edge at a few u of their distance however far away both are.
Vec3 towards_an_edge(const Mesh& mesh, const Vec3& origin, Random& random) {
  const auto& corner = mesh.triangles[random.index(mesh.triangles.size())];
  const std::size_t k = random.index(3);
  const Vec3 a = mesh.vertices[corner[k]] - origin, b = mesh.vertices[corner[(k + 1) % 3]] - origin;
  return a + random.uniform(0, 1) * (b - a);
}

Vec3 towards_a_vertex(const Mesh& mesh, const Vec3& origin, Random& random) {
  return mesh.vertices[random.index(mesh.vertices.size())] - origin;
}

// Rays from inside that leave a closed mesh without a hit. Triangles that the ray passes by far are left out: what they
// would answer does not matter, a hit of any triangle is enough.
template <class Direction>
std::uint64_t cracks(const Vec3& offset, std::uint64_t seed, Direction direction) {
  constexpr std::uint64_t kFrames = 20;
  Random random(seed);
  const Mesh shape = round_mesh();
  std::uint64_t missed = 0, digest = 0;
  for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
    const Mat3 rotation = random.rotation();
    const Mesh mesh = moved(shape, rotation, rotation * offset);
    EXPECT_TRUE(is_closed(mesh));
    const std::uint64_t rays_of_frame = rays() / kFrames;
    for (std::uint64_t i = 0; i < rays_of_frame; ++i) {
      share_done(frame * rays_of_frame + i, rays());
      Ray ray;
      ray.origin = rotation * offset + random.in_cube(0.3);
      ray.direction = direction(mesh, ray.origin, random);
      const Vec3 aim = ray.at(1);
      std::optional<Hit> hit;
      for (std::size_t k = 0; k < mesh.triangles.size() && !hit; ++k) {
        const Triangle triangle = mesh.triangle(k);
        // No edge is longer than 0.62, so only these can contain the target.
        if ((triangle.a - aim).squaredNorm() < 0.5) hit = intersect(ray, triangle);
      }
      missed += !hit;
      digest = 31 * digest + (hit ? std::bit_cast<std::uint64_t>(hit->t) : 0);
    }
  }
  // ci/long-run compares it between compilers and their options.
  ::testing::Test::RecordProperty("digest", std::to_string(digest));
  return missed;
}

// CLAIM      RT.9, IU.5.0: no ray slips between triangles that share an edge.
// ORACLE     topology: a ray from inside a closed mesh leaves it through a triangle.
// TOLERANCE  none: 0 of 10⁶ rays aimed at edges, in random frames around the origin.
TEST(Watertight, LetsNoRayThroughAnEdge) {
  proves({"RT.9", "IU.5.0"}, Oracle::identity, "a ray from inside a closed mesh meets it");
  EXPECT_TRUE(all_agree(cracks(Vec3::Zero(), 101, towards_an_edge), rays()));
}

// CLAIM      RT.9, IU.5.0: the same far away from the origin of the coordinates.
// ORACLE     topology, as above.
// TOLERANCE  none: 0 of 10⁶.
TEST(Watertight, LetsNoRayThroughAnEdgeFarAway) {
  proves({"RT.9", "IU.5.0"}, Oracle::identity, "a ray from inside a closed mesh meets it");
  EXPECT_TRUE(all_agree(cracks({kFarAway, 0, 0}, 102, towards_an_edge), rays()));
}

// CLAIM      RT.9, IU.5.0: no ray slips between the triangles around a vertex.
// ORACLE     topology, as above.
// TOLERANCE  none: 0 of 10⁶ rays aimed at vertices.
TEST(Watertight, LetsNoRayThroughAVertex) {
  proves({"RT.9", "IU.5.0"}, Oracle::identity, "a ray from inside a closed mesh meets it");
  EXPECT_TRUE(all_agree(cracks(Vec3::Zero(), 103, towards_a_vertex), rays()));
}

// CLAIM      RT.9, IU.5.0: the same far away from the origin of the coordinates.
// ORACLE     topology, as above.
// TOLERANCE  none: 0 of 10⁶.
TEST(Watertight, LetsNoRayThroughAVertexFarAway) {
  proves({"RT.9", "IU.5.0"}, Oracle::identity, "a ray from inside a closed mesh meets it");
  EXPECT_TRUE(all_agree(cracks({kFarAway, 0, 0}, 104, towards_a_vertex), rays()));
}

}  // namespace
}  // namespace etendue::validation
