// SPDX-License-Identifier: Apache-2.0
#include "etendue/optics/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "etendue/core/contract.hpp"
#include "etendue/optics/dispersion.hpp"

namespace etendue {

namespace {

double table_wavelength(std::size_t index) {
  return kShortestVisible + kTableStep * static_cast<double>(index);
}

std::vector<double> tabulated(const Spectrum& spectrum) {
  std::vector<double> values;
  for (std::size_t i = 0; i < kTableLength; ++i) values.push_back(spectrum.at(table_wavelength(i)));
  return values;
}

const Spectrum& daylight() {
  static const Spectrum spectrum = through_table(daylight_d65());
  return spectrum;
}

const Xyz& daylight_white() {
  static const Xyz white = tristimulus(daylight_d65());
  return white;
}

}  // namespace

double Spectrum::at(double wavelength) const {
  require(!points.empty(), "Spectrum: at least one point");
  const auto above = std::upper_bound(points.begin(), points.end(), wavelength,
                                      [](double at, const Point& point) { return at < point.wavelength; });
  if (above == points.begin()) return points.front().value;
  const Point& low = *std::prev(above);
  if (above == points.end()) return low.value;
  const double share = (wavelength - low.wavelength) / (above->wavelength - low.wavelength);
  return (1 - share) * low.value + share * above->value;
}

Spectrum through_table(const std::vector<double>& values) {
  require(values.size() == kTableLength, "through_table: a value for each wavelength of the table");
  Spectrum spectrum;
  for (std::size_t i = 0; i < kTableLength; ++i) spectrum.points.push_back({table_wavelength(i), values[i]});
  return spectrum;
}

bool is_visible(const Spectrum& power) {
  const double luminance = tristimulus(tabulated(power))[1];
  return luminance > 0 && std::isfinite(daylight_white()[1] / luminance);
}

Illuminant illuminant(const Spectrum& power) {
  for (const Spectrum::Point& point : power.points) require(point.value >= 0, "illuminant: no power is negative");
  require(is_visible(power), "illuminant: some of the light is visible");
  const Xyz seen = tristimulus(tabulated(power));
  const double scale = daylight_white()[1] / seen[1];
  Illuminant light{power, linear_srgb(scale * seen) / linear_srgb(daylight_white())};
  for (Spectrum::Point& point : light.power.points) point.value *= scale;
  return light;
}

LinearSrgb colour_by_daylight(const Spectrum& reflectance) {
  std::vector<double> reflected = tabulated(reflectance);
  for (std::size_t i = 0; i < kTableLength; ++i) reflected[i] *= daylight_d65()[i];
  return linear_srgb(tristimulus(reflected)) / linear_srgb(daylight_white());
}

std::vector<WavelengthSample> even_wavelengths(int count) {
  require(count >= 1, "even_wavelengths: at least one part");
  constexpr double kBegin = kShortestVisible - kTableStep / 2, kWidth = kTableStep * kTableLength;
  std::vector<WavelengthSample> samples;
  LinearSrgb all = LinearSrgb::Zero();
  for (int part = 0; part < count; ++part) {
    const double middle = std::clamp(kBegin + kWidth * (part + 0.5) / count, kShortestVisible, kLongestVisible);
    samples.push_back({middle, linear_srgb(observer(middle))});
    all += samples.back().weight;
  }
  for (WavelengthSample& sample : samples) sample.weight /= all;
  return samples;
}

std::vector<WavelengthSample> lit(std::vector<WavelengthSample> samples, const Illuminant& light) {
  LinearSrgb all = LinearSrgb::Zero();
  for (const WavelengthSample& sample : samples) all += sample.weight * daylight().at(sample.wavelength);
  for (WavelengthSample& sample : samples) sample.weight *= light.power.at(sample.wavelength) / all;
  return samples;
}

}  // namespace etendue
