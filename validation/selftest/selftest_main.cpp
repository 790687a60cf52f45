// SPDX-License-Identifier: Apache-2.0
// A program whose tests misbehave on purpose, each in one way, so that runner_selftest.py can see the runner notice.
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>

#include "runner/run.hpp"
#include "support/evidence.hpp"
#include "support/long_run.hpp"

namespace etendue::validation {
namespace {

constexpr const char* kClaims = R"({"claims": [
  {"id": "T.1", "source": "[T] 1", "subject": "s", "statement": "holds", "formula": "", "verdict": "verified"},
  {"id": "T.2", "source": "[T] 2", "subject": "mended things", "statement": "mended", "formula": "", "verdict": "refuted", "errata": ["E1"]},
  {"id": "T.3", "source": "[T] 3", "subject": "errors", "statement": "unproved", "formula": "", "verdict": "verified", "errata": ["E1"]},
  {"id": "T.4", "source": "[T] 4", "subject": "s", "statement": "open", "formula": "", "verdict": "open"}]})";
constexpr const char* kErrata = R"({"errata": [
  {"id": "E1", "source": "[T] 2", "printed": "p", "right": "r", "tells_apart": "", "verdict": "proved"}]})";

TEST(Good, HoldsATenthOfItsTolerance) {
  proves({"T.1"}, Oracle::closed_form, "one");
  uses_seed(7);
  EXPECT_TRUE(near(1.1, 1, 1));
}

TEST(Good, DecidesExactly) {
  proves({"T.2", "E1"}, Oracle::exact, "<integers> & \"quotes\"");
  EXPECT_TRUE(all_agree(0, long_run(3)));
  const auto begun = std::chrono::steady_clock::now();  // the bar moves every fifth of a second
  while (on_share_done != nullptr && std::chrono::steady_clock::now() - begun < std::chrono::milliseconds(300))
    share_done(1, 2);
  EXPECT_TRUE(apart(1, 2, 0.5));
  if (const char* number = std::getenv("ETENDUE_SELFTEST_SIGNAL")) std::raise(std::atoi(number));
}

TEST(Good, TwoOraclesInOneTest) {
  proves({"T.1"}, Oracle::identity, "itself");
  EXPECT_TRUE(near(1, 1, 0));
  proves({"T.4"}, Oracle::table, "a table");
  EXPECT_TRUE(near(1.5, 1, 1));
}

TEST(Bad, Fails) {
  proves({"T.1"}, Oracle::closed_form, "two");
  EXPECT_TRUE(near(3, 2, 0.5)) << "\x01 <&> \xff";
}

TEST(Bad, AssertsNothing) {
  proves({"T.1"}, Oracle::identity, "nothing");
}

TEST(Bad, PassesOutOfBounds) {
  proves({"T.1"}, Oracle::identity, "carelessness");
  EXPECT_FALSE(near(3, 2, 0.5));
}

TEST(Bad, PassesOnNan) {
  proves({"T.1"}, Oracle::identity, "carelessness");
  EXPECT_FALSE(near(std::nan(""), 2, 0.5));
}

TEST(Bad, NamesAnUnknownClaim) {
  proves({"T.77"}, Oracle::identity, "itself");
  EXPECT_TRUE(near(1, 1, 0));
}

TEST(Bad, Skips) {
  proves({"T.1"}, Oracle::identity, "itself");
  GTEST_SKIP() << "not today";
}

TEST(Bad, DISABLED_Sleeps) {
  proves({"T.1"}, Oracle::identity, "itself");
}

}  // namespace
}  // namespace etendue::validation

int main(int argc, char** argv) {
  using namespace etendue::validation;
  return run_validation(argc, argv, kClaims, kErrata);
}
