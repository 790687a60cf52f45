// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/media.hpp"

#include <cmath>

#include "etendue/core/rounding.hpp"
#include "etendue/raytracing/camera_rays.hpp"
#include "etendue/raytracing/render.hpp"
#include "optics/incidence.hpp"
#include "support/evidence.hpp"
#include "support/scene_builder.hpp"

// Rays through bodies in bodies: what is around them, which way they go, and what is left of the light.
namespace etendue::validation {
namespace {

constexpr double u = kUnitRoundoff;

/// Clear, with nothing but an index.
Material clear(double eta, double k_t = 1) {
  return specular(0, k_t, eta);
}

RayTree through(const Scene& scene, const Ray& ray, const TreeLimits& limits = {20, 0}) {
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  return trace(ray, *accelerator, limits, {media_around(ray.origin, *accelerator)});
}

/// Distance of the ray's line from a point.
double distance_from(const Ray& ray, const Vec3& point) {
  return ray.direction.cross(point - ray.origin).norm();
}

/// Water of radius 9, in it glass of radius 4, in it a bubble: all around one centre.
constexpr double kWater = 1.33, kGlass = 1.5, kAir = 1;
Scene shells(const Vec3& centre) {
  Scene scene;
  add(scene, Sphere{centre, 4}, clear(kGlass), "glass");
  add(scene, Sphere{centre, 9}, clear(kWater), "water");
  add(scene, Sphere{centre, 1}, clear(kAir), "bubble");
  return scene;
}

/// One refraction errs by 12.5 u in direction, one hit by 60 u of the coordinates, below 40: a line seven surfaces on.
constexpr double kPathError = 1e4 * u;

// CLAIM      IU.4-6, IU.5-7 with nested media: a ray through a bubble in glass in water keeps n times its distance from
//            the common centre, in each shell, and leaves turned by the sum of all bends.
// ORACLE     closed form: Bouguer's invariant n p, and the angle Σ 2 (asin(p/r) − asin(p'/r)) over the shells, per ray.
// TOLERANCE  kPathError for p; the same for the angle, which changes by less than 4 dp for p < 0.9 of each radius.
TEST(Media, MakeABubbleInGlassInWaterRight) {
  proves({"IU.4-6", "IU.5-7"}, Oracle::closed_form, "Bouguer's invariant in concentric shells");
  Directions random(5201);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 centre = 5 * random.unit(), out = random.unit();
    const double p = random.uniform(0, 0.9);
    const Vec3 direction = out, aside = random.orthogonal_to(direction);
    const Scene scene = shells(centre);
    const RayTree tree = through(scene, {centre + p * aside - 20 * direction, direction});
    ASSERT_EQ(tree.nodes.size(), 7u);
    const double index[7] = {1, kWater, kGlass, kAir, kGlass, kWater, 1};
    for (std::size_t i = 0; i < 7; ++i) {
      EXPECT_TRUE(near(distance_from(tree.nodes[i].ray, centre), p / index[i], kPathError)) << i;
    }
    EXPECT_TRUE(holds(tree.nodes.back().media.empty()));
    const auto bend = [&](double radius, double from, double to) {
      return std::asin(p / from / radius) - std::asin(p / to / radius);
    };
    const double turned = 2 * (bend(9, 1, kWater) + bend(4, kWater, kGlass) + bend(1, kGlass, kAir));
    const Vec3 leaving = tree.nodes.back().ray.direction;
    EXPECT_TRUE(near(std::atan2(-leaving.dot(aside), leaving.dot(direction)), turned, 4 * kPathError));
  }
}

// CLAIM      The eye may stand in any of the bodies: its rays leave with the same invariant; a path back is the path there.
// ORACLE     closed form: p_out = n p, from points in the bubble, the glass, the water, and outside.
// TOLERANCE  kPathError.
TEST(Media, BeginWithThoseAroundTheEye) {
  proves({"IU.4-6"}, Oracle::closed_form, "Bouguer's invariant from inside the shells");
  Directions random(5202);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 centre = 5 * random.unit(), aside = random.unit(), direction = random.orthogonal_to(aside);
    const Scene scene = shells(centre);
    for (const auto& [along, index] : {std::pair(0.2, kAir), std::pair(2.0, kGlass), std::pair(6.0, kWater)}) {
      const double p = random.uniform(0, 0.5);
      const RayTree tree = through(scene, {centre + p * aside + along * direction, direction});
      const RayNode& last = tree.nodes.back();
      ASSERT_EQ(last.end, RayEnd::left_scene);
      EXPECT_TRUE(near(distance_from(last.ray, centre), index * p, kPathError)) << along;
      // Time runs backwards as well as forwards.
      const RayTree back = through(scene, {last.ray.at(30), -last.ray.direction});
      EXPECT_TRUE(within(distance_from(back.nodes[tree.nodes.size() - 1].ray, tree.nodes[0].ray.origin), kPathError));
    }
    const auto accelerator = make_accelerator(scene, AcceleratorKind::octree);
    EXPECT_TRUE(holds(media_around(centre + 9.5 * direction, *accelerator).empty()));
  }
}

