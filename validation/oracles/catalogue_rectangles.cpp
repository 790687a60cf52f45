// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "oracles/catalogue_truth.hpp"
#include "oracles/pair_form_factor.hpp"

namespace etendue::oracle {

namespace {

constexpr Wide kDegree = kWidePi / 180;

/// ∫∫ f(y − x) over x ∈ [a, b], y ∈ [c, d]: f against the density of the difference, linear between four breaks.
/// `peak` is the width of f around 0.
template <class F>
Wide over_difference(Wide a, Wide b, Wide c, Wide d, Wide peak, const F& f) {
  std::vector<Wide> breaks{c - b, d - b, c - a, d - a};
  for (const Wide at : {-peak, Wide(0), peak}) {
    if (at > c - b && at < d - a) breaks.push_back(at);
  }
  std::sort(breaks.begin(), breaks.end());
  const auto density = [&](Wide u) { return std::max<Wide>(0, std::min(b, d - u) - std::max(a, c - u)); };
  Wide sum = 0;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    sum += integrate_coarse(breaks[i], breaks[i + 1], [&](Wide u) { return density(u) * f(u); });
  }
  return sum;
}

/// Area-free exchange between parallel rectangles at the distance z.
Wide parallel(const Wide* x, const Wide* y, const Wide* u, const Wide* v, Wide z) {
  return over_difference(x[0], x[1], u[0], u[1], z, [&](Wide s) {
    return over_difference(y[0], y[1], v[0], v[1], std::hypot(s, z), [&](Wide t) {
      const Wide square = s * s + t * t + z * z;
      return z * z / (kWidePi * square * square);
    });
  });
}

Wide pair(const std::vector<Point>& from, const std::vector<Point>& to) {
  constexpr double kExactPlanarity = 1e-13;
  return pair_form_factor(from, to, kExactPlanarity).factor;
}

/// From [x0,x1] × [y0,y1] on the floor to [t0,t1] × [v0,v1] in a plane that meets it at the angle phi in x = 0.
Wide hinged(double x0, double x1, double y0, double y1, double t0, double t1, double v0, double v1, Wide phi) {
  const double c = static_cast<double>(std::cos(phi)), s = static_cast<double>(std::sin(phi));
  return pair({{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}, {x0, y1, 0}},
              {{t0 * c, v0, t0 * s}, {t0 * c, v1, t0 * s}, {t1 * c, v1, t1 * s}, {t1 * c, v0, t1 * s}});
}

Wide opposite(Wide a, Wide b, Wide c) {
  const Wide x[] = {0, a}, y[] = {0, b};
  return parallel(x, y, x, y, c) / (a * b);
}

}  // namespace

Truths truths_of_rectangles() {
  Truths t;
  t["C-11"] = [](const double* p) { return opposite(p[0], p[1], p[2]); };
  t["C-14"] = [](const double* p) { return hinged(0, p[0], 0, p[2], 0, p[1], 0, p[2], kWidePi / 2); };
  t["parallel-rectangles"] = [](const double* p) {
    const Wide x[] = {p[0], p[1]}, y[] = {p[2], p[3]}, u[] = {p[4], p[5]}, v[] = {p[6], p[7]};
    return parallel(x, y, u, v, p[8]) / ((x[1] - x[0]) * (y[1] - y[0]));
  };
  t["perpendicular-rectangles"] = [](const double* p) {
    return hinged(p[0], p[1], p[2], p[3], p[6], p[7], p[4], p[5], kWidePi / 2);
  };
  t["hinged-rectangles"] = [](const double* p) { return hinged(0, p[1], 0, p[2], 0, p[0], 0, p[2], p[3] * kDegree); };
  t["strip-opposite-rectangle"] = [](const double* p) {
    const Wide a = p[0], b = p[1], c = p[2];
    return integrate(0, a,
                     [&](Wide x) {
                       return over_difference(0, b, 0, b, c, [&](Wide u) {
                         const Wide square = x * x + u * u + c * c;
                         return c * c / (kWidePi * square * square);
                       });
                     }) /
           b;
  };
  t["strip-standing-rectangle"] = [](const double* p) {
    const Wide a = p[0], b = p[1], c = p[2];
    return integrate(0, a,
                     [&](Wide z) {
                       return over_difference(0, b, 0, b, c, [&](Wide u) {
                         const Wide square = z * z + u * u + c * c;
                         return c * z / (kWidePi * square * square);
                       });
                     }) /
           b;
  };
  t["box-floor-walls"] = [](const double* p) { return 1 - opposite(p[0], p[1], p[2]); };
  t["box-walls-self"] = [](const double* p) {
    const Wide a = p[0], b = p[1], c = p[2];
    return 1 - a * b / ((a + b) * c) * (1 - opposite(a, b, c));
  };
  t["cube-opposite"] = [](const double*) { return opposite(1, 1, 1); };
  t["cube-adjacent"] = [](const double*) { return (1 - opposite(1, 1, 1)) / 4; };
  t["corner-tetrahedron-legs"] = [](const double*) {
    return pair({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  };
  t["corner-tetrahedron-oblique"] = [](const double*) {
    return pair({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}});
  };
  t["tetrahedron"] = [](const double*) {  // on four corners of a cube
    return pair({{0, 0, 0}, {1, 0, 1}, {1, 1, 0}}, {{0, 0, 0}, {1, 1, 0}, {0, 1, 1}});
  };
  return t;
}

}  // namespace etendue::oracle
