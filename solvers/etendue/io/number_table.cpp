// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/number_table.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <regex>
#include <utility>
#include <vector>

#include "etendue/io/atomic_file.hpp"
#include "etendue/io/market_file.hpp"
#include "etendue/io/read_errors.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

namespace fs = std::filesystem;

Error bad_file(const fs::path& path, const std::string& what) {
  return {ErrorCode::invalid_input, printable(path.string()) + ": " + what};
}

std::string_view without_comment(std::string_view line) {
  return line.substr(0, std::min(line.find('#'), line.size()));
}

Result<NumberTable> read_text(const fs::path& path, std::string_view text) {
  ReadErrors errors(path.string());
  std::vector<double> values;
  std::vector<std::size_t> lines;
  std::size_t columns = 0, number = 0;
  for (const std::string_view raw : lines_of(text)) {
    ++number;
    const std::vector<std::string_view> words = words_of(without_comment(raw), ",; \t");
    if (words.empty()) continue;
    if (lines.empty()) columns = words.size();
    lines.push_back(number);
    if (words.size() != columns) {
      errors.add(number, "found " + std::to_string(words.size()) + " numbers, expected " + std::to_string(columns) +
                             " as in the first row");
      if (errors.count() > ReadErrors::kMostLines) break;
      continue;
    }
    for (std::size_t k = 0; k < words.size(); ++k) {
      const std::optional<double> value = parse_number(words[k]);
      if (!value) {
        errors.add(number,
                   "column " + std::to_string(k + 1) + ": found '" + shown(words[k]) + "', expected a finite number");
      }
      values.push_back(value.value_or(0));
    }
    if (errors.count() > ReadErrors::kMostLines) break;
  }
  if (errors.count() > 0) return errors.error();
  if (lines.empty()) return bad_file(path, "holds no numbers");
  const auto rows = static_cast<Eigen::Index>(lines.size());
  return NumberTable{Eigen::Map<const RowMatrix>(values.data(), rows, static_cast<Eigen::Index>(columns)), true,
                     std::move(lines)};
}

/// What a .npy says of its data.
struct Layout {
  std::size_t begin = 0;  ///< of the data in the file
  bool big_endian = false, single = false, by_columns = false;
  Eigen::Index rows = 0, columns = 0;
};

std::optional<Eigen::Index> dimension(const std::string& text) {
  const std::optional<long> value = parse_integer(text);
  constexpr long kMost = 1 << 30;
  if (!value || *value < 1 || *value > kMost) return std::nullopt;
  return *value;
}

/// The header is a Python dictionary with three keys, whose order is free.
Result<Layout> npy_layout(const fs::path& path, const std::string& bytes) {
  constexpr std::size_t kMagic = 6, kVersion = 2;
  const bool magic = bytes.size() > 12 && bytes.compare(0, kMagic, "\x93NUMPY") == 0;
  if (!magic) return bad_file(path, "is no NumPy file");
  const auto byte = [&](std::size_t k) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes[k])); };
  const std::size_t wide = byte(kMagic) >= 2 ? 4 : 2;
  std::size_t length = 0;
  for (std::size_t k = wide; k-- > 0;) length = length << 8 | byte(kMagic + kVersion + k);
  const std::size_t begin = kMagic + kVersion + wide;
  if (byte(kMagic) > 3 || length > bytes.size() - begin) return bad_file(path, "the NumPy header is cut short");
  const std::string header = bytes.substr(begin, length);
  const auto found = [&](const char* pattern) {
    std::smatch match;
    return std::regex_search(header, match, std::regex(pattern)) ? match[1].str() : std::string();
  };
  const std::string type = found("'descr'\\s*:\\s*'([^']*)'"), order = found("'fortran_order'\\s*:\\s*(True|False)");
  const std::string shape = found("'shape'\\s*:\\s*\\(([^)]*)\\)");
  if (type != "<f8" && type != ">f8" && type != "<f4" && type != ">f4") {
    return bad_file(path, "found numbers of type '" + shown(type) + "', expected <f8, >f8, <f4 or >f4");
  }
  std::vector<Eigen::Index> sizes;
  for (const std::string_view word : words_of(shape, ", ")) {
    const auto size = dimension(std::string(word));
    if (!size) return bad_file(path, "found shape (" + shown(shape) + "), expected one or two positive numbers");
    sizes.push_back(*size);
  }
  if (sizes.empty() || sizes.size() > 2 || order.empty()) {
    return bad_file(path, "found shape (" + shown(shape) + "), expected one or two dimensions");
  }
  return Layout{begin + length,  type[0] == '>', type[2] == '4',
                order == "True", sizes[0],       sizes.size() > 1 ? sizes[1] : 1};
}

