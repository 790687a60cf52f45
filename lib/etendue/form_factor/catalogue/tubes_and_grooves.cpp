// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/catalogue/families.hpp"

namespace etendue::catalogue {

namespace {

/// √(a² − b²) of lengths, and the angle whose cosine is b/a.
Counted leg(const Counted& a, const Counted& b) {
  return sqrt((a - b) * (a + b));
}

Counted arc_cosine(const Counted& b, const Counted& a) {
  return atan2(leg(a, b), b);
}

Drawing two_tubes(double second, const char* one, const char* two) {
  Drawing d(View::section);
  const double x = 0.6 + 0.5 + second;
  d.circle_trace(Surface::from, {0, 0, 0}, 0.6);
  d.circle_trace(Surface::to, {x, 0, 0}, second);
  d.dimension({0.6, 0, 0}, {1.1, 0, 0}, "s");
  d.dimension({0, 0, 0}, {-0.42, 0, 0.42}, one);
  d.dimension({x, 0, 0}, {x + 0.7 * second, 0, 0.7 * second}, two);
  return d;
}

Drawing strip_and_tube() {
  Drawing d(View::section);
  d.element({0, 0, 0}, {0, 0, 1});
  d.circle_trace(Surface::to, {1, 0, 1.2}, 0.5);
  d.line({-0.3, 0, 0}, {1.6, 0, 0}, Stroke::thin);
  d.dimension({0, 0, -0.2}, {1, 0, -0.2}, "b");
  d.height({0, 0, 0}, {0, 0, 1.2}, 1, "a");
  d.dimension({1, 0, 1.2}, {1.42, 0, 1.48}, "r");
  return d;
}

Drawing tube_and_plate() {
  Drawing d(View::section);
  d.circle_trace(Surface::from, {0, 0, 1.2}, 0.5);
  d.trace(Surface::to, {{-0.4, 0, 0}, {1.2, 0, 0}});
  d.line({0, 0, 0}, {0, 0, 1.2});
  d.dimension({0, 0, 0.15}, {0, 0, 1.2}, "a");
  d.dimension({0, 0, -0.18}, {1.2, 0, -0.18}, "b1");
  d.dimension({-0.4, 0, -0.18}, {0, 0, -0.18}, "-b2");
  d.dimension({0, 0, 1.2}, {-0.4, 0, 1.5}, "r");
  return d;
}

Drawing tube_row() {
  Drawing d(View::section);
  d.trace(Surface::from, {{-1.4, 0, 0}, {1.4, 0, 0}});
  for (const double x : {-1.0, 0.0, 1.0}) d.circle_trace(Surface::to, {x, 0, 0.9}, 0.33);
  d.dimension({0, 0, 1.45}, {1, 0, 1.45}, "s");
  d.dimension({-1.33, 0, 0.9}, {-0.67, 0, 0.9}, "d");
  d.line({0, 0, 0.9}, {0, 0, 1.5});
  d.line({1, 0, 0.9}, {1, 0, 1.5});
  return d;
}

Drawing tube_in_tube() {
  Drawing d(View::section);
  d.circle_trace(Surface::from, {0, 0, 0}, 1);
  d.circle_trace(Surface::other, {0, 0, 0}, 0.45);
  d.dimension({0, 0, 0}, {0.45, 0, 0}, "r1");
  d.dimension({0, 0, 0}, {-0.7, 0, 0.7}, "r2");
  return d;
}

Drawing arc() {
  Drawing d(View::section);
  d.circle_trace(Surface::from, {0, 0, 0}, 1, 210, 330);
  d.line({0, 0, 0}, {0.866, 0, -0.5});
  d.line({0, 0, 0}, {0, 0, -1});
  d.dimension({0, 0, 0}, {-0.866, 0, -0.5}, "r");
  d.angle({0, 0, 0}, {0, 0, -1}, {0.866, 0, -0.5}, 0.3, "beta");
  return d;
}

Drawing groove() {
  Drawing d(View::section);
  d.trace(Surface::from, {{-0.5, 0, 1}, {-0.5, 0, 0}, {0.5, 0, 0}, {0.5, 0, 1}});
  d.dimension({-0.5, 0, -0.18}, {0.5, 0, -0.18}, "w");
  d.height({0, 0, 0}, {0, 0, 1}, 0.7, "h");
  return d;
}

Drawing triangle() {
  Drawing d(View::section);
  d.trace(Surface::from, {{0, 0, 0}, {1.6, 0, 0}});
  d.trace(Surface::to, {{0, 0, 0}, {0.5, 0, 1}});
  d.trace(Surface::other, {{1.6, 0, 0}, {0.5, 0, 1}});
  d.dimension({0, 0, -0.15}, {1.6, 0, -0.15}, "a");
  d.dimension({-0.13, 0, 0.06}, {0.37, 0, 1.06}, "b");
  d.dimension({1.72, 0, 0.1}, {0.62, 0, 1.1}, "c");
  return d;
}

}  // namespace

std::vector<Entry> tubes_and_grooves() {
  return {
      {.id = "strip-long-cylinder",
       .number = "",
       .title = "Strip element to infinitely long parallel cylinder above its horizon",
       .parameters = {length("a", "height of the axis above the strip's plane"),
                      offset("b", "distance of the axis aside of the strip"), length("r", "radius")},
       .conditions = {{"a >= r, the cylinder above the horizon", "a",
                       [](std::span<const double> p) { return p[0] >= p[2]; }}},
       .widest_ratio = 1e6,
       .formula = "F = ar/(a²+b²)",
       .source = "B-71 between the two tangents",
       .care = "one quotient: nothing cancels",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return p[0] * p[2] / (square(p[0]) + square(p[1])); },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = strip_and_tube},
      {.id = "equal-tubes",
       .number = "C-63",
       .title = "Infinitely long, equal, parallel cylinders",
       .parameters = {length("r", "radius"), length("s", "gap between them")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "X = 1 + s/2r: F = (1/π) [asin(1/X) + √(X²−1) − X]",
       .source = "Hottel's crossed strings around both",
       .care = "far cylinders leave 1/(2πX); X−1 is taken from s; counted",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted above = p[1] / (2 * p[0]), x = 1 + above, root = sqrt(above * (x + 1));
             return (atan2(1, root) + root - x) / pi();
           },
       .area_from = [](Values) { return Counted(1); },
       .area_to = [](Values) { return Counted(1); },
       .picture = [] { return two_tubes(0.6, "r", "r"); }},
      {.id = "unequal-tubes",
       .number = "C-64",
       .title = "Infinitely long, parallel cylinders of different radii",
       .parameters = {length("r1", "radius of the first"), length("r2", "radius of the second"),
                      length("s", "gap between them")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "R = r2/r1, C = 1 + R + s/r1: F = (1/2π) {π + √(C²−(R+1)²) − √(C²−(R−1)²) + (R−1) acos((R−1)/C) − "
                  "(R+1) acos((R+1)/C)}",
       .source = "Hottel's crossed strings around both",
       .care = "C − R − 1 is taken from s, arcs by atan2; far or small cylinders leave a difference; counted",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted sum = p[0] + p[1], c = sum + p[2], difference = p[1] - p[0];
             const Counted inner = sqrt(p[2] * (c + sum)), outer = leg(c, difference);
             const Counted arcs = difference * arc_cosine(difference, c) - sum * atan2(inner, sum);
             return (pi() + (inner - outer + arcs) / p[0]) / (2 * pi());
           },
       .area_from = [](Values p) { return p[0]; },
       .area_to = [](Values p) { return p[1]; },
       .picture = [] { return two_tubes(0.35, "r1", "r2"); }},
      {.id = "tube-plate",
       .number = "",
       .title = "Infinitely long cylinder to parallel plate",
       .parameters = {length("a", "distance of the axis from the plate's plane"), length("r", "radius"),
                      position("b2", "where the plate begins, from below the axis"), position("b1", "where it ends")},
       .conditions = {{"a >= r, the cylinder in front of the plate", "a",
                       [](std::span<const double> p) { return p[0] >= p[1]; }},
                      {"b1 > b2", "b1", [](std::span<const double> p) { return p[3] > p[2]; }}},
       .widest_ratio = 1e6,
       .formula = "F = (1/2π) [atan(b1/a) − atan(b2/a)]",
       .source = "reciprocity with strip-long-cylinder",
       .care = "the arcs are subtracted as one, atan2(a(b1−b2), a²+b1b2)",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return atan2(p[0] * (p[3] - p[2]), square(p[0]) + p[2] * p[3]) / (2 * pi()); },
       .area_from = [](Values p) { return 2 * pi() * p[1]; },
       .area_to = [](Values p) { return p[3] - p[2]; },
       .picture = tube_and_plate},
      {.id = "plane-tube-row",
       .number = "",
       .title = "Infinite plane to a row of infinitely long, equal cylinders",
       .parameters = {length("d", "diameter"), length("s", "distance from axis to axis")},
       .conditions = {{"d <= s, the cylinders apart", "d", [](std::span<const double> p) { return p[0] <= p[1]; }}},
       .widest_ratio = 1e6,
       .formula = "q = d/s: F = 1 − √(1−q²) + q acos q",
       .source = "Hottel's crossed strings for one cell of the row",
       .care = "1 − √(1−q²) is taken as q²/(1 + √(1−q²))",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted q = p[0] / p[1], root = leg(p[1], p[0]) / p[1];
             return q * q / (1 + root) + q * atan2(root, q);
           },
       .area_from = [](Values p) { return p[1]; },
       .area_to = [](Values p) { return pi() * p[0]; },
       .picture = tube_row},
      {.id = "tube-in-tube-self",
       .number = "",
       .title = "Outer of two infinitely long cylinders, one inside the other, to itself",
       .parameters = {length("r1", "radius of the inner"), length("r2", "radius of the outer")},
       .conditions = {{"r1 < r2", "r1", [](std::span<const double> p) { return p[0] < p[1]; }}},
       .widest_ratio = 1e6,
       .formula = "F = 1 − r1/r2; the inner need not be concentric, only convex: r1 is its perimeter/2π",
       .source = "reciprocity and closure",
       .care = "taken as (r2−r1)/r2",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return (p[1] - p[0]) / p[1]; },
       .area_from = [](Values) { return Counted(1); },
       .area_to = [](Values) { return Counted(1); },
       .picture = tube_in_tube},
      {.id = "arc-self",
       .number = "",
       .title = "Inside of an infinitely long circular trough to itself",
       .parameters = {length("r", "radius"), angle("beta", "half of the arc's angle", 0.001, 180)},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "F = 1 − sin β/β; the semi-cylinder, β = 90°: 1 − 2/π; the whole tube, β = 180°: 1",
       .source = "closure with the chord, which receives sin β/β",
       .care = "a flat trough leaves β²/6; counted",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const double beta = exact(p[1]);
             return 1 - sin_deg(beta) / radians(beta);
           },
       .area_from = [](Values) { return Counted(1); },
       .area_to = [](Values) { return Counted(1); },
       .picture = arc},
      {.id = "groove-self",
       .number = "",
       .title = "Bottom and both walls of an infinitely long rectangular groove to themselves",
       .parameters = {length("w", "width"), length("h", "depth")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "F = 2h/(w + 2h)",
       .source = "closure with the opening, which sees all of the groove",
       .care = "one quotient: nothing cancels",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return 2 * p[1] / (p[0] + 2 * p[1]); },
       .area_from = [](Values) { return Counted(1); },
       .area_to = [](Values) { return Counted(1); },
       .picture = groove},
      {.id = "triangular-duct",
       .number = "",
       .title = "Infinitely long triangular duct: side to side",
       .parameters = {length("a", "first side"), length("b", "second side"), length("c", "third side")},
       .conditions = {{"c < a + b, a triangle", "c", [](std::span<const double> p) { return p[2] < p[0] + p[1]; }},
                      {"b < a + c, a triangle", "b", [](std::span<const double> p) { return p[1] < p[0] + p[2]; }},
                      {"a < b + c, a triangle", "a", [](std::span<const double> p) { return p[0] < p[1] + p[2]; }}},
       .widest_ratio = 1e6,
       .formula = "F = (a + b − c)/(2a)",
       .source = "closure and reciprocity of three flat sides",
       .care = "flat triangles leave a difference of given lengths: exact in twice the digits",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return (p[0] + p[1] - p[2]) / (2 * p[0]); },
       .area_from = [](Values p) { return p[0]; },
       .area_to = [](Values p) { return p[1]; },
       .picture = triangle},
  };
}

}  // namespace etendue::catalogue
