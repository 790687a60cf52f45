// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "etendue/form_factor/catalogue/families.hpp"
#include "etendue/form_factor/catalogue/round_formulas.hpp"

namespace etendue::catalogue {

Counted near_by_far(const Counted& l, const Counted& h, const Counted& r) {
  return hypot(l - r, h) * hypot(l + r, h);
}

Counted facing_disc(const Counted& l, const Counted& h, const Counted& r) {
  const Counted s = near_by_far(l, h, r), rest = square(l) + square(h) - square(r);
  if (rest.value.high > 0) return 2 * square(r) * square(h) / (s * (s + rest));
  return (s - rest) / (2 * s);
}

Counted beside_disc(const Counted& l, const Counted& h, const Counted& r) {
  const Counted s = near_by_far(l, h, r), z = square(l) + square(h) + square(r);
  return 2 * h * square(r) / (s * (z + s));
}

namespace {

Counted facing(const Counted& l, const Counted& h, const Counted& r) {
  return facing_disc(l, h, r);
}

Counted beside(const Counted& l, const Counted& h, const Counted& r) {
  return l * beside_disc(l, h, r);
}

Drawing over_axis(double radius, double hole) {
  Drawing d;
  d.disc(Surface::to, {0, 0, 1.2}, {0, 0, 1}, radius, hole);
  d.element({0, 0, 0}, {0, 0, 1});
  d.line({0, 0, 0}, {0, 0, 1.2});
  d.height({0, 0, 0}, {0, 0, 1.2}, -1.2, "h");
  return d;
}

Drawing coaxial_disc() {
  Drawing d = over_axis(0.9, 0);
  d.dimension({0, 0, 1.2}, {0.9, 0, 1.2}, "r");
  return d;
}

Drawing coaxial_annulus() {
  Drawing d = over_axis(1, 0.5);
  d.dimension({0, 0, 1.2}, {0.5, 0, 1.2}, "r1");
  d.dimension({0, 0, 1.2}, {0.6, -0.8, 1.2}, "r2");
  return d;
}

Drawing tilted_disc() {
  Drawing d;
  d.disc(Surface::to, {0, 0, 1.3}, {0, 0, 1}, 0.8);
  d.element({0, 0, 0}, {0.5, 0, 0.866});
  d.line({0, 0, 0}, {0, 0, 1.3});
  d.angle({0, 0, 0}, {0, 0, 1}, {0.5, 0, 0.866}, 0.62, "omega");
  d.dimension({0, 0, 1.3}, {0.8, 0, 1.3}, "r");
  d.height({0, 0, 0}, {0, 0, 1.3}, -1.1, "h");
  return d;
}

Drawing offset_disc(double hole, bool standing) {
  Drawing d;
  d.disc(Surface::to, {0, 0, 1}, {0, 0, 1}, 0.7, hole);
  d.element({1.4, 0, 0}, standing ? Vec3(-1, 0, 0) : Vec3(0, 0, 1));
  d.line({0, 0, 0}, {0, 0, 1});
  d.dimension({0, 0, 0}, {1.4, 0, 0}, standing ? "l" : "a");
  d.height({0, 0, 0}, {0, 0, 1}, -0.9, "h");
  if (hole > 0) {
    d.dimension({0, 0, 1}, {hole, 0, 1}, "r1");
    d.dimension({0, 0, 1}, {-0.4, -0.57, 1}, "r2");
  } else {
    d.dimension({0, 0, 1}, {0.7, 0, 1}, "r");
  }
  return d;
}

Drawing ellipse() {
  Drawing d;
  std::vector<Vec3> outline;
  for (int k = 0; k < 72; ++k)
    outline.push_back({1.1 * std::cos(k * 0.0872664626), 0.7 * std::sin(k * 0.0872664626), 1.2});
  d.polygon(Surface::to, outline);
  d.element({0, 0, 0}, {0, 0, 1});
  d.line({0, 0, 0}, {0, 0, 1.2});
  d.dimension({0, 0, 1.2}, {1.1, 0, 1.2}, "a");
  d.dimension({0, 0, 1.2}, {0, 0.7, 1.2}, "b");
  d.height({0, 0, 0}, {0, 0, 1.2}, -1.3, "h");
  return d;
}

Drawing wall_around(double at) {
  Drawing d;
  d.frustum(Surface::to, {0, 0, 0}, 0.9, {0, 0, 1.2}, 0.9);
  d.element({at, 0, 0}, {0, 0, 1});
  d.height({0, 0, 0}, {0, 0, 1.2}, 1.1, "h");
  d.dimension({0, 0, 1.2}, {0.9, 0, 1.2}, "r");
  if (at > 0) d.dimension({0, 0, 0}, {at, 0, 0}, "a");
  return d;
}

bool ordered(double inner, double outer) {
  return outer > inner;
}

}  // namespace

std::vector<Entry> elements_to_discs() {
  return {
      {.id = "B-12",
       .number = "B-12",
       .title = "Element to parallel disc, its normal through the centre",
       .parameters = {length("h", "distance"), length("r", "radius of the disc")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "F = r²/(h² + r²)",
       .source = "Howell, catalogue of configuration factors, B-12",
       .care = "one quotient: nothing cancels",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return square(p[1]) / (square(p[0]) + square(p[1])); },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = coaxial_disc},
      {.id = "element-tilted-disc",
       .number = "",
       .title = "Element under the centre of a disc, tilted while all of the disc is above its horizon",
       .parameters = {length("h", "distance"), length("r", "radius of the disc"),
                      angle("omega", "angle between the element's normal and the axis", 0, 89.9)},
       .conditions = {{"omega with h cos(omega) >= r sin(omega), the disc above the horizon", "omega",
                       [](std::span<const double> p) {
                         const Counted margin = p[0] * cos_deg(p[2]) - p[1] * sin_deg(p[2]);
                         return margin.value.high >= -margin.error;
                       }}},
       .widest_ratio = 1e6,
       .formula = "F = cos ω · r²/(h² + r²)",
       .source = "Lambert's vector of the disc lies on its axis",
       .care = "beyond the horizon the formula would count negative light: refused",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return cos_deg(exact(p[2])) * square(p[1]) / (square(p[0]) + square(p[1])); },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = tilted_disc},
      {.id = "B-13",
       .number = "B-13",
       .title = "Element to parallel disc, aside of the axis",
       .parameters = {offset("a", "distance of the element from the axis"), length("h", "distance of the planes"),
                      length("r", "radius of the disc")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "S = √(((a−r)²+h²)((a+r)²+h²)): F = ½ [1 − (a²+h²−r²)/S]",
       .source = "Howell, catalogue of configuration factors, B-13, with lengths instead of ratios, so that a may be 0",
       .care = "a small disc far away leaves a difference of order r²h²/a⁴: taken as 2r²h²/(S(S + a²+h²−r²)) where "
               "a²+h² > r²",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return facing(p[0], p[1], p[2]); },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = [] { return offset_disc(0, false); }},
      {.id = "element-standing-disc",
       .number = "B-14",
       .title = "Element beside a disc's cylinder, its normal towards the axis",
       .parameters = {length("l", "distance of the element from the axis"), length("h", "height of the disc above it"),
                      length("r", "radius of the disc")},
       .conditions = {{"r <= l, the disc above the element's horizon", "r",
                       [](std::span<const double> p) { return p[2] <= p[0]; }}},
       .widest_ratio = 1e6,
       .formula = "H = h/l, R = r/l, Z = 1+H²+R²: F = (H/2) [Z/√(Z²−4R²) − 1]",
       .source = "Lambert's contour integral",
       .care = "a small or far disc leaves a difference of order R²: taken as 2hlr²/(S(Z'+S)), S = "
               "√(((l−r)²+h²)((l+r)²+h²))",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return beside(p[0], p[1], p[2]); },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = [] { return offset_disc(0, true); }},
      {.id = "element-annulus",
       .number = "",
       .title = "Element to parallel annulus, its normal through the centre",
       .parameters = {length("h", "distance"), length("r1", "inner radius"), length("r2", "outer radius")},
       .conditions = {{"r2 > r1", "r2", [](std::span<const double> p) { return ordered(p[1], p[2]); }}},
       .widest_ratio = 1e6,
       .formula = "F = h² (r2²−r1²)/((h²+r1²)(h²+r2²))",
       .source = "difference of two discs B-12",
       .care = "r2²−r1² is taken as (r2−r1)(r2+r1), exact for neighbouring radii",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted h2 = square(p[0]);
             return h2 * (p[2] - p[1]) * (p[2] + p[1]) / ((h2 + square(p[1])) * (h2 + square(p[2])));
           },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = coaxial_annulus},
      {.id = "element-offset-annulus",
       .number = "",
       .title = "Element to parallel annulus, aside of the axis",
       .parameters = {offset("a", "distance of the element from the axis"), length("h", "distance of the planes"),
                      length("r1", "inner radius"), length("r2", "outer radius")},
       .conditions = {{"r2 >= 1.001 r1", "r2", [](std::span<const double> p) { return p[3] >= 1.001 * p[2]; }}},
       .widest_ratio = 1e4,
       .formula = "F = B-13(a, h, r2) − B-13(a, h, r1)",
       .source = "configuration algebra",
       .care = "a narrow annulus is a small difference; counted",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return facing(p[0], p[1], p[3]) - facing(p[0], p[1], p[2]); },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = [] { return offset_disc(0.35, false); }},
      {.id = "element-standing-annulus",
       .number = "",
       .title = "Element beside an annulus's cylinder, its normal towards the axis",
       .parameters = {length("l", "distance of the element from the axis"),
                      length("h", "height of the annulus above it"), length("r1", "inner radius"),
                      length("r2", "outer radius")},
       .conditions = {{"r2 >= 1.001 r1", "r2", [](std::span<const double> p) { return p[3] >= 1.001 * p[2]; }},
                      {"r2 <= l, the annulus above the element's horizon", "r2",
                       [](std::span<const double> p) { return p[3] <= p[0]; }}},
       .widest_ratio = 1e4,
       .formula = "F = f(l, h, r2) − f(l, h, r1), f the factor of element-standing-disc",
       .source = "configuration algebra",
       .care = "a narrow annulus is a small difference; counted",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return beside(p[0], p[1], p[3]) - beside(p[0], p[1], p[2]); },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = [] { return offset_disc(0.35, true); }},
      {.id = "element-ellipse",
       .number = "",
       .title = "Element to parallel elliptical disc, its normal through the centre",
       .parameters = {length("h", "distance"), length("a", "semi-axis"), length("b", "other semi-axis")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "F = ab/√((h²+a²)(h²+b²))",
       .source = "Lambert's contour integral in the angle around the axis",
       .care = "one product: nothing cancels; a = b is B-12",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return p[1] / hypot(p[0], p[1]) * (p[2] / hypot(p[0], p[2])); },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = ellipse},
      {.id = "element-base-centre-wall",
       .number = "",
       .title = "Element at the centre of a cylinder's base to the wall around it",
       .parameters = {length("h", "height of the cylinder"), length("r", "its radius")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "F = h²/(h² + r²)",
       .source = "closure with B-12",
       .care = "one quotient: nothing cancels",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return square(p[0]) / (square(p[0]) + square(p[1])); },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = [] { return wall_around(0); }},
      {.id = "element-base-wall",
       .number = "",
       .title = "Element anywhere on a cylinder's base to the wall around it",
       .parameters = {offset("a", "distance of the element from the axis"), length("h", "height of the cylinder"),
                      length("r", "its radius")},
       .conditions = {{"a < r", "a", [](std::span<const double> p) { return p[0] < p[2]; }}},
       .widest_ratio = 1e6,
       .formula = "S as in B-13: F = ½ [1 + (a²+h²−r²)/S] = 1 − B-13(a, h, r)",
       .source = "closure with B-13",
       .care = "a low wall leaves a difference of order h²: taken as 2r²h²/(S(S − (a²+h²−r²))) where a²+h² < r²",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted s = near_by_far(p[0], p[1], p[2]), rest = square(p[0]) + square(p[1]) - square(p[2]);
             if (rest.value.high >= 0) return (s + rest) / (2 * s);
             return 2 * square(p[2]) * square(p[1]) / (s * (s - rest));  // S² − rest² = 4 r² h²
           },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = [] { return wall_around(0.5); }},
  };
}

}  // namespace etendue::catalogue
