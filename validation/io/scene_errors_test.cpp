// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "etendue/io/scene_reader.hpp"
#include "io/example_scene.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

/// An error put into a sound scene: `text` stands in place of `original`, which occurs once; the error is `offset`
/// bytes into it.
struct Planted {
  std::string original;
  std::string text;
  std::size_t offset;
  std::string pointer;
  std::string message;
};

/// Most errors of one value: where they are, what is put there, and what the reader must say.
const std::vector<Planted>& planted_errors() {
  static const std::vector<Planted> all{
      {R"("unit": "cm")", R"("unit": "cms")", 8, "/unit",
       R"(found "cms", expected one of "m", "cm", "mm", "um", "km", "ft" or "in"; did you mean 'cm'?)"},
      {R"("unit": "cm",)", R"()", 0, "", R"(found no key "unit", expected one: it is mandatory here)"},
      {R"("scene.schema.json")", R"(5)", 0, "/$schema", "found 5, expected a text in quotes"},
      {R"("version": 1)", R"("version": 2)", 11, "/version", "found 2, expected 1"},
      {R"("version": 1)", R"("version": "1")", 11, "/version", R"(found "1", expected 1)"},
      {R"("etendue-scene")", R"("gltf")", 0, "/format", R"(found "gltf", expected "etendue-scene")"},
      {R"("ambient": 0.3)", R"("ambeint": 0.3)", 0, "/ambeint",
       "found an unknown key, expected a known one; did you mean 'ambient'?"},
      {R"("ambient": 0.3)", R"("ambient": 1e999)", 11, "/ambient",
       "found 1e999, expected a number in [0, 1e+50] that a double can hold"},
      {R"("ambient": 0.3)", R"("ambient": -1e-999)", 11, "/ambient",
       "found -1e-999, expected a number in [0, 1e+50] that a double can hold"},
      {R"("ambient": 0.3)", R"("ambient": "NaN")", 11, "/ambient",
       R"(found "NaN", expected a number in [0, 1e+50], or an array of 3 of them (red, green, blue))"},
      {R"("ambient": 0.3)", R"("ambient": null)", 11, "/ambient",
       "found null, expected a number in [0, 1e+50], or an array of 3 of them (red, green, blue)"},
      {R"([0.02, 0.02, 0.05])", R"([0.02, 0.02])", 0, "/background",
       "found an array of 2 items, expected a number in [0, 1e+50], or an array of 3 of them (red, green, blue)"},
      {R"("look_at": [0, 0, 50])", R"("gaze": [0, 0, -3])", 0, "/camera",
       "camera: gaze (0, 0, -1) and up (0, 0, 1) are parallel; choose another up"},
      {R"("look_at": [0, 0, 50])", R"("look_at": [0, -400, 150])", 11, "/camera/look_at",
       "found the point of \"eye\", expected another point"},
      {R"("look_at": [0, 0, 50],)", R"()", 0, "/camera", R"(found neither "look_at" nor "gaze", expected one of them)"},
      {R"("up": [0, 0, 1])", R"("up": [0, 0, 0])", 6, "/camera/up", "found [0, 0, 0], expected a direction"},
      {R"(_deg": 45)", R"(_deg": 180)", 7, "/camera/horizontal_fov_deg", "found 180, expected a number in (0, 180)"},
      {R"([320, 240])", R"([320, 0])", 6, "/camera/resolution/1", "found 0, expected an integer in [1, 65536]"},
      {R"([320, 240])", R"([320, 24.5])", 6, "/camera/resolution/1", "found 24.5, expected an integer in [1, 65536]"},
      {R"([320, 240])", R"([65536, 65536])", 0, "/camera/resolution",
       "found 65536 x 65536 pixels, expected at most 268435456"},
      {R"("rho": 0.5)", R"("rho": 1)", 7, "/materials/wall/rho", "found 1, expected a number in [0, 1)"},
      {R"("k_d": 0.3)", R"("k_d": -0.1)", 7, "/materials/gloss/k_d", "found -0.1, expected a number in [0, 1]"},
      {R"("k_d": 0.3)", R"("k_d": [0.1, 1.1, 0])", 13, "/materials/gloss/k_d/1",
       "found 1.1, expected a number in [0, 1]"},
      {R"("k_d": 0.3)", R"("k_d": 1)", 7, "/materials/gloss/k_d",
       R"(found 1, expected a number below 1, since "rho" is taken from it; give "rho" in [0, 1) to keep 1)"},
      {R"("n": 40)", R"("n": 0.5)", 5, "/materials/gloss/n", "found 0.5, expected a number in [1, 1e+06]"},
      {R"("eta": 1.5)", R"("eta": true)", 7, "/materials/glass/eta", "found true, expected a number in [0.1, 10]"},
      {R"("eta": 1.5)", R"("eta": 0)", 7, "/materials/glass/eta", "found 0, expected a number in [0.1, 10]"},
      {R"("eta": 1.5)", R"("eta": -1.5)", 7, "/materials/glass/eta", "found -1.5, expected a number in [0.1, 10]"},
      {R"("mirror": {"k_r": 0.9})", R"("mirror": {"k_r": 0.9}, "wall": {})", 24, "/materials/wall",
       "found the key a second time, expected each key once"},
      {R"("type": "directional")", R"("type": "directonal")", 8, "/lights/1/type",
       R"(found "directonal", expected one of "point", "directional", "rectangle" or "sphere"; did you mean 'directional'?)"},
      {R"("material": "glass")", R"("material": "glas")", 12, "/objects/1/material",
       R"(found "glas", expected a material of this scene; did you mean 'glass'?)"},
      {R"("radius": 30)", R"("radius": -30)", 10, "/objects/1/radius", "found -30, expected a number in (0, 1e+50]"},
      {R"("radius": 30)", R"("raduis": 30)", 0, "/objects/1/raduis",
       "found an unknown key, expected a known one; did you mean 'radius'?"},
      {R"("element_size": 7.5)", R"("element_size": 0)", 16, "/objects/6/children/0/element_size",
       "found 0, expected a number in (0, 1e+50] (object 'table/top')"},
      {R"("element_size": 7.5)", R"("element_size": [1, 2])", 16, "/objects/6/children/0/element_size",
       "found an array of 2 items, expected a number in (0, 1e+50] (object 'table/top')"},
      {R"("elements": [10, 5])", R"("elements": [10, 5], "element_size": 3)", 37, "/objects/2/element_size",
       R"(found "element_size" beside "elements", expected one of them (object 'back wall'))"},
      {R"("align_mesh": true)", R"("align_mesh": 1)", 14, "/align_mesh", "found 1, expected true or false"},
      {R"("align_mesh": true)", R"("align_mash": true)", 0, "/align_mash",
       "found an unknown key, expected a known one; did you mean 'align_mesh'?"},
      {R"("patches": [5, 5])", R"("patches": [3, 5])", 11, "/objects/2/patches",
       "found [3, 5], expected divisors of the elements [10, 5] (object 'back wall')"},
      {R"([[-90, 0, 0], [-60, 0, 0], [-75, 20, 40]])", R"([[-90, 0, 0], [-60, 0, 0], [-75, 0, 0]])", 0,
       "/objects/3/vertices", "found three vertices that lie on one line, expected a triangle with an area"},
      {R"([[-90, 0, 0], [-60, 0, 0], [-75, 20, 40]])", R"([])", 0, "/objects/3/vertices",
       "found an array of 0 items, expected an array of 3 vertices"},
      {R"("angle_deg": 30)", R"("angle_deg": 40000)", 13, "/objects/6/transform/0/rotate/angle_deg",
       "found 40000, expected a number in [-36000, 36000] (object 'table')"},
      {R"("high": [2, 2, 39])", R"("high": [2, -2, 39])", 8, "/objects/6/children/1/high",
       R"(found a coordinate that is not above that of "low", expected low < high on each axis (object 'table/leg'))"},
      {R"([3, 0, 4])", R"([3, 0, 5])", 7, "/objects/7/triangles/3/2", "found 5, expected an integer in [0, 4]"},
      {R"([3, 0, 4])", R"([3, 3, 4])", 0, "/objects/7/triangles/3",
       "found a face whose corners lie on one line, expected a face with an area"},
      {R"({"scale": [20, 20, 40]})", R"({"scale": [20, 0, 40]})", 15, "/objects/7/transform/0/scale/1",
       "found 0, expected a number in [1e-09, 1e+09]"},
      {R"({"scale": [20, 20, 40]})", R"({"stretch": 2})", 1, "/objects/7/transform/0/stretch",
       R"(found an unknown key, expected one of "translate", "rotate" or "scale")"},
      {R"({"scale": [20, 20, 40]})", R"({"scal": 2})", 1, "/objects/7/transform/0/scal",
       R"(found an unknown key, expected a known one; did you mean 'scale'?)"},
      {R"({"scale": [20, 20, 40]})", R"({})", 0, "/objects/7/transform/0",
       R"(found an object of 0 keys, expected one key "translate", "rotate" or "scale")"},
  };
  return all;
}

