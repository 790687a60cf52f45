// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "etendue/core/rounding.hpp"
#include "etendue/raytracing/render.hpp"
#include "support/evidence.hpp"
#include "support/exhibit.hpp"
#include "support/scene_builder.hpp"

// Pictures that are known pixel by pixel, from formulas that share nothing with the renderer.
namespace etendue::validation {
namespace {

using Long = long double;
using Long3 = std::array<Long, 3>;

/// A primary ray's direction errs by at most this (validation/raytracing/camera_rays_test.cpp derives it).
constexpr double kDirectionError = 200 * kUnitRoundoff;

Long dot(const Long3& a, const Long3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Long3 plus(const Long3& a, Long t, const Long3& b) {
  return {a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]};
}
Long3 unit(const Long3& a) {
  return plus({0, 0, 0}, 1 / std::sqrt(dot(a, a)), a);
}
Long3 cross(const Long3& a, const Long3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Long3 to_long(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

Long3 pixel_direction(const Camera& camera, int column, int row) {
  const Long3 g = unit(to_long(camera.gaze));
  const Long3 x = unit(cross(g, to_long(camera.up)));
  const Long3 y = cross(x, g);
  const Long tangent = std::tan(static_cast<Long>(camera.horizontal_half_angle));
  const Long across = 2 * (column + 0.5L) / camera.columns - 1;
  const Long up = 1 - 2 * (row + 0.5L) / camera.rows;
  return unit(plus(plus(g, across * tangent, x), up * tangent * camera.rows / camera.columns, y));
}

Rendering rendered(const Scene& scene, const TreeLimits& limits = {}) {
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  RenderOptions options;
  options.limits = limits;
  return render(*accelerator, options, {}).value();
}

Scene lone_sphere() {
  Scene scene;
  scene.camera.eye = {3, -5, 2};
  scene.camera.gaze = Vec3(0.2, 0.3, 0.1) - scene.camera.eye;
  scene.camera.up = {0.1, 0.2, 1};
  scene.camera.horizontal_half_angle = 0.3;
  scene.camera.columns = 160;
  scene.camera.rows = 120;
  add(scene, Sphere{{0.25, 0.5, -0.125}, 1.25}, diffuse(0.75));
  scene.objects[0].material = 0;
  scene.materials[0].k_a = Rgb::Zero();
  scene.lights = {DirectionalLight{Vec3(2, -2, 1) / 3, {1, 0.5, 0.25}}};
  scene.background = {0, 0, 2};  // brighter than any shading: tells a miss from a dark hit
  return scene;
}

// CLAIM      Known render of a sphere (IU.5-8 to 5-11) seen through pixels' centres (RT.1, RT.2): each pixel is background or
//            Lambert's k_d I_p max(0, N·L), as the quadratic decides.
// ORACLE     known render: 5-9 ... 5-11 and 2-3 per pixel, in long double.
// TOLERANCE  silhouette: a pixel is decided unless |γ| ≤ 2 d R · kDirectionError · 4 (a turn of the ray by δ moves γ by 2 d R δ);
//            none is undecided. Shading: the turn moves the point by d δ R/√γ, hence the normal by d δ/√γ.
TEST(KnownRender, OfASphereIsRightInEveryPixel) {
  proves({"IU.5.2", "IU.2-3", "IU.5-8", "IU.5-9", "IU.5-10", "IU.5-11", "RT.1", "RT.2"}, Oracle::render,
         "sphere and Lambert's cosine, pixel by pixel in long double");
  const Scene scene = lone_sphere();
  const Sphere& sphere = std::get<Sphere>(scene.objects[0].shape);
  const Long3 to_light = to_long(std::get<DirectionalLight>(scene.lights[0]).direction);
  const Image image = rendered(scene).image;
  std::uint64_t undecided = 0, wrong = 0, decided = 0, lit = 0;
  ImagePair pair{"A sphere under Lambert's law", image.columns, image.rows, {}, {}, 0};
  for (const Rgb& pixel : image.pixels) {
    pair.ours.insert(pair.ours.end(), {pixel[0], pixel[1], pixel[2]});
    pair.reference.insert(pair.reference.end(), {0, 0, 2});  // the background, where no sphere is
  }
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.columns; ++column) {
      const Long3 d = pixel_direction(scene.camera, column, row);
      const Long3 to_centre = plus(to_long(sphere.centre), -1, to_long(scene.camera.eye));
      const Long mu = dot(d, to_centre), distance = std::sqrt(dot(to_centre, to_centre));
      const Long gamma = mu * mu - dot(to_centre, to_centre) + static_cast<Long>(sphere.radius) * sphere.radius;
      if (std::abs(gamma) <= 8 * distance * sphere.radius * kDirectionError) {
        ++undecided;
        continue;
      }
      ++decided;
      const Rgb& pixel = image.at(column, row);
      if ((pixel[2] == 2) != (gamma < 0)) ++wrong;
      if (gamma < 0) continue;
      const Long3 out = plus(plus({0, 0, 0}, mu - std::sqrt(gamma), d), -1, to_centre);
      const Long cosine = std::max<Long>(0, dot(unit(out), to_light));
      if (cosine > 0) ++lit;
      for (const std::size_t k : {0u, 1u, 2u})
        pair.reference[3 * static_cast<std::size_t>(row * image.columns + column) + k] =
            static_cast<double>(0.75L * cosine / static_cast<Long>(1U << k));
      const double tolerance = kDirectionError * static_cast<double>(1 + distance / std::sqrt(gamma));
      pair.tolerance = std::max(pair.tolerance, tolerance);
      ASSERT_TRUE(near(pixel[0], static_cast<double>(0.75L * cosine), tolerance)) << column << " " << row;
      ASSERT_TRUE(near(pixel[1], static_cast<double>(0.375L * cosine), tolerance)) << column << " " << row;
    }
  }
  EXPECT_EQ(undecided, 0u);
  EXPECT_TRUE(all_agree(wrong, decided));
  EXPECT_GT(lit, 2000u);
  exhibit(pair);
}

// The faces of a box around the origin, as polygons that share their corners.
std::vector<Shape> box_of_polygons(const Mat3& axes, const Vec3& half) {
  std::vector<Shape> faces;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      std::vector<Vec3> chain;
      for (const double turn : {0.5, 1.5, 2.5, 3.5}) {
        Vec3 corner;
        corner[axis] = side;
        corner[(axis + 1) % 3] = std::copysign(1.0, std::cos(turn * std::numbers::pi / 2));
        corner[(axis + 2) % 3] = std::copysign(side, side * std::sin(turn * std::numbers::pi / 2));
        chain.push_back(axes * corner.cwiseProduct(half));
      }
      faces.push_back(Polygon::make(chain).value());
    }
  }
  return faces;
}

