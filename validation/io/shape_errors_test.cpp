// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <vector>

#include "etendue/io/scene_reader.hpp"
#include "support/evidence.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {
namespace {

std::string scene_of(const std::string& objects) {
  return R"({"format": "etendue-scene", "version": 1, "unit": "m",
"camera": {"eye": [0, -4, 0], "gaze": [0, 1, 0], "up": [0, 0, 1], "horizontal_fov_deg": 60, "resolution": [8, 6]},
"materials": {"a": {}}, "objects": )" +
         objects + "}";
}

std::string message_of(const TemporaryFolder& folder, const std::string& objects) {
  const auto scene = read_scene(folder.add("scene.json", scene_of(objects)));
  if (scene) return "accepted";
  const std::string& message = scene.error().message;
  return message.substr(message.find(": ") + 2);
}

/// An object of one kind, what is wrong with it, and where: its pointer below /objects/0.
struct Fault {
  std::string object;
  std::string pointer;
  std::string message;
};

const std::vector<Fault>& faults() {
  static const std::vector<Fault> all{
      {R"("type": "cone", "base": [0, 0, 0], "top": [0, 0, 1], "base_radius": -1)", "/base_radius",
       "found -1, expected a number in [0, 1e+50]"},
      {R"("type": "cone", "base": [0, 0, 0], "top": [0, 0, 1], "base_radius": 0)", "",
       "found both radii 0, expected a cone with an end that is none"},
      {R"("type": "cone", "base": [0, 0, 1], "top": [0, 0, 1], "base_radius": 1)", "",
       "found base and top in one point, expected a cone with a height"},
      {R"("type": "cone", "base": [0, 0, 0], "top": [0, 0, 1], "base_radius": 1, "top_radius": 1e-40)", "",
       "found a cone out of range, expected coordinates within ±1e+36 and lengths in [1e-36, 1e+36] where it stands"},
      {R"("type": "cone", "base": [0, 0, 0], "top": [0, 0, 1], "base_radius": 1, "transform": [{"scale": [1, 1, 2]}])",
       "", "found a scale that is not the same along all axes, expected one number for a cone"},
      {R"("type": "cone", "base": [0, 0, 0], "top": [0, 0, 1], "base_radius": 1, "caps": "both")", "/caps",
       "found \"both\", expected true or false"},
      {R"("type": "cylinder", "base": [0, 0, 0], "top": [0, 0, 1], "radius": -1, "caps": true)", "/radius",
       "found -1, expected a number in (0, 1e+50]"},
      {R"("type": "torus", "centre": [0, 0, 0], "axis": [0, 0, 0], "ring_radius": 2, "tube_radius": 1)", "/axis",
       "found [0, 0, 0], expected a direction"},
      {R"("type": "torus", "centre": [0, 0, 0], "axis": [0, 0, 1], "ring_radius": 2, "tube_radius": 3)", "",
       "found a tube_radius of 3, not below the ring_radius of 2, expected a ring with a hole: a spindle would meet "
       "itself"},
      {R"("type": "torus", "centre": [0, 0, 0], "axis": [0, 0, 1], "ring_radius": 2, "tube_radius": 2)", "",
       "found a tube_radius of 2, not below the ring_radius of 2, expected a ring with a hole: a spindle would meet "
       "itself"},
      {R"("type": "torus", "centre": [0, 0, 0], "axis": [0, 0, 1], "ring_radius": -2, "tube_radius": 1)",
       "/ring_radius", "found -2, expected a number in (0, 1e+50]"},
      {R"("type": "torus", "centre": [1e40, 0, 0], "axis": [0, 0, 1], "ring_radius": 2, "tube_radius": 1)", "",
       "found a torus out of range, expected coordinates within ±1e+36 and lengths in [1e-36, 1e+36] where it stands"},
      {R"("type": "quadric", "squares": [0, 0, 0], "constant": 1, "low": [0, 0, 0], "high": [1, 1, 1])", "",
       "found no coefficient but \"constant\", expected one that depends on the place"},
      {R"("type": "quadric", "squares": [1, 1, 1], "constant": 1, "low": [-1, -1, -1], "high": [1, 1, 0])", "",
       "found a quadric without a point in its box: its polynomial keeps its sign there"},
      {R"("type": "quadric", "squares": [1, 1, 1], "constant": 0, "low": [-1, -1, -1], "high": [1, 1, 1])", "",
       "found a quadric without a point in its box: its polynomial keeps its sign there"},
      {R"("type": "quadric", "squares": [-1, 0, 0], "products": [0, 0, 1], "linear": [2, 0, 0], "constant": -3,
          "low": [0, 0, 0], "high": [4, 1, 1])",
       "", "found a quadric without a point in its box: its polynomial keeps its sign there"},
      {R"("type": "quadric", "squares": [1, 1, 1], "constant": -1, "low": [2, 2, 2], "high": [3, 3, 3])", "",
       "found a quadric without a point in its box: its polynomial keeps its sign there"},
      {R"("type": "quadric", "squares": [1, 1, 1], "constant": -1, "low": [-1, -1, -1], "high": [1, -1, 1])", "/high",
       "found a coordinate that is not above that of \"low\", expected low < high on each axis"},
      {R"("type": "quadric", "squares": [1, 1, 1], "constant": -1, "low": [-1, -1, -1], "size": [1, 1, 1])", "",
       "found a quadric with other keys, expected either \"low\" and \"high\", or \"centre\" and \"size\""},
      {R"("type": "quadric", "squares": [1, 1], "constant": -1, "low": [-1, -1, -1], "high": [1, 1, 1])", "/squares",
       "found an array of 2 items, expected an array of 3 numbers"},
      {R"("type": "quadric", "squares": [1, 1, 1], "constant": -1, "low": [-1, -1, -1], "high": [1, 1, 1],
          "transform": [{"rotate": {"axis": [0, 0, 1], "angle_deg": 30}}, {"scale": [1, 2, 1]}])",
       "", "found a transform that shears the quadric, expected right angles"},
      {R"("type": "bezier", "control": [[[0, 0, 0], [0, 0, 1], [0, 0, 2], [0, 0, 3]], [[0, 0, 0], [0, 0, 1], [0, 0, 2], [0, 0, 3]],
          [[0, 0, 0], [0, 0, 1], [0, 0, 2], [0, 0, 3]], [[0, 0, 0], [0, 0, 1], [0, 0, 2], [0, 0, 3]]])",
       "/control", "found sixteen points on one line, expected a surface with an area"},
      {R"("type": "bezier", "control": [[[0, 0, 0], [0, 0, 1], [0, 0, 2], [0, 0, 3]]])", "/control",
       "found an array of 1 item, expected an array of 4 rows of control points"},
      {R"("type": "bezier", "control": [[[0, 0, 0], [0, 0, 1], [0, 0, 2]], [[1, 0, 0], [1, 0, 1], [1, 0, 2], [1, 0, 3]],
          [[2, 0, 0], [2, 0, 1], [2, 0, 2], [2, 0, 3]], [[3, 0, 0], [3, 0, 1], [3, 0, 2], [3, 0, 3]]])",
       "/control/0", "found an array of 3 items, expected an array of 4 points"},
      {R"("type": "cone", "base": [0, 0, 0], "top": [0, 0, 1e14], "base_radius": 1, "top_radius": 0.5)", "",
       "found a cone 1e+14 long with a radius of 1 at most, expected a length of at most 2^26 = 67108864 radii"},
      {R"("type": "torus", "centre": [0, 0, 0], "axis": [0, 0, 1], "ring_radius": 1e9, "tube_radius": 1)", "",
       "found a tube_radius of 1 around a ring_radius of 1e+09, expected at least 2^-26 = 1.49e-08 of it"},
      {R"("type": "polygon", "vertices": [[0, 0, 0], [1, 0, 0], [2, 0, 0]])", "/vertices",
       "found a polygon that is none: has no area: its vertices lie on one line, to the rounding of coordinates as "
       "large as 2; expected a flat one whose edges do not cross"},
      {R"("type": "polygon", "vertices": [[0, 0, 0], [1, 0, 0], [1, 1, 0.125], [0, 1, 0]])", "/vertices",
       "found a polygon that is none: vertex 0 = (0, 0, 0) is 0.0207524 off the plane; 9.10383e-13 is allowed (use "
       "triangles); expected a flat one whose edges do not cross"},
      {R"("type": "polygon", "vertices": [[0, 0, 0], [1, 0, "NaN"], [1, 1, 0]])", "/vertices/1/2",
       "found \"NaN\", expected a number in [-1e+50, 1e+50]"},
      {R"("type": "polygon", "vertices": [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], "holes": [])", "/holes",
       "found an array of 0 items, expected an array of 1 or more holes"},
      {R"("type": "polygon", "vertices": [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]], "holes": [[[1, 1, 0], [2, 1, 0]]])",
       "/holes/0", "found an array of 2 items, expected an array of 3 or more vertices"},
      {R"("type": "polygon", "vertices": [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]],
          "holes": [[[1, 1, 0], [2, 1, 0], [1, 2, 0]], [[5, 1, 0], [6, 1, 0], [5, 2, 0]]])",
       "/holes",
       "found hole 1 lies outside the polygon; expected holes inside the polygon, in its plane and apart from each "
       "other"},
      {R"("type": "triangle", "vertices": [[0, 0, 0], [1, 1, 1], [2, 2, 2]])", "/vertices",
       "found three vertices that lie on one line, expected a triangle with an area"},
      {R"("type": "triangle", "vertices": [[0, 0, 0], [1e-200, 0, 0], [0, 1e-200, 0]])", "/vertices",
       "found three vertices that lie within 1e-200 of each other, less than 2^-120 = 7.52e-37, expected a triangle "
       "with an area"},
  };
  return all;
}