/// Line and column of a byte, counted here and in another way than the reader's: by splitting.
std::string place_of(const std::string& text, std::size_t byte) {
  const std::string before = text.substr(0, byte);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::string in_line = before.substr(before.rfind('\n') + 1);
  const auto characters =
      std::count_if(in_line.begin(), in_line.end(), [](char c) { return (static_cast<unsigned char>(c) >> 6) != 2; });
  return std::to_string(line) + ":" + std::to_string(characters + 1);
}

std::string replaced(const std::string& text, const Planted& planted, std::size_t& at) {
  at = text.find(planted.original);
  EXPECT_NE(at, std::string::npos) << planted.original;
  EXPECT_EQ(text.find(planted.original, at + 1), std::string::npos) << planted.original << " must occur once";
  return text.substr(0, at) + planted.text + text.substr(at + planted.original.size());
}

std::string message_of(const std::filesystem::path& path) {
  const auto scene = read_scene(path);
  if (scene) return "accepted";
  EXPECT_EQ(scene.error().code, ErrorCode::invalid_input);
  return scene.error().message;
}

// CLAIM      Each error of a scene file is reported with file, line, column, JSON pointer, what was found and what is
//            expected.
// ORACLE     exact: errors planted at known bytes of a sound scene; the place is counted here by splitting the text.
// TOLERANCE  none: the message is known to the letter.
TEST(SceneErrors, NameTheExactPlaceOfAPlantedError) {
  proves({}, Oracle::exact, "errors planted at known bytes");
  const TemporaryFolder folder;
  const std::string sound = example_scene();
  std::uint64_t wrong = 0, decided = 0;
  for (const Planted& planted : planted_errors()) {
    if (planted.message.empty()) continue;
    std::size_t at = 0;
    const std::string text = replaced(sound, planted, at);
    std::size_t byte = at + planted.offset;
    if (planted.pointer.empty()) byte = 0;                                             // of the file's object
    if (planted.pointer == "/camera") byte = text.find('{', text.find("\"camera\""));  // of the camera's object
    if (planted.pointer == "/materials/wall" && planted.offset == 24) byte = text.find("\"wall\": {}");
    const auto path = folder.add("scene.json", text);
    const std::string expected = path.string() + ":" + place_of(text, byte) + ": " +
                                 (planted.pointer.empty() ? "" : planted.pointer + ": ") + planted.message +
                                 "\n1 error";
    const std::string found = message_of(path);
    ++decided;
    if (found == expected) continue;
    ++wrong;
    ADD_FAILURE() << "found    " << found << "\nexpected " << expected;
  }
  EXPECT_TRUE(all_agree(wrong, decided));
  EXPECT_GE(decided, 35u);
}