// CLAIM      White furnace: inside a closed mirror that emits E and reflects k_r, every pixel of every camera is
//            E (1 + k_r + … + k_r^D), whatever the geometry; with k_r = 0 it is E.
// ORACLE     known render: the geometric series, one constant for all pixels.
// TOLERANCE  none between pixels: all have the same bits; D · 2 u against (1 − k_r^(D+1))/(1 − k_r), relatively.
TEST(KnownRender, OfAWhiteFurnaceIsOneConstant) {
  proves({"IU.5-2", "IU.5.5", "IU.5.4b"}, Oracle::render, "the geometric series, the same in every pixel");
  std::mt19937_64 random(66);
  std::uniform_real_distribution<double> coordinate(-0.5, 0.5);
  const auto vector = [&] {
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
    return Vec3(x, y, z);
  };
  Mat3 axes = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const std::vector<std::vector<Shape>> enclosures{
      {Sphere{{0, 0, 0}, 1}}, {Box{{0, 0, 0}, axes, {1, 1.25, 1.5}}}, box_of_polygons(axes, {1, 1.25, 1.5})};
  for (const auto& enclosure : enclosures) {
    for (const double k_r : {0.0, 0.5, 0.9}) {
      for (const int depth : {0, 1, 2, 7, 30}) {
        Scene scene;
        Material wall = specular(k_r, 0);
        wall.emission = {0.7, 0.3, 0.1};
        for (const Shape& shape : enclosure) add(scene, shape, wall);
        scene.background = {100, 100, 100};  // a ray that leaks shows
        scene.camera.eye = vector();
        scene.camera.gaze = vector() + Vec3(0, 1, 0);
        scene.camera.horizontal_half_angle = 0.8;
        scene.camera.columns = 12;
        scene.camera.rows = 9;
        const Image image = rendered(scene, {depth, 0}).image;
        const double series = (1 - std::pow(k_r, depth + 1)) / (1 - k_r);
        std::uint64_t different = 0;
        for (const Rgb& pixel : image.pixels) {
          if ((pixel != image.pixels[0]).any()) ++different;
        }
        ASSERT_TRUE(all_agree(different, image.pixels.size()));
        for (int k = 0; k < 3; ++k) {
          const double expected = wall.emission[k] * series;
          ASSERT_TRUE(near(image.pixels[0][k], expected, expected * (2 * depth + 16) * kUnitRoundoff));
        }
      }
    }
  }
}

