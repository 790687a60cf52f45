// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "solve_parts.hpp"

// What the JSON reports of all commands are made of.
namespace etendue::cli {

using Json = nlohmann::ordered_json;

inline constexpr const char* kChannels[] = {"red", "green", "blue"};

template <class Three>
Json triple(const Three& v) {
  return Json::array({v(0), v(1), v(2)});
}

/// JSON has no infinity: a bound that does not exist is null.
inline Json finite_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// All beyond ASCII escaped: names that a terminal would take for a command pass it, a reader gets them back.
/// @param indent of a level; −1: all in one line
inline std::string dumped(const Json& json, int indent = 1) {
  return json.dump(indent, ' ', true, Json::error_handler_t::replace);
}

/// A scene as reports name it.
inline Json scene_json(const SceneFile& file) {
  return {{"name", file.scene.name}, {"hash", file.hash}, {"metres_per_unit", file.scene.metres_per_unit}};
}

/// What a view needs beside the elements: to the last bit, so not as scene files have it.
inline Json view_json(const Scene& scene) {
  const Camera& camera = scene.camera;
  return {{"eye", triple(camera.eye)},
          {"gaze", triple(camera.gaze)},
          {"up", triple(camera.up)},
          {"horizontal_half_angle", camera.horizontal_half_angle},
          {"resolution", {camera.columns, camera.rows}},
          {"background", triple(scene.background)}};
}

/// What a view needs of a mesh beside its elements: the corners of each face.
inline Json faces_json(const ElementMesh& mesh) {
  Json all = Json::array();
  for (const Face& face : mesh.faces) {
    Json corners = Json::array();
    for (const Vec3& vertex : face.polygon.vertices()) corners.push_back(triple(vertex));
    all.push_back(corners);
  }
  return all;
}

/// And where its elements were cut: faces, and two ends.
inline Json contacts_json(const ElementMesh& mesh) {
  Json all = Json::array();
  for (const Contact& contact : mesh.contacts) {
    all.push_back({contact.face, triple(contact.segment.from), triple(contact.segment.to)});
  }
  return all;
}

/// Where the scene lies, and what `etendue solve` has written.
inline Json files_json(const std::filesystem::path& scene, const SolutionFiles& files) {
  Json json{{"scene", scene.string()}, {"json", files.json.string()}};
  if (!files.png.empty()) {
    json["exr"] = files.exr.string();
    json["png"] = files.png.string();
  }
  for (const auto& path : files.written) json["written"].push_back(path.string());
  return json;
}

}  // namespace etendue::cli
