// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/phong.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "etendue/core/rounding.hpp"
#include "etendue/reflectance/lambert.hpp"
#include "optics/incidence.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr double u = kUnitRoundoff;

// CLAIM      IU.2-2, IU.2-3: the diffuse share is N·L for unit vectors, in any frame.
// ORACLE     the scalar product at 600 bits.
// TOLERANCE  lambert_error().
TEST(Lambert, IsTheCosineOfTheAngle) {
  proves({"IU.2-2", "IU.2-3"}, Oracle::closed_form, "scalar product at 600 bits");
  Directions random(2401);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 n = random.unit(), l = random.unit();
    EXPECT_TRUE(within(oracle::distance_to_lambert(triple(n), triple(l), lambert(n, l)), lambert_error()));
  }
}

// CLAIM      E8: N·L is the angle's cosine: at 60° 0.5, not 1.047 as "gives the angle" would have it.
// ORACLE     closed form: cos 60° = 1/2, 60° = π/3.
// TOLERANCE  lambert_error() and the rounding of the light's direction.
TEST(Lambert, IsNotTheAngle) {
  proves({"E8", "IU.2-3"}, Oracle::closed_form, "cos 60° = 1/2");
  const Vec3 n(0, 0, 1), l(std::sqrt(0.75), 0, 0.5);
  EXPECT_TRUE(near(60 * kDegree, 1.047, 5e-4));
  EXPECT_TRUE(near(lambert(n, l), 0.5, lambert_error() + kInputRounding));
}

// CLAIM      G1: the printed k_d I_p (N·L) takes light away where the source is behind: −0.2 at 120° for k_d = 0.4.
//            The code gives nothing there.
// ORACLE     closed form: cos 120° = −1/2.
// TOLERANCE  none for the clamp; the rounding of the input for the printed form.
TEST(Lambert, IsZeroForALightBehindTheSurface) {
  proves({"G1", "IU.2-3"}, Oracle::closed_form, "cos 120° = −1/2");
  const Vec3 n(0, 0, 1), behind(std::sqrt(0.75), 0, -0.5);
  EXPECT_TRUE(near(0.4 * n.dot(behind), -0.2, kInputRounding));
  EXPECT_TRUE(near(0.4 * lambert(n, behind), 0, 0));
  EXPECT_TRUE(
      all_agree(accepted([&] { return lambert(2 * n, behind); }) + accepted([&] { return lambert(n, 0.5 * n); }), 2));
}

// CLAIM      IU.2.7.1, IU.2-6, IU.2-7: the lobe is cosⁿ φ with φ between R and V, for n from 1 to 200, at any place
//            of the light and the viewer, and next to the lobe's peak and foot.
// ORACLE     the power of R·V at 600 bits.
// TOLERANCE  phong_error(n).
TEST(Phong, IsThePowerOfTheCosine) {
  proves({"IU.2.7.1", "IU.2-6", "IU.2-7"}, Oracle::closed_form, "(R·V)ⁿ at 600 bits");
  Directions random(2402);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 n = random.unit(), l = random.unit(), mirrored = reflect(-l, n);
    const double away = i % 3 == 0 ? 0 : std::exp2(-random.uniform(0, 30));
    const Vec3 v = i % 3 == 2 ? random.unit() : (mirrored + away * random.unit()).normalized();
    const double exponent = i % 2 == 0 ? random.integer(1, 200) : random.uniform(1, 200);
    const double distance =
        oracle::distance_to_phong(triple(n), triple(l), triple(v), exponent, phong(n, l, v, exponent));
    EXPECT_TRUE(within(distance, phong_error(exponent)));
  }
}

