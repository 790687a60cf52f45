// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "runner/figures.hpp"
#include "runner/report.hpp"

// The page as it reads without a script; validation/report/*.js add the plot, the filter and the check of the data.
namespace etendue::validation {

namespace {

using Json = nlohmann::ordered_json;

/// Rows of the table of the closest calls, which stands in for the plot where there is no script.
constexpr std::size_t kClosest = 20;

std::string text_of(const Json& value) {
  return value.is_string() ? escaped(value.get<std::string>()) : std::string();
}

std::string share_of(const Json& proof) {
  return proof["worst_share"].is_number() ? share_text(proof["worst_share"].get<double>()) : "not a number";
}

void append_fact(std::string& page, const std::string& name, const std::string& html) {
  page += "<dt>" + name + "</dt><dd>" + html + "</dd>\n";
}

std::string seeds_of(const Json& report) {
  std::vector<std::uint64_t> seeds;
  for (const auto& test : report["tests"]) {
    for (const auto& evidence : test["evidence"]) {
      for (const auto& seed : evidence["seeds"]) seeds.push_back(seed.get<std::uint64_t>());
    }
  }
  std::sort(seeds.begin(), seeds.end());
  seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
  std::string text;
  for (const auto seed : seeds) text += (text.empty() ? "" : ", ") + std::to_string(seed);
  return text.empty() ? "none drawn" : text;
}

void append_verdict(std::string& page, const Json& report, const Summary& summary, const std::string& link) {
  const bool ok = report["ok"].get<bool>();
  page += "<header><h1>etendue " + text_of(report["build"]["version"]) +
          ": every claim against its oracle</h1>\n<p id=\"verdict\" role=\"status\">";
  page += (ok ? (summary.full ? "Verified: " : "Verified, of the tests chosen: ") : std::string("NOT VERIFIED: "));
  if (summary.failed > 0) page += std::to_string(summary.failed) + " of the tests failed. ";
  if (!summary.problems.empty()) page += std::to_string(summary.problems.size()) + " problems. ";
  if (summary.not_run > 0) page += std::to_string(summary.not_run) + " tests were not run. ";
  page += std::to_string(summary.passed) + " tests passed" + left_out_text(summary) + "; " + headline(summary) +
          ".</p>\n<dl>\n";
  const auto& build = report["build"];
  append_fact(page, "Build",
              text_of(build["compiler"]) + ", " + text_of(build["build_type"]) +
                  ", -ffp-contract=" + text_of(build["fp_contract"]));
  std::array<char, 32> seconds{};
  std::snprintf(seconds.data(), seconds.size(), "%.1f s", report["duration_seconds"].get<double>());
  append_fact(page, "Run", text_of(report["date"]) + ", " + seconds.data());
  append_fact(page, "Seeds", "<details><summary>of the random families</summary>" + seeds_of(report) + "</details>");
  append_fact(page, "Reproduce with", "<code>" + text_of(report["command"]) + "</code>");
  page +=
      "</dl>\n<nav aria-label=\"Sections\"><ul><li><a href=\"#margins\">Margins</a></li><li><a "
      "href=\"#claims\">Claims</a></li>" +
      figures_links(collected_exhibits()) + link +
      "<li><a href=\"#environment\">Environment</a></li></ul></nav></header>\n<main>\n";
}

/// From the JSON, where bytes that are not UTF-8 have been replaced.
void append_failures(std::string& page, const Json& report) {
  if (report["ok"].get<bool>()) return;
  page += "<section aria-labelledby=\"failures-title\"><h2 id=\"failures-title\">What failed</h2>\n";
  for (const auto& problem : report["problems"]) page += "<pre class=\"bad\">" + text_of(problem) + "</pre>\n";
  for (const auto& test : report["tests"]) {
    for (const auto& failure : test["failures"])
      page += "<pre><b>" + text_of(test["test"]) + "</b>\n" + text_of(failure) + "</pre>\n";
  }
  page += "</section>\n";
}

struct Check {
  const Json* test;
  const Json* evidence;
  double share;
};

void append_margins(std::string& page, const Json& report) {
  std::vector<Check> checks;
  std::size_t exact = 0;
  for (const auto& test : report["tests"]) {
    for (const auto& evidence : test["evidence"]) {
      if (!evidence["worst_share"].is_number() || evidence["claims"].empty()) continue;
      const double share = evidence["worst_share"].get<double>();
      if (share > 0)
        checks.push_back({&test, &evidence, share});
      else
        ++exact;
    }
  }
  std::stable_sort(checks.begin(), checks.end(), [](const Check& a, const Check& b) { return a.share > b.share; });
  page +=
      "<section id=\"margins\" aria-labelledby=\"margins-title\"><h2 id=\"margins-title\">How close was it?</h2>\n"
      "<p class=\"note\">The worst error of each check as a share of its tolerance; above 1 it fails. " +
      std::to_string(exact) + " more checks held exactly.</p>\n";
  const std::size_t rows = std::min(kClosest, checks.size());
  page +=
      "<details><summary>The closest " + std::to_string(rows) +
      " in a table</summary><div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Closest checks\"><table>"
      "<thead><tr><th scope=\"col\">Test</th><th scope=\"col\">Error/tolerance</th><th "
      "scope=\"col\">Proves</th></tr></thead>"
      "<tbody>\n";
  for (std::size_t i = 0; i < rows; ++i) {
    page += "<tr><td>" + text_of((*checks[i].test)["test"]) + "</td><td class=\"number\">" +
            share_text(checks[i].share) + "</td><td>";
    for (const auto& id : (*checks[i].evidence)["claims"])
      page += "<a href=\"#claim-" + text_of(id) + "\">" + text_of(id) + "</a> ";
    page += "</td></tr>\n";
  }
  page += "</tbody></table></div></details></section>\n";
}

/// What a row was held against, oracle by oracle; in the details what each test states of its tolerance, and how to run it.
void append_proofs(std::string& page, const Json& row, const Json& stated) {
  page += "<td>";
  for (const auto& proof : row["proofs"]) {
    page += "<p><b>" + text_of(proof["oracle_kind"]) + "</b>: " + text_of(proof["oracle"]) + "<br>error/tolerance " +
            share_of(proof) + " in " + std::to_string(proof["comparisons"].get<std::uint64_t>()) + " comparisons</p>";
  }
  if (!row["proofs"].empty()) page += "<details><summary>Tests and where their tolerances come from</summary>";
  for (const auto& proof : row["proofs"]) {
    for (const auto& test : proof["tests"]) {
      const auto name = test.get<std::string>();
      page += "<p><code>etendue-validate --filter " + escaped(name) + "</code>";
      const auto known = stated.find(name);
      if (known != stated.end()) {
        page += "<br>" + text_of(known->value("claim", Json())) + "<br><i>Tolerance:</i> " +
                text_of(known->value("tolerance", Json())) + "<br><code>" + text_of(known->value("place", Json())) +
                "</code>";
      }
      page += figures_of(name, collected_exhibits()) + "</p>";
    }
  }
  if (!row["proofs"].empty()) page += "</details>";
  page += "</td>";
}

/// How near a row came to failing: the worst share of its proofs, as the table is sorted by.
std::string worst_of(const Json& row) {
  double worst = -1;
  for (const auto& proof : row["proofs"]) {
    if (!proof["worst_share"].is_number()) return "not a number";
    worst = std::max(worst, proof["worst_share"].get<double>());
  }
  return worst < 0 ? "" : share_text(worst);
}

void append_row(std::string& page, const Json& row, const std::string& what, const Json& known) {
  const std::string id = text_of(row["id"]), verdict = text_of(row["verdict"]);
  const char* mood = verdict == "FAILED" || verdict == "NOT PROVED"                         ? "bad"
                     : verdict == "verified" || verdict == "refuted" || verdict == "proved" ? "good"
                                                                                            : "note";
  page += "<tr id=\"claim-" + id + "\" data-verdict=\"" + verdict + "\"><th scope=\"row\"><a href=\"#claim-" + id +
          "\">" + id + "</a></th><td>" + what;
  const auto formula = known["formulas"].find(row["id"].get<std::string>());
  if (formula != known["formulas"].end()) page += "<p>" + formula->get<std::string>() + "</p>";
  page += "</td><td class=\"" + std::string(mood) + "\">" + verdict;
  if (row.contains("errata")) {
    for (const auto& e : row["errata"]) page += " <a href=\"#claim-" + text_of(e) + "\">" + text_of(e) + "</a>";
  }
  const std::string worst = worst_of(row);
  page += "</td><td class=\"number\" data-key=\"" +
          (worst == "exact" ? "0"
           : worst.empty()  ? "-1"
                            : worst) +
          "\">" + worst + "</td>";
  append_proofs(page, row, known["tests"]);
  page += "</tr>\n";
}

void append_claims(std::string& page, const Json& report, const Register& all, const Json& known) {
  page +=
      "<section id=\"claims\" aria-labelledby=\"claims-title\"><h2 id=\"claims-title\">What is claimed, and does it "
      "hold?</h2>\n"
      "<p class=\"note\">A claim that is refuted as printed names the errata whose mended form was verified.</p>\n"
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Claims and errata\"><table "
      "id=\"claims-table\" "
      "class=\"wide\"><thead><tr><th scope=\"col\">Id</th><th scope=\"col\">Statement</th><th "
      "scope=\"col\">Verdict</th>"
      "<th scope=\"col\">Error/tolerance</th><th scope=\"col\">Held against</th></tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < all.claims.size(); ++i) {
    const std::string why =
        all.claims[i].reason.empty() ? "" : "<p>Not testable: " + escaped(all.claims[i].reason) + "</p>";
    append_row(page, report["claims"][i], "<p>" + escaped(all.claims[i].statement) + "</p>" + why, known);
  }
  for (std::size_t i = 0; i < all.errata.size(); ++i) {
    const auto& erratum = all.errata[i];
    append_row(page, report["errata"][i],
               "<p>Printed: " + escaped(erratum.printed) + "</p><p>Right: " + escaped(erratum.right) + "</p>", known);
  }
  page += "</tbody></table></div></section>\n";
}

void append_environment(std::string& page) {
  page +=
      "<section id=\"environment\" aria-labelledby=\"environment-title\"><h2 id=\"environment-title\">Made "
      "with</h2>\n<dl>\n";
  for (const auto& [name, text] : environment()) append_fact(page, escaped(name), escaped(text));
  page += "</dl></section>\n</main>\n";
}

/// FNV-1a, 32 bits: the script finds by it what was altered after the run.
std::string digest(std::string_view text) {
  std::uint32_t hash = 0x811c9dc5U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x01000193U;
  std::array<char, 16> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%08x", static_cast<unsigned>(hash));
  return buffer.data();
}

/// In a script element nothing may look like a tag; in JSON a "<" stands inside of strings only.
std::string without_tags(const std::string& json) {
  std::string safe;
  for (const char c : json) c == '<' ? safe += "\\u003c" : safe += c;
  return safe;
}

void put(std::string& page, const std::string& key, const std::string& value) {
  const std::string mark = "{{" + key + "}}";
  const std::size_t at = page.find(mark);
  if (at != std::string::npos) page.replace(at, mark.size(), value);
}

}  // namespace

