// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cmath>
#include <numbers>

#include "etendue/acceleration/brute_force.hpp"
#include "etendue/acceleration/embree.hpp"
#include "etendue/acceleration/surface_list.hpp"
#include "etendue/core/contract.hpp"
#include "etendue/geometry/spawn.hpp"
#include "geometry/families.hpp"
#include "support/evidence.hpp"
#include "support/scene_builder.hpp"

namespace etendue::validation {
namespace {

/// A bumpy closed surface of 2 · rings · rings triangles, about a radius of `size` around `centre`.
Mesh bumpy(std::uint32_t rings, const Vec3& centre, double size) {
  Mesh mesh;
  const double pi = std::numbers::pi;
  mesh.vertices.push_back(centre + size * Vec3::UnitZ());
  for (std::uint32_t i = 1; i < rings; ++i) {
    for (std::uint32_t j = 0; j < rings; ++j) {
      const double down = pi * i / rings, turn = 2 * pi * j / rings;
      const double radius = size * (1 + 0.1 * std::sin(7 * down) * std::sin(5 * turn));
      mesh.vertices.push_back(
          centre + radius * Vec3(std::sin(down) * std::cos(turn), std::sin(down) * std::sin(turn), std::cos(down)));
    }
  }
  mesh.vertices.push_back(centre - size * Vec3::UnitZ());
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  const auto at = [rings](std::uint32_t i, std::uint32_t j) { return 1 + (i - 1) * rings + j % rings; };
  for (std::uint32_t j = 0; j < rings; ++j) {
    mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
    mesh.triangles.push_back({last, at(rings - 1, j + 1), at(rings - 1, j)});
    for (std::uint32_t i = 1; i + 1 < rings; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      mesh.triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool same(const std::optional<SceneHit>& a, const std::optional<SceneHit>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  bool equal = a->object == b->object && a->part == b->part && same_bits(a->hit.t, b->hit.t);
  for (int k = 0; k < 3; ++k) equal = equal && same_bits(a->hit.point[k], b->hit.point[k]);
  return equal;
}

/// Rays at the mesh: any, aimed at corners, at edges, and such as leave its surface.
Ray ray_at(const Mesh& mesh, const Vec3& centre, double size, Random& random, const Accelerator& any, int kind) {
  Ray ray;
  ray.origin = centre + random.in_cube((kind & 4 ? 0.5 : 3) * size);
  const auto& corner = mesh.triangles[random.index(mesh.triangles.size())];
  const Vec3 &a = mesh.vertices[corner[0]], &b = mesh.vertices[corner[1]];
  const double share = random.uniform(0, 1), speed = random.scale(1e-3, 1e3);
  if (kind % 4 == 0) ray.direction = speed * random.unit_vector();
  if (kind % 4 == 1) ray.direction = speed / size * (a - ray.origin);
  if (kind % 4 >= 2) ray.direction = speed / size * (a + share * (b - a) - ray.origin);
  if (kind % 4 == 3) {
    const auto met = any.nearest(ray).hit;
    const Vec3 direction = random.unit_vector();
    if (met) ray = Ray{offset_origin(met->hit, direction), direction};
  }
  return ray;
}

struct Place {
  double size;
  Vec3 centre;
};
const Place kPlaces[] = {{1, Vec3::Zero()},
                         {1, {3e6, -2e6, 1e5}},
                         {0x1p-100, Vec3::Zero()},
                         {0x1p100, Vec3::Zero()},
                         {0x1p-100, {0x1p-80, 0, 0x1p-85}},
                         {0x1p90, {0, 0x1p110, 0}}};

// CLAIM      IU.5.7, IU.5.7.1: on a closed mesh the hierarchy of boxes, which looks in single precision first, finds what brute
//            force finds; for scenes of any size in the domain, and far from the origin of coordinates.
// ORACLE     identity: brute force, bit for bit; topology: a ray from inside meets a closed mesh.
// TOLERANCE  none.
TEST(Triangles, AreFoundAtAnySizeAndAnywhere) {
  proves({"IU.5.7", "IU.5.7.1", "RT.3"}, Oracle::identity, "brute force, bit for bit");
  Random random(1571);
  std::uint64_t wrong = 0, decided = 0, inside = 0;
  for (const Place& place : kPlaces) {
    Scene scene;
    const Mesh mesh = bumpy(32, place.centre, place.size);
    add(scene, mesh, diffuse(0.5));
    const BruteForce brute(scene);
    const auto boxes = make_accelerator(scene, AcceleratorKind::bounding_volumes);
    for (int trial = 0; trial < 1200; ++trial) {
      Ray ray = ray_at(mesh, place.centre, place.size, random, *boxes, trial);
      if (trial % 10 == 0) ray.t_max = random.scale(1e-3, 1e3) * place.size / ray.direction.norm();
      const auto expected = brute.nearest(ray).hit;
      decided += 2;
      wrong += !same(boxes->nearest(ray).hit, expected);
      wrong += boxes->obstruction(ray).blocked != expected.has_value();
      const bool from_inside = (trial & 4) && trial % 4 != 3 && trial % 10 != 0;
      inside += from_inside;
      wrong += from_inside && !expected;
    }
  }
  EXPECT_TRUE(all_agree(wrong, decided + inside));
}

// CLAIM      IU.5.7: where Embree proposes triangles, any ray finds the bits of brute force; of rays aimed exactly at edges and
//            corners, or leaving from them, those that pass a silhouette may find less, but nothing untrue, and none from
//            inside a closed mesh slips out. Where Embree is not there, that is said.
// ORACLE     identity: brute force, and intersect() on the triangle named, bit for bit.
// TOLERANCE  none for the first; of 4,500 aimed rays 1 % (measured: 0.6 %) may differ.
TEST(Triangles, AreTrueWhereEmbreeProposesThem) {
  proves({"IU.5.7"}, Oracle::identity, "brute force, bit for bit");
  Scene scene;
  const Mesh mesh = bumpy(32, {1, 2, 3}, 1);
  add(scene, mesh, diffuse(0.5));
  add(scene, Sphere{{1, 2, 3}, 0.125}, diffuse(0.5));
  add(scene, Triangle{{-5, -5, -2}, {5, -5, -2}, {0, 9, -2}}, diffuse(0.5));
  add(scene, Plane{{0, 0, -4}, {0, 0, 1}}, diffuse(0.5));
  if (const auto missing = embree_missing()) {
    EXPECT_TRUE(holds(missing->message.find("embree: ") == 0)) << missing->message;
    EXPECT_THROW((void)make_accelerator(scene, AcceleratorKind::embree), ContractViolation);
    return;
  }
  const BruteForce brute(scene);
  const auto embree = make_accelerator(scene, AcceleratorKind::embree);
  Random random(1572);
  std::uint64_t wrong = 0, decided = 0, aimed = 0, differ = 0;
  for (int trial = 0; trial < 6000; ++trial) {
    Ray ray = ray_at(mesh, {1, 2, 3}, 1, random, brute, trial);
    if (trial % 10 == 0) ray.t_max = random.scale(1e-3, 1e3) / ray.direction.norm();
    const auto expected = brute.nearest(ray).hit, found = embree->nearest(ray).hit;
    const bool blocked = embree->obstruction(ray).blocked;
    const bool agrees = same(found, expected) && blocked == expected.has_value();
    const bool true_hit =
        found && same(found, SceneHit{intersect(ray, scene, {found->object, found->part}).value_or(Hit{}),
                                      found->object, found->part});
    const bool any = trial % 4 == 0, from_inside = (trial & 4) && trial % 4 != 3;
    decided += 2;
    wrong += found && !true_hit;
    wrong += any ? !agrees : from_inside && expected && (!found || found->object > 1 || !blocked);
    aimed += !any;
    differ += !any && !agrees;
  }
  EXPECT_TRUE(all_agree(wrong, decided));
  EXPECT_TRUE(within(static_cast<double>(differ), 0.01 * static_cast<double>(aimed))) << differ << " of " << aimed;
}

}  // namespace
}  // namespace etendue::validation