// CLAIM      A plane bounds the half-space behind it, a box of six polygons is a box: an eye there is inside, and rays leave
//            refracted; a single pane, seen from behind, holds nothing.
// ORACLE     closed form: Snell's sine for the flat side; the solid box, ray by ray.
// TOLERANCE  refraction_error twice and the hits' roundings: kPathError.
TEST(Media, AreBoundedByFlatObjectsTogether) {
  proves({"IU.4-6"}, Oracle::metamorphic, "six polygons against the box that they bound");
  const double h = 1.5;
  Scene solid, faces;
  add(solid, Box{{0, 0, 0}, Mat3::Identity(), {h, h, h}}, clear(kGlass));
  faces.materials = {clear(kGlass)};
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      Vec3 normal = Vec3::Zero();
      normal[axis] = sign;
      faces.objects.push_back({"face", square(h * normal, normal, h), 0, {}});
    }
  }
  Directions random(5203);
  for (int trial = 0; trial < 300; ++trial) {
    const bool inside = trial % 3 == 0;
    const Vec3 from = inside ? Vec3(random.unit()) : Vec3(6 * random.unit());
    const Vec3 aim = 1.2 * random.unit();
    const Ray ray{from, (aim - from).normalized()};
    const RayTree one = through(solid, ray), six = through(faces, ray);
    ASSERT_EQ(one.nodes.size(), six.nodes.size());
    for (std::size_t i = 0; i < one.nodes.size(); ++i) {
      EXPECT_TRUE(within((one.nodes[i].ray.direction - six.nodes[i].ray.direction).norm(), kPathError));
    }
  }
  Scene half, pane;
  add(half, Plane{{0, 0, 0}, {0, 0, 1}}, clear(kGlass));
  add(pane, square({0, 0, 0}, {0.1, -0.2, 1}, 50), clear(kGlass));
  const auto below = make_accelerator(half, AcceleratorKind::bounding_volumes);
  EXPECT_TRUE(holds(!media_around({1, 2, -3}, *below).empty() && media_around({1, 2, 3}, *below).empty()));
  const auto single = make_accelerator(pane, AcceleratorKind::bounding_volumes);
  EXPECT_TRUE(holds(media_around({0, 0, -3}, *single).empty() && media_around({0, 0, 3}, *single).empty()));
}

// CLAIM      Where bodies overlap the one of higher priority counts: ice of priority 1 hides the water's surface inside it,
//            whichever is entered first; with equal priorities, the one that was entered last.
// ORACLE     closed form: the slabs' refracted sines, sin θ / n in each stretch.
// TOLERANCE  two roundings of a sine and refraction_error for each surface: kPathError.
TEST(Media, CountByPriorityWhereTheyOverlap) {
  proves({"IU.4-6"}, Oracle::closed_form, "Snell's sines in overlapping slabs");
  const double ice = 1.31, sine = 0.6;
  const auto stretches = [&](int priority, bool from_above) {
    Scene scene;
    Material frozen = clear(ice);
    frozen.priority = priority;
    add(scene, Box{{0, 0, 1}, Mat3::Identity(), {50, 50, 2}}, frozen);          // from −1 to 3
    add(scene, Box{{0, 0, -4}, Mat3::Identity(), {60, 60, 4}}, clear(kWater));  // from −8 to 0
    const double way = from_above ? -1 : 1;
    return through(scene, {{0, 0, -20 * way}, {sine, 0, 0.8 * way}});
  };
  const auto check = [&](const RayTree& tree, const std::vector<double>& indices) {
    ASSERT_EQ(tree.nodes.size(), indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i) {
      EXPECT_TRUE(near(tree.nodes[i].ray.direction.x(), sine / indices[i], kPathError)) << i;
    }
  };
  check(stretches(1, true), {1, ice, kWater, 1});
  check(stretches(1, false), {1, kWater, ice, 1});
  check(stretches(0, true), {1, ice, kWater, 1});  // the water was entered last: its surface, at 0, is seen
  const RayTree hidden = stretches(1, true), shown = stretches(0, true);
  EXPECT_TRUE(near(hidden.nodes[1].hit->hit.point.z(), -1, 40 * u));
  EXPECT_TRUE(near(shown.nodes[1].hit->hit.point.z(), 0, 40 * u));
  EXPECT_TRUE(near(hidden.nodes[1].length, 4 / std::sqrt(1 - sine * sine / (ice * ice)), kPathError));
}

