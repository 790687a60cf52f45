// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "etendue/form_factor/catalogue/catalogue.hpp"

namespace etendue::validation {

/// SplitMix64: the same numbers with every compiler.
class CatalogueRandom {
 public:
  explicit CatalogueRandom(std::uint64_t seed) : state_(seed) {}
  double unit() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
  /// Evenly in the logarithm.
  double scale(double low, double high) { return low * std::exp(unit() * std::log(high / low)); }

 private:
  std::uint64_t state_;
};

/// Parameters whose lengths differ by at most `spread`, within the entry's domain; angles keep `margin` of their range
/// from both ends.
inline std::vector<double> random_parameters(const catalogue::Entry& entry, CatalogueRandom& random, double spread,
                                             double margin) {
  for (;;) {
    std::vector<double> values;
    for (const auto& p : entry.parameters) {
      const double low = 1 / std::sqrt(spread), high = std::sqrt(spread);
      switch (p.quantity) {
        case catalogue::Quantity::length:
        case catalogue::Quantity::offset:
          values.push_back(random.scale(low, high));
          break;
        case catalogue::Quantity::position:
          values.push_back((random.unit() < 0.5 ? -1 : 1) * random.scale(low, high));
          break;
        case catalogue::Quantity::angle:
          values.push_back(p.least + (p.greatest - p.least) * (margin + (1 - 2 * margin) * random.unit()));
          break;
        case catalogue::Quantity::count:
          values.push_back(std::floor(random.scale(p.least, margin > 0 ? 12 : p.greatest + 0.5)));
          break;
      }
    }
    if (!catalogue::complaint(entry, values)) return values;
  }
}

inline std::string described(const catalogue::Entry& entry, const std::vector<double>& values) {
  std::string text = entry.id;
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += " " + std::string(entry.parameters[i].symbol) + "=" + std::to_string(values[i]);
  }
  return text;
}

}  // namespace etendue::validation
