// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/curved_view.hpp"

#include <cmath>
#include <optional>

#include "etendue/form_factor/obstructed.hpp"
#include "etendue/geometry/ray.hpp"
#include "form_factor/shapes.hpp"
#include "oracles/catalogue_truth.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

Vec3 direction(CounterRandom& random) {
  const double z = random.between(-1, 1), turn = random.between(0, 6.283185307179586);
  const double r = std::sqrt(1 - z * z);
  return Vec3(r * std::cos(turn), r * std::sin(turn), z).normalized();
}

Vec3 inside(CounterRandom& random, double margin) {
  const double x = random.between(margin, 1 - margin), y = random.between(margin, 1 - margin);
  return {x, y, random.between(margin, 1 - margin)};
}

/// A room of side 1 with things in three cells of it, so that they are apart.
struct Room {
  std::vector<CurvedPatch> patches;
  std::vector<CurvedBlocker> bodies;

  explicit Room(CounterRandom& random) {
    const auto wall = [&](const Vec3& o, const Vec3& a, const Vec3& b) { patches.emplace_back(rectangle(o, a, b)); };
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
    wall({0, 0, 0}, x, y), wall({0, 0, 1}, y, x), wall({0, 0, 0}, y, z);
    wall({1, 0, 0}, z, y), wall({0, 0, 0}, z, x), wall({0, 1, 0}, x, z);
    const Vec3 cells[] = {{0.27, 0.3, 0.7}, {0.7, 0.3, 0.3}, {0.3, 0.72, 0.3}};
    for (int k = 0; k < 3; ++k) {
      const double size = random.scale(0.01, 0.2);
      const Vec3 axis = direction(random);
      const double share = random.between(0.1, 0.9);
      switch (random.below(4)) {
        case 0:
          add(Sphere{cells[k], size});
          break;
        case 1:  // both sides of a plate
          add(Disc{cells[k], axis, size});
          add(Disc{cells[k], -axis, size});
          break;
        case 2: {
          const Vec3 half = share * size * axis;
          const double radius = std::sqrt(1 - share * share) * size;
          add(Cylinder{cells[k] - half, cells[k] + half, radius});
          patches.emplace_back(Disc{cells[k] - half, -axis, radius});
          patches.emplace_back(Disc{cells[k] + half, axis, radius});
          break;
        }
        default: {
          const Vec3 u = share * size * axis.unitOrthogonal(),
                     v = std::sqrt(1 - share * share) * size * axis.cross(u).normalized();
          const Polygon front = rectangle(cells[k] - u - v, 2 * u, 2 * v),
                        back = rectangle(cells[k] - u - v, 2 * v, 2 * u);
          patches.emplace_back(front), patches.emplace_back(back);
          bodies.emplace_back(Blocker::plate(front));
        }
      }
    }
  }

  template <class Shape>
  void add(const Shape& shape) {
    patches.emplace_back(shape);
    bodies.emplace_back(shape);
  }
};

// CLAIM      IU.6-2, IU.6-4: what an element sees of the walls of a room, of spheres, discs, cylinders and plates in it,
//            each past all the others, sums to one.
// ORACLE     identity: every ray from inside a closed room meets one surface first.
// TOLERANCE  the sum of the returned bounds.
TEST(CurvedView, ClosesFromEveryPointOfARoom) {
  constexpr std::uint64_t kSeed = 31;
  constexpr int kRooms = 700;
  proves({"IU.6-2", "IU.6-4", "IU.6-6"}, Oracle::identity,
         "closure of 700 random rooms with three bodies, from a point each");
  uses_seed(kSeed);
  CounterRandom random(kSeed);
  int partly = 0;
  for (int k = 0; k < kRooms; ++k) {
    const Room room(random);
    std::vector<const CurvedBlocker*> blockers;
    for (const CurvedBlocker& body : room.bodies) blockers.push_back(&body);
    // In the fourth cell, or anywhere on the floor.
    Vec3 eye = Vec3(0.5, 0.5, 0.5) + 0.5 * inside(random, 0.1), normal = direction(random);
    if (k % 3 == 0) eye.z() = 0, normal = Vec3::UnitZ();
    double sum = 0, bound = 0;
    for (const CurvedPatch& patch : room.patches) {
      std::vector<const CurvedBlocker*> others;
      for (const CurvedBlocker* blocker : blockers) {
        const auto* sphere = std::get_if<Sphere>(&patch);
        const auto* tube = std::get_if<Cylinder>(&patch);
        const auto* disc = std::get_if<Disc>(&patch);
        const auto* polygon = std::get_if<Polygon>(&patch);
        const bool own =
            (sphere && std::holds_alternative<Sphere>(*blocker) &&
             std::get<Sphere>(*blocker).centre == sphere->centre) ||
            (tube && std::holds_alternative<Cylinder>(*blocker) && std::get<Cylinder>(*blocker).base == tube->base) ||
            (disc && std::holds_alternative<Disc>(*blocker) && std::get<Disc>(*blocker).centre == disc->centre) ||
            (disc && std::holds_alternative<Cylinder>(*blocker) &&
             (std::get<Cylinder>(*blocker).base == disc->centre || std::get<Cylinder>(*blocker).top == disc->centre)) ||
            (polygon && std::holds_alternative<Blocker>(*blocker) &&
             (std::get<Blocker>(*blocker).points()[0] - polygon->vertices()[0]).norm() == 0);
        if (!own) others.push_back(blocker);
      }
      const Bounded factor = visible_point_to_patch(eye, normal, patch, others);
      partly += factor.value > 0 && factor.value < visible_point_to_patch(eye, normal, patch, {}).value * 0.999;
      sum += factor.value;
      bound += factor.bound;
    }
    EXPECT_TRUE(near(sum, 1, bound)) << k;
  }
  EXPECT_GT(partly, kRooms) << "rooms in which nothing hides anything prove nothing";
}

