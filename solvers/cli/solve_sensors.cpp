// SPDX-License-Identifier: Apache-2.0
#include "solve_sensors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <utility>

#include "etendue/meshing/halved.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"
#include "outputs.hpp"
#include "solve_report.hpp"

namespace etendue::cli {

namespace {

constexpr double kLeastEfficacy = 1e-6;

/// What all sensors receive of one solution. Bounds are infinite where the solution's own is.
Result<std::vector<Gathered>> readings(const SolvedElements& solved, const std::vector<Sensor>& sensors,
                                       const Execution& execution) {
  const bool known = solved.bound.isFinite().all();
  const FinalGather gather(solved.mesh);
  const RadiosityField field =
      linear_field(solved.mesh, solved.radiosity, solved.covered, known ? solved.bound : Rgb(Rgb::Zero()));
  auto outcome = measure(gather, field, sensors, execution);
  if (!outcome) return outcome.error();
  std::vector<Gathered> found = std::move(outcome).value();
  if (!known) {
    for (Gathered& one : found) one.bound = Rgb::Constant(std::numeric_limits<double>::infinity());
  }
  return found;
}

SolvedElements solved_elements(const SolveReport& report) {
  Rgb bound;
  for (std::size_t c = 0; c < 3; ++c) {
    bound(static_cast<Eigen::Index>(c)) = report.solution->channels[c].bound_with_factors;
  }
  return {report.mesh, report.solution->radiosity, report.closure.covered, bound};
}

Json colour_or_null(const Rgb& colour) {
  return Json::array({finite_or_null(colour(0)), finite_or_null(colour(1)), finite_or_null(colour(2))});
}

/// The largest estimate of the discretisation's error, as a share of the largest irradiance.
double largest_discretisation(const SensorReport& sensors) {
  double largest = 0, irradiance = 0;
  for (const SensorResult& one : sensors.results) {
    irradiance = std::max(irradiance, one.irradiance.maxCoeff());
    if (one.discretisation) largest = std::max(largest, one.discretisation->maxCoeff());
  }
  return irradiance > 0 ? largest / irradiance : 0;
}

}  // namespace

void add_sensors(Options& options, SensorRequest& request) {
  options.path("--sensors", "FILE",
               "also find the irradiance at the points of FILE (.json, or text: x y z and normal a line), written to\n"
               "NAME.sensors.csv and NAME.json",
               request.file);
  options.real("--efficacy", "K",
               "luminous efficacy of the light, lm/W, for lux (default: 179, equal-energy white; 683 at 555 nm)",
               request.efficacy, kLeastEfficacy, kPeakEfficacy);
}

void add_extrapolation(Options& options, SensorRequest& request) {
  options.flag(
      "--extrapolate",
      "with the full matrix: solve on half the elements along every edge as well, and extrapolate what sensors\n"
      "receive: the error of the elements' size is estimated, and most of it is gone",
      request.extrapolate);
}

std::optional<std::string> contradiction(const SensorRequest& request) {
  if (request.extrapolate && !request.asked()) return "--extrapolate is for sensors: give --sensors FILE as well";
  return std::nullopt;
}

Result<SensorReport> opened_sensors(const SensorRequest& request, const SceneFile& scene,
                                    const std::filesystem::path& csv) {
  std::vector<std::filesystem::path> inputs = scene.files;
  inputs.push_back(request.file);
  if (const auto free = check_outputs({csv}, inputs); !free) return free.error();
  auto sensors = read_sensors(request.file, scene.scene.metres_per_unit);
  if (!sensors) return sensors.error();
  if (request.extrapolate) {
    if (const auto coarse = with_half_the_elements(scene.scene); !coarse) return coarse.error();
  }
  return SensorReport{std::move(sensors).value(), {}, request.efficacy, 0, {}, csv};
}

Result<SensorReport> measured(const SolvedElements& solved, SensorReport sensors, const Execution& execution) {
  const auto found = readings(solved, sensors.sensors, execution);
  if (!found) return found.error();
  for (const Gathered& one : *found) sensors.results.push_back({one.irradiance, one.bound});
  return sensors;
}

Result<SensorReport> measured(const SolveReport& report, SensorReport sensors, const SolveAgain& again,
                              const Execution& execution) {
  if (!again) return measured(solved_elements(report), std::move(sensors), execution);
  const auto fine = readings(solved_elements(report), sensors.sensors, execution);
  if (!fine) return fine.error();
  auto halved = with_half_the_elements(report.file.scene);
  if (!halved) return halved.error();
  const auto coarse_report = again(std::move(halved).value());
  if (!coarse_report) return coarse_report.error();
  const auto coarse = readings(solved_elements(*coarse_report), sensors.sensors, execution);
  if (!coarse) return coarse.error();
  sensors.not_halved = not_halved(report.file.scene);
  sensors.coarse_elements = coarse_report->mesh.elements.size();
  for (std::size_t k = 0; k < fine->size(); ++k) {
    const Extrapolated one = extrapolated((*fine)[k], (*coarse)[k]);
    sensors.results.push_back({one.irradiance, one.bound, one.discretisation});
  }
  return sensors;
}

void print_sensors(std::ostream& out, const SensorReport& sensors) {
  double low = std::numeric_limits<double>::infinity(), high = 0, sum = 0, bound = 0;
  for (const SensorResult& one : sensors.results) {
    const double lux = illuminance(one.irradiance, sensors.efficacy);
    low = std::min(low, lux);
    high = std::max(high, lux);
    sum += lux;
    bound = std::max(bound, one.bound.maxCoeff());
  }
  const auto count = static_cast<double>(sensors.results.size());
  out << "sensors      " << counted(sensors.results.size(), "sensor") << ": " << rounded(low) << " to " << rounded(high)
      << " lx, mean " << rounded(sum / count) << " (" << rounded(sensors.efficacy) << " lm/W); "
      << (std::isfinite(bound) ? "bound of the equation " + rounded(bound) + " W/m²" : "without a bound") << '\n';
  if (sensors.coarse_elements > 0) {
    out << "elements     extrapolated from " << sensors.coarse_elements << " as well, which changed sensors by "
        << rounded(100 * largest_discretisation(sensors)) << " % of the largest at most\n";
    if (!sensors.not_halved.empty()) {
      constexpr std::size_t kMostNames = 5;
      out << "not halved   " << counted(sensors.not_halved.size(), "object")
          << " of a single element along an edge, whose part in the error is not estimated: ";
      for (std::size_t k = 0; k < std::min(kMostNames, sensors.not_halved.size()); ++k) {
        out << (k > 0 ? ", " : "") << printable(sensors.not_halved[k]);
      }
      out << (sensors.not_halved.size() > kMostNames ? ", …\n" : "\n");
    }
  }
}

Json sensors_json(const SensorReport& sensors, bool all) {
  Json json;
  json["count"] = sensors.sensors.size();
  json["lumens_per_watt"] = sensors.efficacy;
  json["luminance_weights"] = {kLuminanceWeights[0], kLuminanceWeights[1], kLuminanceWeights[2]};
  if (sensors.coarse_elements > 0) {
    json["extrapolated"] = {{"coarse_elements", sensors.coarse_elements},
                            {"largest_discretisation", largest_discretisation(sensors)},
                            {"not_halved", sensors.not_halved}};
  }
  if (!all) return json;
  json["readings"] = Json::array();
  for (std::size_t k = 0; k < sensors.sensors.size(); ++k) {
    const Sensor& sensor = sensors.sensors[k];
    const SensorResult& result = sensors.results[k];
    Json one{{"name", sensor.name},
             {"position", triple(sensor.position)},
             {"normal", triple(sensor.normal)},
             {"irradiance", triple(result.irradiance)},
             {"bound", colour_or_null(result.bound)}};
    if (result.discretisation) one["discretisation"] = triple(*result.discretisation);
    one["illuminance"] = illuminance(result.irradiance, sensors.efficacy);
    json["readings"].push_back(std::move(one));
  }
  return json;
}

}  // namespace etendue::cli
