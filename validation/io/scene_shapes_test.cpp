// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>
#include <vector>

#include "etendue/acceleration/accelerator.hpp"
#include "etendue/io/scene_keys.hpp"
#include "io/scene_texts.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

// CLAIM      Cones, tori, quadrics, bezier surfaces and polygons with holes stand where their transforms put them.
// ORACLE     exact: positions worked out by hand in integers; of the quadric the points where it is zero.
// TOLERANCE  none: all results are dyadic.
TEST(SceneShapes, PlacesCurvedShapesExactlyUnderQuarterTurns) {
  proves({"IU.5.0"}, Oracle::exact, "integer positions worked out by hand");
  const TemporaryFolder folder;
  const Scene scene = read(
      folder,
      scene_of(
          R"({"type": "group", "transform": [{"rotate": {"axis": [0, 0, 5], "angle_deg": 90}}, {"translate": [10, 0, 0]}],
        "children": [
          {"type": "cone", "material": "a", "base": [1, 2, 3], "top": [2, 2, 3], "base_radius": 2, "transform": [{"scale": 2}]},
          {"type": "torus", "material": "a", "centre": [1, 0, 0], "axis": [4, 0, 0], "ring_radius": 3, "tube_radius": 1},
          {"type": "quadric", "material": "a", "squares": [1, 2, 0], "products": [0, 0, 2], "linear": [0, 0, -1], "constant": 3,
           "low": [0, -2, 0], "high": [4, 2, 8], "transform": [{"scale": [2, 4, 1]}]},
          {"type": "bezier", "material": "a", "transform": [{"translate": [0, 0, 1]}], "control": [
            [[0, 0, 0], [0, 1, 0], [0, 2, 0], [0, 3, 0]], [[1, 0, 0], [1, 1, 0], [1, 2, 5], [1, 3, 0]],
            [[2, 0, 0], [2, 1, 0], [2, 2, 0], [2, 3, 0]], [[3, 0, 0], [3, 1, 0], [3, 2, 0], [3, 3, 0]]]},
          {"type": "polygon", "material": "a", "vertices": [[0, 0, 0], [4, 0, 0], [0, 4, 0]],
           "holes": [[[1, 1, 0], [2, 1, 0], [1, 2, 0]]]},
          {"type": "cylinder", "caps": false, "material": "a", "base": [0, 0, 0], "top": [0, 0, 1], "radius": 1}]})"));
  ASSERT_EQ(scene.objects.size(), 6u);
  const auto& cone = std::get<Cone>(scene.objects[0].shape);
  EXPECT_TRUE(cone.base == Vec3(6, 2, 6) && cone.top == Vec3(6, 4, 6) && cone.base_radius == 4 && cone.top_radius == 0);
  const auto& torus = std::get<Torus>(scene.objects[1].shape);
  EXPECT_TRUE(torus.centre == Vec3(10, 1, 0) && torus.axis == Vec3(0, 1, 0) && torus.ring == 3 && torus.tube == 1);
  // Box: centre (2, 0, 4), half edges (2, 2, 4); scaled (4, 0, 4) and (4, 8, 4); turned and moved.
  const auto& quadric = std::get<Quadric>(scene.objects[2].shape);
  EXPECT_EQ(quadric.box.centre, Vec3(10, 4, 4));
  EXPECT_EQ(quadric.box.half_edges, Vec3(4, 8, 4));
  EXPECT_EQ(quadric.box.axes.col(0), Vec3(0, 1, 0));
  // x² + 2y² + 2yz − z + 3, at places worked out by hand: local (x, y, z) stands at (10 − 4y, 2x, z).
  for (const Vec3& local : {Vec3(0, 0, 3), Vec3(2, 0, 7), Vec3(1, -1, 2), Vec3(1, 1, -6), Vec3(4, 3, 5)}) {
    const double f = local.x() * local.x() + 2 * local.y() * local.y() + 2 * local.y() * local.z() - local.z() + 3;
    const Vec3 y = Vec3(10 - 4 * local.y(), 2 * local.x(), local.z()) - quadric.box.centre;
    EXPECT_TRUE(near(y.dot(quadric.square * y) + 2 * quadric.linear.dot(y) + quadric.constant, f, 0));
  }
  const auto& surface = std::get<BezierSurface>(scene.objects[3].shape);
  EXPECT_EQ(surface.control[1][2], Vec3(8, 1, 6));
  EXPECT_EQ(surface.control[3][0], Vec3(10, 3, 1));
  const auto& polygon = std::get<PolygonWithHoles>(scene.objects[4].shape);
  EXPECT_EQ(polygon.outline().vertices()[1], Vec3(10, 4, 0));
  EXPECT_EQ(polygon.holes()[0][2], Vec3(8, 1, 0));
}

