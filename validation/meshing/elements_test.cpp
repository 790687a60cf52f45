// SPDX-License-Identifier: Apache-2.0
#include "etendue/meshing/elements.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "etendue/meshing/element_count.hpp"
#include "etendue/meshing/surface_checks.hpp"
#include "meshing/small_scenes.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

// CLAIM      IU.6.7.1 (patches and elements): a quadrilateral of 6 × 4 elements in 3 × 2 patches has 24 elements of
//            equal area in 6 patches of four neighbours each; corners are shared to the last bit, so the areas leave no
//            gap.
// ORACLE     closed form: counts, areas and centroids of a rectangle's grid, in dyadic coordinates.
// TOLERANCE  none: every number is exact in double.
TEST(Elements, DivideAQuadrilateralIntoElementsAndPatches) {
  proves({"IU.f62"}, Oracle::closed_form, "the grid of a rectangle in dyadic coordinates");
  Scene scene = scene_of({quadrilateral({0, 0, 1}, {6, 0, 1}, {6, 4, 1}, {0, 4, 1})});
  scene.objects[0].subdivision = {{6, 4}, {3, 2}};
  const auto mesh = mesh_elements(scene);
  ASSERT_TRUE(mesh.ok());
  ASSERT_EQ(mesh->elements.size(), 24u);
  EXPECT_EQ(mesh->patches, 6u);
  std::uint64_t wrong = 0, checked = 0;
  std::map<std::size_t, std::vector<Vec3>> members;
  for (std::size_t k = 0; k < 24; ++k, ++checked) {
    const Element& element = mesh->elements[k];
    const Vec3 expected(0.5 + static_cast<double>(k % 6), 0.5 + static_cast<double>(k / 6), 1);
    wrong += element.polygon.centroid() != expected || element.polygon.area() != 1 ||
             element.polygon.normal() != Vec3::UnitZ();
    members[element.patch].push_back(expected);
  }
  EXPECT_TRUE(all_agree(wrong, checked));
  for (const auto& [patch, centroids] : members) {
    ASSERT_EQ(centroids.size(), 4u) << patch;
    for (const Vec3& centroid : centroids) EXPECT_LE((centroid - centroids.front()).cwiseAbs().sum(), 2);
  }
}

// CLAIM      Neighbouring elements share corners bit by bit on a skew quadrilateral in general position: 7 × 5 elements
//            have 8 · 6 distinct corners.
// ORACLE     identity: Euler's count of a grid.
// TOLERANCE  none: equality of doubles.
TEST(Elements, ShareTheirCornersToTheLastBit) {
  proves({"IU.f62"}, Oracle::identity, "number of vertices of a grid");
  const Vec3 origin(0.1, 0.7, -0.3), u(1.1, 0.3, 0.9), v(-0.2, 1.7, 0.13);
  Scene scene = scene_of({quadrilateral(origin, origin + u, origin + u + v, origin + v)});
  scene.objects[0].subdivision = {{7, 5}, {1, 1}};
  const auto mesh = mesh_elements(scene);
  ASSERT_TRUE(mesh.ok());
  std::set<std::array<double, 3>> corners;
  for (const Element& element : mesh->elements) {
    for (const Vec3& p : element.polygon.vertices()) corners.insert({p.x(), p.y(), p.z()});
  }
  EXPECT_TRUE(near(static_cast<double>(corners.size()), 48, 0));
  EXPECT_EQ(mesh->elements.size(), 35u);
}

