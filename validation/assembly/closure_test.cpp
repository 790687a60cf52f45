// SPDX-License-Identifier: Apache-2.0
#include "etendue/assembly/closure.hpp"

#include "etendue/form_factor/polygon_polygon.hpp"
#include "meshing/small_scenes.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

std::vector<Outlook> outlooks(const Scene& scene) {
  const ElementMesh mesh = *mesh_elements(scene);
  return closure_report(mesh, assemble_form_factors(mesh, {}, {})).outlooks;
}

Object plate(const std::string& name, const Polygon& polygon) {
  return {name, polygon, 0, {}};
}

// CLAIM      IU.6-6: an element is told closed, open, covered or facing the void by its row sum, its bounds, and what
//            stands around it; a scene in which nothing sees anything has nothing to judge.
// ORACLE     identity: scenes whose outlook is plain: a box, a box without its lid, a plate alone, a plate in a box.
// TOLERANCE  none.
TEST(Closure, TellsWhatEachElementSees) {
  proves({"IU.6-6"}, Oracle::identity, "scenes whose outlook is plain");
  std::uint64_t wrong = 0;
  const auto expect = [&](bool right, const char* what) {
    if (!right) ++wrong;
    EXPECT_TRUE(right) << what;
  };
  const Scene box = room_of({0, 0, 0}, {2, 3, 1.5});
  expect(outlooks(box) == std::vector<Outlook>(6, Outlook::closed), "a closed box");

  Scene open = box;
  open.objects.pop_back();
  expect(outlooks(open) == std::vector<Outlook>(5, Outlook::open), "a box without a side");

  Scene alone = box;
  alone.objects = {plate("plate", quadrilateral({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}))};
  expect(outlooks(alone) == std::vector<Outlook>(1, Outlook::facing_void), "a plate alone");

  // A floor under a hood whose sides and top show it their backs, and which itself faces the void.
  Scene hood = alone;
  hood.objects.push_back({"hood", Box{{0.5, 0.5, 0.5}, Mat3::Identity(), {2, 2, 1}}, 0, {}});
  std::vector<Outlook> expected(7, Outlook::facing_void);
  expected[0] = Outlook::covered;
  expect(outlooks(hood) == expected, "a plate under a hood");

  const ElementMesh mesh = *mesh_elements(alone);
  const ClosureReport nothing = closure_report(mesh, assemble_form_factors(mesh, {}, {}));
  expect(nothing.judged == 0 && nothing.facing_void == 1 && nothing.covered.empty(), "nothing to judge");
  EXPECT_TRUE(all_agree(wrong, 5));
}

// CLAIM      IU.6-6: surfaces that overlap show: an element that is there twice is seen twice.
// ORACLE     identity: the row sum of the opposite side is 1 + F to the doubled one.
// TOLERANCE  the row's bounds and the factor's.
TEST(Closure, ShowsOverlappingSurfaces) {
  proves({"IU.6-6"}, Oracle::identity, "a side that is there twice");
  Scene twice = room_of({0, 0, 0}, {2, 3, 1.5});
  twice.objects.push_back(twice.objects.front());
  const ElementMesh mesh = *mesh_elements(twice);
  const FormFactorMatrix matrix = assemble_form_factors(mesh, {}, {});
  const ClosureReport closure = closure_report(mesh, matrix);
  EXPECT_EQ(closure.exceeded, 5u);
  for (Eigen::Index i = 1; i < 6; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Bounded again = form_factor(mesh.elements[k].polygon, mesh.elements[0].polygon);
    EXPECT_TRUE(near(closure.row_sums(i), 1 + again.value, closure.row_bounds(i) + again.bound));
  }
}

}  // namespace
}  // namespace etendue::validation
