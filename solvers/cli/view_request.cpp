// SPDX-License-Identifier: Apache-2.0
#include "view_request.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "etendue/io/read_errors.hpp"
#include "etendue/scene/camera_frame.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue::cli {

namespace {

constexpr int kMostSamples = 16;  // a side, 256 a pixel
constexpr double kLeastFov = 1e-6, kMostFov = 179.999;
constexpr long kLongestSide = 65536;
constexpr long kMostPixels = 1L << 28;

Error unusable(const std::string& option, const std::string& found, const std::string& expected) {
  return {ErrorCode::usage, "option '" + option + "': found '" + printable(found) + "', expected " + expected};
}

Result<Vec3> point(const std::string& option, const std::string& text) {
  const auto words = words_of(text, ",");
  Vec3 value;
  bool good = words.size() == 3 && std::count(text.begin(), text.end(), ',') == 2;
  for (std::size_t k = 0; good && k < 3; ++k) {
    const auto number = parse_number(words[k]);
    good = number && std::abs(*number) <= kFarthestCoordinate;
    if (good) value(static_cast<Eigen::Index>(k)) = *number;
  }
  if (!good) return unusable(option, text, "three numbers X,Y,Z");
  return value;
}

Result<Vec3> direction(const std::string& option, const std::string& text) {
  auto value = point(option, text);
  if (value && value->isZero(0)) return unusable(option, text, "a direction other than 0,0,0");
  return value;
}

Result<Done> resize(const std::string& text, Camera& camera) {
  const auto words = words_of(text, "x");
  const bool two = words.size() == 2 && std::count(text.begin(), text.end(), 'x') == 1;
  const auto columns = two ? parse_integer(words[0]) : std::nullopt;
  const auto rows = two ? parse_integer(words[1]) : std::nullopt;
  const auto fits = [](const std::optional<long>& side) { return side && *side >= 1 && *side <= kLongestSide; };
  if (!fits(columns) || !fits(rows) || *columns * *rows > kMostPixels) {
    return unusable("--resolution", text, "COLUMNSxROWS, each from 1 to 65536, at most 2^28 pixels in all");
  }
  camera.columns = static_cast<int>(*columns);
  camera.rows = static_cast<int>(*rows);
  return Done{};
}

/// The camera as the options change it: what they do not name stays.
Result<Done> change(const ViewRequest& request, Camera& camera) {
  if (request.eye) {
    const auto eye = point("--eye", *request.eye);
    if (!eye) return eye.error();
    camera.eye = *eye;
  }
  if (request.look_at) {
    const auto target = point("--look-at", *request.look_at);
    if (!target) return target.error();
    if (*target == camera.eye) return unusable("--look-at", *request.look_at, "another point than the eye's");
    camera.gaze = *target - camera.eye;
  }
  if (request.gaze) {
    const auto gaze = direction("--gaze", *request.gaze);
    if (!gaze) return gaze.error();
    camera.gaze = *gaze;
  }
  if (request.up) {
    const auto up = direction("--up", *request.up);
    if (!up) return up.error();
    camera.up = *up;
  }
  if (request.fov > 0) camera.horizontal_half_angle = request.fov / 2 * std::numbers::pi / 180;
  if (request.resolution) return resize(*request.resolution, camera);
  return Done{};
}

}  // namespace

void declare(Options& options, ViewRequest& request) {
  options.argument("SOLUTION", "NAME.json that 'etendue solve' wrote", request.solution);
  options.paths("--camera", "FILE",
                "look through the camera, or the cameras, of a JSON file, which may be a scene; repeatable (default:\n"
                "the camera of the scene that was solved)",
                request.cameras);
  options.text("--eye", "X,Y,Z", "where the camera stands; this and the next five change every camera", request.eye);
  options.text("--look-at", "X,Y,Z", "the point in the middle of the picture", request.look_at);
  options.text("--gaze", "X,Y,Z", "the direction to it, instead", request.gaze);
  options.text("--up", "X,Y,Z", "what appears upwards", request.up);
  options.real("--fov", "DEG", "the whole horizontal angle", request.fov, kLeastFov, kMostFov);
  options.text("--resolution", "CxR", "columns x rows of the picture: 640x400", request.resolution);
  options.choice("--method", {"raster", "raytrace", "gather"},
                 "draw the elements into a depth buffer (default), or follow a ray through each sample; the same\n"
                 "picture up to the outlines, where the first snaps to 1/4096 of a pixel. gather: by rays, and what\n"
                 "arrives at each point is gathered with exact factors: shadows finer than the elements; slow",
                 request.method);
  options.flag("--mesh", "draw the outlines of the elements into the PNG", request.draw_mesh);
  options.flag("--ambient", "add the ambient term, of a solution that was found with --ambient", request.ambient);
  options.path("--scene", "FILE", "refuse a solution of another scene than this, or of this before it was changed",
               request.scene);
  add_tone(options, request.tone, "as solve found it, the same for every view");
  options.integer("--samples", "N", "N × N samples a pixel (default: 3)", request.samples, 1, kMostSamples);
  options.paths("--output", "FILE",
                "NAME.exr or NAME.png: both are written. Given once for each camera, in turn; or once for several,\n"
                "which then are NAME-CAMERA (default: SOLUTION-view, in this folder)",
                request.outputs);
  options.alias("-o", "--output");
  add_running(options, request.common);
  options.note(
      "Nothing is solved again: the solution does not depend on the view. The EXR holds radiosities [W/m²], the PNG "
      "shows\n"
      "them. A surface shows its front only, so a camera outside a room sees through the back of the nearest wall.\n"
      "The pictures of a run appear together or not at all. Details: docs/view.md");
  options.example("etendue view furnace.json --eye 0.2,0.3,1.2 --look-at 2,3,0 --output furnace-corner.png");
}

std::optional<std::string> contradiction(const ViewRequest& request) {
  if (request.look_at && request.gaze) return "--look-at and --gaze: expected one of them";
  if (request.ambient && request.method == "gather") {
    return "--ambient stands in for light that is unshot, and belongs to values at corners: not with --method gather";
  }
  return contradiction(request.tone);
}

Result<std::vector<NamedCamera>> cameras_of(const ViewRequest& request, const Scene& scene) {
  std::vector<NamedCamera> all;
  for (const auto& path : request.cameras) {
    auto some = read_cameras(path, scene.metres_per_unit);
    if (!some) return some.error();
    all.insert(all.end(), some->begin(), some->end());
  }
  if (request.cameras.empty()) all.push_back({"", scene.camera});
  for (NamedCamera& one : all) {
    if (const auto changed = change(request, one.camera); !changed) return changed.error();
    const auto frame = camera_frame(one.camera);
    if (!frame) {
      return Error{ErrorCode::usage, (one.name.empty() ? "" : "camera '" + one.name + "': ") + frame.error().message};
    }
  }
  return all;
}

}  // namespace etendue::cli
