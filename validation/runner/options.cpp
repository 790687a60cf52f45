// SPDX-License-Identifier: Apache-2.0
#include "runner/options.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <numeric>
#include <optional>

namespace etendue::validation {

namespace {

constexpr std::array kKnown = {"--filter", "--claim",   "--subject",           "--long",   "--text", "--json",
                               "--junit",  "--report",  "--history",           "--quiet",  "--list", "--claims",
                               "--help",   "--version", "--update-references", "--reason", "--jobs", "--all"};

/// Levenshtein's distance: how many single letters to change, insert or drop.
std::size_t edits(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

std::string nearest(const std::string& option) {
  return *std::min_element(kKnown.begin(), kKnown.end(),
                           [&](const char* a, const char* b) { return edits(option, a) < edits(option, b); });
}

Error usage(const std::string& message) {
  return Error{ErrorCode::usage, message};
}

constexpr int kMostJobs = 200;

/// "3" is 3; nothing where `text` is no whole number from 1 to kMostJobs.
std::optional<int> jobs_in(const std::string& text) {
  int jobs = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), jobs);
  if (error != std::errc() || end != text.data() + text.size() || jobs < 1 || jobs > kMostJobs) return std::nullopt;
  return jobs;
}

std::string* value_of(Options& options, std::string& jobs, const std::string& option) {
  if (option == "--jobs") return &jobs;
  if (option == "--filter") return &options.filters.emplace_back();
  if (option == "--claim") return &options.claims.emplace_back();
  if (option == "--subject") return &options.subjects.emplace_back();
  if (option == "--text") return &options.text_path;
  if (option == "--json") return &options.json_path;
  if (option == "--junit") return &options.junit_path;
  if (option == "--report") return &options.html_path;
  if (option == "--history") return &options.history.emplace_back();
  if (option == "--update-references") return &options.references;
  if (option == "--reason") return &options.reason;
  return nullptr;
}

bool set_flag(Options& options, const std::string& option) {
  if (option == "--quiet")
    options.quiet = true;
  else if (option == "--all")
    options.all = true;
  else if (option == "--long")
    options.all = options.deep = true;
  else if (option == "--help" || option == "-h")
    options.action = Options::Action::help;
  else if (option == "--version")
    options.action = Options::Action::version;
  else if (option == "--list")
    options.action = Options::Action::list;
  else if (option == "--claims")
    options.action = Options::Action::claims;
  else
    return false;
  return true;
}

}  // namespace

Result<Options> parse_options(const std::vector<std::string>& arguments) {
  Options options;
  std::string jobs;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (argument.rfind("--gtest_", 0) == 0) {
      options.gtest_options.push_back(argument);
      continue;
    }
    const std::size_t equals = argument.rfind("--", 0) == 0 ? argument.find('=') : std::string::npos;
    const std::string option = argument.substr(0, equals);
    if (equals == std::string::npos && set_flag(options, option)) continue;
    std::string* value = value_of(options, jobs, option);
    if (value == nullptr) {
      if (argument.rfind('-', 0) != 0)
        return usage("unexpected argument " + argument + "; to select tests use --filter " + argument);
      return usage("unknown option " + argument + "; did you mean " + nearest(option) + "?");
    }
    if (equals != std::string::npos)
      *value = argument.substr(equals + 1);
    else if (i + 1 < arguments.size())
      *value = arguments[++i];
    if (value->empty()) return usage(option + " needs a value");
  }
  if (!jobs.empty()) {
    const auto count = jobs_in(jobs);
    if (!count) return usage("--jobs " + jobs + ": expected a whole number from 1 to " + std::to_string(kMostJobs));
    options.jobs = *count;
  }
  if (options.references.empty() != options.reason.empty()) {
    return usage(options.reason.empty() ? "--update-references needs --reason: why the old pictures are no longer right"
                                        : "--reason belongs to --update-references");
  }
  if (!options.history.empty() && options.html_path.empty()) return usage("--history belongs to --report");
  if (!options.references.empty()) options.action = Options::Action::update_references;
  return options;
}

const char* help_text() {
  return R"(etendue-validate: hold every claim of the source texts against its oracle

Usage: etendue-validate [options]            (also: etendue validate [options])
       etendue-validate grade [options] -- COMMAND ...
                                             hold any program against cases whose answers are known; grade --help

Runs the tests and prints, for each claim, the kind of oracle, the worst error as a share of the tolerance, and the
verdict. "exact" means that every comparison was a yes-or-no decision or agreed to the last bit.

Options
  --filter ID|PATTERN  run only tests that prove this claim or erratum, or whose name fits (* any, ? one); repeatable
  --claim ID           run only tests that prove this claim or erratum; repeatable, and joined with --filter and --subject
  --subject NAME       run only tests of one subject ("form factors") or module (form_factor); repeatable
  --all                run the tests of the program's commands too: what they prove of the claims other tests prove as well
  --long               the deep version of all: a hundred times as many random rays and pairs, 10^8 rays at the edges of a
                       mesh and more than 10^5 pairs of polygons; hours, with a bar that shows how far it is
  --jobs N             run N tests at a time, each process taking the next (default: one a core)
  --text FILE          write the table to FILE
  --json FILE          write all evidence to FILE as JSON
  --junit FILE         write the outcome to FILE as JUnit XML
  --report FILE        write an HTML page to FILE, complete in itself: verdict, margins, claims, tolerances, figures
  --history FILE       let that page tell of an earlier run, from its --json; repeatable
  --quiet              print failures and the closing line only
  --list               print each test with what it proves, and stop
  --claims             print the register, a row a claim: verdict, kinds of oracle, tests (tabs between them), and stop
  --update-references WHICH --reason WHY
                       render the pictures of scenes/references.json whose paths begin with WHICH (or all) again, replace
                       those that changed, and record version, day and reason
  --version            print the version, and stop
  --help               print this, and stop
  --gtest_*            handed to GoogleTest, which then prints in its own form

Exit status
  0  all tests passed, and every verdict of the register is backed
  1  a test failed, asserts nothing, or the register claims what no test proves
  2  the command line is wrong, or what was chosen selects nothing
  3  a file of --history is no report
  5  a report cannot be written, or a file of --history not read (checked before the first test runs), or standard output did
     not take everything
  6  stopped by Ctrl-C: the running test was ended, the reports say which tests were not run

Sample runs
  etendue-validate --claims
  etendue-validate --claim IU.6-11
  etendue-validate --subject optics --quiet
  etendue-validate --filter 'IU.5-1*' --json report.json
  etendue-validate --filter 'IU.6-11' --report report.html
)";
}

bool fits(const std::string& text, const std::string& pattern) {
  std::size_t t = 0;
  std::size_t p = 0;
  std::size_t star = std::string::npos;
  std::size_t resume = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = t;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
      ++p;
      ++t;
    } else if (star != std::string::npos) {
      p = star + 1;
      t = ++resume;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

}  // namespace etendue::validation
