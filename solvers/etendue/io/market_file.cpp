// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/market_file.hpp"

#include <algorithm>
#include <cctype>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "etendue/io/atomic_file.hpp"
#include "etendue/io/read_errors.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

namespace fs = std::filesystem;

/// StorageIndex of an Eigen::SparseMatrix is an int.
constexpr long kMost = std::numeric_limits<int>::max();

struct Line {
  std::size_t number = 0;
  std::vector<std::string_view> words;
};

/// The lines that say something, without comments.
std::vector<Line> lines(std::string_view text) {
  std::vector<Line> result;
  std::size_t number = 0;
  for (const std::string_view raw : lines_of(text)) {
    ++number;
    if (number > 1 && !raw.empty() && raw[0] == '%') continue;
    std::vector<std::string_view> words = words_of(raw, " \t");
    if (!words.empty()) result.push_back({number, std::move(words)});
  }
  return result;
}

std::string lowered(std::string_view word) {
  std::string text(word);
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

struct Entry {
  long row, column;
  double value;
  std::size_t line;
};

class Reader {
 public:
  explicit Reader(const fs::path& path) : errors_(path.string()) {}

  Result<SparseRows> read(std::string_view text) {
    const std::vector<Line> all = lines(text);
    if (!header(all) || !sizes(all)) return errors_.error();
    for (std::size_t k = 2; k < all.size() && errors_.count() <= ReadErrors::kMostLines; ++k) {
      array_ ? number(all[k]) : coordinate(all[k]);
    }
    if (errors_.count() == 0) counted(all.back().number);
    if (errors_.count() == 0) mirror();
    if (errors_.count() == 0) twice();
    if (errors_.count() > 0) return errors_.error();
    std::vector<Eigen::Triplet<double>> triplets;
    triplets.reserve(entries_.size());
    for (const Entry& entry : entries_) {
      if (entry.value != 0)
        triplets.emplace_back(static_cast<int>(entry.row), static_cast<int>(entry.column), entry.value);
    }
    SparseRows matrix(rows_, columns_);
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    return matrix;
  }

 private:
  bool header(const std::vector<Line>& all) {
    const bool right = !all.empty() && all[0].number == 1 && all[0].words.size() == 5 &&
                       lowered(all[0].words[0]) == "%%matrixmarket" && lowered(all[0].words[1]) == "matrix";
    const std::string form = right ? lowered(all[0].words[2]) : "", field = right ? lowered(all[0].words[3]) : "",
                      symmetry = right ? lowered(all[0].words[4]) : "";
    array_ = form == "array";
    symmetric_ = symmetry == "symmetric";
    if ((array_ || form == "coordinate") && (field == "real" || field == "integer") &&
        (symmetric_ || symmetry == "general")) {
      return true;
    }
    errors_.add(1, "expected '%%MatrixMarket matrix coordinate|array real|integer general|symmetric'");
    return false;
  }

  bool sizes(const std::vector<Line>& all) {
    std::vector<long> values;
    if (all.size() > 1) {
      for (const std::string_view word : all[1].words) values.push_back(parse_integer(word).value_or(-1));
    }
    const bool fit = values.size() == (array_ ? 2u : 3u) &&
                     std::all_of(values.begin(), values.end(), [](long v) { return v >= 0 && v < kMost; });
    if (!fit || values[0] < 1 || values[1] < 1 || (symmetric_ && values[0] != values[1])) {
      errors_.add(all.size() > 1 ? all[1].number : 0, array_ ? "expected two positive numbers: rows and columns"
                                                             : "expected three numbers: rows, columns and entries");
      return false;
    }
    rows_ = values[0];
    columns_ = values[1];
    promised_ = !array_ ? values[2] : symmetric_ ? rows_ * (rows_ + 1) / 2 : rows_ * columns_;
    return true;
  }

  void coordinate(const Line& line) {
    const bool three = line.words.size() == 3;
    const std::optional<long> i = three ? parse_integer(line.words[0]) : std::nullopt;
    const std::optional<long> j = three ? parse_integer(line.words[1]) : std::nullopt;
    const std::optional<double> value = three ? parse_number(line.words[2]) : std::nullopt;
    if (!i || !j || !value) return errors_.add(line.number, "expected row, column and a finite number");
    if (*i < 1 || *i > rows_ || *j < 1 || *j > columns_) {
      return errors_.add(line.number, "entry (" + std::to_string(*i) + ", " + std::to_string(*j) + ") is outside of " +
                                          std::to_string(rows_) + " × " + std::to_string(columns_));
    }
    entries_.push_back({*i - 1, *j - 1, *value, line.number});
  }

  /// Column after column; of a symmetric one, what is on and below the diagonal.
  void number(const Line& line) {
    for (const std::string_view word : line.words) {
      const std::optional<double> value = parse_number(word);
      if (!value) return errors_.add(line.number, "found '" + shown(word) + "', expected a finite number");
      if (column_ >= columns_) {
        extra_ = true;
        return;
      }
      entries_.push_back({row_, column_, *value, line.number});
      if (++row_ == rows_) {
        ++column_;
        row_ = symmetric_ ? column_ : 0;
      }
    }
  }

  void counted(std::size_t last) {
    if (static_cast<long>(entries_.size()) == promised_ && !extra_) return;
    errors_.add(last, "found " + std::string(extra_ ? "more than " : "") + std::to_string(entries_.size()) +
                          " entries, expected " + std::to_string(promised_));
  }

  void mirror() {
    if (!symmetric_) return;
    for (std::size_t k = 0, own = entries_.size(); k < own; ++k) {
      const Entry entry = entries_[k];
      if (entry.row != entry.column) entries_.push_back({entry.column, entry.row, entry.value, entry.line});
    }
  }

  void twice() {
    std::stable_sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
      return a.row != b.row ? a.row < b.row : a.column < b.column;
    });
    for (std::size_t k = 1; k < entries_.size(); ++k) {
      const Entry &a = entries_[k - 1], &b = entries_[k];
      if (a.row != b.row || a.column != b.column) continue;
      errors_.add(b.line, "entry (" + std::to_string(b.row + 1) + ", " + std::to_string(b.column + 1) +
                              ") is in line " + std::to_string(a.line) + " already");
    }
  }

  ReadErrors errors_;
  bool array_ = false, symmetric_ = false, extra_ = false;
  long rows_ = 0, columns_ = 0, promised_ = 0, row_ = 0, column_ = 0;
  std::vector<Entry> entries_;
};

}  // namespace

Result<SparseRows> read_market(const fs::path& path) {
  const auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  return Reader(path).read(*bytes);
}

}  // namespace etendue
