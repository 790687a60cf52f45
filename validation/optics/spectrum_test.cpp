// SPDX-License-Identifier: Apache-2.0
#include "etendue/optics/spectrum.hpp"

#include <cmath>

#include "etendue/core/rounding.hpp"
#include "etendue/optics/illuminants.hpp"
#include "optics/direct_colour.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr double u = kUnitRoundoff;

/// A reflectance with bumps, in (0, 1).
double bumpy(double wavelength, int kind) {
  return 0.5 + 0.45 * std::sin(wavelength / (7 + 11 * kind) + kind);
}

Spectrum on_table(const std::function<double(double)>& value) {
  std::vector<double> values;
  for (std::size_t i = 0; i < kTableLength; ++i) values.push_back(value(380 + 5 * static_cast<double>(i)));
  return through_table(values);
}

LinearSrgb sum_of_weights(const std::vector<WavelengthSample>& samples) {
  LinearSrgb sum = LinearSrgb::Zero();
  for (const WavelengthSample& sample : samples) sum += sample.weight;
  return sum;
}

// CLAIM      A spectrum is linear between its points and stays what it was beyond them.
// ORACLE     exact: values on lines through dyadic numbers.
// TOLERANCE  none.
TEST(Spectrum, IsLinearBetweenItsPoints) {
  proves({"IU.2.9b"}, Oracle::exact, "values on lines through dyadic numbers");
  const Spectrum spectrum{{{384, 0.25}, {400, 0.75}, {464, 0.5}}};
  EXPECT_TRUE(holds(spectrum.at(380) == 0.25 && spectrum.at(384) == 0.25 && spectrum.at(800) == 0.5));
  EXPECT_TRUE(holds(spectrum.at(388) == 0.375 && spectrum.at(400) == 0.75 && spectrum.at(448) == 0.5625));
  EXPECT_TRUE(holds(spectrum.at(464) == 0.5));
  EXPECT_TRUE(refuses([] { return Spectrum{}.at(500); }));
  EXPECT_TRUE(refuses([] { return through_table({1, 2}); }));
}

// CLAIM      IU.2.9b: colours of reflectances by daylight, and the white of a light, are sums over the CIE's table; that of
//            daylight is (1, 1, 1), and a light's scale does not matter.
// ORACLE     closed form: the sums in extended precision, with a matrix from the primaries.
// TOLERANCE  direct_colour()'s bound on roundings; the white of daylight: none.
TEST(Spectrum, IsSeenAsTheDirectSum) {
  proves({"IU.2.9b", "IU.2.9"}, Oracle::closed_form, "sums over the CIE's table in extended precision");
  for (int kind = 0; kind < 8; ++kind) {
    const Spectrum reflectance = on_table([&](double at) { return bumpy(at, kind); });
    const auto exact = [&](long double at) { return bumpy(static_cast<double>(at), kind); };
    const DirectColour expected = direct_colour(exact, daylight_light);
    const LinearSrgb seen = colour_by_daylight(reflectance);
    for (int c = 0; c < 3; ++c)
      EXPECT_TRUE(near(seen[c], static_cast<double>(expected.value[c]), static_cast<double>(expected.bound[c])));
  }
  const auto all = [](long double) { return 1; };
  const DirectColour expected = direct_colour(all, incandescent_light);
  for (const double scale : {1.0, 1e-3, 7e20}) {
    const LinearSrgb seen = illuminant(on_table([&](double at) { return scale * incandescent_light(at); })).white;
    for (int c = 0; c < 3; ++c)
      EXPECT_TRUE(near(seen[c], static_cast<double>(expected.value[c]), static_cast<double>(expected.bound[c])));
  }
  EXPECT_TRUE(holds((illuminant(through_table(daylight_d65())).white == 1).all()));
  EXPECT_TRUE(holds(!is_visible({{{300, 1}, {379, 0}}}) && is_visible({{{380, 0}, {385, 1}}})));
  EXPECT_TRUE(
      holds(!is_visible({{{380, 1e-320}, {780, 1e-320}}})));  // so faint that white would take an infinite factor
  EXPECT_TRUE(refuses([] { return illuminant({{{300, 1}, {379, 0}}}); }));
  EXPECT_TRUE(refuses([] { return illuminant({{{380, 1}, {500, -1}}}); }));
}

// CLAIM      The visible light in parts of equal width: 81 of them have the table's wavelengths; weights sum to 1, under daylight
//            as well, and at the table's wavelengths to the white of any light.
// ORACLE     identity: sums; 380 + 5 i.
// TOLERANCE  wavelengths of the table: none. Sums: 4 N u, for each of two normalisations; the light's white: its bound.
TEST(EvenWavelengths, DivideWhiteLight) {
  proves({"IU.2.9b"}, Oracle::identity, "parts sum to white");
  const Illuminant day = illuminant(through_table(daylight_d65()));
  for (const int count : {1, 2, 3, 10, 27, 81, 401}) {
    const auto samples = even_wavelengths(count);
    ASSERT_EQ(samples.size(), static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < samples.size(); ++i) {
      EXPECT_TRUE(holds(380 <= samples[i].wavelength && samples[i].wavelength <= 780));
      EXPECT_TRUE(holds(i == 0 || samples[i - 1].wavelength <= samples[i].wavelength));
      EXPECT_TRUE(holds(count != 81 || samples[i].wavelength == 380 + 5 * static_cast<double>(i)));
    }
    EXPECT_TRUE(within((sum_of_weights(samples) - 1).abs().maxCoeff(), 4 * count * u));
    EXPECT_TRUE(within((sum_of_weights(lit(samples, day)) - 1).abs().maxCoeff(), 8 * count * u));
  }
  const DirectColour expected = direct_colour([](long double) { return 1; }, incandescent_light);
  const LinearSrgb white =
      sum_of_weights(lit(even_wavelengths(kTableLength), illuminant(through_table(incandescent_a()))));
  for (int c = 0; c < 3; ++c)
    EXPECT_TRUE(near(white[c], static_cast<double>(expected.value[c]), static_cast<double>(expected.bound[c])));
  EXPECT_TRUE(refuses([] { return even_wavelengths(0); }));
}

}  // namespace
}  // namespace etendue::validation
