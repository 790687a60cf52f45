// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "etendue/io/scene_reader.hpp"
#include "etendue/raytracing/render.hpp"
#include "etendue/view/shaded_view.hpp"
#include "io/scene_texts.hpp"
#include "support/evidence.hpp"
#include "support/process.hpp"
#include "support/scene_builder.hpp"

// Pictures of surfaces with textures, by both methods.
namespace etendue::validation {
namespace {

constexpr double kPi = std::numbers::pi;

Rgb colour_seen(const Accelerator& accelerator, const Vec3& from, const Vec3& direction, double path) {
  Ray ray;
  ray.origin = from;
  ray.direction = direction.normalized();
  const auto met = accelerator.nearest(ray).hit;
  return met ? colour_at(accelerator.scene(), *met, ray, path).k_d : Rgb::Constant(-1);
}

// CLAIM      IU.f21: random squares on the shipped sphere are squeezed towards the poles and stretched at the equator: around each of 16 circles of latitude
//            λ there are 32 squares, all of the width 2π cos λ/32, ten times narrower beside the poles than at the equator; along a meridian all have
//            the height π/16.
// ORACLE     closed form: circles of latitude.
// TOLERANCE  two steps of the walk around, for the two ends of a square.
TEST(TexturedScenes, SqueezeSquaresAtThePoles) {
  proves({"IU.f21", "IU.4-1", "IU.4.1.2"}, Oracle::closed_form, "widths 2 pi cos(latitude)/32, heights pi/16");
  const Scene scene = read_scene(source_root() / "scenes/squares-on-sphere/scene.json").value().scene;
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  constexpr int kSteps = 12000;
  const auto at = [&](double longitude, double latitude) {
    const Vec3 out(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                   std::sin(latitude));
    return colour_seen(*accelerator, 3 * out, -out, 3);
  };
  double widest = 0, narrowest = 1;
  for (int row = 0; row < 16; ++row) {
    const double latitude = kPi * ((row + 0.5) / 16 - 0.5), length = 2 * kPi * std::cos(latitude);
    std::vector<int> widths{0};
    for (int i = 0; i < kSteps; ++i) {
      const auto longitude = [](int step) { return 2 * kPi * (step + 0.5) / kSteps; };
      ++widths.back();
      if ((at(longitude(i), latitude) != at(longitude(i + 1), latitude)).any()) widths.push_back(0);
    }
    widths.pop_back();  // the walk ends at a border, that of u = 0
    EXPECT_EQ(widths.size(), 32U);
    for (const int steps : widths) {
      const double width = steps * length / kSteps;
      EXPECT_TRUE(near(width, length / 32, 2 * length / kSteps)) << row;
      widest = std::max(widest, width);
      narrowest = std::min(narrowest, width);
    }
  }
  EXPECT_GT(widest / narrowest, 9.5);  // cos 5.6° / cos 84.4° = 10.2
  int borders = 0, last = 0;
  for (int i = 1; i < kSteps; ++i) {
    const auto latitude = [](int step) { return kPi * ((step + 0.5) / kSteps - 0.5); };
    if ((at(1, latitude(i)) == at(1, latitude(i - 1))).all()) continue;
    ++borders;
    EXPECT_TRUE(near(i - last, kSteps / 16.0, 2));
    last = i;
  }
  EXPECT_EQ(borders, 15);
}

/// Smooth, with slopes of at most π/2 over u and v.
std::shared_ptr<const TexturePyramid> waves() {
  constexpr int kSide = 256;
  std::vector<Eigen::Array3d> texels;
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const double u = (column + 0.5) / kSide, v = 1 - (row + 0.5) / kSide;
      texels.emplace_back(0.5 + 0.25 * std::sin(2 * kPi * u), 0.5 + 0.25 * std::cos(2 * kPi * v),
                          0.5 + 0.25 * std::sin(2 * kPi * (u + v)));
    }
  }
  return std::make_shared<const TexturePyramid>(kSide, kSide, std::move(texels));
}