constexpr double kEta = 1.5, kThickness = 1, kPatternDepth = 4;

Scene behind_glass(const Vec3& slab_normal) {
  Scene scene;
  Mat3 axes;
  const Vec3 u = slab_normal.unitOrthogonal();
  axes << u, slab_normal.cross(u), slab_normal;
  add(scene, Box{{0, 0, 0}, axes, {50, 50, kThickness / 2}}, specular(0, 1, kEta));
  Material red, blue;
  red.emission = {1, 0, 0};
  blue.emission = {0, 0, 1};
  const double z = -kPatternDepth;
  add(scene, Polygon::make({{-40, -40, z}, {0.1, -40, z}, {0.1, 40, z}, {-40, 40, z}}).value(), red);
  add(scene, Polygon::make({{0.1, -40, z}, {40, -40, z}, {40, 40, z}, {0.1, 40, z}}).value(), blue);
  scene.camera.eye = {0.3, 0.2, 5};
  scene.camera.gaze = {-0.05, -0.02, -1};
  scene.camera.up = {0.3, 1, 0};
  scene.camera.horizontal_half_angle = 0.35;
  scene.camera.columns = 120;
  scene.camera.rows = 90;
  return scene;
}

// CLAIM      IU.4.3b, IU.4.3c, IU.4.3d: a slab of glass displaces what is seen through it: each ray leaves parallel to the
//            entering one, and the pixel shows what stands there, not what would be seen without the slab.
//            E10: it is the polygon in front, the slab's, that refracts. The pattern behind lets nothing through, so
//            refraction due to it, as printed, would displace nothing, and the pixels counted as moved would be others;
//            giving it an index of refraction of its own changes no pixel.
// ORACLE     known render: the displaced ray's foot on the pattern, in closed form and long double.
// TOLERANCE  a pixel is decided unless the foot lies within 1000 u · 10 of the border (ray length 10, two refractions of
//            30 u and the direction's 200 u); none is undecided.
TEST(KnownRender, BehindASlabOfGlassIsDisplaced) {
  proves({"IU.4.3b", "IU.4.3c", "IU.4.3d", "IU.5-2", "E10"}, Oracle::render,
         "the displaced pattern, pixel by pixel in long double");
  std::uint64_t moved = 0;
  for (const Vec3& tilt : {Vec3(0, 0, 1), Vec3(0.4, 0.1, 1), Vec3(-0.3, 0.5, 1)}) {
    const Scene scene = behind_glass(tilt.normalized());
    const Image image = rendered(scene).image;
    Scene dense_behind = scene;
    dense_behind.materials[1].eta = dense_behind.materials[2].eta = 2.5;
    const Image same = rendered(dense_behind).image;
    std::uint64_t displaced_by_back = 0;
    for (std::size_t k = 0; k < same.pixels.size(); ++k) displaced_by_back += (same.pixels[k] != image.pixels[k]).any();
    EXPECT_TRUE(all_agree(displaced_by_back, same.pixels.size()));
    const Long3 n = unit(to_long(tilt.normalized()));
    std::uint64_t wrong = 0, decided = 0, undecided = 0;
    for (int row = 0; row < image.rows; ++row) {
      for (int column = 0; column < image.columns; ++column) {
        const Long3 d = pixel_direction(scene.camera, column, row);
        const Long3 eye = to_long(scene.camera.eye);
        const Long cos_in = -dot(d, n), cos_glass = std::sqrt(1 - (1 - cos_in * cos_in) / (Long(kEta) * kEta));
        // Inside, the path w / cos φ along the bent direction; outside it would have been w / cos θ along d.
        const Long3 bent = plus(plus({0, 0, 0}, 1 / Long(kEta), d), cos_in / kEta - cos_glass, n);
        const Long3 start = plus(plus(eye, kThickness / cos_glass, bent), -kThickness / cos_in, d);
        const auto foot = [&](const Long3& from) { return from[0] + (-kPatternDepth - from[2]) / d[2] * d[0]; };
        const Long offset = foot(start) - 0.1;
        if (std::abs(offset) <= 1e4 * kUnitRoundoff) {
          ++undecided;
          continue;
        }
        ++decided;
        if ((offset > 0) != (foot(eye) > 0.1)) {
          ++moved;
          const Rgb printed = foot(eye) > 0.1 ? Rgb(0, 0, 1) : Rgb(1, 0, 0);
          if ((image.at(column, row) == printed).all()) ++wrong;
        }
        const Rgb expected = offset < 0 ? Rgb(1, 0, 0) : Rgb(0, 0, 1);
        if ((image.at(column, row) != expected).any()) ++wrong;
      }
    }
    EXPECT_EQ(undecided, 0u);
    EXPECT_TRUE(all_agree(wrong, decided));
  }
  EXPECT_TRUE(apart(static_cast<double>(moved), 0, 200)) << "the glass did change the picture";
}

