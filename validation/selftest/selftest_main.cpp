// SPDX-License-Identifier: Apache-2.0
// A program whose tests misbehave on purpose, each in one way, so that runner_selftest.py can see the runner notice.
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>

#include "cli/stop.hpp"
#include "runner/run.hpp"
#include "support/evidence.hpp"
#include "support/exhibit.hpp"
#include "support/long_run.hpp"

namespace etendue::validation {
namespace {

constexpr const char* kClaims = R"({"claims": [
  {"id": "T.1", "source": "[T] 1", "subject": "s", "statement": "holds", "formula": "", "verdict": "verified"},
  {"id": "T.2", "source": "[T] 2", "subject": "mended things", "statement": "mended", "formula": "", "verdict": "refuted", "errata": ["E1"]},
  {"id": "T.3", "source": "[T] 3", "subject": "errors", "statement": "unproved", "formula": "", "verdict": "verified", "errata": ["E1"]},
  {"id": "T.4", "source": "[T] 4", "subject": "s", "statement": "open", "formula": "", "verdict": "open"},
  {"id": "T.5", "source": "[T] 5", "subject": "s", "statement": "names a man", "formula": "", "verdict": "not testable", "reason": "nobody asked him"}]})";
constexpr const char* kErrata = R"({"errata": [
  {"id": "E1", "source": "[T] 2", "printed": "p", "right": "r", "tells_apart": "", "verdict": "proved"}]})";

/// One of each kind, small and right.
void exhibit_figures() {
  exhibit(Convergence{"A <curve>", "h", {0.5, 0.25, 0.125}, {0.25, 0.0625, 0.0157}, 2, 0.05});
  ErrorHistogram histogram("A histogram", "ulps", 0.25, 8);
  for (const double error : {0.1, 0.3, 0.6}) histogram.add(error);
  exhibit(histogram);
  exhibit(WorstInput{"An input", "etendue catalogue C-11 --a 1 --b 1 --c 1", std::abs(1.1 - 1)});
  exhibit(FactorTable{
      "Three surfaces", {1, 2, 1}, {0, 0.75, 0.25, 0.375, 0.25, 0.375, 0.25, 0.75, 0}, std::vector(9, 0.001), {}});
  // A floor and a wall before the eye, turned to it.
  exhibit(RadiosityField{"A corner",
                         {{-2, 1, -1, 2, 1, -1, 2, 4, -1, -2, 4, -1}, {-2, 4, -1, 2, 4, -1, 2, 4, 2, -2, 4, 2}},
                         {0.5, 0.25, 0.125, 0.25, 1, 0.5},
                         {1, 0.5, 0.125},
                         0.5,
                         {{10, 6, 4, 1e-9}, {10, 7, 3, 1e-9}, {10, 8, 2, 1e-9}},
                         {0, -2, 0},
                         {0.28, 0.96, 0}});
  const std::vector<double> reference = {0, 0.5, 1, 0.25, 0.25, 0.25, 0.75, 0.5, 0.125, 1, 1, 1, 0, 0, 0, 0.5, 0.25, 2};
  ImagePair pair{"Six pixels", 3, 2, reference, reference, 0.125};
  pair.ours[4] += 0.0625;
  pair.ours[6] -= 0.015625;
  exhibit(pair);
}

/// Two tests meet here, each in a process of its own; one of them stops the whole run, and both end when told to.
void meet_to_stop_the_run(bool stops) {
  const char* number = std::getenv("ETENDUE_SELFTEST_STOP_THE_RUN");
  if (number == nullptr) return;
  if (stops) ::kill(::getppid(), std::atoi(number));
  const auto begun = std::chrono::steady_clock::now();
  while (!cli::stop_requested() && std::chrono::steady_clock::now() - begun < std::chrono::seconds(20)) ::usleep(1000);
}

TEST(Good, HoldsATenthOfItsTolerance) {
  proves({"T.1"}, Oracle::closed_form, "one");
  meet_to_stop_the_run(false);
  uses_seed(7);
  EXPECT_TRUE(near(1.1, 1, 1));
  exhibit_figures();
}

TEST(Good, DecidesExactly) {
  proves({"T.2", "E1"}, Oracle::exact, "<integers> & \"quotes\"");
  EXPECT_TRUE(all_agree(0, long_run(3)));
  const auto begun = std::chrono::steady_clock::now();  // the bar moves every fifth of a second
  while (on_share_done != nullptr && std::chrono::steady_clock::now() - begun < std::chrono::milliseconds(300))
    share_done(1, 2);
  EXPECT_TRUE(apart(1, 2, 0.5));
  meet_to_stop_the_run(true);
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
