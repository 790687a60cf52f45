// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "etendue/form_factor/catalogue/families.hpp"
#include "etendue/form_factor/catalogue/round_formulas.hpp"

namespace etendue::catalogue {

// What stands in catalogue no. 19 of a widely copied program differs in three places; sphere_errata_test.cpp shows them
// fail.
Counted cut_sphere(const Counted& h, const Counted& l) {
  const Counted x = square(l) + square(h);
  if (h.value.high >= 1) return h / (x * sqrt(x));
  const Counted y = sqrt(x - 1), below = sqrt((1 - h) * (1 + h));
  const Counted first = h / (x * sqrt(x)) * atan2(sqrt(x) * below, -(h * y));
  return (first - y * below / x + atan2(below, y)) / pi();
}

namespace {

Drawing beside_cylinder() {
  Drawing d;
  d.frustum(Surface::to, {0, 0, 0}, 0.5, {0, 0, 1.4}, 0.5);
  d.element({1.7, 0, 0}, {-1, 0, 0});
  d.line({0, 0, 0}, {1.7, 0, 0});
  d.dimension({0, -0.15, 0}, {1.7, -0.15, 0}, "h");
  d.height({0, 0, 0}, {0, 0, 1.4}, -0.7, "l");
  d.dimension({0, 0, 1.4}, {0.5, 0, 1.4}, "r");
  return d;
}

Drawing sphere_over(const Vec3& centre, const Vec3& normal) {
  Drawing d;
  d.ball(Surface::to, centre, 0.6);
  d.element({0, 0, 0}, normal);
  d.dimension(centre, centre + Vec3(0.51, 0.3, 0), "r");
  return d;
}

Drawing sphere_on_normal() {
  Drawing d = sphere_over({0, 0, 1.5}, {0, 0, 1});
  d.line({0, 0, 0}, {0, 0, 1.5});
  d.height({0, 0, 0}, {0, 0, 1.5}, -0.8, "h");
  return d;
}

Drawing sphere_tilted() {
  Drawing d = sphere_over({0, 0, 1.6}, {0.6, 0, 0.8});
  d.line({0, 0, 0}, {0, 0, 1.6});
  d.height({0, 0, 0}, {0, 0, 1.6}, -0.8, "h");
  d.angle({0, 0, 0}, {0, 0, 1}, {0.6, 0, 0.8}, 0.62, "omega");
  return d;
}

Drawing sphere_halved() {
  Drawing d = sphere_over({1.6, 0, 0}, {0, 0, 1});
  d.line({0, 0, 0}, {1.6, 0, 0});
  d.dimension({0, -0.2, 0}, {1.6, -0.2, 0}, "h");
  return d;
}

Drawing sphere_cut() {
  Drawing d = sphere_over({1.6, 0, 0.3}, {0, 0, 1});
  d.rectangle(Surface::other, {-0.4, -0.8, 0}, {2.8, 0, 0}, {0, 1.6, 0});
  d.dimension({0, 0, 0}, {1.6, 0, 0}, "l");
  d.dimension({1.6, 0, 0}, {1.6, 0, 0.3}, "h");
  return d;
}

Drawing long_cylinder() {
  Drawing d(View::section);
  d.circle_trace(Surface::to, {0, 0, 1.5}, 0.55);
  d.element({0, 0, 0}, {0.5, 0, 0.866});
  d.line({0, 0, 0}, {0, 0, 1.5});
  d.angle({0, 0, 0}, {0, 0, 1}, {0.5, 0, 0.866}, 0.6, "omega");
  d.dimension({0, 0, 1.5}, {0.55, 0, 1.5}, "r");
  d.height({0, 0, 0}, {0, 0, 1.5}, -0.8, "h");
  return d;
}

bool outside(double distance, double radius) {
  return distance >= radius;
}

bool above_horizon(double h, double omega, double r) {
  const Counted margin = h * cos_deg(omega) - r;
  return margin.value.high >= -margin.error;
}

}  // namespace

std::vector<Entry> elements_to_solids() {
  return {
      {.id = "element-cylinder",
       .number = "B-31",
       .title = "Element to the outside of a cylinder, its normal meeting the axis at the cylinder's end",
       .parameters = {length("h", "distance of the element from the axis"), length("l", "length of the cylinder"),
                      length("r", "its radius")},
       .conditions = {{"h >= 1.000001 r, the element outside the cylinder", "h",
                       [](std::span<const double> p) { return p[0] >= 1.000001 * p[2]; }}},
       .widest_ratio = 1e4,
       .formula = "H = h/r, L = l/r, X = (1+H)²+L², Y = (1−H)²+L²: F = (1/πH) {atan(L/√(H²−1)) + L (X−2H)/√(XY) "
                  "atan √(X(H−1)/(Y(H+1))) − L atan √((H−1)/(H+1))}",
       .source = "no paper is cited: the number is Howell's as commonly quoted, not confirmed; the formula was checked "
                 "against the "
                 "integral over the visible wall",
       .care = "a short cylinder leaves a difference; H²−1 and Y are taken from h−r; counted",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted h = p[0] / p[2], l = p[1] / p[2], beyond = (p[0] - p[2]) / p[2];
             const Counted x = square(1 + h) + square(l), y = square(beyond) + square(l);
             const Counted ends = atan(l / sqrt(beyond * (h + 1)));
             const Counted wall = l * (x - 2 * h) / sqrt(x * y) * atan(sqrt(x * beyond / (y * (h + 1))));
             return (ends + wall - l * atan(sqrt(beyond / (h + 1)))) / (pi() * h);
           },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = beside_cylinder},
      {.id = "element-sphere",
       .number = "B-38",
       .title = "Element to sphere on its normal",
       .parameters = {length("h", "distance of the centre"), length("r", "radius")},
       .conditions = {{"h >= r, the element outside the sphere", "h",
                       [](std::span<const double> p) { return outside(p[0], p[1]); }}},
       .widest_ratio = 1e6,
       .formula = "F = (r/h)²",
       .source = "the sphere's outline is a disc, B-12",
       .care = "one quotient: nothing cancels",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return square(p[1] / p[0]); },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = sphere_on_normal},
      {.id = "element-sphere-halved",
       .number = "B-39",
       .title = "Element to sphere, the element's plane passing through the centre",
       .parameters = {length("h", "distance of the centre"), length("r", "radius")},
       .conditions = {{"h >= r, the element outside the sphere", "h",
                       [](std::span<const double> p) { return outside(p[0], p[1]); }}},
       .widest_ratio = 1e6,
       .formula = "H = h/r: F = (1/π) [atan(1/√(H²−1)) − √(H²−1)/H²]",
       .source = "Lambert's contour: half of the outline and the horizon",
       .care = "a far sphere leaves a difference of order H⁻³; counted; the element on the sphere is allowed, F = 1/2",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted root = sqrt((p[0] - p[1]) * (p[0] + p[1])) / p[1], h = p[0] / p[1];
             return (atan2(1, root) - root / square(h)) / pi();
           },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = sphere_halved},
      {.id = "element-sphere-tilted",
       .number = "B-40",
       .title = "Element to sphere, tilted while all of the sphere is above its horizon",
       .parameters = {length("h", "distance of the centre"), length("r", "radius"),
                      angle("omega", "angle between the normal and the direction of the centre", 0, 89.9)},
       .conditions = {{"omega with h cos(omega) >= r, the sphere above the horizon", "omega",
                       [](std::span<const double> p) { return above_horizon(p[0], p[2], p[1]); }}},
       .widest_ratio = 1e6,
       .formula = "F = cos ω (r/h)²",
       .source = "Lambert's vector of the sphere points to its centre",
       .care = "beyond the horizon see element-sphere-cut: refused here",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return cos_deg(exact(p[2])) * square(p[1] / p[0]); },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = sphere_tilted},
      {.id = "element-sphere-cut",
       .number = "B-41",
       .title = "Element to sphere anywhere, cut by the element's horizon where it must be",
       .parameters = {position("h", "height of the centre above the element's plane, negative below"),
                      offset("l", "distance of the centre from the normal"), length("r", "radius")},
       .conditions = {{"h > -r, a part of the sphere above the horizon", "h",
                       [](std::span<const double> p) { return p[0] > -p[2]; }},
                      {"l with h^2 + l^2 > r^2, the element outside the sphere", "l",
                       [](std::span<const double> p) {
                         const double scale = std::max({std::abs(p[0]), p[1], p[2]});
                         const double h = p[0] / scale, l = p[1] / scale, r = p[2] / scale;
                         return h * h + l * l > r * r;
                       }}},
       .widest_ratio = 1e6,
       .formula = "H = h/r, L = l/r, X = L²+H², Y = √(X−1): |H| < 1: F = (1/π) [H X^(−3/2) acos(−HY/L) − Y√(1−H²)/X − "
                  "asin(Y/L) + π/2]; H ≥ 1: F = H X^(−3/2)",
       .source = "Lambert's contour: part of the outline and the horizon",
       .care = "both arcs are taken by atan2, π/2 − asin as one arc; h → −r leaves a difference of order (h+r)^(5/2), "
               "whose relative bound grows",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return cut_sphere(p[0] / p[2], p[1] / p[2]); },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = sphere_cut},
      {.id = "element-long-cylinder",
       .number = "",
       .title = "Element to infinitely long cylinder, tilted across the axis while all of it is above the horizon",
       .parameters = {length("h", "distance of the axis"), length("r", "radius"),
                      angle("omega", "angle between the normal and the direction of the axis", 0, 89.9)},
       .conditions = {{"omega with h cos(omega) >= r, the cylinder above the horizon", "omega",
                       [](std::span<const double> p) { return above_horizon(p[0], p[2], p[1]); }}},
       .widest_ratio = 1e6,
       .formula = "F = cos ω · r/h",
       .source = "B-71 between the two tangents",
       .care = "one product: nothing cancels; valid for elements and for strips along the cylinder alike",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return cos_deg(exact(p[2])) * p[1] / p[0]; },
       .area_from = nullptr,
       .area_to = nullptr,
       .picture = long_cylinder},
  };
}

}  // namespace etendue::catalogue
