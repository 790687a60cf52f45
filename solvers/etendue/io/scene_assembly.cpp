// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/scene_assembly.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <utility>

#include "etendue/io/camera_file.hpp"
#include "etendue/io/curved_shape_reader.hpp"
#include "etendue/io/material_reader.hpp"
#include "etendue/io/nearest.hpp"
#include "etendue/io/shape_reader.hpp"
#include "etendue/io/spectrum_reader.hpp"
#include "etendue/meshing/division.hpp"
#include "etendue/raytracing/shading_normal.hpp"

namespace etendue {

namespace {

constexpr std::size_t kAnyCount = std::numeric_limits<std::size_t>::max();

class Assembly {
 public:
  Assembly(const LoadedFiles& files, TextureFiles& textures, EnvironmentFiles& environments, SceneErrors& errors)
      : files_(files), textures_(textures), environments_(environments), errors_(errors) {}

  Scene build() {
    for (const LoadedFile& file : files_.files) {
      textures_.look_in(std::filesystem::path(file.name).parent_path());
      environments_.look_in(std::filesystem::path(file.name).parent_path());
      if (file.sound) read_materials(node_of(file), scale_of(file));
    }
    for (const LoadedFile& file : files_.files) {
      if (file.sound) read_contents(file);
    }
    return std::move(scene_);
  }

 private:
  SceneNode node_of(const LoadedFile& file) const {
    return SceneNode(file.document.root, file.index, file.name, errors_);
  }

  /// Lengths come out in the main file's unit.
  double scale_of(const LoadedFile& file) const {
    const double main_unit = files_.files.back().metres_per_unit;
    return file.metres_per_unit == main_unit ? 1 : file.metres_per_unit / main_unit;
  }

  void read_materials(const SceneNode& top, double scale) {
    const auto materials = top.member("materials");
    if (!materials || !materials->is_object()) return;
    for (const auto& [name, node] : materials->members()) {
      if (!material_index_.emplace(name, scene_.materials.size()).second) {
        node.complain("found a material of a name that an included file has taken, expected another name");
      }
      scene_.materials.push_back(read_material(node, name, scale, textures_));
      if (const auto images = node.member("environment")) read_environment(*images, scene_.materials.back());
    }
  }

  void read_environment(const SceneNode& images, Material& material) {
    if (!(material.k_r > 0 || (material.fresnel && material.k_t > 0))) {
      images.complain("found \"environment\" without \"k_r\", expected a \"k_r\" above 0: so much of it is mirrored");
    }
    material.environment = environments_.read(images);
  }

  void read_contents(const LoadedFile& file) {
    const SceneNode top = node_of(file);
    const bool is_main = file.index == 0;
    if (const auto node = top.member("name")) {
      const auto name = node->text();
      if (is_main && name) scene_.name = *name;
    }
    if (is_main) {
      read_view(top, file);
    } else {
      for (const char* key : {"camera", "background", "ambient", "illuminant", "align_mesh"}) {
        if (const auto node = top.member(key))
          node->complain("found this in an included file, expected it in the main file only");
      }
    }
    const double scale = scale_of(file);
    const Placement placement = scale == 1 ? Placement{} : uniform_scale(scale);
    file_scale_ = placement.scale;
    if (const auto lights = top.member("lights")) read_lights(*lights, placement);
    if (const auto objects = top.member("objects")) read_objects(*objects, placement, "");
    // Included files may hold objects, and errors may be why none was read from them.
    const bool all_read = !top.member("include") || (files_.complete && errors_.count() == 0);
    if (is_main && scene_.objects.empty() && !top.member("objects") && all_read) {
      top.complain("found no object in the scene, expected \"objects\" here or in an included file");
    }
  }

  void read_view(const SceneNode& top, const LoadedFile& file) {
    scene_.metres_per_unit = file.metres_per_unit;
    if (const auto node = top.member("background"))
      scene_.background = node->colour(kNonNegative).value_or(Rgb::Zero());
    if (const auto node = top.member("ambient")) scene_.ambient = node->colour(kNonNegative).value_or(Rgb::Zero());
    scene_.illuminant = illuminant_of(top);
    if (const auto node = top.member("align_mesh")) scene_.align_mesh = node->truth().value_or(false);
    if (const auto node = top.member("camera")) {
      scene_.camera = read_camera(*node);
    } else {
      top.complain("found no key \"camera\", expected one: it is mandatory in the main file");
    }
  }

  /// Daylight, where surfaces want one and none is given.
  std::optional<Illuminant> illuminant_of(const SceneNode& top) const {
    if (const auto node = top.member("illuminant")) return read_illuminant(*node);
    const auto& materials = scene_.materials;
    const bool spectral = std::any_of(materials.begin(), materials.end(),
                                      [](const Material& material) { return material.reflectance.has_value(); });
    return spectral ? std::optional(illuminant(through_table(daylight_d65()))) : std::nullopt;
  }

  void read_lights(const SceneNode& lights, const Placement& placement) {
    for (const SceneNode& node : lights.items(0, kAnyCount, "lights")) {
      if (auto light = read_light(node, placement)) scene_.lights.push_back(*light);
    }
  }

  void read_objects(const SceneNode& objects, const Placement& placement, const std::string& prefix) {
    for (SceneNode node : objects.items(1, kAnyCount, "objects")) {
      if (const JsonMember* name = node.json().find("name"); name && name->value.kind == JsonValue::Kind::string)
        node.belongs_to(prefix + name->value.text);
      read_object(node, placement, prefix);
    }
  }

