// SPDX-License-Identifier: Apache-2.0
#include "etendue/view/vertex_radiosity.hpp"

#include <array>
#include <map>
#include <random>

#include "etendue/meshing/shared_vertices.hpp"
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

// Floor of columns × rows unit elements with walls on it, cut at their feet; `away` from the origin.
ElementMesh with_walls(int columns, int rows, const std::vector<std::array<double, 4>>& feet, double away = 0) {
  const double x = away + columns, y = away + rows;
  Scene scene = scene_of({quadrilateral({away, away, 0}, {x, away, 0}, {x, y, 0}, {away, y, 0})});
  scene.objects[0].subdivision = {{columns, rows}, {1, 1}};
  for (const auto& foot : feet) {
    const double x0 = away + foot[0], y0 = away + foot[1], x1 = away + foot[2], y1 = away + foot[3];
    scene.objects.push_back({"wall", quadrilateral({x0, y0, 0}, {x1, y1, 0}, {x1, y1, 1}, {x0, y0, 1}), 0, {}});
  }
  scene.align_mesh = true;
  return with_shared_vertices(*mesh_elements(scene));
}

// CLAIM      IU.6.5.1, figure 59: of nine elements of which the three to the upper right receive light, the middle one, most of
//            which is dark, is shown graded from its lower left to its upper right: light leaks. Cut along the foot of the
//            surface that hides the light, all that is dark is shown dark, and all that is lit is shown lit.
// ORACLE     closed form: means of the numbers in the figure: 0, 1/4, 3/4, 1/4.
// TOLERANCE  none for the figure; one rounding where ones are averaged.
TEST(VertexRadiosity, LeaksAcrossAFootThatItsMeshDoesNotFollow) {
  proves({"IU.6.5.1"}, Oracle::closed_form, "figure 59 by hand");
  const auto nine = vertex_radiosities(grid(3, 3), grey({0, 0, 0, 0, 0, 1, 0, 1, 1}));
  const double shown[4] = {0, 0.25, 0.75, 0.25};
  for (std::size_t c = 0; c < 4; ++c) EXPECT_TRUE(near(corner(nine, 4, c), shown[c], 0));

  // The wall of scenes/leak: from (3, 0.7) to (0.4, 3).
  for (const double away : {0.0, 1e7}) {  // there coordinates are rounded to 2^-30
    const auto lit = [&](const Vec3& p) { return (p.x() - away - 3) * 2.3 + (p.y() - away - 0.7) * 2.6; };
    const ElementMesh mesh = with_walls(3, 3, {{3, 0.7, 0.4, 3}}, away);
    std::vector<Rgb> radiosity;
    for (const Element& element : mesh.elements) {
      radiosity.push_back(Rgb::Constant(lit(element.polygon.centroid()) > 0 && element.face == 0 ? 1 : 0));
    }
    const auto values = vertex_radiosities(mesh, radiosity);
    std::uint64_t pieces = 0;
    for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
      for (const Rgb& value : values.corners[k]) EXPECT_TRUE(near(value(0), radiosity[k](0), 0x1p-52)) << k;
      pieces += mesh.elements[k].cell == kNoCell;
    }
    EXPECT_EQ(pieces, 10u) << "the foot passes five of nine elements";
  }
}

// CLAIM      IU.6.5.1: a wall keeps the two sides of its foot apart, and no more: around its free end, also in the inside of an
//            element, the display is continuous, each side of an element being drawn alike from both; a vertex of the foot
//            has one value on each side.
// ORACLE     identity: values at the ends of every side, from the elements that have it; a count of the sides that differ.
// TOLERANCE  none: the same doubles, or not.
TEST(VertexRadiosity, IsContinuousBeyondTheEndOfAFoot) {
  proves({"IU.6.5.1", "IU.6.5"}, Oracle::identity, "sides from both elements");
  // From the border to the middle of the element [2, 3] × [1, 2], on a line that is no line of the grid.
  const ElementMesh mesh = with_walls(5, 3, {{0, 1.5, 2.5, 1.5}});
  std::vector<Rgb> radiosity;
  for (const Element& element : mesh.elements) {
    const Vec3& p = element.polygon.centroid();
    radiosity.push_back(Rgb::Constant(3 + p.x() * p.x() + (p.y() > 1.5 ? 7 : 0)));
  }
  const auto values = vertex_radiosities(mesh, radiosity);
  using End = std::array<double, 2>;
  std::map<std::pair<End, End>, std::vector<std::array<double, 2>>> sides;
  for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
    if (mesh.elements[k].face != 0) continue;
    const auto& v = mesh.elements[k].polygon.vertices();
    for (std::size_t c = 0; c < v.size(); ++c) {
      const std::size_t next = (c + 1) % v.size();
      const End a{v[c].x(), v[c].y()}, b{v[next].x(), v[next].y()};
      const double at_a = corner(values, k, c), at_b = corner(values, k, next);
      sides[{std::min(a, b), std::max(a, b)}].push_back(a < b ? std::array{at_a, at_b} : std::array{at_b, at_a});
    }
  }
  std::uint64_t wrong = 0, checked = 0, kept_apart = 0;
  for (const auto& [ends, seen] : sides) {
    if (seen.size() < 2) continue;
    const auto& [a, b] = ends;
    const bool foot = a[1] == 1.5 && b[1] == 1.5 && b[0] <= 2.5;
    kept_apart += foot;
    wrong += foot ? seen[0][0] == seen[1][0] : seen[0] != seen[1];
    ++checked;
  }
  EXPECT_TRUE(all_agree(wrong, checked));
  EXPECT_EQ(kept_apart, 3u) << "two elements' sides, and half of one";
}

