// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "runner/report.hpp"

namespace etendue::validation {

namespace {

constexpr std::size_t kLineWidth = 100;
constexpr std::array<std::size_t, 4> kColumns = {10, 20, 24, 0};

void append_line(std::string& text, const std::array<std::string, 4>& cells) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    text += cells[i];
    if (i + 1 < cells.size()) text.append(std::max(kColumns[i], cells[i].size() + 1) - cells[i].size(), ' ');
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  text += '\n';
}

std::string verdict_text(const RowReport& row) {
  std::string text = word(row);
  if (row.errata.empty() || row.verdict != Verdict::refuted) return text;
  text += " as printed:";
  for (const auto& erratum : row.errata) text += " " + erratum;
  return text;
}

void append_row(std::string& text, const RowReport& row) {
  if (row.standing == Standing::open || row.standing == Standing::not_run || row.standing == Standing::not_testable)
    return;
  if (row.proofs.empty()) append_line(text, {row.id, "-", "-", verdict_text(row)});
  for (std::size_t i = 0; i < row.proofs.size(); ++i) {
    const Proof& proof = row.proofs[i];
    append_line(text,
                {i == 0 ? row.id : "", proof.kind, share_text(proof.worst_share), i == 0 ? verdict_text(row) : ""});
  }
}

/// A list of the rows of which the run has no more to say.
void append_list(std::string& text, const std::string& title, Standing standing, const std::vector<RowReport>& rows) {
  std::string line = title + ":";
  bool any = false;
  for (const auto& row : rows) {
    if (row.standing != standing) continue;
    any = true;
    if (line.size() + 1 + row.id.size() > kLineWidth) {
      text += line + "\n";
      line = " ";
    }
    line += " " + row.id;
  }
  if (any) text += line + "\n";
}

/// How many rows of the register this run did not look at: their names would hide the few that it did.
void append_not_run(std::string& text, const Summary& summary) {
  const auto count = [](const std::vector<RowReport>& rows) {
    return std::count_if(rows.begin(), rows.end(), [](const RowReport& r) { return r.standing == Standing::not_run; });
  };
  const auto claims = count(summary.claims), errata = count(summary.errata);
  if (claims + errata == 0) return;
  text += "not run: the tests of " + std::to_string(claims) + (claims == 1 ? " claim" : " claims") + " and " +
          std::to_string(errata) + (errata == 1 ? " erratum" : " errata") + " that have a verdict\n";
}

}  // namespace

std::string share_text(double share) {
  if (std::isnan(share)) return "not a number";
  if (share == 0) return "exact";
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), share >= 0.001 ? "%.3f" : "%.1e", share);
  return buffer.data();
}

std::string text_report(const Summary& summary, const BuildInfo& build) {
  std::string text = "etendue " + build.version + ", " + build.compiler + ", " + build.build_type +
                     ", -ffp-contract=" + build.contraction + "\n\n";
  append_line(text, {"claim", "oracle", "worst error/tolerance", "verdict"});
  for (const auto& row : summary.claims) append_row(text, row);
  text += "\n";
  append_line(text, {"erratum", "oracle", "worst error/tolerance", "verdict"});
  for (const auto& row : summary.errata) append_row(text, row);
  text += "\n";
  append_not_run(text, summary);
  if (summary.full) {
    append_list(text, "not testable", Standing::not_testable, summary.claims);
    append_list(text, "open claims", Standing::open, summary.claims);
    append_list(text, "open errata", Standing::open, summary.errata);
  }
  for (const auto& test : summary.tests) {
    for (const auto& failure : test.failures) text += "FAILED " + test.suite + "." + test.name + "\n" + failure + "\n";
  }
  for (const auto& problem : summary.problems) text += "PROBLEM " + problem + "\n";
  text += stop_notice(summary);
  text += std::to_string(summary.passed) + (summary.passed == 1 ? " test passed, " : " tests passed, ") +
          std::to_string(summary.failed) + " failed" + left_out_text(summary) + "\n";
  text += headline(summary) + "\n";
  return text;
}

}  // namespace etendue::validation
