// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/read_errors.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

void ReadErrors::add(std::size_t place, const std::string& message) {
  lines_.emplace_back(place, message);
}

Error ReadErrors::error() const {
  std::vector<std::pair<std::size_t, std::string>> sorted = lines_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string text;
  for (std::size_t k = 0; k < std::min(sorted.size(), kMostLines); ++k) {
    const auto& [place, message] = sorted[k];
    text += printable(file_) + ":" + (place > 0 ? std::to_string(place) + ":" : "") + " " + message + "\n";
  }
  if (sorted.size() > kMostLines) text += "… and " + std::to_string(sorted.size() - kMostLines) + " more\n";
  return {ErrorCode::invalid_input, text + counted_errors(sorted.size())};
}

std::optional<double> parse_number(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<long> parse_integer(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  long value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    lines.push_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::vector<std::string_view> words_of(std::string_view line, std::string_view separators) {
  std::vector<std::string_view> words;
  for (;;) {
    const std::size_t begin = line.find_first_not_of(separators);
    if (begin == std::string_view::npos) return words;
    const std::size_t end = std::min(line.find_first_of(separators, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    line.remove_prefix(end);
  }
}

std::string shown(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  return printable(word, kLongest);
}

}  // namespace etendue
