// SPDX-License-Identifier: Apache-2.0
#include "solve_factors_report.hpp"

#include <algorithm>
#include <charconv>
#include <ostream>

#include "etendue/core/version.hpp"
#include "etendue/text/number_text.hpp"
#include "report_json.hpp"

namespace etendue::cli {

namespace {

/// As printf's "%.17g", whatever the locale.
void append(std::string& text, double value) {
  char digits[40];
  const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 17).ptr;
  text.append(digits, end);
}

double widest(const RadiosityEnclosure& around, Eigen::Index c) {
  double width = 0;
  for (Eigen::Index i = 0; i < around.lower.rows(); ++i)
    width = std::max(width, around.upper(i, c) - around.lower(i, c));
  return width;
}

}  // namespace

std::string result_csv(const FactorsSolution& solution) {
  const Eigen::MatrixXd& b = solution.report.radiosity;
  std::string text = "index";
  for (Eigen::Index c = 0; c < b.cols(); ++c) text += ",radiosity_" + std::to_string(c + 1);
  for (Eigen::Index c = 0; c < b.cols(); ++c) {
    text += ",lower_" + std::to_string(c + 1) + ",upper_" + std::to_string(c + 1);
  }
  text += '\n';
  for (Eigen::Index i = 0; i < b.rows(); ++i) {
    text += std::to_string(i);
    for (Eigen::Index c = 0; c < b.cols(); ++c) append(text += ',', b(i, c));
    for (Eigen::Index c = 0; c < b.cols(); ++c) {
      append(text += ',', solution.around.lower(i, c));
      append(text += ',', solution.around.upper(i, c));
    }
    text += '\n';
  }
  return text;
}

std::string missed_text(const RadiosityReport& report, double tolerance) {
  Eigen::Index worst = 0;
  const auto relative = [&](Eigen::Index c) { return report.bound(c) / report.radiosity.col(c).cwiseAbs().maxCoeff(); };
  for (Eigen::Index c = 1; c < report.bound.size(); ++c) {
    if (!(relative(c) <= relative(worst))) worst = c;
  }
  return std::string("tolerance not reached (") + words(report.status) + "): the proved bound is " +
         rounded(relative(worst)) + " of the largest radiosity of channel " + std::to_string(worst + 1) +
         ", asked was " + rounded(tolerance) + "; the result is written with the bound that was reached";
}

void print_factors_summary(std::ostream& out, const FactorsSolution& solution,
                           const std::optional<RepairedFactors>& repaired) {
  const RadiosityReport& report = solution.report;
  out << "system       " << report.radiosity.rows() << (report.radiosity.rows() == 1 ? " patch, " : " patches, ")
      << counted(static_cast<std::size_t>(report.radiosity.cols()), "channel") << '\n';
  if (repaired) {
    out << "repaired     " << repaired->report.changed << " pairs changed, by "
        << rounded(repaired->report.largest_change) << " at most; rows were off by "
        << rounded(repaired->report.defect_before) << " and are by " << rounded(repaired->report.defect_after)
        << ", reciprocity by " << rounded(repaired->reciprocity_defect) << '\n';
  }
  if (report.dark) out << "dark         nothing emits: every radiosity is 0\n";
  out << "solver       " << solution.solver << ": " << words(report.status);
  if (report.steps > 0) out << ", " << report.steps << " steps";
  out << ", " << report.passes << " products with F\n";
  for (Eigen::Index c = 0; c < report.bound.size(); ++c) {
    out << "channel " << c + 1 << "    residual " << rounded(report.residual(c)) << ", proved bound "
        << rounded(report.bound(c)) << " W/m²";
    if (solution.certified) out << ", widest interval " << rounded(widest(solution.around, c));
    if (!solution.balances.empty()) {
      const PowerBalance& power = solution.balances[static_cast<std::size_t>(c)];
      out << "; " << rounded(power.emitted) << " W emitted, " << rounded(power.absorbed) << " absorbed, "
          << rounded(power.escaped) << " escaped";
    }
    out << '\n';
  }
}

std::string factors_summary_json(const FactorsSolution& solution, const std::optional<RepairedFactors>& repaired) {
  const RadiosityReport& report = solution.report;
  Json json{{"program", std::string("etendue ") + version()},
            {"solver", solution.solver},
            {"status", words(report.status)},
            {"patches", report.radiosity.rows()},
            {"steps", report.steps},
            {"products", report.passes},
            {"dark", report.dark},
            {"certified", solution.certified}};
  if (solution.not_certified) json["not_certified"] = solution.not_certified->message;
  if (repaired) {
    json["repaired"] = {{"pairs_changed", repaired->report.changed},
                        {"largest_change", repaired->report.largest_change},
                        {"defect_before", repaired->report.defect_before},
                        {"defect_after", repaired->report.defect_after},
                        {"reciprocity_defect_before", repaired->reciprocity_defect}};
  }
  json["channels"] = Json::array();
  for (Eigen::Index c = 0; c < report.bound.size(); ++c) {
    Json channel{{"residual", report.residual(c)},
                 {"bound", report.bound(c)},
                 {"backward_error", report.backward_error(c)},
                 {"widest_interval", widest(solution.around, c)}};
    if (!solution.balances.empty()) {
      const PowerBalance& power = solution.balances[static_cast<std::size_t>(c)];
      channel["emitted_watts"] = power.emitted;
      channel["absorbed_watts"] = power.absorbed;
      channel["escaped_watts"] = power.escaped;
      channel["balance_defect_watts"] = power.defect;
    }
    json["channels"].push_back(channel);
  }
  return dumped(json) + "\n";
}

}  // namespace etendue::cli