// CLAIM      IU.6-4: polygons past plates come out as from the other routine of this library, which clips polygons.
// ORACLE     another program part: visible_point_to_polygon has no outlines, no crossings and no arcs.
// TOLERANCE  the sum of both bounds.
TEST(CurvedView, AgreesWithClippedPolygons) {
  constexpr std::uint64_t kSeed = 32;
  proves({"IU.6-4"}, Oracle::program, "clipping of 500 views past two random plates");
  uses_seed(kSeed);
  CounterRandom random(kSeed);
  const auto plate = [&random](const Vec3& centre, double size) {
    const Vec3 axis = direction(random), u = size * axis.unitOrthogonal(), v = random.between(0.2, 1) * axis.cross(u);
    return rectangle(centre - u - v, 2 * u, 2 * v);
  };
  for (int k = 0; k < 500; ++k) {
    const Polygon patch = plate({0, 0, 4}, random.between(0.3, 0.9));
    const double aside = random.between(-0.3, 0.3);
    const std::vector<Polygon> plates{plate({aside, 0.1, 1}, random.between(0.1, 0.4)), plate({0.1, aside, 1.9}, 0.4)};
    const std::vector<CurvedBlocker> bodies{Blocker::plate(plates[0]), Blocker::plate(plates[1])};
    const std::vector<const CurvedBlocker*> blockers{&bodies[0], &bodies[1]};
    const Vec3 normal = (Vec3::UnitZ() + 0.9 * direction(random)).normalized();
    const Bounded ours = visible_point_to_patch(Vec3::Zero(), normal, patch, blockers);
    const Bounded theirs = visible_point_to_polygon(Vec3::Zero(), normal, patch, plates);
    EXPECT_TRUE(near(ours.value, theirs.value, ours.bound + theirs.bound)) << k;
  }
}

// CLAIM      IU.6-2: a sphere anywhere above, across or below the horizon, far and touching.
// ORACLE     closed form: the directions that meet it, integrated by double-exponential rules, 64-bit significand.
// TOLERANCE  the returned bound, 2^-48 for the rounded frame and 1e-15 of the oracle.
TEST(CurvedView, SeesASphereInAnyPosition) {
  constexpr std::uint64_t kSeed = 33;
  proves({"IU.6-2"}, Oracle::closed_form, "rings of directions, cut by the horizon");
  uses_seed(kSeed);
  CounterRandom random(kSeed);
  for (int k = 0; k < 500; ++k) {
    const double radius = random.scale(1e-3, 1), distance = radius * (1 + random.scale(1e-6, 1e3));
    const double height = distance * random.between(-1, 1), aside = std::sqrt(distance * distance - height * height);
    const double turn = random.between(0, 6.28);
    const Vec3 centre(aside * std::cos(turn), aside * std::sin(turn), height);
    const Bounded ours = visible_point_to_patch(Vec3::Zero(), Vec3::UnitZ(), Sphere{centre, radius}, {});
    const double truth = static_cast<double>(oracle::element_to_sphere(height, centre.head<2>().norm(), radius));
    EXPECT_TRUE(near(ours.value, truth, ours.bound + 0x1p-48 + 1e-15)) << k;
  }
}

}  // namespace
}  // namespace etendue::validation
