// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "etendue/core/bounded.hpp"
#include "etendue/form_factor/parallelogram.hpp"
#include "etendue/geometry/polygon.hpp"

namespace etendue {

/// Which instructions the product rules run on. Both give the same bits: lanes only add, multiply and divide.
enum class Instructions { portable, widest };

struct IndexPair {
  std::uint32_t from, to;
};

/// What an absolute error is asked of: the factor from the first to the second, or that and the one back.
enum class AbsoluteError { of_this, of_both };

/// Free form factors from one polygon to many: what form_factor() returns, some hundred times faster where
/// parallelograms lie apart. Pairs of those go through product Gauss rules, eight at a time, with an a-priori number of
/// nodes for each of the four directions; everything else goes through form_factor().
///
/// Domain    any polygons; parallelograms (rectangles) are the fast ones. Nothing is known of obstruction: name only
///           columns that are clear
/// Returns   value and bound for each column, 0 with bound 0 where the two avert their faces or lie in one plane
/// Accuracy  |value − F| ≤ bound, and the bound reaches the tolerance wherever form_factor() does: proved, NOTES.md §8
/// Errors    ContractViolation for a negative tolerance, an index out of range, or spans of different sizes
class FactorRows {
 public:
  explicit FactorRows(std::vector<Polygon> polygons, Instructions instructions = Instructions::widest);

  std::size_t size() const { return polygons_.size(); }

  /// F of each pair, in their order. A pair's bits depend on nothing but its polygons and the tolerance.
  void pairs(std::span<const IndexPair> pairs, Tolerance tolerance, AbsoluteError side,
             std::span<Bounded> factors) const;

  /// F from polygon `from` to each of `columns`, in their order.
  void row(std::size_t from, std::span<const std::uint32_t> columns, Tolerance tolerance,
           std::span<Bounded> factors) const;

 private:
  class Call;
  std::vector<Polygon> polygons_;
  std::vector<Parallelogram> patches_;
  bool wide_;
};

/// The product rule for a single pair; nothing where it does not apply, or form_factor() would be the cheaper one.
[[nodiscard]] std::optional<Bounded> product_factor(const Polygon& from, const Polygon& to, Tolerance tolerance);

}  // namespace etendue
