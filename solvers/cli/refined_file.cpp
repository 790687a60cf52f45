// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>

#include "etendue/core/rounding.hpp"
#include "etendue/refinement/relighting.hpp"
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

/// Are two values of a channel the same up to rounding, in units of one that bounds them both?
bool same(const Rgb& found, const Rgb& expected, const Rgb& unit, int roundings) {
  return ((found - expected).abs() <= gamma_bound(roundings) * unit).all();
}

/// What a run says of its power against what its elements and patches hold; the difference in words, if there is one.
std::optional<std::string> contradiction(const Json& run, const RefinedReport& report, const Emissions& emissions,
                                         const SceneShooting& state, double tolerance) {
  const PatchModel& model = report.solution.model;
  const Scene& scene = report.file.scene;
  const auto sums =
      static_cast<int>(state.irradiance.size() + state.unshot.size() + 64);  // roundings of a sum, and of its terms
  const Rgb unshot = unshot_power(model, state), stated = triple(run.at("unshot_watts"));
  if (!same(stated, unshot, unshot, sums)) return "\"unshot\" of its patches is not what \"unshot_watts\" says";
  const Rgb emitted = before_shooting(model, emissions).emitted;
  if (!same(state.emitted, emitted, emitted, sums)) return "\"emitted_watts\" is not what the scene emits";
  const double share = unshot_share(model, state), told = state.unshot_shares.back();
  if (!(std::abs(share - told) <= gamma_bound(sums) * share)) return "\"unshot_shares\" do not end with what is unshot";
  Rgb absorbed = Rgb::Zero(), left = Rgb::Zero(), largest = Rgb::Zero();
  for (std::size_t q = 0; q < state.irradiance.size(); ++q) {
    const Rgb& rho = model.material_of(scene, model.patch_of(q)).rho;
    absorbed += (1 - rho) * state.irradiance[q] * model.element_areas[q];
    largest = largest.max(rho);
  }
  for (std::size_t j = 0; j < state.unshot.size(); ++j) left += state.unshot[j] * model.patch_areas[j];
  // Each step rounds once in each sum; all that was ever shot, overshooting back and forth, is below 4 / (1 − ρ) of E A.
  const int steps = sums + 4 * static_cast<int>(std::min<std::size_t>(state.steps, 1'000'000));
  const Rgb all = 4 * emitted / (1 - largest);
  if (!same(state.absorbed, absorbed, all, steps)) return "\"absorbed_watts\" is not what its elements absorb";
  // Shares of a patch's light may sum to as much above 1 as its factors err, which counts as nothing escaped.
  const Rgb excess = all * (report.bounded ? tolerance : 0);
  const Rgb defect = (state.emitted - state.absorbed - state.escaped - left).abs();
  if (report.solution.missed == 0 && !(defect <= excess + gamma_bound(steps) * all).all()) {
    return "what was emitted is not absorbed, escaped and unshot together";
  }
  return std::nullopt;
}

/// Does every element's radiosity follow from what it received?
std::optional<std::string> contradiction(const Json& elements, const RefinedReport& report) {
  const PatchModel& model = report.solution.model;
  const Emissions emissions = emissions_of(report.file.scene, model);
  constexpr int kRoundings = 16;  // of one sum and product, of E and H of each light
  for (std::size_t q = 0; q < elements.size(); ++q) {
    const std::size_t patch = model.patch_of(q);
    Rgb received = report.lights.empty() ? report.solution.state.irradiance[q] : Rgb(Rgb::Zero());
    for (const LightSolution& light : report.lights) received += light.state.irradiance[q];
    const Rgb expected = emissions[patch] + model.material_of(report.file.scene, patch).rho * received;
    const int roundings = kRoundings + 2 * static_cast<int>(report.lights.size());
    if (same(triple(elements.at(q).at("radiosity")), expected, expected.abs(), roundings)) continue;
    return "\"radiosity\" of element " + std::to_string(q) + " is not what follows from its \"irradiance\"";
  }
  return std::nullopt;
}

/// Nothing that was written by hand is gone on with.
Result<Done> check_whole(const Json& file, const std::filesystem::path& path, const RefinedReport& report,
                         double tolerance) {
  const auto refusal = [&](const std::string& what) {
    return wrong(path, "contradicts itself: " + what + "; was it changed? Solve anew without it");
  };
  const PatchModel& model = report.solution.model;
  const Json& runs = file.at("runs");
  std::optional<std::string> what = contradiction(file.at("elements"), report);
  if (!what && report.lights.empty()) {
    what = contradiction(runs.at(0), report, emissions_of(report.file.scene, model), report.solution.state, tolerance);
  }
  for (std::size_t l = 0; l < report.lights.size() && !what; ++l) {
    const LightSolution& light = report.lights[l];
    what = contradiction(runs.at(l), report, emissions_of(report.file.scene, model, light.material), light.state,
                         tolerance);
  }
  if (what) return refusal(*what);
  return Done{};
}

/// Everything that was written; exceptions of the parser are the caller's.
Result<Done> take(const Json& file, const std::filesystem::path& path, RefinedReport& report, double tolerance) {
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
  return check_whole(file, path, report, tolerance);
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
    constexpr double kLoosest = 0.1;  // that --tolerance takes
    const double tolerance = same_settings ? report.request.tolerance : kLoosest;
    if (const auto taken = take(file, path, report, tolerance); !taken) return taken;
    // A round that ended with this mesh ends anew.
    auto& rounds = report.solution.rounds;
    const bool ended = !rounds.empty() && rounds.back().elements == report.solution.mesh.cells.size();
    if (same_settings && ended) rounds.pop_back();
    return Done{};
  } catch (const Json::exception& failure) {
    return wrong(path, std::string("damaged: ") + failure.what());
  }
}

Result<std::vector<Rgb>> light_factors(const std::string& text, const RefinedReport& report) {
  const Scene& scene = report.file.scene;
  std::vector<Rgb> factors(report.lights.size(), Rgb::Ones());
  std::vector<bool> named(report.lights.size(), false);
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
    if (named[light]) return fault("this light is named twice; expected one factor for it");
    named[light] = true;
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