constexpr int kTiles = 8;
constexpr double kMirrorShare = 0.75;

/// A board of luminous tiles behind the eye, in one plane, and a mirror before it that is turned out of every axis.
Scene board_in_a_mirror(const Vec3& mirror_normal) {
  Scene scene;
  Material white, black;
  white.emission = {1, 0.5, 0.25};
  black.emission = {0.125, 0.25, 0.5};
  add(scene, Plane{{0, 4, 0}, mirror_normal}, specular(kMirrorShare, 0));
  for (int i = -kTiles; i < kTiles; ++i) {
    for (int j = -kTiles; j < kTiles; ++j) {
      const double x = i, z = j, y = -2;
      add(scene, Polygon::make({{x, y, z}, {x, y, z + 1}, {x + 1, y, z + 1}, {x + 1, y, z}}).value(),
          (i + j) % 2 == 0 ? white : black);
    }
  }
  scene.background = {3, 3, 3};
  scene.camera.eye = {0.3, 0, 0.2};
  scene.camera.gaze = {0.02, 1, 0.05};
  scene.camera.horizontal_half_angle = 0.5;
  scene.camera.columns = 120;
  scene.camera.rows = 80;
  return scene;
}

// CLAIM      Known render of a checkerboard in a mirror: each pixel has the tile on which the mirrored ray's foot lies, times k_r.
// ORACLE     known render: 5-5 and the feet on both planes in closed form and long double.
// TOLERANCE  a pixel is decided unless the foot lies within 1e5 u of a tile's border (the way is 20 at most, the direction errs by
//            kDirectionError and the mirror's 21 u, each weighed by the cosines, 0.3 at least); none is undecided.
TEST(KnownRender, OfACheckerboardInAMirrorIsRightInEveryPixel) {
  proves({"IU.5-2", "IU.5-5", "IU.5.6.2"}, Oracle::render, "the mirrored ray's foot, pixel by pixel in long double");
  constexpr double kBorder = 1e5 * kUnitRoundoff;
  for (const Vec3& tilt : {Vec3(0, -1, 0), Vec3(0.06, -1, 0.03), Vec3(-0.1, -1, 0.08)}) {
    const Scene scene = board_in_a_mirror(tilt.normalized());
    const Image image = rendered(scene).image;
    const Long3 n = to_long(tilt.normalized()), eye = to_long(scene.camera.eye);
    std::uint64_t wrong = 0, decided = 0, undecided = 0;
    for (int row = 0; row < image.rows; ++row) {
      for (int column = 0; column < image.columns; ++column) {
        const Long3 d = pixel_direction(scene.camera, column, row);
        const Long3 met = plus(eye, dot(plus({0, 4, 0}, -1, eye), n) / dot(d, n), d);
        const Long3 back = plus(d, -2 * dot(d, n) / dot(n, n), n);
        const Long3 foot = plus(met, (-2 - met[1]) / back[1], back);
        const Long x = foot[0], z = foot[2];
        if (std::abs(x - std::round(x)) < kBorder || std::abs(z - std::round(z)) < kBorder) {
          ++undecided;
          continue;
        }
        ++decided;
        const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(z));
        const bool on_board = -kTiles <= i && i < kTiles && -kTiles <= j && j < kTiles;
        const Rgb tile = (i + j) % 2 == 0 ? Rgb(1, 0.5, 0.25) : Rgb(0.125, 0.25, 0.5);
        const Rgb expected = kMirrorShare * (on_board ? tile : Rgb(3, 3, 3));
        wrong += (image.at(column, row) != expected).any();
      }
    }
    EXPECT_EQ(undecided, 0u);
    EXPECT_TRUE(all_agree(wrong, decided));
  }
}

}  // namespace
}  // namespace etendue::validation
