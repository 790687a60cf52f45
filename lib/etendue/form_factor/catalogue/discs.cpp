// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/catalogue/coaxial_discs.hpp"
#include "etendue/form_factor/catalogue/families.hpp"

namespace etendue::catalogue {

namespace {

/// What a narrow ring on a cylinder wall of radius r1 sends to a disc of radius r2 at height z: element-standing-disc.
Counted ring_to_disc(const Counted& r1, const Counted& r2, const Counted& z) {
  const Counted s = hypot(r1 - r2, z) * hypot(r1 + r2, z), x = square(r1) + square(r2) + square(z);
  return 2 * z * r1 * square(r2) / (s * (x + s));
}

Counted ring_area(const Counted& inner, const Counted& outer) {
  return pi() * (outer - inner) * (outer + inner);
}

Drawing two_discs(double first, double hole_1, double second, double hole_2) {
  Drawing d;
  d.disc(Surface::from, {0, 0, 0}, {0, 0, 1}, first, hole_1);
  d.disc(Surface::to, {0, 0, 1.1}, {0, 0, 1}, second, hole_2);
  d.line({0, 0, 0}, {0, 0, 1.1});
  d.height({0, 0, 0}, {0, 0, 1.1}, -1.25, "h");
  return d;
}

Drawing equal_discs() {
  Drawing d = two_discs(0.9, 0, 0.9, 0);
  d.dimension({0, 0, 0}, {0.9, 0, 0}, "r");
  d.dimension({0, 0, 1.1}, {0.9, 0, 1.1}, "r");
  return d;
}

Drawing unequal_discs() {
  Drawing d = two_discs(1, 0, 0.6, 0);
  d.dimension({0, 0, 0}, {1, 0, 0}, "r1");
  d.dimension({0, 0, 1.1}, {0.6, 0, 1.1}, "r2");
  return d;
}

Drawing disc_and_annulus(bool swapped) {
  Drawing d = swapped ? two_discs(1, 0.5, 0.7, 0) : two_discs(0.7, 0, 1, 0.5);
  const Vec3 annulus(0, 0, swapped ? 0 : 1.1), disc(0, 0, swapped ? 1.1 : 0);
  d.dimension(disc, disc + Vec3(0.7, 0, 0), swapped ? "r3" : "r1");
  d.dimension(annulus, annulus + Vec3(0.5, 0, 0), swapped ? "r1" : "r2");
  d.dimension(annulus, annulus + Vec3(0.6, -0.8, 0), swapped ? "r2" : "r3");
  return d;
}

Drawing annuli() {
  Drawing d = two_discs(0.9, 0.4, 1.1, 0.6);
  d.dimension({0, 0, 0}, {0.4, 0, 0}, "r1");
  d.dimension({0, 0, 0}, {0.54, -0.72, 0}, "r2");
  d.dimension({0, 0, 1.1}, {0.6, 0, 1.1}, "r3");
  d.dimension({0, 0, 1.1}, {0.66, -0.88, 1.1}, "r4");
  return d;
}

Drawing wall_ring(double hole) {
  Drawing d;
  d.frustum(Surface::other, {0, 0, 0}, 0.9, {0, 0, 1.3}, 0.9);
  d.ring({0, 0, 0}, 0.9, {0, 0, 0.07});
  d.disc(Surface::to, {0, 0, 1.1}, {0, 0, 1}, 0.6, hole);
  d.dimension({0, 0, 0}, {0.9, 0, 0}, "r1");
  if (hole > 0) d.dimension({0, 0, 1.1}, {hole, 0, 1.1}, "r2");
  d.dimension({0, 0, 1.1}, {-0.36, -0.48, 1.1}, hole > 0 ? "r3" : "r2");
  d.height({0, 0, 0}, {0, 0, 1.1}, 1.1, "z");
  d.label({-0.9, -0.1, -0.1}, "dA\u2081");
  return d;
}

}  // namespace

std::vector<Entry> discs() {
  return {
      {.id = "C-40",
       .number = "C-40",
       .title = "Equal, parallel, coaxial discs",
       .parameters = {length("r", "radius"), length("h", "distance")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "X = 2 + (h/r)²: F = ½ [X − √(X²−4)] = 2/(X + √(X²−4))",
       .source = "Howell, catalogue of configuration factors, C-40",
       .care = "far discs: the difference is taken as the quotient, the root as h√(h²+4r²)/r²",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return disc_to_disc(p[0], p[0], p[1]); },
       .area_from = [](Values p) { return pi() * square(p[0]); },
       .area_to = [](Values p) { return pi() * square(p[0]); },
       .picture = equal_discs},
      {.id = "C-41",
       .number = "C-41",
       .title = "Parallel, coaxial discs of different radii",
       .parameters = {length("r1", "radius of the first"), length("r2", "radius of the second"),
                      length("h", "distance")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "x = r1²+r2²+h², S = √(((r1−r2)²+h²)((r1+r2)²+h²)): F = (x − S)/(2r1²) = 2r2²/(x + S)",
       .source = "Howell, catalogue of configuration factors, C-41, with lengths instead of ratios",
       .care = "far or unequal discs: the difference is taken as the quotient",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return disc_to_disc(p[0], p[1], p[2]); },
       .area_from = [](Values p) { return pi() * square(p[0]); },
       .area_to = [](Values p) { return pi() * square(p[1]); },
       .picture = unequal_discs},
      {.id = "disc-annulus",
       .number = "",
       .title = "Disc to parallel, coaxial annulus",
       .parameters = {length("r1", "radius of the disc"), length("r2", "inner radius of the annulus"),
                      length("r3", "outer radius"), length("h", "distance")},
       .conditions = {{"r3 >= 1.001 r2", "r3", [](std::span<const double> p) { return p[2] >= 1.001 * p[1]; }}},
       .widest_ratio = 1e4,
       .formula = "F = C-41(r1, r3, h) − C-41(r1, r2, h)",
       .source = "configuration algebra",
       .care = "a narrow annulus is a small difference; counted",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return disc_to_disc(p[0], p[2], p[3]) - disc_to_disc(p[0], p[1], p[3]); },
       .area_from = [](Values p) { return pi() * square(p[0]); },
       .area_to = [](Values p) { return ring_area(p[1], p[2]); },
       .picture = [] { return disc_and_annulus(false); }},
      {.id = "annulus-disc",
       .number = "",
       .title = "Annulus to parallel, coaxial disc",
       .parameters = {length("r1", "inner radius of the annulus"), length("r2", "outer radius"),
                      length("r3", "radius of the disc"), length("h", "distance")},
       .conditions = {{"r2 >= 1.001 r1", "r2", [](std::span<const double> p) { return p[1] >= 1.001 * p[0]; }}},
       .widest_ratio = 1e4,
       .formula = "F = [r2² C-41(r2, r3, h) − r1² C-41(r1, r3, h)]/(r2² − r1²)",
       .source = "configuration algebra",
       .care = "a narrow annulus is a quotient of small differences; counted",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted sum = disc_exchange(p[1], p[2], p[3]) - disc_exchange(p[0], p[2], p[3]);
             return sum / ring_area(p[0], p[1]);
           },
       .area_from = [](Values p) { return ring_area(p[0], p[1]); },
       .area_to = [](Values p) { return pi() * square(p[2]); },
       .picture = [] { return disc_and_annulus(true); }},
      {.id = "C-52",
       .number = "C-52",
       .title = "Parallel, coaxial annuli",
       .parameters = {length("r1", "inner radius of the first"), length("r2", "its outer radius"),
                      length("r3", "inner radius of the second"), length("r4", "its outer radius"),
                      length("h", "distance")},
       .conditions = {{"r2 >= 1.001 r1", "r2", [](std::span<const double> p) { return p[1] >= 1.001 * p[0]; }},
                      {"r4 >= 1.001 r3", "r4", [](std::span<const double> p) { return p[3] >= 1.001 * p[2]; }}},
       .widest_ratio = 1e3,
       .formula = "K(a,b) = πa² C-41(a, b, h): F = [K(r2,r4) − K(r2,r3) − K(r1,r4) + K(r1,r3)]/(π(r2²−r1²))",
       .source = "Howell, catalogue of configuration factors, C-52; configuration algebra",
       .care = "narrow annuli are a difference of differences; counted",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted outer = disc_exchange(p[1], p[3], p[4]) - disc_exchange(p[1], p[2], p[4]);
             const Counted inner = disc_exchange(p[0], p[3], p[4]) - disc_exchange(p[0], p[2], p[4]);
             return (outer - inner) / ring_area(p[0], p[1]);
           },
       .area_from = [](Values p) { return ring_area(p[0], p[1]); },
       .area_to = [](Values p) { return ring_area(p[2], p[3]); },
       .picture = annuli},
      {.id = "wall-ring-disc",
       .number = "",
       .title = "Narrow ring on the inside of a cylinder to a coaxial disc",
       .parameters = {length("r1", "radius of the cylinder"), length("r2", "radius of the disc"),
                      length("z", "distance of the disc from the ring")},
       .conditions = {{"r2 <= r1, the disc inside the cylinder", "r2",
                       [](std::span<const double> p) { return p[1] <= p[0]; }}},
       .widest_ratio = 1e6,
       .formula = "R = r2/r1, Z = z/r1, X = 1+R²+Z²: F = (Z/2) [X/√(X²−4R²) − 1]",
       .source = "element-standing-disc: every piece of the ring sees the same",
       .care = "a small or far disc leaves a difference of order R²: taken as a quotient",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return ring_to_disc(p[0], p[1], p[2]); },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = [] { return wall_ring(0); }},
      {.id = "wall-ring-annulus",
       .number = "",
       .title = "Narrow ring on the inside of a cylinder to a coaxial annulus",
       .parameters = {length("r1", "radius of the cylinder"), length("r2", "inner radius of the annulus"),
                      length("r3", "outer radius"), length("z", "distance of the annulus from the ring")},
       .conditions = {{"r3 <= r1, the annulus inside the cylinder", "r3",
                       [](std::span<const double> p) { return p[2] <= p[0]; }},
                      {"r3 >= 1.001 r2", "r3", [](std::span<const double> p) { return p[2] >= 1.001 * p[1]; }}},
       .widest_ratio = 1e4,
       .formula = "F = f(r1, r3, z) − f(r1, r2, z), f the factor of wall-ring-disc",
       .source = "configuration algebra",
       .care = "a narrow annulus is a small difference; counted",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return ring_to_disc(p[0], p[2], p[3]) - ring_to_disc(p[0], p[1], p[3]); },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = [] { return wall_ring(0.3); }},
  };
}

}  // namespace etendue::catalogue
