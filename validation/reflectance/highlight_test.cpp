// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/highlight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

#include "etendue/core/rounding.hpp"
#include "etendue/reflectance/cosines.hpp"
#include "etendue/reflectance/phong.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"

// The laws of the directed reflection as both methods of rendering use them.
namespace etendue::validation {
namespace {

using Long = long double;
using Long3 = Eigen::Matrix<Long, 3, 1>;
constexpr Long kWidePi = std::numbers::pi_v<Long>;

Vec3 above(CounterRandom& random) {
  const double z = random.between(0.05, 1), turn = random.between(0, 6.2), r = std::sqrt(1 - z * z);
  return Vec3(r * std::cos(turn), r * std::sin(turn), z).normalized();
}

/// Fresnel's factor of a conductor as the text prints it, with a complex angle of refraction.
Long fresnel(Long cosine, std::complex<Long> n) {
  const Long sine = std::sqrt(1 - cosine * cosine);
  const std::complex<Long> inside = std::sqrt(Long(1) - (sine / n) * (sine / n));
  const std::complex<Long> across = (cosine - n * inside) / (cosine + n * inside);
  const std::complex<Long> along = (n * cosine - inside) / (n * cosine + inside);
  return (std::norm(across) + std::norm(along)) / 2;
}

/// Beckmann's facets in V-shaped grooves, written out; and how the result moves with its cosines, relatively.
struct Written {
  Long value, condition;
};
Written written(const Long3& n, const Long3& l, const Long3& v, Long m, std::complex<Long> index) {
  const Long3 h = (l + v).normalized();
  const Long nh = n.dot(h), nl = n.dot(l), nv = n.dot(v), vh = v.dot(h), tan2 = (1 - nh * nh) / (nh * nh);
  const Long d = std::exp(-tan2 / (m * m)) / (kWidePi * m * m * nh * nh * nh * nh);
  const Long g = std::min({Long(1), 2 * nh * nv / vh, 2 * nh * nl / vh});
  return {kWidePi * fresnel(vh, index) * d * g / (4 * nv), 2 / (nh * nh * nh * m * m) + 8 / std::min({nh, nl, nv, vh})};
}

// CLAIM      IU.4.2.2, IU.4.2.2F, IU.4.2.3: local_reflection() with facets sends k_s π F D G/(4 N·V) of each light, F channel by channel;
//            reflection_of_cosines() the same from five products.
// ORACLE     closed form: D, G and F written out in long double, F with a complex angle.
// TOLERANCE  kFacetError twice, for D G and F; and 32 u of each cosine, times what the result moves with them.
TEST(Highlight, OfFacetsIsCookAndTorrances) {
  proves({"IU.4.2.2", "IU.4.2.2F", "IU.4.2.3"}, Oracle::closed_form, "2,000 directions, written out in long double");
  constexpr std::uint64_t kSeed = 20261123;
  uses_seed(kSeed);
  CounterRandom random(kSeed);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 normal = Vec3::UnitZ(), to_light = above(random), to_viewer = above(random);
    const double m = random.scale(0.2, 2), k_s = random.between(0.1, 1);
    FacetHighlight facets{Facets(FacetDistribution::beckmann, m, FacetShadowing::grooves)};
    for (int c = 0; c < 3; ++c) {
      facets.eta[c] = random.scale(0.2, 4);
      facets.k[c] = k % 2 == 0 ? 0 : random.between(0, 5);
    }
    if (k % 2 == 0) facets.eta += 1;  // dielectrics, entered from outside
    const Highlight law = facets;
    const LocalReflection surface{Eigen::Array3d::Zero(), Eigen::Array3d::Zero(), k_s, 1, &law};
    const Eigen::Array3d intensity(1, 0.5, 0.25);
    const Eigen::Array3d sent = local_reflection(surface, normal, to_viewer, Eigen::Array3d::Zero(),
                                                 std::array{IncidentLight{to_light, intensity, 1}});
    const LightCosines cosines = all_light_cosines(normal, to_light, to_viewer);
    const Eigen::Array3d again =
        reflection_of_cosines(surface, Eigen::Array3d::Zero(), std::array{cosines}, std::array{intensity});
    for (int c = 0; c < 3; ++c) {
      const Written truth =
          written(normal.cast<Long>(), to_light.cast<Long>(), to_viewer.cast<Long>(), m, {facets.eta[c], facets.k[c]});
      const double expected = k_s * intensity[c] * static_cast<double>(truth.value);
      const double tolerance = expected * (2 * kFacetError + 32 * kUnitRoundoff * static_cast<double>(truth.condition));
      EXPECT_TRUE(near(sent[c], expected, tolerance + 1e-300)) << k;
      EXPECT_TRUE(near(again[c], sent[c], 4 * kUnitRoundoff * expected));
    }
  }
}

// CLAIM      IU.2.7.1, IU.4.2.2: N·H, V·H and N·V are within what all_light_cosines() states.
// ORACLE     closed form: the products of the given vectors in long double.
// TOLERANCE  16 u, as stated, while |L + V| ≥ 1/4.
TEST(Highlight, RestsOnProductsOfVectors) {
  proves({"IU.2.7.1", "IU.4.2.2"}, Oracle::closed_form, "2,000 directions in long double");
  CounterRandom random(7);
  uses_seed(7);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 normal = above(random), to_light = above(random), to_viewer = above(random);
    const Long3 n = normal.cast<Long>(), l = to_light.cast<Long>(), v = to_viewer.cast<Long>();
    if ((l + v).norm() < 0.25L) continue;
    const Long3 h = (l + v) / (l + v).norm();
    const LightCosines cosines = all_light_cosines(normal, to_light, to_viewer);
    EXPECT_TRUE(near(cosines.halfway, static_cast<double>(n.dot(h)), 16 * kUnitRoundoff));
    EXPECT_TRUE(near(cosines.tilt, static_cast<double>(v.dot(h)), 16 * kUnitRoundoff));
    EXPECT_TRUE(near(cosines.view, static_cast<double>(n.dot(v)), 16 * kUnitRoundoff));
  }
}

