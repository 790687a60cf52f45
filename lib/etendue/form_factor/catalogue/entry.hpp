// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "etendue/form_factor/catalogue/counted.hpp"
#include "etendue/form_factor/catalogue/drawing.hpp"

namespace etendue::catalogue {

/// What a parameter measures, and with that what it may be.
enum class Quantity {
  length,    ///< positive, in any unit, the same for all of an entry
  position,  ///< a coordinate or offset: any sign, zero too
  offset,    ///< a distance that may be zero
  angle,     ///< in degrees: a right angle and 60° are then exact
  count,     ///< a whole number
};

struct Parameter {
  const char* symbol;
  Quantity quantity;
  const char* meaning;
  double least = 0;  ///< of angles and counts, both included
  double greatest = 0;
};

constexpr Parameter length(const char* symbol, const char* meaning) {
  return {symbol, Quantity::length, meaning};
}
constexpr Parameter position(const char* symbol, const char* meaning) {
  return {symbol, Quantity::position, meaning};
}
constexpr Parameter offset(const char* symbol, const char* meaning) {
  return {symbol, Quantity::offset, meaning};
}
constexpr Parameter angle(const char* symbol, const char* meaning, double least, double greatest) {
  return {symbol, Quantity::angle, meaning, least, greatest};
}
constexpr Parameter count(const char* symbol, const char* meaning, double least, double greatest) {
  return {symbol, Quantity::count, meaning, least, greatest};
}

/// A rule between parameters: `holds` in words, and which parameter is named when it does not.
struct Condition {
  const char* rule;
  const char* names;
  bool (*holds)(std::span<const double>);
};

/// The parameters of one call: lengths scaled by a common power of two, angles in degrees, counts as they are.
using Values = std::span<const Counted>;

/// A parameter that came in as an exact double: angles and counts.
inline double exact(const Counted& value) {
  return value.value.high;
}

enum class Accuracy {
  proved,    ///< the bound counts every rounding of a closed form
  measured,  ///< the formula holds an integral, taken by two Gauss rules; their difference is in the bound
};

/// One configuration: everything that the page, the picture, the command and the tests need to know.
struct Entry {
  const char* id;      ///< of Howell's catalogue where it was seen with its title, else a name of our own
  const char* number;  ///< Howell's number where it is likely but was not seen; else ""
  const char* title;
  std::vector<Parameter> parameters;
  std::vector<Condition> conditions;
  double widest_ratio;  ///< between any two lengths: to there the bound stays below kCatalogueError of the value
  const char* formula;
  const char* source;
  const char* care;  ///< what goes wrong at the edges in plain double, and what is done
  Accuracy accuracy;
  Counted (*factor)(Values);
  Counted (*area_from)(Values);  ///< null where the surface is an element or infinitely long
  Counted (*area_to)(Values);
  Drawing (*picture)();
};

}  // namespace etendue::catalogue