template <class Number, class Word>
double number_at(const char* bytes, bool big_endian) {
  Word word = 0;
  for (std::size_t k = 0; k < sizeof word; ++k) {
    const auto byte = static_cast<unsigned char>(bytes[big_endian ? k : sizeof word - 1 - k]);
    word = static_cast<Word>(word << 8 | byte);
  }
  return static_cast<double>(std::bit_cast<Number>(word));
}

Result<NumberTable> read_npy(const fs::path& path, const std::string& bytes) {
  const auto layout = npy_layout(path, bytes);
  if (!layout) return layout.error();
  const std::size_t wide = layout->single ? 4 : 8;
  const auto count = static_cast<std::size_t>(layout->rows) * static_cast<std::size_t>(layout->columns);
  if ((bytes.size() - layout->begin) / wide < count) {
    return bad_file(path, "holds " + std::to_string((bytes.size() - layout->begin) / wide) + " numbers, expected " +
                              std::to_string(layout->rows) + " × " + std::to_string(layout->columns));
  }
  NumberTable table{RowMatrix(layout->rows, layout->columns), false, {}};
  for (Eigen::Index i = 0; i < layout->rows; ++i) {
    for (Eigen::Index j = 0; j < layout->columns; ++j) {
      const Eigen::Index at = layout->by_columns ? j * layout->rows + i : i * layout->columns + j;
      const char* place = bytes.data() + layout->begin + static_cast<std::size_t>(at) * wide;
      const double value = layout->single ? number_at<float, std::uint32_t>(place, layout->big_endian)
                                          : number_at<double, std::uint64_t>(place, layout->big_endian);
      if (!std::isfinite(value)) {
        return bad_file(path, "entry (" + std::to_string(i) + ", " + std::to_string(j) + ") is not a finite number");
      }
      table.values(i, j) = value;
    }
  }
  return table;
}

Error not_square(const fs::path& path, Eigen::Index rows, Eigen::Index columns) {
  return bad_file(path, "found " + std::to_string(rows) + " rows of " + std::to_string(columns) +
                            " numbers; form factors are a square matrix, a row and a column a patch");
}

}  // namespace

Result<NumberTable> read_number_table(const fs::path& path) {
  const auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  return path.extension() == ".npy" ? read_npy(path, *bytes) : read_text(path, *bytes);
}

Eigen::Index FactorsFile::size() const {
  return std::visit([](const auto& matrix) { return matrix.rows(); }, factors);
}

Result<FactorsFile> read_factors(const fs::path& path) {
  if (path.extension() == ".mtx") {
    auto matrix = read_market(path);
    if (!matrix) return matrix.error();
    if (matrix->rows() != matrix->cols()) return not_square(path, matrix->rows(), matrix->cols());
    return FactorsFile{std::move(matrix).value(), true, {}};
  }
  auto table = read_number_table(path);
  if (!table) return table.error();
  if (table->values.rows() != table->values.cols()) {
    return not_square(path, table->values.rows(), table->values.cols());
  }
  NumberTable read = std::move(table).value();
  return FactorsFile{std::move(read.values), read.decimal, std::move(read.lines)};
}

}  // namespace etendue
