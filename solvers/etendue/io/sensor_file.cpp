// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/sensor_file.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string_view>

#include "etendue/io/atomic_file.hpp"
#include "etendue/io/read_errors.hpp"
#include "etendue/io/scene_files.hpp"
#include "etendue/io/scene_node.hpp"
#include "etendue/optics/photometry.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

namespace fs = std::filesystem;

const KeySet kFile{"sensors file", {"format", "version", "unit"}, {"comment", "name", "sensors", "grids"}};
const KeySet kSensor{"sensor", {"position", "normal"}, {"comment", "name"}};
const KeySet kGrid{"grid", {"origin", "edges", "counts"}, {"comment", "name"}};

constexpr long kMostAlong = 65536;
constexpr std::size_t kAnyCount = std::numeric_limits<std::size_t>::max();

/// Reads the JSON form.
class JsonSensors {
 public:
  explicit JsonSensors(double metres_per_unit) : scene_unit_(metres_per_unit) {}

  void read(const SceneNode& top) {
    if (!top.is(kFile)) return;
    if (const auto format = top.member("format")) (void)format->choice({"etendue-sensors"});  // reported there
    if (const auto version = top.member("version")) (void)version->integer(1, 1);
    if (const auto name = top.member("name")) (void)name->text();
    if (const auto unit = top.member("unit")) scale_ = read_unit(*unit).value_or(scene_unit_) / scene_unit_;
    if (const auto list = top.member("sensors")) {
      for (const SceneNode& node : list->items(1, kMostSensors, "sensors")) read_sensor(node);
    }
    if (const auto list = top.member("grids")) {
      for (const SceneNode& node : list->items(1, kAnyCount, "grids")) read_grid(node);
    }
    if (!top.member("sensors") && !top.member("grids")) {
      top.complain("found neither \"sensors\" nor \"grids\", expected one of them");
    }
  }

  std::vector<Sensor> found;

 private:
  static std::string name_of(const SceneNode& node) {
    const auto name = node.member("name");
    return name ? name->text().value_or(node.pointer()) : node.pointer();
  }

  void read_sensor(const SceneNode& node) {
    if (!node.is(kSensor)) return;
    const auto position_node = node.member("position"), normal_node = node.member("normal");
    const auto position = position_node ? position_node->vector() : std::nullopt;
    const auto normal = normal_node ? normal_node->direction() : std::nullopt;
    const std::string name = name_of(node);
    if (position && normal) found.push_back({name, scale_ * *position, *normal, node.where()});
  }

  void read_grid(const SceneNode& node) {
    if (!node.is(kGrid)) return;
    const auto origin_node = node.member("origin"), edges_node = node.member("edges"),
               counts_node = node.member("counts");
    const auto origin = origin_node ? origin_node->vector() : std::nullopt;
    std::vector<Vec3> edges;
    if (edges_node) {
      for (const SceneNode& edge : edges_node->items(2, 2, "edges")) {
        if (const auto vector = edge.vector()) edges.push_back(*vector);
      }
    }
    std::vector<long> counts;
    if (counts_node) {
      for (const SceneNode& count : counts_node->items(2, 2, "integers")) {
        if (const auto value = count.integer(1, kMostAlong)) counts.push_back(*value);
      }
    }
    const std::string name = name_of(node);
    if (!origin || edges.size() != 2 || counts.size() != 2) return;
    const double sine = edges[0].normalized().cross(edges[1].normalized()).norm();
    if (!(sine > kLeastSine)) {
      edges_node->complain("found edges of length zero, or parallel ones, expected two that span a plane");
      return;
    }
    if (found.size() + static_cast<std::size_t>(counts[0] * counts[1]) > kMostSensors) {
      counts_node->complain("found more than " + std::to_string(kMostSensors) + " sensors in all, expected fewer");
      return;
    }
    for (Sensor& sensor : sensor_grid(name, scale_ * *origin, scale_ * edges[0], scale_ * edges[1],
                                      static_cast<int>(counts[0]), static_cast<int>(counts[1]))) {
      sensor.place = node.where();
      found.push_back(std::move(sensor));
    }
  }

  /// Edges nearer to parallel than this have lost their normal to the rounding of decimals.
  static constexpr double kLeastSine = 0x1p-30;

