// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <string>

#include "form_factor/catalogue/configurations.hpp"
#include "support/evidence.hpp"

// What the factor back takes beside the factor: the quotient of the two areas, written down from the titles alone.
namespace etendue::validation {
namespace {

using P = const std::vector<double>&;
constexpr double kPi = std::numbers::pi;

double square(double x) {
  return x * x;
}
double ring(double inner, double outer) {
  return kPi * (outer - inner) * (outer + inner);
}
/// Wall of a truncated cone.
double wall(double r1, double r2, double h) {
  return kPi * (r1 + r2) * std::hypot(r1 - r2, h);
}

/// Area of the first surface over that of the second; per length where both are infinitely long.
const std::map<std::string, double (*)(P)>& quotients() {
  static const std::map<std::string, double (*)(P)> all{
      {"centred-plates", [](P p) { return p[0] / p[1]; }},
      {"shifted-plates", [](P p) { return p[0] / (p[2] - p[1]); }},
      {"perpendicular-plates", [](P p) { return p[0] / p[1]; }},
      {"C-5a", [](P p) { return p[0] / p[1]; }},
      {"unequal-tubes", [](P p) { return p[0] / p[1]; }},
      {"tube-plate", [](P p) { return 2 * kPi * p[1] / (p[3] - p[2]); }},
      {"plane-tube-row", [](P p) { return p[1] / (kPi * p[0]); }},
      {"triangular-duct", [](P p) { return p[0] / p[1]; }},
      {"C-14", [](P p) { return p[0] / p[1]; }},
      {"parallel-rectangles", [](P p) { return (p[1] - p[0]) * (p[3] - p[2]) / ((p[5] - p[4]) * (p[7] - p[6])); }},
      {"perpendicular-rectangles", [](P p) { return (p[1] - p[0]) * (p[3] - p[2]) / ((p[5] - p[4]) * (p[7] - p[6])); }},
      {"hinged-rectangles", [](P p) { return p[1] / p[0]; }},
      {"box-floor-walls", [](P p) { return p[0] * p[1] / (2 * (p[0] + p[1]) * p[2]); }},
      {"corner-tetrahedron-oblique", [](P) { return 1 / std::sqrt(3.0); }},
      {"C-41", [](P p) { return square(p[0] / p[1]); }},
      {"disc-annulus", [](P p) { return kPi * square(p[0]) / ring(p[1], p[2]); }},
      {"annulus-disc", [](P p) { return ring(p[0], p[1]) / (kPi * square(p[2])); }},
      {"C-52", [](P p) { return ring(p[0], p[1]) / ring(p[2], p[3]); }},
      {"C-80", [](P p) { return p[0] / (2 * p[1]); }},
      {"base-wall-band", [](P p) { return p[0] / (2 * p[2]); }},
      {"wall-bands", [](P p) { return p[1] / p[3]; }},
      {"C-77", [](P p) { return 2 * kPi * p[0] * p[2] / ring(p[0], p[1]); }},
      {"outer-inner-cylinder", [](P p) { return p[1] / p[0]; }},
      {"outer-cylinder-end", [](P p) { return 2 * kPi * p[1] * p[2] / ring(p[0], p[1]); }},
      {"sphere-rectangle", [](P p) { return 4 * kPi * square(p[3]) / (p[1] * p[2]); }},
      {"sphere-disc", [](P p) { return 4 * square(p[0] / p[1]); }},
      {"sphere-annulus", [](P p) { return 4 * kPi * square(p[0]) / ring(p[1], p[2]); }},
      {"sphere-regular-polygon",
       [](P p) { return 4 * kPi * square(p[3]) / (p[0] * square(p[1]) * std::tan(kPi / p[0])); }},
      {"sphere-cylinder", [](P p) { return square(p[0]) / (p[1] * p[2]); }},
      {"sphere-cone", [](P p) { return 4 * square(p[0] / p[2]) * std::sin(p[3] * kPi / 180); }},
      {"sphere-sphere", [](P p) { return square(p[0] / p[1]); }},
      {"sphere-in-sphere", [](P p) { return square(p[1] / p[0]); }},
      {"cap-base", [](P p) { return 2 * p[0] / (2 * p[0] - p[1]); }},
      {"C-48", [](P p) { return kPi * square(p[0]) / wall(p[1], 0, p[3]); }},
      {"cone-base", [](P p) { return wall(p[0], 0, p[1]) / (kPi * square(p[0])); }},
      {"frustum-base-wall", [](P p) { return kPi * square(p[0]) / wall(p[0], p[1], p[2]); }},
  };
  return all;
}

/// Entries whose two surfaces are congruent, or one.
bool are_alike(const std::string& id) {
  static const char* const ids[] = {"opposite-plates",
                                    "C-5",
                                    "screened-plates",
                                    "equal-tubes",
                                    "tube-in-tube-self",
                                    "arc-self",
                                    "groove-self",
                                    "C-11",
                                    "box-walls-self",
                                    "cube-opposite",
                                    "cube-adjacent",
                                    "tetrahedron",
                                    "corner-tetrahedron-legs",
                                    "C-40",
                                    "cylinder-wall-self",
                                    "annular-ends",
                                    "cone-self",
                                    "outer-cylinder-self",
                                    "sphere-in-sphere-self",
                                    "frustum-self"};
  return std::ranges::find(ids, id) != std::end(ids);
}

// CLAIM      IU.6-5: the factor back is the factor times the quotient of the areas, for every entry that has both.
// ORACLE     closed form: the areas, written down here from the configurations' titles.
// TOLERANCE  32 u: a dozen roundings of the quotients here, the program's two of double double, and those of tan and sin; the factors'
//            own errors cancel, being one and the same number's.
TEST(Catalogue, KnowsTheAreasOfItsSurfaces) {
  proves({"IU.6-5"}, Oracle::closed_form, "quotients of areas, every entry that has two, 20 parameters each");
  CounterRandom random(77);
  std::size_t judged = 0;
  for (const catalogue::Entry& entry : catalogue::entries()) {
    if (entry.area_from == nullptr || entry.area_to == nullptr) continue;
    const auto quotient = quotients().find(entry.id);
    ASSERT_TRUE(holds((quotient != quotients().end()) != are_alike(entry.id))) << entry.id;
    for (int i = 0; i < 20; ++i) {
      const std::vector<double> values = random_parameters(entry, random, 8, 0.1);
      const double forth = catalogue::form_factor(entry, values).value().value;
      const double back = catalogue::reverse_form_factor(entry, values).value()->value;
      const double right = are_alike(entry.id) ? 1 : quotient->second(values);
      EXPECT_TRUE(near(back, forth * right, 32 * 0x1p-53 * back)) << described(entry, values);
    }
    ++judged;
  }
  EXPECT_EQ(judged, 56u);
}

}  // namespace
}  // namespace etendue::validation
