// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/catalogue/families.hpp"
#include "etendue/form_factor/rectangles.hpp"

namespace etendue::catalogue {

namespace {

Counted counted(const Bounded& f) {
  return {DoubleDouble(f.value), f.bound};
}

/// From the floor (a × b) of a box to its four walls of height c.
Counted floor_to_walls(const Counted& a, const Counted& b, const Counted& c) {
  const double x = exact(a), y = exact(b), z = exact(c);
  return 2 * (counted(perpendicular_rectangles(x, z, y)) + counted(perpendicular_rectangles(y, z, x)));
}

/// From the four walls to themselves: each to the opposite one and to its two neighbours.
Counted walls_to_walls(const Counted& a, const Counted& b, const Counted& c) {
  const double x = exact(a), y = exact(b), z = exact(c);
  const Counted from_a = counted(parallel_rectangles(x, z, y)) + 2 * counted(perpendicular_rectangles(x, y, z));
  const Counted from_b = counted(parallel_rectangles(y, z, x)) + 2 * counted(perpendicular_rectangles(y, x, z));
  return (a * from_a + b * from_b) / (a + b);
}

Counted square_side(Values p) {
  return square(p[0]);
}

Drawing box(bool walls) {
  Drawing d;
  const Vec3 x(1.4, 0, 0), y(0, 1, 0), z(0, 0, 0.9);
  if (walls) {
    d.rectangle(Surface::from, {0, 0, 0}, x, y);
    d.rectangle(Surface::to, y, x, z);
    d.rectangle(Surface::to, {0, 0, 0}, y, z);
    d.rectangle(Surface::to, x, y, z);
    d.rectangle(Surface::to, {0, 0, 0}, x, z);
  } else {
    d.rectangle(Surface::other, {0, 0, 0}, x, y);
    d.rectangle(Surface::other, z, x, y);
    d.rectangle(Surface::from, y, x, z);
    d.rectangle(Surface::from, {0, 0, 0}, y, z);
    d.rectangle(Surface::from, x, y, z);
    d.rectangle(Surface::from, {0, 0, 0}, x, z);
  }
  d.dimension({0, -0.12, 0}, {1.4, -0.12, 0}, "a");
  d.dimension({1.52, 0, 0}, {1.52, 1, 0}, "b");
  d.height({0, 0, 0}, {0, 0, 0.9}, -0.12, "c");
  return d;
}

Drawing cube(bool opposite) {
  Drawing d;
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  d.rectangle(Surface::other, y, x, z);
  d.rectangle(Surface::from, {0, 0, 0}, x, y);
  d.rectangle(Surface::to, opposite ? z : Vec3(0, 0, 0), opposite ? x : y, opposite ? y : z);
  d.rectangle(Surface::other, {0, 0, 0}, x, z);
  d.rectangle(Surface::other, x, y, z);
  d.dimension({0, -0.12, 0}, {1, -0.12, 0}, "a");
  return d;
}

Drawing corner_tetrahedron(bool oblique) {
  Drawing d;
  const Vec3 o(0, 0, 0), x(1.2, 0, 0), y(0, 1.2, 0), z(0, 0, 1.2);
  d.polygon(Surface::from, {o, x, y});
  d.polygon(oblique ? Surface::to : Surface::other, {x, y, z});
  d.polygon(oblique ? Surface::other : Surface::to, {o, y, z});
  d.dimension(o, x, "a");
  d.dimension(o, z, "a");
  d.line(o, y);
  return d;
}

Drawing tetrahedron() {
  Drawing d;
  const Vec3 a(0, 0, 0), b(1.3, 0, 0), c(0.65, 1.126, 0), e(0.65, 0.375, 1.061);
  d.polygon(Surface::from, {a, b, c});
  d.polygon(Surface::to, {b, c, e});
  d.polygon(Surface::other, {a, b, e});
  d.dimension({0, -0.12, 0}, {1.3, -0.12, 0}, "a");
  return d;
}

}  // namespace

std::vector<Entry> boxes_and_tetrahedra() {
  return {
      {.id = "box-floor-walls",
       .number = "",
       .title = "Floor of a box to its four walls",
       .parameters = {length("a", "side of the floor"), length("b", "other side"), length("c", "height")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "F = 2 [C-14(a, c, b) + C-14(b, c, a)] = 1 − C-11(a, b, c)",
       .source = "configuration algebra",
       .care = "low walls: 1 − C-11 cancels, the sum of the walls does not",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return floor_to_walls(p[0], p[1], p[2]); },
       .area_from = [](Values p) { return p[0] * p[1]; },
       .area_to = [](Values p) { return 2 * (p[0] + p[1]) * p[2]; },
       .picture = [] { return box(true); }},
      {.id = "box-walls-self",
       .number = "",
       .title = "Four walls of a box to themselves: the rectangular channel",
       .parameters = {length("a", "side of the floor"), length("b", "other side"), length("c", "height")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "F = [a (C-11(a, c, b) + 2 C-14(a, b, c)) + b (C-11(b, c, a) + 2 C-14(b, a, c))]/(a + b)",
       .source = "configuration algebra; the mean over the walls",
       .care = "the closure 1 − (ab/((a+b)c)) box-floor-walls cancels for low walls, this sum does not",
       .accuracy = Accuracy::proved,
       .factor = [](Values p) { return walls_to_walls(p[0], p[1], p[2]); },
       .area_from = [](Values p) { return 2 * (p[0] + p[1]) * p[2]; },
       .area_to = [](Values p) { return 2 * (p[0] + p[1]) * p[2]; },
       .picture = [] { return box(false); }},
      {.id = "cube-opposite",
       .number = "",
       .title = "Cube: face to the opposite face",
       .parameters = {length("a", "edge")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "F = (2/π) {½ ln(4/3) + 2√2 atan(1/√2) − π/2} = 0.199825",
       .source = "C-11 with a = b = c",
       .care = "a constant",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values) {
             const Counted root = sqrt(Counted(2));
             return 2 / pi() * (log(Counted(4) / 3) / 2 + 2 * root * atan(1 / root) - pi() / 2);
           },
       .area_from = square_side,
       .area_to = square_side,
       .picture = [] { return cube(true); }},
      {.id = "cube-adjacent",
       .number = "",
       .title = "Cube: face to a neighbouring face",
       .parameters = {length("a", "edge")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "F = (1/π) {π/2 − √2 atan(1/√2) + ¼ ln(3/4)} = 0.200044",
       .source = "C-14 with w = h = l",
       .care = "a constant",
       .accuracy = Accuracy::proved,
       .factor =
           [](Values) {
             const Counted root = sqrt(Counted(2));
             return (pi() / 2 - root * atan(1 / root) + log(Counted(3) / 4) / 4) / pi();
           },
       .area_from = square_side,
       .area_to = square_side,
       .picture = [] { return cube(false); }},
      {.id = "corner-tetrahedron-legs",
       .number = "",
       .title = "Corner cut off a cube: right-angled face to right-angled face",
       .parameters = {length("a", "edge at the corner")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "F = (3 − √3)/6",
       .source = "symmetry, reciprocity and closure of the four faces",
       .care = "a constant",
       .accuracy = Accuracy::proved,
       .factor = [](Values) { return (3 - sqrt(Counted(3))) / 6; },
       .area_from = [](Values p) { return square(p[0]) / 2; },
       .area_to = [](Values p) { return square(p[0]) / 2; },
       .picture = [] { return corner_tetrahedron(false); }},
      {.id = "corner-tetrahedron-oblique",
       .number = "",
       .title = "Corner cut off a cube: right-angled face to the oblique face",
       .parameters = {length("a", "edge at the corner")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "F = 1/√3",
       .source = "symmetry, reciprocity and closure of the four faces",
       .care = "a constant",
       .accuracy = Accuracy::proved,
       .factor = [](Values) { return 1 / sqrt(Counted(3)); },
       .area_from = [](Values p) { return square(p[0]) / 2; },
       .area_to = [](Values p) { return sqrt(Counted(3)) / 2 * square(p[0]); },
       .picture = [] { return corner_tetrahedron(true); }},
      {.id = "tetrahedron",
       .number = "",
       .title = "Regular tetrahedron: face to face",
       .parameters = {length("a", "edge")},
       .conditions = {},
       .widest_ratio = 1e6,
       .formula = "F = 1/3",
       .source = "symmetry and closure",
       .care = "a constant",
       .accuracy = Accuracy::proved,
       .factor = [](Values) { return Counted(1) / 3; },
       .area_from = [](Values p) { return sqrt(Counted(3)) / 4 * square(p[0]); },
       .area_to = [](Values p) { return sqrt(Counted(3)) / 4 * square(p[0]); },
       .picture = tetrahedron},
  };
}

}  // namespace etendue::catalogue
