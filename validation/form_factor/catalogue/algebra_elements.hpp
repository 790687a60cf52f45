// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "form_factor/catalogue/algebra.hpp"

// Relations of elements with discs and solids.
namespace etendue::validation {

inline void elements_and_discs(Algebra& f) {
  const double h = 0.8, r = 1.1;
  one(f("B-12", {h, r}) + f("element-base-centre-wall", {h, r}), "base centre");
  for (const double a : {0.0, 0.4, 1.0}) one(f("B-13", {a, h, r}) + f("element-base-wall", {a, h, r}), "base");
  equal(f("element-annulus", {h, 0.5, r}), f("element-offset-annulus", {0, h, 0.5, r}), "annulus on the axis");
  equal(f("element-annulus", {h, 0.5, r}), f("B-12", {h, r}) - f("B-12", {h, 0.5}), "annulus as two discs");
  equal(f("element-ellipse", {h, r, r}), f("B-12", {h, r}), "round ellipse");

  equal(f("element-ellipse", {h, 2, 0.5}) * f("element-ellipse", {h, 2, 0.5}), f("B-12", {h, 2}) * f("B-12", {h, 0.5}),
        "ellipse: geometric mean of its two discs");
  const double inscribed = h * r / std::hypot(h, r);  // the sphere around (0, 0, h) that touches the disc's cone
  equal(f("element-tilted-disc", {h, r, 30}), f("element-sphere-tilted", {h, inscribed, 30}),
        "disc and sphere in one cone");
  for (const double l : {1.2, 2.0}) {
    const auto mean = [&](double rho) { return 2 * rho / square(l) * f("B-13", {rho, h, r}); };
    equal(integral(0, l, mean, 6), f("C-41", {l, r, h}), "C-41 is the mean of B-13");
  }
  equal(f("wall-ring-disc", {1.3, 0.9, 0.4}), f("element-standing-disc", {1.3, 0.4, 0.9}), "ring and element");
  equal(f("wall-ring-annulus", {1.3, 0.3, 0.9, 0.4}), f("element-standing-annulus", {1.3, 0.4, 0.3, 0.9}),
        "ring and element");
}

inline void elements_and_solids(Algebra& f) {
  equal(f("element-sphere", {2, 0.7}), f("element-sphere-cut", {2, 0, 0.7}), "sphere on the normal");
  equal(f("element-sphere-halved", {2, 0.7}), f("element-sphere-cut", {0, 2, 0.7}), "sphere halved");
  equal(f("element-sphere-tilted", {2, 0.7, 60}), f("element-sphere-cut", {1, std::sqrt(3.0), 0.7}), "sphere above");
  for (const double h : {0.1, 0.35, 0.6}) {
    // the two sides of an element together see Lambert's vector of the whole sphere
    const double whole = h / std::pow(h * h + 1.69, 1.5) * square(0.7);
    equal(f("element-sphere-cut", {h, 1.3, 0.7}), whole + f("element-sphere-cut", {-h, 1.3, 0.7}), "both sides");
  }
  equal(f("element-long-cylinder", {2, 0.6, 40}),
        f("strip-long-cylinder", {2 * std::cos(40 * kPi / 180), 2 * std::sin(40 * kPi / 180), 0.6}), "turned strip");
  const double h = 1.7;
  const auto along = [&](double z) {
    return (f("element-cylinder", {2, z, 0.6}) + f("element-cylinder", {2, h - z, 0.6})) / h;
  };
  equal(integral(0, h, along, 2), f("strip-cylinder", {h, 2, 0, 0.6}), "strip-cylinder is the mean of its elements");
}

}  // namespace etendue::validation
