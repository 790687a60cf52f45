// SPDX-License-Identifier: Apache-2.0
#include "runner/run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <set>
#include <string_view>
#include <thread>
#include <utility>

#include "cli/stop.hpp"
#include "etendue/core/version.hpp"
#include "etendue/io/atomic_file.hpp"
#include "etendue/text/utf8.hpp"
#include "grade/command.hpp"
#include "runner/listeners.hpp"
#include "runner/options.hpp"
#include "runner/probe.hpp"
#include "runner/references.hpp"
#include "runner/report.hpp"
#include "runner/selection.hpp"
#include "runner/workers.hpp"
#include "support/long_run.hpp"

namespace etendue::validation {

namespace {

int fail(const Error& error) {
  std::cerr << "etendue-validate: " << printable_lines(error.message) << "\n";
  return static_cast<int>(error.code);
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::array<char, 32> buffer{};
  std::tm parts{};
  if (::gmtime_r(&now, &parts) != nullptr) std::strftime(buffer.data(), buffer.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return buffer.data();
}

BuildInfo build_info() {
#ifdef __clang__
  const std::string compiler = std::string("clang ") + __clang_version__;
#else
  const std::string compiler = std::string("g++ ") + __VERSION__;
#endif
  return {version(), compiler, ETENDUE_BUILD_TYPE, ETENDUE_FP_CONTRACT, utc_now(), 0, "etendue-validate"};
}

/// "exact arithmetic, table": the kinds of oracle of a row's tests, and a tab, and the tests' names.
std::string oracles_and_tests(const std::vector<TestClaims>& tests, const std::string& id) {
  std::set<std::string> kinds;
  std::string oracles, names;
  for (const auto& test : tests) {
    if (std::find(test.claims.begin(), test.claims.end(), id) == test.claims.end()) continue;
    kinds.insert(test.oracle);
    names += (names.empty() ? "" : " ") + test.test;
  }
  for (const auto& kind : kinds) oracles += (oracles.empty() ? "" : ", ") + kind;
  return oracles + "\t" + names;
}

int print_claims(const Register& all) {
  const auto tests = probe_tests();
  if (!tests) return fail(tests.error());
  std::cout << "claim\tverdict\toracles\ttests\tstatement\n";
  for (const auto& claim : all.claims) {
    std::cout << claim.id << "\t" << name(claim.verdict) << "\t" << oracles_and_tests(*tests, claim.id) << "\t"
              << claim.statement;
    if (!claim.formula.empty()) std::cout << "  " << claim.formula;
    for (const auto& erratum : claim.errata) std::cout << " [" << erratum << "]";
    if (!claim.reason.empty()) std::cout << " Not testable: " << claim.reason;
    std::cout << "\n";
  }
  for (const auto& erratum : all.errata) {
    std::cout << erratum.id << "\t" << name(erratum.verdict) << "\t" << oracles_and_tests(*tests, erratum.id)
              << "\tprinted: " << erratum.printed << "; right: " << erratum.right << "\n";
  }
  return 0;
}

int print_tests() {
  const auto tests = probe_tests();
  if (!tests) return fail(tests.error());
  for (const auto& test : *tests) {
    std::cout << test.test;
    for (const auto& claim : test.claims) std::cout << " " << claim;
    std::cout << "\n";
  }
  return 0;
}

/// Do both name one file, by whatever ways, be it there or not?
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code error;
  if (std::filesystem::equivalent(a, b, error)) return true;
  const auto canonical = [&](const auto& path) { return std::filesystem::weakly_canonical(path, error); };
  const auto first = canonical(std::filesystem::absolute(a)), second = canonical(std::filesystem::absolute(b));
  return first == second;
}

/// Before the first test: a path that cannot be written must not cost the work of a whole run, nor one report replace
/// another.
Result<Done> check_reports(const Options& options) {
  std::vector<std::pair<const char*, std::filesystem::path>> reports;
  for (const auto& [option, path] :
       {std::pair("--text", options.text_path), std::pair("--json", options.json_path),
        std::pair("--junit", options.junit_path), std::pair("--report", options.html_path)}) {
    if (path.empty()) continue;
    for (const auto& [other, taken] : reports) {
      if (!same_file(taken, path)) continue;
      return Error{ErrorCode::usage, std::string(other) + " and " + option + " name the same file, " +
                                         quoted_path(path) + ": one would replace the other"};
    }
    reports.emplace_back(option, path);
  }
  std::vector<std::filesystem::path> paths;
  for (const auto& [option, path] : reports) paths.push_back(path);
  return check_writable(paths);
}

Result<Done> write_reports(const Options& options, const Summary& summary, const Register& all, const BuildInfo& build,
                           const std::vector<PastRun>& past) {
  std::vector<NewFile> files;
  if (!options.text_path.empty()) files.push_back({options.text_path, text_report(summary, build)});
  if (!options.json_path.empty()) files.push_back({options.json_path, json_report(summary, all, build)});
  if (!options.junit_path.empty()) files.push_back({options.junit_path, junit_report(summary, build)});
  if (!options.html_path.empty()) files.push_back({options.html_path, html_report(summary, all, build, past)});
  return write_files(files);
}

/// Has the user narrowed the run: by a choice of ours (`filter`), one of GoogleTest's, a shard?
bool narrowed(const std::string& filter) {
  return !filter.empty() || GTEST_FLAG_GET(filter) != "*" || std::getenv("GTEST_TOTAL_SHARDS") != nullptr;
}

void leave_out(const std::vector<std::string>& tests) {
  std::string filter = "-";
  for (const auto& test : tests) filter += ":" + test;
  GTEST_FLAG_SET(filter, filter);
}

/// What is being run, beyond the command line.
struct Selection {
  bool whole = true;  ///< nothing narrowed it
  int left_out = 0;   ///< tests of commands, of a whole run
};

/// A disabled test would be a check that silently does not happen: it counts as skipped.
void add_disabled(std::vector<TestRun>& tests) {
  if (GTEST_FLAG_GET(also_run_disabled_tests)) return;
  constexpr std::string_view kMark = "DISABLED_";  // GoogleTest's, of a suite or a test
  const auto& unit = *::testing::UnitTest::GetInstance();
  for (int s = 0; s < unit.total_test_suite_count(); ++s) {
    const auto& suite = *unit.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const std::string_view test = suite.GetTestInfo(t)->name();
      if (!test.starts_with(kMark) && !std::string_view(suite.name()).starts_with(kMark)) continue;
      tests.push_back({suite.name(), std::string(test), Outcome::skipped, {}, 0, {}});
    }
  }
}

Depth depth_of(const Options& options) {
  return options.deep ? Depth::long_run : Depth::usual;
}

void print(const Summary& summary, const BuildInfo& build, const Options& options) {
  if (options.gtest_options.empty() && !options.quiet) {
    std::cout << text_report(summary, build);
    return;
  }
  for (const auto& test : summary.tests) {
    if (!options.gtest_options.empty()) break;  // GoogleTest has printed them
    for (const auto& failure : test.failures)
      std::cout << "FAILED " << test.suite << "." << test.name << "\n" << failure << "\n";
  }
  for (const auto& problem : summary.problems) std::cout << "PROBLEM " << problem << "\n";
  std::cout << stop_notice(summary);
  if (options.gtest_options.empty()) std::cout << headline(summary) << "\n";
}

/// All in this process, as debuggers like it.
TestsDone run_here(const Options& options) {
  auto& listeners = ::testing::UnitTest::GetInstance()->listeners();
  TestsDone done;
  listeners.Append(new Collector(done.tests));  // GoogleTest owns it
  if (options.gtest_options.empty()) {
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new Progress(depth_of(options)));
  }
  done.gtest_ok = RUN_ALL_TESTS() == 0;
  return done;
}

