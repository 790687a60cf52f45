// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

#include "etendue/form_factor/catalogue/catalogue.hpp"
#include "support/counter_random.hpp"

namespace etendue::validation {

/// Parameters whose lengths differ by at most `spread`, within the entry's domain; angles keep `margin` of their range
/// from both ends.
inline std::vector<double> random_parameters(const catalogue::Entry& entry, CounterRandom& random, double spread,
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
