// SPDX-License-Identifier: Apache-2.0
#include "solve_report.hpp"

#include <algorithm>
#include <ostream>

#include "etendue/core/version.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"
#include "outputs.hpp"
#include "report_json.hpp"

namespace etendue::cli {

namespace {

std::size_t rows_done(const SolveReport& report) {
  return static_cast<std::size_t>(std::count(report.matrix.row_done.begin(), report.matrix.row_done.end(), true));
}

const std::string& object_name(const SolveReport& report, std::size_t element) {
  return report.file.scene.objects[report.mesh.face_of(report.mesh.elements[element]).object].name;
}

/// Objects of a pair of elements, as messages name them.
std::string between(const SolveReport& report, std::size_t first, std::size_t second) {
  return "elements " + std::to_string(first) + " (" + printable(object_name(report, first)) + ") and " +
         std::to_string(second) + " (" + printable(object_name(report, second)) + ")";
}

/// What the elements see, in a word.
const char* state(const ClosureReport& closure) {
  if (closure.judged == 0) return "none to judge";
  if (closure.exceeded > 0) return "exceeded";
  if (closure.open > 0 || closure.facing_void > 0) return "open";
  return closure.unknown > 0 ? "unknown" : "closed";
}

Json closure_json(const ClosureReport& closure) {
  Json json{{"state", state(closure)},
            {"elements_closed", closure.closed},
            {"elements_open", closure.open},
            {"elements_exceeded", closure.exceeded},
            {"elements_facing_void", closure.facing_void},
            {"elements_unknown", closure.unknown},
            {"covered_elements", closure.covered}};
  json["defect"] = closure.judged > 0 ? Json(closure.defect) : Json(nullptr);
  json["worst_element"] = closure.judged > 0 ? Json(closure.worst) : Json(nullptr);
  json["largest_row_bound"] = closure.largest_row_bound;
  json["total_bound"] = closure.total_bound;
  return json;
}

Json missed_json(const MissedTolerance& missed) {
  Json json{{"pairs", missed.pairs}};
  if (missed.pairs > 0) {
    json["worst_elements"] = {missed.first, missed.second};
    json["bound"] = missed.bound;
    json["asked"] = missed.allowed;
  }
  return json;
}

const char* status(const SolveReport& report) {
  if (!is_solved(report)) return "stopped";
  const bool wide = report.certified && report.certified->wide > 0;
  return wide || report.matrix.missed.pairs > 0 ? "tolerance missed" : "solved";
}

Json channel_summary(const ChannelRadiosity& channel) {
  return {{"residual", channel.solution.residual},
          {"bound", channel.solution.bound},
          {"bound_with_form_factors", finite_or_null(channel.bound_with_factors)},
          {"backward_error", channel.solution.backward_error},
          {"emitted_watts", channel.balance.emitted},
          {"absorbed_watts", channel.balance.absorbed},
          {"escaped_watts", channel.balance.escaped},
          {"balance_defect_watts", channel.balance.defect}};
}

Json certified_json(const SolveReport& report) {
  const CertifiedFactors& factors = *report.certified;
  Json json{{"status", report.enclosure ? "enclosed" : factors.complete ? "not enclosed" : "stopped"}};
  if (!report.not_certified.empty()) json["reason"] = report.not_certified;
  if (!factors.complete) return json;
  json["pairs"] = {{"averted", factors.pairs.averted},
                   {"clear", factors.pairs.clear},
                   {"obstructed", factors.pairs.obstructed},
                   {"wider_than_asked", factors.wide}};
  json["asked"] = {{"free", kCertifiedFree}, {"obstructed", report.certify_tolerance}};
  json["widest_form_factor"] = {{"width", factors.widest}, {"elements", {factors.from, factors.to}}};
  for (std::size_t c = 0; report.enclosure && c < 3; ++c) {
    json["channels"][kChannels[c]] = {{"widest_interval", report.enclosure->widest[c]},
                                      {"element", report.enclosure->worst[c]}};
  }
  return json;
}

void print_certified(std::ostream& out, const SolveReport& report) {
  if (!report.certified) return;
  const CertifiedFactors& factors = *report.certified;
  if (!report.enclosure) {
    out << "certified    no: " << report.not_certified << '\n';
    return;
  }
  out << "certified    " << factors.pairs.clear << " clear, " << factors.pairs.obstructed << " obstructed, "
      << factors.pairs.averted << " averted pairs enclosed, " << factors.wide
      << " of them wider than asked; the widest form factor is known to " << rounded(factors.widest) << '\n'
      << "intervals    hold the exact radiosities; widest ";
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t worst = report.enclosure->worst[c];
    out << (c > 0 ? ", " : "") << rounded(report.enclosure->widest[c]) << " (" << kChannels[c] << ", element " << worst
        << ", " << printable(object_name(report, worst)) << ')';
  }
  out << " W/m²\n";
}

/// What the scene and the settings determine: nothing that differs between two runs.
Json summary(const SolveReport& report, bool all_sensors) {
  const FormFactorMatrix& matrix = report.matrix;
  Json json;
  json["program"] = std::string("etendue ") + version();
  json["method"] = "radiosity, full matrix";
  json["status"] = status(report);
  json["scene"] = scene_json(report.file);
  json["camera"] = view_json(report.file.scene);
  json["settings"] = {{"solver", report.solver},
                      {"tolerance_free", report.tolerance.free.relative},
                      {"tolerance_obstructed", report.tolerance.obstructed.relative}};
  json["mesh"] = {
      {"faces", report.mesh.faces.size()}, {"patches", report.mesh.patches}, {"elements", report.mesh.elements.size()}};
  if (report.element_size > 0) json["mesh"]["element_size"] = report.element_size;
  if (report.file.scene.align_mesh) json["mesh"]["aligned"] = true;
  json["pairs"] = {{"averted", matrix.pairs.averted},
                   {"clear", matrix.pairs.clear},
                   {"blocked", matrix.pairs.blocked},
                   {"obstructed", matrix.pairs.obstructed}};
  json["reciprocity"] = {{"pairs_checked", matrix.reciprocity.pairs},
                         {"pairs_refined", matrix.reciprocity.refined},
                         {"pairs_beyond_bounds", matrix.reciprocity.disagreements},
                         {"defect", matrix.reciprocity.defect}};
  json["missed_tolerance"] = missed_json(matrix.missed);
  json["rows_done"] = rows_done(report);
  if (!report.solution) return json;
  json["closure"] = closure_json(report.closure);
  if (report.solution->steps > 0) {
    json["iteration"] = {{"status", words(report.solution->status)}, {"steps", report.solution->steps}};
  }
  for (std::size_t c = 0; c < report.solution->solved; ++c) {
    json["channels"][kChannels[c]] = channel_summary(report.solution->channels[c]);
  }
  if (report.certified) json["certified"] = certified_json(report);
  if (!is_solved(report)) return json;
  if (report.sensors) json["sensors"] = sensors_json(*report.sensors, all_sensors);
  json["vertices"] = {{"distinct", report.vertices.vertices},
                      {"clamped", report.vertices.clamped},
                      {"without_inner_neighbour", report.vertices.without_interior}};
  json["exposure"] = report.exposure;
  return json;
}

Json element_json(const SolveReport& report, std::size_t k) {
  const Element& element = report.mesh.elements[k];
  const Material& material = report.file.scene.materials[report.mesh.face_of(element).material];
  Json json{{"element", k},
            {"object", object_name(report, k)},
            {"face", element.face},
            {"patch", element.patch},
            {"material", material.name},
            {"centroid", triple(element.polygon.centroid())},
            {"area", element.polygon.area()},
            {"normal", triple(element.polygon.normal())},
            {"reflectance", triple(material.rho)},
            {"emission", triple(material.emission)}};
  for (const Vec3& vertex : element.polygon.vertices()) json["vertices"].push_back(triple(vertex));
  if (report.solution) {
    json["radiosity"] = triple(report.solution->radiosity[k]);
    for (std::size_t c = report.solution->solved; c < 3; ++c) json["radiosity"][c] = nullptr;
    if (report.enclosure) {
      json["radiosity_interval"] = Json::array();
      for (Eigen::Index channel = 0; channel < 3; ++channel) {
        json["radiosity_interval"].push_back(
            {report.enclosure->lower[k](channel), report.enclosure->upper[k](channel)});
      }
    }
    const auto& covered = report.closure.covered;
    if (std::binary_search(covered.begin(), covered.end(), k)) json["covered"] = true;
    json["row_sum"] = report.closure.row_sums(static_cast<Eigen::Index>(k));
  } else {
    json["row_done"] = static_cast<bool>(report.matrix.row_done[k]);
  }
  return json;
}

/// Adds to a report what each row that is done computed, the part right of the diagonal, one line a row. The text may be
/// as large as the matrix: it is not copied.
std::string with_rows(std::string text, const FormFactorMatrix& matrix) {
  const std::string end = "\n}\n";
  text.resize(text.size() - end.size());
  text += ",\n \"rows\": [";
  const char* separator = "\n  ";
  for (Eigen::Index i = 0, n = matrix.factors.rows(); i < n; ++i) {
    if (!matrix.row_done[static_cast<std::size_t>(i)]) continue;
    Json row{{"row", i}, {"factors", Json::array()}, {"bounds", Json::array()}};
    for (Eigen::Index j = i + 1; j < n; ++j) {
      row["factors"].push_back(matrix.factors(i, j));
      row["bounds"].push_back(matrix.bounds(i, j));
    }
    text += separator + row.dump();
    separator = ",\n  ";
  }
  text += "]" + end;
  return text;
}

void print_closure(std::ostream& out, const SolveReport& report) {
  const ClosureReport& closure = report.closure;
  out << "closure      " << state(closure);
  if (closure.closed > 0 && closure.closed == closure.judged) {
    out << ": " << closure.closed << " elements see 1 to within " << rounded(closure.defect);
  } else if (closure.judged > 0) {
    out << ": " << closure.closed << " elements see 1 to within their bounds, " << closure.open << " less, "
        << closure.exceeded << " more; by " << rounded(closure.defect) << " at most";
  } else {
    out << ": no element sees the front of another";
  }
  if (closure.judged > 0) {
    out << ", at element " << closure.worst << " (" << printable(object_name(report, closure.worst))
        << "); bounds of a row sum to " << rounded(closure.largest_row_bound) << " at most";
  }
  out << '\n';
  if (!closure.covered.empty()) {
    out << "covered      " << closure.covered.size()
        << " elements lie inside or under other surfaces and see no front\n";
  }
  if (closure.unknown > 0) {
    out << "unknown      " << counted(closure.unknown, "element")
        << (closure.unknown == 1 ? ", whose" : ", each of whose") << " form factors are known to 1 or worse together\n";
  }
  if (closure.facing_void > 0) {
    out << "void         " << counted(closure.facing_void, "element")
        << (closure.facing_void == 1 ? " sees no front and faces the void\n" : " see no front and face the void\n");
  }
}

/// Which pairs keep the tolerance. It is asked of the larger of two elements, whose share of the smaller one is known to
/// it; what a tiny element sees of others may be unknown all the same.
std::string tolerance_words(const SolveReport& report) {
  const FormFactorMatrix& matrix = report.matrix;
  if (matrix.missed.pairs > 0) return "missed by " + std::to_string(matrix.missed.pairs) + " pairs";
  if (!matrix.complete) return "kept by the pairs that are done";
  if (report.closure.unknown == 0) return "kept by all pairs";
  return "kept from the larger element of all pairs, not from " + counted(report.closure.unknown, "tiny element");
}

}  // namespace

