// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/form_factor/point_polygon.hpp"
#include "etendue/form_factor/polygon_polygon.hpp"
#include "form_factor/catalogue/algebra.hpp"
#include "form_factor/shapes.hpp"

// Relations of what is flat or infinitely long.
namespace etendue::validation {

inline void polygons_from_elements(Algebra& f) {
  const auto from = [](const std::vector<Vec3>& corners) {
    const Bounded seen = point_to_polygon(tilted(Vec3(0, 0, 0)), tilted(Vec3(0, 0, 1)) - tilted(Vec3(0, 0, 0)),
                                          tilted(polygon(corners)));
    return seen;
  };
  const auto same = [&](const char* id, const std::vector<double>& values, const std::vector<Vec3>& corners) {
    const Bounded seen = from(corners);
    constexpr double kFrame = 1e-14;  // the corners are rounded as they are turned into the frame
    EXPECT_TRUE(near(f(id, values), seen.value, seen.bound + kFrame)) << id;
  };
  same("element-corner-rectangle", {1.3, 0.7, 0.9}, {{0, 0, .9}, {0, .7, .9}, {1.3, .7, .9}, {1.3, 0, .9}});
  same("element-standing-rectangle", {0.8, 1.4, 0.6}, {{0, .6, 0}, {1.4, .6, 0}, {1.4, .6, .8}, {0, .6, .8}});
  for (const double phi : {35.0, 90.0, 140.0}) {
    const double y = 0.6 - 0.8 * std::cos(phi * kPi / 180), z = 0.8 * std::sin(phi * kPi / 180);
    same("element-leaning-rectangle", {0.8, 1.4, 0.6, phi}, {{0, .6, 0}, {1.4, .6, 0}, {1.4, y, z}, {0, y, z}});
  }
  same("element-rectangle", {-0.3, 1.1, 0.4, 2, 0.5}, {{-.3, .4, .5}, {-.3, 2, .5}, {1.1, 2, .5}, {1.1, .4, .5}});
  same("element-right-triangle", {1.2, 0.5, 0.8}, {{0, 0, .8}, {0, .5, .8}, {1.2, 0, .8}});
  for (const int n : {3, 5, 12}) {
    std::vector<Vec3> corners;
    for (int k = 0; k < n; ++k) {
      const double a = -2 * kPi * k / n, r = 0.9 / std::cos(kPi / n);
      corners.push_back({r * std::cos(a), r * std::sin(a), 0.7});
    }
    same("element-regular-polygon", {static_cast<double>(n), 0.9, 0.7}, corners);
  }
}

inline void pairs_of_polygons(Algebra& f) {
  const auto same = [&](const char* id, const std::vector<double>& values, const Polygon& from, const Polygon& to) {
    const Bounded engine = form_factor(tilted(from), tilted(to));
    const double ours = f(id, values);
    EXPECT_TRUE(near(ours, engine.value, engine.bound + kTwelveDigits * ours)) << id;
  };
  same("C-11", {1.2, 0.7, 0.9}, rectangle({0, 0, 0}, {1.2, 0, 0}, {0, .7, 0}),
       rectangle({0, 0, .9}, {0, .7, 0}, {1.2, 0, 0}));
  same("C-14", {1.2, 0.7, 0.9}, rectangle({0, 0, 0}, {1.2, 0, 0}, {0, .9, 0}),
       rectangle({0, 0, 0}, {0, .9, 0}, {0, 0, .7}));
  same("parallel-rectangles", {0, 1, 0, 0.6, 0.3, 1.7, -0.4, 0.5, 0.8}, rectangle({0, 0, 0}, {1, 0, 0}, {0, .6, 0}),
       rectangle({.3, -.4, .8}, {0, .9, 0}, {1.4, 0, 0}));
  same("perpendicular-rectangles", {0.2, 1, 0, 0.6, 0.5, 1.3, 0, 0.9}, rectangle({.2, 0, 0}, {.8, 0, 0}, {0, .6, 0}),
       rectangle({0, .5, 0}, {0, .8, 0}, {0, 0, .9}));
  for (const double phi : {30.0, 60.0, 90.0, 135.0}) {
    const double c = std::cos(phi * kPi / 180), s = std::sin(phi * kPi / 180);
    same("hinged-rectangles", {0.7, 1.2, 0.9, phi}, rectangle({0, 0, 0}, {1.2, 0, 0}, {0, .9, 0}),
         rectangle({0, 0, 0}, {0, .9, 0}, {.7 * c, 0, .7 * s}));
  }
  const Vec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  same("cube-opposite", {1}, rectangle(o, x, y), rectangle(z, y, x));
  same("cube-adjacent", {1}, rectangle(o, x, y), rectangle(o, y, z));
  same("corner-tetrahedron-legs", {1}, polygon({o, x, y}), polygon({o, y, z}));
  same("corner-tetrahedron-oblique", {1}, polygon({o, x, y}), polygon({x, z, y}));
  same("tetrahedron", {1}, polygon({o, x + z, x + y}), polygon({o, x + y, y + z}));
}

inline void boxes(Algebra& f) {
  const double a = 1.4, b = 0.8, c = 0.5, walls = 2 * (a + b) * c;
  one(f("box-floor-walls", {a, b, c}) + f("C-11", {a, b, c}), "floor: walls and ceiling");
  one(f("box-walls-self", {a, b, c}) + 2 * a * b / walls * f("box-floor-walls", {a, b, c}),
      "walls: walls, floor, ceiling");
  one(f("cube-opposite", {1}) + 4 * f("cube-adjacent", {1}), "cube");
  const auto strip = [&](double x) {
    return f("strip-opposite-rectangle", {x, b, c}) + f("strip-opposite-rectangle", {a - x, b, c});
  };
  equal(integral(0, a, strip) / a, f("C-11", {a, b, c}), "C-11 is the mean of its strips");
  const auto standing = [&](double x) { return f("strip-standing-rectangle", {c, b, x}); };
  // from a distance on; nearer, C-14 of the rest
  const double part = integral(0.2, a, standing, 4);
  equal(part, a * f("C-14", {a, c, b}) - 0.2 * f("C-14", {0.2, c, b}), "C-14 is the mean of its strips");
}

inline void strips(Algebra& f) {
  one(f("B-71", {-90, 20}) + f("B-71", {20, 90}), "half-space");
  equal(f("wedge-half-plane", {50}), f("B-71", {-40, 90}), "wedge");
  equal(f("opposite-plates", {1.3, 0.6}), f("centred-plates", {1.3, 1.3, 0.6}), "equal plates");
  equal(f("centred-plates", {1.3, 0.9, 0.6}), f("shifted-plates", {1.3, 0.2, 1.1, 0.6}), "centred plates");
  equal(f("perpendicular-plates", {1.3, 0.6}), f("C-5a", {1.3, 0.6, 90}), "right angle");
  equal(f("C-5", {70}), f("C-5a", {1.3, 1.3, 70}), "equal widths");
  const auto wedge = [&](double x) { return f("wedge-plate", {x, 0.8, 65}); };
  equal(integral(0.3, 1.5, wedge, 3), 1.5 * f("C-5a", {1.5, 0.8, 65}) - 0.3 * f("C-5a", {0.3, 0.8, 65}),
        "C-5a by elements");
  equal(f("screened-plates", {1.3, 0.4, 0.6}), 0.9 / 1.3 * f("opposite-plates", {0.9, 0.6}),
        "what passes the screen's two sides");
  one(f("triangular-duct", {1.1, 0.8, 0.7}) + f("triangular-duct", {1.1, 0.7, 0.8}), "triangle");
  equal(f("triangular-duct", {1.2, 0.5, 1.3}), f("perpendicular-plates", {1.2, 0.5}), "right triangle");
  const double w = 0.9, h = 1.4;
  const double kept = 2 * w * f("perpendicular-plates", {w, h}) +
                      2 * h * (f("perpendicular-plates", {h, w}) + f("opposite-plates", {h, w}));
  equal(f("groove-self", {w, h}), kept / (w + 2 * h), "groove, wall by wall");
  equal(f("arc-self", {1, 90}), 1 - 2 / kPi, "semi-cylinder");
  one(f("arc-self", {1, 180}), "whole tube");
  equal(f("arc-self", {1, 90}), 1 - 2 / kPi * f("perpendicular-plates", {1, 1}) / f("C-5", {90}),
        "semi-cylinder and its chord");
}

inline void tubes(Algebra& f) {
  equal(f("equal-tubes", {0.8, 0.5}), f("unequal-tubes", {0.8, 0.8, 0.5}), "equal radii");
  equal(0.8 * f("unequal-tubes", {0.8, 0.3, 0.5}), 0.3 * f("unequal-tubes", {0.3, 0.8, 0.5}), "reciprocity");
  const auto plate = [&](double x) { return f("strip-long-cylinder", {1.2, std::abs(x), 0.5}) / (2 * kPi * 0.5); };
  equal(integral(-0.4, 1.5, plate, 2), f("tube-plate", {1.2, 0.5, -0.4, 1.5}), "tube-plate is the mean of its strips");
  // A row seen tangentially: closed at d = s; thin tubes are seen one by one, ½ of π d each
  one(f("plane-tube-row", {1, 1}), "closed row");
  const double q = 1e-5;
  EXPECT_TRUE(near(f("plane-tube-row", {q, 1}), kPi / 2 * q - q * q / 2, q * q * q)) << "thin tubes, each hiding q²/2";
  one(f("tube-in-tube-self", {0.4, 1}) + 0.4, "outer tube: itself and the inner");
}

}  // namespace etendue::validation
