// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "oracles/catalogue_truth.hpp"

namespace etendue::oracle {

namespace {

constexpr Wide kDegree = kWidePi / 180;
constexpr WideVector kUp{0, 0, 1}, kDown{0, 0, -1};

/// Between [a, b] on z = 0 and [c, d] on z = h, per length of the first.
Wide plates(Wide a, Wide b, Wide c, Wide d, Wide h) {
  return integrate(a, b,
                   [&](Wide x) {
                     const auto at = [&](Wide y) { return kernel_of_strips({x, 0, 0}, kUp, {y, 0, h}, kDown); };
                     const Wide opposite = std::clamp(x, c, d);  // where the kernel peaks
                     return integrate(c, opposite, at) + integrate(opposite, d, at);
                   }) /
         (b - a);
}

/// Between plates of widths u and v that share an edge at the angle alpha, per length of the first.
Wide hinge(Wide u, Wide v, Wide alpha) {
  const Wide c = std::cos(alpha), s = std::sin(alpha);
  const auto from = [&](Wide x) {
    const auto at = [&](Wide y) { return kernel_of_strips({x, 0, 0}, kUp, {y * c, 0, y * s}, {s, 0, -c}); };
    Wide sum = 0, low = 0;  // the kernel changes within lengths of the point's distance from the edge
    for (const Wide end : {x / 3, x, 3 * x, v}) {
      sum += integrate(low, std::min(end, v), at);
      low = std::min(end, v);
    }
    return sum;
  };
  const Wide opposite = std::min(u, v);
  return (integrate(0, opposite, from) + integrate(opposite, u, from)) / u;
}

/// Share of what a point of the first circle sends between the two tangents to the second, cut by its horizon.
Wide between_tangents(Wide distance, Wide to_centre, Wide radius) {
  const Wide half = std::asin(radius / distance);
  const Wide low = std::max(to_centre - half, -kWidePi / 2), high = std::min(to_centre + half, kWidePi / 2);
  return integrate(low, high, [](Wide a) { return std::cos(a) / 2; });
}

/// Mean over a circle of radius r1 of what arrives at a circle of radius r2 whose centre is d away.
Wide circles(Wide r1, Wide r2, Wide d) {
  // The point at the angle t sees all of the second where d cos t ≥ r1 + r2, nothing where d cos t ≤ r1 − r2.
  const auto at = [&](Wide t) {
    const Wide x = d - r1 * std::cos(t), y = -r1 * std::sin(t);  // to the centre
    return between_tangents(std::hypot(x, y), std::atan2(y, x) - t, r2);
  };
  const Wide all = std::acos((r1 + r2) / d), nothing = std::acos((r1 - r2) / d);
  return (integrate(0, all, at) + integrate(all, nothing, at)) / kWidePi;
}

/// Inside of a circle, between points an angle apart: the chord c has cosines c/2r at both ends.
Wide inside_circle(Wide r, Wide angle) {
  return std::abs(2 * r * std::sin(angle / 2)) / (8 * r * r);
}

}  // namespace

Truths truths_of_strips() {
  Truths t;
  t["B-71"] = [](const double* p) {
    return integrate(p[0] * kDegree, p[1] * kDegree, [](Wide a) { return std::cos(a) / 2; });
  };
  t["wedge-half-plane"] = [](const double* p) {
    // the element at 1 from the edge; the half-plane beyond 1 by y = 1/u
    const Wide c = std::cos(p[0] * kDegree), s = std::sin(p[0] * kDegree);
    const auto at = [&](Wide y) { return kernel_of_strips({1, 0, 0}, kUp, {y * c, 0, y * s}, {s, 0, -c}); };
    return integrate(0, 1, at) + integrate(0, 1, [&](Wide u) { return at(1 / u) / (u * u); });
  };
  t["wedge-plate"] = [](const double* p) {
    const Wide c = std::cos(p[2] * kDegree), s = std::sin(p[2] * kDegree);
    return integrate(0, p[1], [&](Wide y) {
      return kernel_of_strips({p[0], 0, 0}, kUp, {y * c, 0, y * s}, {s, 0, -c});
    });
  };
  t["opposite-plates"] = [](const double* p) { return plates(0, p[0], 0, p[0], p[1]); };
  t["centred-plates"] = [](const double* p) {
    return plates(-p[0] / Wide(2), p[0] / Wide(2), -p[1] / Wide(2), p[1] / Wide(2), p[2]);
  };
  t["shifted-plates"] = [](const double* p) { return plates(0, p[0], p[1], p[2], p[3]); };
  t["perpendicular-plates"] = [](const double* p) { return hinge(p[0], p[1], kWidePi / 2); };
  t["C-5"] = [](const double* p) { return hinge(1, 1, p[0] * kDegree); };
  t["C-5a"] = [](const double* p) { return hinge(p[0], p[1], p[2] * kDegree); };
  t["screened-plates"] = [](const double* p) {
    // x sees y past the screen's right end where the line's middle is beyond it: x + y > d
    const Wide w = p[0], d = p[1], h = p[2];
    return 2 / w * integrate(d - w / 2, w / 2, [&](Wide x) {
             return integrate(d - x, w / 2, [&](Wide y) { return kernel_of_strips({x, 0, 0}, kUp, {y, 0, h}, kDown); });
           });
  };
  t["strip-long-cylinder"] = [](const double* p) {
    const Wide distance = std::hypot(Wide(p[0]), Wide(p[1]));
    return between_tangents(distance, std::atan2(Wide(p[1]), Wide(p[0])), p[2]);
  };
  t["equal-tubes"] = [](const double* p) { return circles(p[0], p[0], 2 * Wide(p[0]) + p[1]); };
  t["unequal-tubes"] = [](const double* p) { return circles(p[0], p[1], Wide(p[0]) + p[1] + p[2]); };
  t["tube-plate"] = [](const double* p) {
    return integrate(
               p[2], p[3],
               [&](Wide x) { return between_tangents(std::hypot(x, Wide(p[0])), std::atan2(-x, Wide(p[0])), p[1]); }) /
           (2 * kWidePi * p[1]);
  };
  t["plane-tube-row"] = [](const double* p) {
    // A beam at the angle a meets the tubes but for the share 1 − d/(s cos a) of the plane, as long as that is positive.
    const Wide q = Wide(p[0]) / p[1];
    return 1 - integrate(0, std::acos(q), [&](Wide a) { return std::cos(a) - q; });
  };
  t["tube-in-tube-self"] = [](const double* p) {
    const Wide r = p[1], seen = 2 * std::acos(Wide(p[0]) / r);
    return 2 * integrate(0, seen, [&](Wide a) { return r * inside_circle(r, a); });
  };
  t["arc-self"] = [](const double* p) {
    const Wide r = p[0], beta = p[1] * kDegree;  // the angle between two points of the arc has a triangular density
    return integrate(0, 2 * beta, [&](Wide a) { return 2 * (2 * beta - a) * r * inside_circle(r, a); }) / (2 * beta);
  };
  t["groove-self"] = [](const double* p) {
    const Wide w = p[0], h = p[1];
    const Wide bottom = 2 * w * hinge(w, h, kWidePi / 2);                           // to both walls
    const Wide walls = 2 * h * (hinge(h, w, kWidePi / 2) + plates(0, h, 0, h, w));  // each to bottom and wall
    return (bottom + walls) / (w + 2 * h);
  };
  t["triangular-duct"] = [](const double* p) {
    const Wide a = p[0], b = p[1], c = p[2];
    return hinge(a, b, std::acos((a * a + b * b - c * c) / (2 * a * b)));
  };
  return t;
}

}  // namespace etendue::oracle
