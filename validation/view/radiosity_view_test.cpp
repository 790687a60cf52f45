// SPDX-License-Identifier: Apache-2.0
#include "etendue/view/radiosity_view.hpp"

#include <cmath>
#include <optional>
#include <random>

#include "etendue/assembly/scene_radiosity.hpp"
#include "etendue/meshing/shared_vertices.hpp"
#include "etendue/view/traced_view.hpp"
#include "meshing/small_scenes.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

// The point of the plane z = 0 under a picture position [pixels], by IU.5.2 written out here.
std::optional<Vec3> seen_point(const Camera& camera, double column, double row) {
  const Vec3 g = camera.gaze.normalized();
  const Vec3 x = g.cross(camera.up).normalized();
  const Vec3 y = x.cross(g);
  const double tan_h = std::tan(camera.horizontal_half_angle);
  const double tan_v = tan_h * camera.rows / camera.columns;
  const Vec3 d = g + (2 * column / camera.columns - 1) * tan_h * x + (1 - 2 * row / camera.rows) * tan_v * y;
  if (d.z() >= 0) return std::nullopt;
  return Vec3(camera.eye - camera.eye.z() / d.z() * d);
}

// CLAIM      IU.6.5v, IU.6.5: one solution serves any view: whatever the camera, a pixel shows the radiosity at the
//            point that its centre's ray meets; Gouraud interpolation on the surface reproduces a linear field.
// ORACLE     closed form: the field at the intersection of the ray of IU.5.2 with the floor.
// TOLERANCE  corners are snapped to 1/4096 pixel: the shown point moves by at most 1/4096 of a pixel's footprint (taken
//            to the neighbouring pixels, doubled), times the field's gradient 2; plus 1e-12 for rounding of values near
//            50.
TEST(RadiosityView, ShowsTheSameValueFromEveryCamera) {
  proves({"IU.6.5v", "IU.6.5", "IU.5.2"}, Oracle::closed_form,
         "a linear field at the ray's intersection with the floor");
  Scene scene = scene_of({quadrilateral({-5, -5, 0}, {5, -5, 0}, {5, 5, 0}, {-5, 5, 0})});
  scene.objects[0].subdivision = {{4, 5}, {1, 1}};
  const ElementMesh mesh = *mesh_elements(scene);
  const auto field = [](const Vec3& p) { return 50 + 1.2 * p.x() - 1.6 * p.y(); };
  std::vector<Rgb> radiosity;
  for (const Element& element : mesh.elements) radiosity.push_back(Rgb::Constant(field(element.polygon.centroid())));
  const VertexRadiosities vertices = vertex_radiosities(mesh, radiosity);

  std::mt19937_64 random(61);
  std::uniform_real_distribution<double> entry(-1, 1);
  std::uint64_t floor_pixels = 0;
  for (int trial = 0; trial < 12; ++trial) {
    Camera camera;
    const double x = 3 * entry(random), y = 3 * entry(random);
    camera.eye = Vec3(x, y, 2.5 + entry(random));
    const double tilt = entry(random), turn = entry(random);
    camera.gaze = Vec3(tilt, turn, -0.8);
    camera.up = Vec3(entry(random), 1, 0.3);
    camera.horizontal_half_angle = 0.6;
    camera.columns = 48;
    camera.rows = 32;
    const auto picture = view_radiosities(camera, mesh, vertices, Rgb::Constant(-1), 1);
    ASSERT_TRUE(picture.ok());
    for (int row = 0; row < camera.rows; ++row) {
      for (int column = 0; column < camera.columns; ++column) {
        const auto point = seen_point(camera, column + 0.5, row + 0.5);
        const auto right = seen_point(camera, column + 1.5, row + 0.5),
                   below = seen_point(camera, column + 0.5, row + 1.5);
        if (!point || !right || !below) continue;
        const double footprint = 2 * ((*right - *point).norm() + (*below - *point).norm());
        const double value = picture->at(column, row)(0);
        const double inside = 5 - point->cwiseAbs().maxCoeff();
        if (std::abs(inside) <= footprint) continue;  // the snapped boundary may go either way
        if (inside < 0) {
          EXPECT_EQ(value, -1) << "nothing is there";
          continue;
        }
        ++floor_pixels;
        EXPECT_TRUE(near(value, field(*point), 2 * footprint / 4096 + 1e-12));
      }
    }
  }
  EXPECT_GT(floor_pixels, 5000u);
}

