// SPDX-License-Identifier: Apache-2.0
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "etendue/io/image_file.hpp"
#include "support/evidence.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {
namespace {

std::string mirrors() {
  return (source_root() / "scenes" / "mirrors" / "scene.json").string();
}

/// One ball before a camera of this angle and resolution.
std::string ball_scene(const std::string& degrees, const std::string& resolution) {
  return R"({"format": "etendue-scene", "version": 1, "unit": "m",
 "camera": {"eye": [0, 0, 2], "look_at": [0, 0, 0], "up": [0, 1, 0], "horizontal_fov_deg": )" +
         degrees + R"(, "resolution": )" + resolution + R"(},
 "materials": {"grey": {"k_d": 0.5}},
 "objects": [{"type": "sphere", "name": "ball", "material": "grey", "centre": [0, 0, 0], "radius": 1}]})";
}

/// While one lives, this program and those that it starts may have so many bytes of address space, beyond what this one
/// has: the sanitizers take terabytes for themselves.
class AddressSpace {
 public:
  explicit AddressSpace(double bytes) {
    getrlimit(RLIMIT_AS, &before_);
    double pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit limit = before_;
    limit.rlim_cur = static_cast<rlim_t>(pages * static_cast<double>(sysconf(_SC_PAGESIZE)) + bytes);
    set_ = setrlimit(RLIMIT_AS, &limit) == 0;
  }
  ~AddressSpace() { setrlimit(RLIMIT_AS, &before_); }
  AddressSpace(const AddressSpace&) = delete;
  AddressSpace& operator=(const AddressSpace&) = delete;
  bool is_set() const { return set_; }

 private:
  rlimit before_{};
  bool set_ = false;
};

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

// CLAIM      render writes EXR and PNG with what made them, and a report that a machine can read; --columns scales the picture.
// ORACLE     identity: what was asked for.
// TOLERANCE  none.
TEST(RenderCommand, WritesBothPicturesAndAReport) {
  proves({}, Oracle::identity, "the options of the run");
  const TemporaryFolder folder;
  const Ended ended = run_etendue({"render", mirrors(), "--columns", "20", "--samples", "1", "--depth", "3", "--cutoff",
                                   "0.01", "--json", "--output", (folder.path() / "m.png").string()});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto report = nlohmann::json::parse(ended.out);
  EXPECT_EQ(report["picture"]["columns"], 20);
  EXPECT_EQ(report["picture"]["rows"], 20);
  EXPECT_EQ(report["picture"]["complete"], true);
  EXPECT_EQ(report["rays"]["eye"], 400);
  const auto image = read_image(folder.path() / "m.exr");
  ASSERT_TRUE(image.ok()) << image.error().message;
  EXPECT_EQ(image->columns, 20);
  EXPECT_TRUE(read_image(folder.path() / "m.png").ok());
  const auto facts = read_image_metadata(folder.path() / "m.exr");
  ASSERT_TRUE(facts.ok());
  const auto fact = [&](const std::string& name) {
    for (const auto& each : *facts) {
      if (each.first == name) return each.second;
    }
    return std::string("missing");
  };
  EXPECT_EQ(fact("etendue:depth"), "3");
  EXPECT_EQ(fact("etendue:cutoff"), "0.01");
  EXPECT_EQ(fact("etendue:samples_per_side"), "1");
  EXPECT_EQ(fact("etendue:scene_hash"), report["scene"]["hash"].get<std::string>());
  EXPECT_EQ(fact("etendue:rows"), "20 of 20");
}

// CLAIM      --columns does not lead past the 2^28 pixels that a scene may ask for: exit code 2, nothing is written.
// ORACLE     exact: exit code and message for a picture of one column and 65,536 rows, made 16,384 columns wide.
// TOLERANCE  none.
TEST(RenderCommand, RefusesColumnsThatMakeTooManyPixels) {
  proves({}, Oracle::exact, "exit code and message");
  const TemporaryFolder folder;
  const auto scene = folder.add("tall.json", ball_scene("1", "[1, 65536]"));
  const Ended ended =
      run_etendue({"render", scene.string(), "--columns", "16384", "--output", (folder.path() / "a.png").string()});
  EXPECT_TRUE(holds(ended.code == 2)) << ended.code << ended.err;
  // 65,536 · 16,384 = 2^30 rows.
  const std::string words =
      "option '--columns': found '16384', expected at most 2^28 pixels in all; in the scene's proportions these are "
      "16384 × 1073741824\n";
  EXPECT_TRUE(holds(ended.err.find(words) != std::string::npos)) << ended.err;
  EXPECT_EQ(folder.contents(), "tall.json");
}