// CLAIM      A box has six faces that look outward, and a mesh an element a triangle.
// ORACLE     identity: the divergence theorem: Σ A_i n_i · c_i / 3 is the volume, positive for outward normals, and
//            Σ A_i n_i = 0 for a closed surface.
// TOLERANCE  16 roundings of magnitudes below 16 for the turned box.
TEST(Elements, TurnTheFacesOfABoxOutward) {
  proves({"IU.f62"}, Oracle::identity, "divergence theorem");
  Mat3 axes;
  axes << 0.36, 0.48, -0.8, -0.8, 0.6, 0, 0.48, 0.64, 0.6;
  Scene scene = scene_of({Box{{1, 2, 3}, axes, {0.5, 1, 1.5}}});
  scene.objects[0].subdivision = {{2, 2}, {1, 1}};
  const auto mesh = mesh_elements(scene);
  ASSERT_TRUE(mesh.ok());
  EXPECT_EQ(mesh->faces.size(), 6u);
  EXPECT_EQ(mesh->elements.size(), 24u);
  EXPECT_EQ(mesh->patches, 6u);
  double volume = 0;
  Vec3 closed = Vec3::Zero();
  for (const Element& element : mesh->elements) {
    volume += element.polygon.area() * element.polygon.normal().dot(element.polygon.centroid()) / 3;
    closed += element.polygon.area() * element.polygon.normal();
  }
  constexpr double tolerance = 24 * 16 * 16 * 0x1p-53;
  EXPECT_TRUE(near(volume, 6, tolerance));
  EXPECT_TRUE(near(closed.norm(), 0, tolerance));

  const Mesh tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  const auto triangles = mesh_elements(scene_of({tetrahedron}));
  ASSERT_TRUE(triangles.ok());
  EXPECT_EQ(triangles->elements.size(), 4u);
  EXPECT_EQ(triangles->faces.size(), 4u);
}

// CLAIM      The elements of a scene can be counted without making them.
// ORACLE     closed form: 6 × 4 of a quadrilateral, 6 · 3 · 2 of a box, 1 of a triangle and of a pentagon, 4 of a
//            tetrahedron; as many are made.
// TOLERANCE  none: counts.
TEST(Elements, AreCountedBeforeTheyAreMade) {
  proves({}, Oracle::closed_form, "products of divisions");
  const Mesh tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  const Box box{{0, 0, 0}, Mat3::Identity(), {1, 1, 1}};
  Scene scene = scene_of({quadrilateral({0, 0, 1}, {6, 0, 1}, {6, 4, 1}, {0, 4, 1}), box,
                          Triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                          polygon({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {2, 2, 0}, {0, 2, 0}}), tetrahedron});
  scene.objects[0].subdivision = {{6, 4}, {3, 2}};
  scene.objects[1].subdivision = {{3, 2}, {1, 1}};
  EXPECT_TRUE(near(static_cast<double>(count_elements(scene)), 24 + 36 + 1 + 1 + 4, 0));
  const auto mesh = mesh_elements(scene);
  ASSERT_TRUE(mesh.ok());
  EXPECT_TRUE(near(static_cast<double>(mesh->elements.size()), 24 + 36 + 1 + 1 + 4, 0));
}