// CLAIM      IU.2.7.1, IU.4.2.2F: with Fresnel's factor for W(θ) local_reflection() and reflection_of_cosines() send k_s F(θ) (R·V)ⁿ of each
//            channel; weighted_phong() the same for any weight, which it asks for cos θ, and not where nothing is mirrored.
// ORACLE     closed form: F with a complex angle and the power, in long double.
// TOLERANCE  phong_error(), and kFacetError for F.
TEST(Highlight, OfPhongMayDependOnTheAngle) {
  proves({"IU.2.7.1", "IU.4.2.2F"}, Oracle::closed_form, "2,000 directions, written out in long double");
  CounterRandom random(6);
  uses_seed(6);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 to_light = above(random), to_viewer = above(random);
    FresnelHighlight coat{random.scale(1, 200)};
    coat.eta = Eigen::Array3d(1.5, 0.9, random.scale(1.1, 4));
    coat.k = Eigen::Array3d(0, 2.5, random.between(0, 5));
    const Highlight law = coat;
    const LocalReflection surface{Eigen::Array3d::Zero(), Eigen::Array3d::Zero(), 0.5, 1, &law};
    const Eigen::Array3d dark = Eigen::Array3d::Zero(), one = Eigen::Array3d::Ones();
    const auto sent =
        local_reflection(surface, Vec3::UnitZ(), to_viewer, dark, std::array{IncidentLight{to_light, one, 1}});
    const auto again = reflection_of_cosines(
        surface, dark, std::array{all_light_cosines(Vec3::UnitZ(), to_light, to_viewer)}, std::array{one});
    const Long3 l = to_light.cast<Long>(), v = to_viewer.cast<Long>();
    const Long lobe = std::pow(std::max(Long(0), 2 * l.z() * v.z() - l.dot(v)), static_cast<Long>(coat.exponent));
    for (int c = 0; c < 3; ++c) {
      const Long f = fresnel(l.z(), {coat.eta[c], coat.k[c]});
      const double expected = static_cast<double>(f * lobe / 2),
                   bound = phong_error(coat.exponent) + kFacetError * expected;
      EXPECT_TRUE(near(sent[c], expected, bound));
      EXPECT_TRUE(near(again[c], expected, bound));
      const auto weight = [&](double cosine) {
        return static_cast<double>(fresnel(cosine, {coat.eta[c], coat.k[c]})) / 2;
      };
      EXPECT_TRUE(near(weighted_phong(Vec3::UnitZ(), to_light, to_viewer, coat.exponent, weight), expected, bound));
    }
  }
  const auto asked = [](double) -> double { throw std::logic_error("asked"); };
  EXPECT_TRUE(holds(weighted_phong(Vec3::UnitZ(), Vec3(0.6, 0, -0.8), Vec3::UnitZ(), 2, asked) == 0));
}

