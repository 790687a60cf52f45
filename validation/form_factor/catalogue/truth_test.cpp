// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>
#include <sstream>

#include "form_factor/catalogue/configurations.hpp"
#include "oracles/catalogue_truth.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"
#include "support/exhibit.hpp"
#include "support/long_run.hpp"

namespace etendue::validation {
namespace {

constexpr std::uint64_t kSeed = 20240611;
/// Twelve digits of the factor: what the double-exponential rules are good for, not what the formulas are.
constexpr double kTwelveDigits = 1e-12;
/// The oracle of these takes a closure, 1 − x: it knows the difference to twelve digits of 1.
bool by_closure(const std::string& id) {
  return id == "cone-self" || id == "frustum-self" || id == "box-walls-self";
}

/// What `etendue` computes this factor by.
std::string command_for(const catalogue::Entry& entry, const std::vector<double>& values) {
  std::ostringstream text;
  text.precision(17);
  text << "etendue catalogue " << entry.id;
  for (std::size_t i = 0; i < values.size(); ++i) text << " --" << entry.parameters[i].symbol << " " << values[i];
  return text.str();
}

oracle::Truths all_truths() {
  oracle::Truths all;
  for (const auto& some : {oracle::truths_of_elements(), oracle::truths_of_strips(), oracle::truths_of_rectangles(),
                           oracle::truths_of_discs_and_cylinders(), oracle::truths_of_spheres_and_cones()}) {
    all.insert(some.begin(), some.end());
  }
  return all;
}

// CLAIM      IU.6-2, IU.6-3: every configuration of the catalogue has the factor that the integral defines.
// ORACLE     identity: the kernel over the visible parts of both surfaces, by double-exponential rules in extended
//            precision; polygons by the contour integral in 600-bit balls.
// TOLERANCE  twelve digits of the factor (of 1 where the oracle is a closure) and the returned bound.
TEST(Catalogue, HasTheFactorsThatTheIntegralDefines) {
  proves({"IU.6-2", "IU.6-3"}, Oracle::identity,
         "every entry at one set of random parameters of ratios to 9 (in a long run three), by quadrature");
  uses_seed(kSeed);
  const std::size_t rows = 3 / every(3);  // more meet places that the rules of the oracle do not resolve
  constexpr double kSpread = 9, kMargin = 0.05;
  const oracle::Truths truths = all_truths();
  CounterRandom random(kSeed);
  WorstInput worst{"The factor of the catalogue nearest to its bound", {}, 0};
  for (const auto& entry : catalogue::entries()) {
    const auto truth = truths.find(entry.id);
    ASSERT_NE(truth, truths.end()) << entry.id << " has no oracle";
    for (std::size_t row = 0; row < rows; ++row) {
      const auto values = random_parameters(entry, random, kSpread, kMargin);
      const auto factor = catalogue::form_factor(entry, values);
      ASSERT_TRUE(factor.ok()) << factor.error().message;
      const double right = static_cast<double>(truth->second(values.data()));
      const double tolerance = kTwelveDigits * (by_closure(entry.id) ? 1 : right);
      EXPECT_TRUE(near(factor->value, right, factor->bound + tolerance)) << described(entry, values);
      worst.consider(std::abs(factor->value - right) / (factor->bound + tolerance), command_for(entry, values));
    }
  }
  exhibit(worst);
  EXPECT_EQ(truths.size(), catalogue::entries().size());
}

// CLAIM      IU.6-3: the factors' bounds hold where two surfaces touch or an element lies on the axis, offsets being 0.
// ORACLE     identity: the same integrals.
// TOLERANCE  twelve digits of the factor and the returned bound.
TEST(Catalogue, HoldsWhereOffsetsVanish) {
  proves({"IU.6-2", "IU.6-3"}, Oracle::identity, "every entry with an offset, at 0");
  CounterRandom random(kSeed + 1);
  const oracle::Truths truths = all_truths();
  int offsets = 0;
  for (const auto& entry : catalogue::entries()) {
    if (std::string(entry.id) == "wall-ring-end") continue;  // the ring then lies in the disc: a limit, see below
    for (std::size_t i = 0; i < entry.parameters.size(); ++i) {
      if (entry.parameters[i].quantity != catalogue::Quantity::offset) continue;
      std::vector<double> values;
      do {
        values = random_parameters(entry, random, 9, 0.05);
        values[i] = 0;
      } while (catalogue::complaint(entry, values));
      const auto factor = catalogue::form_factor(entry, values);
      ASSERT_TRUE(factor.ok());
      const double right = static_cast<double>(truths.at(entry.id)(values.data()));
      EXPECT_TRUE(near(factor->value, right, factor->bound + kTwelveDigits * right)) << described(entry, values);
      ++offsets;
    }
  }
  EXPECT_GE(offsets, 9);
  const auto limit = catalogue::form_factor(*catalogue::find("wall-ring-end"), std::vector<double>{0, 1});
  EXPECT_TRUE(near(limit->value, 0.5, limit->bound));  // half of the ring's horizon
}

}  // namespace
}  // namespace etendue::validation