Material textured(const std::shared_ptr<const TexturePyramid>& image, const std::optional<LaidPattern>& laid = {}) {
  Material material = diffuse(1);
  material.texture = MaterialTexture{TextureImage{image, {}}, laid, {1, 1}};
  return material;
}

/// Each pixel by one ray, at its centre.
RenderOptions one_ray_each() {
  RenderOptions options;
  options.sampling.scheme = SamplingScheme::uniform;
  options.sampling.samples_per_side = 1;
  options.filter.radius = 0.5;
  options.facts = {PictureFact::object, PictureFact::normal, PictureFact::depth};
  return options;
}

// CLAIM      IU.4-1, IU.4.1.2: ray tracer and rasteriser show a texture's same colours at the same points, by every mapping and by the parameters of every
//            shape that both can draw: u and v are interpolated with perspective.
// ORACLE     program: the two methods against each other.
// TOLERANCE  flat shapes: corners snapped by 1/8192 of a pixel, whose diagonal is 1/10 of the pattern at most, seen aslant, on slopes of π: 6e-5. Round ones: a
//            net of 256 facets lies 7.6e-5 of the radius within; seen at 70° at most that is 2.1e-4 along the surface, where it counts double (both ways),
//            and u grows by 1/(2π 0.1) at most, besides the slope π: 2e-3. Nearer to a pole pixels, 1/20 of the radius, average around it.
//            A quadric's 64 cells of 1.8/64 have edges of 0.049 at most: 3e-4 of its radius 1 within, four times that of spheres: 8e-3. The infinite plane to
//            6.5 from the eye, where its pixels are 1/10 of the pattern.
TEST(TexturedScenes, LookTheSameByBothMethods) {
  proves({"IU.4-1", "IU.4.1.2"}, Oracle::program, "rasteriser against ray tracer on 17 objects");
  const auto image = waves();
  PatternFrame frame;
  frame.pole = Vec3(1, 2, -2) / 3;
  frame.equator = Vec3(2, 1, 2) / 3;
  static constexpr double kFlat = 6e-5, kRound = 2e-3, kQuadric = 8e-3, kFarthest = 6.5;
  struct Case {
    Shape shape;
    std::optional<LaidPattern> laid;
    double tolerance;
    bool is_round() const { return tolerance > kFlat; }
  };
  Mesh roof{{{-1, 0.6, -1}, {0, -0.6, -1}, {1, 0.6, -1}, {-1, 0.6, 1}, {0, -0.6, 1}, {1, 0.6, 1}},
            {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}},
            {{0, 0}, {0.5, 0}, {1, 0}, {0, 1}, {0.5, 1}, {1, 1}}};
  BezierSurface cloth;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j)
      cloth.control[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = {0.7 * i - 1, 0.2 * (i % 2) + 0.1 * j,
                                                                                 0.7 * j - 1};
  }
  const Polygon floor = Polygon::make({{-1.5, -1.5, -0.6}, {1.5, -1.5, -0.6}, {1.5, 4, -0.6}, {-1.5, 4, -0.6}}).value();
  const Box box{{0, 0, 0}, Eigen::AngleAxisd(0.5, Vec3(1, 1, 2).normalized()).toRotationMatrix(), {0.6, 0.7, 0.8}};
  const Polygon wall = Polygon::make({{-1.4, 0, -1.2}, {1.4, 0, -1.2}, {1.4, 0.3, 1.2}, {-1.4, 0.3, 1.2}}).value();
  const auto in_wall = [&](double x, double z) { return Vec3(x, 0.3 * (z + 1.2) / 2.4, z); };
  const PolygonWithHoles window =
      PolygonWithHoles::make(wall, {{in_wall(-1, -0.5), in_wall(-0.2, -0.8), in_wall(0, 0.7)},
                                    {in_wall(0.3, 0.1), in_wall(1, 0.2), in_wall(0.8, 0.9)}})
          .value();
  Quadric ball;  // of radius 1, in a box that cuts it
  ball.box = {{0, 0, 0}, box.axes, {0.9, 0.9, 0.9}};
  const Case cases[] = {{floor, {}, kFlat},
                        {floor, LaidOnPlane{{0.1, 0, 0}, {}, 2, 3}, kFlat},
                        {Triangle{{-1, 0, -1}, {1, 0, -1}, {0, 1, 1}}, {}, kFlat},
                        {box, {}, kFlat},
                        {box, LaidOnBox{{0, 0, 0}, frame, {1.2, 1.4, 1.6}}, kFlat},
                        {roof, {}, kFlat},
                        {Disc{{0, 0, 0}, Vec3(1, -4, 1).normalized(), 1}, {}, kFlat},
                        {Sphere{{0, 0, 0}, 1}, {}, kRound},
                        {Sphere{{0, 0, 0}, 1}, LaidOnSphere{{0, 0, 0}, frame}, kRound},
                        {Cylinder{{-0.3, 0, -1}, {0.3, 0, 1}, 0.7}, {}, kRound},
                        {Cylinder{{-0.3, 0, -1}, {0.3, 0, 1}, 0.7}, LaidOnCylinder{{0, 5, 0}, frame, 3}, kRound},
                        {Cone{{0, 0, -1}, {0, 0, 1}, 0.9, 0.4}, {}, kRound},
                        {Torus{{0, 0, 0}, Vec3(1, -2, 1), 0.8, 0.35}, {}, kRound},
                        {ball, LaidOnSphere{{0, 0, 0}, frame}, kQuadric},
                        {window, {}, kFlat},
                        {Plane{{0.5, 0, -0.6}, {0, 0, 1}}, LaidOnPlane{{0.1, 0, 0}, {}, 2, 3}, kFlat},
                        {Plane{{0.5, 0, -0.6}, {0, 0, 1}}, {}, kFlat}};
  std::size_t compared = 0;
  for (const Case& each : cases) {
    Scene scene;
    add(scene, each.shape, textured(image, each.laid));
    scene.ambient = Rgb::Ones();
    scene.camera.eye = {0.4, -5, 0.8};
    scene.camera.gaze = -scene.camera.eye;
    scene.camera.horizontal_half_angle = 0.3;
    scene.camera.columns = 64;
    scene.camera.rows = 64;
    const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
    const Rendering traced = render(*accelerator, one_ray_each(), {}).value();
    ShadingOptions options;
    options.samples = 1;
    options.net.facets = 256;
    for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong}) {
      if (shading != Shading::phong && std::holds_alternative<Plane>(each.shape)) continue;
      options.shading = shading;
      const Image drawn = view_shaded(scene, options).value().image;
      for (int row = 1; row < 63; ++row) {
        for (int column = 1; column < 63; ++column) {
          bool inside = true;  // and what lies around: the methods may see a rim in another pixel
          for (int k = 0; k < 9; ++k)
            inside = inside && traced.facts[0].at(column + k % 3 - 1, row + k / 3 - 1)[0] == 0;
          const Vec3 normal = traced.facts[1].at(column, row).matrix();
          if (!inside || traced.facts[2].at(column, row)[0] > kFarthest) continue;
          if (each.is_round() && normal.dot(scene.camera.eye) < 0.35 * scene.camera.eye.norm()) continue;
          const Rgb difference = drawn.at(column, row) - traced.image.at(column, row);
          if (!each.is_round() && difference.abs().maxCoeff() > 0.05 && std::holds_alternative<Box>(each.shape)) {
            // At an edge the two may see one face each, and so they may where the mapping itself jumps.
            const Vec3 beside = traced.facts[1].at(column + 1, row).matrix(),
                       above = traced.facts[1].at(column, row + 1).matrix();
            if (normal.dot(beside) < 0.9 || normal.dot(above) < 0.9) continue;
          }
          ++compared;
          EXPECT_TRUE(within(difference.abs().maxCoeff(), each.tolerance))
              << each.shape.index() << (each.laid ? " laid " : " ") << column << ' ' << row;
        }
      }
    }
  }
  EXPECT_GT(compared, 15000U);
}

