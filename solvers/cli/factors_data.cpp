// SPDX-License-Identifier: Apache-2.0
#include "factors_data.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "etendue/core/interval.hpp"
#include "etendue/io/read_errors.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue::cli {

namespace {

namespace fs = std::filesystem;

Error in_file(const std::string& file, const std::string& what) {
  return {ErrorCode::invalid_input, printable(file) + ": " + what};
}

/// "R.csv:7: row 3: ", or what can be said of it.
std::string place(const std::string& file, const std::vector<std::size_t>& lines, Eigen::Index row) {
  const auto k = static_cast<std::size_t>(row);
  return printable(file) + ":" + (k < lines.size() ? std::to_string(lines[k]) + ": " : " ") + "row " +
         std::to_string(row) + ": ";
}

/// An option's number, or the file of numbers that it names.
struct Column {
  std::string source;
  NumberTable table;  ///< 1 × 1 for a number
  bool number = false;
};

/// A word that reads as a number that is none to compute with: nan, inf, or beyond what double holds.
bool is_no_finite_number(std::string_view word) {
  if (word.size() > 1 && (word[0] == '+' || word[0] == '-')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error != std::errc::invalid_argument && end == word.data() + word.size();
}

Result<Column> column(const std::string& option, const std::string& text) {
  if (const auto value = parse_number(text)) {
    return Column{option, {RowMatrix::Constant(1, 1, *value), true, {}}, true};
  }
  if (is_no_finite_number(text)) {
    return Error{ErrorCode::invalid_input, option + ": found '" + printable(text) + "', expected a finite number"};
  }
  auto table = read_number_table(text);
  // A word that is neither a number nor a file: both are named.
  if (!table && table.error().code == ErrorCode::input_output) {
    return Error{table.error().code, option + ": expected a number or a file; " + table.error().message};
  }
  if (!table) return table.error();
  return Column{text, std::move(table).value(), false};
}

/// Refuses the first value that is not as expected.
Result<Done> check_values(const Column& column, const char* what, bool (*good)(double), const char* expected) {
  const RowMatrix& values = column.table.values;
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    for (Eigen::Index c = 0; c < values.cols(); ++c) {
      if (good(values(i, c))) continue;
      const std::string where = column.number
                                    ? column.source + ": "
                                    : place(column.source, column.table.lines, i) +
                                          (values.cols() > 1 ? "channel " + std::to_string(c + 1) + ": " : "");
      return Error{ErrorCode::invalid_input,
                   where + "found " + what + " " + shortest(values(i, c)) + ", expected " + expected};
    }
  }
  return Done{};
}

/// For n patches and so many channels.
Result<Eigen::MatrixXd> spread(const Column& column, Eigen::Index n, Eigen::Index channels) {
  const RowMatrix& values = column.table.values;
  if (!column.number && values.rows() != n) {
    return in_file(column.source, "holds " + std::to_string(values.rows()) + " rows, expected " + std::to_string(n) +
                                      ": one a patch, as the form factors have");
  }
  if (values.cols() != 1 && values.cols() != channels) {
    return in_file(column.source, "holds " + std::to_string(values.cols()) + " columns, expected 1" +
                                      (channels > 1 ? " or " + std::to_string(channels) + ": one a channel" : ""));
  }
  Eigen::MatrixXd result(n, channels);
  for (Eigen::Index c = 0; c < channels; ++c) {
    for (Eigen::Index i = 0; i < n; ++i) {
      result(i, c) = values(column.number ? 0 : i, values.cols() == 1 ? 0 : c);
    }
  }
  return result;
}

Result<Eigen::VectorXd> read_areas(const std::string& text, Eigen::Index n) {
  const auto areas = column("--areas", text);
  if (!areas) return areas.error();
  const auto all = spread(*areas, n, 1);
  if (!all) return all.error();
  const auto positive = [](double area) { return area > 0; };
  if (const auto good = check_values(*areas, "area", positive, "a positive number"); !good) return good.error();
  return Eigen::VectorXd(all->col(0));
}

/// No bound below zero.
Result<Done> check_bounds(const Column& bounds) {
  const auto good = [](double bound) { return bound >= 0; };
  return check_values(bounds, "bound", good, "a number of at least 0");
}

/// Every factor is a share of power.
Result<Done> check_factors(const FactorsFile& file, const std::string& name) {
  const double most = 1 + RadiosityRules{}.factor_error;
  const auto entry = form_factors(file, {})->entry_outside(most);
  if (!entry) return Done{};
  return Error{ErrorCode::invalid_input,
               place(name, file.lines, entry->row) + "column " + std::to_string(entry->column) +
                   ": found form factor " + shortest(entry->value) + ", expected a share of power: a number in [0, 1]"};
}

Result<Done> add_bound(const std::string& option, const std::optional<std::string>& text,
                       Known<Eigen::MatrixXd>& known) {
  if (!text) return Done{};
  const auto bounds = column(option, *text);
  if (!bounds) return bounds.error();
  if (const auto good = check_bounds(*bounds); !good) return good.error();
  auto all = spread(*bounds, known.value.rows(), known.value.cols());
  if (!all) return all.error();
  known.bound = std::move(all).value();
  known.decimal_bound = bounds->table.decimal;
  return Done{};
}

Result<NumberTable> read_factor_bounds(const std::string& text, Eigen::Index n) {
  auto bounds = column("--factor-bounds", text);
  if (!bounds) return bounds.error();
  if (const auto good = check_bounds(*bounds); !good) return good.error();
  const RowMatrix& values = bounds->table.values;
  if (!bounds->number && (values.rows() != n || values.cols() != n)) {
    const std::string side = std::to_string(n);
    return in_file(bounds->source, "holds " + std::to_string(values.rows()) + " × " + std::to_string(values.cols()) +
                                       " numbers, expected " + side + " × " + side + ", as the form factors");
  }
  return std::move(bounds).value().table;
}

/// What a decimal number may have meant that was read as this double. Zero is zero.
double lower_reading(double value) {
  return value == 0 ? 0 : below(value);
}
double upper_reading(double value) {
  return value == 0 ? 0 : above(value);
}

/// The ends of one number, none below zero, none above `most`.
double lower_end(double value, bool decimal, double bound, bool decimal_bound) {
  if (decimal) value = lower_reading(value);
  if (decimal_bound) bound = upper_reading(bound);
  return bound == 0 ? value : std::max(0.0, below(value - bound));
}
double upper_end(double value, bool decimal, double bound, bool decimal_bound, double most) {
  if (decimal) value = upper_reading(value);
  if (decimal_bound) bound = upper_reading(bound);
  return bound == 0 ? value : std::min(most, above(value + bound));
}

Eigen::MatrixXd lower_end(const Known<Eigen::MatrixXd>& known) {
  Eigen::MatrixXd ends = known.value;
  for (Eigen::Index c = 0; c < ends.cols(); ++c) {
    for (Eigen::Index i = 0; i < ends.rows(); ++i) {
      ends(i, c) = lower_end(ends(i, c), known.decimal, known.bound ? (*known.bound)(i, c) : 0, known.decimal_bound);
    }
  }
  return ends;
}

Eigen::MatrixXd upper_end(const Known<Eigen::MatrixXd>& known) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  Eigen::MatrixXd ends = known.value;
  for (Eigen::Index c = 0; c < ends.cols(); ++c) {
    for (Eigen::Index i = 0; i < ends.rows(); ++i) {
      const double bound = known.bound ? (*known.bound)(i, c) : 0;
      ends(i, c) = upper_end(ends(i, c), known.decimal, bound, known.decimal_bound, kNone);
    }
  }
  return ends;
}

