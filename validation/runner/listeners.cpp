// SPDX-License-Identifier: Apache-2.0
#include "runner/listeners.hpp"

#include <unistd.h>

#include <cstdio>
#include <string>

#include "cli/stop.hpp"

namespace etendue::validation {

namespace {

constexpr double kSecondsPerMillisecond = 1e-3;

std::string text(const ::testing::TestPartResult& part) {
  const std::string place = part.file_name()
                                ? std::string(part.file_name()) + ":" + std::to_string(part.line_number()) + ": "
                                : std::string();
  return place + part.message();
}

}  // namespace

void Collector::OnTestStart(const ::testing::TestInfo&) {
  if (cli::stop_requested()) GTEST_SKIP();
}

void Collector::OnTestEnd(const ::testing::TestInfo& info) {
  const auto& result = *info.result();
  TestRun test;
  test.suite = info.test_suite_name();
  test.name = info.name();
  test.outcome = result.Failed() ? Outcome::failed : result.Skipped() ? Outcome::skipped : Outcome::passed;
  // A terminal sends its interrupt to the program under test as well: what fails meanwhile says nothing.
  if (cli::stop_requested() && test.outcome != Outcome::passed) test.outcome = Outcome::not_run;
  test.seconds = static_cast<double>(result.elapsed_time()) * kSecondsPerMillisecond;
  for (int i = 0; i < result.total_part_count(); ++i) {
    if (test.outcome != Outcome::not_run && result.GetTestPartResult(i).failed())
      test.failures.push_back(text(result.GetTestPartResult(i)));
  }
  const std::string full_name = test.suite + "." + test.name;
  for (const auto& evidence : collected_evidence()) {
    if (evidence.test == full_name) test.evidence.push_back(evidence);
  }
  tests_.push_back(std::move(test));
}

void Progress::OnTestStart(const ::testing::TestInfo& info) {
  ++done_;
  if (!::isatty(STDERR_FILENO)) return;
  const std::string name = std::string(info.test_suite_name()) + "." + info.name();
  std::fprintf(stderr, "\r\033[K%d/%d %.70s", done_, ::testing::UnitTest::GetInstance()->test_to_run_count(),
               name.c_str());
  std::fflush(stderr);
}

void Progress::OnTestProgramEnd(const ::testing::UnitTest&) {
  if (::isatty(STDERR_FILENO)) std::fprintf(stderr, "\r\033[K");
}

}  // namespace etendue::validation