// CLAIM      IU.4-1: a floor with a fine chequered image is grey in the distance, pixel by pixel, by one ray each, where rays without a footprint would show black or
//            white; the picture has the same bits with any number of threads; a mirror shows the floor as from as far away as the path is long.
// ORACLE     closed form: the image's mean; metamorphic: threads; the camera behind the mirror.
// TOLERANCE  kTextureError; none; for the mirrored picture 2^-36: rays differ by rounding, which the floor's slopes multiply by 2^10 in the distance.
TEST(TexturedScenes, TurnGreyInTheDistance) {
  proves({"IU.4-1"}, Oracle::closed_form, "mean of a chequered floor; threads; a mirror");
  std::vector<Eigen::Array3d> texels;
  for (int i = 0; i < 64 * 64; ++i) texels.emplace_back(Eigen::Array3d::Constant((i + i / 64) % 2));
  const auto board = std::make_shared<const TexturePyramid>(64, 64, std::move(texels));
  Scene scene;
  add(scene, Plane{{0, 0, 0}, {0, 0, 1}}, textured(board, LaidOnPlane{{0.3, 0.2, 0}, {}, 0.25, 0.25}));
  scene.ambient = Rgb::Ones();
  scene.background = Rgb::Constant(-1);
  scene.camera.eye = {0, 0, 1};
  scene.camera.gaze = {0.1, 1, -0.35};
  scene.camera.horizontal_half_angle = 0.5;
  scene.camera.columns = 96;
  scene.camera.rows = 96;
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  const Rendering traced = render(*accelerator, one_ray_each(), {}).value();
  const double pixel = 2 * std::tan(0.5) / 96;
  std::size_t grey = 0;
  for (const Rgb& colour : traced.image.pixels) {
    if (colour[0] < 0) continue;
    EXPECT_TRUE(near(colour[0], 0.5, kTextureError));
    ++grey;
  }
  EXPECT_GT(grey, 4000U);
  EXPECT_GT(pixel * scene.camera.eye.z(), 2 * 0.25 / 64);  // all pixels cover two texels and more
  Execution three;
  three.threads = 3;
  const Rendering again = render(*accelerator, one_ray_each(), three).value();
  std::uint64_t other = 0;
  for (std::size_t i = 0; i < again.image.pixels.size(); ++i)
    other += (again.image.pixels[i] != traced.image.pixels[i]).any() ? 1u : 0u;
  EXPECT_TRUE(all_agree(other, again.image.pixels.size()));

  Scene smooth = scene;  // waves, to see differences
  smooth.materials[0] = textured(waves(), LaidOnPlane{{0.3, 0.2, 0}, {}, 1, 1});
  const auto direct = make_accelerator(smooth, AcceleratorKind::brute_force);
  Scene mirrored = smooth;  // a mirror before the eye, which looks away from the floor it shows
  add(mirrored, Polygon::make({{-9, 1, 0.01}, {9, 1, 0.01}, {9, 1, 9}, {-9, 1, 9}}).value(), specular(1, 0));
  mirrored.camera.eye = {0, 0.5, 1};
  const auto by_mirror = make_accelerator(mirrored, AcceleratorKind::brute_force);
  RenderOptions options;
  for (int i = 0; i < 200; ++i) {
    // From (0, ½, 1) into the mirror y = 1, and from (0, 3/2, 1) straight, mirrored.
    const Vec3 way = Vec3(0.01 * (i % 20) - 0.1, 1, -0.05 - 0.002 * i).normalized();
    Ray into, straight_on;
    into.origin = {0, 0.5, 1};
    into.direction = way;
    straight_on.origin = {0, 1.5, 1};
    straight_on.direction = {way.x(), -way.y(), way.z()};
    const Rgb seen = see(into, *by_mirror, options, {}).colour,
              expected = see(straight_on, *direct, options, {}).colour;
    EXPECT_TRUE(within((seen - expected).abs().maxCoeff(), 0x1p-36));
  }
}

