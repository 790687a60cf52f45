// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/matrix_file.hpp"

#include <charconv>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "etendue/io/atomic_file.hpp"
#include "etendue/io/byte_text.hpp"
#include "etendue/io/nearest.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

namespace fs = std::filesystem;

const std::vector<std::string>& endings() {
  static const std::vector<std::string> all{".csv", ".npy", ".mtx", ".json", ".vf"};
  return all;
}

/// Gathers what is written into pieces of a sensible size; remembers the first failure.
class Sink {
 public:
  explicit Sink(const Append& append) : append_(append) {}

  void text(std::string_view words) {
    piece_ += words;
    constexpr std::size_t kPiece = std::size_t{1} << 20;
    if (piece_.size() >= kPiece) flush();
  }
  /// As printf's "%.17g", whatever the locale.
  void number(double value) {
    char digits[40];
    const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 17).ptr;
    text({digits, static_cast<std::size_t>(end - digits)});
  }
  Result<Done> close() {
    flush();
    return state_;
  }

 private:
  void flush() {
    if (state_) state_ = append_(piece_);
    piece_.clear();
  }

  const Append& append_;
  std::string piece_;
  Result<Done> state_ = Done{};
};

void write_csv(Sink& sink, const ExchangeMatrix& matrix) {
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    for (std::size_t j = 0; j < matrix.size(); ++j) {
      if (j > 0) sink.text(",");
      sink.number(matrix.factor(i, j).value);
    }
    sink.text("\n");
  }
}

/// NumPy's format 1.0.
void write_npy(Sink& sink, const ExchangeMatrix& matrix) {
  sink.text(npy_header(matrix.size(), matrix.size()));
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    std::string row;
    for (std::size_t j = 0; j < matrix.size(); ++j) append_little(row, matrix.factor(i, j).value);
    sink.text(row);
  }
}

void write_mtx(Sink& sink, const ExchangeMatrix& matrix, const MatrixFacts& facts) {
  std::size_t entries = 0;
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    for (std::size_t j = 0; j < matrix.size(); ++j) entries += matrix.exchange(i, j) != 0;
  }
  const std::string n = std::to_string(matrix.size());
  sink.text("%%MatrixMarket matrix coordinate real general\n% form factors, row = from, column = to; " + facts.program +
            "\n" + n + " " + n + " " + std::to_string(entries) + "\n");
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    for (std::size_t j = 0; j < matrix.size(); ++j) {
      if (matrix.exchange(i, j) == 0) continue;
      sink.text(std::to_string(i + 1) + " " + std::to_string(j + 1) + " ");
      sink.number(matrix.factor(i, j).value);
      sink.text("\n");
    }
  }
}

