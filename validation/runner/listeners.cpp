// SPDX-License-Identifier: Apache-2.0
#include "runner/listeners.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

#include "cli/stop.hpp"
#include "support/long_run.hpp"

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

namespace {

Progress* the_progress = nullptr;

std::string clock_text(std::chrono::steady_clock::duration duration) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(duration).count();
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%d:%02d:%02d", static_cast<int>(seconds / 3600),
                static_cast<int>(seconds / 60 % 60), static_cast<int>(seconds % 60));
  return text.data();
}

std::string bar(double share) {
  constexpr std::size_t kWidth = 24;
  const auto full = static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(kWidth));
  return "[" + std::string(full, '#') + std::string(kWidth - full, '.') + "] ";
}

}  // namespace

Progress::Progress(Depth depth) : depth_(depth) {
  if (depth_ != Depth::long_run || !::isatty(STDERR_FILENO)) return;
  the_progress = this;
  on_share_done = [](double share) {
    constexpr auto kEvery = std::chrono::milliseconds(200);
    if (std::chrono::steady_clock::now() - the_progress->shown_ >= kEvery) the_progress->show(share);
  };
}

Progress::~Progress() {
  if (the_progress != this) return;
  on_share_done = nullptr;
  the_progress = nullptr;
}

void Progress::show(double share) {
  shown_ = std::chrono::steady_clock::now();
  const int tests = ::testing::UnitTest::GetInstance()->test_to_run_count();
  const std::string head =
      depth_ == Depth::usual ? "" : bar((begun_ - 1 + share) / tests) + clock_text(shown_ - start_) + " ";
  const std::string tail = share > 0 ? " " + std::to_string(static_cast<int>(100 * share)) + " %" : "";
  std::fprintf(stderr, "\r\033[K%s%d/%d %.70s%s", head.c_str(), begun_, tests, test_.c_str(), tail.c_str());
  std::fflush(stderr);
}

void Progress::OnTestStart(const ::testing::TestInfo& info) {
  ++begun_;
  test_ = std::string(info.test_suite_name()) + "." + info.name();
  if (::isatty(STDERR_FILENO)) show(0);
}

void Progress::OnTestProgramEnd(const ::testing::UnitTest&) {
  if (::isatty(STDERR_FILENO)) std::fprintf(stderr, "\r\033[K");
}

}  // namespace etendue::validation