// CLAIM      IU.2.7, E9: the directed reflection peaks at V = R, is the same all round R ("centred on R"), and falls
//            away from it; the duller, the wider: half of the peak is reached at cos φ = 2^(−1/n).
// ORACLE     closed form: cosⁿ φ in coordinates around R.
// TOLERANCE  phong_error(n), and n times the 8 u with which the viewer is placed.
TEST(Phong, PeaksAtTheMirrorDirectionAndIsRoundAboutIt) {
  proves({"IU.2.7", "IU.2.7.1", "E9"}, Oracle::closed_form, "cosⁿ φ in coordinates around R");
  Directions random(2403);
  double previous_width = 4;
  for (const double exponent : {1.0, 3.0, 10.0, 100.0, 200.0}) {
    const double half_width = std::acos(std::exp2(-1 / exponent)), tolerance = phong_error(exponent) + 8 * u * exponent;
    EXPECT_LT(half_width, previous_width);
    previous_width = half_width;
    for (int i = 0; i < 300; ++i) {
      const Vec3 n = random.unit(), l = (random.unit() + 1.5 * n).normalized(), r = reflect(-l, n);
      EXPECT_TRUE(near(phong(n, l, r, exponent), 1, tolerance));
      const Vec3 v = std::cos(half_width) * r + std::sin(half_width) * random.orthogonal_to(r);
      EXPECT_TRUE(near(phong(n, l, v.normalized(), exponent), 0.5, tolerance));
      const double phi = random.uniform(0, 1.5);
      const Vec3 w = std::cos(phi) * r + std::sin(phi) * random.orthogonal_to(r);
      EXPECT_TRUE(near(phong(n, l, w.normalized(), exponent), std::pow(std::cos(phi), exponent), tolerance));
    }
  }
}

// CLAIM      IU.2.7.1: n → ∞ is a mirror: 0.1° away from R the lobe of n = 10⁸ is gone, while at R it is one.
// ORACLE     closed form: cos(0.1°)^(10⁸) = exp(−152.3…) < 1e-60.
// TOLERANCE  1e-60 is the claim; at R, n times the error of R·V: phong_error(n).
TEST(Phong, BecomesAMirrorForLargeExponents) {
  proves({"IU.2.7.1"}, Oracle::closed_form, "cosⁿ of 0.1°");
  const Vec3 n(0, 0, 1), r(0.6, 0, 0.8), l(-0.6, 0, 0.8);
  const double phi = 0.1 * kDegree;
  const Vec3 beside = std::cos(phi) * r + std::sin(phi) * Vec3(0, 1, 0);
  EXPECT_TRUE(near(phong(n, l, r, 1e8), 1, phong_error(1e8)));
  EXPECT_TRUE(within(phong(n, l, beside, 1e8), 1e-60));
}

// CLAIM      G2: with an even n the printed (R·V)ⁿ shines where R·V < 0: (−0.5)² = +0.25. The code gives nothing
//            there, nor for a light behind the surface.
// ORACLE     closed form.
// TOLERANCE  none for the clamps; two roundings of the input for the printed form.
TEST(Phong, IsZeroOnTheFarSideOfTheLobe) {
  proves({"G2", "IU.2-7"}, Oracle::closed_form, "(−1/2)² = 1/4");
  const Vec3 n(0, 0, 1), l(0, 0, 1), v(std::sqrt(0.75), 0, -0.5);  // R = N
  EXPECT_TRUE(near(std::pow(reflect(-l, n).dot(v), 2), 0.25, 2 * kInputRounding));
  EXPECT_TRUE(near(phong(n, l, v, 2), 0, 0));
  const Vec3 behind(0.6, 0, -0.8), along_mirror = reflect(-behind, n);
  EXPECT_TRUE(near(phong(n, behind, along_mirror, 2), 0, 0));
  EXPECT_TRUE(near(phong(n, Vec3(1, 0, 0), Vec3(-1, 0, 0), 2), 0, 0));
}