// CLAIM      Textures follow their objects: transforms and those of groups, other units, and movement; by parameters, or laid in the coordinates of the
//            object's own numbers.
// ORACLE     metamorphic: the object before its transforms, seen from where the transform comes from.
// TOLERANCE  2^-36: rays and places a few units away are rounded on both ways, and slopes multiply by 10 at most.
TEST(TexturedScenes, FollowTransformsAndMovement) {
  proves({"IU.4-1", "IU.4.1.2"}, Oracle::metamorphic, "each object with and without its transform");
  const TemporaryFolder folder;
  const std::pair<const char*, std::optional<LaidPattern>> objects[] = {
      {R"("type": "sphere", "centre": [0.5, 0, 0], "radius": 1)", LaidOnSphere{{0.5, 0, 0}, {}}},
      {R"("type": "box", "low": [-1, -1, -1], "high": [1, 1, 1])", LaidOnBox{{0, 0, 0}, {}, {2, 2, 2}}},
      {R"("type": "cylinder", "base": [0, 0, -1], "top": [0, 0, 1], "radius": 1)", LaidOnCylinder{{0, 0, -1}, {}, 2}},
      {R"("type": "cylinder", "base": [0, 0, -1], "top": [0, 0, 1], "radius": 1)", LaidOnPlane{{0, 0, -1}, {}, 3, 2}},
      {R"("type": "bezier", "control": [[[-1,0,-1],[-1,0,0],[-1,0,1],[-1,0,2]],[[0,1,-1],[0,1,0],[0,0,1],[0,0,2]],
        [[1,0,-1],[1,0,0],[1,1,1],[1,0,2]],[[2,0,-1],[2,0,0],[2,0,1],[2,0,2]]])",
       {}}};
  for (const auto& [object, laid] : objects) {
    const std::string body = std::string("{") + object + R"(, "material": "a")";
    const std::string moved =
        R"({"type": "group", "transform": [{"rotate": {"axis": [1, 2, 3], "angle_deg": 70}}, {"scale": 2.5}],
      "velocity": [1, 2, 3], "children": [)" +
        body + R"(, "transform": [{"translate": [0.3, -0.2, 5]}]}]})";
    Scene plain = read(folder, scene_of(body + "}"));
    Scene placed = read(folder, scene_of(moved));
    placed.camera.shutter = 2;
    for (Scene* scene : {&plain, &placed}) scene->materials[0] = textured(waves(), laid);
    const auto at_home = make_accelerator(plain, AcceleratorKind::brute_force);
    const auto away = make_accelerator(placed, AcceleratorKind::brute_force);
    const Mat3 turn = Eigen::AngleAxisd(70 * kPi / 180, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const Vec3 velocity = placed.objects[0].velocity;
    int met = 0;
    for (int i = 0; i < 100; ++i) {
      Ray ray;
      ray.origin = {3 * std::cos(0.7 * i), 3 * std::sin(0.7 * i), 0.02 * i - 1};
      ray.direction = (Vec3(0.1, 0.05, 0.2) - ray.origin).normalized();
      Ray there;
      there.time = 0.01 * i;
      there.origin = 2.5 * (turn * (ray.origin + Vec3(0.3, -0.2, 5))) + there.time * velocity;
      there.direction = turn * ray.direction;
      const auto hit = at_home->nearest(ray).hit, hit_there = away->nearest(there).hit;
      ASSERT_EQ(hit.has_value(), hit_there.has_value());
      if (!hit) continue;
      ++met;
      const Rgb expected = colour_at(plain, *hit, ray, 3).k_d;
      EXPECT_TRUE(within((colour_at(placed, *hit_there, there, 7.5).k_d - expected).abs().maxCoeff(), 0x1p-36))
          << object;
    }
    EXPECT_GT(met, 50);
  }
}

}  // namespace
}  // namespace etendue::validation