/// As many processes as were asked for; one where GoogleTest prints or writes for itself.
int jobs_of(const Options& options) {
  if (!options.gtest_options.empty() || !GTEST_FLAG_GET(output).empty()) return 1;
  const int tests = ::testing::UnitTest::GetInstance()->total_test_count();
  const int wanted = options.jobs > 0 ? options.jobs : static_cast<int>(std::thread::hardware_concurrency());
  return std::clamp(wanted, 1, std::max(tests, 1));
}

int run_tests(const Options& options, const Register& all, const std::vector<PastRun>& past, Selection selection) {
  const auto start = std::chrono::steady_clock::now();
  const int jobs = jobs_of(options);
  Result<TestsDone> run = jobs > 1 ? run_in_workers(jobs, depth_of(options)) : run_here(options);
  if (!run) return fail(run.error());
  TestsDone done = std::move(run).value();
  const bool stopped =
      std::any_of(done.tests.begin(), done.tests.end(), [](const TestRun& t) { return t.outcome == Outcome::not_run; });
  const bool full = selection.whole && !stopped;
  if (full) add_disabled(done.tests);
  // What GoogleTest thinks is told again, test by test, by the summary; but it also sees failures outside tests.
  Summary summary = summarize(all, std::move(done.tests), full);
  summary.left_out = selection.left_out;
  summary.problems.insert(summary.problems.begin(), done.problems.begin(), done.problems.end());
  BuildInfo build = build_info();
  build.command += choice_text(options);
  for (const auto& option : options.gtest_options) build.command += " '" + option + "'";
  build.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  print(summary, build, options);
  const auto written = write_reports(options, summary, all, build, past);
  if (!written) return fail(written.error());
  if (stopped) {
    return fail({ErrorCode::stopped, "stopped; " + std::to_string(summary.not_run) + " tests were not run"});
  }
  return done.gtest_ok && summary.ok() ? 0 : static_cast<int>(ErrorCode::check_failed);
}

