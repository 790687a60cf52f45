// SPDX-License-Identifier: Apache-2.0
#include "runner/probe.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <sstream>

#include "support/evidence.hpp"

namespace etendue::validation {

namespace {

constexpr const char* kProbeVariable = "ETENDUE_VALIDATE_PROBE";

void write_all(int descriptor, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t written = ::write(descriptor, text.data() + done, text.size() - done);
    if (written <= 0 && errno != EINTR) return;
    if (written > 0) done += static_cast<std::size_t>(written);
  }
}

std::string tests_and_claims() {
  std::string text;
  const auto& unit = *::testing::UnitTest::GetInstance();
  for (int s = 0; s < unit.total_test_suite_count(); ++s) {
    const auto& suite = *unit.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const std::string test = std::string(suite.name()) + "." + suite.GetTestInfo(t)->name();
      text += test + "\t";
      for (const auto& evidence : collected_evidence()) {
        if (evidence.test != test) continue;
        text += evidence.kind + "\t";
        for (const auto& claim : evidence.claims) text += " " + claim;
      }
      text += "\n";
    }
  }
  return text;
}

[[noreturn]] void run_child(int pipe_end) {
  ::setenv(kProbeVariable, "1", 1);
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int stream : {0, 1, 2}) ::dup2(nowhere, stream);
  int argc = 1;
  char program[] = "etendue-validate";
  char* argv[] = {program, nullptr};
  ::testing::InitGoogleTest(&argc, argv);
  GTEST_FLAG_SET(filter, "*");
  GTEST_FLAG_SET(output, "");
  only_collect_claims();
  // A test that fails here fails because it was cut short; only its claims matter.
  [[maybe_unused]] const int cut_short = RUN_ALL_TESTS();
  write_all(pipe_end, tests_and_claims());
  ::_exit(0);
}

std::string read_all(int descriptor) {
  std::string text;
  char buffer[4096];
  for (;;) {
    const ssize_t count = ::read(descriptor, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer, static_cast<std::size_t>(count));
  }
}

std::vector<TestClaims> parse(const std::string& text) {
  std::vector<TestClaims> tests;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    TestClaims& test = tests.emplace_back();
    std::getline(words, test.test, '\t');
    std::getline(words, test.oracle, '\t');
    for (std::string id; words >> id;) test.claims.push_back(id);
  }
  return tests;
}

}  // namespace

bool inside_probe() {
  return std::getenv(kProbeVariable) != nullptr;
}

Result<std::vector<TestClaims>> probe_tests() {
  if (inside_probe()) return Error{ErrorCode::usage, "a probe of the tests must not start another"};
  int ends[2];
  if (::pipe(ends) != 0) return Error{ErrorCode::input_output, "no pipe for the probe of the tests"};
  const pid_t child = ::fork();
  if (child < 0) return Error{ErrorCode::input_output, "no process for the probe of the tests"};
  if (child == 0) {
    ::close(ends[0]);
    run_child(ends[1]);
  }
  ::close(ends[1]);
  const std::string text = read_all(ends[0]);
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    return Error{ErrorCode::check_failed, "the probe of the tests crashed: a test must begin with proves()"};
  }
  return parse(text);
}

}  // namespace etendue::validation
