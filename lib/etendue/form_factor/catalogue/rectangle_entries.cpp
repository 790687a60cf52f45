// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "etendue/form_factor/catalogue/families.hpp"
#include "etendue/form_factor/rectangles.hpp"

namespace etendue::catalogue {

namespace {

Counted counted(const Bounded& f) {
  return {DoubleDouble(f.value), f.bound};
}

Counted area(const Counted& a, const Counted& b) {
  return a * b;
}

/// Sums the corner function g over differences of the sides, with the signs of the fourfold primitive.
template <class Corner>
Counted sixteen_corners(const Corner& g) {
  Counted sum;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      for (std::size_t k = 0; k < 2; ++k) {
        for (std::size_t l = 0; l < 2; ++l) {
          const Counted term = g(i, j, k, l);
          sum = (i + j + k + l) % 2 == 0 ? sum + term : sum - term;
        }
      }
    }
  }
  return sum;
}

/// x² ln y with its limit 0, where both vanish together.
Counted weighted_log(const Counted& weight, const Counted& y) {
  return y.value.high == 0 && y.error == 0 ? Counted(0) : weight * log(y);
}

Counted parallel_corner(const Counted& u, const Counted& v, const Counted& z) {
  const Counted p = hypot(u, z), q = hypot(v, z), z2 = square(z);
  return v * p * atan(v / p) + u * q * atan(u / q) - z2 / 2 * log(square(u) + square(v) + z2);
}

Counted perpendicular_corner(const Counted& k, const Counted& s2) {
  const Counted k2 = square(k), logarithm = weighted_log((s2 - k2) / 4, s2 + k2);
  if (s2.value.high == 0) return -logarithm;
  const Counted s = sqrt(s2);
  return k * s * atan(k / s) - logarithm;
}

/// √(1+z² sin²φ) [atan(z cos φ/√…) + atan((A − z cos φ)/√…)], values being cos φ, sin φ, A.
Counted edge_integrand(const Counted& z, Values p) {
  const Counted root = hypot(1, z * p[1]), along = z * p[0];
  return root * (atan(along / root) + atan((p[2] - along) / root));
}

/// The integrand's singularities ±i, ±i/sin φ and A cos φ ± i√(1 + A² sin²φ) lie at least 1 away from the real line. Each
/// piece is half as long as they are far from where it begins, so all stay outside its Bernstein ellipse 5.8.
Counted edge_integral(const Counted& width, Values p) {
  Counted sum, low;
  const double end = width.value.high, centre = p[2].value.high * p[0].value.high;
  const double beside = std::hypot(1.0, p[2].value.high * p[1].value.high);
  while (low.value.high < end) {
    const double from = low.value.high;
    const double step = std::fmin(std::hypot(from, 1.0), std::hypot(from - centre, beside)) / 2;
    const Counted high = from + step < end ? Counted(from + step) : width;
    sum = sum + integral(low, high, edge_integrand, p);
    low = high;
  }
  return sum;
}

Counted hinged(Values p) {
  const double phi = exact(p[3]);
  const Counted a = p[0] / p[2], b = p[1] / p[2], sine = sin_deg(phi), cosine = cos_deg(phi);
  const Counted a2 = square(a), b2 = square(b), sin2 = 2 * sine * cosine, sine2 = square(sine);
  const Counted c = square(a - b) + 4 * a * b * square(sin_deg(phi / 2)), d = hypot(1, a * sine);
  const Counted first = a * b * sine + (pi() / 2 - radians(phi)) * (a2 + b2) +
                        b2 * atan((a - b * cosine) / (b * sine)) + a2 * atan((b - a * cosine) / (a * sine));
  // sin²φ times the logarithms, with (2/sin²φ − 1) sin²φ = 1 + cos²φ and cos 2φ sin²φ = (1 − 2 sin²φ) sin²φ
  const Counted cos2 = 1 - 2 * sine2;
  const Counted second = (1 + square(cosine)) * (log1p(a2) + log1p(b2) - log1p(c)) +
                         sine2 * b2 * (log(b2 / c) + log1p(c) - log1p(b2)) +
                         sine2 * a2 * (log(a2 / c) + cos2 * (log1p(a2) - log1p(c)));
  const Counted root = sqrt(c);
  const Counted third = b * atan(1 / b) + a * atan(1 / a) - root * atan(1 / root);
  const Counted fourth = sine * sin2 / 2 * a * d * (atan(a * cosine / d) + atan((b - a * cosine) / d));
  Counted fifth;
  if (phi != 90) {
    const Counted angles[] = {cosine, sine, a};
    fifth = cosine * edge_integral(b, angles);
  }
  return (second / 4 - sin2 / 4 * first + third + fourth + fifth) / (pi() * b);
}