std::string html_report(const Summary& summary, const Register& all, const BuildInfo& build,
                        const std::vector<PastRun>& past) {
  const std::string plain = json_report(summary, all, build);
  Json report = Json::parse(plain);
  const Json known = Json::parse(embedded_statements());
  for (auto& test : report["tests"]) {
    const auto stated = known["tests"].find(test["test"].get<std::string>());
    if (stated != known["tests"].end()) test["stated"] = *stated;
  }
  std::string body;
  append_verdict(body, report, summary, past.empty() ? "" : "<li><a href=\"#history\">History</a></li>");
  append_failures(body, report);
  append_margins(body, report);
  append_claims(body, report, all, known);
  body += figures_html(collected_exhibits());
  const PastRun now = past_run(plain).value_or(PastRun{});
  body += history_html(past, now);
  append_environment(body);
  report["history"] = Json::parse(history_json(past, now));
  report["figures"] = Json::parse(figures_json(collected_exhibits()));
  const std::string data = without_tags(report.dump());
  std::string page(embedded_page());
  // The data last: nothing in them is taken for a mark.
  put(page, "VERDICT", report["ok"].get<bool>() ? "good" : "bad");
  put(page, "TITLE", report["ok"].get<bool>() ? "etendue: verified" : "etendue: NOT VERIFIED");
  put(page, "DIGEST", digest(data));
  put(page, "DATA", data);
  put(page, "BODY", body);
  return page;
}

}  // namespace etendue::validation
