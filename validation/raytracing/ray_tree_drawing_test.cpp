// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/ray_tree_drawing.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "support/evidence.hpp"
#include "support/scene_builder.hpp"

namespace etendue::validation {
namespace {

/// A tree by hand: the parent of each ray, in order; levels follow.
RayTree tree_of(const std::vector<std::size_t>& parents) {
  RayTree tree;
  for (const std::size_t parent : parents) {
    RayNode node;
    node.parent = parent;
    if (parent != RayNode::kNone) {
      node.level = tree.nodes[parent].level + 1;
      node.kind = RayKind::reflected;
    }
    tree.nodes.push_back(node);
  }
  return tree;
}

constexpr std::size_t kNone = RayNode::kNone;

// CLAIM      IU.f36 is drawn in its shape: R2, R3, R4, T1 from left to right, and above them T3, T2, R1, R in the middle of what
//            they cause.
// ORACLE     table: the figure's columns by hand: halves and quarters.
// TOLERANCE  none.
TEST(TreeLayout, DrawsFigure36) {
  proves({"IU.f36"}, Oracle::table, "the figure's eight rays by hand");
  // R, R1, R2, T2, R3, T3, R4, T1
  const TreeLayout layout = etendue::layout(tree_of({kNone, 0, 1, 1, 3, 3, 5, 0}));
  EXPECT_TRUE(holds(layout.across == std::vector<double>({1.875, 0.75, 0, 1.5, 1, 2, 2, 3})));
  EXPECT_TRUE(holds(layout.columns == 4 && layout.levels == 5));
}

// CLAIM      No two ends share a place, parents stand between their first and last child, and lines of one level do not cross.
// ORACLE     identity: the order of children and of their parents on each level, for a thousand trees.
// TOLERANCE  none.
TEST(TreeLayout, CrossesNoLines) {
  proves({"IU.f36"}, Oracle::identity, "order of ends and of parents on each level");
  uses_seed(5501);
  std::uint64_t state = 5501, wrong = 0, decided = 0;
  const auto next = [&] { return (state = state * 6364136223846793005u + 1442695040888963407u) >> 33; };
  for (int trial = 0; trial < 1000; ++trial) {
    std::vector<std::size_t> parents;
    // depth first, as trace() does it
    const auto grow = [&](auto&& self, std::size_t parent, int level) -> void {
      parents.push_back(parent);
      const std::size_t self_index = parents.size() - 1;
      const std::uint64_t children = level > 7 ? 0 : next() % 3;
      for (std::uint64_t i = 0; i < children; ++i) self(self, self_index, level + 1);
    };
    grow(grow, kNone, 0);
    const RayTree tree = tree_of(parents);
    const TreeLayout places = layout(tree);
    std::map<int, std::vector<std::size_t>> levels;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) levels[tree.nodes[i].level].push_back(i);
    for (const auto& [level, rays] : levels) {
      for (std::size_t i = 1; i < rays.size(); ++i) {
        ++decided;
        const std::size_t left = rays[i - 1], right = rays[i];
        const std::size_t left_parent = tree.nodes[left].parent, right_parent = tree.nodes[right].parent;
        wrong +=
            !(places.across[left] < places.across[right]) || places.across[left_parent] > places.across[right_parent];
      }
    }
  }
  EXPECT_TRUE(all_agree(wrong, decided));
}

// CLAIM      The drawing has a line for each ray, a circle for each surface met, the names of both, and says why rays ended;
//            what a name holds cannot leave its text.
// ORACLE     table: the parts of a tree of three rays.
// TOLERANCE  none.
TEST(TreeDrawing, HasEveryRay) {
  proves({"IU.f32", "IU.f36"}, Oracle::table, "a pane of glass before a black one, ray by ray");
  Scene scene;
  add(scene, square({0, 0, 0}, {0, 0, 1}, 1), specular(0.25, 0.5), "a <pane> & \"more\"");
  add(scene, square({0, 0, -1}, {0, 0, 1}, 1), diffuse(0), "wall");
  const auto accelerator = make_accelerator(scene, AcceleratorKind::brute_force);
  const std::string svg = to_svg(trace({{0.1, 0.2, 3}, {0, 0, -1}}, *accelerator, {}), scene);
  const auto count = [&](const std::string& part) {
    std::size_t found = 0;
    for (auto at = svg.find(part); at != std::string::npos; at = svg.find(part, at + 1)) ++found;
    return found;
  };
  EXPECT_TRUE(holds(count("<line ") == 3 && count("<circle ") == 2 && count("stroke-dasharray") == 1));
  EXPECT_TRUE(holds(count(">R 1<") == 1 && count(">R1 0.25<") == 1 && count(">T1 0.5<") == 1));
  EXPECT_TRUE(holds(count(">leaves<") == 1 && count(">wall<") == 1 && count("<pane>") == 0));
  EXPECT_TRUE(holds(count("&lt;pane&gt; &amp;") == 1));
  const RayTree cut = trace({{0.1, 0.2, 3}, {0, 0, -1}}, *accelerator, {0, 0});
  EXPECT_TRUE(holds(to_svg(cut, scene).find(">depth limit<") != std::string::npos));
}

}  // namespace
}  // namespace etendue::validation