bool is_solved(const SolveReport& report) {
  return report.solution && report.solution->solved == report.solution->channels.size();
}

std::string missed_tolerance_text(const SolveReport& report) {
  const MissedTolerance& missed = report.matrix.missed;
  return "tolerance not reached: the form factors of " + std::to_string(missed.pairs) + " pairs of " +
         "elements are known less well than --tolerance " + rounded(report.tolerance.obstructed.relative) +
         " asks; worst between " + between(report, missed.first, missed.second) + ": known to within " +
         rounded(missed.bound) + ", asked " + rounded(missed.allowed);
}

std::string wide_enclosures_text(const SolveReport& report) {
  if (!report.certified || report.certified->wide == 0) return {};
  const CertifiedFactors& factors = *report.certified;
  return "tolerance not reached: the enclosures of the form factors of " + std::to_string(factors.wide) +
         " pairs of elements are wider than asked (--certify-tolerance " + rounded(report.certify_tolerance) +
         ", where nothing is in between " + rounded(kCertifiedFree) + "); the widest, between " +
         between(report, factors.from, factors.to) + ", has the width " + rounded(factors.widest) +
         "; the intervals hold all the same";
}

std::string summary_json(const SolveReport& report) {
  Json json = summary(report, false);
  json["files"] = files_json(report.scene_path, report);
  if (report.sensors) json["files"]["sensors"] = report.sensors->csv.string();
  json["seconds"] = report.seconds;
  return dumped(json) + "\n";
}

