// SPDX-License-Identifier: Apache-2.0
#include "runner/history.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "etendue/io/atomic_file.hpp"
#include "etendue/text/utf8.hpp"
#include "runner/figures.hpp"
#include "runner/figures_curves.hpp"

namespace etendue::validation {

namespace {

using Json = nlohmann::ordered_json;

/// Throws what nlohmann throws where something is missing or of another type.
PastRun run_of(const Json& json) {
  PastRun run;
  const Json& totals = json.at("totals");
  run.date = json.at("date").get<std::string>();
  run.version = json.at("build").at("version").get<std::string>();
  run.ok = json.at("ok").get<bool>();
  run.seconds = json.at("duration_seconds").get<double>();
  run.passed = totals.at("tests_passed").get<int>();
  run.failed = totals.at("tests_failed").get<int>();
  run.verified = totals.at("claims_verified").get<int>();
  run.refuted = totals.at("claims_refuted").get<int>();
  run.open = totals.at("claims_open").get<int>();
  run.other_problems = static_cast<int>(json.at("problems").size()) + totals.at("tests_not_run").get<int>();
  for (const char* rows : {"claims", "errata"}) {
    for (const Json& row : json.at(rows))
      run.verdicts.emplace_back(row.at("id").get<std::string>(), row.at("verdict").get<std::string>());
  }
  return run;
}

std::string row_of(const PastRun& run) {
  std::string html = "<tr><th scope=\"row\">" + escaped(run.date) + "</th><td>" + escaped(run.version) +
                     "</td><td class=\"" + (run.ok ? "good\">verified" : "bad\">not verified") + "</td>";
  for (const int count : {run.passed, run.failed, run.verified, run.refuted, run.open})
    html += "<td class=\"number\">" + std::to_string(count) + "</td>";
  return html + "<td class=\"number\">" + short_number(run.seconds) + "</td></tr>\n";
}

}  // namespace

std::optional<PastRun> past_run(const std::string& json) {
  const Json report = Json::parse(json, nullptr, false);
  try {
    if (report.at("schema") != "etendue-validation-report/1") return std::nullopt;
    return run_of(report);
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

Result<std::vector<PastRun>> read_history(const std::vector<std::string>& paths) {
  std::vector<PastRun> runs;
  for (const auto& path : paths) {
    const auto text = read_file(path);
    if (!text) return text.error();
    const auto run = past_run(*text);
    if (!run)
      return Error{ErrorCode::invalid_input, quoted_path(path) + " is not a JSON report of etendue-validate (--json)"};
    runs.push_back(*run);
  }
  std::stable_sort(runs.begin(), runs.end(), [](const PastRun& a, const PastRun& b) { return a.date < b.date; });
  return runs;
}

std::vector<Change> changes_since(const PastRun& past, const std::vector<std::pair<std::string, std::string>>& now) {
  std::vector<Change> changes;
  for (const auto& [id, verdict] : now) {
    const auto then = std::find_if(past.verdicts.begin(), past.verdicts.end(),
                                   [&, &wanted = id](const auto& row) { return row.first == wanted; });
    const std::string before = then == past.verdicts.end() ? "not there" : then->second;
    if (before != verdict) changes.push_back({id, before, verdict});
  }
  return changes;
}

std::string history_html(const std::vector<PastRun>& past, const PastRun& now) {
  if (past.empty()) return "";
  std::string html =
      "<section id=\"history\" aria-labelledby=\"history-title\"><h2 id=\"history-title\">How was it "
      "before?</h2>\n<div "
      "class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Earlier runs\"><table><thead><tr>";
  for (const char* head :
       {"Run", "Version", "Outcome", "Tests passed", "Failed", "Claims verified", "Refuted", "Open", "Seconds"})
    html += std::string("<th scope=\"col\">") + head + "</th>";
  html += "</tr></thead><tbody>\n";
  for (const PastRun& run : past) html += row_of(run);
  html += row_of(now) + "</tbody></table></div>\n<h3>Verdicts that changed since the run before</h3>\n<ul>";
  const auto changes = changes_since(past.back(), now.verdicts);
  for (const Change& change : changes)
    html += "<li><a href=\"#claim-" + escaped(change.id) + "\">" + escaped(change.id) +
            "</a>: " + escaped(change.then) + ", now " + escaped(change.now) + "</li>\n";
  return html + (changes.empty() ? "<li>none</li>" : "") + "</ul></section>\n";
}

std::string history_json(const std::vector<PastRun>& past, const PastRun& now) {
  Json json = Json::object();
  json["runs"] = Json::array();
  json["changes"] = Json::array();
  for (const PastRun& run : past) {
    json["runs"].push_back({{"date", run.date},
                            {"version", run.version},
                            {"ok", run.ok},
                            {"duration_seconds", run.seconds},
                            {"tests_passed", run.passed},
                            {"tests_failed", run.failed},
                            {"claims_verified", run.verified},
                            {"claims_refuted", run.refuted},
                            {"claims_open", run.open},
                            {"other_problems", run.other_problems},
                            {"rows", run.verdicts.size()}});
  }
  if (past.empty()) return json.dump();
  for (const Change& change : changes_since(past.back(), now.verdicts))
    json["changes"].push_back({{"id", change.id}, {"then", change.then}, {"now", change.now}});
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace etendue::validation