template <class Write>
void write_array(Sink& sink, std::size_t size, const Write& write) {
  sink.text("[");
  for (std::size_t k = 0; k < size; ++k) {
    if (k > 0) sink.text(", ");
    write(k);
  }
  sink.text("]");
}

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void write_json(Sink& sink, const ExchangeMatrix& matrix, const RowClosure& closure, const MatrixFacts& facts) {
  const std::size_t n = matrix.size();
  const TileReport report = matrix.report();
  const auto numbers = [&](const char* key, const std::vector<double>& values) {
    sink.text(std::string(",\n \"") + key + "\": ");
    write_array(sink, values.size(), [&](std::size_t k) { sink.number(values[k]); });
  };
  const auto square = [&](const char* key, const auto& value) {
    sink.text(std::string(",\n \"") + key + "\": [\n");
    for (std::size_t i = 0; i < n; ++i) {
      if (i > 0) sink.text(",\n");
      sink.text("  ");
      write_array(sink, n, [&](std::size_t j) { sink.number(value(i, j)); });
    }
    sink.text("\n ]");
  };
  sink.text("{\n \"program\": " + quoted(facts.program) + ",\n \"method\": " + quoted(facts.method) +
            ",\n \"scene\": " + quoted(facts.scene) + ",\n \"hash\": " + quoted(facts.hash) + ",\n \"relative\": ");
  sink.number(facts.tolerance.relative);
  sink.text(",\n \"absolute\": ");
  sink.number(facts.tolerance.absolute);
  sink.text(std::string(",\n \"closure_repaired\": ") + (facts.repaired ? "true" : "false") +
            ",\n \"metres_per_unit\": ");
  if (facts.metres_per_unit) {
    sink.number(*facts.metres_per_unit);
  } else {
    sink.text("null");
  }
  sink.text(",\n \"n\": " + std::to_string(n) + ",\n \"pairs\": {\"averted\": " + std::to_string(report.averted) +
            ", \"clear\": " + std::to_string(report.clear) + ", \"blocked\": " + std::to_string(report.blocked) +
            ", \"obstructed\": " + std::to_string(report.obstructed) +
            ", \"beyond_tolerance\": " + std::to_string(report.beyond) + "}");
  sink.text(",\n \"names\": ");
  write_array(sink, n, [&](std::size_t k) { sink.text(quoted(facts.names[k])); });
  numbers("areas", matrix.areas());
  if (facts.metres_per_unit) {
    std::vector<double> square_metres = matrix.areas();
    for (double& area : square_metres) area *= *facts.metres_per_unit * *facts.metres_per_unit;
    numbers("areas_m2", square_metres);
  }
  square("F", [&](std::size_t i, std::size_t j) { return matrix.factor(i, j).value; });
  square("bounds", [&](std::size_t i, std::size_t j) { return matrix.factor(i, j).bound; });
  numbers("row_sums", closure.sums);
  numbers("row_bounds", closure.bounds);
  std::vector<double> defects;
  for (const double sum : closure.sums) defects.push_back(1 - sum);
  numbers("row_defects", defects);
  sink.text("\n}\n");
}

/// View3D's text layout: a line of 30 characters, areas, rows, emittances.
void write_vf(Sink& sink, const ExchangeMatrix& matrix, const MatrixFacts& facts) {
  const auto printed = [&](const char* format, double value) {
    char text[400];  // "%.6f" of the largest double has 316 characters
    std::snprintf(text, sizeof text, format, value);
    return std::string(text);
  };
  std::string header = "View3D 4.0.0 0 0 0 " + std::to_string(matrix.size());
  constexpr std::size_t kHeader = 30;
  if (header.size() < kHeader) header.append(kHeader - header.size(), ' ');
  sink.text(header + "\n");
  const auto line = [&](const char* format, const auto& value) {
    for (std::size_t k = 0; k < matrix.size(); ++k) sink.text((k > 0 ? " " : "") + printed(format, value(k)));
    sink.text("\n");
  };
  line("%g", [&](std::size_t k) { return matrix.areas()[k]; });
  for (std::size_t i = 0; i < matrix.size(); ++i) {
    line("%.6f", [&](std::size_t j) { return matrix.factor(i, j).value; });
  }
  line("%.3f", [&](std::size_t k) { return facts.emittances[k]; });
}

}  // namespace

Result<Done> check_matrix_path(const fs::path& path) {
  const std::string ending = path.extension().string();
  for (const std::string& known : endings()) {
    if (ending == known) return Done{};
  }
  return Error{ErrorCode::usage, quoted_path(path) + ": found ending '" + printable(ending) +
                                     "', expected .csv, .npy, .mtx, .json or .vf" + did_you_mean(ending, endings())};
}

Result<Done> write_form_factors(const fs::path& path, const ExchangeMatrix& matrix, const RowClosure& closure,
                                const MatrixFacts& facts) {
  if (const auto known = check_matrix_path(path); !known) return known;
  require(facts.names.size() == matrix.size() && facts.emittances.size() == matrix.size(),
          "write_form_factors: a name and an emittance a row");
  return write_pieces(path, [&](const Append& append) {
    Sink sink(append);
    const std::string ending = path.extension().string();
    if (ending == ".csv") write_csv(sink, matrix);
    if (ending == ".npy") write_npy(sink, matrix);
    if (ending == ".mtx") write_mtx(sink, matrix, facts);
    if (ending == ".json") write_json(sink, matrix, closure, facts);
    if (ending == ".vf") write_vf(sink, matrix, facts);
    return sink.close();
  });
}

}  // namespace etendue