  void read_object(const SceneNode& node, const Placement& outer, const std::string& prefix) {
    const auto type = node.kind(object_types());
    if (!type) return read_without_type(node, outer, prefix);
    if (!node.is(keys_of(*type))) return;
    const auto name_node = node.member("name");
    const std::string name = prefix + (name_node ? name_node->text().value_or("") : node.pointer());
    const auto transform = node.member("transform");
    const Placement placement = transform ? compose(outer, read_transform(*transform)) : outer;
    const Vec3 velocity = velocity_ + read_velocity(node, placement);
    if (*type == "group") {
      const Vec3 of_others = std::exchange(velocity_, velocity);
      if (const auto children = node.member("children"))
        read_objects(*children, placement, name_node ? name + "/" : prefix);
      velocity_ = of_others;
      return;
    }
    const auto material = read_material_name(node);
    const Subdivision subdivision = read_subdivision(node);
    const auto caps_node = node.member("caps");
    const bool closed = caps_node && caps_node->truth().value_or(false);
    auto shape = read_shape(node, *type, placement);
    if (!shape || !material) return;
    const auto& bump = scene_.materials[*material].bump;
    if (bump && !bump->lay && (closed || !has_chart(*shape))) {
      node.complain("found a material whose \"bump\" has no \"size\", expected one: " +
                    std::string(closed ? "the caps have no coordinates" : "a " + *type + " has no coordinates") +
                    " u and v of its own");
    }
    const auto caps = closed ? caps_of(*shape) : std::vector<Cap>{};
    const OwnCoordinates own = own_coordinates(placement);
    scene_.objects.push_back({name, std::move(*shape), *material, subdivision, node.where(), velocity, own});
    for (const Cap& cap : caps) {
      scene_.objects.push_back({name + "/" + cap.end, cap.disc, *material, subdivision, node.where(), velocity, own});
    }
  }

  /// An object of unknown kind, read for its errors: what objects of all kinds have, numbers of shapes, children.
  void read_without_type(const SceneNode& node, const Placement& outer, const std::string& prefix) {
    if (!node.is(keys_of_any(object_types()))) return;
    if (const auto name = node.member("name")) (void)name->text();  // reported there, and so on
    if (const auto transform = node.member("transform")) (void)read_transform(*transform);
    (void)read_velocity(node, outer);
    (void)read_material_name(node);
    (void)read_subdivision(node);
    read_numbers_of_shapes(node);
    if (const auto children = node.member("children")) read_objects(*children, outer, prefix);
  }

  /// The way back, but in lengths of the scene, whatever the unit of the file.
  OwnCoordinates own_coordinates(const Placement& placement) const {
    return {file_scale_ * placement.linear.inverse(), placement.offset};
  }

  /// In the coordinates of the object's own numbers: turned and scaled with them.
  static Vec3 read_velocity(const SceneNode& node, const Placement& placement) {
    const auto member = node.member("velocity");
    const auto velocity = member ? member->vector() : std::nullopt;
    return velocity ? placement.vector(*velocity) : Vec3::Zero();
  }

  std::optional<std::size_t> read_material_name(const SceneNode& node) {
    const auto member = node.member("material");
    const auto name = member ? member->text() : std::nullopt;
    if (!name) return std::nullopt;
    const auto found = material_index_.find(*name);
    if (found != material_index_.end()) return found->second;
    if (!files_.complete) return std::nullopt;  // it may stand in the file that could not be read, which was reported
    std::vector<std::string> known;
    for (const auto& [material, index] : material_index_) known.push_back(material);
    member->expected("a material of this scene" + did_you_mean(*name, known));
    return std::nullopt;
  }

  Subdivision read_subdivision(const SceneNode& node) const {
    Subdivision subdivision;
    const auto elements_node = node.member("elements"), patches_node = node.member("patches");
    const auto size_node = node.member("element_size");
    const auto size = size_node ? size_node->number(kPositive) : std::nullopt;
    if (size_node && elements_node) {
      size_node->complain("found \"element_size\" beside \"elements\", expected one of them");
    }
    if (size) subdivision.element_size = file_scale_ * *size;
    const auto read = [](const std::optional<SceneNode>& counts) {
      return counts ? read_two(*counts, "integers", kMostElementsAlong) : std::pair(1, 1);
    };
    const auto elements = read(elements_node), patches = read(patches_node);
    if (const auto grading = node.member("grading")) subdivision.grading = grading->number(kFraction).value_or(0);
    if (!elements || !patches) return subdivision;
    if (static_cast<long>(elements->first) * elements->second > kMostElements) {
      elements_node->complain("found more than " + std::to_string(kMostElements) + " elements, expected fewer");
    }
    const bool divide = elements->first % patches->first == 0 && elements->second % patches->second == 0;
    if (!size_node && !divide) {
      patches_node->complain("found [" + std::to_string(patches->first) + ", " + std::to_string(patches->second) +
                             "], expected divisors of the elements [" + std::to_string(elements->first) + ", " +
                             std::to_string(elements->second) + "]");
    }
    subdivision.elements[0] = elements->first;
    subdivision.elements[1] = elements->second;
    subdivision.patches[0] = patches->first;
    subdivision.patches[1] = patches->second;
    return subdivision;
  }

  const LoadedFiles& files_;
  TextureFiles& textures_;
  EnvironmentFiles& environments_;
  SceneErrors& errors_;
  Scene scene_;
  Vec3 velocity_ = Vec3::Zero();  ///< of the groups that are read
  double file_scale_ = 1;         ///< from lengths of the file that is read to those of the scene
  std::map<std::string, std::size_t> material_index_;
};

}  // namespace

Scene assemble_scene(const LoadedFiles& files, TextureFiles& textures, EnvironmentFiles& environments,
                     SceneErrors& errors) {
  return Assembly(files, textures, environments, errors).build();
}

}  // namespace etendue
