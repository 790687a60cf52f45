// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/ray_tree.hpp"

#include <array>
#include <cmath>

#include "etendue/core/rounding.hpp"
#include "etendue/raytracing/shade.hpp"
#include "support/evidence.hpp"
#include "support/scene_builder.hpp"

namespace etendue::validation {
namespace {

constexpr double kR1 = 0.1, kT1 = 0.8, kR2 = 0.3, kT2 = 0.5, kR3 = 0.2, kT3 = 0.5, kR4 = 0.6;
/// At most four products and four sums of numbers in [0, 1].
constexpr double kSumError = 8 * kUnitRoundoff;

/// Figure 32: S1, S2, S3 transparent, S4 opaque. The eye ray runs along +x; S1 turns it up; S2, S3, S4 stand above each
/// other, each tilted so that its reflected ray leaves sideways. η = 1: transmitted rays go straight on.
Scene four_surfaces() {
  Scene scene;
  add(scene, square({0, 0, 0}, {-1, 0, 1}, 0.5), specular(kR1, kT1), "S1");
  add(scene, square({0, 0, 2}, {0, -1, -1}, 0.5), specular(kR2, kT2), "S2");
  add(scene, square({0, 0, 4}, {1, 0, -1}, 0.5), specular(kR3, kT3), "S3");
  add(scene, square({0, 0, 6}, {0, 1, -1}, 0.5), specular(kR4, 0), "S4");
  return scene;
}

const Ray kEyeRay{{-5, 0.0625, 0.03125}, {1, 0, 0}};

struct Expected {
  const char* name;
  RayKind kind;
  int level;
  std::size_t parent;
  double weight;
  const char* meets;  ///< nothing: it leaves the scene
};

constexpr std::size_t kNone = RayNode::kNone;
const std::array<Expected, 8> kFigure36{{
    {"R", RayKind::eye, 0, kNone, 1, "S1"},
    {"R1", RayKind::reflected, 1, 0, kR1, "S2"},
    {"R2", RayKind::reflected, 2, 1, kR1* kR2, nullptr},
    {"T2", RayKind::transmitted, 2, 1, kR1* kT2, "S3"},
    {"R3", RayKind::reflected, 3, 3, kR1* kT2* kR3, nullptr},
    {"T3", RayKind::transmitted, 3, 3, kR1* kT2* kT3, "S4"},
    {"R4", RayKind::reflected, 4, 5, kR1* kT2* kT3* kR4, nullptr},
    {"T1", RayKind::transmitted, 1, 0, kT1, nullptr},
}};

// CLAIM      IU.f32, IU.f36: the four surfaces give the rays R, R1, T1, R2, T2, R3, T3, R4 in the figure's shape; T1,
//            R2, R3, R4 leave; S4 is opaque and transmits nothing; the tree can be printed and drawn.
// ORACLE     table: the figure, ray by ray.
// TOLERANCE  none for the shape; two roundings for the weights.
TEST(RayTree, IsThatOfFourSurfaces) {
  proves({"IU.f32", "IU.f36", "IU.5-2"}, Oracle::table, "figures 32 and 36, ray by ray");
  const Scene scene = four_surfaces();
  for (const auto kind : {AcceleratorKind::brute_force, AcceleratorKind::bounding_volumes}) {
    const auto accelerator = make_accelerator(scene, kind);
    const RayTree tree = trace(kEyeRay, *accelerator, {});
    const auto names = ray_names(tree);
    ASSERT_EQ(tree.nodes.size(), kFigure36.size());
    for (std::size_t i = 0; i < kFigure36.size(); ++i) {
      const RayNode& node = tree.nodes[i];
      const Expected& expected = kFigure36[i];
      EXPECT_EQ(names[i], expected.name);
      EXPECT_EQ(node.kind, expected.kind);
      EXPECT_EQ(node.level, expected.level);
      EXPECT_EQ(node.parent, expected.parent);
      EXPECT_TRUE(near(node.weight, expected.weight, 4 * kUnitRoundoff));
      ASSERT_EQ(node.end, expected.meets ? RayEnd::surface : RayEnd::left_scene) << names[i];
      if (expected.meets) {
        EXPECT_EQ(scene.objects[node.hit->object].name, expected.meets);
      }
    }
    EXPECT_EQ(to_text(tree, scene),
              "R weight 1 meets S1\n"
              "  R1 weight 0.1 meets S2\n"
              "    R2 weight 0.03 leaves the scene\n"
              "    T2 weight 0.05 meets S3\n"
              "      R3 weight 0.01 leaves the scene\n"
              "      T3 weight 0.025 meets S4\n"
              "        R4 weight 0.015 leaves the scene\n"
              "  T1 weight 0.8 leaves the scene\n");
    const std::string dot = to_dot(tree, scene);
    for (const char* edge :
         {"eye -> n0 [label=\"R\\n1\"]", "n0 -> n1 [label=\"R1\\n0.1\"]", "n1 -> n2 [label=\"R2\\n0.03\"]",
          "n1 -> n3 [label=\"T2\\n0.05\"]", "n3 -> n4 [label=\"R3\\n0.01\"]", "n3 -> n5 [label=\"T3\\n0.025\"]",
          "n5 -> n6 [label=\"R4\\n0.015\"]", "n0 -> n7 [label=\"T1\\n0.8\"]"}) {
      EXPECT_NE(dot.find(edge), std::string::npos) << edge;
    }
  }
}

// CLAIM      E13: a ray that leaves brings the background; "does not contribute" is the same only where that is black.
// ORACLE     closed form: k_t1 b + k_r1 (k_r2 b + k_t2 (k_r3 b + k_t3 k_r4 b)).
// TOLERANCE  kSumError.
TEST(RayTree, BringsTheBackgroundFromRaysThatLeave) {
  proves({"E13", "IU.5.5", "IU.5-2"}, Oracle::closed_form, "the nested sum of figure 36");
  Scene scene = four_surfaces();
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  const RayTree tree = trace(kEyeRay, *accelerator, {});
  EXPECT_EQ(shade(tree, *accelerator).colour.maxCoeff(), 0);  // black background: the printed statement holds
  scene.background = {1, 0.5, 0.25};
  const double share = kT1 + kR1 * (kR2 + kT2 * (kR3 + kT3 * kR4));
  const Rgb colour = shade(tree, *accelerator).colour;
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(near(colour[k], share * scene.background[k], kSumError));
}

// CLAIM      IU.5.5: with the eye rays at level 0, a greatest depth of 2 leaves out T3, R3 and R4, and nothing else.
// ORACLE     table: the sentence in the text, and the nested sum without those rays.
// TOLERANCE  kSumError.
TEST(RayTree, EndsAtTheGreatestDepth) {
  proves({"IU.5.5"}, Oracle::table, "the text's example: depth 2 leaves out T3, R3, R4");
  Scene scene = four_surfaces();
  scene.background = {1, 1, 1};
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  const RayTree tree = trace(kEyeRay, *accelerator, {2, 0});
  std::string followed, cut;
  const auto names = ray_names(tree);
  for (std::size_t i = 0; i < names.size(); ++i) {
    (tree.nodes[i].end == RayEnd::depth_limit ? cut : followed) += names[i] + " ";
  }
  EXPECT_EQ(followed, "R R1 R2 T2 T1 ");
  EXPECT_EQ(cut, "R3 T3 ");
  EXPECT_TRUE(near(shade(tree, *accelerator).colour[0], kT1 + kR1 * kR2, kSumError));

  const RayTree eye_only = trace(kEyeRay, *accelerator, {0, 0});
  EXPECT_EQ(eye_only.nodes.size(), 3u);
  EXPECT_EQ(shade(eye_only, *accelerator).colour.maxCoeff(), 0);
}

// CLAIM      E12: T3 is weakened by k_t3 k_t2 k_r1, for it descends from R1; with k_t1 in place of k_r1, as printed
//            (one letter for all three), it would count 0.2 instead of 0.025 and be followed by the adaptive limit.
// ORACLE     closed form: both products.
// TOLERANCE  two roundings of the product; none for what is followed.
TEST(RayTree, WeighsARayByTheProductAlongItsPath) {
  proves({"E12", "IU.5.5"}, Oracle::closed_form, "0.5 · 0.5 · 0.1 against 0.5 · 0.5 · 0.8");
  const Scene scene = four_surfaces();
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  const double printed = kT3 * kT2 * kT1, mended = kT3 * kT2 * kR1;
  EXPECT_TRUE(near(printed, 0.2, 2 * kUnitRoundoff));
  for (const double cutoff : {0.024, 0.026, 0.1}) {
    const RayTree tree = trace(kEyeRay, *accelerator, {5, cutoff});
    const auto names = ray_names(tree);
    bool asked = false;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const RayNode& node = tree.nodes[i];
      EXPECT_EQ(node.end == RayEnd::below_cutoff, node.weight < cutoff) << names[i];
      if (names[i] != "T3") continue;
      asked = true;
      EXPECT_TRUE(near(node.weight, mended, 2 * kUnitRoundoff));
      EXPECT_EQ(node.end == RayEnd::surface, cutoff < mended);
    }
    EXPECT_EQ(asked, cutoff < kR1 * kT2);  // a cutoff of 0.1 ends the branch at T2 already
  }
  EXPECT_GT(printed, 0.026);  // the printed product would have followed it
}

// CLAIM      IU.5.5 with absorbing bodies: what a body absorbs on the way counts in the weight, by the channel that keeps most, so that the
//            adaptive limit ends what a dark body hides, and the error told for it holds.
// ORACLE     closed form: k_t exp(−σ d) for a slab of thickness d that a ray crosses along its normal.
// TOLERANCE  six roundings; none for what is followed.
TEST(RayTree, WeighsWhatBodiesAbsorb) {
  proves({"IU.5.5"}, Oracle::closed_form, "exp(-sigma d) along the path");
  Scene scene;
  scene.background = Rgb::Ones();
  Material ink = specular(0, 0.5, 1.5);
  ink.absorption = Rgb(3, 2, 5);
  add(scene, Box{{0, 0, 0}, Mat3::Identity(), {2, 2, 0.5}}, ink);
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  const double first = 0.5, second = 0.25 * std::exp(-2.0);
  for (const double cutoff : {0.0, 0.9 * second, 1.1 * second, 0.24, 0.51}) {
    const RayTree tree = trace({{0.25, 0.5, 4}, {0, 0, -1}}, *accelerator, {5, cutoff});
    ASSERT_EQ(tree.nodes.size(), cutoff > first ? 2u : 3u);
    EXPECT_TRUE(near(tree.nodes[1].weight, first, 0));
    if (cutoff > first) continue;
    EXPECT_TRUE(near(tree.nodes[2].weight, second, 6 * kUnitRoundoff));
    EXPECT_EQ(tree.nodes[2].end == RayEnd::below_cutoff, cutoff > second);
    const double lost = 0.25 * std::exp(-2.0) - shade(tree, *accelerator).colour[1];
    EXPECT_TRUE(within(std::abs(lost), (cutoff > second ? tree.nodes[2].weight : 0) + 8 * kUnitRoundoff));
  }
}

// CLAIM      IU.5.3tir in the tree: under total internal reflection nothing is transmitted and the reflected ray
//            carries k_r + k_t; the ray that meets the flat side of glass from inside below the critical angle does
//            leave.
// ORACLE     closed form: Snell, sin 45° · 1.5 > 1 and sin 30° · 1.5 = 0.75.
// TOLERANCE  none for the shape; u for the coefficient.
TEST(RayTree, ReflectsTotallyInsideGlass) {
  proves({"IU.5.3tir", "IU.5-2"}, Oracle::closed_form, "Snell's law at 45 and 30 degrees from inside, η = 1.5");
  Scene scene;
  add(scene, Plane{{0, 0, 0}, {0, 0, 1}}, specular(0.25, 0.5, 1.5), "glass below");
  const auto accelerator = make_accelerator(scene, AcceleratorKind::brute_force);
  const double half = std::sqrt(0.5);
  const RayTree total = trace({{0, 0, -1}, {half, 0, half}}, *accelerator, {});
  ASSERT_EQ(total.nodes.size(), 2u);
  EXPECT_EQ(total.nodes[1].kind, RayKind::reflected);
  EXPECT_TRUE(near(total.nodes[1].coefficient, 0.75, kUnitRoundoff));
  EXPECT_LT(total.nodes[1].ray.direction.z(), -0.7);

  const RayTree leaves = trace({{0, 0, -1}, {0.5, 0, std::sqrt(0.75)}}, *accelerator, {});
  ASSERT_EQ(leaves.nodes.size(), 3u);
  EXPECT_TRUE(near(leaves.nodes[1].coefficient, 0.25, 0));
  EXPECT_TRUE(near(leaves.nodes[2].ray.direction.x(), 0.75, 16 * kUnitRoundoff));

  const RayTree enters = trace({{0, 0, 1}, {half, 0, -half}}, *accelerator, {});
  ASSERT_EQ(enters.nodes.size(), 3u);
  EXPECT_TRUE(near(enters.nodes[2].ray.direction.x(), half / 1.5, 16 * kUnitRoundoff));
}

}  // namespace
}  // namespace etendue::validation
