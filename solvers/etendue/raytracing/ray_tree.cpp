// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/ray_tree.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "etendue/core/contract.hpp"
#include "etendue/geometry/spawn.hpp"
#include "etendue/optics/absorption.hpp"
#include "etendue/optics/fresnel.hpp"
#include "etendue/optics/frost.hpp"
#include "etendue/optics/reflect.hpp"
#include "etendue/optics/refract.hpp"
#include "etendue/raytracing/shading_normal.hpp"
#include "etendue/reflectance/bump.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

thread_local std::vector<RayNode> spare_nodes;  // of recycle(); empty

/// How a material shares out what comes along global rays.
struct Shares {
  double reflected, transmitted;
};

class TreeBuilder {
 public:
  TreeBuilder(const Accelerator& accelerator, const TreeLimits& limits, const RayStart& start)
      : accelerator_(accelerator), scene_(accelerator.scene()), limits_(limits), key_(start.key) {
    tree_.wavelength = start.wavelength;
    tree_.nodes = std::exchange(spare_nodes, {});
  }

  /// Of the tree that begins with this ray.
  void begin(const Ray& ray, const Media& media) {
    RayNode& root = tree_.nodes.emplace_back();
    root.ray = ray;
    root.media = media;
    follow(0);
  }

  RayTree take() { return std::move(tree_); }

 private:
  void follow(std::size_t i) {
    RayNode& node = tree_.nodes[i];
    if (const auto body = node.media.present(scene_)) node.medium = body->material;
    if (node.level > limits_.depth) {
      node.end = RayEnd::depth_limit;
    } else if (node.weight < limits_.cutoff) {
      node.end = RayEnd::below_cutoff;
    } else {
      meet(node);
    }
    if (node.end == RayEnd::surface) branch(i);
  }

  /// Finds the next surface that can be seen: those hidden in the body that counts are passed.
  void meet(RayNode& node) {
    Ray ahead = node.ray;
    for (;;) {
      const Nearest nearest = accelerator_.nearest(ahead);
      tree_.tests += nearest.tests;
      node.hit = nearest.hit;
      node.end = node.hit ? RayEnd::surface : RayEnd::left_scene;
      if (!node.hit) return;
      node.length = node.hit->hit.t - node.ray.t_min;
      if (!is_transparent(material_of(*node.hit))) return;
      Crossing crossing = cross(node.media, *node.hit, ahead.direction, scene_);
      if (crossing.visible()) return;
      node.media = std::move(crossing.behind);
      ahead.t_min = node.hit->hit.t;
    }
  }

  void branch(std::size_t parent) {
    const Material& material = material_of(*tree_.nodes[parent].hit);
    if (!(material.k_r > 0 || material.k_t > 0)) return;  // most surfaces
    const SceneHit met = *tree_.nodes[parent].hit;
    const Ray incident = tree_.nodes[parent].ray;
    const Media around = tree_.nodes[parent].media;
    Crossing crossing;
    if (is_transparent(material)) crossing = cross(around, met, incident.direction, scene_);
    const double ratio = index_ratio(crossing, tree_.nodes[parent].medium, material);
    const bool clear = material.frost == 0;
    const Vec3 normal = material.bump ? bumped(met, incident) : met.hit.normal;
    Shares shares = shares_of(material, std::abs(incident.direction.dot(normal)), ratio);

    std::optional<Vec3> transmission;
    if (material.k_t > 0) {
      transmission = ratio == 1 ? incident.direction : refract(incident.direction, normal, ratio);
      if (!transmission) shares.reflected = material.k_r + material.k_t;  // total internal reflection: nothing is lost
    }
    if (shares.reflected > 0) {
      Vec3 mirrored = reflect(incident.direction, normal);
      if (material.bump) mirrored = kept_outside(mirrored, on_side_of(-incident.direction, met.hit.normal));
      const bool mapped = material.environment && (!is_transparent(material) || on_front(incident, met));
      spawn(parent, RayKind::reflected, from_hit(met, mirrored), shares.reflected, around, mapped);
    }
    if (transmission && shares.transmitted > 0) {
      Ray onward = incident;  // straight on: beyond this hit, and no surface is met at another t than without it
      onward.t_min = met.hit.t;
      if (material.bump && ratio != 1) {
        transmission = kept_outside(*transmission, on_side_of(incident.direction, met.hit.normal));
      }
      if (!clear) transmission = strayed(*transmission, met.hit.normal, material.frost, parent);
      spawn(parent, RayKind::transmitted, ratio == 1 && clear ? onward : from_hit(met, *transmission),
            shares.transmitted, crossing.behind);
    }
  }

  /// The normal that mirrors and refracts. Where a bump would turn its back on the ray it is the surface's own.
  Vec3 bumped(const SceneHit& met, const Ray& incident) const {
    const Object& object = scene_.objects[met.object];
    const Vec3 point = at_rest(object, met.hit.point, incident.time);
    const Vec3 rough = shading_normal(*scene_.materials[object.material].bump, object.shape, point, met.hit.normal);
    return rough.dot(incident.direction) * met.hit.normal.dot(incident.direction) > 0 ? rough : met.hit.normal;
  }

  static Vec3 on_side_of(const Vec3& direction, const Vec3& normal) {
    return normal.dot(direction) < 0 ? Vec3(-normal) : normal;
  }

  /// η_incident / η_transmitted; of an opaque surface, whose inside no one sees, for Fresnel's factor.
  double index_ratio(const Crossing& crossing, std::optional<std::size_t> medium, const Material& material) const {
    if (!is_transparent(material)) return index_of(medium) / refractive_index(material, tree_.wavelength);
    const auto material_in = [](const std::optional<Media::Body>& body) {
      return body ? std::optional(body->material) : std::nullopt;
    };
    return index_of(material_in(crossing.before)) / index_of(material_in(crossing.afterwards));
  }