// CLAIM      IU.6.5, figure 58b: in a mesh without inner vertices each vertex gets the mean of the elements around it, carried on by
//            the gradient of the elements beside it; of a row along the row only; a single element keeps its value.
// ORACLE     closed form: a strip of three, by hand: 2, 4, 12 rise by 2 at the one end, by 8 at the other.
// TOLERANCE  none: small integers.
TEST(VertexRadiosity, TreatsMeshesWithoutInnerVertices) {
  proves({"IU.6.5"}, Oracle::closed_form, "a strip of three elements by hand");
  const auto strip = vertex_radiosities(grid(3, 1), grey({2, 4, 12}));
  const double expected[3][4] = {{1, 3, 3, 1}, {3, 8, 8, 3}, {8, 16, 16, 8}};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t c = 0; c < 4; ++c) EXPECT_TRUE(near(corner(strip, k, c), expected[k][c], 0));
  }
  EXPECT_EQ(strip.without_interior, 8u);
  const auto single = vertex_radiosities(grid(1, 1), grey({7}));
  for (std::size_t c = 0; c < 4; ++c) EXPECT_TRUE(near(corner(single, 0, c), 7, 0));
}

// CLAIM      IU.6.5, figure 58b: without inner vertices too, a linear radiosity comes out exactly: around a hole, on an L, on a
//            strip of triangles; and on a row as far as it changes along it.
// ORACLE     identity: a linear field.
// TOLERANCE  1024 roundings of values below 64: sums of squares of at most eight centroids, divided by the smaller spread, which
//            in these meshes is at least a tenth of the larger.
TEST(VertexRadiosity, ReproducesLinearFieldsWithoutInnerVertices) {
  proves({"IU.6.5"}, Oracle::identity, "a linear field");
  constexpr std::uint64_t kSeed = 58;
  uses_seed(kSeed);
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> entry(-1, 1);
  const auto vector = [&] {
    const double x = entry(random), y = entry(random);
    return Vec3(x, y, entry(random));
  };
  int tried = 0;
  while (tried < 20) {
    const Vec3 origin = vector(), u = vector(), v = vector(), gradient = vector();
    if (u.cross(v).norm() < 0.3) continue;
    ++tried;
    const auto at = [&](double a, double b) { return Vec3(origin + a * u + b * v); };
    const auto block = [&](double a0, double a1, double b0, double b1) {
      return quadrilateral(at(a0, b0), at(a1, b0), at(a1, b1), at(a0, b1));
    };
    const auto three = [&](double a, double b, double c, double d, double e, double f) {
      return polygon({at(a, b), at(c, d), at(e, f)});
    };
    struct Case {
      std::vector<Shape> shapes;
      Vec3 slope;
    };
    const Vec3 along = u.normalized() * gradient.dot(u.normalized());
    const std::vector<Case> cases{
        {{block(0, 2, 0, 1), block(2, 3, 0, 2), block(1, 3, 2, 3), block(0, 1, 1, 3)}, gradient},
        {{block(0, 1, 0, 1), block(1, 2, 0, 1), block(0, 1, 1, 2)}, gradient},
        {{three(0, 0, 1, 0, 0, 1), three(1, 0, 1, 1, 0, 1), three(1, 0, 2, 0, 1, 1), three(2, 0, 2, 1, 1, 1)},
         gradient},
        {{block(0, 1, 0, 1), block(1, 3, 0, 1), block(3, 4, 0, 1)}, along},
        {{three(0, 0, 1, 0.1, 0, 1)}, Vec3::Zero()},
    };
    for (const Case& one : cases) {
      const ElementMesh mesh = with_shared_vertices(*mesh_elements(scene_of(one.shapes)));
      const Vec3 middle = mesh.elements[0].polygon.centroid();
      const auto field = [&](const Vec3& p) { return 30 + one.slope.dot(p); };
      std::vector<Rgb> radiosity;
      for (const Element& element : mesh.elements) {
        radiosity.push_back(Rgb::Constant(field(element.polygon.centroid())));
      }
      const auto values = vertex_radiosities(mesh, radiosity);
      EXPECT_EQ(values.without_interior, values.vertices);
      for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
        for (std::size_t c = 0; c < values.corners[k].size(); ++c) {
          Vec3 corner_at = mesh.elements[k].polygon.vertices()[c];
          // Of a row, the point beside the vertex on the line of centroids.
          if (&one == &cases[3]) corner_at = middle + u.normalized() * u.normalized().dot(corner_at - middle);
          EXPECT_TRUE(near(corner(values, k, c), field(corner_at), 1024 * 64 * 0x1p-53)) << &one - cases.data();
        }
      }
    }
  }
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
