// SPDX-License-Identifier: Apache-2.0
#include "etendue/optics/colour.hpp"

#include <algorithm>
#include <cmath>

#include "etendue/core/contract.hpp"
#include "etendue/optics/colour_tables.hpp"
#include "etendue/optics/dispersion.hpp"

namespace etendue {

namespace {

using Matrix = const double[3][3];

constexpr Matrix kToSrgb = {{3.2409699419045213, -1.5373831775700935, -0.4986107602930033},
                            {-0.9692436362808798, 1.8759675015077206, 0.04155505740717561},
                            {0.05563007969699361, -0.20397695888897657, 1.0569715142428786}};
constexpr Matrix kToXyz = {{0.4123907992659595, 0.35758433938387796, 0.1804807884018343},
                           {0.21263900587151036, 0.7151686787677559, 0.07219231536073371},
                           {0.01933081871559185, 0.11919477979462599, 0.9505321522496606}};

Eigen::Array3d times(Matrix& matrix, const Eigen::Array3d& v) {
  Eigen::Array3d product;
  for (int row = 0; row < 3; ++row) {
    product[row] = matrix[row][0] * v[0] + matrix[row][1] * v[1] + matrix[row][2] * v[2];
  }
  return product;
}

Xyz entry(std::size_t index) {
  return {kObserverTable[index][0], kObserverTable[index][1], kObserverTable[index][2]};
}

/// ∫ of the observer's three functions, which are linear between the table's entries, from 380 nm to each of them.
const std::vector<Xyz>& integrals() {
  static const std::vector<Xyz> table = [] {
    std::vector<Xyz> sums{Xyz::Zero()};
    for (std::size_t i = 1; i < kTableLength; ++i) {
      sums.push_back(sums.back() + (entry(i - 1) + entry(i)) * (kTableStep / 2));
    }
    return sums;
  }();
  return table;
}

/// A wavelength and the observer's integrals from 380 nm to there.
struct Mark {
  double wavelength;
  Xyz below;
};

/// Where the share `share` of all light, weighed by x̄ + ȳ + z̄, lies below.
Mark mark(double share) {
  const std::vector<Xyz>& sums = integrals();
  const double wanted = share * sums.back().sum();
  const auto above =
      std::find_if(sums.begin() + 1, sums.end() - 1, [&](const Xyz& sum) { return wanted <= sum.sum(); });
  const auto index = static_cast<std::size_t>(above - sums.begin()) - 1;
  // Within the interval the weight goes from w0 to w1 along a line, its integral along a parabola: solved for the step s
  // without the cancellation of nearly equal terms.
  const Xyz first = entry(index), rise = entry(index + 1) - first;
  const double rest = std::max(0.0, wanted - sums[index].sum()) / kTableStep;  // absorbs the rounding of the sum
  const double root = std::sqrt(std::max(0.0, first.sum() * first.sum() + 2 * rise.sum() * rest));
  const double step = std::min(1.0, 2 * rest / (first.sum() + root));
  const double wavelength = kShortestVisible + (static_cast<double>(index) + step) * kTableStep;
  return {wavelength, sums[index] + kTableStep * (step * first + step * step / 2 * rise)};
}

}  // namespace

Xyz observer(double wavelength_nm) {
  if (!(kShortestVisible <= wavelength_nm && wavelength_nm <= kLongestVisible)) return Xyz::Zero();
  const double place = (wavelength_nm - kShortestVisible) / kTableStep;
  const std::size_t index = std::min(static_cast<std::size_t>(place), kTableLength - 2);
  const double share = place - static_cast<double>(index);
  return (1 - share) * entry(index) + share * entry(index + 1);
}

Xyz tristimulus(const std::vector<double>& spectrum) {
  require(spectrum.size() == kTableLength, "tristimulus: the spectrum has a value for each wavelength of the table");
  Xyz sum = Xyz::Zero();
  for (std::size_t i = 0; i < kTableLength; ++i) sum += spectrum[i] * entry(i);
  return sum * kTableStep;
}

Eigen::Array2d chromaticity(const Xyz& xyz) {
  return xyz.head<2>() / xyz.sum();
}

LinearSrgb linear_srgb(const Xyz& xyz) {
  return times(kToSrgb, xyz);
}

Xyz xyz_of(const LinearSrgb& colour) {
  return times(kToXyz, colour);
}

std::vector<WavelengthSample> wavelength_samples(int count, double offset) {
  require(count >= 1, "wavelength_samples: at least one part");
  require(0 <= offset && offset <= 1, "wavelength_samples: the offset is in [0, 1]");
  const LinearSrgb all = linear_srgb(integrals().back());
  std::vector<WavelengthSample> samples;
  Mark begin = mark(0);
  for (int part = 0; part < count; ++part) {
    const Mark end = part + 1 == count ? Mark{kLongestVisible, integrals().back()} : mark((part + 1.0) / count);
    samples.push_back({mark((part + offset) / count).wavelength, linear_srgb(end.below - begin.below) / all});
    begin = end;
  }
  return samples;
}

}  // namespace etendue
