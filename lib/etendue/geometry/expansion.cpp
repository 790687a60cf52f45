// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/expansion.hpp"

namespace etendue {

Expansion::Expansion(double value) {
  grow(value);
}

Expansion::Expansion(const DoubleDouble& value) {
  grow(value.low);
  grow(value.high);
}

void Expansion::grow(double term) {
  std::size_t kept = 0;
  for (const double old : terms_) {
    const DoubleDouble sum = exact_sum(term, old);
    term = sum.high;
    // What is written never overtakes what is read: one term in, at most one term out.
    if (sum.low != 0) terms_[kept++] = sum.low;
  }
  terms_.resize(kept);
  if (term != 0) terms_.push_back(term);
}

void Expansion::add_product(const DoubleDouble& a, const DoubleDouble& b) {
  for (const double left : {a.low, a.high}) {
    for (const double right : {b.low, b.high}) {
      if (left == 0 || right == 0) continue;
      const DoubleDouble product = exact_product(left, right);
      if (product.low != 0) grow(product.low);
      grow(product.high);
    }
  }
}

int Expansion::sign() const {
  if (terms_.empty()) return 0;
  return terms_.back() > 0 ? 1 : -1;
}

DoubleDouble Expansion::to_double_double() const {
  DoubleDouble sum;
  for (const double term : terms_) sum = sum + DoubleDouble(term);
  return sum;
}

Expansion operator-(Expansion a) {
  for (double& term : a.terms_) term = -term;
  return a;
}

Expansion operator+(const Expansion& a, const Expansion& b) {
  Expansion sum = a;
  for (const double term : b.terms_) sum.grow(term);
  return sum;
}

Expansion operator-(const Expansion& a, const Expansion& b) {
  return a + (-b);
}

Expansion operator*(const Expansion& a, const Expansion& b) {
  Expansion sum;
  for (const double left : a.terms_) {
    for (const double right : b.terms_) {
      const DoubleDouble product = exact_product(left, right);
      sum.grow(product.low);
      sum.grow(product.high);
    }
  }
  return sum;
}

}  // namespace etendue
