// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/catalogue/catalogue.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

#include "etendue/core/contract.hpp"
#include "etendue/core/text_of.hpp"
#include "etendue/form_factor/catalogue/families.hpp"

namespace etendue::catalogue {

namespace {

bool is_extent(Quantity quantity) {
  return quantity == Quantity::length || quantity == Quantity::position || quantity == Quantity::offset;
}

bool is_allowed(const Parameter& parameter, double value) {
  if (!std::isfinite(value)) return false;
  const double size = std::abs(value);
  switch (parameter.quantity) {
    case Quantity::length:
      return value >= kShortest && value <= kLongest;
    case Quantity::offset:
      return value == 0 || (value >= kShortest && value <= kLongest);
    case Quantity::position:
      return value == 0 || (size >= kShortest && size <= kLongest);
    case Quantity::angle:
      return value >= parameter.least && value <= parameter.greatest;
    case Quantity::count:
      return value >= parameter.least && value <= parameter.greatest && value == std::floor(value);
  }
  return false;
}

std::string as_text(double value) {
  std::ostringstream brief;
  brief << value;
  return std::stod(brief.str()) == value ? brief.str() : text_of(value);
}

std::string found(const Parameter& parameter, double value) {
  return std::string(parameter.symbol) + " = " + as_text(value) + " (" + parameter.meaning + "): ";
}

/// The lengths scaled so that the longest lies in [1, 2): exact but for what is lost below 2^-1000 of it.
std::vector<Counted> scaled(const Entry& entry, std::span<const double> parameters) {
  double longest = 0;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (is_extent(entry.parameters[i].quantity)) longest = std::max(longest, std::abs(parameters[i]));
  }
  const int exponent = longest > 0 ? std::ilogb(longest) : 0;
  std::vector<Counted> values;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const bool extent = is_extent(entry.parameters[i].quantity);
    values.emplace_back(extent ? std::ldexp(parameters[i], -exponent) : parameters[i]);
  }
  return values;
}

std::optional<std::string> ratio_complaint(const Entry& entry, std::span<const double> parameters) {
  std::optional<std::size_t> shortest, longest;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (entry.parameters[i].quantity != Quantity::length) continue;
    if (!shortest || parameters[i] < parameters[*shortest]) shortest = i;
    if (!longest || parameters[i] > parameters[*longest]) longest = i;
  }
  if (!shortest) return std::nullopt;
  if (parameters[*longest] / parameters[*shortest] > entry.widest_ratio) {
    return found(entry.parameters[*shortest], parameters[*shortest]) + "expected at least " +
           entry.parameters[*longest].symbol + "/" + as_text(entry.widest_ratio) + ", where " +
           entry.parameters[*longest].symbol + " = " + as_text(parameters[*longest]);
  }
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Quantity quantity = entry.parameters[i].quantity;
    const bool moves = quantity == Quantity::position || quantity == Quantity::offset;
    if (moves && std::abs(parameters[i]) > kWidestPosition * parameters[*longest]) {
      return found(entry.parameters[i], parameters[i]) + "expected at most " + as_text(kWidestPosition) + " times " +
             entry.parameters[*longest].symbol + ", which is " + as_text(parameters[*longest]);
    }
  }
  return std::nullopt;
}

Bounded clamped(const Counted& factor) {
  const Bounded f = bounded(factor);
  // A factor is within [0, 1]; moving the value there brings it nearer to the truth.
  return {std::clamp(f.value, 0.0, 1.0), f.bound};
}

}  // namespace

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = [] {
    std::vector<Entry> result;
    for (const auto family :
         {elements_to_polygons, elements_to_discs, elements_to_solids, strips, tubes_and_grooves, rectangle_entries,
          boxes_and_tetrahedra, discs, cylinders, concentric_cylinders, spheres, cones}) {
      std::vector<Entry> some = family();
      std::move(some.begin(), some.end(), std::back_inserter(result));
    }
    return result;
  }();
  return all;
}

const Entry* find(std::string_view id) {
  const auto& all = entries();
  const auto entry = std::find_if(all.begin(), all.end(), [&](const Entry& e) { return id == e.id; });
  return entry == all.end() ? nullptr : &*entry;
}

const char* unit(Quantity quantity) {
  if (quantity == Quantity::angle) return "degrees";
  return quantity == Quantity::count ? "" : "length";
}

std::string domain(const Parameter& parameter) {
  const std::string range = as_text(parameter.least) + ", " + as_text(parameter.greatest) + "]";
  switch (parameter.quantity) {
    case Quantity::length:
      return "a length in [1e-100, 1e+100]";
    case Quantity::offset:
      return "0 or a length in [1e-100, 1e+100]";
    case Quantity::position:
      return "0 or a coordinate of size in [1e-100, 1e+100]";
    case Quantity::angle:
      return "an angle in [" + range + " degrees";
    case Quantity::count:
      return "a whole number in [" + range;
  }
  return "";
}

std::optional<std::string> complaint(const Entry& entry, std::span<const double> parameters) {
  require(parameters.size() == entry.parameters.size(), "catalogue: as many values as the entry has parameters");
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!is_allowed(entry.parameters[i], parameters[i])) {
      return found(entry.parameters[i], parameters[i]) + "expected " + domain(entry.parameters[i]);
    }
  }
  if (auto ratio = ratio_complaint(entry, parameters)) return ratio;
  for (const Condition& condition : entry.conditions) {
    if (condition.holds(parameters)) continue;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      if (std::string_view(entry.parameters[i].symbol) == condition.names) {
        return found(entry.parameters[i], parameters[i]) + "expected " + condition.rule;
      }
    }
  }
  return std::nullopt;
}

Result<Bounded> form_factor(const Entry& entry, std::span<const double> parameters) {
  if (const auto wrong = complaint(entry, parameters)) {
    return Error{ErrorCode::invalid_input, std::string(entry.id) + ": " + *wrong};
  }
  return clamped(entry.factor(scaled(entry, parameters)));
}

Result<std::optional<Bounded>> reverse_form_factor(const Entry& entry, std::span<const double> parameters) {
  if (const auto wrong = complaint(entry, parameters)) {
    return Error{ErrorCode::invalid_input, std::string(entry.id) + ": " + *wrong};
  }
  if (!entry.area_from || !entry.area_to) return std::optional<Bounded>();
  const std::vector<Counted> values = scaled(entry, parameters);
  return std::optional<Bounded>(clamped(entry.factor(values) * entry.area_from(values) / entry.area_to(values)));
}

std::string svg(const Entry& entry) {
  return entry.picture().svg(std::string(entry.id) + ": " + entry.title);
}

}  // namespace etendue::catalogue
