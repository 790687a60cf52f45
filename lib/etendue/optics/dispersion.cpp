// SPDX-License-Identifier: Apache-2.0
#include "etendue/optics/dispersion.hpp"

#include <cmath>
#include <limits>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

constexpr double kMicrometre = 1e-3;  // in nanometres: the formulas' unit of length

double index_by(const Cauchy& cauchy, double square) {
  return cauchy.a + (cauchy.b + cauchy.c / square) / square;
}

double index_by(const Sellmeier& sellmeier, double square) {
  double sum = 1;
  for (std::size_t i = 0; i < sellmeier.strength.size(); ++i) {
    sum += sellmeier.strength[i] * square / (square - sellmeier.resonance[i]);
  }
  return std::sqrt(sum);
}

}  // namespace

double refractive_index(const Dispersion& dispersion, double wavelength_nm) {
  require(kShortestVisible <= wavelength_nm && wavelength_nm <= kLongestVisible,
          "refractive_index: the wavelength is visible, in nanometres");
  const double length = wavelength_nm * kMicrometre;
  return std::visit([&](const auto& formula) { return index_by(formula, length * length); }, dispersion);
}

bool has_index(const Dispersion& dispersion, double least, double greatest) {
  for (double wavelength = kShortestVisible; wavelength <= kLongestVisible; ++wavelength) {
    const double index = refractive_index(dispersion, wavelength);
    if (!(least <= index && index <= greatest)) return false;  // also for NaN
  }
  return true;
}

double abbe_number(const Dispersion& dispersion) {
  const double difference = refractive_index(dispersion, kLineF) - refractive_index(dispersion, kLineC);
  if (difference == 0) return std::numeric_limits<double>::infinity();
  return (refractive_index(dispersion, kLineD) - 1) / difference;
}

const std::vector<KnownMedium>& known_media() {
  constexpr std::string_view kSchott = "Schott, Optical Glass Catalogue";
  static const std::vector<KnownMedium> media{
      {"water",
       Sellmeier{{5.684027565e-1, 1.726177391e-1, 2.086189578e-2, 1.130748688e-1},
                 {5.101829712e-3, 1.821153936e-2, 2.620722293e-2, 1.069792721e1}},
       "Daimon and Masumura 2007, distilled water at 20.0 °C, against vacuum"},
      {"fused silica",
       Sellmeier{{0.6961663, 0.4079426, 0.8974794},
                 {0.0684043 * 0.0684043, 0.1162414 * 0.1162414, 9.896161 * 9.896161}},
       "Malitson 1965"},
      {"N-BK7", Sellmeier{{1.03961212, 0.231792344, 1.01046945}, {0.00600069867, 0.0200179144, 103.560653}}, kSchott},
      {"F2", Sellmeier{{1.34533359, 0.209073176, 0.937357162}, {0.00997743871, 0.0470450767, 111.886764}}, kSchott},
      {"N-SF11", Sellmeier{{1.73759695, 0.313747346, 1.89878101}, {0.013188707, 0.0623068142, 155.23629}}, kSchott},
      {"SF11", Sellmeier{{1.73848403, 0.311168974, 1.17490871}, {0.0136068604, 0.0615960463, 121.922711}}, kSchott},
  };
  return media;
}

const KnownMedium* find_medium(std::string_view name) {
  for (const KnownMedium& medium : known_media()) {
    if (medium.name == name) return &medium;
  }
  return nullptr;
}

}  // namespace etendue
