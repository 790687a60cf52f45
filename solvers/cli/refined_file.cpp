// SPDX-License-Identifier: Apache-2.0
#include <sstream>
#include <string>

#include "etendue/text/utf8.hpp"
#include "refined_report.hpp"
#include "report_json.hpp"

namespace etendue::cli {

namespace {

Rgb triple(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

Error wrong(const std::filesystem::path& path, const std::string& what) {
  return {ErrorCode::invalid_input, quoted_path(path) + ": " + what};
}

/// What a run knows beside its elements and patches.
void read_run(const Json& run, SceneShooting& state) {
  state.steps = run.at("steps").get<std::size_t>();
  state.shooters = run.at("shooters").get<std::vector<std::size_t>>();
  state.unshot_shares = run.at("unshot_shares").get<std::vector<double>>();
  state.emitted = triple(run.at("emitted_watts"));
  state.absorbed = triple(run.at("absorbed_watts"));
  state.escaped = triple(run.at("escaped_watts"));
  require(!state.unshot_shares.empty(), "read_run: there are shares");
}

/// The cells of the file, in their order, and the corners of those that are pieces; true when they fit the report.
bool read_cells(const Json& elements, AdaptiveMesh& mesh) {
  std::vector<MeshCell> cells;
  std::vector<Polygon> pieces;
  for (const Json& element : elements) {
    const Json& at = element.at("cell");
    cells.push_back({element.at("face").get<std::size_t>(), element.at("patch").get<std::size_t>(), at.at(0).get<int>(),
                     at.at(1).get<std::int64_t>(), at.at(2).get<std::int64_t>()});
    const MeshCell& cell = cells.back();
    if (cell.face >= mesh.faces.size() || cell.patch >= mesh.patches || cell.halvings() > kDeepestCell) return false;
    if (cell.level >= 0) continue;
    if (cell.level != kPiece || cell.a != static_cast<std::int64_t>(pieces.size()) || cell.b < 0) return false;
    std::vector<Vec3> corners;
    for (const Json& corner : element.at("vertices")) corners.emplace_back(triple(corner));
    auto piece = Polygon::make(std::move(corners));
    if (!piece) return false;
    pieces.push_back(std::move(piece).value());
  }
  mesh.cells = std::move(cells);
  mesh.pieces = std::move(pieces);
  return true;
}

void read_state(const Json& file, const char* irradiance, const char* unshot, const std::size_t* light,
                SceneShooting& state) {
  const auto value = [&](const Json& entry, const char* key) {
    return triple(light != nullptr ? entry.at(key).at(*light) : entry.at(key));
  };
  state.irradiance.clear();
  state.unshot.clear();
  for (const Json& element : file.at("elements")) state.irradiance.push_back(value(element, irradiance));
  for (const Json& patch : file.at("patches")) state.unshot.push_back(value(patch, unshot));
}

/// Everything that was written; exceptions of the parser are the caller's.
Result<Done> take(const Json& file, const std::filesystem::path& path, RefinedReport& report) {
  AdaptiveSolution& solution = report.solution;
  const Json& runs = file.at("runs");
  if (file.at("patches").size() != solution.mesh.patches ||
      runs.size() != std::max<std::size_t>(report.lights.size(), 1)) {
    return wrong(path, "its patches or lights are not those of the scene");
  }
  if (!read_cells(file.at("elements"), solution.mesh)) return wrong(path, "its elements are not those of the scene");
  auto elements = elements_of(solution.mesh);
  if (!elements) return wrong(path, elements.error().message);
  solution.model = with_elements(solution.model, report.file.scene, std::move(elements).value());
  for (const Json& round : file.at("rounds")) {
    solution.rounds.push_back({round.at("elements").get<std::size_t>(), round.at("steps").get<std::size_t>(),
                               round.at("unshot_share").get<double>()});
  }
  solution.missed = file.at("form_factors").at("pairs_beyond_tolerance").get<std::size_t>();
  if (report.lights.empty()) {
    read_run(runs.at(0), solution.state);
    read_state(file, "irradiance", "unshot", nullptr, solution.state);
  }
  for (std::size_t l = 0; l < report.lights.size(); ++l) {
    read_run(runs.at(l), report.lights[l].state);
    read_state(file, "irradiance_by_light", "unshot_by_light", &l, report.lights[l].state);
  }
  return Done{};
}

}  // namespace

Result<Done> read_solution(const std::filesystem::path& path, RefinedReport& report, bool same_settings) {
  const auto text = read_file(path);
  if (!text) return text.error();
  const Json file = Json::parse(*text, nullptr, false);
  if (file.is_discarded() || !file.is_object() || !file.contains("runs")) {
    return wrong(path, "not a solution that etendue solve --method progressive or adaptive wrote");
  }
  try {
    if (file.at("status") == words(RefinedStatus::relit)) return wrong(path, "a relit solution cannot be gone on with");
    if (file.at("scene").at("hash") != report.file.hash) {
      return wrong(path, "a solution of another scene, or of this one before it was changed");
    }
    const auto settings = file.at("settings").get<std::string>();
    if (same_settings && settings != report.request.settings()) {
      return wrong(path, "found by other settings: " + settings + "; asked for: " + report.request.settings());
    }
    report.settings = settings;
    report.bounded = file.at("form_factors").at("bounded").get<bool>();
    return take(file, path, report);
  } catch (const Json::exception& failure) {
    return wrong(path, std::string("damaged: ") + failure.what());
  }
}

Result<std::vector<Rgb>> light_factors(const std::string& text, const RefinedReport& report) {
  const Scene& scene = report.file.scene;
  std::vector<Rgb> factors(report.lights.size(), Rgb::Ones());
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const auto fault = [&](const std::string& what) {
      return Error{ErrorCode::usage, "--relight " + part + ": " + what};
    };
    const std::size_t equals = part.rfind('=');
    if (equals == std::string::npos) return fault("expected MATERIAL=FACTOR");
    std::string known;
    std::size_t light = report.lights.size();
    for (std::size_t l = 0; l < report.lights.size(); ++l) {
      const std::string& name = scene.materials[report.lights[l].material].name;
      if (name == part.substr(0, equals)) light = l;
      known += (l > 0 ? ", " : "") + name;
    }
    if (light == report.lights.size()) return fault("no such material emits; those that do: " + known);
    std::istringstream numbers(part.substr(equals + 1));
    std::vector<double> values;
    for (std::string number; std::getline(numbers, number, ':');) {
      char* end = nullptr;
      values.push_back(std::strtod(number.c_str(), &end));
      if (number.empty() || *end != '\0' || !(values.back() >= 0 && values.back() <= 1e12)) {
        return fault("a factor is a number in [0, 1e12], or three of them: R:G:B");
      }
    }
    if (values.size() != 1 && values.size() != 3) return fault("a factor is one number, or three: R:G:B");
    factors[light] = values.size() == 1 ? Rgb::Constant(values[0]) : Rgb(values[0], values[1], values[2]);
  }
  return factors;
}

}  // namespace etendue::cli
