// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "etendue/core/bounded.hpp"
#include "etendue/core/result.hpp"
#include "etendue/form_factor/catalogue/entry.hpp"

/// Configurations with a form factor in closed form: formula, picture, domain and source of each.
namespace etendue::catalogue {

/// Lengths within [kShortest, kLongest]; their ratios within each entry's widest_ratio; offsets and positions at most
/// kWidestPosition times as long as the longest length.
inline constexpr double kShortest = 1e-100;
inline constexpr double kLongest = 1e100;
inline constexpr double kWidestPosition = 1e6;

/// The bound's share of the value that every entry keeps in its domain, but for those whose `care` says otherwise.
/// Tested over every entry's domain to its ends (validation/form_factor/catalogue/domain_test.cpp).
inline constexpr double kCatalogueError = 1e-12;

/// All entries, family by family.
[[nodiscard]] const std::vector<Entry>& entries();

/// The entry of that id; null where there is none.
[[nodiscard]] const Entry* find(std::string_view id);

/// What is wrong with the parameters, naming the first that breaks a rule, what was found and what is allowed.
[[nodiscard]] std::optional<std::string> complaint(const Entry& entry, std::span<const double> parameters);

/// The form factor from the entry's first surface to its second.                       @eq IU.6-2, IU.6-3
///
/// Domain    as complaint() says
/// Returns   value and a bound on its absolute error; invariant under scaling the lengths by a power of two
/// Accuracy  proved where the entry says so: every rounding is counted (counted.hpp); else measured
/// Errors    invalid_input outside the domain, with complaint()'s words
[[nodiscard]] Result<Bounded> form_factor(const Entry& entry, std::span<const double> parameters);

/// The factor from the second surface to the first, by reciprocity; none where an area is not finite.  @eq IU.6-5
[[nodiscard]] Result<std::optional<Bounded>> reverse_form_factor(const Entry& entry,
                                                                 std::span<const double> parameters);

/// The entry's picture.
[[nodiscard]] std::string svg(const Entry& entry);

/// Its unit in words: "length", "degrees", "".
[[nodiscard]] const char* unit(Quantity quantity);

/// What the parameter alone may be, in words.
[[nodiscard]] std::string domain(const Parameter& parameter);

}  // namespace etendue::catalogue