// CLAIM      IU.2.7.1: with Blinn's law local_reflection() sends k_s blinn(), reflection_of_cosines() the same.
// ORACLE     program: blinn(), which phong_test.cpp holds against its formula.
// TOLERANCE  blinn_error() for each, and three roundings.
TEST(Highlight, OfBlinnIsThePowerOfTheHalfwayCosine) {
  proves({"IU.2.7.1"}, Oracle::program, "blinn() at 2,000 directions");
  CounterRandom random(5);
  uses_seed(5);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 to_light = above(random), to_viewer = above(random);
    const double exponent = random.scale(1, 200);
    const Highlight law = BlinnHighlight{exponent};
    const LocalReflection surface{Eigen::Array3d::Zero(), Eigen::Array3d::Zero(), 0.5, 3, &law};
    const double expected = 0.5 * blinn(Vec3::UnitZ(), to_light, to_viewer, exponent);
    const double bound = 2 * blinn_error(exponent) + 16 * exponent * kUnitRoundoff;
    const Eigen::Array3d one = Eigen::Array3d::Ones();
    const auto sent = local_reflection(surface, Vec3::UnitZ(), to_viewer, Eigen::Array3d::Zero(),
                                       std::array{IncidentLight{to_light, one, 1}});
    const auto again =
        reflection_of_cosines(surface, Eigen::Array3d::Zero(),
                              std::array{all_light_cosines(Vec3::UnitZ(), to_light, to_viewer)}, std::array{one});
    EXPECT_TRUE(near(sent[0], expected, bound));
    EXPECT_TRUE(near(again[2], expected, bound));
  }
}

// CLAIM      IU.4.2.2: on the scale of I_p facets reflect what Fresnel's factor says of what arrives: π is where it belongs. Nothing is sent
//            from behind or to behind.
// ORACLE     closed form: ∫ over all lights of (1/π) directed dω = F(0) for light that leaves upright from nearly level facets.
// TOLERANCE  facets lean by 0.05: F differs by less than 1e-4 of itself there, and the midpoint rule of 2000 × 64 by less than 1e-5.
TEST(Highlight, ReflectsWhatArrives) {
  proves({"IU.4.2.2"}, Oracle::closed_form, "white sky over a nearly smooth metal");
  FacetHighlight metal{Facets(FacetDistribution::beckmann, 0.05, FacetShadowing::smith)};
  metal.eta = {0.2, 0.9, 1.5};
  metal.k = {3.9, 2.5, 0};
  constexpr int kAngles = 2000, kTurns = 64;
  constexpr double kPi = std::numbers::pi;
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  for (int i = 0; i < kAngles; ++i) {
    const double angle = (i + 0.5) / kAngles * 0.8, area = std::sin(angle) * (0.8 / kAngles) * (2 * kPi / kTurns);
    for (int j = 0; j < kTurns; ++j) {
      const double turn = 2 * kPi * (j + 0.5) / kTurns;
      const Vec3 to_light(std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn), std::cos(angle));
      sum += directed_reflection(metal, all_light_cosines(Vec3::UnitZ(), to_light, Vec3::UnitZ())) * area / kPi;
    }
  }
  for (int c = 0; c < 3; ++c) {
    const double n = metal.eta[c], k = metal.k[c];
    const double upright = ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
    EXPECT_TRUE(near(sum[c], upright, 1.1e-4 * upright)) << c;
  }
  const Vec3 down = Vec3(0.6, 0, -0.8), up = Vec3(0.6, 0, 0.8);
  EXPECT_TRUE(holds((directed_reflection(metal, all_light_cosines(Vec3::UnitZ(), down, up)) == 0).all()));
  EXPECT_TRUE(holds((directed_reflection(metal, all_light_cosines(Vec3::UnitZ(), up, down)) == 0).all()));
  EXPECT_TRUE(
      holds((directed_reflection(BlinnHighlight{2}, all_light_cosines(Vec3::UnitZ(), down, Vec3(-down))) == 0).all()));
}

// CLAIM      Lobes have a finite exponent of at least one.
// ORACLE     identity: what breaks the rule, and what just keeps it.
// TOLERANCE  none: refusals.
TEST(Highlight, HasAnExponentOfOneOrMore) {
  proves({}, Oracle::identity, "two lobes, four broken rules each");
  const LightCosines lit = all_light_cosines(Vec3::UnitZ(), Vec3::UnitZ(), Vec3::UnitZ());
  for (const double exponent : {0.999, -1.0, HUGE_VAL, std::nan("")}) {
    EXPECT_TRUE(refuses([&] { static_cast<void>(directed_reflection(BlinnHighlight{exponent}, lit)); }));
    EXPECT_TRUE(refuses([&] { static_cast<void>(directed_reflection(FresnelHighlight{exponent}, lit)); }));
  }
  EXPECT_NO_THROW(static_cast<void>(directed_reflection(BlinnHighlight{1}, lit)));
  EXPECT_NO_THROW(static_cast<void>(directed_reflection(FresnelHighlight{1}, lit)));
}

}  // namespace
}  // namespace etendue::validation
