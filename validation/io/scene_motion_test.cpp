// SPDX-License-Identifier: Apache-2.0
#include "io/scene_texts.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

// CLAIM      Shutter, velocities and frost are read: a velocity is turned and scaled with its object's numbers, a group's is added to
//            those of its children, caps go with their cylinder; what is out of range is refused by name.
// ORACLE     exact: quarter turns and dyadic numbers; the words of the messages.
// TOLERANCE  none.
TEST(SceneReader, HoldsWhatMoves) {
  proves({}, Oracle::exact, "quarter turns and dyadic numbers");
  const TemporaryFolder folder;
  const std::string text = R"({"format": "etendue-scene", "version": 1, "unit": "m",
      "camera": {"eye": [0, -4, 0], "look_at": [0, 0, 0], "up": [0, 0, 1], "horizontal_fov_deg": 45,
                 "resolution": [4, 3], "shutter": 0.5},
      "materials": {"m": {"k_t": 1, "frost": 0.25}, "clear": {"k_d": 0.5}},
      "objects": [
        {"type": "sphere", "material": "m", "centre": [0, 0, 0], "radius": 1, "velocity": [1, 2, 3]},
        {"type": "group", "velocity": [4, 0, 8], "transform": [{"rotate": {"axis": [0, 0, 1], "angle_deg": 90}}],
          "children": [
            {"type": "cylinder", "material": "clear", "caps": true, "base": [0, 0, 0], "top": [0, 0, 1], "radius": 1,
              "velocity": [1, 0, 0], "transform": [{"scale": 2}]},
            {"type": "sphere", "material": "m", "centre": [0, 0, 0], "radius": 1}]},
        {"type": "sphere", "material": "clear", "centre": [0, 0, 0], "radius": 1}]})";
  const Scene scene = read(folder, text);
  EXPECT_EQ(scene.camera.shutter, 0.5);
  EXPECT_EQ(scene.materials[0].frost, 0.25);
  EXPECT_EQ(scene.materials[1].frost, 0);
  const std::vector<Vec3> expected{{1, 2, 3}, {0, 6, 8}, {0, 6, 8}, {0, 6, 8}, {0, 4, 8}, {0, 0, 0}};
  ASSERT_EQ(scene.objects.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(scene.objects[i].velocity, expected[i]) << i;

  const auto refused = [&](const std::string& from, const std::string& to, const std::string& message) {
    std::string wrong = text;
    wrong.replace(wrong.find(from), from.size(), to);
    const auto file = read_scene(folder.add("wrong.json", wrong));
    EXPECT_TRUE(holds(!file && file.error().message.find(message) != std::string::npos))
        << (file ? "taken: " + to : file.error().message);
  };
  refused("\"shutter\": 0.5", "\"shutter\": -1", "/camera/shutter: found -1, expected a number in [0, 1e+50]");
  refused("\"frost\": 0.25", "\"frost\": 0.75", "/materials/m/frost: found 0.75, expected a number in [0, 0.5]");
  refused("[1, 2, 3]", "[1, 2]", "/objects/0/velocity: found an array of 2 items");
  refused("[4, 0, 8]", "[4, 0, 1e60]", "/objects/1/velocity/2: found 1e60, expected a number in");
}

}  // namespace
}  // namespace etendue::validation
