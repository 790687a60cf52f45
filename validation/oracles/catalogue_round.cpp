// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "oracles/catalogue_truth.hpp"

namespace etendue::oracle {

namespace {

/// Points of an annulus at radius rho that a ring at radius r and the distance h below sends to, over the angle.
Wide ring_to_ring(Wide r, Wide rho, Wide h, Wide widest) {
  const auto at = [&](Wide t) {
    const Wide square = (r - rho) * (r - rho) + 4 * r * rho * std::sin(t / 2) * std::sin(t / 2) + h * h;
    return h * h / (kWidePi * square * square);
  };
  const Wide near = std::min(std::hypot(r - rho, h) / std::max(r, rho), widest);
  return 2 * (integrate_coarse(0, near, at) + integrate_coarse(near, widest, at));
}

/// From one annulus to another, per area of the first.
Wide annuli(Wide r1, Wide r2, Wide r3, Wide r4, Wide h) {
  const auto from = [&](Wide r) {
    const auto at = [&](Wide rho) { return r * rho * ring_to_ring(r, rho, h, kWidePi); };
    const Wide opposite = std::clamp(r, r3, r4);  // where the kernel peaks
    return integrate_coarse(r3, opposite, at) + integrate_coarse(opposite, r4, at);
  };
  Wide sum = 0, low = r1;  // beyond the other's circles the peak is at an end
  for (const Wide end : {std::clamp(r3, r1, r2), std::clamp(r4, r1, r2), r2}) {
    sum += integrate_coarse(low, end, from);
    low = end;
  }
  return 2 * sum / (r2 * r2 - r1 * r1);
}

/// From a narrow ring on the wall of radius r1, facing inwards, to an annulus at the distance z.
Wide wall_to_annulus(Wide r1, Wide inner, Wide outer, Wide z) {
  return integrate(inner, outer, [&](Wide rho) {
    return 2 * rho * integrate(0, kWidePi, [&](Wide t) {
             return kernel({r1, 0, 0}, {-1, 0, 0}, {rho * std::cos(t), rho * std::sin(t), z}, {0, 0, -1});
           });
  });
}

/// From a narrow ring at the height 0 to the part of the wall between two heights of one sign.
Wide wall_to_wall(Wide r, Wide low, Wide high) {
  return 2 * r * integrate_coarse(low, high, [&](Wide z) {
           const auto at = [&](Wide t) {
             const Wide height = 2 * r * std::sin(t / 2) * std::sin(t / 2);  // r (1 − cos t)
             const Wide square = 2 * r * height + z * z;
             return height * height / (kWidePi * square * square);
           };
           const Wide near = std::min(z / r, kWidePi);
           return integrate_coarse(0, near, at) + integrate_coarse(near, kWidePi, at);
         });
}

/// The same from a band of height h to itself: the heights' difference has a triangular density.
Wide wall_to_itself(Wide r, Wide h, Wide widest) {
  return 2 * r * integrate(0, h, [&](Wide z) {
           return 2 * (h - z) / h * integrate(0, widest, [&](Wide t) {
                    const Wide height = 2 * r * std::sin(t / 2) * std::sin(t / 2);
                    const Wide square = 2 * r * height + z * z;
                    return height * height / (kWidePi * square * square);
                  });
         });
}

/// From a disc of radius r to the wall around it between two heights, over the wall: each element sees all of the disc.
Wide base_to_band(Wide r, Wide low, Wide high) {
  return 2 / r * integrate(low, high, [&](Wide z) { return element_to_disc({r, 0, z}, {-1, 0, 0}, r, 0); });
}

/// From the wall of radius r (facing outwards: sign 1, inwards: −1) and height h to an annular end that begins at the wall
/// and is `width` wide, over the angles that `widest` allows.
template <class Widest>
Wide wall_to_end(Wide r, Wide sign, Wide width, Wide h, const Widest& widest) {
  const Wide sum = integrate(0, width, [&](Wide e) {
    const Wide rho = r + sign * e;
    const auto at = [&](Wide t) {
      const Wide s = std::sin(t / 2), height = e - sign * 2 * rho * s * s;  // over the tangent plane
      const Wide square = e * e + 4 * r * rho * s * s;
      return height / kWidePi * (1 / square - 1 / (square + h * h)) / 2;  // ∫ z/(d²+z²)² dz
    };
    const Wide whole = widest(rho, e), near = std::min(e / r, whole);  // as far aside as the wall is
    return 2 * rho * (integrate(0, near, at) + integrate(near, whole, at));
  });
  return sum / h;
}

/// acos(r/(r + e)), right for small e.
Wide arc_cosine(Wide r, Wide e) {
  return std::atan2(std::sqrt(e * (2 * r + e)), r);
}

struct Nested {
  Wide r1, r2, h;
};

Nested nested(const double* p) {
  return {p[0], p[1], p[2]};
}

Wide strip_to_cylinder(Wide h, Wide s, Wide x, Wide r) {
  const Wide towards = std::atan2(x, s), visible = std::acos(r / std::hypot(s, x));
  const auto at = [&](Wide t) {
    const Wide c = std::cos(t), n = std::sin(t);
    const Wide forward = s - r * c, out = s * c + x * n - r;
    const Wide square = (s - r * c) * (s - r * c) + (x - r * n) * (x - r * n);
    const auto above = [&](Wide z) {
      const Wide whole = square + z * z;
      return 2 * (h - z) / h * forward * out / (kWidePi * whole * whole);
    };
    const Wide near = std::min(std::sqrt(square), h);
    return integrate(0, near, above) + integrate(near, h, above);
  };
  return r * (integrate(towards - visible, towards, at) + integrate(towards, towards + visible, at));
}

}  // namespace

Truths truths_of_discs_and_cylinders() {
  Truths t;
  t["C-40"] = [](const double* p) { return annuli(0, p[0], 0, p[0], p[1]); };
  t["C-41"] = [](const double* p) { return annuli(0, p[0], 0, p[1], p[2]); };
  t["disc-annulus"] = [](const double* p) { return annuli(0, p[0], p[1], p[2], p[3]); };
  t["annulus-disc"] = [](const double* p) { return annuli(p[0], p[1], 0, p[2], p[3]); };
  t["C-52"] = [](const double* p) { return annuli(p[0], p[1], p[2], p[3], p[4]); };
  t["wall-ring-disc"] = [](const double* p) { return wall_to_annulus(p[0], 0, p[1], p[2]); };
  t["wall-ring-annulus"] = [](const double* p) { return wall_to_annulus(p[0], p[1], p[2], p[3]); };
  t["wall-ring-wall"] = [](const double* p) {
    return wall_to_wall(p[1], 0, p[0]) + wall_to_wall(p[1], 0, Wide(p[2]) - p[0]);
  };
  t["wall-ring-end"] = [](const double* p) { return wall_to_annulus(p[1], 0, p[1], p[0]); };
  t["cylinder-wall-self"] = [](const double* p) { return wall_to_itself(p[0], p[1], kWidePi); };
  t["C-80"] = [](const double* p) { return base_to_band(p[0], 0, p[1]); };
  t["base-wall-band"] = [](const double* p) { return base_to_band(p[0], p[1], Wide(p[1]) + p[2]); };
  t["wall-bands"] = [](const double* p) {
    const Wide r = p[0], a = p[1], g = p[2], b = p[3];
    return integrate_coarse(0, a, [&](Wide z) { return wall_to_wall(r, g + z, g + z + b); }) / a;
  };
  t["strip-cylinder"] = [](const double* p) { return strip_to_cylinder(p[0], p[1], p[2], p[3]); };
  t["C-77"] = [](const double* p) {
    const Nested s = nested(p);
    return wall_to_end(s.r1, 1, s.r2 - s.r1, s.h, [&](Wide, Wide e) { return arc_cosine(s.r1, e); });
  };
  t["outer-inner-cylinder"] = [](const double* p) {
    const Nested s = nested(p);
    return strip_to_cylinder(s.h, s.r2, 0, s.r1);
  };
  t["outer-cylinder-self"] = [](const double* p) {
    const Nested s = nested(p);
    return wall_to_itself(s.r2, s.h, 2 * std::acos(s.r1 / s.r2));
  };
  t["outer-cylinder-end"] = [](const double* p) {
    const Nested s = nested(p);
    const Wide gap = s.r2 - s.r1;
    return wall_to_end(s.r2, -1, gap, s.h,
                       [&](Wide, Wide e) { return arc_cosine(s.r1, gap) + arc_cosine(s.r1, gap - e); });
  };
  t["annular-ends"] = [](const double* p) {
    const Nested s = nested(p);
    const Wide sum = integrate_coarse(s.r1, s.r2, [&](Wide r) {
      return integrate_coarse(s.r1, s.r2, [&](Wide rho) {
        return r * rho * ring_to_ring(r, rho, s.h, arc_cosine(s.r1, r - s.r1) + arc_cosine(s.r1, rho - s.r1));
      });
    });
    return 2 * sum / (s.r2 * s.r2 - s.r1 * s.r1);
  };
  return t;
}

}  // namespace etendue::oracle
