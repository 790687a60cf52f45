// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "form_factor/catalogue/algebra.hpp"

// Relations of discs, cylinders, spheres and cones.
namespace etendue::validation {

inline void discs_and_annuli(Algebra& f) {
  equal(f("C-40", {1.1, 0.7}), f("C-41", {1.1, 1.1, 0.7}), "equal discs");
  equal(1.21 * f("C-41", {1.1, 0.6, 0.7}), 0.36 * f("C-41", {0.6, 1.1, 0.7}), "reciprocity");
  equal(1.21 * f("disc-annulus", {1.1, 0.5, 1.3, 0.7}), (1.69 - 0.25) * f("annulus-disc", {0.5, 1.3, 1.1, 0.7}),
        "reciprocity");
  // annuli as the mean of the elements between their circles
  const double r1 = 0.5, r2 = 1.2, r3 = 0.4, r4 = 0.9, h = 0.8, area = square(r2) - square(r1);
  const auto to_annulus = [&](double a) { return 2 * a / area * f("element-offset-annulus", {a, h, r3, r4}); };
  equal(integral(r1, r2, to_annulus, 2), f("C-52", {r1, r2, r3, r4, h}), "C-52 is the mean of its elements");
  const auto to_disc = [&](double a) { return 2 * a / area * f("B-13", {a, h, r4}); };
  equal(integral(r1, r2, to_disc, 2), f("annulus-disc", {r1, r2, r4, h}), "annulus-disc is the mean of its elements");
  const auto from_disc = [&](double a) { return 2 * a / square(r2) * f("element-offset-annulus", {a, h, r3, r4}); };
  equal(integral(0, r2, from_disc, 3), f("disc-annulus", {r2, r3, r4, h}), "disc-annulus is the mean of its elements");
}

inline void cylinders(Algebra& f) {
  const double r = 0.8, h = 1.7;
  equal(f("wall-ring-end", {0.6, r}), f("wall-ring-disc", {r, r, 0.6}), "the end is a disc as wide as the wall");
  one(f("wall-ring-wall", {0.6, r, h}) + f("wall-ring-end", {0.6, r}) + f("wall-ring-end", {h - 0.6, r}),
      "ring: wall and two ends");
  const auto ring = [&](double z) { return f("wall-ring-wall", {z, r, h}) / h; };
  equal(integral(0, h, ring, 3), f("cylinder-wall-self", {r, h}), "the wall is the mean of its rings");
  one(f("C-80", {r, h}) + f("C-40", {r, h}), "base: wall and top");
  const auto end = [&](double z) { return 2 / r * f("wall-ring-end", {z, r}); };
  equal(integral(0, h, end, 3), f("C-80", {r, h}), "reciprocity, ring by ring");
  equal(integral(0.3, 1.1, end, 2), f("base-wall-band", {r, 0.3, 0.8}), "reciprocity, ring by ring");
  const auto band = [&](double z) {
    return (f("wall-ring-end", {0.2 + z, r}) - f("wall-ring-end", {0.7 + z, r})) / 0.9;
  };
  equal(integral(0, 0.9, band, 2), f("wall-bands", {r, 0.9, 0.2, 0.5}), "bands are the mean of their rings");
}

inline void nested_cylinders(Algebra& f) {
  for (const double h : {0.4, 1.5, 6.0}) {
    const double r1 = 0.7, r2 = 1.5, ends = square(r2) - square(r1);
    const double inner = f("outer-inner-cylinder", {r1, r2, h}), self = f("outer-cylinder-self", {r1, r2, h});
    const double end = f("outer-cylinder-end", {r1, r2, h});
    equal(f("strip-cylinder", {h, r2, 0, r1}), inner, "every strip of the outer wall sees the same");
    one(r2 / r1 * inner + 2 * f("C-77", {r1, r2, h}), "inner cylinder: outer and two ends");
    one(self + inner + 2 * end, "outer cylinder: itself, inner and two ends");
    const double across = f("annular-ends", {r1, r2, h});
    one(across + 2 * h / ends * (r1 * f("C-77", {r1, r2, h}) + r2 * end), "annular end");
    EXPECT_TRUE(holds(across < f("C-52", {r1, r2, r1, r2, h}))) << "the inner cylinder hides a part";
  }
  // a thin inner cylinder hides next to nothing: of the order of its radius
  const double thin = f("C-52", {1e-2, 1, 1e-2, 1, 0.8}) - f("annular-ends", {1e-2, 1, 0.8});
  EXPECT_TRUE(within(thin, 1e-2));
}

inline void spheres(Algebra& f) {
  double directions = 0;  // a box around the sphere: eight corners, three faces each
  for (const auto& [d, a, b] : {std::array{0.7, 1.1, 1.9}, {1.1, 1.9, 0.7}, {1.9, 0.7, 1.1}}) {
    directions += 8 * f("sphere-rectangle", {d, a, b, 0.3});
  }
  one(directions, "sphere in a box");
  one(f("sphere-cylinder", {0.3, 0.9, 1.4}) + 2 * f("sphere-disc", {0.3, 0.9, 1.4}), "sphere in a closed cylinder");
  equal(f("sphere-annulus", {0.3, 0.4, 0.9, 1.4}),
        f("sphere-disc", {0.3, 0.9, 1.4}) - f("sphere-disc", {0.3, 0.4, 1.4}), "annulus");
  equal(f("sphere-regular-polygon", {4, 0.9, 1.4, 0.3}), 4 * f("sphere-rectangle", {1.4, 0.9, 0.9, 0.3}), "square");
  const auto onto = [&](double rho) { return 2 * rho / square(0.9) * f("element-sphere-cut", {1.4, rho, 0.3}); };
  equal(integral(0, 0.9, onto) * square(0.9) / (4 * square(0.3)), f("sphere-disc", {0.3, 0.9, 1.4}),
        "reciprocity, by elements");
  equal(f("sphere-cone", {0.5, 0.4, 0.8, 45}), f("sphere-disc", {0.5, 0.8, 1.7}), "the cone hides its base");
  equal(square(0.8) * f("sphere-sphere", {0.8, 0.3, 0.5}), square(0.3) * f("sphere-sphere", {0.3, 0.8, 0.5}),
        "reciprocity");
  one(f("sphere-in-sphere", {0.4, 1}) + f("sphere-in-sphere-self", {0.4, 1}), "outer sphere: inner and itself");
  equal(f("sphere-in-sphere", {0.4, 1}), f("element-sphere", {1, 0.4}), "every element of the outer sees the same");
  one(f("cap-base", {0.9, 0.5}) + f("sphere-zones", {0.9, 0.5}), "cap: base and itself");
  one(f("sphere-zones", {0.9, 0.5}) + f("sphere-zones", {0.9, 1.3}), "the zones of a sphere");
  equal(f("cap-base", {0.9, 0.9}), 0.5, "hemisphere");
}

inline void cones(Algebra& f) {
  one(f("cone-base", {0.8, 1.3}) + f("cone-self", {0.8, 1.3}), "cone: base and itself");
  const double r1 = 0.8, r2 = 0.5, h = 1.3, wall = (r1 + r2) * std::hypot(h, r1 - r2);
  one(f("frustum-base-wall", {r1, r2, h}) + f("C-41", {r1, r2, h}), "base: wall and top");
  const double ends =
      square(r1) * f("frustum-base-wall", {r1, r2, h}) + square(r2) * f("frustum-base-wall", {r2, r1, h});
  one(f("frustum-self", {r1, r2, h}) + ends / wall, "wall: itself and both ends");
  equal(f("frustum-self", {r1, r1, h}), f("cylinder-wall-self", {r1, h}), "no slope");
  // a top of radius 1e-5: its share of the wall, of the order of its radius, is all that is missing of the cone
  EXPECT_TRUE(near(f("frustum-self", {r1, r1 * 1e-5, h}), f("cone-self", {r1, h}), 1e-4));
  // where the disc's edge reaches the cone continued upwards, C-48 and the disc in its base are one
  for (const double l : {0.75, 0.76, 1.5})
    equal(f("C-48", {1, 0.8, l, 0.6}), f("C-41", {1, 0.8, l + 0.6}), "the cone hides its base");
  EXPECT_TRUE(holds(f("C-48", {1, 0.8, 0.3, 0.6}) > f("C-41", {1, 0.8, 0.9}))) << "nearer, its sides are seen too";
  EXPECT_TRUE(near(f("C-48", {1, 0.8, 0.75 * (1 - 1e-7), 0.6}), f("C-41", {1, 0.8, 1.35}), 1e-6)) << "without a step";
  // all that the disc sees of the half-space below: a cone that fills it, closed by a wall of no height
  EXPECT_TRUE(near(f("C-48", {1, 100, 1e-1, 1}), 1, 1e-3)) << "a wide, near cone fills the view";
}

}  // namespace etendue::validation