// CLAIM      All errors of a file are reported, in the order of their places, not only the first.
// ORACLE     exact: seven errors planted at once.
// TOLERANCE  none.
TEST(SceneErrors, AreAllReportedAtOnce) {
  proves({}, Oracle::exact, "seven errors planted at once");
  const TemporaryFolder folder;
  std::string text = example_scene();
  std::size_t at = 0;
  for (const Planted& planted :
       std::vector<Planted>{{"\"unit\": \"cm\"", "\"unit\": \"ell\"", 0, "", ""},
                            {"[320, 240]", "[320, -240]", 0, "", ""},
                            {"\"ambient\"", "\"ambiant\"", 0, "", ""},
                            {"\"k_r\": 0.9", "\"k_r\": 9", 0, "", ""},
                            {"\"direction\": [1, -1, 2]", "\"direction\": [0, 0, 0]", 0, "", ""},
                            {"\"radius\": 30", "\"radius\": \"30\"", 0, "", ""},
                            {"[3, 0, 4]", "[3, 0, 9]", 0, "", ""}}) {
    text = replaced(text, planted, at);
  }
  std::istringstream lines(message_of(folder.add("scene.json", text)));
  std::vector<std::string> pointers;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find(": /");
    if (begin != std::string::npos) pointers.push_back(line.substr(begin + 2, line.find(": ", begin + 2) - begin - 2));
    if (begin == std::string::npos) pointers.push_back(line);
  }
  const std::vector<std::string> expected{"/unit",
                                          "/camera/resolution/1",
                                          "/ambiant",
                                          "/materials/mirror/k_r",
                                          "/lights/1/direction",
                                          "/objects/1/radius",
                                          "/objects/7/triangles/3/2",
                                          "7 errors"};
  EXPECT_EQ(pointers, expected);
  EXPECT_TRUE(all_agree(pointers == expected ? 0 : 1, 1));
}

