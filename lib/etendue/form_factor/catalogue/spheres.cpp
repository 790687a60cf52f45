// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/catalogue/families.hpp"

namespace etendue::catalogue {

namespace {

Counted sphere_area(const Counted& r) {
  return 4 * pi() * square(r);
}

/// Share of all directions within the cone from the centre to a circle of radius r at the distance h.
Counted cap_share(const Counted& r, const Counted& h) {
  const Counted g = hypot(r, h);
  return square(r) / (2 * g * (g + h));
}

/// Integrand of sphere-sphere over ψ ∈ [0, π]: h = r2 cos ψ is the height of the second centre over the plane of an
/// element of the first sphere, which it cuts. Values are r1, r2, d. Unit length is r2.
Counted partly_seen(const Counted& psi_over_pi, Values p) {
  // cos and sin of ψ by the angle in degrees, exact enough: ψ is a node, not a given number
  const double degrees = 180 * psi_over_pi.value.high;
  const Counted slip = pi() * (psi_over_pi - degrees / 180), c0 = cos_deg(degrees), s0 = sin_deg(degrees);
  const Counted c = c0 - slip * s0 - square(slip) * c0 / 2, s = s0 + slip * c0 - square(slip) * s0 / 2;
  const Counted r1 = p[0] / p[1], d = p[2] / p[1];
  // d cos θ = r1 + h, and the distance² from element to centre is d² − r1² − 2 r1 h
  const Counted x = (d - r1) * (d + r1) - 2 * r1 * c, y = sqrt(x - 1), root = sqrt(x);
  const Counted factor = c / (x * root) * atan2(root * s, -(c * y)) - y * s / x + atan2(s, y);
  return factor * s;
}

Counted sphere_to_sphere(Values p) {
  const Counted r1 = p[0], r2 = p[1], d = r1 + r2 + p[2];
  // Elements that see all of it: ½ ∫ r2² h/D³ dt over t = cos θ from (r1+r2)/d to 1, with D² = r1²+d²−2 r1 d t.
  const Counted near = d - r1;
  const Counted horizon = sqrt((d - r1) * (d + r1) - 2 * r1 * r2);  // D where the sphere touches the element's plane
  const auto primitive = [&](const Counted& distance) {
    // h = (d² − r1² − D²)/(2 r1), dt = −D dD/(r1 d): ∫ h/D³ dt = −∫ (d²−r1²−D²)/(2 r1² d D²) dD
    return ((d - r1) * (d + r1) / distance + distance) / (2 * square(r1) * d);
  };
  const Counted seen = square(r2) / 2 * (primitive(near) - primitive(horizon));
  const Counted values[] = {r1, r2, d};
  Counted partly;
  constexpr int kPieces = 4;
  for (int k = 0; k < kPieces; ++k) {
    partly = partly + integral(Counted(k) / kPieces, Counted(k + 1) / kPieces, partly_seen, values);
  }
  // dt = r2 sin ψ dψ/d, dψ = π du; the factor of an element holds 1/π
  return seen + r2 / (2 * d) * partly;
}

Drawing sphere_and_rectangle() {
  Drawing d;
  d.ball(Surface::from, {0, 0, 0}, 0.4);
  d.rectangle(Surface::to, {0, 0, 1.2}, {1.3, 0, 0}, {0, 1, 0});
  d.line({0, 0, 0}, {0, 0, 1.2});
  d.height({0, 0, 0}, {0, 0, 1.2}, -0.55, "d");
  d.dimension({0, 0, 1.2}, {1.3, 0, 1.2}, "a");
  d.dimension({1.3, 0, 1.2}, {1.3, 1, 1.2}, "b");
  d.dimension({0, 0, 0}, {0.34, 0.2, 0}, "r");
  return d;
}

Drawing sphere_and_disc(double hole) {
  Drawing d;
  d.ball(Surface::from, {0, 0, 0}, 0.4);
  d.disc(Surface::to, {0, 0, 1.2}, {0, 0, 1}, 0.9, hole);
  d.line({0, 0, 0}, {0, 0, 1.2});
  d.height({0, 0, 0}, {0, 0, 1.2}, -1.05, "h");
  d.dimension({0, 0, 0}, {0.34, 0.2, 0}, "r");
  if (hole > 0) {
    d.dimension({0, 0, 1.2}, {hole, 0, 1.2}, "r1");
    d.dimension({0, 0, 1.2}, {0.54, -0.72, 1.2}, "r2");
  } else {
    d.dimension({0, 0, 1.2}, {0.9, 0, 1.2}, "r1");
  }
  return d;
}

Drawing sphere_and_hexagon() {
  Drawing d;
  d.ball(Surface::from, {0, 0, 0}, 0.4);
  d.polygon(
      Surface::to,
      {{1, 0, 1.2}, {0.5, 0.866, 1.2}, {-0.5, 0.866, 1.2}, {-1, 0, 1.2}, {-0.5, -0.866, 1.2}, {0.5, -0.866, 1.2}});
  d.line({0, 0, 0}, {0, 0, 1.2});
  d.height({0, 0, 0}, {0, 0, 1.2}, -1.15, "h");
  d.dimension({0, 0, 1.2}, {0, -0.866, 1.2}, "a");
  d.dimension({0, 0, 0}, {0.34, 0.2, 0}, "r");
  d.label({0.55, 0.9, 1.2}, "n = 6");
  return d;
}

Drawing sphere_in_cylinder() {
  Drawing d;
  d.ball(Surface::from, {0, 0, 0}, 0.4);
  d.frustum(Surface::to, {0, 0, -0.8}, 0.9, {0, 0, 0.8}, 0.9);
  d.height({0, 0, 0}, {0, 0, 0.8}, 1.1, "h");
  d.height({0, 0, -0.8}, {0, 0, 0}, 1.1, "h");
  d.dimension({0, 0, 0.8}, {0.9, 0, 0.8}, "r1");
  d.dimension({0, 0, 0}, {-0.34, -0.2, 0}, "r");
  return d;
}

Drawing nested_spheres(Surface outer, Surface inner) {
  Drawing d;
  d.ball(outer, {0, 0, 0}, 1);
  d.ball(inner, {0, 0, 0}, 0.45);
  d.dimension({0, 0, 0}, {0.38, 0.24, 0}, "r1");
  d.dimension({0, 0, 0}, {-0.85, -0.53, 0}, "r2");
  return d;
}

Drawing zones() {
  Drawing d;
  d.ball(Surface::other, {0, 0, 0}, 1);
  d.zone(Surface::from, {0, 0, 0}, 1, 0.35, 0.75);
  d.zone(Surface::to, {0, 0, 0}, 1, -0.75, -0.25);
  d.height({0, 0, -0.75}, {0, 0, -0.25}, 1.15, "h");
  d.dimension({0, 0, 0}, {0.85, 0.53, 0}, "r");
  return d;
}

Drawing cap() {
  Drawing d;
  d.zone(Surface::from, {0, 0, 0}, 1, -1, -0.3);
  d.disc(Surface::to, {0, 0, -0.3}, {0, 0, 1}, 0.954);
  d.line({0, 0, 0}, {0, 0, -1});
  d.dimension({0, 0, 0}, {0.954, 0, -0.3}, "r");
  d.height({0, 0, -1}, {0, 0, -0.3}, 1.2, "h");
  return d;
}

Drawing two_spheres() {
  Drawing d;
  d.ball(Surface::from, {0, 0, 0}, 0.6);
  d.ball(Surface::to, {1.9, 0, 0}, 0.8);
  d.line({0, 0, 0}, {1.9, 0, 0});
  d.dimension({0.6, 0, 0}, {1.1, 0, 0}, "s");
  d.dimension({0, 0, 0}, {0, 0, 0.6}, "r1");
  d.dimension({1.9, 0, 0}, {1.9, 0, 0.8}, "r2");
  return d;
}

Drawing sphere_and_cone() {
  Drawing d;
  d.ball(Surface::from, {0, 0, 1.5}, 0.4);
  d.frustum(Surface::to, {0, 0, 0}, 0.9, {0, 0, 0.8}, 0);
  d.line({0, 0, 0.8}, {0, 0, 1.1});
  d.line({0, 0, 0}, {0, 0, 0.8});
  d.angle({0, 0, 0.8}, {0, 0, -1}, {0.9, 0, -0.8}, 0.35, "omega");
  d.dimension({0, 0, 0.8}, {0, 0, 1.1}, "s");
  d.dimension({0, 0, 1.5}, {0.34, 0.2, 1.5}, "r1");
  d.dimension({0, 0, 0}, {0.9, 0, 0}, "r2");
  return d;
}

bool clears(double distance, double radius) {
  return distance >= radius;
}

}  // namespace

std::vector<Entry> spheres() {
  return {
      {.id = "sphere-rectangle",
       .number = "C-122",
       .title = "Sphere to rectangle, a corner of it over the centre",
       .parameters = {length("d", "distance of the centre from the rectangle's plane"), length("a", "side"),
                      length("b", "other side"), length("r", "radius of the sphere")},
       .conditions = {{"r <= d, the sphere in front of the plane", "r",
                       [](std::span<const double> p) { return clears(p[0], p[3]); }}},
       .widest_ratio = 1e6,
       .formula = "D1 = d/a, D2 = d/b: F = (1/4π) atan(1/√(D1²+D2²+D1²D2²)); independent of r",
       .source = "solid angle of the rectangle, as a sphere sees every direction alike",
       .care = "taken as atan(ab/(d√(d²+a²+b²))): nothing cancels",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted far = sqrt(square(p[0]) + square(p[1]) + square(p[2]));
             return atan(p[1] * p[2] / (p[0] * far)) / (4 * pi());
           },
       .area_from = [](Values p) { return sphere_area(p[3]); },
       .area_to = [](Values p) { return p[1] * p[2]; },
       .picture = sphere_and_rectangle},
      {.id = "sphere-disc",
       .number = "C-123",
       .title = "Sphere to coaxial disc",
       .parameters = {length("r", "radius of the sphere"), length("r1", "radius of the disc"),
                      length("h", "distance of the centre from the disc")},
       .conditions = {{"r <= h, the sphere in front of the disc's plane", "r",
                       [](std::span<const double> p) { return clears(p[2], p[0]); }}},
       .widest_ratio = 1e6,
       .formula = "R = r1/h: F = ½ [1 − 1/√(1+R²)]; independent of r",
       .source = "solid angle of the disc",
       .care = "a small disc: the difference is taken as r1²/(2g(g+h)), g = √(r1²+h²)",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return cap_share(p[1], p[2]); },
       .area_from = [](Values p) { return sphere_area(p[0]); },
       .area_to = [](Values p) { return pi() * square(p[1]); },
       .picture = [] { return sphere_and_disc(0); }},
      {.id = "sphere-annulus",
       .number = "",
       .title = "Sphere to coaxial annulus",
       .parameters = {length("r", "radius of the sphere"), length("r1", "inner radius of the annulus"),
                      length("r2", "outer radius"), length("h", "distance of the centre from the annulus")},
       .conditions = {{"r2 >= 1.001 r1", "r2", [](std::span<const double> p) { return p[2] >= 1.001 * p[1]; }},
                      {"r <= h, the sphere in front of the annulus's plane", "r",
                       [](std::span<const double> p) { return clears(p[3], p[0]); }}},
       .widest_ratio = 1e6,
       .formula = "F = ½ [h/√(h²+r1²) − h/√(h²+r2²)]",
       .source = "difference of two discs",
       .care = "taken as h (r2²−r1²)/(2 g1 g2 (g1+g2)), g = √(h²+r²): nothing cancels",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted g1 = hypot(p[3], p[1]), g2 = hypot(p[3], p[2]);
             return p[3] * (p[2] - p[1]) * (p[2] + p[1]) / (2 * g1 * g2 * (g1 + g2));
           },
       .area_from = [](Values p) { return sphere_area(p[0]); },
       .area_to = [](Values p) { return pi() * (p[2] - p[1]) * (p[2] + p[1]); },
       .picture = [] { return sphere_and_disc(0.45); }},
      {.id = "sphere-regular-polygon",
       .number = "",
       .title = "Sphere to coaxial regular polygon",
       .parameters = {count("n", "number of sides", 3, 1000), length("a", "radius of the inscribed circle"),
                      length("h", "distance of the centre from the polygon"), length("r", "radius of the sphere")},
       .conditions = {{"r <= h, the sphere in front of the polygon's plane", "r",
                       [](std::span<const double> p) { return clears(p[2], p[3]); }}},
       .widest_ratio = 1e6,
       .formula = "t = tan(π/n), g = √(h²+a²(1+t²)): F = (n/2π) [π/n − atan(t h/g)]",
       .source = "solid angle of 2n right triangles",
       .care = "the two arcs are taken as one of t(1 − h/g), and that as a quotient",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted t = tan_pi_over(static_cast<int>(exact(p[0]))), m2 = square(p[1]) * (1 + square(t));
             const Counted g = sqrt(square(p[2]) + m2), below = m2 / (g * (g + p[2]));
             return p[0] / (2 * pi()) * atan2(t * below, 1 + square(t) * p[2] / g);
           },
       .area_from = [](Values p) { return sphere_area(p[3]); },
       .area_to = [](Values p) { return p[0] * square(p[1]) * tan_pi_over(static_cast<int>(exact(p[0]))); },
       .picture = sphere_and_hexagon},
      {.id = "sphere-cylinder",
       .number = "",
       .title = "Sphere to a coaxial cylinder around it, centred",
       .parameters = {length("r", "radius of the sphere"), length("r1", "radius of the cylinder"),
                      length("h", "half of its height")},
       .conditions = {{"r <= r1, the sphere inside", "r",
                       [](std::span<const double> p) { return clears(p[1], p[0]); }}},
       .widest_ratio = 1e6,
       .formula = "F = 1/√(1+(r1/h)²)",
       .source = "solid angle of the cylinder",
       .care = "one quotient: nothing cancels",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return p[2] / hypot(p[1], p[2]); },
       .area_from = [](Values p) { return sphere_area(p[0]); },
       .area_to = [](Values p) { return 4 * pi() * p[1] * p[2]; },
       .picture = sphere_in_cylinder},
      {.id = "sphere-cone",
       .number = "",
       .title = "Sphere to the outside of a coaxial cone, its apex towards the sphere",
       .parameters = {length("r1", "radius of the sphere"), length("s", "distance of the apex from the sphere"),
                      length("r2", "radius of the cone's base"), angle("omega", "half of the cone's angle", 1, 89)},
       .conditions = {{"omega with sin(omega) >= r1/(r1+s): the whole cone sees all of the sphere", "omega",
                       [](std::span<const double> p) {
                         const Counted margin = sin_deg(p[3]) * (Counted(p[0]) + p[1]) - p[0];
                         return margin.value.high >= -margin.error;
                       }}},
       .widest_ratio = 1e6,
       .formula = "q = r1 + s + r2 cot ω: F = ½ [1 − q/√(q²+r2²)]",
       .source = "solid angle of the cone, which is that of its base",
       .care = "the difference is taken as a quotient, as for sphere-disc",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const double omega = exact(p[3]);
             return cap_share(p[2], p[0] + p[1] + p[2] * cos_deg(omega) / sin_deg(omega));
           },
       .area_from = [](Values p) { return sphere_area(p[0]); },
       .area_to = [](Values p) { return pi() * square(p[2]) / sin_deg(exact(p[3])); },
       .picture = sphere_and_cone},
      {.id = "sphere-sphere",
       .number = "",
       .title = "Sphere to sphere beside it",
       .parameters = {length("r1", "radius of the first"), length("r2", "radius of the second"),
                      length("s", "gap between them")},
       .conditions = {},
       .widest_ratio = 1e2,
       .formula =
           "F = ½ ∫ f(θ) sin θ dθ over the first sphere, f the factor of element-sphere-cut; the part that sees all of "
           "the second in closed form",
       .source = "mean of element-sphere-cut",
       .care = "the rest by Gauss rules in ψ, h = r2 cos ψ, where the integrand is analytic",
       .accuracy = Accuracy::measured,
       .factor = sphere_to_sphere,
       .area_from = [](Values p) { return sphere_area(p[0]); },
       .area_to = [](Values p) { return sphere_area(p[1]); },
       .picture = two_spheres},
      {.id = "sphere-in-sphere",
       .number = "C-135",
       .title = "Outer of two spheres, one inside the other, to the inner",
       .parameters = {length("r1", "radius of the inner"), length("r2", "radius of the outer")},
       .conditions = {{"r1 < r2", "r1", [](std::span<const double> p) { return p[0] < p[1]; }}},
       .widest_ratio = 1e6,
       .formula = "F = (r1/r2)²; they need not be concentric",
       .source = "reciprocity: all that leaves the inner arrives at the outer",
       .care = "one quotient: nothing cancels",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return square(p[0] / p[1]); },
       .area_from = [](Values p) { return sphere_area(p[1]); },
       .area_to = [](Values p) { return sphere_area(p[0]); },
       .picture = [] { return nested_spheres(Surface::from, Surface::to); }},
      {.id = "sphere-in-sphere-self",
       .number = "C-135",
       .title = "Outer of two spheres, one inside the other, to itself",
       .parameters = {length("r1", "radius of the inner"), length("r2", "radius of the outer")},
       .conditions = {{"r1 < r2", "r1", [](std::span<const double> p) { return p[0] < p[1]; }}},
       .widest_ratio = 1e6,
       .formula = "F = 1 − (r1/r2)²",
       .source = "closure",
       .care = "taken as (r2−r1)(r2+r1)/r2²",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return (p[1] - p[0]) * (p[1] + p[0]) / square(p[1]); },
       .area_from = [](Values p) { return sphere_area(p[1]); },
       .area_to = [](Values p) { return sphere_area(p[1]); },
       .picture = [] { return nested_spheres(Surface::from, Surface::other); }},
      {.id = "sphere-zones",
       .number = "",
       .title = "Any part of a sphere's inside to a zone of it",
       .parameters = {length("r", "radius"), length("h", "height of the zone")},
       .conditions = {{"h <= 2 r", "h", [](std::span<const double> p) { return p[1] <= 2 * p[0]; }}},
       .widest_ratio = 1e6,
       .formula = "F = A2/4πr² = h/2r, whatever the first part is, the zone itself included",
       .source = "the kernel is constant on a sphere",
       .care = "one quotient: nothing cancels",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return p[1] / (2 * p[0]); },
       .area_from = nullptr,
       .area_to = [](Values p) { return 2 * pi() * p[0] * p[1]; },
       .picture = zones},
      {.id = "cap-base",
       .number = "",
       .title = "Inside of a spherical cap to its base disc; the hemisphere with h = r",
       .parameters = {length("r", "radius of the sphere"), length("h", "height of the cap")},
       .conditions = {{"h < 2 r", "h", [](std::span<const double> p) { return p[1] < 2 * p[0]; }}},
       .widest_ratio = 1e6,
       .formula = "F = 1 − h/2r",
       .source = "closure with sphere-zones; the ratio of the areas of disc and cap",
       .care = "taken as (2r−h)/2r",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return (2 * p[0] - p[1]) / (2 * p[0]); },
       .area_from = [](Values p) { return 2 * pi() * p[0] * p[1]; },
       .area_to = [](Values p) { return pi() * p[1] * (2 * p[0] - p[1]); },
       .picture = cap},
  };
}

}  // namespace etendue::catalogue