  double scene_unit_, scale_ = 1;
};

Result<std::vector<Sensor>> read_json(const fs::path& path, const std::string& text, double metres_per_unit) {
  const JsonDocument document = parse_json(text);
  const std::string name = path.string();
  SceneErrors errors;
  for (const JsonProblem& problem : document.problems) errors.add(0, name, problem);
  JsonSensors reader(metres_per_unit);
  if (document.complete) reader.read(SceneNode(document.root, 0, name, errors));
  if (errors.count() > 0) return Error{ErrorCode::invalid_input, errors.text()};
  return std::move(reader.found);
}

Result<std::vector<Sensor>> read_lines(const fs::path& path, const std::string& text) {
  ReadErrors errors(path.string());
  std::vector<Sensor> found;
  std::size_t number = 0;
  for (const std::string_view raw : lines_of(text)) {
    ++number;
    const std::vector<std::string_view> words = words_of(raw.substr(0, std::min(raw.find('#'), raw.size())), ",; \t");
    if (words.empty()) continue;
    if (errors.count() > ReadErrors::kMostLines) break;
    if (words.size() != 6) {
      errors.add(number, "found " + counted(words.size(), "word") +
                             ", expected six numbers: x, y, z and the three of the normal");
      continue;
    }
    double values[6] = {};
    bool all = true;
    for (std::size_t k = 0; k < 6; ++k) {
      const std::optional<double> value = parse_number(words[k]);
      all = all && value && std::abs(*value) <= kFarthestCoordinate;
      if (!value || std::abs(*value) > kFarthestCoordinate) {
        errors.add(number, "column " + std::to_string(k + 1) + ": found '" + shown(words[k]) +
                               "', expected a number of magnitude 1e50 at most");
      }
      values[k] = value.value_or(0);
    }
    if (!all) continue;
    const Vec3 normal(values[3], values[4], values[5]);
    const double size = normal.cwiseAbs().maxCoeff();
    if (!(size > 0)) {
      errors.add(number, "found a normal of length zero, expected a direction");
      continue;
    }
    if (found.size() == kMostSensors) {
      errors.add(number, "found more than " + std::to_string(kMostSensors) + " sensors, expected fewer");
      break;
    }
    // The name is the number among the sensors, as results count them.
    found.push_back({std::to_string(found.size()), Vec3(values[0], values[1], values[2]), (normal / size).normalized(),
                     printable(path.string()) + ":" + std::to_string(number)});
  }
  if (errors.count() > 0) return errors.error();
  if (found.empty()) return Error{ErrorCode::invalid_input, printable(path.string()) + ": holds no sensor"};
  return found;
}

std::string quoted_field(const std::string& name) {
  std::string text = "\"";
  for (const char c : printable(name)) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

template <class Three>
void append_three(std::string& line, const Three& values) {
  for (Eigen::Index c = 0; c < 3; ++c) line += ',' + shortest(values(c));
}

}  // namespace

Result<std::vector<Sensor>> read_sensors(const fs::path& path, double metres_per_unit) {
  const auto text = read_file(path);
  if (!text) return text.error();
  if (path.extension() == ".json") return read_json(path, *text, metres_per_unit);
  return read_lines(path, *text);
}

std::string sensors_csv(std::span<const Sensor> sensors, std::span<const SensorResult> results, double efficacy) {
  std::string text = "sensor,name,x,y,z,normal_x,normal_y,normal_z";
  for (const char* what : {"irradiance", "bound", "discretisation"}) {
    for (const char* channel : {"red", "green", "blue"}) text += std::string(",") + what + "_" + channel;
  }
  text += ",illuminance\n";
  for (std::size_t k = 0; k < sensors.size(); ++k) {
    text += std::to_string(k) + ',' + quoted_field(sensors[k].name);
    append_three(text, sensors[k].position);
    append_three(text, sensors[k].normal);
    append_three(text, results[k].irradiance);
    append_three(text, results[k].bound);
    if (results[k].discretisation) {
      append_three(text, *results[k].discretisation);
    } else {
      text += ",,,";
    }
    text += ',' + shortest(illuminance(results[k].irradiance, efficacy)) + '\n';
  }
  return text;
}

}  // namespace etendue