/// "7 /objects/0/centre/2, " of each error, and the last line.
std::string lines_and_pointers(const std::string& message) {
  std::istringstream lines(message);
  std::string found;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t place = line.find(".json:");
    if (place == std::string::npos) return found + line;
    const std::size_t pointer = line.find(": /", place);
    found += line.substr(place + 6, line.find(':', place + 6) - place - 6) + " " +
             line.substr(pointer + 2, line.find(": ", pointer + 2) - pointer - 2) + ", ";
  }
  return found;
}

// CLAIM      An object or a light whose type is missing, misspelt or of another kind does not hide its other errors.
// ORACLE     exact: errors planted in objects written for it, one a line.
// TOLERANCE  none: places and numbers are known.
TEST(SceneErrors, AreNotHiddenByATypeThatIsNone) {
  proves({}, Oracle::exact, "errors planted one a line");
  const TemporaryFolder folder;
  const std::string text = R"({"format": "etendue-scene", "version": 1, "unit": "m", "materials": {"wall": {}},
"camera": {"eye": [0, 0, 2], "look_at": [0, 0, 0], "up": [0, 1, 0], "horizontal_fov_deg": 60, "resolution": [4, 4]},
"lights": [{"type": "pont",
  "intensity": -1, "position": [0, 0, 0]}, {
  "intensity": -1}],
"objects": [{"type": "spher",
  "centre": [0, 0, "1"],
  "radius": -1,
  "material": "wall"}, {
  "material": "wal",
  "elements": [0, 1],
  "colour": "red"}, {"type": 5,
  "name": 7,
  "material": "wall",
  "children": [
   {"type": "disc", "centre": [0, 0, 0], "normal": [0, 0, 0], "radius": 1, "material": "wall"}],
  "transform": 1}]})";
  const auto found = lines_and_pointers(message_of(folder.add("scene.json", text)));
  const std::string expected =
      "3 /lights/0/type, 4 /lights/0/intensity, 4 /lights/1, 5 /lights/1/intensity, 6 /objects/0/type, "
      "7 /objects/0/centre/2, 8 /objects/0/radius, 9 /objects/1, 10 /objects/1/material, 11 /objects/1/elements/0, "
      "12 /objects/1/colour, 12 /objects/2/type, 13 /objects/2/name, 16 /objects/2/children/0/normal, "
      "17 /objects/2/transform, 15 errors";
  EXPECT_EQ(found, expected);
  EXPECT_TRUE(all_agree(found == expected ? 0 : 1, 15));
}

// CLAIM      An array of a wrong length, a wrong vertex, or keys that contradict one another do not hide the errors of
//            the values in them and beside them.
// ORACLE     exact: errors planted, their lines counted by hand.
// TOLERANCE  none: places and numbers are known.
TEST(SceneErrors, AreNotHiddenByAWrongCount) {
  proves({}, Oracle::exact, "errors planted in arrays that are too short or too long");
  const TemporaryFolder folder;
  const std::string text = R"({"format": "etendue-scene", "version": 1, "unit": "m", "include": [], "materials": {
  "wall": {"k_d": [0.1, 2]}},