// CLAIM      The nearer surface hides the farther one whatever the order of drawing; surfaces show their front only;
//            what lies behind the eye is cut away.
// ORACLE     known render: a small square before a large one, seen along their normals.
// TOLERANCE  none: pixels well inside or outside the small square's projection.
TEST(RadiosityView, HidesWhatIsBehindAndTurnedAway) {
  proves({"IU.6.5"}, Oracle::render, "two squares one behind the other");
  const auto square = [](double half, double z) {
    return quadrilateral({-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z});
  };
  const auto turned = [](double half, double z) {
    return quadrilateral({-half, half, z}, {half, half, z}, {half, -half, z}, {-half, -half, z});
  };
  Camera camera;
  camera.eye = Vec3(0, 0, 4);
  camera.gaze = Vec3(0, 0, -1);
  camera.up = Vec3(0, 1, 0);
  camera.horizontal_half_angle = std::atan(1.0);
  camera.columns = camera.rows = 40;
  // The far square (2 half, distance 4) covers half the picture's side, the near one (0.5, distance 2) a quarter.
  for (const bool near_first : {true, false}) {
    Scene scene = near_first ? scene_of({square(0.5, 2), square(2, 0), turned(3, 3), square(3, 5)})
                             : scene_of({square(2, 0), square(0.5, 2), square(3, 5), turned(3, 3)});
    const ElementMesh mesh = *mesh_elements(scene);
    std::vector<Rgb> radiosity;
    for (const Element& element : mesh.elements) {
      radiosity.push_back(Rgb::Constant(1 + std::abs(element.polygon.centroid().z())));
    }
    const auto picture = view_radiosities(camera, mesh, vertex_radiosities(mesh, radiosity), Rgb::Zero(), 2);
    ASSERT_TRUE(picture.ok());
    std::uint64_t wrong = 0, decided = 0;
    for (int row = 0; row < 40; ++row) {
      for (int column = 0; column < 40; ++column) {
        const double side = std::max(std::abs(column + 0.5 - 20), std::abs(row + 0.5 - 20));
        const double expected = side < 5 ? 3 : side < 10 ? 1 : 0;
        wrong += std::abs(picture->at(column, row)(0) - expected) > 8 * 0x1p-52;  // weights sum to one after rounding
        ++decided;
      }
    }
    EXPECT_TRUE(all_agree(wrong, decided));
  }
}

// CLAIM      A camera that stands in the room, before and behind its walls, sees a wall in every pixel: the near plane
//            cuts no hole, shared edges leave no gap.
// ORACLE     known render: a closed room of uniform radiosity is uniform.
// TOLERANCE  8 roundings of one: the interpolation's weights.
TEST(RadiosityView, LeavesNoGapInAClosedRoom) {
  proves({"IU.6.5", "IU.6.5v"}, Oracle::render, "a uniform closed room");
  Scene scene = room_of({-1.3, -0.7, -2.1}, {2.2, 3.1, 0.9});
  for (std::size_t k = 0; k < 6; ++k) scene.objects[k].subdivision = {{static_cast<int>(k) + 2, 5}, {1, 1}};
  const ElementMesh mesh = *mesh_elements(scene);
  const auto vertices = vertex_radiosities(mesh, std::vector<Rgb>(mesh.elements.size(), Rgb::Ones()));
  std::mt19937_64 random(62);
  std::uniform_real_distribution<double> entry(-1, 1);
  double worst = 0;
  for (int trial = 0; trial < 25; ++trial) {
    Camera camera;
    const double x = 0.6 * entry(random), y = 0.6 * entry(random);
    camera.eye = Vec3(x, y, -0.5);
    const double gx = entry(random), gy = entry(random);
    camera.gaze = Vec3(gx, gy, entry(random));
    camera.up = Vec3(0.1, 0.2, 1);
    camera.horizontal_half_angle = 0.5 + 0.02 * trial;
    camera.columns = 64;
    camera.rows = 48;
    const auto picture = view_radiosities(camera, mesh, vertices, Rgb::Constant(-100), 1);
    ASSERT_TRUE(picture.ok());
    for (const auto& pixel : picture->pixels) worst = std::max(worst, std::abs(pixel(0) - 1));
  }
  EXPECT_TRUE(within(worst, 8 * 0x1p-53));
}

