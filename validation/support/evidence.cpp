// SPDX-License-Identifier: Apache-2.0
#include "support/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace etendue::validation {

namespace {

std::vector<Evidence>& store() {
  static std::vector<Evidence> evidence;
  return evidence;
}

bool& only_claims() {
  static bool only = false;
  return only;
}

std::string running_test() {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  return info ? std::string(info->test_suite_name()) + "." + info->name() : "outside a test";
}

Evidence& current() {
  const std::string test = running_test();
  auto& all = store();
  if (all.empty() || all.back().test != test) all.push_back({test, {}, {}, {}, 0, 0, {}});
  return all.back();
}

void record(double share, std::uint64_t comparisons) {
  Evidence& evidence = current();
  evidence.worst_share = std::isnan(share) ? share : std::max(evidence.worst_share, share);
  evidence.comparisons += comparisons;
}

double share_of(double error, double tolerance) {
  return error == 0 ? 0 : error / tolerance;
}

}  // namespace

std::string_view name(Oracle kind) {
  switch (kind) {
    case Oracle::identity:
      return "identity";
    case Oracle::closed_form:
      return "closed form";
    case Oracle::table:
      return "table";
    case Oracle::exact:
      return "exact arithmetic";
    case Oracle::metamorphic:
      return "metamorphic";
    case Oracle::statistics:
      return "statistics";
    case Oracle::program:
      return "independent method";
    case Oracle::render:
      return "known render";
  }
  return "unknown";
}

void proves(std::initializer_list<const char*> claims, Oracle kind, std::string_view oracle) {
  if (!current().claims.empty()) store().push_back({running_test(), {}, {}, {}, 0, 0, {}});
  Evidence& evidence = current();
  evidence.claims.assign(claims.begin(), claims.end());
  evidence.kind = name(kind);
  evidence.oracle = oracle;
  if (only_claims()) {
    // GoogleTest takes this for an assertion that was reported already, and ends the test without a failure.
    throw ::testing::AssertionException({::testing::TestPartResult::kSuccess, "", 0, ""});
  }
  std::string joined;
  for (const auto& claim : evidence.claims) joined += (joined.empty() ? "" : " ") + claim;
  ::testing::Test::RecordProperty("claims", joined);
  ::testing::Test::RecordProperty("oracle", evidence.kind + ": " + evidence.oracle);
}

::testing::AssertionResult within(double error, double tolerance) {
  const bool sound = error >= 0 && std::isfinite(error) && tolerance >= 0;
  record(sound ? share_of(error, tolerance) : std::nan(""), 1);
  if (sound && error <= tolerance) return ::testing::AssertionSuccess();
  std::ostringstream text;
  text.precision(17);
  text << "error " << error << " is " << (sound ? error / tolerance : std::nan("")) << " times the tolerance "
       << tolerance;
  return ::testing::AssertionFailure() << text.str();
}

::testing::AssertionResult near(double actual, double expected, double tolerance) {
  auto result = within(std::abs(actual - expected), tolerance);
  if (!result) {
    std::ostringstream text;
    text.precision(17);
    text << "\n  actual   " << actual << "\n  expected " << expected;
    result << text.str();
  }
  return result;
}

::testing::AssertionResult apart(double printed, double right, double tolerance) {
  const bool sound = std::isfinite(right) && tolerance >= 0;
  record(sound ? 0 : std::nan(""), 1);
  if (sound && !(std::abs(printed - right) <= tolerance)) return ::testing::AssertionSuccess();
  std::ostringstream text;
  text.precision(17);
  text << printed << " is not apart from " << right << " by more than " << tolerance;
  return ::testing::AssertionFailure() << text.str();
}

::testing::AssertionResult all_agree(std::uint64_t mismatches, std::uint64_t decisions) {
  record(mismatches == 0 && decisions > 0 ? 0 : std::nan(""), decisions);
  if (decisions == 0) return ::testing::AssertionFailure() << "nothing was decided";
  if (mismatches == 0) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << mismatches << " of " << decisions << " decisions disagree";
}

::testing::AssertionResult holds(bool decision) {
  return all_agree(decision ? 0 : 1, 1);
}

void uses_seed(std::uint64_t seed) {
  current().seeds.push_back(seed);
}

const std::vector<Evidence>& collected_evidence() {
  return store();
}

void only_collect_claims() {
  only_claims() = true;
}

}  // namespace etendue::validation
