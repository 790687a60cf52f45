// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/catalogue/families.hpp"

namespace etendue::catalogue {

namespace {

/// (1/2π) [u/√(1+u²) atan(v/√(1+u²)) + v/√(1+v²) atan(u/√(1+v²))]: a corner at (u, v) over an element, at height 1.
Counted corner(const Counted& u, const Counted& v) {
  const Counted p = hypot(1, u), q = hypot(1, v);
  return (u / p * atan(v / p) + v / q * atan(u / q)) / (2 * pi());
}

Drawing corner_over_element() {
  Drawing d;
  d.rectangle(Surface::to, {0, 0, 1.3}, {1.4, 0, 0}, {0, 1.1, 0});
  d.element({0, 0, 0}, {0, 0, 1});
  d.line({0, 0, 0}, {0, 0, 1.3});
  d.dimension({0, 0, 1.3}, {1.4, 0, 1.3}, "a");
  d.dimension({1.4, 0, 1.3}, {1.4, 1.1, 1.3}, "b");
  d.height({0, 0, 0}, {0, 0, 1.3}, -0.35, "c");
  return d;
}

Drawing standing_rectangle() {
  Drawing d;
  d.rectangle(Surface::to, {0, 1, 0}, {1.4, 0, 0}, {0, 0, 1.1});
  d.element({0, 0, 0}, {0, 0, 1});
  d.dimension({1.4, 1, 0}, {1.4, 1, 1.1}, "a");
  d.dimension({0, 1, 1.1}, {1.4, 1, 1.1}, "b");
  d.dimension({0, 0, 0}, {0, 1, 0}, "c");
  return d;
}

Drawing leaning_rectangle() {
  Drawing d;
  const Vec3 up(0, -0.5, 0.95);
  d.rectangle(Surface::to, {0, 1.2, 0}, {1.4, 0, 0}, up);
  d.element({0, 0, 0}, {0, 0, 1});
  d.line({1.4, 1.2, 0}, {1.4, 0, 0});
  d.line({0, 0, 0}, {1.4, 0, 0});
  d.dimension(Vec3(1.55, 1.2, 0), Vec3(1.55, 1.2, 0) + up, "a");
  d.dimension(Vec3(0, 1.2, 0) + up, Vec3(1.4, 1.2, 0) + up, "b");
  d.dimension({0, 0, 0}, {0, 1.2, 0}, "c");
  d.angle({1.4, 1.2, 0}, {0, -1, 0}, up, 0.4, "phi");
  return d;
}

Drawing rectangle_over_element() {
  Drawing d;
  d.rectangle(Surface::to, {0.4, 0.4, 1.2}, {1, 0, 0}, {0, 0.8, 0});
  d.element({0, 0, 0}, {0, 0, 1});
  d.line({0, 0, 0}, {0, 0, 1.2});
  d.line({0, 0, 1.2}, {1.7, 0, 1.2}, Stroke::thin);
  d.line({0, 0, 1.2}, {0, 1.5, 1.2}, Stroke::thin);
  d.label({1.7, 0, 1.2}, "x");
  d.label({0, 1.5, 1.2}, "y");
  d.height({0, 0, 0}, {0, 0, 1.2}, -0.3, "c");
  d.dimension({0, 0.12, 1.2}, {0.4, 0.12, 1.2}, "x1");
  d.dimension({0, -0.1, 1.2}, {1.4, -0.1, 1.2}, "x2");
  d.dimension({1.6, 0, 1.2}, {1.6, 0.4, 1.2}, "y1");
  d.dimension({1.85, 0, 1.2}, {1.85, 1.2, 1.2}, "y2");
  d.line({0.4, 0.4, 1.2}, {0.4, 0, 1.2});
  d.line({1.4, 0.4, 1.2}, {1.4, 0, 1.2});
  d.line({1.4, 0.4, 1.2}, {1.85, 0.4, 1.2});
  d.line({1.4, 1.2, 1.2}, {1.85, 1.2, 1.2});
  return d;
}

Drawing hexagon_over_element() {
  Drawing d;
  std::vector<Vec3> corners;
  for (const auto& [x, y] :
       {std::pair(1.0, 0.0), {0.5, 0.866}, {-0.5, 0.866}, {-1.0, 0.0}, {-0.5, -0.866}, {0.5, -0.866}}) {
    corners.push_back({x, y, 1.2});
  }
  d.polygon(Surface::to, corners);
  d.element({0, 0, 0}, {0, 0, 1});
  d.line({0, 0, 0}, {0, 0, 1.2});
  d.dimension({0, 0, 1.2}, {0, -0.866, 1.2}, "a");
  d.height({0, 0, 0}, {0, 0, 1.2}, -1.1, "h");
  d.label({0.55, 0.9, 1.2}, "n = 6");
  return d;
}

Drawing triangle_over_element() {
  Drawing d;
  d.polygon(Surface::to, {{0, 0, 1.3}, {1.4, 0, 1.3}, {0, 1.3, 1.3}});
  d.element({0, 0, 0}, {0, 0, 1});
  d.line({0, 0, 0}, {0, 0, 1.3});
  d.dimension({0, 0, 1.3}, {1.4, 0, 1.3}, "a");
  d.dimension({0, 0, 1.3}, {0, 1.3, 1.3}, "b");
  d.height({0, 0, 0}, {0, 0, 1.3}, -0.35, "c");
  return d;
}

}  // namespace

std::vector<Entry> elements_to_polygons() {
  return {
      {.id = "element-corner-rectangle",
       .number = "B-4",
       .title = "Element to parallel rectangle, its normal through a corner",
       .parameters = {length("a", "side of the rectangle"), length("b", "other side"), length("c", "distance")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "A = a/c, B = b/c: F = (1/2π) [A/√(1+A²) atan(B/√(1+A²)) + B/√(1+B²) atan(A/√(1+B²))]",
       .source = "Lambert's sum over the four edges, of which two pass through the normal and give nothing",
       .care = "two positive terms: nothing cancels",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return corner(p[0] / p[2], p[1] / p[2]); },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = corner_over_element},
      {.id = "element-standing-rectangle",
       .number = "B-5",
       .title = "Element to perpendicular rectangle with a corner at the element's height",
       .parameters = {length("a", "height of the rectangle along the element's normal"), length("b", "its width"),
                      length("c", "distance of the element from its plane, at one end of its width")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "X = a/b, Y = c/b: F = (1/2π) [atan(1/Y) − Y/√(X²+Y²) atan(1/√(X²+Y²))]",
       .source = "Lambert's sum",
       .care =
           "a ≪ c: two nearly equal terms, of which (a/c)² remains; the count of twice the digits holds it to the end",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted far = hypot(p[0], p[2]);
             return (atan(p[1] / p[2]) - p[2] / far * atan(p[1] / far)) / (2 * pi());
           },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = standing_rectangle},
      {.id = "element-leaning-rectangle",
       .number = "B-6",
       .title = "Element to rectangle at an angle, an edge of it in the element's plane",
       .parameters = {length("a", "side of the rectangle that rises from the element's plane"),
                      length("b", "its edge in the element's plane"),
                      length("c", "distance of the element from that edge's end, across the edge"),
                      angle("phi", "angle between the two planes on the element's side", 1, 179)},
       .conditions = {},
       .widest_ratio = 1e4,
       .formula =
           "N = a/b, L = c/b, V = 1/√(N²+L²−2NL cos φ), W = √(1+L² sin²φ): F = (1/2π) {atan(1/L) + V (N cos φ − L) "
           "atan V + (cos φ/W) [atan((N − L cos φ)/W) + atan(L cos φ/W)]}",
       .source = "Lambert's sum; V's root is taken as (N−L)² + 4NL sin²(φ/2)",
       .care = "a ≪ c and φ near 180° cancel; counted",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const double phi = exact(p[3]);
             const Counted n = p[0] / p[1], l = p[2] / p[1], cosine = cos_deg(phi);
             const Counted v = 1 / sqrt(square(n - l) + 4 * n * l * square(sin_deg(phi / 2)));
             const Counted w = hypot(1, l * sin_deg(phi));
             return (atan(1 / l) + v * (n * cosine - l) * atan(v) +
                     cosine / w * (atan((n - l * cosine) / w) + atan(l * cosine / w))) /
                    (2 * pi());
           },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = leaning_rectangle},
      {.id = "element-rectangle",
       .number = "",
       .title = "Element to parallel rectangle anywhere above it",
       .parameters = {position("x1", "left side, from the element"), position("x2", "right side"),
                      position("y1", "near side"), position("y2", "far side"), length("c", "distance")},
       .conditions = {{"x2 > x1", "x2", [](std::span<const double> p) { return p[1] > p[0]; }},
                      {"y2 > y1", "y2", [](std::span<const double> p) { return p[3] > p[2]; }}},
       .widest_ratio = 1e6,
       .formula =
           "F = f(x2,y2) − f(x1,y2) − f(x2,y1) + f(x1,y1), f the factor of element-corner-rectangle, odd in both",
       .source = "configuration algebra of four corners",
       .care = "a small rectangle far aside is a difference of four nearly equal terms: the bound says what is left",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const auto f = [&](int x, int y) {
               return corner(p[static_cast<std::size_t>(x)] / p[4], p[static_cast<std::size_t>(y)] / p[4]);
             };
             return f(1, 3) - f(0, 3) - f(1, 2) + f(0, 2);
           },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = rectangle_over_element},
      {.id = "element-regular-polygon",
       .number = "",
       .title = "Element to parallel regular polygon, its normal through the centre",
       .parameters = {count("n", "number of sides", 3, 1000), length("a", "radius of the inscribed circle"),
                      length("h", "distance")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "F = (n/π) a/√(a²+h²) atan(a tan(π/n)/√(a²+h²))",
       .source = "Lambert's sum of n equal edges",
       .care = "one product: nothing cancels; n → ∞ is B-12",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted s = hypot(p[1], p[2]);
             return p[0] / pi() * p[1] / s * atan(p[1] * tan_pi_over(static_cast<int>(exact(p[0]))) / s);
           },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = hexagon_over_element},
      {.id = "element-right-triangle",
       .number = "",
       .title = "Element to parallel right triangle, its normal through the right angle",
       .parameters = {length("a", "leg"), length("b", "other leg"), length("c", "distance")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "m = ab/√(a²+b²), s = √(m²+c²): F = (1/2π) (m/s) [atan(a²/(s√(a²+b²))) + atan(b²/(s√(a²+b²)))]",
       .source = "Lambert's sum: the legs pass through the normal, the hypotenuse remains",
       .care = "positive terms: nothing cancels",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted hypotenuse = hypot(p[0], p[1]), m = p[0] * p[1] / hypotenuse, s = hypot(m, p[2]);
             return m / s * (atan(p[0] * p[0] / (s * hypotenuse)) + atan(p[1] * p[1] / (s * hypotenuse))) / (2 * pi());
           },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = triangle_over_element},
  };
}

}  // namespace etendue::catalogue
