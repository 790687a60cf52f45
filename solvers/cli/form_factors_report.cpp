// SPDX-License-Identifier: Apache-2.0
#include "form_factors_report.hpp"

#include <algorithm>
#include <cstdio>
#include <ostream>

#include "etendue/assembly/closure.hpp"
#include "etendue/core/interval.hpp"
#include "etendue/core/version.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"
#include "memory.hpp"
#include "report_json.hpp"

namespace etendue::cli {

namespace {

std::string exact(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

const std::string& row_name(const SurfaceModel& model, std::size_t row) {
  return model.rows[row].name;
}

/// "3 'floor'": by number, as in the matrix, and by name.
std::string called(const SurfaceModel& model, std::size_t row) {
  return std::to_string(row + 1) + " '" + printable(row_name(model, row)) + "'";
}

/// One sentence on whether the surfaces close.
std::string closedness(const MatrixReport& report) {
  const RowClosure& closure = report.closure;
  const std::size_t n = report.matrix.size(), seeing = n - closure.covered.size();
  if (seeing == 0) return "nothing sees anything";
  if (!closure.above.empty()) {
    return "wrong: " + std::to_string(closure.above.size()) + " rows exceed 1 by more than their bounds, surface " +
           called(report.model, closure.above.front()) + " first: do surfaces overlap or lie inside another?";
  }
  if (closure.open.empty()) return "closed: every row sums to 1 within its bounds";
  return "open: " + std::to_string(closure.open.size()) + " of " + std::to_string(seeing) +
         " rows miss more of 1 than their bounds explain";
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kMostNames = 8;
  std::string text;
  for (std::size_t k = 0; k < names.size() && k < kMostNames; ++k)
    text += (k > 0 ? ", '" : "'") + printable(names[k]) + "'";
  if (names.size() > kMostNames) text += " and " + std::to_string(names.size() - kMostNames) + " more";
  return text;
}

/// What areas are in.
std::string unit_of(const SurfaceModel& model) {
  if (!model.metres_per_unit) return "not known: areas are in the square of the file's own (--unit says which)";
  return shortest(*model.metres_per_unit) + " m: areas are in its square";
}

/// What the bounds of a method are worth.
std::string bound_kind(const std::string& method, const SurfaceModel& model, const TileReport& what) {
  if (method == "rays") return "holds with probability 1 − 1e-6 each";
  if (method == "hemicube" || method == "tetrahedron") {
    return what.obstructed == 0
               ? "measured against exact integration"
               : "measured where nothing is in between; elsewhere only that F is at most the unobstructed "
                 "factor";
  }
  if (method == "certified") return "enclosed, rounding and all";
  if (!model.rounds.empty()) return "an estimate where round or partly obstructed, elsewhere proved";
  return what.obstructed == 0 ? "proved" : "where partly obstructed an estimate, elsewhere proved";
}

/// The two numbers that a proved bound leaves, within [0, 1].
Interval enclosure(const Bounded& factor) {
  const Interval both = Interval(factor.value) + Interval(-factor.bound, factor.bound);
  return {std::clamp(both.lower, 0.0, 1.0), std::clamp(both.upper, 0.0, 1.0)};
}

/// "12 averted, 3 clear …": what there is of each kind.
std::string listed(const TileReport& what) {
  std::string text;
  const auto add = [&text](std::uint64_t count, const char* kind) {
    if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + kind;
  };
  add(what.averted, "averted");
  add(what.clear, "clear");
  add(what.blocked, "blocked");
  add(what.obstructed, "partly obstructed");
  add(what.sampled, "sampled");
  return text.empty() ? "none" : text;
}

Json kinds(const TileReport& what) {
  return {{"averted", what.averted},
          {"clear", what.clear},
          {"blocked", what.blocked},
          {"obstructed", what.obstructed},
          {"sampled", what.sampled},
          {"checked", what.checked},
          {"disagreements", what.disagreements},
          {"beyond_tolerance", what.beyond},
          {"clamped", what.clamped}};
}

}  // namespace

std::vector<std::string> buried_remark(const SurfaceModel& model, const RowClosure& closure) {
  constexpr std::size_t kMostJudged = 256;  // each costs a look at every face in all directions
  std::vector<std::string> names;
  for (std::size_t k = 0; k < closure.covered.size() && k < kMostJudged; ++k) {
    const ComposedRow& row = model.rows[closure.covered[k]];
    const bool buried = std::all_of(row.terms.begin(), row.terms.end(), [&](const ComposedRow::Term& term) {
      return term.element < model.mesh.elements.size() && is_covered(model.mesh, model.mesh.elements[term.element]);
    });
    if (buried) names.push_back(row.name);
  }
  if (names.empty()) return {};
  return {"surfaces that see nothing, since they lie inside or under others: " + listed(names)};
}

void print_matrix_report(std::ostream& out, const MatrixReport& report) {
  const RowClosure& closure = report.closure;
  const TileReport what = report.matrix.report();
  const std::size_t n = report.matrix.size();
  out << "scene        " << printable(report.scene.string());
  if (!report.model.name.empty()) out << " '" << printable(report.model.name) << "'";
  out << "\nsurfaces     " << n;
  if (!closure.covered.empty()) out << ", " << closure.covered.size() << " of them see nothing";
  const std::size_t parts = report.model.elements();
  out << "\npairs        ";
  if (!report.model.plain()) out << "of their " << parts << " parts: ";
  out << listed(what) << "\nmethod       " << report.method;
  if (report.tolerance.relative < 1) {
    out << ", asked for " << rounded(report.tolerance.relative) << " relative or " << rounded(report.tolerance.absolute)
        << " absolute";
  }
  out << "\nclamps       ";
  if (what.clamped == 0) {
    out << "none";
  } else {
    out << what.clamped << " pairs were held at 0, at the unobstructed factor, or at min(1, A_j/A_i)";
  }
  out << '\n' << "closure      " << closedness(report) << '\n';
  if (n > closure.covered.size()) {
    out << "worst row    " << called(report.model, closure.worst) << ": sums to " << exact(closure.sums[closure.worst])
        << ", defect " << rounded(1 - closure.sums[closure.worst]) << ", of which its bounds explain "
        << rounded(closure.bounds[closure.worst]) << '\n';
  }
  out << "bound        " << rounded(closure.largest_bound) << " at most, from "
      << called(report.model, closure.loosest_from) << " to " << called(report.model, closure.loosest_to);
  out << " (" << bound_kind(report.method, report.model, what) << ")\n";
  for (const std::string& remark : report.remarks) out << "remark       " << printable(remark) << '\n';
  out << "time         " << rounded(report.seconds) << " s, "
      << rounded(static_cast<double>(report.matrix.layout().pairs()) / report.seconds) << " pairs/s\n";
  if (const auto peak = peak_memory()) {
    out << "memory       " << rounded(*peak / 1e6) << " MB at most, "
        << rounded(static_cast<double>(exchange_bytes(report.matrix.layout())) / 1e6) << " MB of it the matrix\n";
  }
  if (!report.output.empty()) out << "written      " << printable(report.output.string()) << '\n';
}

std::string matrix_report_json(const MatrixReport& report) {
  const RowClosure& closure = report.closure;
  Json json;
  json["program"] = std::string("etendue ") + version();
  json["scene"] = {{"file", report.scene.string()}, {"name", report.model.name}, {"hash", report.model.hash}};
  json["n"] = report.matrix.size();
  json["method"] = report.method;
  json["relative"] = report.tolerance.relative;
  json["absolute"] = report.tolerance.absolute;
  json["pairs"] = kinds(report.matrix.report());
  json["closed"] = closure.closed();
  json["rows_open"] = closure.open.size();
  json["rows_above_one"] = closure.above.size();
  json["rows_that_see_nothing"] = closure.covered.size();
  json["worst_row"] = closure.worst + 1;
  json["worst_row_defect"] = closure.defect;
  json["largest_bound"] = closure.largest_bound;
  json["largest_bound_at"] = {closure.loosest_from + 1, closure.loosest_to + 1};
  json["remarks"] = report.remarks;
  json["seconds"] = report.seconds;
  json["matrix_bytes"] = exchange_bytes(report.matrix.layout());
  if (const auto peak = peak_memory()) json["peak_memory_bytes"] = *peak;
  if (!report.output.empty()) json["output"] = report.output.string();
  return dumped(json) + "\n";
}

void print_pair_report(std::ostream& out, const PairReport& report) {
  const SurfaceModel& model = report.model;
  out << "from         " << called(model, report.from) << ", area " << exact(model.rows[report.from].area) << '\n'
      << "to           " << called(model, report.to) << ", area " << exact(model.rows[report.to].area) << '\n'
      << "unit         " << unit_of(model) << '\n'
      << "factor       " << exact(report.forth.value) << " ± " << rounded(report.forth.bound) << '\n'
      << "back         " << exact(report.back.value) << " ± " << rounded(report.back.bound) << '\n';
  if (!report.manners.empty()) {
    const Interval forth = enclosure(report.forth), back = enclosure(report.back);
    out << "enclosure    [" << exact(forth.lower) << ", " << exact(forth.upper) << "], back [" << exact(back.lower)
        << ", " << exact(back.upper) << "]\nfound by     ";
    for (std::size_t k = 0; k < report.manners.size(); ++k) out << (k > 0 ? ", " : "") << report.manners[k];
    out << '\n';
  }
  out << "method       " << report.method << ": ";
  const TileReport& what = report.what;
  if (what.obstructed > 0) {
    out << "partly obstructed by " << listed(report.blockers) << "; bound "
        << bound_kind(report.method, report.model, what) << '\n';
  } else if (what.clear > 0) {
    out << "nothing in between; bound " << bound_kind(report.method, report.model, what) << '\n';
  } else if (what.sampled > 0) {
    out << "rays counted; bound " << bound_kind(report.method, report.model, what) << '\n';
  } else if (what.blocked > 0) {
    out << "blocked altogether\n";
  } else {
    out << "they turn away from one another\n";
  }
  if (what.checked > 0) {
    out << "both sides   "
        << (what.disagreements == 0 ? "agree within their bounds" : "differ by more than their bounds")
        << ", difference " << rounded(what.defect) << " of the larger area's exchange\n";
  }
  out << "clamps       "
      << (what.clamped > 0 ? "the value was held at 0, at the unobstructed factor, or at min(1, A_j/A_i)\n" : "none\n");
}

std::string pair_report_json(const PairReport& report) {
  Json json;
  if (report.model.metres_per_unit) json["metres_per_unit"] = *report.model.metres_per_unit;
  json["from"] = {{"number", report.from + 1},
                  {"name", row_name(report.model, report.from)},
                  {"area", report.model.rows[report.from].area}};
  json["to"] = {{"number", report.to + 1},
                {"name", row_name(report.model, report.to)},
                {"area", report.model.rows[report.to].area}};
  json["factor"] = report.forth.value;
  json["bound"] = report.forth.bound;
  json["back"] = report.back.value;
  json["back_bound"] = report.back.bound;
  json["method"] = report.method;
  if (!report.manners.empty()) {
    const Interval forth = enclosure(report.forth), back = enclosure(report.back);
    json["enclosure"] = {forth.lower, forth.upper};
    json["back_enclosure"] = {back.lower, back.upper};
    json["found_by"] = report.manners;
  }
  json["pairs"] = kinds(report.what);
  json["blockers"] = report.blockers;
  json["tolerance_reached"] = report.reached;
  return dumped(json) + "\n";
}

}  // namespace etendue::cli