// CLAIM      IU.5.0: shapes that are none, of no area, with radii that are not positive, that meet themselves or do not
//            lie in a plane, are refused; the message names the place, the number and what is expected.
// ORACLE     exact: objects with one fault each.
// TOLERANCE  none: the message is known to the letter.
TEST(ShapeErrors, SayWhatIsWrongWithEachShape) {
  proves({"IU.5.0"}, Oracle::exact, "objects with one fault each");
  const TemporaryFolder folder;
  std::uint64_t wrong = 0;
  for (const Fault& fault : faults()) {
    const std::string found = message_of(folder, R"([{"material": "a", )" + fault.object + "}]");
    const std::string expected = "/objects/0" + fault.pointer + ": " + fault.message + "\n1 error";
    if (found == expected) continue;
    ++wrong;
    ADD_FAILURE() << "found    " << found << "\nexpected " << expected;
  }
  EXPECT_TRUE(all_agree(wrong, faults().size()));
  // Just enough is accepted: a sphere that reaches into its box by a hair, above and below the zero of f.
  for (const char* sound :
       {R"("squares": [1, 1, 1], "constant": -1, "low": [0.999, -1, -1], "high": [3, 1, 1])",
        R"("squares": [-1, -1, -1], "constant": 1, "low": [-3, -1, -1], "high": [-0.999, 1, 1])",
        R"("squares": [0, 0, 0], "products": [1, 0, 0], "constant": 0.9, "low": [-1, -1, -1], "high": [1, 1, 1])"}) {
    const std::string found =
        message_of(folder, std::string(R"([{"material": "a", "type": "quadric", )") + sound + "}]");
    EXPECT_TRUE(holds(found == "accepted")) << found;
  }
  const std::string none = message_of(folder, "[]");
  EXPECT_TRUE(holds(none == "/objects: found an array of 0 items, expected an array of 1 or more objects\n1 error"))
      << none;
}

