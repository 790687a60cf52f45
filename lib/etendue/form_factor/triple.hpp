// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>

#include "etendue/core/double_double_functions.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/geometry/double_double3.hpp"

namespace etendue {

/// A vector of double or of DoubleDouble: the contour is one algorithm, run in either.
template <class T>
struct Triple {
  T x{}, y{}, z{};

  friend Triple operator+(const Triple& a, const Triple& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Triple operator-(const Triple& a, const Triple& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Triple operator*(const T& k, const Triple& a) { return {k * a.x, k * a.y, k * a.z}; }
  friend T dot(const Triple& a, const Triple& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend Triple cross(const Triple& a, const Triple& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  friend T norm(const Triple& a) {
    using std::sqrt;
    return sqrt(dot(a, a));
  }
};

/// The leading digits.
inline double leading(double a) {
  return a;
}
inline double leading(const DoubleDouble& a) {
  return a.high;
}

template <class T>
T narrowed(const DoubleDouble& a);
template <>
inline double narrowed(const DoubleDouble& a) {
  return rounded(a);
}
template <>
inline DoubleDouble narrowed(const DoubleDouble& a) {
  return a;
}

template <class T>
Triple<T> narrowed(const DoubleDouble3& a) {
  return {narrowed<T>(a.x), narrowed<T>(a.y), narrowed<T>(a.z)};
}

inline Triple<DoubleDouble> widened(const Triple<double>& a) {
  return {a.x, a.y, a.z};
}
inline const Triple<DoubleDouble>& widened(const Triple<DoubleDouble>& a) {
  return a;
}

/// What one operation, logarithm or angle loses, in units of which the counts of NOTES.md §3 are. In twice the digits
/// the functions' bound stands for all.
template <class T>
inline constexpr double kRounding = kUnitRoundoff;
template <>
inline constexpr double kRounding<DoubleDouble> = kDoubleDoubleFunctionError;

inline double angle_of(double y, double x) {
  return std::atan2(y, x);
}

}  // namespace etendue