FactorsFile readings(const FactorsFile& file, double (*reading)(double)) {
  FactorsFile result = file;
  if (!file.decimal) return result;
  std::visit([reading](auto& matrix) { matrix = matrix.unaryExpr(reading).eval(); }, result.factors);
  return result;
}

RowMatrix dense(const FactorsFile& file) {
  const auto* matrix = std::get_if<RowMatrix>(&file.factors);
  return matrix != nullptr ? *matrix : RowMatrix(std::get<SparseRows>(file.factors));
}

struct FactorEnds {
  FactorsFile lower, upper;
};

FactorEnds ends_of(const FactorsData& data) {
  if (!data.factor_bounds) return {readings(data.factors, lower_reading), readings(data.factors, upper_reading)};
  const NumberTable& bounds = *data.factor_bounds;
  RowMatrix low = dense(data.factors), high = low;
  for (Eigen::Index i = 0; i < low.rows(); ++i) {
    for (Eigen::Index j = 0; j < low.cols(); ++j) {
      const double value = low(i, j), bound = bounds.values.size() == 1 ? bounds.values(0, 0) : bounds.values(i, j);
      low(i, j) = lower_end(value, data.factors.decimal, bound, bounds.decimal);
      high(i, j) = upper_end(value, data.factors.decimal, bound, bounds.decimal, 1);
    }
  }
  return {{std::move(low), false, {}}, {std::move(high), false, {}}};
}