// CLAIM      IU.5.0: a scene may have spheres, polygons, cones, tori and parametric surfaces, planes, discs, cylinders
//            and boxes; a ray meets each where it stands, whatever the accelerator.
// ORACLE     closed form: each shape touches the plane z = 1 from below, or passes through (0, 0, 1).
// TOLERANCE  2^-50 for t = 4: each shape's t is documented within one unit in its last place.
TEST(SceneShapes, ShowsShapesOfEveryTypeToRays) {
  proves({"IU.5.0", "IU.5.7"}, Oracle::closed_form, "shapes through the point (0, 0, 1)");
  const TemporaryFolder folder;
  const std::vector<std::pair<std::string, std::string>> shapes{
      {"sphere", R"("centre": [0, 0, -2], "radius": 3)"},
      {"polygon",
       R"("vertices": [[-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]], "holes": [[[0.5, 0, 1], [0.9, 0, 1], [0.5, 0.5, 1]]])"},
      {"triangle", R"("vertices": [[-1, -1, 1], [1, -1, 1], [0, 1, 1]])"},
      {"plane", R"("point": [7, 7, 1], "normal": [0, 0, 3])"},
      {"disc", R"("centre": [0.25, 0, 1], "normal": [0, 0, 1], "radius": 0.5)"},
      {"cylinder", R"("base": [-1, 0, 0.5], "top": [1, 0, 0.5], "radius": 0.5)"},
      {"cone", R"("caps": true, "base": [0, 0, 1], "top": [0, 0, -1], "base_radius": 1)"},
      {"torus", R"("centre": [-2, 0, 0], "axis": [0, 0, 1], "ring_radius": 2, "tube_radius": 1)"},
      {"quadric",
       R"("squares": [1, -1, 0], "linear": [0, 0, -1], "constant": 1, "centre": [0, 0, 1], "size": [1, 1, 1])"},
      {"bezier",
       R"("control": [[[-1, -1, 1], [-1, -0.5, 1], [-1, 0.5, 1], [-1, 1, 1]], [[-0.5, -1, 1], [-0.5, -0.5, 1], [-0.5, 0.5, 1], [-0.5, 1, 1]],
       [[0.5, -1, 1], [0.5, -0.5, 1], [0.5, 0.5, 1], [0.5, 1, 1]], [[1, -1, 1], [1, -0.5, 1], [1, 0.5, 1], [1, 1, 1]]])"},
      {"box", R"("low": [-1, -1, -1], "high": [1, 2, 1])"},
      {"mesh", R"("vertices": [[-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]], "quads": [[0, 1, 2, 3]])"},
  };
  std::vector<std::string> types = object_types();
  for (const auto& [type, keys] : shapes) {
    types.erase(std::remove(types.begin(), types.end(), type), types.end());
    const Scene scene = read(folder, scene_of(R"({"material": "a", "type": ")" + type + "\", " + keys + "}"));
    for (const AcceleratorKind kind :
         {AcceleratorKind::brute_force, AcceleratorKind::bounding_volumes, AcceleratorKind::bounding_spheres,
          AcceleratorKind::grid, AcceleratorKind::octree}) {
      const auto met = make_accelerator(scene, kind)->nearest(Ray{{0.0625, 0.0625, 5}, {-0.015625, -0.015625, -1}}).hit;
      ASSERT_TRUE(met) << type;
      EXPECT_TRUE(near(met->hit.t, 4, 0x1p-50)) << type;
    }
  }
  EXPECT_EQ(types, std::vector<std::string>{"group"});
}

}  // namespace
}  // namespace etendue::validation
