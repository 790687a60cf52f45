// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/catalogue/families.hpp"

namespace etendue::catalogue {

namespace {

/// √(1 + w² − 2w cos φ), without cancellation where the two sides nearly coincide.
Counted third_side(const Counted& w, double phi) {
  return sqrt(square(1 - w) + 4 * w * square(sin_deg(phi / 2)));
}

Drawing strip_between_angles() {
  Drawing d(View::section);
  d.element({0, 0, 0}, {0, 0, 1});
  d.line({0, 0, 0}, {0.35, 0, 1.3});
  d.line({0, 0, 0}, {1.3, 0, 0.9});
  d.trace(Surface::to, {{0.35, 0, 1.3}, {1.3, 0, 0.9}});
  d.angle({0, 0, 0}, {0, 0, 1}, {0.35, 0, 1.3}, 0.75, "phi1");
  d.angle({0, 0, 0}, {0, 0, 1}, {1.3, 0, 0.9}, 1.0, "phi2");
  return d;
}

Drawing wedge(bool finite) {
  Drawing d(View::section);
  d.trace(Surface::other, {{0, 0, 0}, {2.2, 0, 0}});
  d.trace(Surface::to, {{0, 0, 0}, finite ? Vec3(0.75, 0, 1.1) : Vec3(1.1, 0, 1.6)});
  d.element({1.4, 0, 0}, {0, 0, 1});
  d.angle({0, 0, 0}, {1, 0, 0}, {0.75, 0, 1.1}, 0.35, "phi");
  if (finite) {
    d.dimension({0, 0, -0.2}, {1.4, 0, -0.2}, "x");
    d.dimension({-0.12, 0, 0.08}, {0.63, 0, 1.18}, "l");
  } else {
    d.label({1.1, 0, 1.6}, "∞");
  }
  return d;
}

Drawing plates(double left, double right, const char* one, const char* two) {
  Drawing d(View::section);
  d.trace(Surface::from, {{-0.8, 0, 0}, {0.8, 0, 0}});
  d.trace(Surface::to, {{left, 0, 1}, {right, 0, 1}});
  d.dimension({-0.8, 0, -0.18}, {0.8, 0, -0.18}, one);
  if (two) d.dimension({left, 0, 1.18}, {right, 0, 1.18}, two);
  d.height({0, 0, 0}, {0, 0, 1}, 1.2, "h");
  return d;
}

Drawing hinge(const Vec3& second, const char* one, const char* two, const char* between) {
  Drawing d(View::section);
  d.trace(Surface::from, {{0, 0, 0}, {1.5, 0, 0}});
  d.trace(Surface::to, {{0, 0, 0}, second});
  d.dimension({0, 0, -0.18}, {1.5, 0, -0.18}, one);
  const Vec3 aside = 0.18 * Vec3(-second.z(), 0, second.x()).normalized();
  d.dimension(aside, second + aside, two);
  if (between) d.angle({0, 0, 0}, {1, 0, 0}, second, 0.4, between);
  return d;
}

Drawing shifted_plates() {
  Drawing d = plates(0.2, 1.6, "a", nullptr);
  d.dimension({-0.8, 0, 1.45}, {0.2, 0, 1.45}, "b");
  d.dimension({-0.8, 0, 1.7}, {1.6, 0, 1.7}, "c");
  d.line({-0.8, 0, 0}, {-0.8, 0, 1.7});
  return d;
}

Drawing screened_plates() {
  Drawing d = plates(-0.8, 0.8, "w", "w");
  d.trace(Surface::other, {{-0.3, 0, 0.5}, {0.3, 0, 0.5}});
  d.dimension({-0.3, 0, 0.28}, {0.3, 0, 0.28}, "d");
  return d;
}

}  // namespace

std::vector<Entry> strips() {
  return {
      {.id = "B-71",
       .number = "B-71",
       .title = "Element to infinitely long strip between two angles",
       .parameters = {angle("phi1", "angle from the normal to the strip's one edge, seen along it", -90, 90),
                      angle("phi2", "to its other edge", -90, 90)},
       .conditions = {{"phi2 > phi1", "phi2", [](std::span<const double> p) { return p[1] > p[0]; }}},
       .widest_ratio = 1e6,
       .formula = "F = ½ (sin φ2 − sin φ1)",
       .source = "Howell, catalogue of configuration factors, B-71",
       .care = "close angles leave a difference; counted in twice the digits; exact at right angles",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return (sin_deg(exact(p[1])) - sin_deg(exact(p[0]))) / 2; },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = strip_between_angles},
      {.id = "wedge-half-plane",
       .number = "",
       .title = "Element on one wall of an infinite wedge to the other wall",
       .parameters = {angle("phi", "angle of the wedge", 0.001, 179.999)},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "F = ½ (1 + cos φ) = cos²(φ/2)",
       .source = "B-71 from the edge to infinity",
       .care = "near 180° the sum cancels: the square is taken",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return square(cos_deg(exact(p[0]) / 2)); },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = [] { return wedge(false); }},
      {.id = "wedge-plate",
       .number = "",
       .title = "Element on one wall of a wedge to an infinitely long plate on the other, from the edge upwards",
       .parameters = {length("x", "distance of the element from the edge"), length("l", "width of the plate"),
                      angle("phi", "angle of the wedge", 0.001, 179.999)},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "X = x/l, S = √(1+X²−2X cos φ): F = ½ [1 + (cos φ − X)/S]",
       .source = "B-71 from the edge to the plate's end",
       .care = "X > cos φ leaves a difference: taken as sin²φ/(2S(S + X − cos φ))",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const double phi = exact(p[2]);
             const Counted x = p[0] / p[1], s = third_side(x, phi), rest = cos_deg(phi) - x;
             if (rest.value.high >= 0) return (s + rest) / (2 * s);
             return square(sin_deg(phi)) / (2 * s * (s - rest));
           },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = [] { return wedge(true); }},
      {.id = "opposite-plates",
       .number = "C-1",
       .title = "Infinitely long, directly opposed plates of equal width",
       .parameters = {length("w", "width"), length("h", "distance")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "H = h/w: F = √(1+H²) − H = 1/(√(1+H²) + H)",
       .source = "Hottel's crossed strings",
       .care = "the difference is taken as the quotient",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return p[0] / (hypot(p[0], p[1]) + p[1]); },
       .area_from = [](Values p) { return p[0]; },
       .area_to = [](Values p) { return p[0]; },
       .picture = [] { return plates(-0.8, 0.8, "w", "w"); }},
      {.id = "centred-plates",
       .number = "C-2",
       .title = "Infinitely long, parallel plates of different widths, their centres opposite",
       .parameters = {length("b", "width of the first"), length("c", "width of the second"), length("h", "distance")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "B = b/h, C = c/h: F = [√((B+C)²+4) − √((C−B)²+4)]/(2B)",
       .source = "Hottel's crossed strings",
       .care = "narrow plates leave a difference of two roots: taken as 2C over their sum",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return 2 * p[1] / (hypot(p[0] + p[1], 2 * p[2]) + hypot(p[1] - p[0], 2 * p[2])); },
       .area_from = [](Values p) { return p[0]; },
       .area_to = [](Values p) { return p[1]; },
       .picture = [] { return plates(-1, 1, "b", "c"); }},
      {.id = "shifted-plates",
       .number = "C-2a",
       .title = "Infinitely long, parallel plates, shifted sideways",
       .parameters = {length("a", "width of the first, from 0 to a"), position("b", "where the second begins"),
                      position("c", "where it ends"), length("h", "distance")},
       .conditions = {{"c > b", "c", [](std::span<const double> p) { return p[2] > p[1]; }}},
       .widest_ratio = 1e6,
       .formula = "F = [√(c²+h²) + √((a−b)²+h²) − √(b²+h²) − √((c−a)²+h²)]/(2a)",
       .source = "Hottel's crossed strings",
       .care = "four roots cancel where the plates are narrow or far: the bound says what is left",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted crossed = hypot(p[2], p[3]) + hypot(p[0] - p[1], p[3]);
             return (crossed - hypot(p[1], p[3]) - hypot(p[2] - p[0], p[3])) / (2 * p[0]);
           },
       .area_from = [](Values p) { return p[0]; },
       .area_to = [](Values p) { return p[2] - p[1]; },
       .picture = shifted_plates},
      {.id = "perpendicular-plates",
       .number = "C-3",
       .title = "Infinitely long plates at a right angle, sharing an edge",
       .parameters = {length("w", "width of the first"), length("h", "width of the second")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "H = h/w: F = ½ (1 + H − √(1+H²)) = H/(1 + H + √(1+H²))",
       .source = "Hottel's crossed strings",
       .care = "the difference is taken as the quotient",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return p[1] / (p[0] + p[1] + hypot(p[0], p[1])); },
       .area_from = [](Values p) { return p[0]; },
       .area_to = [](Values p) { return p[1]; },
       .picture =
           [] {
             return hinge({0, 0, 1.1}, "w", "h", nullptr);
           }},
      {.id = "C-5",
       .number = "C-5",
       .title = "Infinitely long plates of equal width, sharing an edge: the V-groove",
       .parameters = {angle("alpha", "angle between them", 0.001, 179.999)},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "F = 1 − sin(α/2) = cos²(α/2)/(1 + sin(α/2))",
       .source = "Howell, catalogue of configuration factors, C-5",
       .care = "near 180° the difference is taken as the quotient",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const double half = exact(p[0]) / 2;
             return square(cos_deg(half)) / (1 + sin_deg(half));
           },
       .area_from = [](Values) { return Counted(1); },
       .area_to = [](Values) { return Counted(1); },
       .picture =
           [] {
             return hinge({1.0, 0, 1.118}, "w", "w", "alpha");
           }},
      {.id = "C-5a",
       .number = "C-5a",
       .title = "Infinitely long plates of different widths, sharing an edge",
       .parameters = {length("w1", "width of the first"), length("w2", "width of the second"),
                      angle("alpha", "angle between them", 0.001, 179.999)},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "W = w2/w1, S = √(1+W²−2W cos α): F = ½ (1 + W − S) = 2W cos²(α/2)/(1 + W + S)",
       .source = "Howell, catalogue of configuration factors, C-5a",
       .care = "the difference is taken as the quotient, the root as (1−W)² + 4W sin²(α/2)",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const double alpha = exact(p[2]);
             const Counted w = p[1] / p[0];
             return 2 * w * square(cos_deg(alpha / 2)) / (1 + w + third_side(w, alpha));
           },
       .area_from = [](Values p) { return p[0]; },
       .area_to = [](Values p) { return p[1]; },
       .picture =
           [] {
             return hinge({0.75, 0, 0.9}, "w1", "w2", "alpha");
           }},
      {.id = "screened-plates",
       .number = "",
       .title = "Infinitely long, directly opposed plates with a screen half-way between them",
       .parameters = {length("w", "width of the plates"), length("d", "width of the screen"),
                      length("h", "distance of the plates")},
       .conditions = {{"d < w, else nothing is seen past the screen", "d",
                       [](std::span<const double> p) { return p[1] < p[0]; }}},
       .widest_ratio = 1e6,
       .formula = "F = [√((w−d)²+h²) − h]/w = (w−d)²/(w (√((w−d)²+h²) + h))",
       .source = "Hottel's crossed strings through both openings; the strings bend around the screen",
       .care = "the difference is taken as the quotient",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return square(p[0] - p[1]) / (p[0] * (hypot(p[0] - p[1], p[2]) + p[2])); },
       .area_from = [](Values p) { return p[0]; },
       .area_to = [](Values p) { return p[0]; },
       .picture = screened_plates},
  };
}

}  // namespace etendue::catalogue