Drawing opposite() {
  Drawing d;
  d.rectangle(Surface::from, {0, 0, 0}, {1.4, 0, 0}, {0, 1, 0});
  d.rectangle(Surface::to, {0, 0, 1.2}, {1.4, 0, 0}, {0, 1, 0});
  d.dimension({0, -0.12, 0}, {1.4, -0.12, 0}, "a");
  d.dimension({1.5, 0, 0}, {1.5, 1, 0}, "b");
  d.height({0, 0, 0}, {0, 0, 1.2}, -0.15, "c");
  return d;
}

Drawing corner() {
  Drawing d;
  d.rectangle(Surface::from, {0, 0, 0}, {1.4, 0, 0}, {0, 1.1, 0});
  d.rectangle(Surface::to, {0, 1.1, 0}, {1.4, 0, 0}, {0, 0, 1});
  d.dimension({1.5, 0, 0}, {1.5, 1.1, 0}, "w");
  d.dimension({1.5, 1.1, 0}, {1.5, 1.1, 1}, "h");
  d.dimension({0, -0.12, 0}, {1.4, -0.12, 0}, "l");
  return d;
}

Drawing hinge() {
  Drawing d;
  const Vec3 up(0, -0.45, 0.95);
  d.rectangle(Surface::from, {0, 1.2, 0}, {1.4, 0, 0}, {0, -1.2, 0});
  d.rectangle(Surface::to, {0, 1.2, 0}, {1.4, 0, 0}, up);
  d.dimension({-0.12, 1.2, 0}, {-0.12, 0, 0}, "w");
  d.dimension(Vec3(1.52, 1.2, 0), Vec3(1.52, 1.2, 0) + up, "h");
  d.dimension({0, -0.12, 0}, {1.4, -0.12, 0}, "l");
  d.angle({1.4, 1.2, 0}, {0, -1, 0}, up, 0.4, "phi");
  return d;
}

Drawing general_parallel() {
  Drawing d;
  d.rectangle(Surface::from, {0.3, 0.2, 0}, {0.9, 0, 0}, {0, 0.7, 0});
  d.rectangle(Surface::to, {0.9, 0.6, 1.1}, {0.9, 0, 0}, {0, 0.6, 0});
  d.line({0, 0, 0}, {2, 0, 0}, Stroke::thin);
  d.line({0, 0, 0}, {0, 1.4, 0}, Stroke::thin);
  d.line({0, 0, 0}, {0, 0, 1.1}, Stroke::thin);
  d.line({0, 0, 1.1}, {2, 0, 1.1}, Stroke::thin);
  d.line({0, 0, 1.1}, {0, 1.4, 1.1}, Stroke::thin);
  d.dimension({0, 0, 0}, {0, 0, 1.1}, "z");
  d.dimension({0, -0.1, 0}, {0.3, -0.1, 0}, "x1");
  d.dimension({0, -0.35, 0}, {1.2, -0.35, 0}, "x2");
  d.dimension({2.1, 0, 0}, {2.1, 0.2, 0}, "y1");
  d.dimension({2.4, 0, 0}, {2.4, 0.9, 0}, "y2");
  d.dimension({0, 0.6, 1.1}, {0.9, 0.6, 1.1}, "u1");
  d.dimension({0, 1.35, 1.1}, {1.8, 1.35, 1.1}, "u2");
  d.dimension({1.95, 0, 1.1}, {1.95, 0.6, 1.1}, "v1");
  d.dimension({2.2, 0, 1.1}, {2.2, 1.2, 1.1}, "v2");
  return d;
}