// CLAIM      IU.6.5: where three small elements end on the side of two large ones, the picture has no step once their corners are
//            corners of the large ones too; as they are, it has one.
// ORACLE     closed form: across the side the picture changes by no more than the steepest gradient of the interpolation times
//            the width of a pixel; the step of the plain mesh is known by hand.
// TOLERANCE  twice that gradient times the distance of the two pixels, and what snapping moves the side by.
TEST(RadiosityView, HasNoStepWhereSmallElementsEndOnLargeOnes) {
  proves({"IU.6.5"}, Oracle::closed_form, "gradient times the width of a pixel");
  Scene scene = scene_of({quadrilateral({0, 0, 0}, {3, 0, 0}, {3, 6, 0}, {0, 6, 0}),
                          quadrilateral({3, 0, 0}, {6, 0, 0}, {6, 6, 0}, {3, 6, 0})});
  scene.objects[0].subdivision = {{1, 2}, {1, 1}};
  scene.objects[1].subdivision = {{2, 3}, {1, 1}};
  const ElementMesh plain = *mesh_elements(scene), shared = with_shared_vertices(plain);
  // Left: 10, 40 upwards; right: rows of 0, 60, 20.
  std::vector<Rgb> radiosity;
  for (const double value : {10, 40, 0, 0, 60, 60, 20, 20}) radiosity.push_back(Rgb::Constant(value));
  Camera camera;  // 600 rows over the side x = 3: a column of hundredths of a unit on each side of it
  camera.eye = Vec3(3, 3, 3);
  camera.gaze = Vec3(0, 0, -1);
  camera.up = Vec3(0, 1, 0);
  camera.columns = 2;
  camera.rows = 600;
  camera.horizontal_half_angle = std::atan(1.0 / 300);
  const auto step = [&](const ElementMesh& mesh) {
    const auto picture = *view_radiosities(camera, mesh, vertex_radiosities(mesh, radiosity), Rgb::Zero(), 1);
    double largest = 0;
    for (int row = 0; row < 600; ++row) {
      largest = std::max(largest, std::abs(picture.at(0, row)(0) - picture.at(1, row)(0)));
    }
    return largest;
  };
  // Values lie in [0, 65], elements are 1.5 wide at least, a fan's triangles half as high: no gradient above 65 / 0.75.
  EXPECT_TRUE(within(step(shared), 2 * 65 / 0.75 * 0.01));
  // The large elements alone: their side runs straight from one end to the other, past the small ones' corners.
  EXPECT_TRUE(holds(step(plain) > 10));
}

struct SolvedRoom {
  Scene scene = room_of({-1.5, -1, 0}, {1.5, 1, 1.25});
  ElementMesh mesh;
  std::vector<Rgb> radiosity;
  VertexRadiosities vertices;
};

