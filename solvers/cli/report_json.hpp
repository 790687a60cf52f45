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
