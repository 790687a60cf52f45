// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <nlohmann/json.hpp>

#include "runner/report.hpp"

namespace etendue::validation {

namespace {

using Json = nlohmann::ordered_json;

/// JSON has no NaN: null stands for "not a number".
Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json from(const Evidence& evidence) {
  Json json;
  json["claims"] = evidence.claims;
  json["oracle_kind"] = evidence.kind;
  json["oracle"] = evidence.oracle;
  json["worst_share"] = number(evidence.worst_share);
  json["comparisons"] = evidence.comparisons;
  json["seeds"] = evidence.seeds;
  return json;
}

const char* word(Outcome outcome) {
  switch (outcome) {
    case Outcome::passed:
      return "passed";
    case Outcome::failed:
      return "failed";
    case Outcome::skipped:
      return "skipped";
    case Outcome::not_run:
      return "not run";
  }
  return "unknown";
}

Json from(const TestRun& test) {
  Json json;
  json["test"] = test.suite + "." + test.name;
  json["outcome"] = word(test.outcome);
  json["failures"] = test.failures;
  json["duration_seconds"] = number(test.seconds);
  json["evidence"] = Json::array();
  for (const auto& evidence : test.evidence) json["evidence"].push_back(from(evidence));
  return json;
}

Json from(const RowReport& row) {
  Json json;
  json["register"] = name(row.verdict);
  json["verdict"] = word(row);
  json["proofs"] = Json::array();
  for (const auto& proof : row.proofs) {
    Json entry;
    entry["oracle_kind"] = proof.kind;
    entry["oracle"] = proof.oracle;
    entry["worst_share"] = number(proof.worst_share);
    entry["comparisons"] = proof.comparisons;
    entry["tests"] = proof.tests;
    json["proofs"].push_back(entry);
  }
  return json;
}

Json from(const BuildInfo& build) {
  Json json;
  json["version"] = build.version;
  json["compiler"] = build.compiler;
  json["build_type"] = build.build_type;
  json["fp_contract"] = build.contraction;
  return json;
}

Json totals(const Summary& summary) {
  Json json;
  json["tests_passed"] = summary.passed;
  json["tests_failed"] = summary.failed;
  json["tests_not_run"] = summary.not_run;
  json["claims_verified"] = summary.verified;
  json["claims_refuted"] = summary.refuted;
  json["claims_open"] = summary.open;
  json["claims_not_testable"] = summary.not_testable;
  json["errata_proved"] = summary.proved;
  return json;
}

}  // namespace

std::string json_report(const Summary& summary, const Register& all, const BuildInfo& build) {
  Json json;
  json["schema"] = "etendue-validation-report/1";
  json["build"] = from(build);
  json["command"] = build.command;
  json["date"] = build.date;
  json["duration_seconds"] = number(build.seconds);
  json["full_run"] = summary.full;
  json["stopped"] = summary.not_run > 0;
  json["ok"] = summary.ok() && summary.not_run == 0;
  json["totals"] = totals(summary);
  json["problems"] = summary.problems;
  json["claims"] = Json::array();
  for (std::size_t i = 0; i < summary.claims.size(); ++i) {
    Json row;
    row["id"] = all.claims[i].id;
    row["source"] = all.claims[i].source;
    row["statement"] = all.claims[i].statement;
    row["errata"] = all.claims[i].errata;
    if (!all.claims[i].reason.empty()) row["reason"] = all.claims[i].reason;
    row.update(from(summary.claims[i]));
    json["claims"].push_back(row);
  }
  json["errata"] = Json::array();
  for (std::size_t i = 0; i < summary.errata.size(); ++i) {
    Json row;
    row["id"] = all.errata[i].id;
    row["source"] = all.errata[i].source;
    row.update(from(summary.errata[i]));
    json["errata"].push_back(row);
  }
  json["tests"] = Json::array();
  for (const auto& test : summary.tests) json["tests"].push_back(from(test));
  // Failure messages may hold bytes that are not UTF-8: replaced, never thrown over.
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace etendue::validation
