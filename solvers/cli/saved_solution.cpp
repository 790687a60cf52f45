// SPDX-License-Identifier: Apache-2.0
#include "saved_solution.hpp"

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "etendue/io/atomic_file.hpp"
#include "etendue/io/read_errors.hpp"
#include "etendue/scene/camera_frame.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue::cli {

namespace {

using Json = nlohmann::json;

constexpr int kMostPixels = 65536;  // along an edge, as a scene's "resolution"

/// What is wrong with a datum of the file; caught where the file's name is known.
struct Damage {
  std::string what;
};

double number(const Json& json, double low, double high, const std::string& name) {
  if (!json.is_number()) throw Damage{name + ": not a number"};
  const auto value = json.get<double>();
  if (!(value >= low && value <= high)) throw Damage{name + ": " + json.dump() + " is out of range"};
  return value;
}

Eigen::Array3d three(const Json& json, double low, const std::string& name) {
  if (!json.is_array() || json.size() != 3) throw Damage{name + ": not three numbers"};
  Eigen::Array3d all;
  for (Eigen::Index k = 0; k < 3; ++k) {
    all(k) = number(json[static_cast<std::size_t>(k)], low, kFarthestCoordinate, name);
  }
  return all;
}

Eigen::Array3d any_three(const Json& json, const std::string& name) {
  return three(json, -kFarthestCoordinate, name);
}

Camera read_view(const Json& json) {
  Camera camera;
  camera.eye = any_three(json.at("eye"), "camera");
  camera.gaze = any_three(json.at("gaze"), "camera");
  camera.up = any_three(json.at("up"), "camera");
  camera.horizontal_half_angle = number(json.at("horizontal_half_angle"), 0, 2, "camera");
  camera.columns = static_cast<int>(number(json.at("resolution").at(0), 1, kMostPixels, "camera"));
  camera.rows = static_cast<int>(number(json.at("resolution").at(1), 1, kMostPixels, "camera"));
  if (const auto frame = camera_frame(camera); !frame) throw Damage{"camera: " + frame.error().message};
  return camera;
}

Polygon polygon(const Json& json, const std::string& name) {
  std::vector<Vec3> corners;
  for (const Json& corner : json) corners.push_back(any_three(corner, name));
  auto made = Polygon::make(std::move(corners));
  if (!made) throw Damage{name + ": " + made.error().message};
  return std::move(made).value();
}

std::size_t face_index(const Json& json, const ElementMesh& mesh, const std::string& name) {
  const double index = number(json, 0, 1e15, name);
  if (!(index < static_cast<double>(mesh.faces.size()))) throw Damage{name + ": there is no face " + json.dump()};
  return static_cast<std::size_t>(index);
}

void read_faces(const Json& file, ElementMesh& mesh) {
  for (const Json& face : file.at("faces")) {
    mesh.faces.push_back({polygon(face, "face " + std::to_string(mesh.faces.size())), 0, 0});
  }
  for (const Json& json : file.at("contacts")) {
    const std::string name = "contact " + std::to_string(mesh.contacts.size());
    mesh.contacts.push_back(
        {face_index(json.at(0), mesh, name), {any_three(json.at(1), name), any_three(json.at(2), name)}});
  }
}

/// Adds elements to a solution; the materials are those that elements name.
class Elements {
 public:
  explicit Elements(SavedSolution& solution) : solution_(solution) {}

  void add(const Json& json) {
    const std::size_t k = solution_.mesh.elements.size();
    const std::string name = "element " + std::to_string(k);
    const Json& radiosity = json.at("radiosity");
    if (radiosity.is_array() && radiosity.size() == 3 && (radiosity[0].is_null() || radiosity[2].is_null())) {
      throw Damage{"stopped before all channels were solved; there is nothing to view"};
    }
    const std::size_t face = face_index(json.at("face"), solution_.mesh, name);
    solution_.mesh.faces[face].material = material_of(json, name);
    if (objects_.size() <= face) objects_.resize(solution_.mesh.faces.size());
    objects_[face] = json.at("object").get<std::string>();
    solution_.mesh.elements.push_back({polygon(json.at("vertices"), name), face, 0});
    solution_.radiosity.push_back(any_three(radiosity, name));
    if (json.value("covered", false)) solution_.covered.push_back(k);
  }

  /// Faces that follow one another and have one object's name are an object's.
  void number_objects() {
    for (std::size_t f = 1; f < objects_.size(); ++f) {
      solution_.mesh.faces[f].object = solution_.mesh.faces[f - 1].object + (objects_[f] != objects_[f - 1] ? 1 : 0);
    }
  }

 private:
  std::size_t material_of(const Json& json, const std::string& name) {
    const auto called = json.at("material").get<std::string>();
    const auto [found, fresh] = materials_.emplace(called, solution_.scene.materials.size());
    if (fresh) {
      Material material;
      material.name = called;
      material.rho = three(json.at("reflectance"), 0, name);
      material.emission = three(json.at("emission"), 0, name);
      solution_.scene.materials.push_back(material);
    }
    return found->second;
  }

  SavedSolution& solution_;
  std::map<std::string, std::size_t> materials_;
  std::vector<std::string> objects_;  ///< of each face
};

SavedSolution taken(const Json& file) {
  SavedSolution solution;
  const Json& scene = file.at("scene");
  solution.scene.name = scene.at("name").get<std::string>();
  solution.scene.metres_per_unit = number(scene.at("metres_per_unit"), 1e-9, 1e9, "metres_per_unit");
  solution.hash = scene.at("hash").get<std::string>();
  solution.method = file.at("method").get<std::string>();
  const auto status = file.at("status").get<std::string>();
  solution.finished = status != "stopped";
  if (!file.contains("camera") || !file.contains("faces")) {
    if (!solution.finished) throw Damage{"stopped before anything was solved; there is nothing to view"};
    throw Damage{"an earlier version wrote it, without what a view needs; solve the scene again"};
  }
  solution.scene.camera = read_view(file.at("camera"));
  solution.scene.background = three(file.at("camera").at("background"), 0, "background");
  if (file.contains("ambient")) solution.ambient = three(file.at("ambient"), 0, "ambient");
  if (file.contains("exposure")) solution.exposure = number(file.at("exposure"), 0, 1e300, "exposure");
  read_faces(file, solution.mesh);
  Elements elements(solution);
  for (const Json& element : file.at("elements")) {
    if (!element.contains("radiosity")) throw Damage{"stopped before anything was solved; there is nothing to view"};
    elements.add(element);
  }
  elements.number_objects();
  if (solution.mesh.elements.empty()) throw Damage{"no element"};
  return solution;
}

}  // namespace

Result<SavedSolution> read_saved_solution(const std::filesystem::path& path) {
  const auto wrong = [&](const std::string& what) {
    return Error{ErrorCode::invalid_input, quoted_path(path) + ": " + what};
  };
  const auto text = read_file(path);
  if (!text) return text.error();
  const Json file = Json::parse(*text, nullptr, false);
  if (file.is_discarded()) return wrong("no solution: not JSON, or cut short");
  if (file.is_object() && file.contains("format")) {
    return wrong("a scene, no solution; 'etendue solve' makes NAME.json of it, which can be viewed");
  }
  const bool known = file.is_object() && file.contains("scene") && file.contains("elements") && file.contains("method");
  if (!known) return wrong("no solution that etendue solve wrote (NAME.json)");
  try {
    return taken(file);
  } catch (const Damage& damage) {
    return wrong(damage.what);
  } catch (const Json::exception& failure) {
    return wrong(std::string("damaged: ") + failure.what());
  }
}

}  // namespace etendue::cli
