// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "etendue/core/contract.hpp"

// What a test proves, and how far from failing it was. The runner joins this with the register of claims.
namespace etendue::validation {

/// The kinds of oracle, in order of preference (CONTRIBUTING.md).
enum class Oracle {
  identity,     ///< an algebraic identity or invariant
  closed_form,  ///< a formula, evaluated at higher precision or in balls
  table,        ///< a published or generated table
  exact,        ///< exact arithmetic: CGAL kernels, rationals
  metamorphic,  ///< a relation between two answers
  statistics,   ///< a statistical test with stated level
  program,      ///< another program, or another method in this one
  render,       ///< a picture known pixel by pixel
};
std::string_view name(Oracle kind);

/// First statement of a test: the claims and errata it proves, and what it holds the code against.
/// A second call in the same test opens a second record, for another oracle; comparisons go to the latest.
/// (--filter and --list know a test by its first call.)
void proves(std::initializer_list<const char*> claims, Oracle kind, std::string_view oracle);

/// |actual − expected| ≤ tolerance. NaN fails. Records error/tolerance for the report.
::testing::AssertionResult near(double actual, double expected, double tolerance);

/// error ≤ tolerance for an error computed by the test itself; negative or NaN fails. Records the share.
::testing::AssertionResult within(double error, double tolerance);

/// The printed formula really is wrong: |printed − right| > tolerance, or `printed` is NaN or infinite.
/// Counts as a comparison, leaves the worst share alone: an erratum's distance says nothing about our accuracy.
::testing::AssertionResult apart(double printed, double right, double tolerance);

/// No mismatch in `decisions` yes/no decisions; zero decisions fail: a check of nothing proves nothing.
::testing::AssertionResult all_agree(std::uint64_t mismatches, std::uint64_t decisions);

/// One yes-or-no decision: a refusal, an equality, a miss. Short for all_agree over a single decision.
::testing::AssertionResult holds(bool decision);

/// One decision: `call` breaks a contract and is told so.
template <class Call>
::testing::AssertionResult refuses(Call&& call) {
  try {
    call();
  } catch (const ContractViolation&) {
    return holds(true);
  }
  return holds(false) << "no ContractViolation";
}

/// Notes the seed of a random family in the report, so that the run can be repeated.
void uses_seed(std::uint64_t seed);

/// What one test left behind.
struct Evidence {
  std::string test;  ///< Suite.Name
  std::vector<std::string> claims;
  std::string kind;
  std::string oracle;
  double worst_share = 0;  ///< max error/tolerance; 0 where every comparison was exact
  std::uint64_t comparisons = 0;
  std::vector<std::uint64_t> seeds;
};

/// Of all tests run so far in this process, in order.
const std::vector<Evidence>& collected_evidence();

/// From now on proves() ends its test at once: tells which test proves what without computing anything.
void only_collect_claims();

}  // namespace etendue::validation
