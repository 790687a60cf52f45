// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <nlohmann/json.hpp>

#include "etendue/io/image_file.hpp"
#include "etendue/reflectance/mapping.hpp"
#include "support/evidence.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {
namespace {

constexpr std::array<const char*, 6> kNames{"right", "left", "back", "front", "top", "bottom"};

/// A sphere each on the six axes, far and so large that it fills the middle of a view, red k/8 for the k-th; and one around the middle.
std::string six_spheres(const std::string& more = "") {
  const char* const at[] = {"9, 0, 0", "-9, 0, 0", "0, 9, 0", "0, -9, 0", "0, 0, 9", "0, 0, -9"};
  std::string materials, objects;
  for (int k = 0; k < 6; ++k) {
    const std::string n = std::to_string(k);
    materials += "\"m" + n + R"(": {"emission": [)" + std::to_string((k + 1) / 8.0) + ", 0, 0]}, ";
    objects += R"({"type": "sphere", "material": "m)" + n + R"(", "centre": [)" + at[k] + R"(], "radius": 3}, )";
  }
  return R"({"format": "etendue-scene", "version": 1, "unit": "m",
    "camera": {"eye": [0, 0, 0], "gaze": [0, 1, 0], "up": [0, 0, 1], "horizontal_fov_deg": 60, "resolution": [24, 10]},
    "materials": {)" +
         materials + R"("ball": {"k_r": 1)" + more + R"(}}, "objects": [)" + objects +
         R"({"type": "group", "name": "mirror", "children": [
           {"type": "sphere", "name": "ball", "material": "ball", "centre": [0, 0, 0], "radius": 1}]}]})";
}

// CLAIM      IU.4.1.3: --cube writes the six images of a cube's surroundings, each square and named by where it looks; --hide takes out what
//            would stand in the way. A material's "environment" reads them back: what is mirrored straight back is the middle of an image.
// ORACLE     table: six spheres on the axes, of six colours.
// TOLERANCE  2^-24 of a colour, which the EXR holds as a float; a mean of equal numbers.
TEST(CubeCommand, MakesTheImagesThatMirrorsRead) {
  proves({"IU.4.1.3"}, Oracle::table, "six colours on six axes");
  const TemporaryFolder folder;
  const std::string scene = folder.add("scene.json", six_spheres()).string();
  const std::string name = (folder.path() / "around.exr").string();
  for (const char* const method : {"raytrace", "raster"}) {
    const Ended ended = run_etendue({"render", scene, "--cube", "0,0,0", "--hide", "mirror", "--method", method,
                                     "--samples", "1", "--columns", "15", "--json", "--output", name});
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_TRUE(holds(nlohmann::json::parse(ended.out).size() == 6));
    for (std::size_t k = 0; k < 6; ++k) {
      const auto image = read_image(folder.path() / ("around." + std::string(kNames[k]) + ".exr"));
      ASSERT_TRUE(image.ok()) << (image.ok() ? "" : image.error().message);
      EXPECT_TRUE(holds(image->columns == 15 && image->rows == 15));
      EXPECT_TRUE(near(image->at(7, 7)[0], static_cast<double>(k + 1) / 8, 0x1p-24));
      EXPECT_TRUE(holds(std::filesystem::exists(folder.path() / ("around." + std::string(kNames[k]) + ".png"))));
    }
  }
  // Looked at along an axis, the ball mirrors the image behind the eye in its middle.
  folder.add("mapped.json", six_spheres(R"(, "environment": "around")"));
  for (std::size_t k = 0; k < 6; ++k) {
    const CubeView view = cube_view(kCubeFaces[k]);
    const auto text = [](const Vec3& v) {
      return "[" + std::to_string(v.x()) + ", " + std::to_string(v.y()) + ", " + std::to_string(v.z()) + "]";
    };
    std::string looking = read_text(folder.path() / "mapped.json");
    const std::string before = R"("eye": [0, 0, 0], "gaze": [0, 1, 0], "up": [0, 0, 1])";
    looking.replace(
        looking.find(before), before.size(),
        R"("eye": )" + text(4 * view.gaze) + R"(, "gaze": )" + text(-view.gaze) + R"(, "up": )" + text(view.up));
    const std::string path = folder.add("looking.json", looking).string();
    const std::string picture = (folder.path() / "picture.exr").string();
    const Ended ended =
        run_etendue({"render", path, "--samples", "1", "--size", "9x9", "--quiet", "--output", picture});
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_TRUE(near(read_image(picture)->at(4, 4)[0], static_cast<double>(k + 1) / 8, 0x1p-23));
  }
}

// CLAIM      What is wrong with --cube, --hide and "environment" is said.
// ORACLE     exact: the words of each message, and the exit code.
// TOLERANCE  none.
TEST(CubeCommand, RefusesWhatItCannotDo) {
  proves({}, Oracle::exact, "one message for each fault");
  const TemporaryFolder folder;
  const std::string scene = folder.add("scene.json", six_spheres()).string();
  const std::string name = (folder.path() / "no.exr").string();
  const auto refused = [&](std::vector<std::string> options, int code, const std::string& words) {
    options.insert(options.begin(), {"render", scene, "--output", name, "--quiet"});
    const Ended ended = run_etendue(options);
    return holds(ended.code == code && ended.err.find(words) != std::string::npos) << ended.code << " " << ended.err;
  };
  EXPECT_TRUE(refused({"--cube", "1,2"}, 2, "option '--cube': found '1,2', expected X,Y,Z"));
  EXPECT_TRUE(refused({"--cube", "1,2,nan"}, 2, "option '--cube': found '1,2,nan', expected X,Y,Z"));
  EXPECT_TRUE(refused({"--cube", "0,0,0", "--size", "4x4"}, 2, "option '--size' is for one picture"));
  EXPECT_TRUE(refused({"--cube", "0,0,0", "--resume"}, 2, "option '--resume' is for one picture"));
  EXPECT_TRUE(
      refused({"--hide", "miror"}, 2, "option '--hide': found 'miror', expected the name of an object or a group"));
  const auto unread = [&](const std::string& more, int code, const std::string& words) {
    const std::string path = folder.add("mapped.json", six_spheres(more)).string();
    const Ended ended = run_etendue({"render", path, "--quiet", "--output", name});
    return holds(ended.code == code && ended.err.find(words) != std::string::npos) << ended.code << " " << ended.err;
  };
  EXPECT_TRUE(unread(R"(, "environment": "absent")", 5, "absent.right.png"));
  EXPECT_TRUE(unread(R"(, "k_t": 0, "environment": 3)", 3, "environment: found 3, expected a text in quotes"));
  folder.add("wrong.right.exr", "no image");
  EXPECT_TRUE(
      unread(R"(, "environment": "wrong")", 5, "environment: found \"wrong\", expected the name of six images"));
  const std::string dull = folder
                               .add("dull.json", R"({"format": "etendue-scene", "version": 1, "unit": "m",
    "camera": {"eye": [0, 0, 0], "gaze": [0, 1, 0], "up": [0, 0, 1], "horizontal_fov_deg": 60, "resolution": [4, 4]},
    "materials": {"a": {"environment": "x"}},
    "objects": [{"type": "sphere", "material": "a", "centre": [0, 3, 0], "radius": 1}]})")
                               .string();
  const Ended ended = run_etendue({"render", dull, "--output", name});
  EXPECT_TRUE(holds(ended.err.find("found \"environment\" without \"k_r\"") != std::string::npos)) << ended.err;
}

}  // namespace
}  // namespace etendue::validation
