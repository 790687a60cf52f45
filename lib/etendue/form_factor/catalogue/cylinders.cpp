// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/catalogue/coaxial_discs.hpp"
#include "etendue/form_factor/catalogue/families.hpp"

namespace etendue::catalogue {

namespace {

/// From a narrow ring on the wall to the end disc at the distance z: (Z²+½)/√(Z²+1) − Z with Z = z/2r, which is
/// ¼ over what does not cancel.
Counted ring_to_end(const Counted& z, const Counted& r) {
  const Counted u = z / (2 * r), root = hypot(1, u);
  return 1 / (4 * root * (square(u) + Counted(1) / 2 + u * root));
}

Counted wall(const Counted& r, const Counted& h) {
  return 2 * pi() * r * h;
}

Drawing cylinder(Surface wall_is, Surface base_is) {
  Drawing d;
  d.disc(base_is, {0, 0, 0}, {0, 0, 1}, 0.8);
  d.frustum(wall_is, {0, 0, 0}, 0.8, {0, 0, 1.3}, 0.8);
  d.dimension({0, 0, 1.3}, {0.8, 0, 1.3}, "r");
  d.height({0, 0, 0}, {0, 0, 1.3}, 1.05, "h");
  return d;
}

Drawing ring_in_cylinder(bool to_end) {
  Drawing d;
  if (to_end) d.disc(Surface::to, {0, 0, 1.3}, {0, 0, 1}, 0.8);
  d.frustum(to_end ? Surface::other : Surface::to, {0, 0, 0}, 0.8, {0, 0, 1.3}, 0.8);
  d.ring({0, 0, 0.45}, 0.8, {0, 0, 0.07});
  d.dimension({0, 0, 1.3}, {0.8, 0, 1.3}, "r");
  d.label({-0.8, -0.1, 0.3}, "dA\u2081");
  if (to_end) {
    d.height({0, 0, 0.45}, {0, 0, 1.3}, 1.05, "z");
  } else {
    d.height({0, 0, 0}, {0, 0, 0.45}, 1.05, "z");
    d.height({0, 0, 0}, {0, 0, 1.3}, 1.35, "h");
  }
  return d;
}

Drawing base_and_band() {
  Drawing d;
  d.disc(Surface::from, {0, 0, 0}, {0, 0, 1}, 0.8);
  d.frustum(Surface::other, {0, 0, 0}, 0.8, {0, 0, 0.6}, 0.8);
  d.frustum(Surface::to, {0, 0, 0.6}, 0.8, {0, 0, 1.3}, 0.8);
  d.dimension({0, 0, 1.3}, {0.8, 0, 1.3}, "r");
  d.height({0, 0, 0}, {0, 0, 0.6}, 1.05, "a");
  d.height({0, 0, 0.6}, {0, 0, 1.3}, 1.05, "b");
  return d;
}

Drawing two_bands() {
  Drawing d;
  d.frustum(Surface::from, {0, 0, 0}, 0.7, {0, 0, 0.5}, 0.7);
  d.frustum(Surface::other, {0, 0, 0.5}, 0.7, {0, 0, 0.9}, 0.7);
  d.frustum(Surface::to, {0, 0, 0.9}, 0.7, {0, 0, 1.5}, 0.7);
  d.dimension({0, 0, 1.5}, {0.7, 0, 1.5}, "r");
  d.height({0, 0, 0}, {0, 0, 0.5}, 0.95, "a");
  d.height({0, 0, 0.5}, {0, 0, 0.9}, 0.95, "g");
  d.height({0, 0, 0.9}, {0, 0, 1.5}, 0.95, "b");
  return d;
}

Drawing strip_by_cylinder() {
  Drawing d;
  d.frustum(Surface::to, {0, 0, 0}, 0.45, {0, 0, 1.3}, 0.45);
  d.rectangle(Surface::from, {1.6, 0.47, 0}, {0, 0.06, 0}, {0, 0, 1.3});
  d.line({0, 0, 0}, {1.6, 0, 0});
  d.dimension({0, -0.1, 0}, {1.6, -0.1, 0}, "s");
  d.dimension({1.6, 0, 0}, {1.6, 0.5, 0}, "x");
  d.dimension({1.85, 0.5, 0}, {1.85, 0.5, 1.3}, "h");
  d.dimension({0, 0, 1.3}, {0.45, 0, 1.3}, "r");
  d.label({1.6, 0.5, 1.3}, "dA\u2081");
  return d;
}

/// The published form: H = h/r, S = s/r, C = S² + (x/r)², A = H²+C−1, B = H²−C+1.
Counted strip_to_cylinder(Values p) {
  const Counted h = p[0] / p[3], s = p[1] / p[3], c = square(s) + square(p[2] / p[3]), c1 = c - 1;
  const Counted a = square(h) + c1, b = square(h) - c1, root = sqrt(a * a + 4 * square(h));
  // acos(B/A), where A² − B² = 4H²(C−1); acos(B/(A√C)), where A²C − B² = (C−1)(A² + 4H²); asin(1/√C)
  const Counted first = atan2(2 * h * sqrt(c1), b), second = atan2(sqrt(c1) * root, b), third = atan2(1, sqrt(c1));
  return s / c * (1 - (first - (root * second + b * third) / (2 * h)) / pi() - a / (4 * h));
}

}  // namespace

std::vector<Entry> cylinders() {
  return {
      {.id = "wall-ring-wall",
       .number = "",
       .title = "Narrow ring on the inside of a cylinder to the whole wall",
       .parameters = {offset("z", "height of the ring above one end"), length("r", "radius"), length("h", "height")},
       .conditions = {{"z <= h", "z", [](std::span<const double> p) { return p[0] <= p[2]; }}},
       .widest_ratio = 1e6,
       .formula = "H = h/2r, Z = z/2r: F = 1 + H − (Z²+½)/√(Z²+1) − ((H−Z)²+½)/√((H−Z)²+1)",
       .source = "closure with the two end discs",
       .care = "a low cylinder leaves a difference of order H; counted",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return 1 - ring_to_end(p[0], p[1]) - ring_to_end(p[2] - p[0], p[1]); },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = [] { return ring_in_cylinder(false); }},
      {.id = "wall-ring-end",
       .number = "",
       .title = "Narrow ring on the inside of a cylinder to the disc at its end",
       .parameters = {offset("z", "distance of the ring from the end"), length("r", "radius")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "Z = z/2r: F = (Z²+½)/√(Z²+1) − Z",
       .source = "element-standing-disc with l = r",
       .care = "far from the end the difference is taken as ¼/(√(Z²+1) (Z²+½+Z√(Z²+1)))",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return ring_to_end(p[0], p[1]); },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = [] { return ring_in_cylinder(true); }},
      {.id = "cylinder-wall-self",
       .number = "C-79",
       .title = "Inside wall of a cylinder to itself",
       .parameters = {length("r", "radius"), length("h", "height")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "H = h/2r: F = 1 + H − √(1+H²) = 2H/(1 + H + √(1+H²))",
       .source = "closure with C-40",
       .care = "a low cylinder: the difference is taken as the quotient",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted d = 2 * p[0];
             return 2 * p[1] / (d + p[1] + hypot(d, p[1]));
           },
       .area_from = [](Values p) { return wall(p[0], p[1]); },
       .area_to = [](Values p) { return wall(p[0], p[1]); },
       .picture = [] { return cylinder(Surface::from, Surface::other); }},
      {.id = "C-80",
       .number = "C-80",
       .title = "Base of a cylinder to the inside of its wall",
       .parameters = {length("r", "radius"), length("h", "height")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "H = h/2r: F = 2H [√(1+H²) − H] = 2H/(√(1+H²) + H)",
       .source = "Howell, catalogue of configuration factors, C-80; closure with C-40",
       .care = "a high cylinder: the difference is taken as the quotient",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return 2 * p[1] / (hypot(2 * p[0], p[1]) + p[1]); },
       .area_from = [](Values p) { return pi() * square(p[0]); },
       .area_to = [](Values p) { return wall(p[0], p[1]); },
       .picture = [] { return cylinder(Surface::to, Surface::from); }},
      {.id = "base-wall-band",
       .number = "",
       .title = "Base of a cylinder to a band of its wall",
       .parameters = {length("r", "radius"), offset("a", "where the band begins above the base"),
                      length("b", "its height")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "F = C-40(r, a) − C-40(r, a+b)",
       .source = "configuration algebra",
       .care = "a narrow band far away is a small difference; counted",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return disc_to_disc(p[0], p[0], p[1]) - disc_to_disc(p[0], p[0], p[1] + p[2]); },
       .area_from = [](Values p) { return pi() * square(p[0]); },
       .area_to = [](Values p) { return wall(p[0], p[2]); },
       .picture = base_and_band},
      {.id = "wall-bands",
       .number = "",
       .title = "Two bands on the inside of a cylinder",
       .parameters = {length("r", "radius"), length("a", "height of the first band"),
                      offset("g", "gap between the bands"), length("b", "height of the second")},
       .conditions = {},
       .widest_ratio = 1e3,
       .formula = "D(z) = πr² C-40(r, z): F = [D(g) − D(g+a) − D(g+b) + D(g+a+b)]/(2πra)",
       .source = "configuration algebra",
       .care = "narrow bands far apart are a difference of differences; counted; bands in touch have g = 0",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const auto d = [&](const Counted& z) { return disc_exchange(p[0], p[0], z); };
             return (d(p[2]) - d(p[2] + p[1]) - d(p[2] + p[3]) + d(p[2] + p[1] + p[3])) / wall(p[0], p[1]);
           },
       .area_from = [](Values p) { return wall(p[0], p[1]); },
       .area_to = [](Values p) { return wall(p[0], p[3]); },
       .picture = two_bands},
      {.id = "strip-cylinder",
       .number = "",
       .title = "Strip element to the outside of a parallel cylinder of the same length",
       .parameters = {length("h", "length of both"), length("s", "distance of the axis from the strip's plane"),
                      offset("x", "distance of the axis aside of the strip"), length("r", "radius")},
       .conditions = {{"s >= 1.000001 r, the cylinder above the strip's horizon", "s",
                       [](std::span<const double> p) { return p[1] >= 1.000001 * p[3]; }}},
       .widest_ratio = 1e3,
       .formula = "H = h/r, S = s/r, C = S²+(x/r)², A = H²+C−1, B = H²−C+1: F = (S/C) {1 − (1/π) [acos(B/A) − (1/2H) "
                  "(√(A²+4H²) acos(B/(A√C)) + B asin(1/√C))] − A/4H}",
       .source = "the plus before B asin(1/√C): with the minus of a widely copied program the closure below fails",
       .care = "a short or far cylinder cancels like H², arcs are taken by atan2; counted",
       .accuracy = Accuracy::proved,
       .factor = strip_to_cylinder,
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = strip_by_cylinder},
  };
}

}  // namespace etendue::catalogue
