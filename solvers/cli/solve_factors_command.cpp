// SPDX-License-Identifier: Apache-2.0
#include "solve_factors_command.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <ostream>
#include <string>
#include <utility>

#include "etendue/assembly/factor_repair.hpp"
#include "etendue/assembly/schedule.hpp"
#include "etendue/core/interval.hpp"
#include "etendue/io/atomic_file.hpp"
#include "etendue/radiosity/enclosure.hpp"
#include "etendue/radiosity/solve.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"
#include "factors_data.hpp"
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

struct Request : FactorsSource {
  CommonOptions common;
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
  options.text(
      "--factor-bounds", "X",
      "with --certify: the true F_ij are within X of those written; a number, for zeros too, or a file of n × n",
      request.factor_bounds);
  options.text("--reflectance-bounds", "X", "the same for reflectances: a number, or a file as theirs",
               request.reflectance_bounds);
  options.text("--emission-bounds", "X", "and for emissions", request.emission_bounds);
  options.real("--tolerance", "X",
               "proved bound asked, relative to each channel's largest radiosity (iterations: 1e-10)",
               request.tolerance, 1e-16, 1);
  options.integer("--steps", "N", "most steps of an iteration (default: 100000)", request.steps, 1, 1'000'000'000);
  options.real("--row-excess", "X", "how far row sums may be above 1 (default: 1e-6)", request.row_excess, 0, 1e6);
  options.flag("--repair-closure", "change factors by least squares until rows sum to one and A_i F_ij = A_j F_ji",
               request.repair);
  add_common(options, request.common, "result as CSV (default: standard output)");
  options.note(
      "The result has a header and then a row a patch: index from 0, the radiosity of each channel [W/m²], and of "
      "each\n"
      "channel a lower and an upper bound between which the exact solution of this system lies. What is said about "
      "the\n"
      "solve goes to standard error, or, with --output, to standard output. A number in place of a file holds for all\n"
      "patches, one column for all channels.\n"
      "Exit code 4: the bound that was asked is not reached; the result is written with the bound that was.\n"
      "Exit code 6, after Ctrl-C: an iteration writes what it has reached, with its bound; an elimination has nothing "
      "to\n"
      "write before its end, and says so. A further run begins anew: --resume is for scenes, whose form factors take "
      "long.");
  options.example(
      "etendue solve --factors docs/examples/duct.csv --reflectance 0.5 --emission docs/examples/duct-emission.csv");
  options.example(
      "etendue solve --factors docs/examples/duct.csv --reflectance 0.5 --emission 2 --solver gmres --certify");
}

Result<Done> repair(FactorsData& data, const Request& request) {
  if (!request.repair) return Done{};
  auto* dense = std::get_if<RowMatrix>(&data.factors.factors);
  const RowMatrix all = dense != nullptr ? *dense : RowMatrix(std::get<SparseRows>(data.factors.factors));
  auto mended = repaired(all, data.areas);
  if (!mended) return Error{mended.error().code, request.factors.string() + ": " + mended.error().message};
  data.factors.factors = mended->factors;
  data.factors.decimal = false;  // the numbers are our own
  data.repaired = std::move(mended).value();
  return Done{};
}

/// Bytes for each pair of patches: the file's text or the doubles, F, the matrix of a direct solver and its copy, both ends.
constexpr double kBytesAPair = 6 * sizeof(double);

Result<FactorsData> read(const Request& request) {
  auto data = read_factors_data(request);
  if (!data) return data.error();
  FactorsData read = std::move(data).value();
  const Eigen::Index n = read.factors.size();
  const auto pairs = static_cast<double>(n) * static_cast<double>(n);
  const bool sparse = std::holds_alternative<SparseRows>(read.factors.factors) && !request.factor_bounds &&
                      !is_direct(*solver_named(request.solver));
  if (const auto room = check_memory({sparse ? 0 : pairs * kBytesAPair, std::to_string(n) + " patches need",
                                      shortest(kBytesAPair) + " bytes for each of n² pairs",
                                      "give sparse form factors (.mtx) and an iteration (--solver gmres)"});
      !room) {
    return room.error();
  }
  if (const auto mended = repair(read, request); !mended) return mended.error();
  return read;
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

Result<FactorsSolution> solved(const Request& request, const FactorsData& data, std::ostream& err) {
  const Schedule schedule = on_threads(request.common.threads);
  const RadiosityEquation equation = equation_of(data, schedule);
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
  auto report = solve_radiosity(equation, goal);
  if (!report) return Error{report.error().code, printable(request.factors.string()) + ": " + report.error().message};
  FactorsSolution solution{request.solver, std::move(report).value(), {}, {}, {}};
  solution.around = around(equation, solution.report);
  if (equation.areas.size() > 0) {
    for (Eigen::Index c = 0; c < equation.emission.cols(); ++c) {
      solution.balances.push_back(power_balance(equation, solution.report, c));
    }
  }
  if (!request.certify || solution.report.status == RadiosityStatus::stopped) return solution;
  goal.rules.row_excess.reset();
  auto certified = enclose_radiosity(enclosed(data, schedule), goal);
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
  if (request.has_bounds() && !request.certify) {
    return "--factor-bounds, --reflectance-bounds and --emission-bounds say what --certify is to enclose: give it too";
  }
  if (request.factor_bounds && request.repair) {
    return "--factor-bounds are of the factors as written, --repair-closure changes them: expected one of them";
  }
  return std::nullopt;
}

/// Why conjugate gradients may have got no nearer.
std::string not_reciprocal(const Request& request, const FactorsData& data) {
  constexpr double kRounded = 1e-6;  // as form factors are computed and written
  if (request.solver != "cg") return "";
  const double defect = reciprocity_defect(data);
  if (!(defect > kRounded)) return "";
  return "; cg needs reciprocal form factors, and with these areas A_i F_ij and A_j F_ji differ by up to " +
         shortest(std::round(1e4 * defect) / 1e2) + " %: check --areas, or take gmres";
}

int judged(const Request& request, const FactorsData& data, const FactorsSolution& solution, std::ostream& err) {
  const RadiosityReport& report = solution.report;
  if (report.status == RadiosityStatus::stopped) {
    return fail(
        err, kName,
        {ErrorCode::stopped, "stopped; the result is what was reached, with its bound; a further run begins anew"});
  }
  if (solution.not_certified) {
    const auto code = solution.not_certified->code;
    return fail(err, kName, {code, "not certified: " + solution.not_certified->message});
  }
  // Of a direct solver nothing is asked unless it is asked.
  if (report.status == RadiosityStatus::reached) return 0;
  return fail(err, kName,
              {ErrorCode::not_converged, missed_text(report, request.tolerance > 0 ? request.tolerance : kTolerance) +
                                             not_reciprocal(request, data)});
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
    if (const auto free = check_outputs({output}, request.files()); !free) return fail(err, kName, free.error());
  }
  auto data = [&] {
    const NothingToSave reading;
    return read(request);
  }();
  if (!data) return fail(err, kName, data.error());
  const auto solution = solved(request, *data, err);
  if (!solution && solution.error().code == ErrorCode::stopped) {
    return fail(err, kName,
                {ErrorCode::stopped,
                 "stopped in the elimination: before its end there is nothing to save; solvers that iterate (--solver "
                 "gmres) write what they have reached"});
  }
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
  return judged(request, *data, *solution, err);
}

}  // namespace etendue::cli