std::string full_json(const SolveReport& report) {
  Json json = summary(report, true);
  json["faces"] = faces_json(report.mesh);
  json["contacts"] = contacts_json(report.mesh);
  json["elements"] = Json::array();
  for (std::size_t k = 0; k < report.mesh.elements.size(); ++k) json["elements"].push_back(element_json(report, k));
  const std::string text = dumped(json) + "\n";
  return is_solved(report) ? text : with_rows(text, report.matrix);
}

void print_summary(std::ostream& out, const SolveReport& report) {
  const FormFactorMatrix& matrix = report.matrix;
  out << "scene        " << scene_line(report.file) << '\n'
      << "mesh         " << counted(report.mesh.elements.size(), "element") << " in " << report.mesh.patches
      << (report.mesh.patches == 1 ? " patch on " : " patches on ") << counted(report.mesh.faces.size(), "face") << "\n"
      << "pairs        " << matrix.pairs.clear << " clear, " << matrix.pairs.obstructed << " obstructed, "
      << matrix.pairs.blocked << " blocked, " << matrix.pairs.averted << " averted\n"
      << "reciprocity  " << rounded(matrix.reciprocity.defect) << " at most over " << matrix.reciprocity.pairs
      << " pairs computed from both sides; " << matrix.reciprocity.disagreements << " beyond their bounds\n"
      << "tolerance    " << rounded(report.tolerance.obstructed.relative) << ": " << tolerance_words(report) << "; "
      << matrix.reciprocity.refined << " were computed in parts until both sides agreed\n";
  if (!report.solution) {
    out << "stopped      " << rows_done(report) << " of " << report.mesh.elements.size() << " rows are done\n"
        << printable(report.json.string()) << '\n';
    return;
  }
  print_closure(out, report);
  if (report.solution->steps > 0) {
    out << "solver       " << report.solver << ": " << words(report.solution->status) << " after "
        << report.solution->steps << " steps\n";
  }
  for (std::size_t c = 0; c < report.solution->solved; ++c) {
    const ChannelRadiosity& channel = report.solution->channels[c];
    out << kChannels[c] << std::string(13 - std::string(kChannels[c]).size(), ' ') << "residual "
        << rounded(channel.solution.residual) << ", bound " << rounded(channel.solution.bound) << " (with form factors "
        << rounded(channel.bound_with_factors) << ") W/m²; " << rounded(channel.balance.emitted) << " W emitted, "
        << rounded(channel.balance.absorbed) << " absorbed, " << rounded(channel.balance.escaped) << " escaped, "
        << rounded(channel.balance.defect) << " unaccounted for\n";
  }
  if (!is_solved(report)) {
    out << "stopped      " << report.solution->solved << " of 3 channels are solved\n"
        << printable(report.json.string()) << '\n';
    return;
  }
  print_certified(out, report);
  if (report.sensors) print_sensors(out, *report.sensors);
  out << "vertices     " << report.vertices.vertices << "; " << report.vertices.clamped
      << " negative extrapolations set to 0\n"
      << "exposure     " << rounded(report.exposure) << " (white = " << rounded(1 / report.exposure) << " W/m²)\n"
      << "time         " << rounded(report.seconds) << " s\n";
  print_files(out, report);
  if (report.sensors) out << printable(report.sensors->csv.string()) << '\n';
}

}  // namespace etendue::cli