"lights": [{"type": 5, "position": [0, "a"], "intensity": 1}],
"camera": {"look_at": [0, 0, "b"], "gaze": [0, 0, 0], "up": [0, 1, 0], "horizontal_fov_deg": 60, "eye": [0, 0, 1, "c"],
  "resolution": [4, 4, 0]},
"objects": [
 {"type": "polygon", "material": "wall", "vertices": [[0, 0, 0], [0, "d", 0]], "elements": [0]},
 {"type": "triangle", "material": "wall", "vertices": [[0, 0, 0], [0, 1, 0], [1, 1, 0], [1, 0, "e"]]},
 {"type": "box", "material": "wall", "low": [0, 0, "f"], "size": [1, -1, 1]},
 {"type": "mesh", "material": "wall", "vertices": [[0, 0], [0, 1, 0], [1, 1, 0]], "triangles": [[0, 1, 3], [0, -1]]},
 {"type": 5, "material": "wall", "centre": [0, "g", 0], "radius": -1, "normal": [0, 0, 0], "vertices": [[1]]}]})";
  const std::string expected =
      "1 /include, 2 /materials/wall/k_d, 2 /materials/wall/k_d/1, 3 /lights/0/type, 3 /lights/0/position, "
      "3 /lights/0/position/1, 4 /camera, 4 /camera/look_at/2, 4 /camera/gaze, 4 /camera/eye, 4 /camera/eye/3, "
      "5 /camera/resolution, 5 /camera/resolution/2, 7 /objects/0/vertices, 7 /objects/0/vertices/1/1, "
      "7 /objects/0/elements, 7 /objects/0/elements/0, 8 /objects/1/vertices, 8 /objects/1/vertices/3/2, "
      "9 /objects/2, 9 /objects/2/low/2, 9 /objects/2/size/1, 10 /objects/3/vertices/0, "
      "10 /objects/3/triangles/0/2, 10 /objects/3/triangles/1, 10 /objects/3/triangles/1/1, 11 /objects/4/type, "
      "11 /objects/4/centre/1, 11 /objects/4/radius, 11 /objects/4/normal, 11 /objects/4/vertices, "
      "11 /objects/4/vertices/0, 32 errors";
  const auto found = lines_and_pointers(message_of(folder.add("scene.json", text)));
  EXPECT_EQ(found, expected);
  EXPECT_TRUE(all_agree(found == expected ? 0 : 1, 32));
}

// CLAIM      That no object is there is said beside the other errors; not where an included file may hold some.
// ORACLE     exact: one error planted, two, or none but the missing file.
// TOLERANCE  none.
TEST(SceneErrors, SayThatObjectsAreMissingBesideOthers) {
  proves({}, Oracle::exact, "errors planted");
  const TemporaryFolder folder;
  const std::string start = R"({"format": "etendue-scene", "version": 1, "unit": "m")";
  const std::string none = message_of(folder.add("none.json", start + "}"));
  EXPECT_TRUE(holds(none.find("found no object in the scene") != std::string::npos)) << none;
  EXPECT_TRUE(holds(none.find("found no key \"camera\"") != std::string::npos)) << none;
  const std::string absent = message_of(folder.add("absent.json", start + R"(, "include": ["nowhere.json"]})"));
  EXPECT_TRUE(holds(absent.find("nowhere.json") != std::string::npos)) << absent;
  EXPECT_TRUE(holds(absent.find("found no object") == std::string::npos)) << absent;
}