/// A closed room with a glowing ceiling and a red wall, solved by the full matrix; its walls are 4 × 3 elements.
SolvedRoom solved_room() {
  SolvedRoom room;
  Material light = room.scene.materials[0], red = light;
  light.emission = Rgb(10, 9, 8);
  red.rho = Rgb(0.6, 0.1, 0.05);
  room.scene.materials.push_back(light);
  room.scene.materials.push_back(red);
  room.scene.objects[1].material = 1;
  room.scene.objects[2].material = 2;
  for (Object& object : room.scene.objects) object.subdivision = {{4, 3}, {1, 1}};
  room.mesh = *mesh_elements(room.scene);
  const FormFactorMatrix factors = assemble_form_factors(room.mesh, AssemblyTolerance{}, Execution{});
  const RadiosityGoal goal{RadiositySolver::gaussian_elimination};
  room.radiosity = solve_scene_radiosity(room.scene, room.mesh, factors, goal, Execution{})->radiosity;
  room.vertices = vertex_radiosities(room.mesh, room.radiosity);
  return room;
}

/// Where a ray from inside the room ends: the nearest of the planes that it approaches.
Vec3 far_end(const Vec3& eye, const Vec3& d) {
  const Vec3 low(-1.5, -1, 0), high(1.5, 1, 1.25);
  double nearest = 1e300;
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (d(k) > 0) nearest = std::min(nearest, (high(k) - eye(k)) / d(k));
    if (d(k) < 0) nearest = std::min(nearest, (low(k) - eye(k)) / d(k));
  }
  return eye + nearest * d;
}

// CLAIM      IU.6.5v: two views of one solution agree at the points that both show: what a pixel of one camera shows, a second
//            camera elsewhere, turned to that very point, shows in its middle.
// ORACLE     metamorphic: a closed room, solved once; the shared points by the geometry of a box, written out here.
// TOLERANCE  1e-11 of the brightest radiosity: both find the point within a few roundings of the room's size, and the display
//            changes by less than the brightest over a tenth of an element.
TEST(RadiosityView, TwoViewsOfOneSolutionAgreeAtSharedPoints) {
  proves({"IU.6.5v"}, Oracle::metamorphic, "points that two cameras share");
  const SolvedRoom room = solved_room();
  double brightest = 0;
  for (const Rgb& value : room.radiosity) brightest = std::max(brightest, value.maxCoeff());
  std::mt19937_64 random(63);
  std::uniform_real_distribution<double> entry(-1, 1);
  const auto within_room = [&] {
    Vec3 eye = Vec3::Zero();
    for (Eigen::Index k = 0; k < 3; ++k) eye(k) = entry(random);
    return Vec3(1.3 * eye.x(), 0.8 * eye.y(), 0.6 + 0.5 * eye.z());
  };
  double least = 1e300, most = 0;
  for (int trial = 0; trial < 8; ++trial) {
    Camera first;
    first.eye = within_room();
    first.gaze = within_room() - first.eye;
    first.up = Vec3(0.1, 0.2, 1);
    first.horizontal_half_angle = 0.7;
    first.columns = 12;
    first.rows = 9;
    const auto picture = trace_radiosities(first, room.mesh, room.vertices, Rgb::Constant(-1), 1);
    ASSERT_TRUE(picture.ok());
    const Vec3 g = first.gaze.normalized(), x = g.cross(first.up).normalized(), y = x.cross(g);
    for (int row = 0; row < first.rows; ++row) {
      for (int column = 0; column < first.columns; ++column) {
        const double s = 2 * (column + 0.5) / first.columns - 1, t = 1 - 2 * (row + 0.5) / first.rows;
        const Vec3 d = g + s * std::tan(0.7) * x + t * std::tan(0.7) * first.rows / first.columns * y;
        Camera second;
        second.eye = within_room();
        second.gaze = far_end(first.eye, d) - second.eye;
        second.up = Vec3(0.3, -0.2, 1);
        second.horizontal_half_angle = 0.2;
        second.columns = second.rows = 1;
        const auto shared = trace_radiosities(second, room.mesh, room.vertices, Rgb::Constant(-2), 1);
        ASSERT_TRUE(shared.ok());
        for (int c = 0; c < 3; ++c) {
          EXPECT_TRUE(near(shared->pixels[0](c), picture->at(column, row)(c), 1e-11 * brightest));
        }
        least = std::min(least, shared->pixels[0](0));
        most = std::max(most, shared->pixels[0](0));
      }
    }
  }
  EXPECT_GT(most, 2 * least) << "the views show a solution that varies";
}

