// SPDX-License-Identifier: Apache-2.0
#include "runner/probe.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <utility>

#include "runner/child.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {

namespace {

constexpr const char* kProbeVariable = "ETENDUE_VALIDATE_PROBE";

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

std::string claims_of_all_tests() {
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
  return tests_and_claims();
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
  auto started = Child::start(claims_of_all_tests);
  if (!started) return started.error();
  Child probe = std::move(started).value();
  const Child::Ended ended = probe.wait();
  if (!ended.well) {
    return Error{ErrorCode::check_failed, "the probe of the tests crashed: a test must begin with proves()"};
  }
  return parse(ended.text);
}

}  // namespace etendue::validation
