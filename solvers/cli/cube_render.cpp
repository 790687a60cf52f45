// SPDX-License-Identifier: Apache-2.0
#include "cube_render.hpp"

#include <algorithm>
#include <numbers>
#include <ostream>
#include <vector>

#include "etendue/io/nearest.hpp"
#include "etendue/reflectance/cube_names.hpp"
#include "etendue/text/utf8.hpp"
#include "outputs.hpp"

namespace etendue::cli {

Result<Done> hide(const std::string& name, Scene& scene) {
  const auto is_meant = [&](const Object& object) {
    return object.name == name || object.name.compare(0, name.size() + 1, name + "/") == 0;
  };
  std::vector<std::string> names;
  for (const Object& object : scene.objects) names.push_back(object.name);
  if (std::erase_if(scene.objects, is_meant) == 0) {
    return Error{ErrorCode::usage, "option '--hide': found '" + printable(name) +
                                       "', expected the name of an object or a group" + did_you_mean(name, names)};
  }
  return Done{};
}

std::array<RenderRequest, 6> cube_requests(const RenderRequest& request) {
  std::array<RenderRequest, 6> all;
  const std::string stem = output_stem(request.common.output, request.scene).string();
  for (std::size_t f = 0; f < all.size(); ++f) {
    all[f] = request;
    all[f].common.output = stem + "." + face_name(kCubeFaces[f]) + ".exr";
  }
  return all;
}

int render_cube(const RenderRequest& request, SceneFile file, std::ostream& out,
                const std::function<int(const RenderRequest&, const SceneFile&)>& picture) {
  Camera& camera = file.scene.camera;
  camera.eye = *request.cube_eye;
  camera.horizontal_half_angle = std::numbers::pi / 4;
  camera.rows = camera.columns;
  camera.lens_radius = 0;
  const auto requests = cube_requests(request);
  for (std::size_t f = 0; f < requests.size(); ++f) {
    const CubeView view = cube_view(kCubeFaces[f]);
    camera.gaze = view.gaze;
    camera.up = view.up;
    if (request.common.json) out << (f == 0 ? "[\n" : ",\n");
    if (const int code = picture(requests[f], file); code != 0) return code;
  }
  if (request.common.json) out << "]\n";
  return 0;
}

}  // namespace etendue::cli