// CLAIM      IU.6.5 (meshes by size): no side of an element is longer than the element size; quadrilaterals have the fewest
//            columns and rows for that, multiples of the patches; triangles n² congruent ones; a pentagon n² in each triangle
//            with the centroid; areas fill the faces, and the count is known before.
// ORACLE     closed form: ⌈edge/size⌉ by hand, areas.
// TOLERANCE  sides: the share that is allowed. Areas: 64 roundings of 16 for each element.
TEST(Elements, KeepWithinTheirSize) {
  proves({"IU.6.5"}, Oracle::closed_form, "quotients of edges by hand");
  const Polygon trapezoid = quadrilateral({0, 0, 0}, {3, 0, 0}, {2, 1, 0}, {0, 1, 0});
  const Polygon pentagon = polygon({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {2, 2, 0}, {0, 2, 0}});
  const Triangle triangle{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};
  struct Case {
    Shape shape;
    int patches;
    double size, area;
    std::size_t elements, in_patches;
  };
  const std::vector<Case> cases{
      {trapezoid, 1, 0.3, 2.5, 10 * 5, 1},  // 3/0.3 is ten, and √2/0.3 is above four
      {trapezoid, 1, 0.1, 2.5, 30 * 15, 1},
      {trapezoid, 4, 0.3, 2.5, 12 * 8, 16},
      {trapezoid, 1, 7, 2.5, 1, 1},
      {quadrilateral({0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {0, 1, 0}), 1, 0.3, 2.5, 10 * 5, 1},
      {quadrilateral({0, 0, 0}, {4.2, 0, 0}, {4.2, 2.1, 0}, {0, 2.1, 0}), 1, 0.7, 8.82, 6 * 3,
       1},  // in double 4.2/0.7 is above 6
      {triangle, 1, 0.5, 6, 100, 1},
      {triangle, 1, 5, 6, 1, 1},
      {pentagon, 1, 2, 5, 1, 1},
      {pentagon, 1, 1, 5, 5 * 4, 1},  // its longest edge has 2, its centroid's farthest corner is 1.7 away
      {Box{{0, 0, 0}, Mat3::Identity(), {0.5, 1, 1.5}}, 1, 0.5, 22, 2 * (4 * 6 + 2 * 6 + 2 * 4), 6},
  };
  for (const Case& one : cases) {
    Scene scene = scene_of({one.shape});
    scene.objects[0].subdivision = {{7, 7}, {one.patches, one.patches}, one.size};
    const auto mesh = mesh_elements(scene);
    ASSERT_TRUE(mesh.ok()) << mesh.error().message;
    EXPECT_TRUE(near(static_cast<double>(mesh->elements.size()), static_cast<double>(one.elements), 0)) << one.size;
    EXPECT_TRUE(near(static_cast<double>(count_elements(scene)), static_cast<double>(one.elements), 0));
    EXPECT_TRUE(near(static_cast<double>(mesh->patches), static_cast<double>(one.in_patches), 0));
    double longest = 0, area = 0;
    for (const Element& element : mesh->elements) {
      const auto& v = element.polygon.vertices();
      for (std::size_t k = 0; k < v.size(); ++k) longest = std::max(longest, (v[(k + 1) % v.size()] - v[k]).norm());
      area += element.polygon.area();
    }
    EXPECT_TRUE(within(longest, one.size * (1 + 0x1p-39)));
    EXPECT_TRUE(near(area, one.area, 64 * 16 * 0x1p-53 * static_cast<double>(one.elements)));
  }
  Scene box = scene_of({Box{{0, 0, 0}, Mat3::Identity(), {0.5, 1, 1.5}}});
  box.objects[0].subdivision = {{1, 1}, {3, 1}, 0.5};
  // Edges of 1, 2 and 3 in 2, 4 and 6, or as first edges in 3, 6 and 6 elements.
  EXPECT_TRUE(near(static_cast<double>(count_elements(box)), 3 * 4 + 6 * 2 + 6 * 6 + 6 * 4 + 6 * 2 + 3 * 6, 0));
  EXPECT_TRUE(near(static_cast<double>(mesh_elements(box)->elements.size()), 114, 0));
}

// CLAIM      What cannot be divided is refused; the message names the object and says what to use.
// ORACLE     identity: scenes with one such object each.
// TOLERANCE  none: refusals and their words.
TEST(Elements, RefuseWhatCannotBeDivided) {
  proves({"IU.f62"}, Oracle::identity, "scenes with one defect each");
  struct Case {
    Shape shape;
    Subdivision subdivision;
    const char* words;
  };
  const Polygon dart = polygon({{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5, 1, 0}});
  const Polygon square = polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const Triangle triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Case> cases{
      {Sphere{{0, 0, 0}, 1}, {}, "is a sphere: radiosity elements are flat; approximate it by a mesh"},
      {Disc{{0, 0, 0}, {0, 0, 1}, 1}, {}, "is a disc"},
      {Cylinder{{0, 0, 0}, {0, 0, 1}, 1}, {}, "is a cylinder"},
      {Plane{{0, 0, 0}, {0, 0, 1}}, {}, "use a polygon"},
      {Cone{{0, 0, 0}, {0, 0, 1}, 1, 0}, {}, "is a cone: neither radiosity nor form factors know such surfaces;"},
      {Torus{{0, 0, 0}, {0, 0, 1}, 2, 1}, {}, "is a torus: neither"},
      {Quadric{Mat3::Identity(), Vec3::Zero(), -1, Box{Vec3::Zero(), Mat3::Identity(), Vec3::Ones()}},
       {},
       "is a quadric: neither"},
      {BezierSurface{}, {}, "is a bezier surface: neither"},
      {PolygonWithHoles::make(square, {{{0.2, 0.2, 0}, {0.4, 0.2, 0}, {0.2, 0.4, 0}}}).value(),
       {},
       "has holes: neither radiosity nor form factors know such polygons; divide it into convex ones"},
      {dart, {{2, 1}, {1, 1}}, "is concave: only quadrilaterals have rows and columns of elements and patches;"},
      {triangle, {{2, 1}, {1, 1}}, "has 3 corners: only quadrilaterals have rows and columns of elements and patches;"},
      {triangle,
       {{1, 1}, {2, 1}, 0.1},
       "has 3 corners: only quadrilaterals have rows and columns of elements and patches;"},
      {triangle, {{1, 1}, {1, 1}, 1e-4}, "along an edge: element_size 0.0001 is too small"},
      {square, {{1, 1}, {1, 1}, 1e-4}, "would have more than 1048576 elements on a face, or 4096 along an edge"},
      {square, {{1, 1}, {1, 1}, 1.0 / 1025}, "element_size 0.00097561 is too small"},
      {square, {{1, 1}, {1, 1}, 1e-300}, "is too small"},
      {square, {{3, 2}, {2, 1}}, "3 × 2 elements in 2 × 1 patches: patches must divide the elements"},
  };
  for (const Case& one : cases) {
    Scene scene = scene_of({one.shape});
    scene.objects[0].subdivision = one.subdivision;
    const auto refused = mesh_elements(scene);
    ASSERT_FALSE(refused.ok()) << one.words;
    const std::string& message = refused.error().message;
    EXPECT_TRUE(holds(refused.error().code == ErrorCode::invalid_input));
    EXPECT_TRUE(holds(message.find("object 'object 0'") != std::string::npos)) << message;
    EXPECT_TRUE(holds(message.find(one.words) != std::string::npos)) << message;
    // Form factors take spheres, discs and cylinders whole; nothing else is left out in silence.
    const bool whole = std::holds_alternative<Sphere>(one.shape) || std::holds_alternative<Disc>(one.shape) ||
                       std::holds_alternative<Cylinder>(one.shape);
    const auto rest = mesh_elements(scene, CurvedObjects::left_out);
    EXPECT_TRUE(holds(rest.ok() == whole && (whole || rest.error().message == message))) << one.words;
  }
  EXPECT_TRUE(mesh_elements(scene_of({triangle})).ok());
  EXPECT_FALSE(mesh_elements(Scene{}).ok());
}

// CLAIM      A pile of surfaces is reported by no more than a few lines a surface, with the number of all overlapping pairs.
// ORACLE     closed form: n (n − 1)/2 pairs; a surface with k below it names three of them, and counts the other k − 3 if any.
// TOLERANCE  none: counts.
TEST(Overlaps, OfAPileAreCounted) {
  proves({}, Oracle::closed_form, "pairs in a pile");
  constexpr std::size_t kPile = 60;
  Scene scene = scene_of(std::vector<Shape>(kPile, quadrilateral({0, 0, 1}, {6, 0, 1}, {6, 4, 1}, {0, 4, 1})));
  const auto mesh = mesh_elements(scene);
  ASSERT_TRUE(mesh.ok());
  const auto checked = check_overlaps(scene, *mesh);
  ASSERT_FALSE(checked.ok());
  const std::string text = checked.error().message;
  EXPECT_TRUE(near(static_cast<double>(std::count(text.begin(), text.end(), '\n')), 1 + 2 + 3 + 4 * (kPile - 4), 0))
      << text;
  EXPECT_TRUE(holds(text.find(" overlaps 56 objects more\n") != std::string::npos)) << text;
  EXPECT_TRUE(holds(text.find("\n1770 errors") != std::string::npos)) << text;
}

}  // namespace
}  // namespace etendue::validation