// CLAIM      A file that is no JSON is refused at the place where it stops being JSON, however it fails.
// ORACLE     exact: the place is known from how the text was made.
// TOLERANCE  none.
TEST(SceneErrors, StopAtTheFirstSyntaxError) {
  proves({}, Oracle::exact, "texts broken at known places");
  const TemporaryFolder folder;
  struct Broken {
    std::string text, expected;
  };
  const std::string deep(1000, '[');
  const std::vector<Broken> all{
      {"", "1:1: found the end of the file, expected a value"},
      {"\n\n  ", "3:3: found the end of the file, expected a value"},
      {"{\"format\": \"etendue-scene\",\n \"version\": 1,}", "2:15: found '}', expected a key in quotes"},
      {"{\"version\": 01}", "1:14: /version: found a digit after a leading 0, expected '.', 'e' or the number's end"},
      {"{\"version\": NaN}", "1:13: /version: found 'N', expected a value"},
      {"{\"version\": 1} x", "1:16: found 'x', expected the end of the file"},
      {"{\"a\": \"\\ud800\"}",
       "1:8: /a: found a broken \\u escape, expected four hexadecimal digits that make a character"},
      {"{\"é\": \"tab\there\"}", "1:11: /é: found control character 9 in a string, expected an escape"},
      {"{\"a\": \"open\n", "1:12: /a: found control character 10 in a string, expected an escape"},
      {"{\"a\": \"open", "1:7: /a: found the end of the file in a string, expected '\"'"},
      {"{\"a\": \xff}", "1:7: found a byte that is not UTF-8, expected JSON text in UTF-8"},
      {std::string("\x7f"
                   "ELF\0\0\x01",
                   7),
       "1:1: found control character 127, expected a value"},
      {std::string(3, '\0'), "1:1: found control character 0, expected a value"},
      {deep, "1:66: " +
                 [] {
                   std::string pointer;
                   for (int i = 0; i < 65; ++i) pointer += "/0";
                   return pointer;
                 }() +
                 ": found nesting deeper than 64, expected less"},
  };
  std::uint64_t wrong = 0;
  for (const Broken& broken : all) {
    const auto path = folder.add("scene.json", broken.text);
    const std::string found = message_of(path), expected = path.string() + ":" + broken.expected + "\n1 error";
    if (found != expected) ++wrong;
    EXPECT_EQ(found, expected);
  }
  EXPECT_TRUE(all_agree(wrong, all.size()));
}

// CLAIM      Errors in included files name the included file; missing files and cycles are errors at the "include"
//            itself.
// ORACLE     exact: small files made for it.
// TOLERANCE  none.
TEST(SceneErrors, NameTheIncludedFile) {
  proves({}, Oracle::exact, "small files with known errors");
  const TemporaryFolder folder;
  const std::string head = R"({"format": "etendue-scene", "version": 1, "unit": "cm",)"
                           "\n";
  const std::string dir = folder.path().string();
  folder.add("parts/bad.json", head + R"("materials": {"clay": {"k_d": 2}}})");
  folder.add("parts/back.json", head + R"("include": ["../main.json"]})");
  folder.add("parts/camera.json", head + R"("camera": {}})");
  folder.add("parts/wall.json", head + R"("materials": {"wall": {}}})");
  const std::string sound = example_scene();
  const auto including = [&](const std::string& name) {
    return folder.add("main.json", "{\"include\": [\"" + name + "\"]," + sound.substr(sound.find('{') + 1));
  };
  const auto main = including("parts/bad.json");
  EXPECT_EQ(message_of(main),
            dir + "/parts/bad.json:2:31: /materials/clay/k_d: found 2, expected a number in [0, 1]\n1 error");
  including("parts/none.json");
  EXPECT_EQ(message_of(main), main.string() +
                                  ":1:14: /include/0: found \"parts/none.json\", expected a readable file: cannot "
                                  "read '" +
                                  dir + "/parts/none.json': No such file or directory\n1 error");
  including("parts/back.json");
  EXPECT_EQ(message_of(main),
            dir + "/parts/back.json:2:13: /include/0: found '" + dir +
                "/main.json', which is being read already, expected includes without a cycle\n1 error");
  including("main.json");
  EXPECT_NE(message_of(main).find("main.json:1:14: /include/0: found"), std::string::npos);
  including("parts/camera.json");
  EXPECT_EQ(message_of(main),
            dir +
                "/parts/camera.json:2:11: /camera: found this in an included file, expected it in the main "
                "file only\n1 error");
  including("parts/wall.json");
  EXPECT_NE(message_of(main).find("/materials/wall: found a material of a name that an included file has taken"),
            std::string::npos);
}

}  // namespace
}  // namespace etendue::validation
