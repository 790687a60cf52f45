// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/catalogue/families.hpp"

namespace etendue::catalogue {

namespace {

// Parameters of all: r1 the inner radius, r2 the outer, h the height of both. The published arcs are arc cosines and
// arc sines of quotients near ±1; as arcs of two legs they keep their digits. With q = r2² − r1²:
//     acos((h²−q)/(h²+q)) = atan2(2h√q, h²−q),  acos((h²−q) r1/((h²+q) r2)) = atan2(√q root, (h²−q) r1)
// where root = √((h²+(r2−r1)²)(h²+(r2+r1)²)).
struct Annulus {
  Counted r1, r2, h, q, root_q, root;
};

Annulus annulus(Values p) {
  const Counted q = (p[1] - p[0]) * (p[1] + p[0]);
  return {p[0], p[1], p[2], q, sqrt(q), hypot(p[2], p[1] - p[0]) * hypot(p[2], p[1] + p[0])};
}

/// Howell's C-77: from the outside of the inner cylinder to one annular end.
Counted inner_to_end(const Annulus& s) {
  const Counted h2 = square(s.h), a = h2 - s.q, b = h2 + s.q;
  const Counted first = atan2(2 * s.h * s.root_q, a), second = atan2(s.root_q * s.root, a * s.r1);
  const Counted third = atan2(s.r1, s.root_q);
  return b / (8 * s.r1 * s.h) +
         (first - s.root / (2 * s.h * s.r1) * second - a / (2 * s.r1 * s.h) * third) / (2 * pi());
}

/// From the inside of the outer cylinder to the inner one.
Counted outer_to_inner(const Annulus& s) {
  const Counted h2 = square(s.h), a = h2 + s.q, b = h2 - s.q;
  const Counted first = atan2(2 * s.h * s.root_q, b), second = atan2(s.root_q * s.root, b * s.r1);
  const Counted third = atan2(s.r1, s.root_q);
  const Counted half_pi_a = pi() * a / 2;
  return s.r1 / s.r2 * (1 - (first - (s.root * second + b * third - half_pi_a) / (2 * s.h * s.r1)) / pi());
}

/// From the inside of the outer cylinder to itself; with S = √(h²+4r2²) the published arc sines are twice these arcs.
Counted outer_to_itself(const Annulus& s) {
  const Counted sum = hypot(s.h, 2 * s.r2);
  const Counted through = sum * atan(s.root_q * sum / (s.h * s.r1)) - s.h * atan(s.root_q / s.r1);
  return (s.r2 - s.r1) / s.r2 + (2 * s.r1 * atan(2 * s.root_q / s.h) - through) / (pi() * s.r2);
}

/// From the inside of the outer cylinder to one annular end.
Counted outer_to_end(const Annulus& s) {
  const Counted a = square(s.h) - s.q, sum = hypot(s.h, 2 * s.r2), arc = atan2(s.root_q, s.r1);
  const Counted middle = s.r1 * (atan(s.root_q / s.h) - atan(2 * s.root_q / s.h)) - s.h / 4 * arc;
  const Counted ends = (s.q * (pi() - arc) - s.root * atan2(s.root_q * s.root, a * s.r1)) / (4 * s.h);
  return (middle + ends + sum / 2 * atan(s.root_q * sum / (s.r1 * s.h))) / (pi() * s.r2);
}

Counted outer_area(Values p) {
  return 2 * pi() * p[1] * p[2];
}
Counted inner_area(Values p) {
  return 2 * pi() * p[0] * p[2];
}
Counted end_area(Values p) {
  return pi() * (p[1] - p[0]) * (p[1] + p[0]);
}

Drawing nested(Surface inner, Surface outer, Surface bottom, Surface top) {
  Drawing d;
  d.disc(bottom, {0, 0, 0}, {0, 0, 1}, 0.95, 0.45);
  d.frustum(inner, {0, 0, 0}, 0.45, {0, 0, 1.2}, 0.45);
  d.frustum(outer, {0, 0, 0}, 0.95, {0, 0, 1.2}, 0.95);
  if (top != Surface::other) d.disc(top, {0, 0, 1.2}, {0, 0, 1}, 0.95, 0.45);
  d.dimension({0, 0, 1.2}, {0.45, 0, 1.2}, "r1");
  d.dimension({0, 0, 1.2}, {0.57, -0.76, 1.2}, "r2");
  d.height({0, 0, 0}, {0, 0, 1.2}, 1.2, "h");
  return d;
}

std::vector<Parameter> sizes() {
  return {length("r1", "radius of the inner cylinder"), length("r2", "radius of the outer cylinder"),
          length("h", "height of both")};
}

std::vector<Condition> apart() {
  return {{"r2 >= 1.001 r1", "r2", [](std::span<const double> p) { return p[1] >= 1.001 * p[0]; }}};
}

constexpr double kWidest = 1e3;
constexpr const char* kCare =
    "arcs of quotients near ±1 are taken as arcs of two legs; long and short cylinders cancel like (h/r)² and (r/h)²; "
    "counted";

}  // namespace

std::vector<Entry> concentric_cylinders() {
  return {
      {.id = "C-77",
       .number = "C-77",
       .title = "Outside of a cylinder to the annular end between it and a coaxial one",
       .parameters = sizes(),
       .conditions = apart(),
       .widest_ratio = kWidest,
       .formula = "R = r1/r2, L = h/r2, A = L²+R²−1, B = L²−R²+1: F = B/8RL + (1/2π) {acos(A/B) − (1/2L)√((A+2)²/R²−4) "
                  "acos(AR/B) − (A/2RL) asin R}",
       .source = "Howell, catalogue of configuration factors, C-77",
       .care = kCare,
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return inner_to_end(annulus(p)); },
       .area_from = inner_area,
       .area_to = end_area,
       .picture = [] { return nested(Surface::from, Surface::other, Surface::to, Surface::other); }},
      {.id = "outer-inner-cylinder",
       .number = "C-91",
       .title = "Inside of a cylinder to the outside of a coaxial one in it",
       .parameters = sizes(),
       .conditions = apart(),
       .widest_ratio = kWidest,
       .formula =
           "R = r2/r1, H = h/r1, A = H²+R²−1, B = H²−R²+1: F = (1/R) {1 − (1/π) [acos(B/A) − (1/2H) (√((A+2)²−4R²) "
           "acos(B/RA) + B asin(1/R) − πA/2)]}",
       .source = "derived here: the mean of strip-cylinder over the height; checked against the integral",
       .care = kCare,
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return outer_to_inner(annulus(p)); },
       .area_from = outer_area,
       .area_to = inner_area,
       .picture = [] { return nested(Surface::to, Surface::from, Surface::other, Surface::other); }},
      {.id = "outer-cylinder-self",
       .number = "C-92",
       .title = "Inside of a cylinder to itself, past a coaxial one in it",
       .parameters = sizes(),
       .conditions = apart(),
       .widest_ratio = kWidest,
       .formula =
           "R = r2/r1, H = h/r1, S = √(H²+4R²), q = R²−1: F = 1 − 1/R + (2/πR) atan(2√q/H) − (1/πR) [S atan(S√q/H) − H "
           "atan √q]",
       .source = "no paper is cited: checked against the integral. H by r1: a widely copied program that divides by r2 "
                 "gives 0.08 "
                 "instead of 0.13",
       .care = kCare,
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return outer_to_itself(annulus(p)); },
       .area_from = outer_area,
       .area_to = outer_area,
       .picture = [] { return nested(Surface::other, Surface::from, Surface::other, Surface::other); }},
      {.id = "outer-cylinder-end",
       .number = "C-93",
       .title = "Inside of a cylinder to the annular end between it and a coaxial one in it",
       .parameters = sizes(),
       .conditions = apart(),
       .widest_ratio = kWidest,
       .formula =
           "R = r1/r2, H = h/r2, X = √(1−R²), Y = R(1−R²−H²)/(1−R²+H²): F = (1/π) {R [atan(X/H) − atan(2X/H)] − (H/4) "
           "acos R + (X²/4H)(π/2 + asin R) − (1/4H)√((1+R²+H²)²−4R²)(π/2 + asin Y) + ½√(4+H²) atan(X√(4+H²)/RH)}",
       .source = "no paper is cited: half of what outer-inner-cylinder and outer-cylinder-self leave of one, as "
                 "closure has it; "
                 "checked against the integral",
       .care = kCare,
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return outer_to_end(annulus(p)); },
       .area_from = outer_area,
       .area_to = end_area,
       .picture = [] { return nested(Surface::other, Surface::from, Surface::to, Surface::other); }},
      {.id = "annular-ends",
       .number = "",
       .title = "Annular end between coaxial cylinders to the opposite end",
       .parameters = sizes(),
       .conditions = apart(),
       .widest_ratio = 1e2,
       .formula = "F = 1 − (2h/(r2²−r1²)) [r1 C-77 + r2 outer-cylinder-end]",
       .source = "closure and reciprocity; the inner cylinder hides part of C-52",
       .care = "long cylinders leave a difference; counted",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values p) {
             const Annulus s = annulus(p);
             return 1 - 2 * s.h / s.q * (s.r1 * inner_to_end(s) + s.r2 * outer_to_end(s));
           },
       .area_from = end_area,
       .area_to = end_area,
       .picture = [] { return nested(Surface::other, Surface::other, Surface::from, Surface::to); }},
  };
}

}  // namespace etendue::catalogue
