// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/facets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "etendue/core/contract.hpp"
#include "etendue/optics/unit.hpp"

namespace etendue {

namespace {

constexpr double kPi = std::numbers::pi;

// exp of less is zero, and so is the distribution.
constexpr double kNothing = 700;

double sine_squared(double cosine) {
  return (1 - cosine) * (1 + cosine);
}

// ∫ exp(−(α/m)²) cos α dω = π ∫ exp(−(α/m)²) sin 2α dα over [0, π/2]: Gauss's rule with eight nodes on sixteen panels, as far
// as the function reaches.
double gaussian_integral(double m) {
  constexpr std::array<std::array<double, 2>, 4> kRule{{{0.1834346424956498, 0.3626837833783620},
                                                        {0.5255324099163290, 0.3137066458778873},
                                                        {0.7966664774136267, 0.2223810344533745},
                                                        {0.9602898564975363, 0.1012285362903763}}};
  constexpr int kPanels = 16;
  constexpr double kReach = 6.5;  // exp(−6.5²) is below a unit in the last place of one
  const double half = 0.5 * std::min(kPi / 2, kReach * m) / kPanels;
  const auto density = [m](double a) { return std::exp(-(a / m) * (a / m)) * std::sin(2 * a); };
  double sum = 0;
  for (int i = 0; i < kPanels; ++i) {
    const double middle = (2 * i + 1) * half;
    for (const auto& [node, weight] : kRule) {
      sum += weight * (density(middle - half * node) + density(middle + half * node));
    }
  }
  return kPi * half * sum;
}

bool is_cosine(double value) {
  return 0 <= value && value <= 1;
}

}  // namespace

Facets::Facets(FacetDistribution distribution, double roughness, FacetShadowing shadowing)
    : kind_(distribution), shadowing_(shadowing), roughness_(roughness), scale_(0) {
  require(kLeastRoughness <= roughness && roughness <= kGreatestRoughness, "Facets: roughness is in [1e-4, 10]");
  require(shadowing != FacetShadowing::smith || distribution != FacetDistribution::gaussian,
          "Facets: Smith's function of the Gaussian distribution has no closed form");
  const double squared = roughness * roughness;
  if (distribution == FacetDistribution::beckmann) scale_ = 1 / (kPi * squared);
  if (distribution == FacetDistribution::ggx) scale_ = squared / kPi;
  if (distribution == FacetDistribution::gaussian) scale_ = 1 / gaussian_integral(roughness);
}

double Facets::distribution(double n_h) const {
  require(is_cosine(n_h), "Facets: cosines are in [0, 1]");
  const double m = roughness_, sines = sine_squared(n_h), cosines = n_h * n_h;
  if (kind_ == FacetDistribution::ggx) {
    const double spread = sines + m * m * cosines;
    return scale_ / (spread * spread);
  }
  const double angle = std::atan2(std::sqrt(sines), n_h) / m;
  if (kind_ == FacetDistribution::gaussian) return scale_ * std::exp(-angle * angle);
  if (!(sines < kNothing * m * m * cosines)) return 0;
  return scale_ * std::exp(-sines / (m * m * cosines)) / (cosines * cosines);
}

double Facets::smith(double cosine) const {
  if (cosine == 1) return 0;
  const double tangent = std::sqrt(sine_squared(cosine)) / cosine, slope = roughness_ * tangent;
  // ½ (√(1 + x²) − 1) without the difference
  if (kind_ == FacetDistribution::ggx) return 0.5 * slope / (std::hypot(1, 1 / slope) + 1 / slope);
  const double a = 1 / slope;
  return 0.5 * (std::exp(-a * a) / (a * std::sqrt(kPi)) - std::erfc(a));
}

double Facets::seen(double n_h, double n_v, double v_h) const {
  require(is_cosine(n_h) && is_cosine(n_v) && is_cosine(v_h), "Facets: cosines are in [0, 1]");
  if (n_v == 0) return 0;
  if (shadowing_ == FacetShadowing::smith) return 1 / (1 + smith(n_v));
  return 2 * n_h * n_v < v_h ? 2 * n_h * n_v / v_h : 1;
}

double Facets::shadowing(double n_h, double n_l, double n_v, double v_h) const {
  if (n_l == 0 || n_v == 0) return 0;
  if (shadowing_ == FacetShadowing::smith) {
    require(is_cosine(n_l) && is_cosine(n_v), "Facets: cosines are in [0, 1]");
    return 1 / (1 + smith(n_l) + smith(n_v));
  }
  return std::min(seen(n_h, n_l, v_h), seen(n_h, n_v, v_h));
}

double Facets::sent(double n_h, double n_l, double n_v, double v_h) const {
  // G falls with N·V, so that their quotient stays in range where both nearly vanish.
  return distribution(n_h) * (shadowing(n_h, n_l, n_v, v_h) / (4 * n_v));
}

double cook_torrance(const Facets& facets, const Vec3& normal, const Vec3& to_light, const Vec3& to_viewer) {
  require(is_unit(normal) && is_unit(to_light) && is_unit(to_viewer), "cook_torrance: all vectors are unit vectors");
  const double n_l = std::min(normal.dot(to_light), 1.0), n_v = std::min(normal.dot(to_viewer), 1.0);
  if (n_l <= 0 || n_v <= 0) return 0;
  const Vec3 halfway = (to_light + to_viewer).normalized();  // not zero: both are on the normal's side
  const double n_h = std::clamp(normal.dot(halfway), 0.0, 1.0), v_h = std::clamp(to_viewer.dot(halfway), 0.0, 1.0);
  return facets.sent(n_h, n_l, n_v, v_h) / n_l;
}

}  // namespace etendue
