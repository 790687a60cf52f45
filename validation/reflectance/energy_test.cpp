// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "etendue/reflectance/phong.hpp"
#include "reflectance/facet_surfaces.hpp"
#include "support/evidence.hpp"
#include "support/long_run.hpp"

// How much of the light from one direction a surface sends back, by adaptive cubature of its law over the hemisphere.
namespace etendue::validation {
namespace {

constexpr double kPi = std::numbers::pi, kRadians = kPi / 180;
constexpr std::array<double, 6> kIncidence{0, 30, 60, 75, 85, 89};  // [degrees]
constexpr std::array<double, 6> kExponents{1, 2, 5, 20, 100, 200};

/// Requested relative errors of each of the nested rules, which stop where the estimates of Gauss and Kronrod agree to it: of
/// lobes, whose only kink is cut, and of facets, whose kinks lie anywhere.
constexpr double kOfLobes = 1e-10, kOfFacets = 1e-5;

Vec3 light_at(double degrees) {
  return {-std::sin(degrees * kRadians), 0, std::cos(degrees * kRadians)};
}

/// ∫ of f over [a, b], in parts that end where the cuts lie that are within.
template <class F>
double in_parts(double a, double b, std::array<double, 2> cuts, double requested, const F& f) {
  constexpr unsigned kDepth = 10;
  std::ranges::sort(cuts);
  double sum = 0, from = a;
  for (const double to : {cuts[0], cuts[1], b}) {
    if (!(to > from && to <= b)) continue;
    sum += boost::math::quadrature::gauss_kronrod<double, 15>::integrate(f, from, to, kDepth, requested);
    from = to;
  }
  return sum;
}

/// ∫ f(V) (N·V) dω over the hemisphere about z, of an f that is symmetric to the plane y = 0; cut at the mirror direction R, where
/// lobes are steepest, and where R·V = 0, where Phong's ends.
template <class F>
double reflected(double incidence_deg, double requested, const F& f) {
  constexpr double kLobe = 0.3;
  const double mirror = incidence_deg * kRadians;
  const auto ring = [&](double angle) {
    const double sine = std::sin(angle), cosine = std::cos(angle);
    const auto at = [&](double turn) {
      return f(Vec3(sine * std::cos(turn), sine * std::sin(turn), cosine).normalized());
    };
    const double horizon =
        std::acos(-cosine * std::cos(mirror) / (sine * std::sin(mirror)));  // NaN where there is none
    return 2 * sine * cosine * in_parts(0, kPi, {kLobe, horizon > 0 ? horizon : kPi}, requested, at);
  };
  return in_parts(0, kPi / 2, {mirror, kPi / 2 - mirror}, requested, ring);
}

/// By how much the share that is sent back exceeds one, at the angle of incidence where it is greatest; 0 where it never does.
template <class F>
double excess(double requested, const F& law) {
  double most = 0;
  for (const double degrees : kIncidence) {
    const Vec3 light = light_at(degrees);
    most = std::max(most, reflected(degrees, requested, [&](const Vec3& view) { return law(light, view); }) - 1);
  }
  return most;
}

// CLAIM      IU.2-3, IU.2.7.1, IU.4.2.2: ∫ f cos ≤ 1 for every law as a density of reflection: Lambert's 1/π, Phong's (n + 2)/2π cosⁿ φ, Blinn's
//            (n + 2)(n + 4)/(8π (n + 2^(−n/2))) (N·H)ⁿ, which send back all light along the normal; facets that mirror all.
// ORACLE     closed form along the normal; for the inequality adaptive cubature, nested Gauss–Kronrod rules.
// TOLERANCE  4 times the error that was requested of each rule: two of them nested, and as much again.
TEST(Energy, IsNotMadeByAnyLaw) {
  proves({"IU.2-3", "IU.2.7.1", "IU.4.2.2"}, Oracle::closed_form,
         "adaptive cubature, six angles; albedo along the normal");
  const Vec3 n = Vec3::UnitZ();
  const auto whole = [&](double requested, const auto& law) {
    return reflected(0, requested, [&](const Vec3& v) { return law(n, v); });
  };
  const auto matt = [](const Vec3&, const Vec3&) { return 1 / kPi; };
  EXPECT_TRUE(near(whole(kOfLobes, matt), 1, 4 * kOfLobes));
  EXPECT_TRUE(within(excess(kOfLobes, matt), 4 * kOfLobes));
  for (const double e : kExponents) {
    const auto by_phong = [&](const Vec3& l, const Vec3& v) { return (e + 2) / (2 * kPi) * phong(n, l, v, e); };
    const double scale = (e + 2) * (e + 4) / (8 * kPi * (e + std::exp2(-e / 2)));
    const auto by_blinn = [&](const Vec3& l, const Vec3& v) { return scale * blinn(n, l, v, e); };
    EXPECT_TRUE(near(whole(kOfLobes, by_phong), 1, 4 * kOfLobes)) << e;
    EXPECT_TRUE(near(whole(kOfLobes, by_blinn), 1, 4 * kOfLobes)) << e;
    EXPECT_TRUE(within(excess(kOfLobes, by_phong), 4 * kOfLobes)) << e;
    EXPECT_TRUE(within(excess(kOfLobes, by_blinn), 4 * kOfLobes)) << e;
  }
  std::size_t surface = 0, judged = 0;
  for (const FacetSurface& of : kFacetSurfaces) {
    for (const double m : {0.05, 0.1, 0.3, 0.7, 1.5}) {
      if (surface++ % every(4) != 0) continue;  // of five roughnesses and five surfaces: each comes once
      const Facets facets(of.distribution, m, of.shadowing);
      const auto law = [&](const Vec3& l, const Vec3& v) { return cook_torrance(facets, n, l, v); };
      EXPECT_TRUE(within(excess(kOfFacets, law), 4 * kOfFacets)) << m;
      EXPECT_TRUE(holds(whole(kOfFacets, law) > 0.1)) << m;  // and is no law that sends nothing
      ++judged;
    }
  }
  EXPECT_GE(judged, 5u);
}

// CLAIM      IU.2-7: equation 2-7 does not weigh the lobe by N·L, so that light that grazes gives more than arrives: of Phong's lobe with
//            n = 1 and k_s = 1 12 times as much at 89° (E/π cos θ, E by the oracle); n = 100 stays below 6 %.
// ORACLE     closed form: ∫ max(0, R·V) max(0, N·V) dω = 2/3 (sin θ + (π − θ) cos θ).
// TOLERANCE  4 kOfLobes of the value.
TEST(Energy, IsMadeByLobesUnderGrazingLight) {
  proves({"IU.2-7"}, Oracle::closed_form, "product of two clamped cosines, integrated");
  const Vec3 n = Vec3::UnitZ();
  for (const double degrees : kIncidence) {
    const Vec3 light = light_at(degrees);
    const double theta = degrees * kRadians, arriving = kPi * light.z();
    const auto share = [&](double exponent) {
      return reflected(degrees, kOfLobes, [&](const Vec3& v) { return phong(n, light, v, exponent); }) / arriving;
    };
    const double right = 2.0 / 3 * (std::sin(theta) + (kPi - theta) * std::cos(theta)) / arriving;
    EXPECT_TRUE(near(share(1), right, 4 * kOfLobes * right)) << degrees;
    EXPECT_TRUE(holds((degrees < 70) == (share(1) < 1))) << degrees;
    EXPECT_TRUE(holds(share(100) < 0.06)) << degrees;
  }
}

}  // namespace
}  // namespace etendue::validation
