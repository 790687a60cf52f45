// SPDX-License-Identifier: Apache-2.0
#include "etendue/view/vertex_radiosity.hpp"

#include <random>

#include "meshing/small_scenes.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

// A flat square of columns × rows elements of size one.
ElementMesh grid(int columns, int rows) {
  const double x = columns, y = rows;
  Scene scene = scene_of({quadrilateral({0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0})});
  scene.objects[0].subdivision = {{columns, rows}, {1, 1}};
  return *mesh_elements(scene);
}

std::vector<Rgb> grey(const std::vector<double>& values) {
  std::vector<Rgb> result;
  for (const double value : values) result.push_back(Rgb::Constant(value));
  return result;
}

// Value at a corner of an element; corners run (0,0), (1,0), (1,1), (0,1) around each element.
double corner(const VertexRadiosities& vertices, std::size_t element, std::size_t k) {
  return vertices.corners[element][k](1);
}

// CLAIM      IU.6.5: in figure 58a the inner vertex e has the mean of its four patches, the edge vertex b has
//            B_1 + B_2 − B_e and the corner a has 2 B_1 − B_e.
// ORACLE     closed form: the three rules, by hand: B = 4, 8, 12, 24 give e = 12, b = 0, a = −4 → 0 and so on.
// TOLERANCE  none: small integers.
TEST(VertexRadiosity, FollowsTheThreeRulesOfTheText) {
  proves({"IU.6.5", "G13"}, Oracle::closed_form, "figure 58a by hand");
  const auto vertices = vertex_radiosities(grid(2, 2), grey({4, 8, 12, 24}));
  EXPECT_TRUE(near(corner(vertices, 0, 2), 12, 0));  // e
  EXPECT_TRUE(near(corner(vertices, 1, 3), 12, 0));
  EXPECT_TRUE(near(corner(vertices, 2, 1), 12, 0));
  EXPECT_TRUE(near(corner(vertices, 3, 0), 12, 0));
  EXPECT_TRUE(near(corner(vertices, 0, 1), 0, 0));   // 4 + 8 − 12
  EXPECT_TRUE(near(corner(vertices, 0, 3), 4, 0));   // 4 + 12 − 12
  EXPECT_TRUE(near(corner(vertices, 1, 2), 20, 0));  // 8 + 24 − 12
  EXPECT_TRUE(near(corner(vertices, 2, 2), 24, 0));  // 12 + 24 − 12
  EXPECT_TRUE(near(corner(vertices, 1, 1), 4, 0));   // 16 − 12
  EXPECT_TRUE(near(corner(vertices, 2, 3), 12, 0));  // 24 − 12
  EXPECT_TRUE(near(corner(vertices, 3, 2), 36, 0));  // 48 − 12
  // G13: the printed rule gives 2 · 4 − 12 = −4 at the corner a; no surface has a negative radiosity.
  EXPECT_LT(2 * 4 - 12, 0);
  EXPECT_TRUE(near(corner(vertices, 0, 0), 0, 0));
  EXPECT_EQ(vertices.clamped, 1u);
  EXPECT_EQ(vertices.vertices, 9u);
  EXPECT_EQ(vertices.without_interior, 0u);
}

