// SPDX-License-Identifier: Apache-2.0
#include "solve_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <ostream>

#include "etendue/core/version.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kChannels[] = {"red", "green", "blue"};

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

template <class Three>
Json triple(const Three& v) {
  return Json::array({v(0), v(1), v(2)});
}

/// JSON has no infinity: a bound that does not exist is null.
Json finite_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

std::string dumped(const Json& json) {
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::size_t rows_done(const SolveReport& report) {
  return static_cast<std::size_t>(std::count(report.matrix.row_done.begin(), report.matrix.row_done.end(), true));
}

const std::string& object_name(const SolveReport& report, std::size_t element) {
  return report.file.scene.objects[report.mesh.face_of(report.mesh.elements[element]).object].name;
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

/// What the scene and the settings determine: nothing that differs between two runs.
Json summary(const SolveReport& report) {
  const FormFactorMatrix& matrix = report.matrix;
  Json json;
  json["program"] = std::string("etendue ") + version();
  json["method"] = "radiosity, full matrix";
  json["status"] = report.solution ? "solved" : "stopped";
  json["scene"] = {{"name", report.file.scene.name},
                   {"hash", report.file.hash},
                   {"metres_per_unit", report.file.scene.metres_per_unit}};
  json["settings"] = {{"solver", report.solver},
                      {"tolerance_free", report.tolerance.free.relative},
                      {"tolerance_obstructed", report.tolerance.obstructed.relative}};
  json["mesh"] = {
      {"faces", report.mesh.faces.size()}, {"patches", report.mesh.patches}, {"elements", report.mesh.elements.size()}};
  json["pairs"] = {{"averted", matrix.pairs.averted},
                   {"clear", matrix.pairs.clear},
                   {"blocked", matrix.pairs.blocked},
                   {"obstructed", matrix.pairs.obstructed}};
  json["reciprocity"] = {{"pairs_checked", matrix.reciprocity.pairs},
                         {"pairs_beyond_bounds", matrix.reciprocity.disagreements},
                         {"defect", matrix.reciprocity.defect}};
  if (report.solution) {
    json["closure"] = {{"defect", report.closure.defect},
                       {"worst_element", report.closure.worst},
                       {"covered_elements", report.closure.covered},
                       {"largest_row_bound", report.closure.largest_row_bound},
                       {"total_bound", report.closure.total_bound}};
    for (std::size_t c = 0; c < 3; ++c) json["channels"][kChannels[c]] = channel_summary(report.solution->channels[c]);
    json["vertices"] = {{"distinct", report.vertices.vertices},
                        {"clamped", report.vertices.clamped},
                        {"without_inner_neighbour", report.vertices.without_interior}};
    json["exposure"] = report.exposure;
  } else {
    json["rows_done"] = rows_done(report);
  }
  return json;
}

Json element_json(const SolveReport& report, std::size_t k) {
  const Element& element = report.mesh.elements[k];
  const Material& material = report.file.scene.materials[report.mesh.face_of(element).material];
  Json json{{"element", k},
            {"object", object_name(report, k)},
            {"patch", element.patch},
            {"material", material.name},
            {"centroid", triple(element.polygon.centroid())},
            {"area", element.polygon.area()},
            {"normal", triple(element.polygon.normal())},
            {"reflectance", triple(material.rho)},
            {"emission", triple(material.emission)}};
  if (report.solution) {
    json["radiosity"] = triple(report.solution->radiosity[k]);
    json["row_sum"] = report.closure.row_sums(static_cast<Eigen::Index>(k));
  } else {
    json["row_done"] = static_cast<bool>(report.matrix.row_done[k]);
  }
  return json;
}

}  // namespace

std::string summary_json(const SolveReport& report) {
  Json json = summary(report);
  json["files"] = {{"scene", report.scene_path.string()}, {"json", report.json.string()}};
  if (report.solution) {
    json["files"]["exr"] = report.exr.string();
    json["files"]["png"] = report.png.string();
  }
  json["seconds"] = report.seconds;
  return dumped(json);
}

std::string full_json(const SolveReport& report) {
  Json json = summary(report);
  json["elements"] = Json::array();
  for (std::size_t k = 0; k < report.mesh.elements.size(); ++k) json["elements"].push_back(element_json(report, k));
  return dumped(json);
}

void print_summary(std::ostream& out, const SolveReport& report) {
  const FormFactorMatrix& matrix = report.matrix;
  const Scene& scene = report.file.scene;
  out << "scene        " << printable(scene.name) << ", " << scene.objects.size() << " objects, hash "
      << report.file.hash << '\n'
      << "mesh         " << report.mesh.elements.size() << " elements in " << report.mesh.patches << " patches on "
      << report.mesh.faces.size() << " faces\n"
      << "pairs        " << matrix.pairs.clear << " clear, " << matrix.pairs.obstructed << " obstructed, "
      << matrix.pairs.blocked << " blocked, " << matrix.pairs.averted << " averted\n"
      << "reciprocity  " << rounded(matrix.reciprocity.defect) << " at most over " << matrix.reciprocity.pairs
      << " pairs computed from both sides; " << matrix.reciprocity.disagreements << " beyond their bounds\n";
  if (!report.solution) {
    out << "stopped      " << rows_done(report) << " of " << report.mesh.elements.size() << " rows are done\n";
    return;
  }
  out << "closure      1 to within " << rounded(report.closure.defect) << ", worst at element " << report.closure.worst
      << " (" << printable(object_name(report, report.closure.worst)) << "); bounds of a row sum to "
      << rounded(report.closure.largest_row_bound) << " at most\n";
  if (!report.closure.covered.empty()) {
    out << "covered      " << report.closure.covered.size()
        << " elements see nothing and are left out of the closure\n";
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const ChannelRadiosity& channel = report.solution->channels[c];
    out << kChannels[c] << std::string(13 - std::string(kChannels[c]).size(), ' ') << "residual "
        << rounded(channel.solution.residual) << ", bound " << rounded(channel.solution.bound) << " (with form factors "
        << rounded(channel.bound_with_factors) << ") W/m²; " << rounded(channel.balance.emitted) << " W emitted, "
        << rounded(channel.balance.absorbed) << " absorbed, " << rounded(channel.balance.escaped) << " escaped, "
        << rounded(channel.balance.defect) << " unaccounted for\n";
  }
  out << "vertices     " << report.vertices.vertices << "; " << report.vertices.clamped
      << " negative extrapolations set to 0\n"
      << "exposure     " << rounded(report.exposure) << " (white = " << rounded(1 / report.exposure) << " W/m²)\n"
      << "time         " << rounded(report.seconds) << " s\n"
      << report.exr.string() << '\n'
      << report.png.string() << '\n'
      << report.json.string() << '\n';
}

}  // namespace etendue::cli