// CLAIM      a quad of a mesh whose corners lie in no plane is taken as two triangles, and a warning says how many there
//            are and how far the worst is off; single precision's rounding is no reason to speak.
// ORACLE     closed form: of the unit square with one corner raised by h, corners are h/(2 √(4+2h²)) off the middle plane.
// TOLERANCE  none: the message is known to the letter.
TEST(ShapeErrors, WarnOfQuadsThatAreNotFlat) {
  proves({"IU.5.0"}, Oracle::closed_form, "the unit square with a raised corner");
  const TemporaryFolder folder;
  const auto warnings = [&](const std::string& height) {
    const auto scene = read_scene(folder.add(
        "scene.json",
        scene_of(R"([{"material": "a", "type": "mesh", "vertices": [[0, 0, 0], [1, 0, 0], [1, 1, )" + height +
                 R"(], [0, 1, 0], [2, 0, 0], [2, 1, 0]], "quads": [[0, 4, 5, 3], [0, 1, 2, 3]]}])")));
    EXPECT_TRUE(scene.ok());
    return scene ? scene->warnings : std::vector<std::string>();
  };
  EXPECT_TRUE(holds(warnings("1e-8").empty()));
  const auto found = warnings("0.5");
  ASSERT_EQ(found.size(), 1U);
  // h = 0.5: 0.118 of the edge, and the longer diagonal is 1.5.
  EXPECT_NE(found[0].find("/objects/0/quads: found 1 quad whose corners do not lie in a plane, the most uneven 1 with "
                          "corners 0.0786 of its diagonal off"),
            std::string::npos)
      << found[0];
}

}  // namespace
}  // namespace etendue::validation