// CLAIM      IU.6.5: a radiosity that is linear over the plane comes out exactly at every vertex, also at the corners
//            of a hole, across objects of one material, and on a skew grid in general position.
// ORACLE     identity: each rule is an affine combination whose points combine to the vertex.
// TOLERANCE  32 roundings of values below 64.
TEST(VertexRadiosity, ReproducesLinearFields) {
  proves({"IU.6.5"}, Oracle::identity, "a linear field");
  std::mt19937_64 random(60);
  std::uniform_real_distribution<double> entry(-1, 1);
  for (int trial = 0; trial < 30; ++trial) {
    const auto vector = [&] {
      const double x = entry(random), y = entry(random);
      return Vec3(x, y, entry(random));
    };
    const Vec3 origin = vector(), u = vector(), v = vector(), gradient = vector();
    if (u.cross(v).norm() < 0.2) continue;
    // A frame of four rectangles around a hole of 2 × 1 cells, 7 × 6 in all, as in the ceiling around a light.
    const auto block = [&](double a0, double a1, double b0, double b1) {
      const auto at = [&](double a, double b) { return Vec3(origin + a * u + b * v); };
      return quadrilateral(at(a0, b0), at(a1, b0), at(a1, b1), at(a0, b1));
    };
    Scene scene = scene_of({block(0, 3, 0, 6), block(5, 7, 0, 6), block(3, 5, 0, 2), block(3, 5, 3, 6)});
    const int cells[4][2] = {{3, 6}, {2, 6}, {2, 2}, {2, 3}};
    for (std::size_t k = 0; k < 4; ++k) scene.objects[k].subdivision = {{cells[k][0], cells[k][1]}, {1, 1}};
    const ElementMesh mesh = *mesh_elements(scene);
    ASSERT_EQ(mesh.elements.size(), 40u);
    const auto field = [&](const Vec3& p) { return 30 + gradient.dot(p); };
    std::vector<Rgb> radiosity;
    for (const Element& element : mesh.elements) radiosity.push_back(Rgb::Constant(field(element.polygon.centroid())));
    const auto vertices = vertex_radiosities(mesh, radiosity);
    EXPECT_EQ(vertices.vertices, 8u * 7u);
    EXPECT_EQ(vertices.clamped, 0u);
    EXPECT_EQ(vertices.without_interior, 0u);
    for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
      for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_TRUE(near(corner(vertices, k, c), field(mesh.elements[k].polygon.vertices()[c]), 32 * 64 * 0x1p-53));
      }
    }
  }
}

// CLAIM      IU.6.5, figure 58b: a mesh without inner vertices gets the mean of the elements around each vertex, which
//            is continuous; so do single elements.
// ORACLE     closed form: a strip of three, by hand.
// TOLERANCE  none: small integers.
TEST(VertexRadiosity, TreatsMeshesWithoutInnerVertices) {
  proves({"IU.6.5"}, Oracle::closed_form, "a strip of three elements by hand");
  const auto strip = vertex_radiosities(grid(3, 1), grey({2, 4, 12}));
  const double expected[3][4] = {{2, 3, 3, 2}, {3, 8, 8, 3}, {8, 12, 12, 8}};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t c = 0; c < 4; ++c) EXPECT_TRUE(near(corner(strip, k, c), expected[k][c], 0));
  }
  EXPECT_EQ(strip.without_interior, 8u);
  const auto single = vertex_radiosities(grid(1, 1), grey({7}));
  for (std::size_t c = 0; c < 4; ++c) EXPECT_TRUE(near(corner(single, 0, c), 7, 0));
}

// CLAIM      Vertices are shared within a plane and a material only: not around an edge of a box, nor between
//            neighbours of another colour. Covered elements take part in no mean.
// ORACLE     closed form: counts, and the values of separate surfaces.
// TOLERANCE  none: small integers.
TEST(VertexRadiosity, KeepsPlanesAndMaterialsApart) {
  proves({"IU.6.5"}, Oracle::closed_form, "separate surfaces by hand");
  Scene box = scene_of({Box{{0, 0, 0}, Mat3::Identity(), {1, 1, 1}}});
  EXPECT_EQ(vertex_radiosities(*mesh_elements(box), std::vector<Rgb>(6, Rgb::Ones())).vertices, 24u);

  Scene two = scene_of({quadrilateral({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}),
                        quadrilateral({1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0})});
  EXPECT_EQ(vertex_radiosities(*mesh_elements(two), grey({2, 6})).vertices, 6u);
  two.materials.push_back(two.materials[0]);
  two.objects[1].material = 1;
  const auto apart = vertex_radiosities(*mesh_elements(two), grey({2, 6}));
  EXPECT_EQ(apart.vertices, 8u);
  EXPECT_TRUE(near(corner(apart, 0, 1), 2, 0));
  EXPECT_TRUE(near(corner(apart, 1, 0), 6, 0));

  const auto covered = vertex_radiosities(grid(3, 1), grey({2, 100, 12}), {1});
  EXPECT_TRUE(near(corner(covered, 0, 1), 2, 0));
  EXPECT_TRUE(near(corner(covered, 2, 0), 12, 0));
}

}  // namespace
}  // namespace etendue::validation
