// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>

#include "etendue/form_factor/edge_terms.hpp"
#include "support/counter_random.hpp"

namespace etendue::validation {

/// Where that share of the way along an edge is.
inline Triple<double> between(const Edge<double>& e, double share) {
  return e.start + share * (e.end - e.start);
}

/// Two edges in a cube, every other pair brought close to each other, every fifth nearly parallel.
class EdgePairs {
 public:
  explicit EdgePairs(std::uint64_t seed) : random_(seed) {}

  std::pair<Edge<double>, Edge<double>> next() {
    const Triple<double> a = point(1), b = point(1);
    Triple<double> c = point(1), d = point(1);
    if (++count_ % 2 == 0) c = between(make_edge(a, b), 0.5) + point(0.1);
    if (count_ % 5 == 0) d = c + (b - a) + point(0.2);
    return {make_edge(a, b), make_edge(c, d)};
  }

 private:
  Triple<double> point(double size) {
    const double x = random_.between(-size, size), y = random_.between(-size, size), z = random_.between(-size, size);
    return {x, y, z};
  }
  CounterRandom random_;
  int count_ = 0;
};

}  // namespace etendue::validation
