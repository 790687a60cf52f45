// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runner/register.hpp"
#include "support/evidence.hpp"

// Joins what the tests left behind with the register: which rows does this run back, and which does it contradict?
namespace etendue::validation {

enum class Outcome {
  passed,
  failed,
  skipped,
  not_run,  ///< the user had stopped the run, or did while the test failed: that may be why it failed
};

/// One finished test.
struct TestRun {
  std::string suite;
  std::string name;
  Outcome outcome = Outcome::passed;
  std::vector<std::string> failures;  ///< "file:line: message"
  double seconds = 0;
  std::vector<Evidence> evidence;
};

/// What this run says about one row.
enum class Standing {
  confirmed,  ///< the register's verdict stands: tests ran and passed
  failed,     ///< a test that proves it failed
  unbacked,   ///< the register claims a proof, a full run found none
  not_run,    ///< the register claims a proof, but its tests were not selected
  partial,    ///< open in the register; tests of a part of it passed
  open,
  not_testable,  ///< by the register, which says why
};

/// One line of the report: a row of the register and one kind of oracle that it was held against.
struct Proof {
  std::string kind;
  std::string oracle;
  double worst_share = 0;  ///< of the tolerance; 0: every comparison was exact
  std::uint64_t comparisons = 0;
  std::vector<std::string> tests;
};

struct RowReport {
  std::string id;
  Verdict verdict = Verdict::open;
  Standing standing = Standing::open;
  std::vector<std::string> errata;
  std::vector<Proof> proofs;  ///< by kind, in the order of the tests
};

struct Summary {
  std::vector<TestRun> tests;
  std::vector<RowReport> claims;
  std::vector<RowReport> errata;
  std::vector<std::string> problems;  ///< anything that makes the run fail beside failed tests
  int passed = 0;
  int failed = 0;
  int not_run = 0;   ///< tests, for the user stopped the run
  int left_out = 0;  ///< tests of commands, which nobody asked for
  int verified = 0;
  int refuted = 0;
  int open = 0;
  int not_testable = 0;
  int proved = 0;
  bool full = true;

  bool ok() const { return failed == 0 && problems.empty(); }
};

/// `full`: nothing narrowed the run, so a row without a passing test is a problem.
Summary summarize(const Register& all, std::vector<TestRun> tests, bool full);

/// "12 claims verified, 3 refuted with the mended form verified, 90 open; 5 errata proved"
std::string headline(const Summary& summary);

/// "; 109 of commands left out (--all)"; nothing when none were.
std::string left_out_text(const Summary& summary);

/// "STOPPED: 3 tests were not run", and from which suites; nothing when the run was not stopped.
std::string stop_notice(const Summary& summary);

/// The word for the table: "verified", "FAILED", "not run", …
std::string word(const RowReport& row);

}  // namespace etendue::validation
