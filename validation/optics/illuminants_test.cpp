// SPDX-License-Identifier: Apache-2.0
#include "etendue/optics/illuminants.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "etendue/optics/colour.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

// CLAIM      IU.2.1: sources have spectra. A black body's has its peak where Wien's law says, and in all the power that Stefan and
//            Boltzmann say; the sun's, at 5772 K, is brightest in the visible light, that of incandescent light A rises to the red.
// ORACLE     table: the CODATA values of both constants; rows of illuminant A in CIE 15:2004, table T.1, and its chromaticity.
// TOLERANCE  peak: bracketed by 1 part in 1000. Power: the trapezoidal rule in ln λ from 50 nm to 5 mm, 1e-8. A: half of the last
//            digit of the table; chromaticity to its digits, in steps of 5 nm: 1e-4.
TEST(Illuminants, HaveThePublishedSpectra) {
  proves({"IU.2.1"}, Oracle::table, "constants of Wien, Stefan and Boltzmann; CIE 15:2004, table T.1");
  constexpr double kWien = 2.897771955e6, kStefanBoltzmann = 5.670374419e-8;
  for (const double temperature : {1000.0, 2856.0, kSunTemperature, 10000.0}) {
    const double peak = kWien / temperature, most = black_body(peak, temperature);
    EXPECT_TRUE(holds(most > black_body(peak * 1.001, temperature) && most > black_body(peak / 1.001, temperature)));
    constexpr int kSteps = 4000;
    const double span = std::log(1e5);
    double power = 0;
    for (int i = 0; i <= kSteps; ++i) {
      const double wavelength = 50 * 5772 / temperature * std::exp(span * i / kSteps);
      power += black_body(wavelength, temperature) * wavelength * 1e-9 * span / kSteps;
    }
    const double expected = kStefanBoltzmann * std::pow(temperature, 4);
    EXPECT_TRUE(near(std::numbers::pi * power / expected, 1, 1e-8));
  }
  const auto& a = incandescent_a();
  for (const auto& [wavelength, value, digit] : {std::array{380.0, 9.7951, 1e-4},
                                                 {400.0, 14.7080, 1e-4},
                                                 {500.0, 59.8611, 1e-4},
                                                 {560.0, 100.0, 1e-4},
                                                 {600.0, 129.043, 1e-3},
                                                 {700.0, 198.261, 1e-3},
                                                 {780.0, 241.675, 1e-3}})
    EXPECT_TRUE(near(a[static_cast<std::size_t>((wavelength - 380) / 5)], value, 0.5 * digit));
  const Eigen::Array2d xy = chromaticity(tristimulus(a));
  EXPECT_TRUE(near(xy[0], 0.44758, 1e-4));
  EXPECT_TRUE(near(xy[1], 0.40745, 1e-4));
  EXPECT_TRUE(refuses([] { return black_body(0, 5000); }));
  EXPECT_TRUE(refuses([] { return black_body(500, -1); }));
}

/// Two reflectances of one colour by daylight D65: a smooth one, and the same with ripples that no cone answers to.
struct Metamers {
  std::vector<double> smooth, rippled;
};

Metamers metamers() {
  const auto& light = daylight_d65();
  std::vector<std::array<double, 3>> weights;  // D65 times x̄, ȳ, z̄
  Metamers pair;
  std::vector<double> ripple;
  for (std::size_t i = 0; i < kTableLength; ++i) {
    const double wavelength = 380 + 5 * static_cast<double>(i);
    const Xyz eye = observer(wavelength);
    weights.push_back({light[i] * eye[0], light[i] * eye[1], light[i] * eye[2]});
    pair.smooth.push_back(0.45 + 0.2 * std::sin((wavelength - 400) / 80));
    ripple.push_back(std::cos((wavelength - 380) / 25));
  }
  // The ripple less its parts along the three weights (Gram and Schmidt).
  std::array<std::vector<double>, 3> basis;
  const auto dot = [](const std::vector<double>& p, const std::vector<double>& q) {
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) sum += p[i] * q[i];
    return sum;
  };
  for (std::size_t c = 0; c < 3; ++c) {
    for (const auto& weight : weights) basis[c].push_back(weight[c]);
    for (int twice = 0; twice < 2; ++twice) {
      for (std::size_t before = 0; before < c; ++before) {
        const double share = dot(basis[c], basis[before]) / dot(basis[before], basis[before]);
        for (std::size_t i = 0; i < kTableLength; ++i) basis[c][i] -= share * basis[before][i];
      }
    }
  }
  for (int twice = 0; twice < 2; ++twice) {
    for (const auto& direction : basis) {
      const double share = dot(ripple, direction) / dot(direction, direction);
      for (std::size_t i = 0; i < kTableLength; ++i) ripple[i] -= share * direction[i];
    }
  }
  double most = 0;
  for (const double value : ripple) most = std::max(most, std::abs(value));
  for (std::size_t i = 0; i < kTableLength; ++i) pair.rippled.push_back(pair.smooth[i] + 0.24 * ripple[i] / most);
  return pair;
}

// CLAIM      IU.2.9b: the model at each wavelength, I_λ, and then XYZ and RGB, tells apart what three channels do not: two surfaces of one
//            colour by daylight, under light of every mixture of diffuse and directed, differ by incandescent light, while three
//            channels, which know their colours by daylight only, show one colour under both.
// ORACLE     identity: the pair is made so that daylight cannot tell it apart; the model written out per channel.
// TOLERANCE  daylight: 1e-12 of white (81 products of roundings, twice orthogonalised); incandescent: apart by 0.01 of white.
TEST(ReflectedSpectrum, TellsMetamersApart) {
  proves({"IU.2.9b"}, Oracle::identity, "a metameric pair by daylight and by incandescent light");
  const Metamers pair = metamers();
  for (const double value : pair.rippled) ASSERT_TRUE(value > 0 && value < 1);
  const auto shown = [](const std::vector<double>& diffuse, const std::vector<double>& light, double directed) {
    std::vector<double> ambient = light;
    for (double& value : ambient) value *= 0.2;
    const double white = tristimulus(light)[1];
    return LinearSrgb(linear_srgb(tristimulus(reflected_spectrum(diffuse, ambient, light, 0.7, directed)) / white));
  };
  for (const double directed : {0.0, 0.3}) {
    const LinearSrgb a = shown(pair.smooth, daylight_d65(), directed),
                     b = shown(pair.rippled, daylight_d65(), directed);
    EXPECT_TRUE(within((a - b).abs().maxCoeff(), 1e-12));
    const LinearSrgb c = shown(pair.smooth, incandescent_a(), directed),
                     d = shown(pair.rippled, incandescent_a(), directed);
    EXPECT_TRUE(apart((c - d).abs().maxCoeff(), 0, 0.01));
    // Per channel: k_d (0.2 + 0.7) + directed of a light that is white by daylight.
    const LinearSrgb k_d = shown(pair.smooth, daylight_d65(), 0) / 0.9;
    EXPECT_TRUE(within((k_d * 0.9 + directed - a).abs().maxCoeff(), 1e-4));  // D65's white is that of sRGB to 1e-4
  }
  EXPECT_TRUE(refuses([] { return reflected_spectrum({1}, {1, 2}, {1}, 1, 0); }));
  EXPECT_TRUE(refuses([] { return reflected_spectrum({1}, {1}, {1}, -1, 0); }));
}

}  // namespace
}  // namespace etendue::validation
