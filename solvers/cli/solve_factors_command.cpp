// SPDX-License-Identifier: Apache-2.0
#include "solve_factors_command.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <ostream>
#include <utility>

#include "etendue/assembly/factor_repair.hpp"
#include "etendue/assembly/schedule.hpp"
#include "etendue/core/interval.hpp"
#include "etendue/io/atomic_file.hpp"
#include "etendue/io/number_table.hpp"
#include "etendue/io/read_errors.hpp"
#include "etendue/radiosity/enclosure.hpp"
#include "etendue/radiosity/solve.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"
#include "memory.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "progress.hpp"
#include "solve_factors_report.hpp"
#include "stop.hpp"

namespace etendue::cli {

const char* const kSolverHelp =
    "elimination: own (gauss, default) or Eigen's (lu, eigen); the others iterate, cg by areas";

std::vector<std::string> solver_choices() {
  std::vector<std::string> names = solver_names();
  names.emplace_back("eigen");
  return names;
}

namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "solve";
constexpr double kTolerance = 1e-10;
constexpr double kRowExcess =
    1e-6;  ///< six decimal places, in which factors are often printed, make row sums as wrong as this

struct Request {
  CommonOptions common;
  fs::path factors;
  std::optional<std::string> reflectance, emission, areas;
  std::string solver = "gauss";
  double tolerance = 0;  ///< 0, which --tolerance does not take: not asked of direct solvers, kTolerance of iterations
  double row_excess = kRowExcess;
  int steps = 100'000;
  bool certify = false, repair = false;
};

void declare(Options& options, Request& request) {
  options.path("--factors", "FILE", "form factors, row = from, column = to: .csv, .npy or .mtx", request.factors);
  options.text("--reflectance", "R", "a number, or a file: a row a patch, a column a channel", request.reflectance);
  options.text("--emission", "E", "a number, or a file as above [W/m²]", request.emission);
  options.text("--areas", "A", "a number, or a file: a row a patch; cg and --repair-closure need them", request.areas);
  options.choice("--solver", solver_choices(), kSolverHelp, request.solver);
  options.flag("--certify", "intervals that hold the exact solution for the numbers as written, decimals and all",
               request.certify);
  options.real("--tolerance", "X",
               "proved bound asked, relative to each channel's largest radiosity (iterations: 1e-10)",
               request.tolerance, 1e-16, 1);
  options.integer("--steps", "N", "most steps of an iteration (default: 100000)", request.steps, 1, 1'000'000'000);
  options.real("--row-excess", "X", "how far row sums may be above 1 (default: 1e-6)", request.row_excess, 0, 1e6);
  options.flag("--repair-closure", "change factors by least squares until rows sum to one and A_i F_ij = A_j F_ji",
               request.repair);
  add_common(options, request.common, "result as CSV (default: standard output)");
  options.alias("-o", "--output");
  options.note(
      "The result has a header and then a row a patch: index from 0, the radiosity of each channel [W/m²], and of "
      "each\n"
      "channel a lower and an upper bound between which the exact solution of this system lies. What is said about "
      "the\n"
      "solve goes to standard error, or, with --output, to standard output. A number in place of a file holds for all\n"
      "patches, one column for all channels.\n"
      "Exit code 4: the bound that was asked is not reached; the result is written with the bound that was.");
  options.example(
      "etendue solve --factors docs/examples/duct.csv --reflectance 0.5 --emission docs/examples/duct-emission.csv");
  options.example(
      "etendue solve --factors docs/examples/duct.csv --reflectance 0.5 --emission 2 --solver gmres --certify");
}

Error in_file(const std::string& file, const std::string& what) {
  return {ErrorCode::invalid_input, printable(file) + ": " + what};
}

/// --reflectance, --emission or --areas: a number, or a file of them.
struct Column {
  std::string source;
  NumberTable table;  ///< 1 × 1 for a number
  bool number = false;
};

Result<Column> column(const std::string& option, const std::string& text) {
  if (const auto value = parse_number(text)) {
    return Column{option, {RowMatrix::Constant(1, 1, *value), true}, true};
  }
  auto table = read_number_table(text);
  // A word that is neither a number nor a file: both are named.
  if (!table && table.error().code == ErrorCode::input_output) {
    return Error{table.error().code, option + ": expected a number or a file; " + table.error().message};
  }
  if (!table) return table.error();
  return Column{text, std::move(table).value(), false};
}

/// For n patches and so many channels.
Result<Eigen::MatrixXd> spread(const Column& column, Eigen::Index n, Eigen::Index channels) {
  const RowMatrix& values = column.table.values;
  if (!column.number && values.rows() != n) {
    return in_file(column.source, "holds " + std::to_string(values.rows()) + " rows, expected " + std::to_string(n) +
                                      ": one a patch, as the form factors have");
  }
  if (values.cols() != 1 && values.cols() != channels) {
    return in_file(column.source, "holds " + std::to_string(values.cols()) + " columns, expected 1 or " +
                                      std::to_string(channels) + ": one a channel");
  }
  Eigen::MatrixXd result(n, channels);
  for (Eigen::Index c = 0; c < channels; ++c) {
    for (Eigen::Index i = 0; i < n; ++i) {
      result(i, c) = values(column.number ? 0 : i, values.cols() == 1 ? 0 : c);
    }
  }
  return result;
}

/// Everything that was read.
struct Data {
  FactorsFile factors;
  RadiosityEquation equation;
  bool decimal_reflectance = false, decimal_emission = false;
  std::optional<RepairedFactors> repaired;
};

Result<Done> add_areas(Data& data, const Request& request) {
  if (!request.areas) return Done{};
  const auto areas = column("--areas", *request.areas);
  if (!areas) return areas.error();
  auto spread_areas = spread(*areas, data.factors.size(), 1);
  if (!spread_areas) return spread_areas.error();
  data.equation.areas = spread_areas->col(0);
  for (Eigen::Index i = 0; i < data.equation.areas.size(); ++i) {
    if (data.equation.areas(i) > 0) continue;
    return in_file(areas->source,
                   "row " + std::to_string(i) + ": area " + shortest(data.equation.areas(i)) + " is not positive");
  }
  return Done{};
}

Result<Done> repair(Data& data, const Request& request) {
  if (!request.repair) return Done{};
  auto* dense = std::get_if<RowMatrix>(&data.factors.factors);
  const RowMatrix all = dense != nullptr ? *dense : RowMatrix(std::get<SparseRows>(data.factors.factors));
  auto mended = repaired(all, data.equation.areas);
  if (!mended) return Error{mended.error().code, request.factors.string() + ": " + mended.error().message};
  data.factors.factors = mended->factors;
  data.factors.decimal = false;  // the numbers are our own
  data.repaired = std::move(mended).value();
  return Done{};
}

/// Bytes for each pair of patches: the file's text or the doubles, F, the matrix of a direct solver and its copy, both ends.
constexpr double kBytesAPair = 6 * sizeof(double);

std::shared_ptr<const FormFactors> form_factors(const FactorsFile& file, const Schedule& schedule) {
  if (const auto* dense = std::get_if<RowMatrix>(&file.factors))
    return std::make_shared<DenseFactors>(*dense, schedule);
  return std::make_shared<SparseFactors>(std::get<SparseRows>(file.factors), schedule);
}

Result<Data> read(const Request& request) {
  auto factors = read_factors(request.factors);
  if (!factors) return factors.error();
  Data data{std::move(factors).value(), {}, false, false, {}};
  const Eigen::Index n = data.factors.size();
  const auto pairs = static_cast<double>(n) * static_cast<double>(n);
  const bool sparse =
      std::holds_alternative<SparseRows>(data.factors.factors) && !is_direct(*solver_named(request.solver));
  if (const auto room = check_memory({sparse ? 0 : pairs * kBytesAPair, std::to_string(n) + " patches need",
                                      shortest(kBytesAPair) + " bytes for each of n² pairs",
                                      "give sparse form factors (.mtx) and an iteration (--solver gmres)"});
      !room) {
    return room.error();
  }
  const auto rho = column("--reflectance", *request.reflectance), emission = column("--emission", *request.emission);
  if (!rho) return rho.error();
  if (!emission) return emission.error();
  const Eigen::Index channels = std::max(rho->table.values.cols(), emission->table.values.cols());
  auto all_rho = spread(*rho, n, channels), all_emission = spread(*emission, n, channels);
  if (!all_rho) return all_rho.error();
  if (!all_emission) return all_emission.error();
  data.equation.reflectance = std::move(all_rho).value();
  data.equation.emission = std::move(all_emission).value();
  data.decimal_reflectance = rho->table.decimal;
  data.decimal_emission = emission->table.decimal;
  if (const auto areas = add_areas(data, request); !areas) return areas.error();
  if (const auto mended = repair(data, request); !mended) return mended.error();
  data.equation.factors = form_factors(data.factors, on_threads(request.common.threads));
  return data;
}

/// What a decimal number may have meant that was read as this double. Zero is zero.
double lower_reading(double value) {
  return value == 0 ? 0 : below(value);
}
double upper_reading(double value) {
  return value == 0 ? 0 : above(value);
}

template <class Matrix>
Matrix readings(Matrix values, bool decimal, double (*reading)(double)) {
  if (decimal) values = values.unaryExpr(reading);
  return values;
}

FactorsFile readings(const FactorsFile& file, double (*reading)(double)) {
  FactorsFile result = file;
  if (!file.decimal) return result;
  std::visit([reading](auto& matrix) { matrix = matrix.unaryExpr(reading).eval(); }, result.factors);
  return result;
}

/// The equation between the two ends of every number as written.
EnclosedRadiosityEquation enclosed(const Data& data, const Schedule& schedule) {
  EnclosedRadiosityEquation ends;
  ends.factors_lower = form_factors(readings(data.factors, lower_reading), schedule);
  ends.factors_upper = form_factors(readings(data.factors, upper_reading), schedule);
  ends.reflectance_lower = readings(data.equation.reflectance, data.decimal_reflectance, lower_reading);
  ends.reflectance_upper = readings(data.equation.reflectance, data.decimal_reflectance, upper_reading);
  ends.emission_lower = readings(data.equation.emission, data.decimal_emission, lower_reading);
  ends.emission_upper = readings(data.equation.emission, data.decimal_emission, upper_reading);
  ends.areas = data.equation.areas;
  return ends;
}

/// Without --certify: the bound of the solve around it. B ≥ E, for nothing is taken from what a patch emits.
RadiosityEnclosure around(const RadiosityEquation& equation, const RadiosityReport& report) {
  RadiosityEnclosure result{report.radiosity, report.radiosity, report.status};
  for (Eigen::Index c = 0; c < report.radiosity.cols(); ++c) {
    for (Eigen::Index i = 0; i < report.radiosity.rows() && !report.dark; ++i) {
      result.lower(i, c) = std::max(equation.emission(i, c), below(report.radiosity(i, c) - report.bound(c)));
      result.upper(i, c) = above(report.radiosity(i, c) + report.bound(c));
    }
  }
  return result;
}

Result<FactorsSolution> solved(const Request& request, const Data& data, std::ostream& err) {
  RadiosityGoal goal;
  goal.solver = *solver_named(request.solver);
  goal.tolerance = request.tolerance > 0 ? request.tolerance : is_direct(goal.solver) ? 1 : kTolerance;
  goal.most_steps = request.steps;
  goal.rules.row_excess = request.row_excess;
  Progress progress(err, request.solver, request.common);
  const Execution run = execution(request.common, progress);
  goal.may_go_on = [&run](Eigen::Index done, Eigen::Index total) {
    if (run.progress) run.progress(static_cast<std::size_t>(done), static_cast<std::size_t>(total));
    return !run.stopping();
  };
  auto report = solve_radiosity(data.equation, goal);
  if (!report) return report.error();
  FactorsSolution solution{request.solver, std::move(report).value(), {}, {}, {}};
  solution.around = around(data.equation, solution.report);
  if (data.equation.areas.size() > 0) {
    for (Eigen::Index c = 0; c < data.equation.emission.cols(); ++c) {
      solution.balances.push_back(power_balance(data.equation, solution.report, c));
    }
  }
  if (!request.certify || solution.report.status == RadiosityStatus::stopped) return solution;
  goal.rules.row_excess.reset();
  auto certified = enclose_radiosity(enclosed(data, on_threads(request.common.threads)), goal);
  if (!certified && certified.error().code == ErrorCode::invalid_input) return certified.error();
  if (certified) {
    solution.around = std::move(certified).value();
    solution.certified = true;
  } else {
    solution.not_certified = certified.error();
  }
  return solution;
}

/// What is missing of the command line.
std::optional<std::string> incomplete(const Request& request) {
  if (request.factors.empty()) return "--factors FILE is missing";
  if (!request.reflectance) return "--reflectance NUMBER|FILE is missing";
  if (!request.emission) return "--emission NUMBER|FILE is missing";
  if (request.solver == "cg" && !request.areas) {
    return "--solver cg makes the system symmetric by the areas of the patches: give --areas FILE";
  }
  if (request.repair && !request.areas) return "--repair-closure keeps A_i F_ij = A_j F_ji: give --areas FILE";
  return std::nullopt;
}

std::vector<fs::path> inputs(const Request& request) {
  std::vector<fs::path> files{request.factors};
  for (const auto& text : {request.reflectance, request.emission, request.areas}) {
    if (text && !parse_number(*text)) files.emplace_back(*text);
  }
  return files;
}

int judged(const Request& request, const FactorsSolution& solution, std::ostream& err) {
  const RadiosityReport& report = solution.report;
  if (report.status == RadiosityStatus::stopped) {
    return fail(err, kName, {ErrorCode::stopped, "stopped; the result is what was reached, with its bound"});
  }
  if (solution.not_certified) {
    const auto code = solution.not_certified->code;
    return fail(err, kName, {code, "not certified: " + solution.not_certified->message});
  }
  // Of a direct solver nothing is asked unless it is asked.
  if (report.status == RadiosityStatus::reached) return 0;
  return fail(err, kName,
              {ErrorCode::not_converged, missed_text(report, request.tolerance > 0 ? request.tolerance : kTolerance)});
}

}  // namespace

int solve_factors(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  Request request;
  Options options(kName, "Solve the radiosity equation B = E + diag(ρ) F B for given form factors.");
  declare(options, request);
  if (const auto code = options.parse(arguments, out, err)) return *code;
  if (const auto missing = incomplete(request)) return options.usage_error(err, *missing);
  if (request.solver == "eigen") request.solver = "lu";
  const fs::path& output = request.common.output;
  if (!output.empty()) {
    if (const auto free = check_outputs({output}, inputs(request)); !free) return fail(err, kName, free.error());
  }
  auto data = [&] {
    const NothingToSave reading;
    return read(request);
  }();
  if (!data) return fail(err, kName, data.error());
  const auto solution = solved(request, *data, err);
  if (!solution) return fail(err, kName, solution.error());
  const std::string csv = result_csv(*solution);
  std::ostream& told = output.empty() ? err : out;
  if (output.empty()) {
    out << csv;
  } else if (const auto written = write_file(output, csv); !written) {
    return fail(err, kName, written.error());
  }
  if (request.common.json) {
    told << factors_summary_json(*solution, data->repaired);
  } else if (!request.common.quiet) {
    print_factors_summary(told, *solution, data->repaired);
  }
  return judged(request, *solution, err);
}

}  // namespace etendue::cli