  double index_of(std::optional<std::size_t> material) const {
    return material ? refractive_index(scene_.materials[*material], tree_.wavelength) : 1;
  }

  static Shares shares_of(const Material& material, double cosine, double ratio) {
    if (!material.fresnel) return {material.k_r, material.k_t};
    const double factor = fresnel_reflectance(std::min(cosine, 1.0), ratio);  // absorbs the rounding of unit vectors
    const double both = material.k_r + material.k_t;
    return {both * factor, both * (1 - factor)};
  }

  Vec3 strayed(const Vec3& clear, const Vec3& normal, double frost, std::size_t ray) const {
    const auto [a, b] = key_.part(ray).spread_pair(sample_number::kFrost);
    return frosted(clear, normal, frost, a, b);
  }

  static bool on_front(const Ray& incident, const SceneHit& met) { return incident.direction.dot(met.hit.normal) < 0; }

  static Ray from_hit(const SceneHit& met, const Vec3& direction) {
    return {offset_origin(met.hit, direction), direction};
  }

  void spawn(std::size_t parent, RayKind kind, const Ray& ray, double coefficient, const Media& media,
             bool mapped = false) {
    RayNode& child = tree_.nodes.emplace_back();
    const RayNode& from = tree_.nodes[parent];
    child.ray = ray;
    child.ray.time = from.ray.time;
    child.kind = kind;
    child.level = from.level + 1;
    child.before = from.before + from.length;
    child.parent = parent;
    child.coefficient = coefficient;
    child.weight = from.weight * coefficient * left_by_medium(from);
    child.media = media;
    child.end = RayEnd::environment;
    if (!mapped) follow(tree_.nodes.size() - 1);
  }

  /// The greatest share, of the channels', that the medium of a ray leaves of what comes along it.
  double left_by_medium(const RayNode& node) const {
    if (!node.medium || (scene_.materials[*node.medium].absorption == 0).any()) return 1;
    return transmittance(scene_.materials[*node.medium].absorption, node.length).maxCoeff();
  }

  const Material& material_of(const SceneHit& met) const {
    return scene_.materials[scene_.objects[met.object].material];
  }

  const Accelerator& accelerator_;
  const Scene& scene_;
  const TreeLimits limits_;
  const SampleKey key_;
  RayTree tree_;
};

std::string object_label(const Scene& scene, std::size_t object) {
  const std::string& name = scene.objects[object].name;
  return name.empty() ? "object " + std::to_string(object) : printable(name);
}

std::string fate(const RayNode& node, const Scene& scene) {
  switch (node.end) {
    case RayEnd::surface:
      return "meets " + object_label(scene, node.hit->object);
    case RayEnd::left_scene:
      return "leaves the scene";
    case RayEnd::depth_limit:
      return "is not followed: depth limit";
    case RayEnd::below_cutoff:
      return "is not followed: below the cutoff";
    case RayEnd::environment:
      return "sees the environment of the mirror";
  }
  return "unknown";
}

}  // namespace

RayTree trace(const Ray& eye_ray, const Accelerator& accelerator, const TreeLimits& limits, const RayStart& start) {
  require(limits.depth >= 0, "trace: the depth is not negative");
  require(limits.cutoff >= 0, "trace: the cutoff is not negative");
  TreeBuilder builder(accelerator, limits, start);
  builder.begin(eye_ray, start.media);
  return builder.take();
}

void recycle(RayTree&& tree) {
  tree.nodes.clear();
  spare_nodes = std::move(tree.nodes);
}

std::vector<std::string> ray_names(const RayTree& tree) {
  std::vector<std::size_t> surface_number(tree.nodes.size(), 0);
  std::vector<std::string> names;
  std::size_t met = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const RayNode& node = tree.nodes[i];
    if (node.end == RayEnd::surface) surface_number[i] = ++met;
    const char* letter = node.kind == RayKind::transmitted ? "T" : "R";
    names.push_back(node.kind == RayKind::eye ? "R" : letter + std::to_string(surface_number[node.parent]));
  }
  return names;
}

std::string to_text(const RayTree& tree, const Scene& scene) {
  const auto names = ray_names(tree);
  std::string text;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const RayNode& node = tree.nodes[i];
    text += std::string(2 * static_cast<std::size_t>(node.level), ' ') + names[i] + " weight " +
            rounded(node.weight, 6) + " " + fate(node, scene) + "\n";
  }
  return text;
}

std::string to_dot(const RayTree& tree, const Scene& scene) {
  const auto names = ray_names(tree);
  const auto escaped = [](const std::string& label) {
    std::string result;
    for (const char c : label) result += (c == '"' || c == '\\') ? std::string{'\\', c} : std::string{c};
    return result;
  };
  std::string text = "digraph ray_tree {\n  eye [shape=plaintext];\n";
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const RayNode& node = tree.nodes[i];
    const std::string id = "n" + std::to_string(i);
    const bool met = node.end == RayEnd::surface;
    const std::string label = met ? object_label(scene, node.hit->object) : fate(node, scene);
    text += "  " + id + " [label=\"" + escaped(label) + "\", shape=" + (met ? "circle" : "plaintext") + "];\n";
    const std::string from = node.parent == RayNode::kNone ? "eye" : "n" + std::to_string(node.parent);
    text += "  " + from + " -> " + id + " [label=\"" + names[i] + "\\n" + rounded(node.weight, 6) + "\"];\n";
  }
  return text + "}\n";
}

}  // namespace etendue
