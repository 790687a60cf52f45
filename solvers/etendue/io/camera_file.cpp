// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/camera_file.hpp"

#include <algorithm>
#include <cctype>
#include <numbers>

#include "etendue/io/atomic_file.hpp"
#include "etendue/io/scene_files.hpp"
#include "etendue/io/scene_reader.hpp"
#include "etendue/scene/camera_frame.hpp"

namespace etendue {

namespace {

/// 2^28 pixels, what an image file may have (io/image_file.cpp); 65536 on one side.
constexpr long kMostPixels = 1L << 28;
constexpr long kLongestSide = 65536;
/// Of one file: each is a picture.
constexpr std::size_t kMostCameras = 1000;

const KeySet& keys_of_cameras() {
  static const KeySet keys{"cameras", {"cameras"}, {"comment", "unit"}};
  return keys;
}

void read_resolution(const SceneNode& node, Camera& camera) {
  const auto sides = read_two(node, "integers (columns, rows)", kLongestSide);
  if (!sides) return;
  if (static_cast<long>(sides->first) * sides->second > kMostPixels) {
    node.complain("found " + std::to_string(sides->first) + " x " + std::to_string(sides->second) +
                  " pixels, expected at most " + std::to_string(kMostPixels));
    return;
  }
  camera.columns = sides->first;
  camera.rows = sides->second;
}

void read_gaze(const SceneNode& node, Camera& camera) {
  const auto look_at = node.member("look_at"), gaze = node.member("gaze");
  if (look_at.has_value() == gaze.has_value()) {
    node.complain(std::string("found ") + (gaze ? "both \"look_at\" and" : "neither \"look_at\" nor") +
                  " \"gaze\", expected one of them");
  }
  if (gaze) camera.gaze = gaze->direction().value_or(camera.gaze);
  if (!look_at) return;
  const auto target = look_at->vector();
  if (target && *target == camera.eye) look_at->complain("found the point of \"eye\", expected another point");
  if (target) camera.gaze = *target - camera.eye;
}

/// Lens and shutter; a lens needs to know what is sharp.
void read_exposure(const SceneNode& node, Camera& camera) {
  const auto lens = node.member("lens_radius"), focal = node.member("focal_distance"), shutter = node.member("shutter");
  if (shutter) camera.shutter = shutter->number(kNonNegative).value_or(0);
  if (lens) camera.lens_radius = lens->number(kNonNegative).value_or(0);
  if (focal) camera.focal_distance = focal->number(kPositive).value_or(1);
  if (camera.lens_radius > 0 && !focal)
    lens->complain("found a lens without \"focal_distance\", expected it: how far away is sharp");
}

bool names_a_file(const std::string& name) {
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_';
  });
}

/// What a camera is called that has no name of its own: as its file, as far as that makes the name of another file.
std::string name_of(const std::filesystem::path& path) {
  const std::string stem = path.stem().string();
  return names_a_file(stem) ? stem : "camera";
}

std::vector<NamedCamera> read_named(const SceneNode& top, double metres_per_unit) {
  std::vector<NamedCamera> all;
  if (!top.is(keys_of_cameras())) return all;
  double scale = 1;
  if (const auto unit = top.member("unit")) scale = read_unit(*unit).value_or(1) / metres_per_unit;
  const auto cameras = top.member("cameras");
  if (!cameras || !cameras->is_object()) return all;
  for (const auto& [name, node] : cameras->members()) {
    if (!names_a_file(name)) {
      node.complain("found a camera whose name makes no name of a file, expected letters, digits, '-' and '_'");
    }
    all.push_back({name, read_camera(node)});
    all.back().camera.eye *= scale;
    all.back().camera.lens_radius *= scale;
    all.back().camera.focal_distance *= scale;
  }
  if (all.empty() || all.size() > kMostCameras) {
    cameras->complain("found " + std::to_string(all.size()) + " cameras, expected 1 to " +
                      std::to_string(kMostCameras));
  }
  return all;
}

}  // namespace

std::optional<std::pair<int, int>> read_two(const SceneNode& node, const std::string& what, long most) {
  const auto nodes = node.items(2, 2, what);
  std::vector<int> counts;
  for (const SceneNode& one : nodes) {
    if (const auto count = one.integer(1, most)) counts.push_back(static_cast<int>(*count));
  }
  if (nodes.size() != 2 || counts.size() != 2) return std::nullopt;
  return std::pair(counts[0], counts[1]);
}

Camera read_camera(const SceneNode& node) {
  Camera camera;
  if (!node.is(keys_of("camera"))) return camera;
  const std::size_t errors_before = node.errors().count();
  if (const auto eye = node.member("eye")) camera.eye = eye->vector().value_or(camera.eye);
  if (const auto up = node.member("up")) camera.up = up->direction().value_or(camera.up);
  if (const auto angle = node.member("horizontal_fov_deg")) {
    const auto degrees = angle->number({0, 180, true, true});
    if (degrees) camera.horizontal_half_angle = *degrees / 2 * std::numbers::pi / 180;
  }
  if (const auto resolution = node.member("resolution")) read_resolution(*resolution, camera);
  read_exposure(node, camera);
  read_gaze(node, camera);
  if (node.errors().count() > errors_before) return camera;
  if (const auto frame = camera_frame(camera); !frame) node.complain(frame.error().message);
  return camera;
}

Result<std::vector<NamedCamera>> read_cameras(const std::filesystem::path& path, double metres_per_unit) {
  const auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  const JsonDocument document = parse_json(*bytes);
  SceneErrors errors;
  const std::string name = path.string();
  for (const JsonProblem& problem : document.problems) errors.add(0, name, problem);
  std::vector<NamedCamera> all;
  if (document.complete) {
    const SceneNode top(document.root, 0, name, errors);
    if (document.root.find("format")) {
      auto file = read_scene(path);
      if (!file) return file.error();
      all.push_back({name_of(path), file->scene.camera});
      const double other = file->scene.metres_per_unit / metres_per_unit;
      all.back().camera.eye *= other;
      all.back().camera.lens_radius *= other;
      all.back().camera.focal_distance *= other;
    } else if (document.root.find("cameras")) {
      all = read_named(top, metres_per_unit);
    } else {
      all.push_back({name_of(path), read_camera(top)});
    }
  }
  if (errors.count() > 0) return Error{ErrorCode::invalid_input, errors.text()};
  return all;
}

}  // namespace etendue
