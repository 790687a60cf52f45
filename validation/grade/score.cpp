// SPDX-License-Identifier: Apache-2.0
#include "grade/score.hpp"

#include <algorithm>
#include <iomanip>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "etendue/core/version.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue::validation {

namespace {

using Json = nlohmann::ordered_json;

void count(Tally& tally, const GradeCase& asked, const CaseVerdict& verdict) {
  ++tally.cases;
  tally.passed += verdict.mark == Mark::passed;
  tally.failed += verdict.mark == Mark::failed;
  tally.unsupported += verdict.mark == Mark::unsupported;
  tally.not_run += verdict.mark == Mark::not_run;
  if (verdict.share.value_or(0) > tally.worst) {
    tally.worst = *verdict.share;
    tally.worst_case = asked.id;
  }
}

std::string row(const Tally& tally) {
  std::ostringstream text;
  text << std::left << std::setw(15) << printable(tally.subject) << std::right;
  for (const std::size_t number : {tally.cases, tally.passed, tally.failed, tally.unsupported})
    text << std::setw(13) << number;
  text << "   " << std::left << std::setw(10) << rounded(tally.worst, 3) << " " << printable(tally.worst_case);
  std::string line = text.str();
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

/// What is not supported: each reason once, with how many cases it is given for.
std::string unsupported(const Score& score) {
  std::map<std::string, std::size_t> reasons;
  for (const auto& verdict : score.verdicts) {
    if (verdict.mark == Mark::unsupported) ++reasons[verdict.reason];
  }
  std::string text;
  for (const auto& [reason, cases] : reasons) text += "unsupported, " + counted(cases, "case") + ": " + reason + "\n";
  return text;
}

Json from(const Tally& tally) {
  Json json;
  if (!tally.subject.empty()) json["subject"] = tally.subject;
  json["cases"] = tally.cases;
  json["passed"] = tally.passed;
  json["failed"] = tally.failed;
  json["unsupported"] = tally.unsupported;
  json["not_run"] = tally.not_run;
  json["worst_error_in_tolerances"] = tally.worst;
  json["worst_case"] = tally.worst_case.empty() ? Json(nullptr) : Json(tally.worst_case);
  return json;
}

Json from(const GradeCase& asked, const CaseVerdict& verdict) {
  Json json;
  json["id"] = asked.id;
  json["subject"] = asked.subject;
  json["title"] = asked.title;
  json["mark"] = name(verdict.mark);
  json["error_in_tolerances"] = verdict.share ? Json(*verdict.share) : Json(nullptr);
  json["answer"] = verdict.answer.empty() ? Json(nullptr) : Json::parse(verdict.answer, nullptr, false);
  json["tolerance"] = asked.tolerance;
  json["reason"] = verdict.reason;
  json["seconds"] = verdict.seconds;
  return json;
}

}  // namespace

std::vector<Tally> Score::by_subject() const {
  std::vector<Tally> rows;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    auto at = std::find_if(rows.begin(), rows.end(), [&](const Tally& t) { return t.subject == cases[i].subject; });
    if (at == rows.end()) {
      rows.push_back({});
      rows.back().subject = cases[i].subject;
      at = std::prev(rows.end());
    }
    count(*at, cases[i], verdicts[i]);
  }
  return rows;
}

Tally Score::total() const {
  Tally all;
  for (std::size_t i = 0; i < cases.size(); ++i) count(all, cases[i], verdicts[i]);
  return all;
}

bool Score::good() const {
  const Tally all = total();
  return all.failed == 0 && all.passed > 0;
}

std::string text_score(const Score& score) {
  std::string text = "subject                cases       passed       failed  unsupported   worst error/tolerance\n";
  for (const auto& tally : score.by_subject()) text += row(tally);
  text += "\n";
  for (std::size_t i = 0; i < score.cases.size(); ++i) {
    if (score.verdicts[i].mark != Mark::failed) continue;
    text += "FAILED " + printable(score.cases[i].id) + ": " + score.verdicts[i].reason + "\n";
  }
  text += unsupported(score);
  const Tally all = score.total();
  text += counted(all.cases, "case") + ": " + std::to_string(all.passed) + " passed, " + std::to_string(all.failed) +
          " failed, " + std::to_string(all.unsupported) + " unsupported";
  if (all.not_run > 0) text += ", " + std::to_string(all.not_run) + " not run";
  return text + "\n";
}

std::string json_score(const Score& score) {
  Json json;
  json["format"] = "etendue-score";
  json["version"] = 1;
  json["graded_by"] = std::string("etendue-validate ") + version();
  json["command"] = score.command;
  json["total"] = from(score.total());
  json["subjects"] = Json::array();
  for (const auto& tally : score.by_subject()) json["subjects"].push_back(from(tally));
  json["cases"] = Json::array();
  for (std::size_t i = 0; i < score.cases.size(); ++i) json["cases"].push_back(from(score.cases[i], score.verdicts[i]));
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace etendue::validation
