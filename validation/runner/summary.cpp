// SPDX-License-Identifier: Apache-2.0
#include "runner/summary.hpp"

#include <algorithm>
#include <cmath>

namespace etendue::validation {

namespace {

std::string full_name(const TestRun& test) {
  return test.suite + "." + test.name;
}

bool cites(const Evidence& evidence, const std::string& id) {
  return std::find(evidence.claims.begin(), evidence.claims.end(), id) != evidence.claims.end();
}

/// A test that compared nothing, or that passed although a comparison was out of bounds, proves nothing.
std::string why_worthless(const Evidence& evidence) {
  if (evidence.claims.empty()) return {};
  if (evidence.comparisons == 0) return "asserts nothing: compare with near, within, apart, holds or all_agree";
  if (std::isnan(evidence.worst_share)) return "asserts nothing: a comparison was not a number";
  if (evidence.worst_share > 1) return "passed although an error exceeds its tolerance";
  return {};
}

void add(std::vector<Proof>& proofs, const Evidence& evidence) {
  auto found = std::find_if(proofs.begin(), proofs.end(), [&](const Proof& p) { return p.kind == evidence.kind; });
  if (found == proofs.end()) found = proofs.insert(proofs.end(), Proof{evidence.kind, evidence.oracle, 0, 0, {}});
  found->worst_share =
      std::isnan(evidence.worst_share) ? evidence.worst_share : std::max(found->worst_share, evidence.worst_share);
  found->comparisons += evidence.comparisons;
  found->tests.push_back(evidence.test);
}

Standing standing(Verdict verdict, bool any_passed, bool any_failed, bool full) {
  if (any_failed) return Standing::failed;
  if (verdict == Verdict::not_testable) return any_passed ? Standing::unbacked : Standing::not_testable;
  if (verdict == Verdict::open) return any_passed ? Standing::partial : Standing::open;
  if (any_passed) return Standing::confirmed;
  return full ? Standing::unbacked : Standing::not_run;
}

RowReport report_row(const std::string& id, Verdict verdict, const std::vector<TestRun>& tests, bool full) {
  RowReport row{id, verdict, Standing::open, {}, {}};
  bool any_passed = false;
  bool any_failed = false;
  for (const auto& test : tests) {
    for (const auto& evidence : test.evidence) {
      if (!cites(evidence, id) || test.outcome == Outcome::not_run) continue;
      const bool good = test.outcome == Outcome::passed && why_worthless(evidence).empty();
      (good ? any_passed : any_failed) = true;
      add(row.proofs, evidence);
    }
  }
  row.standing = standing(verdict, any_passed, any_failed, full);
  return row;
}

void find_problems(Summary& summary, const Register& all) {
  for (const auto& test : summary.tests) {
    if (test.outcome == Outcome::skipped) summary.problems.push_back(full_name(test) + ": skipped; nothing skips here");
    for (const auto& evidence : test.evidence) {
      for (const auto& id : evidence.claims) {
        if (!all.knows(id))
          summary.problems.push_back(full_name(test) + ": proves " + id + ", which the register does not have");
      }
      const std::string why = test.outcome == Outcome::passed ? why_worthless(evidence) : std::string();
      if (!why.empty()) summary.problems.push_back(full_name(test) + ": " + why);
    }
  }
  const auto unbacked = [&](const RowReport& row) {
    if (row.standing != Standing::unbacked) return;
    summary.problems.push_back(row.id + ": the register says " + std::string(name(row.verdict)) + ", but " +
                               (row.verdict == Verdict::not_testable ? "a test proves it" : "no test proves it"));
  };
  std::for_each(summary.claims.begin(), summary.claims.end(), unbacked);
  std::for_each(summary.errata.begin(), summary.errata.end(), unbacked);
}

void count(Summary& summary) {
  for (const auto& test : summary.tests) {
    if (test.outcome == Outcome::passed) ++summary.passed;
    if (test.outcome == Outcome::failed || test.outcome == Outcome::skipped) ++summary.failed;
    if (test.outcome == Outcome::not_run) ++summary.not_run;
  }
  for (const auto& row : summary.claims) {
    if (row.verdict == Verdict::open) ++summary.open;
    if (row.standing == Standing::not_testable) ++summary.not_testable;
    if (row.standing == Standing::confirmed) ++(row.verdict == Verdict::verified ? summary.verified : summary.refuted);
  }
  for (const auto& row : summary.errata) summary.proved += row.standing == Standing::confirmed;
}

}  // namespace

Summary summarize(const Register& all, std::vector<TestRun> tests, bool full) {
  Summary summary;
  summary.full = full;
  summary.tests = std::move(tests);
  for (const auto& claim : all.claims) {
    summary.claims.push_back(report_row(claim.id, claim.verdict, summary.tests, full));
    summary.claims.back().errata = claim.errata;
  }
  for (const auto& erratum : all.errata) {
    summary.errata.push_back(report_row(erratum.id, erratum.verdict, summary.tests, full));
  }
  find_problems(summary, all);
  count(summary);
  return summary;
}

std::string left_out_text(const Summary& summary) {
  return summary.left_out == 0 ? "" : "; " + std::to_string(summary.left_out) + " of commands left out (--all)";
}

std::string headline(const Summary& summary) {
  return std::to_string(summary.verified) + (summary.verified == 1 ? " claim verified, " : " claims verified, ") +
         std::to_string(summary.refuted) + " refuted with the mended form verified, " +
         std::to_string(summary.not_testable) + " not testable" +
         (summary.open == 0 ? "" : ", " + std::to_string(summary.open) + " open") + "; " +
         std::to_string(summary.proved) + (summary.proved == 1 ? " erratum proved" : " errata proved");
}

std::string stop_notice(const Summary& summary) {
  if (summary.not_run == 0) return {};
  std::string text = "STOPPED: " + std::to_string(summary.not_run) +
                     (summary.not_run == 1 ? " test was" : " tests were") + " not run, of ";
  for (std::size_t first = 0, suites = 0; first < summary.tests.size();) {
    std::size_t last = first, count = 0;
    while (last < summary.tests.size() && summary.tests[last].suite == summary.tests[first].suite) {
      count += summary.tests[last++].outcome == Outcome::not_run;
    }
    if (count > 0) text += (suites++ == 0 ? "" : ", ") + summary.tests[first].suite + " " + std::to_string(count);
    first = last;
  }
  return text + "\n";
}

std::string word(const RowReport& row) {
  switch (row.standing) {
    case Standing::confirmed:
      return std::string(name(row.verdict));
    case Standing::failed:
      return "FAILED";
    case Standing::unbacked:
      return "NOT PROVED";
    case Standing::not_run:
      return "not run";
    case Standing::partial:
      return "open, in part";
    case Standing::open:
      return "open";
    case Standing::not_testable:
      return "not testable";
  }
  return "unknown";
}

}  // namespace etendue::validation