// CLAIM      The view by rays is the view by the rasteriser: backs, near plane, background and interpolation are the same.
// ORACLE     another method in this program: depth buffer and ray tree share the camera's frame and the mesh only.
// TOLERANCE  as ShowsTheSameValueFromEveryCamera: 1/4096 of a pixel moves a shown point; here 1/1000 of the brightest value for a
//            sample. Where an outline passes within 1/4096 of a pixel of a sample they may differ: in 1 of 1000 samples.
TEST(RadiosityView, RaysShowWhatTheRasteriserDraws) {
  proves({"IU.6.5", "IU.6.5v"}, Oracle::program, "the rasteriser");
  SolvedRoom room = solved_room();
  double brightest = 0;
  for (const Rgb& value : room.radiosity) brightest = std::max(brightest, value.maxCoeff());
  std::mt19937_64 random(64);
  std::uniform_real_distribution<double> entry(-1, 1);
  std::uint64_t samples = 0, different = 0, background = 0;
  for (int trial = 0; trial < 10; ++trial) {
    Camera camera;  // every other one stands outside, where walls turn their backs
    const double x = entry(random), y = 0.8 * entry(random), tilt = 0.4 * entry(random);
    camera.eye = trial % 2 == 0 ? Vec3(x, y, 0.6) : Vec3(x, -4, 1);
    camera.gaze = trial % 2 == 0 ? Vec3(y, -x, tilt) : Vec3(0.2 * y, 4, tilt);
    camera.horizontal_half_angle = 0.6;
    camera.columns = 60;
    camera.rows = 45;
    const auto drawn = view_radiosities(camera, room.mesh, room.vertices, Rgb::Constant(-1), 1);
    const auto traced = trace_radiosities(camera, room.mesh, room.vertices, Rgb::Constant(-1), 1);
    ASSERT_TRUE(drawn.ok() && traced.ok());
    for (std::size_t k = 0; k < drawn->pixels.size(); ++k) {
      ++samples;
      background += traced->pixels[k](0) == -1;
      different += (drawn->pixels[k] - traced->pixels[k]).abs().maxCoeff() > 1e-3 * brightest;
    }
  }
  EXPECT_GT(background, 1000u);
  EXPECT_TRUE(within(static_cast<double>(different), 1e-3 * static_cast<double>(samples)));
}

// CLAIM      Pictures that cannot be drawn are refused, as are cameras that see nothing definite.
// ORACLE     identity: such cameras.
// TOLERANCE  none: refusals.
TEST(RadiosityView, RefusesImpossibleCameras) {
  proves({"IU.5.2", "G11"}, Oracle::identity, "cameras with one defect each");
  const ElementMesh mesh = *mesh_elements(room_of({0, 0, 0}, {1, 1, 1}));
  const auto vertices = vertex_radiosities(mesh, std::vector<Rgb>(6, Rgb::Ones()));
  Camera camera;
  camera.up = camera.gaze;
  EXPECT_TRUE(holds(!view_radiosities(camera, mesh, vertices, Rgb::Zero(), 1).ok()));
  EXPECT_TRUE(holds(!trace_radiosities(camera, mesh, vertices, Rgb::Zero(), 1).ok()));
  camera = Camera{};
  camera.columns = 60000;
  camera.rows = 1;
  EXPECT_TRUE(holds(!view_radiosities(camera, mesh, vertices, Rgb::Zero(), 2).ok()));
  EXPECT_TRUE(view_radiosities(camera, mesh, vertices, Rgb::Zero(), 1).ok());
}

}  // namespace
}  // namespace etendue::validation