// CLAIM      A sphere of η = 1 that lets all light through leaves the picture unchanged, to the last bit; so do spheres in
//            spheres of one index, inside.
// ORACLE     metamorphic: the same scene without them.
// TOLERANCE  none.
TEST(Media, ChangeNoBitWhereTheIndexIsTheSame) {
  proves({"IU.5-2", "IU.5-7"}, Oracle::metamorphic, "the picture without the sphere");
  Scene scene;
  add(scene, Plane{{0, 0, 0}, {0, 0, 1}}, diffuse(0.7));
  add(scene, Sphere{{0.3, 2, 1}, 1}, specular(0.4, 0));
  add(scene, Sphere{{-1.5, 1, 0.6}, 0.6}, diffuse(0.5));
  scene.materials[2].k_s = 0.5;
  scene.materials[2].phong_exponent = 30;
  scene.lights = {PointLight{{-4, -6, 9}, {1, 0.9, 0.8}}};
  scene.ambient = Rgb::Constant(0.2);
  scene.background = {0.1, 0.2, 0.4};
  scene.camera.eye = {0.2, -7, 2.5};
  scene.camera.gaze = {0, 1, -0.2};
  scene.camera.columns = 90;
  scene.camera.rows = 60;
  const auto picture = [](const Scene& each) {
    RenderOptions options;
    options.limits.depth = 20;  // surfaces that change nothing take a level each
    return render(*make_accelerator(each, AcceleratorKind::bounding_volumes), options, {}).value().image;
  };
  const Image plain = picture(scene);
  Scene with = scene;
  add(with, Sphere{{-0.5, 0, 1.2}, 1.1}, clear(1));
  add(with, Sphere{{0.4, -2, 1.2}, 0.7}, clear(1));
  std::uint64_t different = 0, crossed = 0;
  const auto accelerator = make_accelerator(with, AcceleratorKind::bounding_volumes);
  const Image same = picture(with);
  for (std::size_t i = 0; i < plain.pixels.size(); ++i) different += (plain.pixels[i] != same.pixels[i]).any();
  EXPECT_TRUE(all_agree(different, plain.pixels.size()));
  const auto frame = camera_frame(with.camera).value();
  for (int column = 0; column < 90; ++column) {
    crossed += trace(eye_ray(frame, picture_point(with.camera, column, 30)), *accelerator, {}).nodes.size() > 2;
  }
  EXPECT_GT(crossed, 20u) << "the spheres stand in the picture";
}

// CLAIM      Beer along the path: what is seen through a slab or a ball of absorbing glass is weakened by exp(−σ d), d the way
//            in it, per channel; so is what an eye inside sees; the background behind an endless one is black.
// ORACLE     closed form: thickness over the refracted cosine; the chord of a ball of η = 1; the eye's distance to the side.
// TOLERANCE  lengths err by kPathError, absolutely; the exponential and the product by 4 u.
TEST(Media, AbsorbAlongTheWay) {
  proves({"IU.5-2"}, Oracle::closed_form, "exp(−σ d) for slab, ball, eye inside, and endless glass");
  const Rgb sigma(0.1, 0.5, 2);
  const auto seen = [](const Scene& scene, const Ray& ray) {
    const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
    return shade(trace(ray, *accelerator, {}, {media_around(ray.origin, *accelerator)}), *accelerator).colour;
  };
  const auto expect = [&](const Rgb& colour, double share, double length) {
    for (int k = 0; k < 3; ++k) {
      const double expected = share * std::exp(-sigma[k] * length);
      EXPECT_TRUE(near(colour[k], expected, expected * (sigma[k] * kPathError + 16 * u)));
    }
  };
  Material glass = clear(kGlass, 0.9);
  glass.absorption = sigma;
  Scene slab, ball, half;
  add(slab, Box{{0, 0, 0}, Mat3::Identity(), {50, 50, 0.75}}, glass);
  add(half, Plane{{0, 0, 0}, {0, 0, 1}}, glass);
  glass.eta = 1;
  add(ball, Sphere{{1, 2, 3}, 2}, glass);
  for (Scene* scene : {&slab, &ball, &half}) scene->background = Rgb::Ones();
  for (const double sine : {0.0, 0.28, 0.6, 0.96}) {
    const double cosine = std::sqrt(1 - sine * sine), inside = std::sqrt(1 - sine * sine / (kGlass * kGlass));
    expect(seen(slab, {{-3, 1, 5}, {sine, 0, -cosine}}), 0.81, 1.5 / inside);
    expect(seen(slab, {{-3, 1, 0.25}, {0, 0, -1}}), 0.9, 1);
    expect(seen(ball, {{1 + 2 * sine, 2, 30}, {0, 0, -1}}), 0.81, 4 * cosine);
    expect(seen(ball, {{1 + 2 * sine, 2, 3}, {0, 0, -1}}), 0.9, 2 * cosine);
    EXPECT_TRUE(holds((seen(half, {{-3, 1, 2}, {sine, 0, -cosine}}) == 0).all()));
  }
}

}  // namespace
}  // namespace etendue::validation
