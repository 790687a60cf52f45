// SPDX-License-Identifier: Apache-2.0
#include <sys/resource.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

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

/// The four numbers of a window in an OpenEXR header: attribute "name", its type "box2i", its size, the numbers.
std::vector<std::int32_t> exr_window(const std::filesystem::path& path, const std::string& name) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  const std::string text = bytes.str(), head = name + '\0' + "box2i" + '\0';
  const std::size_t at = text.find(head);
  std::vector<std::int32_t> window(4, -1);
  if (at == std::string::npos || at + head.size() + 20 > text.size()) return window;
  std::memcpy(window.data(), text.data() + at + head.size() + 4, 16);
  return window;
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

// CLAIM      A material that sends on more than arrives is rendered as it says, with a warning that names it and its place.
// ORACLE     closed form: a pane of index 1 with k_r = 1 and k_t = 0.5 before a background of 0.25: 0.25 + 0.125, whole in binary.
// TOLERANCE  none.
TEST(RenderCommand, WarnsOfAMaterialThatAddsLight) {
  proves({"IU.5-2"}, Oracle::closed_form, "a pane of k_r + k_t = 1.5 shows 1.5 times its surroundings");
  const TemporaryFolder folder;
  const std::string scene = folder
                                .add("pane.json", R"({"format": "etendue-scene", "version": 1, "unit": "m",
 "camera": {"eye": [0, 0, 2], "look_at": [0, 0, 0], "up": [0, 1, 0], "horizontal_fov_deg": 40, "resolution": [4, 4]},
 "background": 0.25, "materials": {"bright pane": {"k_r": 1, "k_t": 0.5, "eta": 1}},
 "objects": [{"type": "plane", "material": "bright pane", "point": [0, 0, 0], "normal": [0, 0, 1]}]})")
                                .string();
  const std::string picture = (folder.path() / "pane.exr").string();
  const Ended loud = run_etendue({"render", scene, "--samples", "1", "-o", picture});
  EXPECT_EQ(loud.code, 0);
  EXPECT_EQ(loud.err,
            "etendue render: warning: " + scene +
                ":3:51: /materials/bright pane: found \"k_r\" + \"k_t\" = 1.5 in material 'bright pane', expected at "
                "most 1: the rays that go on bring more than arrives\n");
  const auto image = read_image(picture);
  ASSERT_TRUE(image.ok()) << image.error().message;
  std::uint64_t other = 0;
  for (const auto& pixel : image.value().pixels) other += (pixel != 0.375).any() ? 1u : 0u;
  EXPECT_TRUE(all_agree(other, 16));
  const Ended quiet = run_etendue({"render", scene, "--samples", "1", "--quiet", "--output", picture});
  EXPECT_EQ(quiet.code, 0);
  EXPECT_EQ(quiet.err, "");
  const Ended tree = run_etendue({"ray-tree", scene, "--pixel", "1", "1"});
  EXPECT_EQ(tree.code, 0);
  EXPECT_NE(tree.err.find("etendue ray-tree: warning: "), std::string::npos) << tree.err;
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
//            channels and its place, the preview ends as the PNG.
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
  EXPECT_TRUE(holds(exr_window(folder.path() / "part.exr", "dataWindow") == std::vector<std::int32_t>{8, 5, 28, 16}));
  EXPECT_TRUE(
      holds(exr_window(folder.path() / "part.exr", "displayWindow") == std::vector<std::int32_t>{0, 0, 39, 29}));
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
  std::vector<std::string> arguments{"render",    mirrors(),    "--columns", "150",      "--samples",
                                     "6",         "--sampling", "jittered",  "--filter", "tent",
                                     "--threads", "1",          "--output"};
  const auto to = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> all = arguments;
    all.push_back((folder.path() / name).string());
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  ProcessOptions stop;
  stop.interrupt_at = "render [";
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
      {{"--aov", ""}, "some of depth, normal"},
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
