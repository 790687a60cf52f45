// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "oracles/catalogue_truth.hpp"

namespace etendue::oracle {

namespace {

constexpr WideVector kUp{0, 0, 1}, kDown{0, 0, -1};
constexpr Wide kDegree = kWidePi / 180;

/// Over the parallelogram o + s a + t b, facing `facing` (of unit length); `area` = |a × b|.
Wide over_parallelogram(const WideVector& normal, const WideVector& o, const WideVector& a, const WideVector& b,
                        const WideVector& facing, Wide area) {
  return area * integrate(0, 1, [&](Wide s) {
           return integrate(0, 1, [&](Wide t) { return kernel({0, 0, 0}, normal, o + s * a + t * b, facing); });
         });
}

/// Over an annulus around (0, 0, h), facing down, from an element at `at`.
Wide over_annulus(const WideVector& at, const WideVector& normal, Wide inner, Wide outer, Wide h) {
  return integrate(inner, outer, [&](Wide rho) {
    return 2 * rho * integrate(0, kWidePi, [&](Wide t) {
             return kernel(at, normal, {rho * std::cos(t), rho * std::sin(t), h}, kDown);
           });
  });
}

/// Over the triangle (0,0,h), (m,0,h), (m,s,h).
Wide over_right_triangle(Wide m, Wide s, Wide h) {
  return integrate(0, m, [&](Wide x) {
    return integrate(0, x * s / m, [&](Wide y) { return kernel({0, 0, 0}, kUp, {x, y, h}, kDown); });
  });
}

/// Over the inside of a cylinder of radius r and height h, from an element on its base at (a, 0, 0).
Wide over_wall(Wide a, Wide h, Wide r) {
  return integrate(0, kWidePi, [&](Wide t) {
    const Wide c = std::cos(t), s = std::sin(t);
    return 2 * r * integrate(0, h, [&](Wide z) { return kernel({a, 0, 0}, kUp, {r * c, r * s, z}, {-c, -s, 0}); });
  });
}

Wide over_cylinder_outside(Wide h, Wide l, Wide r) {
  const Wide visible = std::acos(r / h);
  return integrate(0, visible, [&](Wide t) {
    const Wide c = std::cos(t), s = std::sin(t);
    return 2 * r * integrate(0, l, [&](Wide z) { return kernel({h, 0, 0}, {-1, 0, 0}, {r * c, r * s, z}, {c, s, 0}); });
  });
}

}  // namespace

Wide element_to_sphere(Wide h, Wide l, Wide r) {
  // Directions at the angle a from the centre's; the normal is at the angle tau from it.
  const Wide distance = std::hypot(h, l), cone = std::asin(r / distance), tau = std::atan2(l, h);
  const Wide touch = std::abs(kWidePi / 2 - tau);  // where the horizon begins to cut the circle of directions
  const auto ring = [&](Wide a) {
    const Wide along = std::cos(tau) * std::cos(a), aside = std::sin(tau) * std::sin(a);
    // ∫ of the positive part of along + aside cos b over b
    if (along >= aside) return 2 * kWidePi * along * std::sin(a);
    if (along <= -aside) return Wide(0);
    const Wide b = std::acos(-along / aside);
    return 2 * (along * b + aside * std::sin(b)) * std::sin(a);
  };
  const Wide split = std::min(touch, cone);
  return (integrate(0, split, ring) + integrate(split, cone, ring)) / kWidePi;
}

Wide element_to_disc(const WideVector& at, const WideVector& normal, Wide radius, Wide height) {
  const auto outline = [&](Wide t) {
    const WideVector r = WideVector{radius * std::cos(t), radius * std::sin(t), height} - at;
    const WideVector dr{-radius * std::sin(t), radius * std::cos(t), 0};
    const WideVector cross{r.y * dr.z - r.z * dr.y, r.z * dr.x - r.x * dr.z, r.x * dr.y - r.y * dr.x};
    return dot(normal, cross) / dot(r, r);
  };
  // even in the angle, and steepest where the outline is nearest, within angles like the element's height over it
  const Wide steep = std::abs(at.z - height) / radius;
  Wide sum = 0, low = 0;
  for (const Wide end : {steep / 3, steep, 3 * steep, kWidePi}) {
    sum += integrate(low, std::min(end, kWidePi), outline);
    low = std::min(end, kWidePi);
  }
  return -sum / kWidePi;
}

Truths truths_of_elements() {
  Truths t;
  t["element-corner-rectangle"] = [](const double* p) {
    return over_parallelogram(kUp, {0, 0, p[2]}, {p[0], 0, 0}, {0, p[1], 0}, kDown, Wide(p[0]) * p[1]);
  };
  t["element-standing-rectangle"] = [](const double* p) {
    return over_parallelogram(kUp, {0, p[2], 0}, {p[1], 0, 0}, {0, 0, p[0]}, {0, -1, 0}, Wide(p[0]) * p[1]);
  };
  t["element-leaning-rectangle"] = [](const double* p) {
    const Wide phi = p[3] * kDegree, c = std::cos(phi), s = std::sin(phi);
    return over_parallelogram(kUp, {0, p[2], 0}, {p[1], 0, 0}, {0, -p[0] * c, p[0] * s}, {0, -s, -c},
                              Wide(p[0]) * p[1]);
  };
  t["element-rectangle"] = [](const double* p) {
    Wide sum = 0;  // split below the element, where the kernel peaks
    const Wide xs[] = {p[0], std::clamp<Wide>(0, p[0], p[1]), p[1]},
               ys[] = {p[2], std::clamp<Wide>(0, p[2], p[3]), p[3]};
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        const Wide a = xs[i + 1] - xs[i], b = ys[j + 1] - ys[j];
        if (a > 0 && b > 0) sum += over_parallelogram(kUp, {xs[i], ys[j], p[4]}, {a, 0, 0}, {0, b, 0}, kDown, a * b);
      }
    }
    return sum;
  };
  t["element-regular-polygon"] = [](const double* p) {
    return 2 * p[0] * over_right_triangle(p[1], p[1] * std::tan(kWidePi / p[0]), p[2]);
  };
  t["element-right-triangle"] = [](const double* p) {
    return integrate(0, p[0], [&](Wide x) {
      return integrate(0, p[1] * (1 - x / p[0]), [&](Wide y) { return kernel({0, 0, 0}, kUp, {x, y, p[2]}, kDown); });
    });
  };
  t["B-12"] = [](const double* p) { return over_annulus({0, 0, 0}, kUp, 0, p[1], p[0]); };
  t["element-tilted-disc"] = [](const double* p) {
    const Wide w = p[2] * kDegree;
    return over_annulus({0, 0, 0}, {std::sin(w), 0, std::cos(w)}, 0, p[1], p[0]);
  };
  t["B-13"] = [](const double* p) { return over_annulus({p[0], 0, 0}, kUp, 0, p[2], p[1]); };
  t["element-standing-disc"] = [](const double* p) { return over_annulus({p[0], 0, 0}, {-1, 0, 0}, 0, p[2], p[1]); };
  t["element-annulus"] = [](const double* p) { return over_annulus({0, 0, 0}, kUp, p[1], p[2], p[0]); };
  t["element-offset-annulus"] = [](const double* p) { return over_annulus({p[0], 0, 0}, kUp, p[2], p[3], p[1]); };
  t["element-standing-annulus"] = [](const double* p) {
    return over_annulus({p[0], 0, 0}, {-1, 0, 0}, p[2], p[3], p[1]);
  };
  t["element-ellipse"] = [](const double* p) {
    return p[1] * p[2] * integrate(0, 1, [&](Wide rho) {
             return 4 * rho * integrate(0, kWidePi / 2, [&](Wide a) {
                      return kernel({0, 0, 0}, kUp, {p[1] * rho * std::cos(a), p[2] * rho * std::sin(a), p[0]}, kDown);
                    });
           });
  };
  t["element-base-centre-wall"] = [](const double* p) { return over_wall(0, p[0], p[1]); };
  t["element-base-wall"] = [](const double* p) { return over_wall(p[0], p[1], p[2]); };
  t["element-cylinder"] = [](const double* p) { return over_cylinder_outside(p[0], p[1], p[2]); };
  t["element-sphere"] = [](const double* p) { return element_to_sphere(p[0], 0, p[1]); };
  t["element-sphere-halved"] = [](const double* p) { return element_to_sphere(0, p[0], p[1]); };
  t["element-sphere-tilted"] = [](const double* p) {
    const Wide w = p[2] * kDegree;
    return element_to_sphere(p[0] * std::cos(w), p[0] * std::sin(w), p[1]);
  };
  t["element-sphere-cut"] = [](const double* p) { return element_to_sphere(p[0], p[1], p[2]); };
  t["element-long-cylinder"] = [](const double* p) {
    // The wall between the two tangents, seen from an element that faces (sin w, cos w).
    const Wide w = p[2] * kDegree, visible = std::acos(Wide(p[1]) / p[0]);
    return integrate(-visible, visible, [&](Wide a) {
      const WideVector out{std::sin(a), 0, -std::cos(a)};
      return p[1] *
             kernel_of_strips({0, 0, 0}, {std::sin(w), 0, std::cos(w)}, WideVector{0, 0, p[0]} + p[1] * out, out);
    });
  };
  return t;
}

}  // namespace etendue::oracle