// CLAIM      A picture that cannot be held is refused with 5 before it is begun: its size, bytes, and what to do. Made smaller
//            it is rendered.
// ORACLE     closed form: 51 bytes for each of 2^28 pixels, with 6 GB allowed.
// TOLERANCE  none: the printed digits.
TEST(RenderCommand, RefusesAPictureThatNoMemoryHolds) {
  proves({}, Oracle::closed_form, "51 bytes a pixel");
  const TemporaryFolder folder;
  const auto scene = folder.add("wide.json", ball_scene("90", "[65536, 4096]"));
  const std::vector<std::string> whole{"render", scene.string(), "--output", (folder.path() / "a.png").string()};
  std::vector<std::string> smaller = whole;
  smaller.insert(smaller.end(), {"--columns", "16", "--quiet"});
  const AddressSpace six(6e9);
  ASSERT_TRUE(six.is_set());
  const Ended refused = run_etendue(whole);
  EXPECT_TRUE(holds(refused.code == 5)) << refused.code;
  // 51 · 2^28 = 1.369e10.
  EXPECT_TRUE(
      holds(refused.err.find("etendue render: " + scene.string() +
                             ": a picture of 65536 × 4096 pixels needs 13.7 GB of memory (51 bytes a pixel), ") == 0))
      << refused.err;
  EXPECT_TRUE(holds(refused.err.find(" GB are available: make it smaller (--columns)\n") != std::string::npos))
      << refused.err;
  EXPECT_TRUE(holds(folder.contents() == "wide.json")) << folder.contents();
  const Ended rendered = run_etendue(smaller);
  EXPECT_TRUE(holds(rendered.code == 0)) << rendered.err;
  EXPECT_TRUE(holds(folder.contents() == "a.exr a.png wide.json")) << folder.contents();
}

// CLAIM      --crop, --size, --sampling, --filter, --aov and --preview do what they say: the crop has the bits of the whole, the EXR the
//            channels, the preview ends as the PNG.
// ORACLE     metamorphic: the whole picture.
// TOLERANCE  none.
TEST(RenderCommand, CropsFiltersAndAddsChannels) {
  proves({}, Oracle::metamorphic, "the whole picture");
  const TemporaryFolder folder;
  const auto run = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"render",   mirrors(),    "--size",
                                       "40x30",    "--sampling", "adaptive-jittered",
                                       "--filter", "gaussian",   "--threshold",
                                       "0.1",      "--seed",     "4",
                                       "--quiet",  "--output",   (folder.path() / name).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_etendue(arguments);
  };
  const Ended whole = run("whole.exr", {"--preview", (folder.path() / "look.png").string(), "--progress"});
  ASSERT_EQ(whole.code, 0) << whole.err;
  const Ended part = run("part.exr", {"--crop", "8,5,29,17", "--aov", "all"});
  ASSERT_EQ(part.code, 0) << part.err;
  EXPECT_TRUE(holds(folder.contents() == "look.png part.exr part.png whole.exr whole.png")) << folder.contents();
  EXPECT_TRUE(holds(whole.err.find("render 50 %\n") != std::string::npos)) << whole.err;
  const auto large = read_image(folder.path() / "whole.exr"), small = read_image(folder.path() / "part.exr");
  ASSERT_TRUE(large.ok() && small.ok());
  ASSERT_EQ(small->columns, 21);
  ASSERT_EQ(small->rows, 12);
  std::uint64_t wrong = 0;
  for (int row = 0; row < 12; ++row) {
    for (int column = 0; column < 21; ++column)
      wrong += (small->at(column, row) != large->at(column + 8, row + 5)).any() ? 1u : 0u;
  }
  EXPECT_TRUE(all_agree(wrong, 21 * 12));
  const auto look = read_image(folder.path() / "look.png"), shown = read_image(folder.path() / "whole.png");
  ASSERT_TRUE(look.ok() && shown.ok());
  wrong = 0;
  for (std::size_t i = 0; i < look->pixels.size(); ++i) wrong += (look->pixels[i] != shown->pixels[i]).any() ? 1u : 0u;
  EXPECT_TRUE(all_agree(wrong, look->pixels.size()));
  const auto channels = read_image_channels(folder.path() / "part.exr");
  ASSERT_TRUE(channels.ok());
  std::set<std::string> names;
  for (const ImageChannel& channel : *channels) names.insert(channel.name);
  const std::set<std::string> expected{"depth",    "normal.X", "normal.Y", "normal.Z", "albedo.R",
                                       "albedo.G", "albedo.B", "object",   "samples",  "tree_depth"};
  EXPECT_TRUE(holds(names == expected));
}

