// SPDX-License-Identifier: Apache-2.0
#include "ray_tree_output.hpp"

#include <charconv>

#include "etendue/core/version.hpp"
#include "etendue/raytracing/camera_rays.hpp"
#include "report_json.hpp"

namespace etendue::cli {

namespace {

const char* word(RayKind kind) {
  return kind == RayKind::eye ? "eye" : kind == RayKind::reflected ? "reflected" : "transmitted";
}

const char* word(RayEnd end) {
  switch (end) {
    case RayEnd::surface:
      return "surface";
    case RayEnd::left_scene:
      return "left scene";
    case RayEnd::depth_limit:
      return "depth limit";
    case RayEnd::below_cutoff:
      return "below cutoff";
    case RayEnd::environment:
      return "environment";
  }
  return "unknown";
}

}  // namespace

std::optional<Pixel> read_pixel(const std::string& text, const Camera& camera) {
  int column = 0, row = 0;
  const char* const end = text.data() + text.size();
  const auto [comma, first] = std::from_chars(text.data(), end, column);
  if (first != std::errc{} || comma == end || *comma != ',') return std::nullopt;
  const auto [rest, second] = std::from_chars(comma + 1, end, row);
  if (second != std::errc{} || rest != end) return std::nullopt;
  if (column < 0 || column >= camera.columns || row < 0 || row >= camera.rows) return std::nullopt;
  return Pixel{column, row};
}

Result<RayTree> pixel_tree(const Accelerator& accelerator, const Pixel& pixel, const TreeLimits& limits,
                           double wavelength) {
  const Camera& camera = accelerator.scene().camera;
  const auto frame = camera_frame(camera);
  if (!frame) return frame.error();
  const Ray ray = eye_ray(*frame, picture_point(camera, pixel.column, pixel.row));
  return trace(ray, accelerator, limits, {media_around(frame->eye, accelerator), wavelength});
}

std::string ray_tree_json(const RayTree& tree, const SceneFile& file, const Pixel& pixel, const TreeLimits& limits) {
  Json report;
  report["program"] = std::string("etendue ") + version();
  report["scene"] = {{"file", file.files.back().string()}, {"name", file.scene.name}, {"hash", file.hash}};
  report["pixel"] = {pixel.column, pixel.row};
  report["settings"] = {{"depth", limits.depth}, {"cutoff", limits.cutoff}};
  if (tree.wavelength > 0) report["settings"]["wavelength_nm"] = tree.wavelength;
  report["rays"] = Json::array();
  const auto names = ray_names(tree);
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const RayNode& node = tree.nodes[i];
    Json ray{{"name", names[i]},
             {"kind", word(node.kind)},
             {"level", node.level},
             {"parent", node.parent == RayNode::kNone ? Json(nullptr) : Json(node.parent)},
             {"coefficient", node.coefficient},
             {"weight", node.weight},
             {"origin", triple(node.ray.origin)},
             {"direction", triple(node.ray.direction)},
             {"begins_at", node.ray.t_min},
             {"medium", node.medium ? Json(file.scene.materials[*node.medium].name) : Json(nullptr)},
             {"end", word(node.end)}};
    if (node.end == RayEnd::surface) {
      ray["object"] = {{"index", node.hit->object}, {"name", file.scene.objects[node.hit->object].name}};
      ray["point"] = triple(node.hit->hit.point);
      ray["length"] = node.length;
    }
    report["rays"].push_back(std::move(ray));
  }
  report["tests"] = {{"surfaces", tree.tests.surfaces}, {"boxes", tree.tests.volumes}};
  return dumped(report, 2) + "\n";
}

}  // namespace etendue::cli
