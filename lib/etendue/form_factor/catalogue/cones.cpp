// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/catalogue/coaxial_discs.hpp"
#include "etendue/form_factor/catalogue/families.hpp"

namespace etendue::catalogue {

namespace {

/// Howell's C-48. A program that cites it writes S² atan(D²/S); disc_cone_errata in the tests shows that one fail.
Counted disc_to_cone(Values p) {
  const Counted rd = p[0], rc = p[1], l = p[2], h = p[3];
  const Counted above = rd * h - l * rc;  // positive where the disc's edge lies outside the cone continued upwards
  if (!(above.value.high > 0)) return disc_to_disc(rd, rc, l + h);
  const Counted slant = hypot(rc, h), sine = rc / slant, cosine = h / slant;
  const Counted s = l / rd, r = rc / rd, x = (l + h) / rd, e = (h - l) / rd;
  const Counted c = sqrt(cosine + s * sine), d = sqrt(above / (rd * slant)), cd = c * d;
  const Counted ab_a = hypot(x, 1 + r), ab_b = hypot(x, 1 - r);
  const Counted disc_part = (1 + square(s)) * atan2(c, d) - ab_a * ab_b * atan2(ab_a * c, ab_b * d);
  const Counted cone_part =
      sine / square(cosine) *
      (x * e * atan2(cd, x) + square(s) * atan2(cd, s) + square(cd) * (atan2(x, cd) - atan2(s, cd)));
  const Counted arc = atan2(cd, -(s * sine));
  const Counted side = (r * (x + s) / (2 * sine * cosine) - s * r * sine / cosine) * arc;
  return (disc_part + cone_part + side) / pi();
}

Counted slant_area(const Counted& r1, const Counted& r2, const Counted& h) {
  return pi() * (r1 + r2) * hypot(h, r2 - r1);
}

Drawing cone(Surface wall, Surface base) {
  Drawing d;
  d.disc(base, {0, 0, 0}, {0, 0, 1}, 0.9);
  d.frustum(wall, {0, 0, 0}, 0.9, {0, 0, 1.4}, 0);
  d.line({0, 0, 0}, {0, 0, 1.4});
  d.height({0, 0, 0}, {0, 0, 1.4}, 1.1, "h");
  d.dimension({0, 0, 0}, {0.9, 0, 0}, "r");
  return d;
}

Drawing frustum(Surface wall, Surface base) {
  Drawing d;
  d.disc(base, {0, 0, 0}, {0, 0, 1}, 0.9);
  d.frustum(wall, {0, 0, 0}, 0.9, {0, 0, 1.1}, 0.5);
  d.height({0, 0, 0}, {0, 0, 1.1}, 1.1, "h");
  d.dimension({0, 0, 0}, {0.9, 0, 0}, "r1");
  d.dimension({0, 0, 1.1}, {0.5, 0, 1.1}, "r2");
  return d;
}

Drawing disc_and_cone() {
  Drawing d;
  d.disc(Surface::from, {0, 0, 1.4}, {0, 0, 1}, 1);
  d.frustum(Surface::to, {0, 0, 0}, 0.6, {0, 0, 0.9}, 0);
  d.line({0, 0, 0.9}, {0, 0, 1.4});
  d.dimension({0, 0, 1.4}, {1, 0, 1.4}, "r1");
  d.dimension({0, 0, 0}, {0.6, 0, 0}, "r2");
  d.height({0, 0, 0.9}, {0, 0, 1.4}, 1.2, "l");
  d.height({0, 0, 0}, {0, 0, 0.9}, 1.2, "h");
  return d;
}

}  // namespace

std::vector<Entry> cones() {
  return {
      {.id = "C-48",
       .number = "C-48",
       .title = "Disc to the outside of a coaxial cone, its apex towards the disc",
       .parameters = {length("r1", "radius of the disc"), length("r2", "radius of the cone's base"),
                      length("l", "distance of the apex from the disc"), length("h", "height of the cone")},
       .conditions = {},
       .widest_ratio = 1e3,
       .formula =
           "tan α = r2/h, S = l/r1, R = r2/r1, X = (l+h)/r1, A,B = √(X²+(1±R)²), C,D = √(cos α ± S sin α), E = "
           "(h−l)/r1: "
           "S tan α < 1: F = (1/π) {−AB atan(AC/BD) + (1+S²) atan(C/D) + (sin α/cos²α) [XE atan(CD/X) + S² atan(CD/S) "
           "+ "
           "(CD)² (atan(X/CD) − atan(S/CD))] + (R(X+S)/sin 2α − SR tan α) acos(−S tan α)}; else C-41(r1, r2, l+h)",
       .source = "Howell, catalogue of configuration factors, C-48",
       .care = "a far or small cone cancels to R²/X²; D is taken from r1 h − l r2; counted",
       .accuracy = Accuracy::proved,
       .factor = disc_to_cone,
       .area_from = [](Values p) { return pi() * square(p[0]); },
       .area_to = [](Values p) { return slant_area(0, p[1], p[3]); },
       .picture = disc_and_cone},
      {.id = "cone-base",
       .number = "",
       .title = "Inside of a cone to its base",
       .parameters = {length("r", "radius of the base"), length("h", "height")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "F = r/√(r²+h²), the sine of half the cone's angle",
       .source = "reciprocity: the base sees only the cone",
       .care = "one quotient: nothing cancels",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return p[0] / hypot(p[0], p[1]); },
       .area_from = [](Values p) { return slant_area(0, p[0], p[1]); },
       .area_to = [](Values p) { return pi() * square(p[0]); },
       .picture = [] { return cone(Surface::from, Surface::to); }},
      {.id = "cone-self",
       .number = "",
       .title = "Inside of a cone to itself",
       .parameters = {length("r", "radius of the base"), length("h", "height")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "g = √(r²+h²): F = 1 − r/g = h²/(g(g+r))",
       .source = "closure with cone-base",
       .care = "a flat cone: the difference is taken as the quotient",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted g = hypot(p[0], p[1]);
             return square(p[1]) / (g * (g + p[0]));
           },
       .area_from = [](Values p) { return slant_area(0, p[0], p[1]); },
       .area_to = [](Values p) { return slant_area(0, p[0], p[1]); },
       .picture = [] { return cone(Surface::from, Surface::other); }},
      {.id = "frustum-base-wall",
       .number = "",
       .title = "Base of a truncated cone to the inside of its wall",
       .parameters = {length("r1", "radius of the base"), length("r2", "radius of the top"), length("h", "height")},
       .conditions = {},
       .widest_ratio = 1e4,
       .formula = "F = 1 − C-41(r1, r2, h)",
       .source = "closure",
       .care = "a low one with equal radii leaves a difference of order h/r; counted",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return 1 - disc_to_disc(p[0], p[1], p[2]); },
       .area_from = [](Values p) { return pi() * square(p[0]); },
       .area_to = [](Values p) { return slant_area(p[0], p[1], p[2]); },
       .picture = [] { return frustum(Surface::to, Surface::from); }},
      {.id = "frustum-self",
       .number = "",
       .title = "Inside wall of a truncated cone to itself",
       .parameters = {length("r1", "radius of the base"), length("r2", "radius of the top"), length("h", "height")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "F = 1 − √((r1+r2)²+h²)/(r1+r2) + h²/((r1+r2)√((r1−r2)²+h²))",
       .source = "closure with C-41, whose root is g√((r1+r2)²+h²), g the slant",
       .care = "a flat one leaves a difference of order h²; counted",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Counted sum = p[0] + p[1], h2 = square(p[2]), across = hypot(sum, p[2]);
             return h2 / (sum * hypot(p[0] - p[1], p[2])) - h2 / (sum * (across + sum));
           },
       .area_from = [](Values p) { return slant_area(p[0], p[1], p[2]); },
       .area_to = [](Values p) { return slant_area(p[0], p[1], p[2]); },
       .picture = [] { return frustum(Surface::from, Surface::other); }},
  };
}

}  // namespace etendue::catalogue
