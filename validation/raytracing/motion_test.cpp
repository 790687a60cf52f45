// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "etendue/acceleration/surface_list.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/raytracing/render.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"
#include "support/scene_builder.hpp"

// Objects that move while the shutter is open.
namespace etendue::validation {
namespace {

constexpr double u = kUnitRoundoff;

Material emitting() {
  Material material;
  material.emission = Rgb::Ones();
  return material;
}

void add_moving(Scene& scene, Shape shape, const Vec3& velocity, const Material& material) {
  scene.objects[add(scene, std::move(shape), material)].velocity = velocity;
}

constexpr int kSide = 16;
RenderOptions many_samples() {
  RenderOptions options;
  options.sampling.scheme = SamplingScheme::jittered;
  options.sampling.samples_per_side = kSide;
  return options;
}

// CLAIM      Motion blur: an edge that passes with the shutter open is a ramp, as wide as its way; a pixel shows the share of the time
//            for which the edge has passed it.
// ORACLE     closed form: that share is linear.
// TOLERANCE  of 256 parts of the time, each with one sample, all but those in which the edge is within the pixel are decided: the pixel's
//            share of the way, and two parts for its ends.
TEST(Motion, BlursAnEdgeIntoARamp) {
  proves({}, Oracle::closed_form, "a linear ramp");
  constexpr double kShutter = 0.5, kSpeed = 4;
  Scene scene;
  add_moving(scene, Polygon::make({{-90, -90, 4}, {-1, -90, 4}, {-1, 90, 4}, {-90, 90, 4}}).value(), {kSpeed, 0, 0},
             emitting());
  scene.camera = straight(256, 1, kShutter);  // at z = 4 the picture is 8 wide, a pixel 1/32
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  const Image image = render(*accelerator, many_samples(), {}).value().image;
  constexpr double kBound = 1.0 / 32 / (kSpeed * kShutter) + 2.0 / (kSide * kSide);
  for (int column = 0; column < 256; ++column) {
    const double x = (column + 0.5) / 32 - 4;
    const double expected = std::clamp(1 - (x + 1) / (kSpeed * kShutter), 0.0, 1.0);
    EXPECT_TRUE(near(image.at(column, 0)[0], expected, kBound)) << column;
  }
}

/// For which share of the time in [0, shutter] a moving sphere hides the line from the origin: |(c + v t) × d| ≤ r.
double covered(const Vec3& centre, const Vec3& velocity, double radius, const Vec3& direction, double shutter) {
  const Vec3 p = centre.cross(direction), q = velocity.cross(direction);
  const double a = q.squaredNorm(), b = p.dot(q), c = p.squaredNorm() - radius * radius, root = b * b - a * c;
  if (root <= 0) return 0;
  const double from = std::clamp((-b - std::sqrt(root)) / a, 0.0, shutter);
  return (std::clamp((-b + std::sqrt(root)) / a, 0.0, shutter) - from) / shutter;
}

// CLAIM      Motion blur: a sphere that flies by covers a pixel for as long as its chord takes, in any direction.
// ORACLE     closed form: a quadratic in time for the ray through the pixel's centre.
// TOLERANCE  within a pixel, 1/64 wide at the distance 1, the ends of that time differ by what the silhouette moves over the pixel: where the chord is
//            half a radius or longer, by √(r² − h²) ≥ r/4 less than 4 · ½ diagonal; and two of 256 parts of the time.
TEST(Motion, CoversAPixelForAsLongAsItTakes) {
  proves({}, Oracle::closed_form, "chord of a moving sphere");
  constexpr double kShutter = 2, kRadius = 0.25;
  const Vec3 start(-0.6, 0.3, 2), velocity(0.5, -0.2, 0);
  Scene scene;
  add_moving(scene, Sphere{start, kRadius}, velocity, emitting());
  scene.camera = straight(128, 64, kShutter);
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  const Image image = render(*accelerator, many_samples(), {}).value().image;
  const double way = velocity.norm() * kShutter, pixel = 2 * std::sqrt(2.0) / 64;
  int long_chords = 0;
  for (int row = 0; row < 64; ++row) {
    for (int column = 0; column < 128; ++column) {
      const Vec3 line = Vec3((column + 0.5) / 64 - 1, (row + 0.5) / 64 - 0.5, 1).normalized();
      // With "up" along −y, rows run along y.
      const double expected = covered(start, velocity, kRadius, line, kShutter);
      const double chord = expected * way;
      if (chord < kRadius / 2 && image.at(column, row)[0] > 0) continue;
      if (chord >= kRadius / 2) ++long_chords;
      const double bound = 2 * 4 * pixel / 2 / way + 2.0 / (kSide * kSide);
      EXPECT_TRUE(near(image.at(column, row)[0], expected, bound)) << column << " " << row;
    }
  }
  EXPECT_GT(long_chords, 300);
}

// CLAIM      Motion blur: shadows and mirror images move with what throws them: at each instant the floor below is dark, the mirror shows the
//            object, where it is then.
// ORACLE     closed form: positions.
// TOLERANCE  none for what is lit; the place in the mirror to 32 roundings of coordinates up to 8.
TEST(Motion, TakesShadowAndMirrorImageAlong) {
  proves({}, Oracle::closed_form, "places at an instant");
  Scene scene;
  scene.camera.shutter = 1;
  add(scene, Plane{{0, 0, 0}, {0, 0, 1}}, specular(0.5, 0));
  scene.materials.back().k_d = Rgb::Ones();
  add_moving(scene, square({-2, 0, 1}, {0, 0, 1}, 0.25), {4, 0, 0}, diffuse(1));
  scene.lights.push_back(DirectionalLight{{0, 0, 1}, Rgb::Ones()});
  for (const AcceleratorKind kind :
       {AcceleratorKind::brute_force, AcceleratorKind::bounding_volumes, AcceleratorKind::bounding_spheres,
        AcceleratorKind::grid, AcceleratorKind::octree}) {
    const auto accelerator = make_accelerator(scene, kind);
    for (const double time : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      for (const double x : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
        // Onto the floor at (x, 0), and by its mirror up through (x, 0, 1).
        Ray ray;
        ray.origin = {x, -4, 4};
        ray.direction = Vec3(0, 1, -1).normalized();
        ray.time = time;
        const RayTree tree = trace(ray, *accelerator, {1, 0});
        const bool below = x == -2 + 4 * time;
        EXPECT_TRUE(holds((local_illumination(tree.nodes[0], *accelerator).colour[0] == 0) == below))
            << time << " " << x;
        ray.origin = {x, -5, 4};  // the mirrored ray passes (x, 0, 1)
        const RayTree mirrored = trace(ray, *accelerator, {1, 0});
        ASSERT_EQ(mirrored.nodes.size(), 2u);
        EXPECT_EQ(mirrored.nodes[1].hit.has_value(), below) << time << " " << x;
        if (below) {
          EXPECT_TRUE(within((mirrored.nodes[1].hit->hit.point - Vec3(x, 0, 1)).norm(), 32 * 8 * u));
        }
      }
    }
  }
}

// CLAIM      What moves is met where the same shape, moved there, is met: t, point, normal; the point's bound and the surface's hold.
// ORACLE     identity: a shape that was moved by hand.
// TOLERANCE  the sum of both bounds on the points; of t, as much over the sine of incidence, 1 for the family; normals: 2^-40 for the change of
//            the place on a sphere of radius ½.
TEST(Motion, MeetsWhatIsMovedByHand) {
  proves({}, Oracle::identity, "a shape moved by hand");
  CounterRandom random(58);
  uses_seed(58);
  const auto vector = [&](double size) {
    const double x = random.between(-size, size), y = random.between(-size, size);
    return Vec3(x, y, random.between(-size, size));
  };
  std::uint64_t hits = 0, wrong = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Vec3 centre = vector(3), velocity = vector(4);
    const double time = random.unit();
    const Vec3 way = time * velocity;
    const Vec3 normal = vector(1).normalized();
    Scene moving, by_hand;
    moving.camera.shutter = 1;
    const int kind = trial % 3;
    const auto shape_at = [&](const Vec3& at) -> Shape {
      if (kind == 0) return Sphere{at, 0.5};
      if (kind == 1) return Disc{at, normal, 0.5};
      return square(at, normal, 0.5);
    };
    add_moving(moving, shape_at(centre), velocity, diffuse(1));
    add(by_hand, shape_at(centre + way), diffuse(1));
    Ray ray;
    ray.origin = vector(8);
    ray.direction = (centre + way + vector(0.3) - ray.origin).normalized();
    ray.time = time;
    const auto a = intersect(ray, moving, Surface{0, 0}), b = intersect(ray, by_hand, Surface{0, 0});
    if (!a || !b) {
      // Only within rounding of an edge may they differ.
      wrong += a.has_value() != b.has_value() ? 1u : 0u;
      continue;
    }
    ++hits;
    const double sine = std::abs(b->normal.dot(ray.direction));
    // The shape that was moved by hand stands where it should to one rounding a coordinate.
    const double bound = a->point_error + b->point_error + 4 * u * (centre.lpNorm<1>() + way.lpNorm<1>()) / sine;
    EXPECT_TRUE(within((a->point - b->point).norm(), bound));
    EXPECT_TRUE(near(a->t, b->t, 2 * bound));
    if (sine > 0.1) {
      EXPECT_TRUE(within((a->normal - b->normal).norm(), 0x1p-40));
    }
    const auto box = bounds(moving, Surface{0, 0});
    ASSERT_TRUE(box);
    EXPECT_TRUE(holds((a->point.array() >= box->low.array()).all() && (a->point.array() <= box->high.array()).all()));
  }
  EXPECT_TRUE(all_agree(wrong, 3000));
  EXPECT_GT(hits, 2000u);
}

// CLAIM      A pattern moves with its object; what glass an eye stands in is asked at the time of its ray.
// ORACLE     identity: the same place on the object, the same answer.
// TOLERANCE  none: dyadic numbers.
TEST(Motion, TakesPatternsAndBodiesAlong) {
  proves({}, Oracle::identity, "the same place on the object");
  Scene scene;
  scene.camera.shutter = 1;
  scene.ambient = Rgb::Ones();
  Material squares = diffuse(1);
  squares.pattern =
      MaterialPattern{Checkerboard{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 1}, Rgb::Constant(0.25), Rgb::Constant(0.25)};
  add_moving(scene, Box{{0, 0, 0}, Mat3::Identity(), {8, 8, 0.5}}, {3, 0, 0}, squares);
  add_moving(scene, Sphere{{0, 0, 40}, 2}, {8, 0, 0}, specular(0, 1, 1.5));
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  for (const double time : {0.0, 0.25, 0.5, 1.0}) {
    for (const double x : {-2.5, -1.5, 0.5}) {
      Ray down;
      down.origin = {x + 3 * time, 0.5, 4};
      down.direction = {0, 0, -1};
      down.time = time;
      const RayTree tree = trace(down, *accelerator, {0, 0});
      EXPECT_EQ(local_illumination(tree.nodes[0], *accelerator).colour[0], x == -2.5 ? 0.25 : 1) << x;
    }
    for (const double x : {0.5, 2.5, 4.5, 8.5}) {
      EXPECT_EQ(media_around({x, 0, 40}, *accelerator, time).empty(), std::abs(x - 8 * time) > 2) << x << " " << time;
    }
  }
}

// CLAIM      With the shutter closed, or open for an instant, nothing moves: the picture is that of the scene at rest.
// ORACLE     metamorphic: the same objects without velocities.
// TOLERANCE  none: all bits.
TEST(Motion, IsNotSeenWithTheShutterClosed) {
  proves({}, Oracle::metamorphic, "the same objects at rest");
  Scene scene;
  scene.background = Rgb(0.1, 0.2, 0.3);
  add_moving(scene, Sphere{{0.2, 0, 3}, 0.5}, {1, 2, 3}, emitting());
  add_moving(scene, Triangle{{0, 0, 4}, {1, 0, 4}, {0, 1, 3}}, {-1, 2, 3}, emitting());
  scene.camera = straight(32, 32, 0);
  Scene at_rest = scene;
  for (Object& object : at_rest.objects) object.velocity = Vec3::Zero();
  const Image moving = render(*make_accelerator(scene, AcceleratorKind::grid), many_samples(), {}).value().image;
  const Image still = render(*make_accelerator(at_rest, AcceleratorKind::grid), many_samples(), {}).value().image;
  std::uint64_t wrong = 0;
  for (std::size_t i = 0; i < still.pixels.size(); ++i) wrong += (still.pixels[i] != moving.pixels[i]).any() ? 1u : 0u;
  EXPECT_TRUE(all_agree(wrong, still.pixels.size()));
}

}  // namespace
}  // namespace etendue::validation
