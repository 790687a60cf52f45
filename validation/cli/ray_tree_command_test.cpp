// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "support/evidence.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {
namespace {

std::string mirrors() {
  return (source_root() / "scenes" / "mirrors" / "scene.json").string();
}

// CLAIM      The tree of rays of a pixel can be printed and drawn from the command line.
// ORACLE     table: the scene: from mirror to mirror, each taking a tenth.
// TOLERANCE  none.
TEST(RenderCommand, PrintsAndDrawsARayTree) {
  proves({"IU.f36"}, Oracle::table, "a path between the two mirrors of the mirror scene");
  const Ended printed = run_etendue({"render", mirrors(), "--ray-tree", "295,235", "--depth", "2"});
  EXPECT_EQ(printed.code, 0) << printed.err;
  const char* const tree =
      "R weight 1 meets wall mirror/glass\n"
      "  R1 weight 0.9 meets standing mirror/glass\n"
      "    R2 weight 0.81 meets wall mirror/glass\n"
      "      R3 weight 0.729 is not followed: depth limit\n";
  EXPECT_TRUE(holds(printed.out == tree)) << printed.out;
  const TemporaryFolder folder;
  const auto dot = folder.path() / "tree.dot";
  const Ended drawn = run_etendue({"render", mirrors(), "--ray-tree", "295,235", "--output", dot.string()});
  EXPECT_EQ(drawn.code, 0) << drawn.err;
  EXPECT_TRUE(holds(read_text(dot).rfind("digraph ray_tree {", 0) == 0));
  for (const char* name : {"tree.png", "tree", "tree.dott"}) {
    const auto misnamed = (folder.path() / name).string();
    const Ended refused = run_etendue({"render", mirrors(), "--ray-tree", "295,235", "--output", misnamed});
    EXPECT_TRUE(holds(refused.code == 2 && folder.contents() == "tree.dot")) << refused.err;
    EXPECT_NE(refused.err.find("'" + misnamed + "', expected a name that ends in .dot"), std::string::npos);
  }
  for (const char* wrong : {"500,0", "-1,0", "1", "1;2", "1,2x", ""}) {
    const Ended refused = run_etendue({"render", mirrors(), std::string("--ray-tree=") + wrong});
    EXPECT_EQ(refused.code, 2) << wrong;
    EXPECT_NE(refused.err.find("expected COLUMN,ROW"), std::string::npos) << refused.err;
  }
}

// CLAIM      --ray-tree --json prints the same tree for a machine, with and without a drawing.
// ORACLE     table: the path between the two mirrors, each taking a tenth.
// TOLERANCE  none; 0.81 to the last bit or two of a product of doubles.
TEST(RenderCommand, PrintsARayTreeAsJson) {
  proves({}, Oracle::table, "a path between the two mirrors of the mirror scene");
  const TemporaryFolder folder;
  std::vector<std::string> arguments{"render", mirrors(), "--ray-tree=295,235", "--depth=1", "--json"};
  const Ended printed = run_etendue(arguments);
  ASSERT_EQ(printed.code, 0) << printed.err;
  const auto report = nlohmann::json::parse(printed.out);
  EXPECT_TRUE(holds(report["pixel"] == nlohmann::json({295, 235})));
  ASSERT_EQ(report["rays"].size(), 3u);
  const auto& first = report["rays"][1];
  EXPECT_TRUE(holds(first["name"] == "R1" && first["kind"] == "reflected" && first["parent"] == 0));
  EXPECT_TRUE(holds(first["end"] == "surface" && first["object"]["name"] == "standing mirror/glass"));
  EXPECT_TRUE(holds(report["rays"][2]["end"] == "depth limit" && !report["rays"][2].contains("object")));
  constexpr double kTwoRoundings = 2 * 0x1p-53;
  EXPECT_TRUE(near(report["rays"][2]["weight"].get<double>(), 0.81, kTwoRoundings));
  arguments.insert(arguments.end(), {"--output", (folder.path() / "tree.dot").string()});
  const Ended drawn = run_etendue(arguments);
  EXPECT_TRUE(holds(drawn.code == 0 && drawn.out == printed.out && folder.contents() == "tree.dot")) << drawn.err;
}

std::string four_surfaces() {
  return (source_root() / "scenes" / "ray-tree" / "scene.json").string();
}

/// Figure 36 as text: each ray with the product of the coefficients along its path, and why it ended.
constexpr const char* kFigure36 =
    "R weight 1 meets S1\n"
    "  R1 weight 0.1 meets S2\n"
    "    R2 weight 0.03 leaves the scene\n"
    "    T2 weight 0.05 meets S3\n"
    "      R3 weight 0.01 leaves the scene\n"
    "      T3 weight 0.025 meets S4\n"
    "        R4 weight 0.015 leaves the scene\n"
    "  T1 weight 0.8 leaves the scene\n";

// CLAIM      IU.f32, IU.f36: etendue ray-tree prints the figure's tree for the pixel that looks at S1, and writes it as text,
//            JSON, graph and drawing, by the name's ending.
// ORACLE     table: the figure, ray by ray.
// TOLERANCE  none.
TEST(RayTreeCommand, PrintsAndWritesFigure36) {
  proves({"IU.f32", "IU.f36"}, Oracle::table, "figures 32 and 36, ray by ray, from the scene file");
  const Ended printed = run_etendue({"ray-tree", four_surfaces(), "--pixel", "50", "50"});
  EXPECT_TRUE(holds(printed.code == 0 && printed.out == kFigure36)) << printed.out << printed.err;
  const TemporaryFolder folder;
  const auto written = [&](const std::string& name) {
    const auto path = folder.path() / name;
    const Ended ended = run_etendue({"ray-tree", four_surfaces(), "--pixel", "50", "50", "-o", path.string()});
    EXPECT_TRUE(holds(ended.code == 0 && ended.out == path.string() + "\n")) << ended.err;
    return read_text(path);
  };
  EXPECT_TRUE(holds(written("tree.txt") == kFigure36));
  EXPECT_TRUE(holds(written("tree.dot").rfind("digraph ray_tree {", 0) == 0));
  const std::string svg = written("tree.svg");
  for (const char* label :
       {">R 1<", ">R1 0.1<", ">R2 0.03<", ">T2 0.05<", ">R3 0.01<", ">T3 0.025<", ">R4 0.015<", ">T1 0.8<", ">S4<"}) {
    EXPECT_TRUE(holds(svg.rfind("<svg ", 0) == 0 && svg.find(label) != std::string::npos)) << label;
  }
  const auto report = nlohmann::json::parse(written("tree.json"));
  ASSERT_EQ(report["rays"].size(), 8u);
  EXPECT_TRUE(holds(report["rays"][5]["name"] == "T3" && report["rays"][5]["coefficient"] == 0.5));
  EXPECT_TRUE(holds(report["rays"][6]["end"] == "left scene" && report["rays"][6]["parent"] == 5));
  for (const char* accelerator : {"brute", "bvh", "spheres", "grid", "octree"}) {
    const Ended ended =
        run_etendue({"ray-tree", four_surfaces(), "--pixel", "50", "50", "--json", "--accelerator", accelerator});
    ASSERT_EQ(ended.code, 0) << ended.err;
    const auto found = nlohmann::json::parse(ended.out);
    EXPECT_TRUE(holds(found["rays"] == report["rays"])) << accelerator;
    // Each of the eight rays is tried against the four surfaces, by brute force alone.
    const bool all_tried = found["tests"]["surfaces"] == 8 * 4 && found["tests"]["boxes"] == 0;
    EXPECT_TRUE(holds(all_tried == (std::string(accelerator) == "brute"))) << accelerator;
  }
  const Ended short_tree = run_etendue({"ray-tree", four_surfaces(), "--pixel", "50", "50", "--cutoff", "0.02"});
  EXPECT_TRUE(holds(short_tree.out.find("R4 weight 0.015 is not followed: below the cutoff") != std::string::npos));
}

// CLAIM      What ray-tree cannot do it says: a pixel that is missing or beside the picture, another ending, a scene's own file.
// ORACLE     table: the words of each message.
// TOLERANCE  none.
TEST(RayTreeCommand, SaysWhatIsWrong) {
  proves({}, Oracle::table, "one message for each misuse");
  const auto refused = [](std::vector<std::string> more, const char* words) {
    more.insert(more.begin(), {"ray-tree", four_surfaces()});
    const Ended ended = run_etendue(more);
    EXPECT_TRUE(holds(ended.code == 2 && ended.err.find(words) != std::string::npos)) << ended.err;
  };
  refused({}, "found none, expected COLUMN ROW");
  refused({"--pixel", "101", "0"}, "found '101 0', expected COLUMN ROW from 0 0 to 100 100");
  refused({"--pixel", "-1", "0"}, "expected COLUMN ROW");
  refused({"--pixel", "1", "x"}, "expected COLUMN ROW");
  refused({"--pixel", "1", "1", "-o", "tree.png"}, "expected a name that ends in .txt, .json, .dot or .svg");
  refused({"--pixel", "1", "1", "-o", four_surfaces()}, "scene.json");
  refused({"--pixel", "1", "1", "--wavelength", "900"}, "[380, 780]");
}

}  // namespace
}  // namespace etendue::validation
