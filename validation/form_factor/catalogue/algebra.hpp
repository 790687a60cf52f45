// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "etendue/form_factor/catalogue/catalogue.hpp"
#include "etendue/form_factor/gauss_legendre.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {

/// The factor of an entry, noted as used: at the end every entry must have been part of a relation.
class Algebra {
 public:
  double operator()(const char* id, const std::vector<double>& values) {
    const catalogue::Entry* entry = catalogue::find(id);
    if (!entry) throw std::runtime_error(std::string("no entry ") + id);
    const auto factor = catalogue::form_factor(*entry, values);
    if (!factor.ok()) throw std::runtime_error(factor.error().message);
    used_.insert(id);
    return factor->value;
  }
  const std::set<std::string>& used() const { return used_; }

 private:
  std::set<std::string> used_;
};

/// ∫ f from low to high by the 32-point Gauss rule on `pieces`: the means that lead from one entry to another.
template <class F>
double integral(double low, double high, const F& f, int pieces = 1) {
  double sum = 0;
  const double step = (high - low) / pieces;
  for (int k = 0; k < pieces; ++k) {
    for (const QuadratureNode& node : gauss_legendre(kMaxGaussNodes)) {
      sum += step / 2 * node.weight * f(low + step * (k + 0.5 * (1 + node.x)));
    }
  }
  return sum;
}

inline constexpr double kPi = 3.14159265358979323846;
/// Twelve digits of the relation's larger side.
inline constexpr double kTwelveDigits = 1e-12;

inline double square(double x) {
  return x * x;
}

inline void equal(double left, double right, const char* relation) {
  EXPECT_TRUE(near(left, right, kTwelveDigits * std::max(std::abs(left), std::abs(right)))) << relation;
}

/// Closure: what leaves a surface arrives somewhere.
inline void one(double sum, const char* relation) {
  EXPECT_TRUE(near(sum, 1, kTwelveDigits)) << relation;
}

}  // namespace etendue::validation