Drawing general_perpendicular() {
  Drawing d;
  d.rectangle(Surface::from, {0.5, 0.2, 0}, {0.9, 0, 0}, {0, 0.6, 0});
  d.rectangle(Surface::to, {0, 0.7, 0.4}, {0, 0.6, 0}, {0, 0, 0.7});
  d.line({0, 0, 0}, {1.7, 0, 0}, Stroke::thin);
  d.line({0, 0, 0}, {0, 1.6, 0}, Stroke::thin);
  d.line({0, 0, 0}, {0, 0, 1.3}, Stroke::thin);
  d.dimension({0, -0.1, 0}, {0.5, -0.1, 0}, "x1");
  d.dimension({0, -0.35, 0}, {1.4, -0.35, 0}, "x2");
  d.dimension({1.55, 0, 0}, {1.55, 0.2, 0}, "y1");
  d.dimension({1.8, 0, 0}, {1.8, 0.8, 0}, "y2");
  d.dimension({0, 0, 0.4}, {0, 0.7, 0.4}, "v1");
  d.dimension({0, 0, 1.25}, {0, 1.3, 1.25}, "v2");
  d.height({0, 0, 0}, {0, 0, 0.4}, -0.12, "z1");
  d.height({0, 0, 0}, {0, 0, 1.1}, -0.4, "z2");
  return d;
}

Drawing strip_opposite() {
  Drawing d;
  d.rectangle(Surface::to, {0, 0, 1.2}, {1.2, 0, 0}, {0, 1, 0});
  d.rectangle(Surface::from, {-0.03, 0, 0}, {0.06, 0, 0}, {0, 1, 0});
  d.line({0, 0, 0}, {0, 0, 1.2});
  d.line({0, 1, 0}, {0, 1, 1.2});
  d.dimension({0, -0.1, 1.2}, {1.2, -0.1, 1.2}, "a");
  d.dimension({0.15, 0, 0}, {0.15, 1, 0}, "b");
  d.height({0, 0, 0}, {0, 0, 1.2}, -0.2, "c");
  d.label({0, 1, 0}, "dA\u2081");
  return d;
}

Drawing strip_standing() {
  Drawing d;
  d.rectangle(Surface::to, {0, 1, 0}, {1.2, 0, 0}, {0, 0, 1});
  d.rectangle(Surface::from, {0, -0.03, 0}, {1.2, 0, 0}, {0, 0.06, 0});
  d.line({0, 0, 0}, {0, 1, 0});
  d.line({1.2, 0, 0}, {1.2, 1, 0});
  d.dimension({1.32, 1, 0}, {1.32, 1, 1}, "a");
  d.dimension({0, -0.18, 0}, {1.2, -0.18, 0}, "b");
  d.dimension({1.32, 0, 0}, {1.32, 1, 0}, "c");
  d.label({0, 0, 0.05}, "dA\u2081");
  return d;
}

bool grows(std::span<const double> p, std::size_t low) {
  return p[low + 1] > p[low];
}

}  // namespace

