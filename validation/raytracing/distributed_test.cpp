// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <numbers>

#include "etendue/core/rounding.hpp"
#include "etendue/raytracing/area_light.hpp"
#include "etendue/raytracing/camera_rays.hpp"
#include "etendue/raytracing/render.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"
#include "support/scene_builder.hpp"

// Soft shadows and depth of field, by distributed samples, against closed forms.
namespace etendue::validation {
namespace {

constexpr double kPi = std::numbers::pi;
/// Five standard deviations: one run in 1.7 million strays so far, and the seeds are fixed.
constexpr double kSigmas = 5;

/// A floor under a narrow light from x = −1 to 1 at the height 2, half hidden by a half-plane x < 0 at the height 1.
Scene penumbra(int samples) {
  Scene scene;
  add(scene, Plane{{0, 0, 0}, {0, 0, 1}}, diffuse(1));
  add(scene, Polygon::make({{-90, -90, 1}, {0, -90, 1}, {0, 90, 1}, {-90, 90, 1}}).value(), diffuse(0));
  scene.lights.push_back(RectangleLight{{-1, -1e-9, 2}, {2, 0, 0}, {0, 2e-9, 0}, Rgb::Ones(), samples});
  return scene;
}

// CLAIM      IU.2.1, distributed sources; a light with an area throws a soft shadow: behind a half-plane the floor has the part of the
//            light that is seen from there, full light beyond the penumbra, none in the umbra.
// ORACLE     closed form: from x the edge hides the light up to s = −x, so I = ½ ∫ h/√(h² + (s − x)²) ds = h/2 [asinh((s − x)/h)],
//            s from max(−1, −x) to 1, h = 2.
// TOLERANCE  statistics: 64 rows of parts, each 1/64 of the light wide; within the one that the edge cuts the visible share has a
//            standard deviation of at most ½ of each of 64 samples, elsewhere the integrand varies by less than 1/64 · ½: 5 σ.
TEST(DistributedRays, ThrowAPenumbra) {
  proves({"IU.2.1"}, Oracle::closed_form, "asinh over the visible part of a narrow light");
  const Scene scene = penumbra(64);
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  constexpr double kEdge = 0.5 / 8 / 64, kElsewhere = 0.5 / 64 / 64;
  for (double x = -1.4; x <= 1.4; x += 0.2) {
    Ray down;
    down.origin = {x, 0, 0.5};
    down.direction = {0, 0, -1};
    const auto met = accelerator->nearest(down).hit;
    ASSERT_TRUE(met);
    RayNode node;
    node.ray = down;
    node.hit = met;
    const double from = std::clamp(-x, -1.0, 1.0);
    const double expected = std::asinh((1 - x) / 2) - std::asinh((from - x) / 2);
    const Shaded found = local_illumination(node, *accelerator, sample_key(1, 0, 0, 0));
    EXPECT_TRUE(near(found.colour[0], expected, kSigmas * (kEdge + kElsewhere))) << x;
    if (x <= -1.2) {
      EXPECT_EQ(found.colour[0], 0);
    }
    EXPECT_EQ(found.shadow_rays, 64u * 64);
  }
}

// CLAIM      IU.2.1: the parts of lights have equal areas: of a rectangle and of a sphere's surface, each has one point, on the light, and an
//            equal share of its intensity.
// ORACLE     identity: z of a sphere is uniform (Archimedes); parts counted.
// TOLERANCE  points: eight roundings of coordinates up to 4; parts none.
TEST(DistributedRays, SeeEachPartOfALightOnce) {
  proves({"IU.2.1"}, Oracle::identity, "equal parts of rectangle and sphere");
  const RectangleLight rectangle{{1, 2, 3}, {0, 2, 0}, {1, 0, 1}, Rgb(1, 2, 3), 5};
  const SphereLight sphere{{1, 2, 3}, 0.5, Rgb(1, 2, 3), 5};
  std::array<int, 25> of_rectangle{}, of_sphere{};
  for (int index = 0; index < 25; ++index) {
    const SampleKey key = sample_key(9, 3, 4, 5);
    const PointLight flat = light_part(rectangle, index, key), round = light_part(sphere, index, key);
    EXPECT_TRUE(near(flat.intensity[1] * 25, 2, 8 * kUnitRoundoff));
    const Vec3 in = flat.position - rectangle.corner;
    EXPECT_TRUE(near(in.x(), in.z(), 32 * kUnitRoundoff));
    ++of_rectangle.at(static_cast<std::size_t>(std::floor(in.y() * 2.5) + 5 * std::floor(in.x() * 5)));
    const Vec3 out = (round.position - sphere.centre) / sphere.radius;
    EXPECT_TRUE(near(out.norm(), 1, 64 * kUnitRoundoff));
    const double turn = std::atan2(out.y(), out.x()) / (2 * kPi);
    ++of_sphere.at(
        static_cast<std::size_t>(std::floor((1 - out.z()) * 2.5) + 5 * std::floor((turn < 0 ? turn + 1 : turn) * 5)));
  }
  std::uint64_t wrong = 0;
  for (std::size_t i = 0; i < 25; ++i) wrong += (of_rectangle[i] == 1 ? 0u : 1u) + (of_sphere[i] == 1 ? 0u : 1u);
  EXPECT_TRUE(all_agree(wrong, 50));
}

// CLAIM      Depth of field: every ray of a picture point passes the same point of the sharp plane, at the distance f, and at the distance z a
//            disc of radius ρ |z − f|/f around the pinhole's ray, all of it.
// ORACLE     closed form: similar triangles.
// TOLERANCE  thirty roundings of lengths up to 8; that the disc is filled: of 500 points one lies beyond 0.98 of the radius and one
//            within 0.1, which fails with a chance of 0.96^500 + 0.99^500 < 1 %; the seed is fixed.
TEST(DistributedRays, BlurWhatIsNotInTheSharpPlane) {
  proves({}, Oracle::closed_form, "similar triangles");
  Camera camera = straight(8, 8);
  camera.lens_radius = 0.1;
  camera.focal_distance = 2;
  const CameraFrame frame = camera_frame(camera).value();
  for (const PicturePoint& point : {PicturePoint{0.5, 0.5}, PicturePoint{0.1, 0.8}}) {
    const Ray sharp = eye_ray(frame, point);
    for (const double z : {1.0, 2.0, 5.0}) {
      const Vec3 middle = sharp.at(z / sharp.direction.z());
      const double radius = 0.1 * std::abs(z - 2) / 2;
      double least = 1, largest = 0;
      for (int i = 0; i < 500; ++i) {
        const Ray ray = sample_ray(camera, frame, point, sample_key(2, 1, 1, i));
        const Vec3 met = ray.at((z - ray.origin.z()) / ray.direction.z());
        const double share = radius > 0 ? (met - middle).norm() / radius : 0;
        if (radius == 0) {
          EXPECT_TRUE(within((met - middle).norm(), 30 * 8 * kUnitRoundoff));
        }
        least = std::min(least, share);
        largest = std::max(largest, share);
      }
      if (radius == 0) continue;
      EXPECT_TRUE(holds(largest <= 1 + 30 * 8 * kUnitRoundoff / radius && largest > 0.98 && least < 0.1)) << largest;
    }
  }
}

// CLAIM      An edge that is not in the sharp plane is blurred into the share of the lens's disc that lies beyond it.
// ORACLE     closed form: a circle's segment, (acos d − d √(1 − d²))/π.
// TOLERANCE  statistics: 4,096 samples of a yes or no, 5 σ of at most ½/64; a pixel is 1/256 of the disc wide and adds at most that.
TEST(DistributedRays, BlurAnEdgeByASegmentOfTheLens) {
  proves({}, Oracle::closed_form, "segments of a circle");
  Scene scene;
  Material bright;
  bright.emission = Rgb::Ones();
  add(scene, Polygon::make({{0, -90, 4}, {90, -90, 4}, {90, 90, 4}, {0, 90, 4}}).value(), bright);
  scene.camera = straight(2048, 1);  // at z = 4 the picture is 8 wide, a pixel 1/256
  scene.camera.lens_radius = 0.5;
  scene.camera.focal_distance = 2;  // at z = 4 the disc has the radius ½, and is seen mirrored
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  RenderOptions options;
  options.sampling.scheme = SamplingScheme::jittered;
  options.sampling.samples_per_side = 64;
  for (const int column : {904, 960, 1000, 1024, 1060, 1090, 1144}) {
    options.crop = PixelWindow{column, 0, column + 1, 1};
    const double found = render(*accelerator, options, {}).value().image.at(0, 0)[0];
    const double x = (column + 0.5) / 256 - 4, d = std::clamp(-x / 0.5, -1.0, 1.0);
    const double expected = (std::acos(d) - d * std::sqrt(1 - d * d)) / kPi;
    EXPECT_TRUE(near(found, expected, kSigmas * 0.5 / 64 + 1.0 / 256)) << column;
  }
}

// CLAIM      IU.5.7: with a lens and a light with an area all accelerators and any number of threads give the same
//            bits.
// ORACLE     metamorphic: brute force, one thread.
// TOLERANCE  none: all bits.
TEST(DistributedRays, HaveTheSameBitsHoweverTheyAreFound) {
  proves({"IU.5.7"}, Oracle::metamorphic, "brute force, one thread");
  CounterRandom random(5);
  uses_seed(5);
  const auto place = [&] {
    const double x = random.between(-2, 2), y = random.between(-2, 2);
    return Vec3(x, y, random.between(3, 7));
  };
  Scene scene;
  for (int i = 0; i < 8; ++i) {
    const Vec3 at = place();
    add(scene, Sphere{at, 0.3}, diffuse(0.6));
    add(scene, Triangle{at, at + Vec3(1, 0.1, 0), at + Vec3(0, 1, 0.3)}, diffuse(0.5));
    add(scene, square(place(), {1, 2, -3}, 0.4), specular(0.5, 0));
    add(scene, Cylinder{at, at + Vec3(0.3, 0.2, 0.8), 0.1}, diffuse(0.4));
    add(scene, Box{place(), Mat3::Identity(), {0.2, 0.3, 0.1}}, diffuse(0.4));
  }
  scene.lights.push_back(SphereLight{{3, 3, 0}, 0.5, Rgb::Ones(), 2});
  scene.background = Rgb(0.2, 0.3, 0.4);
  scene.camera = straight(40, 30);
  scene.camera.lens_radius = 0.05;
  scene.camera.focal_distance = 5;
  RenderOptions options;
  options.sampling.scheme = SamplingScheme::jittered;
  options.sampling.samples_per_side = 3;
  Execution one, three;
  one.threads = 1;
  three.threads = 3;
  const Rendering reference = render(*make_accelerator(scene, AcceleratorKind::brute_force), options, one).value();
  std::uint64_t wrong = 0, compared = 0;
  for (const AcceleratorKind kind : {AcceleratorKind::bounding_volumes, AcceleratorKind::bounding_spheres,
                                     AcceleratorKind::grid, AcceleratorKind::octree}) {
    const Rendering other = render(*make_accelerator(scene, kind), options, three).value();
    for (std::size_t i = 0; i < other.image.pixels.size(); ++i, ++compared)
      wrong += (other.image.pixels[i] != reference.image.pixels[i]).any() ? 1u : 0u;
    EXPECT_EQ(other.counts.rays(), reference.counts.rays());
  }
  EXPECT_TRUE(all_agree(wrong, compared));
  EXPECT_GT(reference.counts.reflected_rays, 100u);
}

}  // namespace
}  // namespace etendue::validation
