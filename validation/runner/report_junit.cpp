// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdio>

#include "runner/report.hpp"

namespace etendue::validation {

namespace {

/// XML 1.0 text: the five entities, and '?' for what XML cannot hold (control characters, bytes beyond ASCII).
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\'')
      out += "&apos;";
    else if (c == '\n')
      out += "&#10;";
    else if (c == '\t')
      out += "&#9;";
    else if (byte < 0x20 || byte >= 0x7f)
      out += '?';
    else
      out += c;
  }
  return out;
}

std::string attribute(const char* key, const std::string& value) {
  return std::string(" ") + key + "=\"" + escaped(value) + "\"";
}

std::string seconds_text(double seconds) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.3f", seconds);
  return buffer.data();
}

std::string property(const char* key, const std::string& value) {
  return "        <property" + attribute("name", key) + attribute("value", value) + "/>\n";
}

std::string properties(const TestRun& test) {
  std::string text;
  for (const auto& evidence : test.evidence) {
    if (evidence.claims.empty()) continue;
    std::string claims;
    for (const auto& id : evidence.claims) claims += (claims.empty() ? "" : " ") + id;
    text += property("claims", claims) + property("oracle", evidence.kind + ": " + evidence.oracle) +
            property("worst_share", share_text(evidence.worst_share)) +
            property("comparisons", std::to_string(evidence.comparisons));
  }
  return text.empty() ? text : "      <properties>\n" + text + "      </properties>\n";
}

std::string test_case(const TestRun& test) {
  std::string text = "    <testcase" + attribute("classname", test.suite) + attribute("name", test.name) +
                     attribute("time", seconds_text(test.seconds)) + ">\n" + properties(test);
  for (const auto& failure : test.failures) {
    text += "      <failure" + attribute("message", failure.substr(0, failure.find('\n'))) + ">" + escaped(failure) +
            "</failure>\n";
  }
  if (test.outcome == Outcome::skipped) text += "      <failure message=\"skipped\">nothing skips here</failure>\n";
  if (test.outcome == Outcome::not_run) text += "      <skipped message=\"the run was stopped\"/>\n";
  return text + "    </testcase>\n";
}

struct Counts {
  std::size_t tests = 0;
  std::size_t failures = 0;
  std::size_t skipped = 0;
  double seconds = 0;
};

std::string counted(const Counts& counts) {
  return attribute("tests", std::to_string(counts.tests)) + attribute("failures", std::to_string(counts.failures)) +
         attribute("skipped", std::to_string(counts.skipped)) + " errors=\"0\"" +
         attribute("time", seconds_text(counts.seconds));
}

/// Everything that fails the run beside its tests, as one more test case: a reader of JUnit sees red too.
std::string problem_suite(const Summary& summary) {
  if (summary.problems.empty()) return {};
  std::string text = "  <testsuite name=\"Register\"" + counted({1, 1, 0, 0}) + ">\n";
  TestRun all{"Register", "EveryVerdictIsBacked", Outcome::failed, summary.problems, 0, {}};
  return text + test_case(all) + "  </testsuite>\n";
}

}  // namespace

std::string junit_report(const Summary& summary, const BuildInfo& build) {
  Counts all{summary.tests.size(), static_cast<std::size_t>(summary.failed), static_cast<std::size_t>(summary.not_run),
             build.seconds};
  if (!summary.problems.empty()) {
    ++all.tests;
    ++all.failures;
  }
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" + attribute("name", "etendue-validate") +
                     counted(all) + attribute("timestamp", build.date) + ">\n";
  for (std::size_t first = 0; first < summary.tests.size();) {
    // Tests of one suite stand together: GoogleTest runs them so.
    std::size_t last = first;
    Counts counts;
    std::string cases;
    while (last < summary.tests.size() && summary.tests[last].suite == summary.tests[first].suite) {
      const TestRun& test = summary.tests[last++];
      ++counts.tests;
      counts.failures += test.outcome == Outcome::failed || test.outcome == Outcome::skipped;
      counts.skipped += test.outcome == Outcome::not_run;
      counts.seconds += test.seconds;
      cases += test_case(test);
    }
    text += "  <testsuite" + attribute("name", summary.tests[first].suite) + counted(counts) + ">\n" + cases +
            "  </testsuite>\n";
    first = last;
  }
  return text + problem_suite(summary) + "</testsuites>\n";
}

}  // namespace etendue::validation
