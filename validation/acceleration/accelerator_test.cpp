// SPDX-License-Identifier: Apache-2.0
#include "etendue/acceleration/accelerator.hpp"

#include <bit>
#include <random>

#include "etendue/acceleration/bounding_volumes.hpp"
#include "etendue/acceleration/brute_force.hpp"
#include "support/evidence.hpp"
#include "support/scene_builder.hpp"

namespace etendue::validation {
namespace {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Vec3 point(double extent) {
    const double x = in(-extent, extent), y = in(-extent, extent), z = in(-extent, extent);
    return {x, y, z};
  }
  Vec3 direction() {
    Vec3 v = point(1);
    while (v.norm() < 0.1) v = point(1);
    return v.normalized();
  }
  std::size_t index(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(engine_); }

 private:
  std::mt19937_64 engine_;
};

Shape random_shape(Random& random, std::size_t kind, double extent) {
  const Vec3 centre = random.point(extent);
  const double size = random.in(0.1, 0.8);
  switch (kind % 7) {
    case 0:
      return Sphere{centre, size};
    case 1:
      return square(centre, random.direction(), size);
    case 2:
      return Triangle{centre, centre + random.point(1), centre + random.point(1)};
    case 3:
      return Disc{centre, random.direction(), size};
    case 4:
      return Cylinder{centre, centre + random.point(2), 0.3 * size};
    case 5: {
      const Vec3 x = random.direction();
      const Vec3 y = x.unitOrthogonal();
      Mat3 axes;
      axes << x, y, x.cross(y);
      return Box{centre, axes, Vec3::Constant(size)};
    }
    default:
      break;
  }
  Mesh mesh;  // an octahedron
  for (int axis = 0; axis < 3; ++axis) {
    mesh.vertices.push_back(centre + size * Vec3::Unit(axis));
    mesh.vertices.push_back(centre - size * Vec3::Unit(axis));
  }
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return mesh;
}

Scene random_scene(Random& random, std::size_t count) {
  Scene scene;
  for (std::size_t i = 0; i < count; ++i) add(scene, random_shape(random, i, 6), diffuse(0.5));
  add(scene, Plane{{0, 0, -7}, {0, 0, 1}}, diffuse(0.5));
  // The same shapes once more: every hit on them is a tie, which the smaller index has to win.
  for (std::size_t i = 0; i < count / 4; ++i) add(scene, scene.objects[random.index(count)].shape, diffuse(0.5));
  return scene;
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool same(const std::optional<SceneHit>& a, const std::optional<SceneHit>& b) {
  if (a.has_value() != b.has_value()) return false;
  if (!a) return true;
  bool equal = a->object == b->object && a->part == b->part && same_bits(a->hit.t, b->hit.t);
  for (int k = 0; k < 3; ++k) {
    equal = equal && same_bits(a->hit.point[k], b->hit.point[k]) && same_bits(a->hit.normal[k], b->hit.normal[k]);
  }
  return equal;
}

/// Rays that are hard on boxes: random, along axes, aimed at corners of boxes, leaving from a surface, with an end.
Ray random_ray(Random& random, const BoundingVolumes& volumes, std::size_t trial) {
  Ray ray;
  ray.origin = random.point(trial % 3 == 0 ? 100 : 8);
  ray.direction = random.direction();
  if (trial % 4 == 1) ray.direction = (trial % 8 == 1 ? 1 : -1) * Vec3::Unit(static_cast<int>(trial % 3));
  if (trial % 4 == 2) {
    const Aabb& box = volumes.nodes()[random.index(volumes.nodes().size())].box;
    const Vec3 corner(random.index(2) ? box.low.x() : box.high.x(), random.index(2) ? box.low.y() : box.high.y(),
                      random.index(2) ? box.low.z() : box.high.z());
    ray.direction = (corner - ray.origin).normalized();
  }
  if (trial % 5 == 0) {
    if (const auto met = volumes.nearest(ray).hit) {
      ray.origin = met->hit.point;
      ray.direction = random.direction();
    }
  }
  if (trial % 7 == 0) ray.t_max = random.in(0, 20);
  return ray;
}

// CLAIM      IU.5.7, IU.5.7.1, RT.3: the hierarchy of boxes finds exactly what brute force finds, object, part, t,
//            point and normal, ties and limited rays included; brute force finds the first of all surfaces; both know
//            when nothing is met.
// ORACLE     identity: a plain loop over all objects, written out here.
// TOLERANCE  none: all bits.
TEST(Accelerator, FindsWhatBruteForceFinds) {
  proves({"IU.5.7", "IU.5.7.1", "RT.3", "R8"}, Oracle::identity, "a plain loop over all surfaces, bit for bit");
  Random random(57);
  std::uint64_t wrong = 0, decisions = 0, hits = 0, ties = 0;
  for (int round = 0; round < 20; ++round) {
    const Scene scene = random_scene(random, 1 + static_cast<std::size_t>(round) * 4);
    const BruteForce brute(scene);
    const BoundingVolumes volumes(scene);
    for (std::size_t trial = 0; trial < 1000; ++trial) {
      const Ray ray = random_ray(random, volumes, trial);
      std::optional<SceneHit> expected;
      for (std::size_t object = 0; object < scene.objects.size(); ++object) {
        const auto* mesh = std::get_if<Mesh>(&scene.objects[object].shape);
        for (std::size_t part = 0; part < (mesh ? mesh->triangles.size() : 1); ++part) {
          const auto hit =
              mesh ? intersect(ray, mesh->triangle(part))
                   : std::visit([&](const auto& shape) { return intersect(ray, shape); }, scene.objects[object].shape);
          if (hit && expected && hit->t == expected->hit.t) ++ties;
          if (hit && (!expected || hit->t < expected->hit.t)) expected = SceneHit{*hit, object, part};
        }
      }
      decisions += 4;
      if (expected) ++hits;
      if (!same(brute.nearest(ray).hit, expected)) ++wrong;
      if (!same(volumes.nearest(ray).hit, expected)) ++wrong;
      if (brute.obstruction(ray).blocked != expected.has_value()) ++wrong;
      if (volumes.obstruction(ray).blocked != expected.has_value()) ++wrong;
    }
  }
  EXPECT_TRUE(all_agree(wrong, decisions));
  EXPECT_GT(hits, 5000u);  // the family did hit, and did tie
  EXPECT_GT(ties, 200u);
}

// CLAIM      IU.5.7.1: every node's box holds the boxes of its parts, every surface is in one leaf, planes are kept
//            aside; the hierarchy tests a small part of what brute force tests.
// ORACLE     identity: the definition of a bounding volume; counts.
// TOLERANCE  none; the saving on 2,000 small spheres is at least twentyfold (measured: more than a hundredfold).
TEST(Accelerator, BoundsVolumesByVolumes) {
  proves({"IU.5.7.1", "IU.5.7"}, Oracle::identity, "containment of boxes, and counted tests");
  Random random(571);
  Scene scene;
  for (int i = 0; i < 2000; ++i) add(scene, Sphere{random.point(20), 0.2}, diffuse(0.5));
  add(scene, Plane{{0, 0, -30}, {0, 0, 1}}, diffuse(0.5));
  const BoundingVolumes volumes(scene);
  const BruteForce brute(scene);
  ASSERT_EQ(volumes.bounded().size(), 2000u);
  ASSERT_EQ(volumes.unbounded().size(), 1u);
  std::vector<int> seen(scene.objects.size(), 0);
  for (const Surface& surface : volumes.bounded()) ++seen[surface.object];
  for (std::size_t object = 0; object < 2000; ++object) ASSERT_EQ(seen[object], 1);
  const auto encloses = [](const Aabb& outer, const Aabb& inner) {
    return (outer.low.array() <= inner.low.array()).all() && (outer.high.array() >= inner.high.array()).all();
  };
  const auto& nodes = volumes.nodes();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].count == 0) {
      ASSERT_TRUE(holds(encloses(nodes[i].box, nodes[i + 1].box) && encloses(nodes[i].box, nodes[nodes[i].first].box)));
    }
    for (std::size_t k = 0; k < nodes[i].count; ++k) {
      ASSERT_TRUE(holds(encloses(nodes[i].box, *bounds(scene, volumes.bounded()[nodes[i].first + k]))));
    }
  }
  TestCount saved, all;
  for (int trial = 0; trial < 300; ++trial) {
    const Ray ray{random.point(30), random.direction()};
    saved += volumes.nearest(ray).tests;
    all += brute.nearest(ray).tests;
  }
  EXPECT_TRUE(holds(20 * saved.surfaces < all.surfaces));
}

}  // namespace
}  // namespace etendue::validation
