// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/integer.hpp"

#include <algorithm>
#include <cmath>

namespace etendue {

namespace {

constexpr int kLimbBits = 32;
constexpr int kDigits = 53;

void trim(std::vector<std::uint32_t>& limbs) {
  while (!limbs.empty() && limbs.back() == 0) limbs.pop_back();
}

}  // namespace

int Integer::exponent_of(double value) {
  if (value == 0) return 0;
  int exponent = 0;
  std::frexp(value, &exponent);
  return exponent - kDigits;
}

Integer Integer::scaled(double value, int exponent) {
  Integer result;
  if (value == 0) return result;
  result.negative_ = value < 0;
  int own = 0;
  const double fraction = std::frexp(std::abs(value), &own);
  const auto mantissa = static_cast<std::uint64_t>(std::ldexp(fraction, kDigits));
  const int shift = own - kDigits - exponent, bits = shift % kLimbBits;
  result.limbs_.assign(static_cast<std::size_t>(shift / kLimbBits), 0);
  // 53 bits moved by up to 31 fill three limbs; what moves up from the lower half fills what the upper half leaves.
  const std::uint64_t low = (mantissa & 0xffffffff) << bits, high = (mantissa >> kLimbBits) << bits;
  for (const std::uint64_t limb : {low, (low >> kLimbBits) | high, high >> kLimbBits}) {
    result.limbs_.push_back(static_cast<std::uint32_t>(limb & 0xffffffff));
  }
  trim(result.limbs_);
  return result;
}

bool Integer::is_less(const Limbs& a, const Limbs& b) {
  if (a.size() != b.size()) return a.size() < b.size();
  return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
}

Integer::Limbs Integer::sum(const Limbs& a, const Limbs& b) {
  const Limbs& longer = a.size() < b.size() ? b : a;
  const Limbs& shorter = a.size() < b.size() ? a : b;
  Limbs result = longer;
  std::uint64_t carry = 0;
  for (std::size_t i = 0; i < longer.size(); ++i) {
    carry += static_cast<std::uint64_t>(longer[i]) + (i < shorter.size() ? shorter[i] : 0);
    result[i] = static_cast<std::uint32_t>(carry & 0xffffffff);
    carry >>= kLimbBits;
  }
  if (carry != 0) result.push_back(static_cast<std::uint32_t>(carry));
  return result;
}

Integer::Limbs Integer::difference(const Limbs& greater, const Limbs& less) {
  Limbs result = greater;
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < greater.size(); ++i) {
    const std::uint64_t taken = (i < less.size() ? less[i] : 0) + borrow;
    borrow = greater[i] < taken ? 1 : 0;
    result[i] = static_cast<std::uint32_t>((greater[i] + (borrow << kLimbBits) - taken) & 0xffffffff);
  }
  trim(result);
  return result;
}

Integer operator-(Integer a) {
  a.negative_ = !a.negative_;
  return a;
}

Integer operator+(const Integer& a, const Integer& b) {
  Integer result;
  if (a.negative_ == b.negative_) {
    result.negative_ = a.negative_;
    result.limbs_ = Integer::sum(a.limbs_, b.limbs_);
    return result;
  }
  const bool swapped = Integer::is_less(a.limbs_, b.limbs_);
  result.negative_ = swapped ? b.negative_ : a.negative_;
  result.limbs_ = swapped ? Integer::difference(b.limbs_, a.limbs_) : Integer::difference(a.limbs_, b.limbs_);
  return result;
}

Integer operator-(const Integer& a, const Integer& b) {
  return a + (-b);
}

Integer operator*(const Integer& a, const Integer& b) {
  Integer result;
  if (a.limbs_.empty() || b.limbs_.empty()) return result;
  result.negative_ = a.negative_ != b.negative_;
  result.limbs_.assign(a.limbs_.size() + b.limbs_.size(), 0);
  for (std::size_t i = 0; i < a.limbs_.size(); ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < b.limbs_.size(); ++j) {
      carry += static_cast<std::uint64_t>(a.limbs_[i]) * b.limbs_[j] + result.limbs_[i + j];
      result.limbs_[i + j] = static_cast<std::uint32_t>(carry & 0xffffffff);
      carry >>= kLimbBits;
    }
    result.limbs_[i + b.limbs_.size()] = static_cast<std::uint32_t>(carry);
  }
  trim(result.limbs_);
  return result;
}

}  // namespace etendue
