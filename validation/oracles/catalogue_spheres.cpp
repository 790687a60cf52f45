// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "oracles/catalogue_truth.hpp"

namespace etendue::oracle {

namespace {

constexpr Wide kDegree = kWidePi / 180;

/// What an element at `at`, facing `normal`, receives of a sphere of radius r around the origin, wholly above its
/// horizon; times 1/4πr² its share of the sphere's power. Proved by itself as element-sphere-tilted.
Wide from_sphere(const WideVector& at, const WideVector& normal) {
  const Wide square = dot(at, at);
  return -dot(normal, at) / (4 * kWidePi * square * std::sqrt(square));
}

Wide sphere_to_annulus(Wide inner, Wide outer, Wide h) {
  return integrate(inner, outer, [&](Wide rho) { return 2 * kWidePi * rho * from_sphere({rho, 0, h}, {0, 0, -1}); });
}

Wide sphere_to_rectangle(Wide a, Wide b, Wide d) {
  return integrate(0, a, [&](Wide x) {
    return integrate(0, b, [&](Wide y) { return from_sphere({x, y, d}, {0, 0, -1}); });
  });
}

Wide sphere_to_sphere(Wide r1, Wide r2, Wide s) {
  const Wide d = r1 + r2 + s;
  const auto at = [&](Wide angle) {
    return std::sin(angle) * element_to_sphere(d * std::cos(angle) - r1, d * std::sin(angle), r2);
  };
  const Wide all = std::acos((r1 + r2) / d), nothing = std::acos((r1 - r2) / d);
  return (integrate_coarse(0, all, at) + integrate_coarse(all, nothing, at)) / 2;
}

/// From the inside of a frustum's wall to the disc at its end of radius r_end, over the wall from there to the other end.
Wide wall_to_end(Wide r_end, Wide r_other, Wide h) {
  const Wide slope = (r_end - r_other) / h, norm = std::hypot(Wide(1), slope);
  const auto ring = [&](Wide u) {
    const Wide z = u * h, r = r_end - slope * z;
    return r * element_to_disc({r, 0, z}, {-1 / norm, 0, -slope / norm}, r_end, 0);
  };
  constexpr Wide kCut = 0.25;  // in one piece the rule leaves 1.5e-12 of a low, wide one: more than is judged
  return 2 * (integrate(0, kCut, ring) + integrate(kCut, 1, ring)) / (r_end + r_other);
}

/// From a disc of radius rd to a cone below it, its apex at the distance l, base radius rc at the depth l + h.
Wide disc_to_cone(Wide rd, Wide rc, Wide l, Wide h) {
  const Wide slant = std::hypot(rc, h), c = h / slant, s = rc / slant, edge = l * rc / h;
  const auto at = [&](Wide rho) {
    const Wide widest = rho <= edge ? kWidePi : std::acos(-edge / rho);
    return 2 * kWidePi * rho * integrate_coarse(0, rc, [&](Wide t) {
             const Wide z = l + t * h / rc;
             return 2 * t * slant / rc * integrate_coarse(0, widest, [&](Wide a) {
                      // from the cone at (t, 0, −z), facing (c, 0, s), to the disc's point (rho cos a, rho sin a, 0)
                      return kernel({rho * std::cos(a), rho * std::sin(a), 0}, {0, 0, -1}, {t, 0, -z}, {c, 0, s});
                    });
           });
  };
  const Wide split = std::min(edge, rd);
  return (integrate_coarse(0, split, at) + integrate_coarse(split, rd, at)) / (kWidePi * rd * rd);
}

}  // namespace

Truths truths_of_spheres_and_cones() {
  Truths t;
  t["sphere-rectangle"] = [](const double* p) { return sphere_to_rectangle(p[1], p[2], p[0]); };
  t["sphere-disc"] = [](const double* p) { return sphere_to_annulus(0, p[1], p[2]); };
  t["sphere-annulus"] = [](const double* p) { return sphere_to_annulus(p[1], p[2], p[3]); };
  t["sphere-regular-polygon"] = [](const double* p) {
    const Wide m = p[1], tangent = std::tan(kWidePi / p[0]);
    return 2 * p[0] * integrate(0, m, [&](Wide x) {
             return integrate(0, x * tangent, [&](Wide y) { return from_sphere({x, y, p[2]}, {0, 0, -1}); });
           });
  };
  t["sphere-cylinder"] = [](const double* p) {
    return 4 * kWidePi * p[1] * integrate(0, p[2], [&](Wide z) { return from_sphere({p[1], 0, z}, {-1, 0, 0}); });
  };
  t["sphere-cone"] = [](const double* p) {
    const Wide w = p[3] * kDegree, c = std::cos(w), s = std::sin(w);
    return integrate(0, p[2], [&](Wide r) {
      return 2 * kWidePi * r / s * from_sphere({r, 0, -(Wide(p[0]) + p[1] + r * c / s)}, {c, 0, s});
    });
  };
  t["sphere-sphere"] = [](const double* p) { return sphere_to_sphere(p[0], p[1], p[2]); };
  t["sphere-in-sphere"] = [](const double* p) { return element_to_sphere(p[1], 0, p[0]); };
  t["sphere-in-sphere-self"] = [](const double* p) {
    // Directions outside the cone of the inner sphere, from an element of the outer.
    const Wide cone = std::asin(Wide(p[0]) / p[1]);
    return integrate(cone, kWidePi / 2, [](Wide a) { return 2 * std::sin(a) * std::cos(a); });
  };
  t["sphere-zones"] = [](const double* p) {
    // From the lowest point of a sphere (or any other) to the zone of height h above it.
    const Wide r = p[0], widest = std::acos(1 - p[1] / r);
    return integrate(0, widest, [&](Wide a) {
      const WideVector out{std::sin(a), 0, -std::cos(a)};
      return 2 * kWidePi * r * r * std::sin(a) * kernel({0, 0, -r}, {0, 0, 1}, r * out, {-out.x, 0, -out.z});
    });
  };
  t["cap-base"] = [](const double* p) {
    // Over the cap, the base's contour seen from each of its rings; the cap's lowest point is at −r.
    const Wide r = p[0], widest = std::acos(1 - p[1] / r), level = -r * std::cos(widest);
    const Wide sum = integrate(0, widest, [&](Wide a) {
      const WideVector out{std::sin(a), 0, -std::cos(a)}, at = r * out;
      return std::sin(a) * -element_to_disc(at, {-out.x, 0, -out.z}, r * std::sin(widest), level);
    });
    return sum / (1 - std::cos(widest));
  };
  t["C-48"] = [](const double* p) { return disc_to_cone(p[0], p[1], p[2], p[3]); };
  t["cone-base"] = [](const double* p) { return wall_to_end(p[0], 0, p[1]); };
  t["cone-self"] = [](const double* p) { return 1 - wall_to_end(p[0], 0, p[1]); };
  t["frustum-base-wall"] = [](const double* p) {
    const Wide r1 = p[0], r2 = p[1], h = p[2];
    return wall_to_end(r1, r2, h) * (r1 + r2) * std::hypot(h, r1 - r2) / (r1 * r1);
  };
  t["frustum-self"] = [](const double* p) { return 1 - wall_to_end(p[0], p[1], p[2]) - wall_to_end(p[1], p[0], p[2]); };
  return t;
}

}  // namespace etendue::oracle
