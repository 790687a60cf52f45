// SPDX-License-Identifier: Apache-2.0
#include "refined_report.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "etendue/core/version.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"
#include "outputs.hpp"
#include "report_json.hpp"

namespace etendue::cli {

namespace {

const char* method_words(const RefinedRequest& request) {
  if (request.method == "hemicube") return "radiosity, full matrix by hemicubes";
  if (!request.adaptive()) return "radiosity, progressive refinement";
  return request.eliminates() ? "radiosity, adaptive subdivision, elimination"
                              : "radiosity, adaptive subdivision, progressive refinement";
}

Json run_json(const RefinedReport& report, const SceneShooting& state, const Json& name) {
  Json json{{"light", name},
            {"steps", state.steps},
            {"unshot_share", state.unshot_shares.back()},
            {"emitted_watts", triple(state.emitted)},
            {"absorbed_watts", triple(state.absorbed)},
            {"escaped_watts", triple(state.escaped)},
            {"unshot_watts", triple(unshot_power(report.solution.model, state))}};
  json["shooters"] = state.shooters;
  json["unshot_shares"] = state.unshot_shares;
  return json;
}

Json channel_json(const RefinedReport& report, Eigen::Index c) {
  const SceneShooting& state = report.solution.state;
  const double unshot = unshot_power(report.solution.model, state)(c);
  Json json{{"emitted_watts", state.emitted(c)},
            {"absorbed_watts", state.absorbed(c)},
            {"escaped_watts", state.escaped(c)},
            {"unshot_watts", unshot}};
  if (report.request.eliminates()) {
    json["bound"] = report.solution.bound(c);
  } else {
    json["bound"] = finite_or_null(report.gap.radiosity(c));
    json["missing_watts_at_most"] = report.gap.power(c);
  }
  return json;
}

/// What scene and settings determine: nothing that differs between two runs. With `all`, each sensor's reading.
Json summary(const RefinedReport& report, bool all) {
  const AdaptiveSolution& solution = report.solution;
  Json json;
  json["program"] = std::string("etendue ") + version();
  json["method"] = method_words(report.request);
  json["status"] = words(report.status);
  json["scene"] = scene_json(report.file);
  json["camera"] = view_json(report.file.scene);
  json["settings"] = report.settings;
  json["mesh"] = {{"faces", solution.mesh.faces.size()},
                  {"patches", solution.mesh.patches},
                  {"elements", solution.mesh.cells.size()}};
  if (report.request.element_size > 0) json["mesh"]["element_size"] = report.request.element_size;
  if (report.file.scene.align_mesh) json["mesh"]["aligned"] = true;
  json["form_factors"] = {{"bounded", report.bounded}, {"pairs_beyond_tolerance", solution.missed}};
  json["rounds"] = Json::array();
  for (const AdaptiveRound& round : solution.rounds) {
    json["rounds"].push_back(
        {{"elements", round.elements}, {"steps", round.steps}, {"unshot_share", round.unshot_share}});
  }
  for (Eigen::Index c = 0; c < 3; ++c) json["channels"][kChannels[c]] = channel_json(report, c);
  json["ambient"] = triple(report.ambient);
  json["runs"] = Json::array();
  const auto name = [&](const LightSolution& light) { return report.file.scene.materials[light.material].name; };
  if (report.lights.empty()) json["runs"].push_back(run_json(report, solution.state, nullptr));
  for (const LightSolution& light : report.lights) json["runs"].push_back(run_json(report, light.state, name(light)));
  if (!report.light_factors.empty()) {
    for (std::size_t l = 0; l < report.lights.size(); ++l) {
      json["light_factors"][name(report.lights[l])] = triple(report.light_factors[l]);
    }
  }
  if (report.exposure > 0) json["exposure"] = report.exposure;
  if (report.sensors && !report.sensors->results.empty()) json["sensors"] = sensors_json(*report.sensors, all);
  return json;
}

Json patch_json(const RefinedReport& report, std::size_t j) {
  const PatchModel& model = report.solution.model;
  Json json{{"patch", j}, {"area_m2", model.patch_areas[j]}, {"unshot", triple(report.solution.state.unshot[j])}};
  for (const LightSolution& light : report.lights) json["unshot_by_light"].push_back(triple(light.state.unshot[j]));
  return json;
}

Json element_json(const RefinedReport& report, std::size_t k) {
  const AdaptiveSolution& solution = report.solution;
  const Element& element = solution.model.elements.elements[k];
  const MeshCell& cell = solution.mesh.cells[k];
  const Face& face = solution.mesh.faces[element.face];
  const Material& material = report.file.scene.materials[face.material];
  Json json{{"element", k},
            {"object", report.file.scene.objects[face.object].name},
            {"face", element.face},
            {"patch", element.patch},
            {"cell", {cell.level, cell.a, cell.b}},
            {"material", material.name},
            {"centroid", triple(element.polygon.centroid())},
            {"area", element.polygon.area()},
            {"normal", triple(element.polygon.normal())},
            {"reflectance", triple(material.rho)},
            {"emission", triple(report.emissions[element.patch])},
            {"radiosity", triple(report.radiosity[k])},
            {"irradiance", triple(solution.state.irradiance[k])}};
  for (const LightSolution& light : report.lights) {
    json["irradiance_by_light"].push_back(triple(light.state.irradiance[k]));
  }
  for (const Vec3& vertex : element.polygon.vertices()) json["vertices"].push_back(triple(vertex));
  if (std::binary_search(report.covered.begin(), report.covered.end(), k)) json["covered"] = true;
  return json;
}

}  // namespace

const char* words(RefinedStatus status) {
  switch (status) {
    case RefinedStatus::solved:
      return "solved";
    case RefinedStatus::steps_used_up:
      return "steps used up";
    case RefinedStatus::elements_used_up:
      return "elements used up";
    case RefinedStatus::tolerance_missed:
      return "tolerance missed";
    case RefinedStatus::relit:
      return "relit";
    case RefinedStatus::stopped:
      break;
  }
  return "stopped";
}

std::string summary_json(const RefinedReport& report) {
  Json json = summary(report, false);
  for (Json& run : json["runs"]) {
    run.erase("shooters");
    run.erase("unshot_shares");
  }
  json["files"] = files_json(report.request.scene, report);
  if (report.sensors && !report.sensors->results.empty()) {
    json["files"]["sensors"] = report.sensors->csv.string();
  }
  json["seconds"] = report.seconds;
  return dumped(json) + "\n";
}

Result<Done> write_solution(const std::filesystem::path& path, const RefinedReport& report) {
  return write_pieces(path, [&](const Append& append) -> Result<Done> {
    std::string text = dumped(summary(report, true));
    text.resize(text.size() - std::string("\n}").size());
    text += ",\n \"faces\": " + dumped(faces_json(report.solution.model.elements), -1);
    text += ",\n \"contacts\": " + dumped(contacts_json(report.solution.model.elements), -1);
    text += ",\n \"patches\": [";
    constexpr std::size_t kPiece = 1 << 16;
    const auto add = [&](const std::string& more) -> Result<Done> {
      text += more;
      if (text.size() < kPiece) return Done{};
      const auto done = append(text);
      text.clear();
      return done;
    };
    for (std::size_t j = 0; j < report.solution.model.patch_areas.size(); ++j) {
      if (const auto done = add((j > 0 ? ",\n  " : "\n  ") + dumped(patch_json(report, j), -1)); !done) return done;
    }
    if (const auto done = add("],\n \"elements\": ["); !done) return done;
    for (std::size_t k = 0; k < report.solution.mesh.cells.size(); ++k) {
      if (const auto done = add((k > 0 ? ",\n  " : "\n  ") + dumped(element_json(report, k), -1)); !done) return done;
    }
    text += "]\n}\n";
    return append(text);
  });
}

void print_summary(std::ostream& out, const RefinedReport& report) {
  const AdaptiveSolution& solution = report.solution;
  const SceneShooting& state = solution.state;
  out << "scene        " << scene_line(report.file) << '\n'
      << "method       " << method_words(report.request) << "; " << report.settings << '\n'
      << "mesh         " << counted(solution.mesh.cells.size(), "element") << " in " << solution.mesh.patches
      << (solution.mesh.patches == 1 ? " patch on " : " patches on ") << counted(solution.mesh.faces.size(), "face")
      << '\n';
  if (solution.rounds.size() > 1) {
    out << "rounds       ";
    for (std::size_t k = 0; k < solution.rounds.size(); ++k) {
      out << (k > 0 ? ", " : "") << solution.rounds[k].elements;
    }
    out << " elements\n";
  }
  if (!report.request.eliminates()) {
    out << "steps        " << state.steps << "; " << rounded(100 * state.unshot_shares.back())
        << " % of the emitted power is unshot\n";
  }
  const Rgb unshot = unshot_power(solution.model, state);
  for (Eigen::Index c = 0; c < 3; ++c) {
    out << kChannels[c] << std::string(13 - std::string(kChannels[c]).size(), ' ') << rounded(state.emitted(c))
        << " W emitted, " << rounded(state.absorbed(c)) << " absorbed, " << rounded(state.escaped(c)) << " escaped, "
        << rounded(unshot(c)) << " unshot; ";
    if (report.request.eliminates()) {
      out << "bound " << rounded(solution.bound(c)) << " W/m² for the form factors as they are\n";
    } else {
      out << "at most " << rounded(report.gap.power(c)) << " W missing";
      if (std::isfinite(report.gap.radiosity(c))) out << ", " << rounded(report.gap.radiosity(c)) << " W/m² anywhere";
      out << '\n';
    }
  }
  out << "form factors "
      << (report.bounded
              ? counted(solution.missed, "pair") + " less certain than --tolerance asks\n"
              : "from pixels: without a bound; what is said above holds for these factors (docs/hemicube.md)\n");
  if (report.exposure > 0) {
    out << "exposure     " << rounded(report.exposure) << " (white = " << rounded(1 / report.exposure) << " W/m²)\n";
  }
  if (report.sensors && !report.sensors->results.empty()) print_sensors(out, *report.sensors);
  out << "time         " << rounded(report.seconds) << " s\n";
  print_files(out, report);
  if (report.sensors && !report.sensors->results.empty()) out << printable(report.sensors->csv.string()) << '\n';
}

}  // namespace etendue::cli
