// SPDX-License-Identifier: Apache-2.0
#include "grade/command.hpp"

#include <algorithm>
#include <optional>
#include <ostream>
#include <stdexcept>

#include "cli/options.hpp"
#include "cli/stop.hpp"
#include "etendue/execution/execution.hpp"
#include "etendue/io/atomic_file.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"
#include "grade/score.hpp"
#include "runner/options.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {

namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t kMostOutput = std::uintmax_t{1} << 20;  ///< bytes: an answer has some hundred

struct Request {
  fs::path cases = own_cases();
  std::optional<std::string> subject, id;
  fs::path json, exported;
  double longest = 60;
  int jobs = 0;
  bool with_truth = false, list = false;
  std::vector<std::string> command;
};

cli::Options declared(Request& request) {
  cli::Options options("validate grade", "Run any program on cases whose answers are known, and print its score card.");
  options.also("[OPTIONS] -- COMMAND [ARGUMENT …]");
  options.path("--cases", "FOLDER", "the cases (default: validation/cases of the sources)", request.cases);
  options.text("--subject", "S",
               "only those of this subject: form factors, radiosity, refraction, intersections, images",
               request.subject);
  options.text("--case", "PATTERN", "only those whose id fits (* any characters, ? one)", request.id);
  options.real("--timeout", "SECONDS", "kill the program when a case takes longer (default: 60)", request.longest, 0.01,
               86400);
  options.integer("--jobs", "N", "cases at a time (default: all cores)", request.jobs, 1, 1024);
  options.path("--json", "FILE", "write the score card to FILE as well, as JSON", request.json);
  options.flag("--list", "print the cases, and stop", request.list);
  options.path("--export", "FOLDER", "write the cases to FOLDER as programs are given them, with schemas, and stop",
               request.exported);
  options.flag("--with-truth", "with --export: with truths, tolerances and derivations", request.with_truth);
  options.note(
      "The program is run once for each case, with the case's file as its last argument and on standard input. It "
      "prints\n"
      "{\"value\": NUMBER, [NUMBERS] or \"none\"} or {\"unsupported\": \"why\"}, and ends with 0: docs/grade.md.\n"
      "Exit code 0: all that it answered is right. 1: a case failed, or none was answered.");
  options.example("etendue validate grade --list");
  options.example("etendue validate grade --subject images --export image-cases");
  options.example("etendue validate grade --case 'form-factors/discs-*' -- validation/adapters/etendue.py");
  return options;
}

int fail(std::ostream& err, const Error& error) {
  err << "etendue validate grade: " << printable_lines(error.message) << "\n";
  return static_cast<int>(error.code);
}

Result<std::vector<GradeCase>> chosen(const Request& request) {
  auto all = read_cases(request.cases);
  if (!all) return all.error();
  std::vector<GradeCase> cases;
  std::copy_if(all->begin(), all->end(), std::back_inserter(cases), [&](const GradeCase& one) {
    return (!request.subject || one.subject == *request.subject) && (!request.id || fits(one.id, *request.id));
  });
  if (cases.empty()) return Error{ErrorCode::usage, "no case fits; --list names all"};
  return cases;
}

Result<Done> export_cases(const Request& request, const std::vector<GradeCase>& cases) {
  std::vector<NewFile> files;
  for (const auto& one : cases)
    files.push_back({request.exported / (one.id + ".json"), request.with_truth ? one.file : one.question});
  for (const char* schema : {"case.schema.json", "answer.schema.json"}) {
    const auto text = read_file(own_cases() / schema);
    if (!text) return text.error();
    files.push_back({request.exported / schema, *text});
  }
  for (const auto& file : files) {
    std::error_code error;
    fs::create_directories(file.path.parent_path(), error);
    if (error)
      return Error{ErrorCode::input_output,
                   "cannot make " + quoted_path(file.path.parent_path()) + ": " + error.message()};
  }
  return write_files(files);
}

/// One process: the program on one case.
CaseVerdict ask(const Request& request, const GradeCase& asked) {
  const TemporaryFolder folder;
  ProcessOptions options;
  options.in = folder.add("case.json", asked.question);
  options.longest = request.longest;
  options.most = kMostOutput;
  options.with_children = true;
  options.stop = &cli::stop_requested();
  std::vector<std::string> arguments(request.command.begin() + 1, request.command.end());
  arguments.push_back(options.in.string());
  const Ended ended = run_process(request.command.front(), arguments, options);
  return cli::stop_requested() ? CaseVerdict{} : judge(asked, ended);
}

/// Throws where the program cannot be started.
Score graded(const Request& request, std::vector<GradeCase> cases) {
  Score score{request.command, std::move(cases), {}};
  score.verdicts.resize(score.cases.size());
  const Execution execution{request.jobs, {}, &cli::stop_requested()};
  parallel_for(score.cases.size(), execution, [&](std::size_t i) { score.verdicts[i] = ask(request, score.cases[i]); });
  return score;
}

int report(const Request& request, const Score& score, std::ostream& out, std::ostream& err) {
  out << text_score(score);
  if (!request.json.empty()) {
    const auto written = write_file(request.json, json_score(score));
    if (!written) return fail(err, written.error());
  }
  if (cli::stop_requested())
    return fail(err, {ErrorCode::stopped, "stopped; " + counted(score.total().not_run, "case") + " not run"});
  return score.good() ? 0 : static_cast<int>(ErrorCode::check_failed);
}

int run_grade(const Request& request, std::ostream& out, std::ostream& err) {
  const auto cases = chosen(request);
  if (!cases) return fail(err, cases.error());
  if (request.list) {
    for (const auto& one : *cases) out << printable(one.id) << "\t" << printable(one.title) << "\n";
    return 0;
  }
  if (!request.exported.empty()) {
    const auto written = export_cases(request, *cases);
    if (!written) return fail(err, written.error());
    err << counted(cases->size(), "case") << " written to " << quoted_path(request.exported) << "\n";
    return 0;
  }
  if (!request.json.empty()) {
    const auto writable = check_writable({request.json});
    if (!writable) return fail(err, writable.error());
  }
  try {
    return report(request, graded(request, *cases), out, err);
  } catch (const std::runtime_error& error) {
    return fail(err, {ErrorCode::input_output, error.what()});
  }
}

}  // namespace

int grade(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  Request request;
  const auto dashes = std::find(arguments.begin(), arguments.end(), "--");
  if (dashes != arguments.end()) request.command.assign(dashes + 1, arguments.end());
  const cli::Options options = declared(request);
  if (const auto code = options.parse({arguments.begin(), dashes}, out, err)) return *code;
  if (request.with_truth && request.exported.empty())
    return options.usage_error(err, "--with-truth belongs to --export");
  const bool runs = !request.list && request.exported.empty();
  if (runs && request.command.empty())
    return options.usage_error(err, "no program to grade; it stands behind the options: -- COMMAND");
  if (!runs && !request.command.empty()) return options.usage_error(err, "--list and --export run no program");
  if (runs && request.command.front().empty()) return options.usage_error(err, "the program has no name");
  return run_grade(request, out, err);
}

}  // namespace etendue::validation
