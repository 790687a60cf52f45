// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "etendue/core/result.hpp"

namespace etendue {

/// What is wrong with a file of lines, in their order.
class ReadErrors {
 public:
  explicit ReadErrors(std::string file) : file_(std::move(file)) {}

  /// `place` is a line number, or 0 where the whole file is meant.
  void add(std::size_t place, const std::string& message);
  std::size_t count() const { return lines_.size(); }
  /// "room.vs3:12: surface 3 'floor': …", one line each, and their number. Beyond kMostLines only the number.
  Error error() const;

  static constexpr std::size_t kMostLines = 1000;

 private:
  std::string file_;
  std::vector<std::pair<std::size_t, std::string>> lines_;
};

/// No coordinate is larger: fourth powers of lengths stay finite.
inline constexpr double kFarthestCoordinate = 1e50;

/// The finite number that all of `word` spells; a leading '+' is allowed.
[[nodiscard]] std::optional<double> parse_number(std::string_view word);
/// The integer that all of `word` spells.
[[nodiscard]] std::optional<long> parse_integer(std::string_view word);

/// `text` cut at newlines, carriage returns dropped.
[[nodiscard]] std::vector<std::string_view> lines_of(std::string_view text);
/// `line` cut at any of `separators`.
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view line, std::string_view separators);

/// A word as a message shows it: short, one line, whatever the file holds.
[[nodiscard]] std::string shown(std::string_view word);

}  // namespace etendue