std::vector<Entry> rectangle_entries() {
  return {
      {.id = "C-11",
       .number = "C-11",
       .title = "Equal, parallel, directly opposed rectangles",
       .parameters = {length("a", "side"), length("b", "other side"), length("c", "distance")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "X = a/c, Y = b/c: F = (2/πXY) {ln √[(1+X²)(1+Y²)/(1+X²+Y²)] + X√(1+Y²) atan(X/√(1+Y²)) + Y√(1+X²) "
                  "atan(Y/√(1+X²)) − X atan X − Y atan Y}",
       .source = "Howell, catalogue of configuration factors, C-11; form_factor/rectangles.hpp",
       .care = "small ratios cancel to X²Y²: there the positive integral behind the formula is taken",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return counted(parallel_rectangles(exact(p[0]), exact(p[1]), exact(p[2]))); },
       .area_from = [](Values p) { return area(p[0], p[1]); },
       .area_to = [](Values p) { return area(p[0], p[1]); },
       .picture = opposite},
      {.id = "C-14",
       .number = "C-14",
       .title = "Rectangles at a right angle, sharing an edge",
       .parameters = {length("w", "width of the first"), length("h", "height of the second"),
                      length("l", "common edge")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "W = w/l, H = h/l, J(a) = ½ ln(1+a²) + 2a atan(1/a) − ½ a² ln(1+1/a²): F = [J(W) + J(H) − "
                  "J(√(W²+H²))]/(2πW)",
       .source = "Howell, catalogue of configuration factors, C-14; form_factor/rectangles.hpp",
       .care = "the difference of the two larger J is formed term by term",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return counted(perpendicular_rectangles(exact(p[0]), exact(p[1]), exact(p[2]))); },
       .area_from = [](Values p) { return area(p[0], p[2]); },
       .area_to = [](Values p) { return area(p[1], p[2]); },
       .picture = corner},
      {.id = "parallel-rectangles",
       .number = "C-13",
       .title = "Parallel rectangles anywhere, their sides parallel",
       .parameters = {position("x1", "first rectangle from x1"), position("x2", "to x2"), position("y1", "from y1"),
                      position("y2", "to y2"), position("u1", "second rectangle from x = u1"), position("u2", "to u2"),
                      position("v1", "from y = v1"), position("v2", "to v2"), length("z", "distance of the planes")},
       .conditions = {{"x2 > x1", "x2", [](std::span<const double> p) { return grows(p, 0); }},
                      {"y2 > y1", "y2", [](std::span<const double> p) { return grows(p, 2); }},
                      {"u2 > u1", "u2", [](std::span<const double> p) { return grows(p, 4); }},
                      {"v2 > v1", "v2", [](std::span<const double> p) { return grows(p, 6); }}},
       .widest_ratio = 1e6,
       .formula = "A1 F = Σ (−1)^(i+j+k+l) G(x_i − u_k, y_j − v_l), 2πG(u,v) = v p atan(v/p) + u q atan(u/q) − (z²/2) "
                  "ln(u²+v²+z²), p = √(u²+z²), q = √(v²+z²)",
       .source = "the fourfold primitive of the integral",
       .care = "sixteen terms of order d² leave A1A2/d²: in double nothing remains of sides below 1e-4 d, in twice the "
               "digits 12 digits remain to 1e-5 d; the bound says what is left",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted sum = sixteen_corners([&](std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
               return parallel_corner(p[i] - p[4 + k], p[2 + j] - p[6 + l], p[8]);
             });
             return sum / (2 * pi() * (p[1] - p[0]) * (p[3] - p[2]));
           },
       .area_from = [](Values p) { return area(p[1] - p[0], p[3] - p[2]); },
       .area_to = [](Values p) { return area(p[5] - p[4], p[7] - p[6]); },
       .picture = general_parallel},
      {.id = "perpendicular-rectangles",
       .number = "C-15",
       .title = "Rectangles in planes at a right angle, anywhere, their sides parallel",
       .parameters = {offset("x1", "first rectangle from x1, the distance to the second's plane"),
                      length("x2", "to x2"), position("y1", "from y1, along the planes' common line"),
                      position("y2", "to y2"), position("v1", "second rectangle from y = v1"), position("v2", "to v2"),
                      offset("z1", "from z1, the height over the first's plane"), length("z2", "to z2")},
       .conditions = {{"x2 > x1", "x2", [](std::span<const double> p) { return grows(p, 0); }},
                      {"y2 > y1", "y2", [](std::span<const double> p) { return grows(p, 2); }},
                      {"v2 > v1", "v2", [](std::span<const double> p) { return grows(p, 4); }},
                      {"z2 > z1", "z2", [](std::span<const double> p) { return grows(p, 6); }}},
       .widest_ratio = 1e6,
       .formula = "A1 F = Σ (−1)^(i+j+k+l) G(y_j − v_k, x_i² + z_l²), 2πG(k,s²) = k s atan(k/s) − ¼ (s²−k²) ln(s²+k²)",
       .source = "the fourfold primitive of the integral",
       .care = "as parallel-rectangles; the limits 0 ln 0 and 0 atan ∞ where the two touch are taken as 0",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted sum = sixteen_corners([&](std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
               return perpendicular_corner(p[2 + j] - p[4 + k], square(p[i]) + square(p[6 + l]));
             });
             return sum / (2 * pi() * (p[1] - p[0]) * (p[3] - p[2]));
           },
       .area_from = [](Values p) { return area(p[1] - p[0], p[3] - p[2]); },
       .area_to = [](Values p) { return area(p[5] - p[4], p[7] - p[6]); },
       .picture = general_perpendicular},
      {.id = "hinged-rectangles",
       .number = "C-16",
       .title = "Rectangles at any angle, sharing an edge",
       .parameters = {length("h", "height of the second"), length("w", "width of the first"),
                      length("l", "common edge"), angle("phi", "angle between them", 1, 179)},
       .conditions = {},
       .widest_ratio = 1e2,
       .formula = "A = h/l, B = w/l: Feingold's form: logarithms and arcs of A, B, φ and "
                  "(cos φ/πB) ∫_0^B √(1+z² sin²φ) [atan(z cos φ/√(1+z² sin²φ)) + atan((A − z cos φ)/√(1+z² sin²φ))] dz",
       .source =
           "Feingold 1966; the remaining integral by Gauss rules on pieces shorter than its singularities are far",
       .care = "large ratios cancel like B², φ near 180° like its square; 1 + A² + B² − … are taken by log1p and from "
               "A − B",
       .accuracy = Accuracy::measured,
       .factor = hinged,
       .area_from = [](Values p) { return area(p[1], p[2]); },
       .area_to = [](Values p) { return area(p[0], p[2]); },
       .picture = hinge},
      {.id = "strip-opposite-rectangle",
       .number = "",
       .title = "Strip element to parallel rectangle, opposite one of its edges",
       .parameters = {length("a", "side of the rectangle across the strip"),
                      length("b", "length of the strip and the other side"), length("c", "distance")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "X = a/c, Y = b/c: F = (1/πY) [√(1+Y²) atan(X/√(1+Y²)) − atan X + XY/√(1+X²) atan(Y/√(1+X²))]",
       .source = "mean of element-corner-rectangle along the strip",
       .care = "a short strip leaves terms of order Y²; counted",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted x = p[0] / p[2], y = p[1] / p[2], px = hypot(1, x), py = hypot(1, y);
             return (py * atan(x / py) - atan(x) + x * y / px * atan(y / px)) / (pi() * y);
           },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = strip_opposite},
      {.id = "strip-standing-rectangle",
       .number = "",
       .title = "Strip element to perpendicular rectangle of the same length, in front of it",
       .parameters = {length("a", "height of the rectangle"),
                      length("b", "length of the strip and width of the rectangle"),
                      length("c", "distance of the strip from its plane")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "X = a/b, Y = c/b: F = (1/π) {atan(1/Y) + (Y/2) ln[Y²(X²+Y²+1)/((1+Y²)(X²+Y²))] − Y/√(X²+Y²) "
                  "atan(1/√(X²+Y²))}",
       .source = "mean of element-standing-rectangle along the strip",
       .care = "a far strip cancels in all three terms; the logarithm is taken as log1p(−X²/((1+Y²)(X²+Y²)))",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted x = p[0] / p[1], y = p[2] / p[1], y2 = square(y), far = hypot(x, y);
             const Counted logarithm = log1p(-(square(x) / ((1 + y2) * (square(x) + y2))));
             return (atan(1 / y) + y / 2 * logarithm - y / far * atan(1 / far)) / pi();
           },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = strip_standing},
  };
}

}  // namespace etendue::catalogue
