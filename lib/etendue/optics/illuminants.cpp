// SPDX-License-Identifier: Apache-2.0
#include "etendue/optics/illuminants.hpp"

#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/optics/colour.hpp"

namespace etendue {

double black_body(double wavelength_nm, double temperature) {
  require(std::isfinite(wavelength_nm) && wavelength_nm > 0 && std::isfinite(temperature) && temperature > 0,
          "black_body: wavelength and temperature are positive");
  constexpr double h = 6.62607015e-34, c = 299792458, k = 1.380649e-23;
  const double wavelength = wavelength_nm * 1e-9;
  const double exponent = h * c / (wavelength * k * temperature);
  return 2 * h * c * c / std::pow(wavelength, 5) / std::expm1(exponent);
}

const std::vector<double>& incandescent_a() {
  static const std::vector<double> table = [] {
    constexpr double kFirst = 380, kMiddle = 560, kSecondConstant = 1.435e7, kTemperature = 2848;
    std::vector<double> values;
    for (std::size_t i = 0; i < kTableLength; ++i) {
      const double wavelength = kFirst + kTableStep * static_cast<double>(i);
      const auto bright = [](double at) { return std::expm1(kSecondConstant / (kTemperature * at)); };
      values.push_back(100 * std::pow(kMiddle / wavelength, 5) * bright(kMiddle) / bright(wavelength));
    }
    return values;
  }();
  return table;
}

std::vector<double> reflected_spectrum(const std::vector<double>& diffuse, const std::vector<double>& ambient,
                                       const std::vector<double>& light, double incidence, double directed) {
  require(diffuse.size() == ambient.size() && diffuse.size() == light.size(),
          "reflected_spectrum: spectra of one length");
  require(incidence >= 0 && directed >= 0, "reflected_spectrum: incidence and directed part are not negative");
  std::vector<double> sum;
  sum.reserve(diffuse.size());
  for (std::size_t i = 0; i < diffuse.size(); ++i)
    sum.push_back(diffuse[i] * ambient[i] + light[i] * (diffuse[i] * incidence + directed));
  return sum;
}

}  // namespace etendue