/// As the result's header numbers them.
std::vector<std::string> channel_names(const FactorsData& data) {
  std::vector<std::string> names;
  for (Eigen::Index c = 1; c <= data.emission.value.cols(); ++c) names.push_back("channel " + std::to_string(c));
  return names;
}

}  // namespace

std::vector<fs::path> FactorsSource::files() const {
  std::vector<fs::path> all{factors};
  for (const auto& text : {reflectance, emission, areas, factor_bounds, reflectance_bounds, emission_bounds}) {
    if (text && !parse_number(*text)) all.emplace_back(*text);
  }
  return all;
}

Result<FactorsData> read_factors_data(const FactorsSource& source) {
  auto factors = read_factors(source.factors);
  if (!factors) return factors.error();
  FactorsData data{std::move(factors).value(), {}, {}, {}, {}, {}};
  const Eigen::Index n = data.factors.size();
  const auto rho = column("--reflectance", *source.reflectance), emission = column("--emission", *source.emission);
  if (!rho) return rho.error();
  if (!emission) return emission.error();
  const Eigen::Index channels = std::max(rho->table.values.cols(), emission->table.values.cols());
  const auto share = [](double value) { return value >= 0 && value < 1; };
  const auto power = [](double value) { return value >= 0; };
  for (const auto& good : {check_factors(data.factors, source.factors.string()),
                           check_values(*rho, "reflectance", share, "a number in [0, 1)"),
                           check_values(*emission, "emission", power, "a number of at least 0")}) {
    if (!good) return good.error();
  }
  auto all_rho = spread(*rho, n, channels), all_emission = spread(*emission, n, channels);
  if (!all_rho) return all_rho.error();
  if (!all_emission) return all_emission.error();
  data.reflectance = {std::move(all_rho).value(), rho->table.decimal};
  data.emission = {std::move(all_emission).value(), emission->table.decimal};
  if (const auto added = add_bound("--reflectance-bounds", source.reflectance_bounds, data.reflectance); !added) {
    return added.error();
  }
  if (const auto added = add_bound("--emission-bounds", source.emission_bounds, data.emission); !added) {
    return added.error();
  }
  if (source.factor_bounds) {
    auto bounds = read_factor_bounds(*source.factor_bounds, n);
    if (!bounds) return bounds.error();
    data.factor_bounds = std::move(bounds).value();
  }
  if (source.areas) {
    auto areas = read_areas(*source.areas, n);
    if (!areas) return areas.error();
    data.areas = std::move(areas).value();
  }
  return data;
}

double reciprocity_defect(const FactorsData& data) {
  double defect = 0;
  const auto note = [&](Eigen::Index i, Eigen::Index j, double factor, double returned) {
    const double there = data.areas(i) * factor, back = data.areas(j) * returned;
    if (there != back) defect = std::max(defect, std::abs(there - back) / std::max(there, back));
  };
  if (const auto* matrix = std::get_if<RowMatrix>(&data.factors.factors)) {
    for (Eigen::Index i = 0; i < matrix->rows(); ++i) {
      for (Eigen::Index j = 0; j < i; ++j) note(i, j, (*matrix)(i, j), (*matrix)(j, i));
    }
  } else {
    const auto& sparse = std::get<SparseRows>(data.factors.factors);
    for (Eigen::Index i = 0; i < sparse.outerSize(); ++i) {
      for (SparseRows::InnerIterator at(sparse, i); at; ++at) {
        note(i, at.col(), at.value(), sparse.coeff(at.col(), i));
      }
    }
  }
  return defect;
}

std::shared_ptr<const FormFactors> form_factors(const FactorsFile& file, const Schedule& schedule) {
  if (const auto* matrix = std::get_if<RowMatrix>(&file.factors))
    return std::make_shared<DenseFactors>(*matrix, schedule);
  return std::make_shared<SparseFactors>(std::get<SparseRows>(file.factors), schedule);
}

RadiosityEquation equation_of(const FactorsData& data, const Schedule& schedule) {
  return {form_factors(data.factors, schedule), data.reflectance.value, data.emission.value, data.areas,
          channel_names(data)};
}

EnclosedRadiosityEquation enclosed(const FactorsData& data, const Schedule& schedule) {
  const FactorEnds factors = ends_of(data);
  return {form_factors(factors.lower, schedule),
          form_factors(factors.upper, schedule),
          lower_end(data.reflectance),
          upper_end(data.reflectance),
          lower_end(data.emission),
          upper_end(data.emission),
          data.areas,
          channel_names(data)};
}

}  // namespace etendue::cli