// CLAIM      A rendering that was interrupted goes on with --resume, to the bytes of one that was not, and clears up; with other
//            settings it is refused with 3.
// ORACLE     metamorphic: the PNG of a rendering without a pause.
// TOLERANCE  none.
TEST(RenderCommand, ResumesAfterAnInterruption) {
  proves({}, Oracle::metamorphic, "the PNG of a rendering without a pause");
  const TemporaryFolder folder;
  std::vector<std::string> arguments{"render",    mirrors(),    "--columns", "300",      "--samples",
                                     "6",         "--sampling", "jittered",  "--filter", "tent",
                                     "--threads", "1",          "--output"};
  const auto to = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> all = arguments;
    all.push_back((folder.path() / name).string());
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  ProcessOptions stop;
  stop.interrupt_after = 0.8;
  const Ended stopped = run_etendue(to("a.png", {}), stop);
  ASSERT_EQ(stopped.code, 6) << stopped.err;
  EXPECT_TRUE(holds(folder.contents() == "a.incomplete.exr a.incomplete.png a.resume")) << folder.contents();
  const Ended other = run_etendue(to("a.png", {"--resume", "--depth", "3"}));
  EXPECT_TRUE(holds(other.code == 3)) << other.err;
  const Ended resumed = run_etendue(to("a.png", {"--resume"}));
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_TRUE(holds(folder.contents() == "a.exr a.png")) << folder.contents();
  const Ended whole = run_etendue(to("b.png", {}));
  ASSERT_EQ(whole.code, 0) << whole.err;
  EXPECT_TRUE(holds(read_text(folder.path() / "a.png") == read_text(folder.path() / "b.png")));
  const auto rays = [](const Ended& ended) {
    const auto begin = ended.out.find("rays ");
    return ended.out.substr(begin, ended.out.find('\n', begin) - begin);
  };
  EXPECT_TRUE(holds(rays(resumed) == rays(whole))) << rays(resumed) << "\n" << rays(whole);
}

// CLAIM      Options of render that mean nothing are refused with 2 and say what is expected; nothing is written.
// ORACLE     table: one case a rule.
// TOLERANCE  none.
TEST(RenderCommand, RefusesWhatMeansNothing) {
  proves({}, Oracle::table, "one case a rule");
  const TemporaryFolder folder;
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"--size", "40"}, "COLUMNSxROWS"},
      {{"--size", "0x7"}, "COLUMNSxROWS"},
      {{"--size", "9x9", "--columns", "8"}, "both say how wide"},
      {{"--crop", "0,0,501,5"}, "LEFT,TOP,RIGHT,BOTTOM"},
      {{"--crop", "5,5,5,9"}, "LEFT,TOP,RIGHT,BOTTOM"},
      {{"--threshold", "0.1"}, "is for --sampling adaptive"},
      {{"--sampling", "adaptive", "--threshold", "0.1,0.2"}, "a contrast in [0, 1]"},
      {{"--sampling", "adaptive", "--threshold", "nan"}, "a contrast in [0, 1]"},
      {{"--sampling", "adaptive", "--samples", "3"}, "is not 1, 2, 4, 8 or 16"},
      {{"--aov", "depht"}, "some of depth, normal"},
      {{"--preview", "a.exr"}, "a name that ends in .png"},
      {{"--ray-tree", "1,1", "--resume"}, "makes no picture"},
  };
  for (const auto& [options, words] : cases) {
    std::vector<std::string> arguments{"render", mirrors(), "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    if (options[0] != "--ray-tree") arguments.insert(arguments.end(), {"--output", (folder.path() / "a.png").string()});
    const Ended ended = run_etendue(arguments);
    EXPECT_TRUE(holds(ended.code == 2 && ended.err.find(words) != std::string::npos)) << options[1] << ended.err;
  }
  EXPECT_EQ(folder.contents(), "");
}

}  // namespace
}  // namespace etendue::validation
