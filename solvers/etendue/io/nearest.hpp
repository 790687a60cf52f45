// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace etendue {

/// Fewest insertions, deletions, substitutions and swaps of neighbours that turn one word into the other; letters count
/// as equal whatever their case (optimal string alignment distance).
[[nodiscard]] std::size_t edit_distance(std::string_view from, std::string_view to);

/// The candidate that `word` was most likely meant to be: the nearest one, the first of equals, or none when even that
/// one differs in more than a third of its letters (and in more than one).
[[nodiscard]] std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& candidates);

/// "; did you mean 'x'?", or nothing when no candidate is near.
[[nodiscard]] std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace etendue
