// SPDX-License-Identifier: Apache-2.0
#include "form_factor/catalogue/algebra_elements.hpp"
#include "form_factor/catalogue/algebra_flat.hpp"
#include "form_factor/catalogue/algebra_round.hpp"

namespace etendue::validation {
namespace {

// CLAIM      IU.6-3, IU.6-5, IU.6-6: the entries of the catalogue obey closure, reciprocity, superposition and means among one
//            another and agree with the polygon engine; every entry takes part in a relation that is not its own formula.
// ORACLE     identity: configuration algebra; the polygon engine with its bound.
// TOLERANCE  twelve digits; the engine's bound; limits as each says.
TEST(Catalogue, ObeysTheAlgebraOfConfigurations) {
  proves({"IU.6-3", "IU.6-5", "IU.6-6"}, Oracle::identity,
         "closure, reciprocity, superposition, means over 90 entries");
  Algebra f;
  polygons_from_elements(f);
  pairs_of_polygons(f);
  boxes(f);
  elements_and_discs(f);
  elements_and_solids(f);
  strips(f);
  tubes(f);
  discs_and_annuli(f);
  cylinders(f);
  nested_cylinders(f);
  spheres(f);
  cones(f);
  for (const auto& entry : catalogue::entries()) {
    EXPECT_TRUE(holds(f.used().count(entry.id) == 1)) << entry.id << " takes part in no relation";
  }
}

// CLAIM      IU.6-5: the factor back is the factor there times the ratio of the areas, and is that of the mirrored entry.
// ORACLE     identity: entries with their surfaces exchanged.
// TOLERANCE  twelve digits.
TEST(Catalogue, GivesTheFactorBack) {
  proves({"IU.6-5"}, Oracle::identity, "7 entries against the same with the surfaces exchanged");
  const auto back = [](const char* id, const std::vector<double>& values) {
    return catalogue::reverse_form_factor(*catalogue::find(id), values).value()->value;
  };
  Algebra f;
  equal(back("C-14", {0.7, 1.3, 0.9}), f("C-14", {1.3, 0.7, 0.9}), "C-14");
  equal(back("C-41", {0.7, 1.3, 0.9}), f("C-41", {1.3, 0.7, 0.9}), "C-41");
  equal(back("C-5a", {0.7, 1.3, 50}), f("C-5a", {1.3, 0.7, 50}), "C-5a");
  equal(back("unequal-tubes", {0.7, 1.3, 0.9}), f("unequal-tubes", {1.3, 0.7, 0.9}), "unequal-tubes");
  equal(back("sphere-sphere", {0.7, 1.3, 0.9}), f("sphere-sphere", {1.3, 0.7, 0.9}), "sphere-sphere");
  equal(back("C-52", {0.3, 0.7, 0.5, 1.3, 0.9}), f("C-52", {0.5, 1.3, 0.3, 0.7, 0.9}), "C-52");
  one(back("sphere-in-sphere", {0.4, 1}), "all that leaves the inner sphere arrives at the outer");
  one(back("cap-base", {0.9, 0.5}), "all that leaves the base arrives at the cap");
  one(back("cone-base", {0.9, 0.5}), "all that leaves the base arrives at the cone");
  const auto none = catalogue::reverse_form_factor(*catalogue::find("B-12"), std::vector<double>{1, 1});
  EXPECT_TRUE(holds(none.ok() && !none->has_value()));
}

}  // namespace
}  // namespace etendue::validation
