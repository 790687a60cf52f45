// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/ray_tree.hpp"

#include <cstdio>
#include <utility>

#include "etendue/core/contract.hpp"
#include "etendue/geometry/spawn.hpp"
#include "etendue/optics/reflect.hpp"
#include "etendue/optics/refract.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

class TreeBuilder {
 public:
  TreeBuilder(const Accelerator& accelerator, const TreeLimits& limits) : accelerator_(accelerator), limits_(limits) {}

  void follow(RayNode node) {
    if (node.level > limits_.depth) {
      node.end = RayEnd::depth_limit;
    } else if (node.weight < limits_.cutoff) {
      node.end = RayEnd::below_cutoff;
    } else {
      const Nearest nearest = accelerator_.nearest(node.ray);
      tree_.tests += nearest.tests;
      node.hit = nearest.hit;
      node.end = node.hit ? RayEnd::surface : RayEnd::left_scene;
    }
    tree_.nodes.push_back(node);
    if (node.end == RayEnd::surface) branch(tree_.nodes.size() - 1);
  }

  RayTree take() { return std::move(tree_); }

 private:
  void branch(std::size_t parent) {
    const SceneHit met = *tree_.nodes[parent].hit;
    const Vec3 direction = tree_.nodes[parent].ray.direction;
    const Scene& scene = accelerator_.scene();
    const Material& material = scene.materials[scene.objects[met.object].material];

    double reflected = material.k_r;
    std::optional<Vec3> transmission;
    if (material.k_t > 0) {
      const bool enters = direction.dot(met.hit.normal) < 0;
      transmission = refract(direction, met.hit.normal, enters ? 1 / material.eta : material.eta);
      if (!transmission) reflected += material.k_t;  // total internal reflection: nothing is lost
    }
    if (reflected > 0) {
      spawn(parent, RayKind::reflected, reflect(direction, met.hit.normal), reflected);
    }
    if (transmission) spawn(parent, RayKind::transmitted, *transmission, material.k_t);
  }

  void spawn(std::size_t parent, RayKind kind, const Vec3& direction, double coefficient) {
    RayNode child;
    child.ray.origin = offset_origin(tree_.nodes[parent].hit->hit, direction);
    child.ray.direction = direction;
    child.kind = kind;
    child.level = tree_.nodes[parent].level + 1;
    child.parent = parent;
    child.coefficient = coefficient;
    child.weight = tree_.nodes[parent].weight * coefficient;
    follow(std::move(child));
  }

  const Accelerator& accelerator_;
  const TreeLimits limits_;
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
  }
  return "unknown";
}

}  // namespace

RayTree trace(const Ray& eye_ray, const Accelerator& accelerator, const TreeLimits& limits) {
  require(limits.depth >= 0, "trace: the depth is not negative");
  require(limits.cutoff >= 0, "trace: the cutoff is not negative");
  TreeBuilder builder(accelerator, limits);
  RayNode root;
  root.ray = eye_ray;
  builder.follow(std::move(root));
  return builder.take();
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
    text += "  " + from + " -> " + id + " [label=\"" + names[i] + "\"];\n";
  }
  return text + "}\n";
}

}  // namespace etendue