/// Hands the --gtest_* options to GoogleTest; refuses those that it does not know.
Result<Done> init_gtest(const Options& options) {
  std::vector<std::string> words = {"etendue-validate"};
  words.insert(words.end(), options.gtest_options.begin(), options.gtest_options.end());
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  int argc = static_cast<int>(words.size());
  ::testing::InitGoogleTest(&argc, argv.data());
  if (argc > 1) return Error{ErrorCode::usage, std::string("unknown option ") + argv[1]};
  return Done{};
}

int run_action(const Options& options, const Register& all) {
  if (inside_probe()) return fail({ErrorCode::usage, "a probe of the tests must not start another run"});
  if (options.action == Options::Action::list) return print_tests();
  if (options.action == Options::Action::claims) return print_claims(all);
  if (const auto writable = check_reports(options); !writable) return fail(writable.error());
  const auto past = read_history(options.history);
  if (!past) return fail(past.error());
  const auto filter = gtest_filter(options, all);
  if (!filter) return fail(filter.error());
  const auto ready = init_gtest(options);
  if (!ready) return fail(ready.error());
  Selection selection{!narrowed(*filter), 0};
  if (!filter->empty()) GTEST_FLAG_SET(filter, *filter);
  if (GTEST_FLAG_GET(list_tests)) return RUN_ALL_TESTS();
  if (const auto commands = command_tests(); selection.whole && !options.all && !commands.empty()) {
    leave_out(commands);
    selection.left_out = static_cast<int>(commands.size());
  }
  if (options.deep) begin_long_run();
  return run_tests(options, all, *past, selection);
}

int run(int argc, char** argv, std::string_view claims_json, std::string_view errata_json) {
  if (argc > 1 && std::string_view(argv[1]) == "grade") return grade({argv + 2, argv + argc}, std::cout, std::cerr);
  const auto options = parse_options({argv + 1, argv + argc});
  if (!options) return fail(options.error());
  if (options->action == Options::Action::help) {
    std::cout << help_text();
    return 0;
  }
  if (options->action == Options::Action::version) {
    std::cout << "etendue-validate " << version() << "\n";
    return 0;
  }
  if (options->action == Options::Action::update_references) {
    const std::string which = options->references == "all" ? "" : options->references;
    const auto updated = update_references(references_root(), which, options->reason, utc_now().substr(0, 10));
    return updated ? 0 : fail(updated.error());
  }
  const auto all = parse_register(claims_json, errata_json);
  if (!all) return fail(all.error());
  return run_action(*options, *all);
}

}  // namespace

int run_validation(int argc, char** argv, std::string_view claims_json, std::string_view errata_json) {
  std::signal(SIGPIPE, SIG_IGN);  // a reader that leaves early is a write error (5), not a silent death
  std::signal(SIGXFSZ, SIG_IGN);  // so is a limit on the size of files
  cli::watch_stop_signals();
  const int code = run(argc, argv, claims_json, errata_json);
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::cout && !std::ferror(stdout)) return code;
  const int lost = fail({ErrorCode::input_output, "cannot write to standard output: not all data got through"});
  return code == 0 ? lost : code;
}

}  // namespace etendue::validation