// CLAIM      IU.2.7.1: Blinn's form is the power of N·H; in the plane of the normal and the light its angle is half of φ, so that
//            with four times the exponent it is Phong's lobe but for terms of n φ⁴.
// ORACLE     closed form: the power of N·H in long double; cos φ = 2 cos²(φ/2) − 1.
// TOLERANCE  blinn_error(n); ln cosⁿ φ − 4n ln cos(φ/2) = −n φ⁴/16 (1 + O(φ²)) against terms e^(−nφ²/2): doubled.
TEST(Blinn, IsPhongsLobeWithFourTimesTheExponent) {
  proves({"IU.2.7.1"}, Oracle::closed_form, "(N·H)ⁿ in long double; Phong's lobe in the plane of incidence");
  Directions random(2404);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 n = random.unit(), l = (random.unit() + n).normalized(), v = (random.unit() + n).normalized();
    if (n.dot(l) <= 0 || n.dot(v) <= 0) continue;
    const double exponent = random.uniform(1, 200);
    using Long = Eigen::Matrix<long double, 3, 1>;
    const Long m = n.cast<long double>().normalized();
    const Long h = (l.cast<long double>().normalized() + v.cast<long double>().normalized()).normalized();
    const double right = static_cast<double>(std::pow(std::min(1.0L, m.dot(h)), static_cast<long double>(exponent)));
    EXPECT_TRUE(near(blinn(n, l, v, exponent), right, blinn_error(exponent)));
  }
  const Vec3 n(0, 0, 1), l(-0.5, 0, std::sqrt(0.75));  // mirrored at 30°
  for (const double exponent : {50.0, 100.0, 200.0}) {
    for (double phi = -2 / std::sqrt(exponent); phi < 2 / std::sqrt(exponent); phi += 0.01) {
      const Vec3 v(std::sin(30 * kDegree + phi), 0, std::cos(30 * kDegree + phi));
      const double tolerance = exponent * std::pow(phi, 4) / 8 + blinn_error(4 * exponent) + phong_error(exponent);
      EXPECT_TRUE(near(blinn(n, l, v, 4 * exponent), phong(n, l, v, exponent), tolerance)) << phi;
    }
  }
  EXPECT_TRUE(near(blinn(n, Vec3(0.6, 0, -0.8), n, 5), 0, 0));
  EXPECT_TRUE(near(blinn(n, n, Vec3(0.6, 0, -0.8), 5), 0, 0));
  EXPECT_TRUE(
      all_agree(accepted([&] { return blinn(2 * n, n, n, 5); }) + accepted([&] { return blinn(n, n, n, 0.5); }), 2));
}

// CLAIM      IU.2.7.1: the contract of phong() is enforced.
// ORACLE     identity: the documented domain.
// TOLERANCE  none.
TEST(Phong, RefusesWhatIsNotInItsDomain) {
  proves({"IU.2.7.1"}, Oracle::identity, "the documented domain");
  const Vec3 z(0, 0, 1);
  const auto at = [](const Vec3& n, const Vec3& l, const Vec3& v, double exponent) {
    return accepted([=] { return phong(n, l, v, exponent); });
  };
  EXPECT_TRUE(all_agree(at(2 * z, z, z, 5) + at(z, 2 * z, z, 5) + at(z, z, 2 * z, 5) + at(z, z, z, 0.5) +
                            at(z, z, z, std::nan("")) + at(z, z, z, INFINITY),
                        6));
}

// CLAIM      IU.2.7.1: light and viewer may change places (Helmholtz): R·V = 2 (N·L)(N·V) − L·V is the same of both, and so is Blinn's N·H.
// ORACLE     identity: both orders.
// TOLERANCE  phong_error(n) and blinn_error(n), twice.
TEST(Phong, IsReciprocal) {
  proves({"IU.2.7.1"}, Oracle::identity, "light and viewer change places");
  Directions random(2412);
  for (int i = 0; i < 5000; ++i) {
    const Vec3 n = random.unit();
    Vec3 l = random.unit(), v = random.unit();
    if (n.dot(l) < 0) l = -l;
    if (n.dot(v) < 0) v = -v;
    const double exponent = random.uniform(1, 200);
    EXPECT_TRUE(near(phong(n, l, v, exponent), phong(n, v, l, exponent), 2 * phong_error(exponent)));
    EXPECT_TRUE(near(blinn(n, l, v, exponent), blinn(n, v, l, exponent), 2 * blinn_error(exponent)));
  }
}

}  // namespace
}  // namespace etendue::validation
