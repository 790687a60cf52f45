// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <vector>

#include "cli/furnace_text.hpp"
#include "io/example_scene.hpp"
#include "io/surface_texts.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

/// The scene of docs/scene-format.md with one thing changed.
std::string with(const std::string& original, const std::string& instead) {
  std::string text = example_scene();
  return text.replace(text.find(original), original.size(), instead);
}

/// The furnace with `text` before the name of the scene, of each object and of its material, with a screen, undivided.
std::string renamed_furnace(const std::string& text) {
  std::string scene = replaced(furnace_text(), "\"objects\": [", R"("objects": [{"type": "polygon", "name": "screen",
    "material": "glowing", "vertices": [[0.5, 1, 0.4], [1.4, 1.3, 0.4], [1.4, 1.3, 1.1], [0.5, 1, 1.1]]},)");
  for (const std::string before : {"\"name\": \"", "\"glowing"}) {
    for (std::size_t at = scene.find(before); at != std::string::npos; at = scene.find(before, at + before.size())) {
      scene.insert(at + before.size(), text);
    }
  }
  const std::string division = ", \"elements\": [";
  for (std::size_t at = scene.find(division); at != std::string::npos; at = scene.find(division)) {
    scene.erase(at, scene.find(']', at) + 1 - at);
  }
  return scene;
}

/// May a terminal show it as it is? Printable characters and line ends only.
bool is_harmless(const std::string& text) {
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte != '\n' && (byte < 0x20 || byte == 0x7F)) return false;
  }
  return text.find("\xC2\x9B") == std::string::npos && text.find("\xE2\x80\xAE") == std::string::npos;
}

// CLAIM      All errors of a scene are reported, with file, line, column, JSON pointer, what was found and what is
//            expected, in the order of their places; an unknown key with the nearest known one.
// ORACLE     exact: seven errors in two files, placed by hand.
// TOLERANCE  none.
TEST(Program, ReportsAllErrorsOfAScene) {
  proves({}, Oracle::exact, "seven errors in two files, placed by hand");
  const TemporaryFolder folder;
  folder.add("part.json",
             "{\"format\": \"etendue-scene\", \"version\": 1, \"unit\": \"cm\",\n"
             "\"materials\": {\"clay\": {\"k_d\": 2}}}");
  const auto scene =
      folder.add("scene.json",
                 "{\"format\": \"etendue-scene\", \"version\": 1, \"unit\": \"ell\", \"include\": [\"part.json\"],\n"
                 "\"camera\": {\"eye\": [0, 0], \"gaze\": [0, 1, 0], \"up\": [0, 0, 1], \"horizontal_fov_deg\": 45},\n"
                 "\"objects\": [{\"type\": \"sphere\", \"material\": \"caly\", \"centre\": [0, 9, 0], \"raduis\": 1},\n"
                 "            {\"type\": \"polygon\", \"material\": \"clay\",\n"
                 "             \"vertices\": [[0, 0, 0], [1, 1, 0], [1, 0, 0], [0, 1, 0]]}]}");
  const std::string main = scene.string() + ":", part = (folder.path() / "part.json").string() + ":";
  const std::string expected =
      main + "1:51: /unit: found \"ell\", expected one of \"m\", \"cm\", \"mm\", \"um\", \"km\", \"ft\" or \"in\"\n" +
      main + "2:11: /camera: found no key \"resolution\", expected one: it is mandatory here\n" + main +
      "2:19: /camera/eye: found an array of 2 items, expected an array of 3 numbers\n" + main +
      "3:44: /objects/0/material: found \"caly\", expected a material of this scene; did you mean 'clay'?\n" + main +
      "3:73: /objects/0/raduis: found an unknown key, expected a known one; did you mean 'radius'?\n" + main +
      "5:26: /objects/1/vertices: found a polygon that is none: edges 0-1 (0, 0, 0) to (1, 1, 0) and 2-3 (1, 0, 0) to "
      "(0, 1, 0) cross or touch; expected a flat one whose edges do not cross\n" +
      part + "2:31: /materials/clay/k_d: found 2, expected a number in [0, 1]\n7 errors\n";
  for (const std::string command : {"render", "solve"}) {
    const Ended ended = run_etendue({command, scene.string()});
    EXPECT_EQ(ended.code, 3);
    EXPECT_EQ(ended.out, "");
    EXPECT_EQ(ended.err, "etendue " + command + ": " + expected);
    EXPECT_EQ(folder.contents(), "part.json scene.json");
  }
  EXPECT_TRUE(all_agree(::testing::Test::HasFailure() ? 1 : 0, 8));
}

// CLAIM      Nothing in a scene file, its name or the command line can command the terminal or feign another line: no
//            control character of theirs reaches a stream.
// ORACLE     exact: escape sequences planted in names, texts, keys, file names and arguments.
// TOLERANCE  none.
TEST(Program, PrintsNothingThatCommandsATerminal) {
  proves({}, Oracle::exact, "escape sequences planted everywhere");
  const std::string json = R"(\u001b[2J\u009b1m\u202e\n\r\u0007)";  // in a JSON text
  const std::string raw = "\x1b[2J\n\r\xC2\x9B";                    // in a name of a file
  const std::string wall = R"({"type": "plane", "material": "wall",)";
  const TemporaryFolder folder;
  const std::string named = folder.add("named.json", with(wall, wall + R"( "name": ")" + json + R"(",)")).string();
  std::vector<std::vector<std::string>> all{
      {"render", named, "--columns=4", "--output", (folder.path() / "a.png").string()},
      {"render", named, "--ray-tree=160,200", "--depth=1"},
      {"solve", named},
      {"solve", folder.add("a.json", with("\"unit\": \"cm\"", "\"unit\": \"" + json + "\"")).string()},
      {"solve", folder.add("b.json", with("\"ambient\"", "\"" + json + "\"")).string()},
      {"solve", folder.add("c.json", with("\"material\": \"glass\"", "\"material\": \"" + json + "\"")).string()},
      {"solve", folder.add("d.json", with("{\n", "{\"include\": [\"" + json + "\"],\n")).string()},
      {"solve", folder.add(raw + ".json", "{").string()},
      {"solve", folder.path() / raw},
      {"solve", named, "--output", (folder.path() / raw / "a.png").string()},
      {"solve", named, "--output", "a." + raw},
      {"solve", named, "--" + raw},
      {"render", named, "--ray-tree=" + raw},
      {"render", named, "--ray-tree=0,0", "--output", raw},
      {raw},
      {"--" + raw},
      {"--version", raw},
  };
  const std::string glowing = folder.add("glowing.json", renamed_furnace(json)).string();
  const std::string ball = folder
                               .add("ball.json", replaced(renamed_furnace(json), "\"objects\": [",
                                                          R"("objects": [
    {"type": "sphere", "name": ")" + json + R"(", "material": "glowing)" +
                                                              json + R"(", "centre": [1, 1, 1], "radius": 0.1},)"))
                               .string();
  const std::string solution = (folder.path() / "g.json").string();  // by one of the runs below
  const auto [name, text] = room_texts().front();                    // a .vs3, whose names have no blanks
  const std::string view3d =
      folder.add(name, replaced(replaced(text, "T box", "T \x1b[2J\xC2\x9B"), "wall-0", "\x1b[2J\xC2\x9B\xFF"))
          .string();
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
           {"form-factors", glowing, "--relative=1e-2"},
           {"form-factors", glowing, "--relative=1e-2", "--json"},
           {"form-factors", glowing, "--relative=1e-2", "--pair", raw, "1"},
           {"form-factors", glowing, "--relative=1e-2", "--pair", "1", "2"},
           {"form-factors", ball, "--method=certified"},
           {"form-factors", view3d},
           {"form-factors", view3d, "--pair", "1", "2", "--json"},
           {"form-factors", view3d, "--relative=0", "--absolute=0"},
           {"form-factors", view3d, "--output", (folder.path() / (raw + ".csv")).string()},
           {"render", named, "--ray-tree=160,200", "--depth=1", "--json"},
           {"render", named, "--columns=4", "--json", "--output", (folder.path() / (raw + ".png")).string()},
           {"render", named, "--columns=4", "--output", (folder.path() / (raw + ".png")).string()},
           {"solve", glowing, "--tolerance=1e-2", "--json", "--output", (folder.path() / "g.png").string()},
           {"solve", glowing, "--method=progressive", "--resolution=64", "--json", "--output",
            (folder.path() / "p.png").string()},
           {"solve", glowing, "--tolerance=1e-2", "--output", (folder.path() / (raw + ".png")).string()},
           {"view", solution, "--output", (folder.path() / "v.png").string()},
           {"view", solution, "--json", "--output", (folder.path() / "v.png").string()},
           {"view", solution, "--output", (folder.path() / (raw + ".png")).string()},
           {"view", (folder.path() / raw).string()},
           {"view", solution, "--eye", raw},
           {"view", solution, "--camera", folder.add("e.json", "{\"" + json + "\": 1}").string()},
           {"view", solution, "--scene", (folder.path() / raw).string()},
       }) {
    all.push_back(more);
  }
  std::uint64_t wrong = 0, silent = 0;
  for (const auto& arguments : all) {
    const Ended ended = run_etendue(arguments);
    const std::string said = ended.out + ended.err;
    const bool shown = said.find("\\x1b[2J") != std::string::npos || said.find("\\u001b[2J") != std::string::npos;
    if (!shown && &arguments != &all[0]) {
      ++silent;
      ADD_FAILURE() << "does not show the text at all:\n" << said;
    }
    if (is_harmless(said)) continue;
    ++wrong;
    ADD_FAILURE() << "after etendue " << arguments.front() << " " << arguments.back() << "\n" << said;
  }
  EXPECT_TRUE(all_agree(wrong + silent, 2 * all.size()));
}

// CLAIM      A word that reads as a number but is none to compute with is a wrong number (3), not the name of a file (5).
// ORACLE     exact: exit codes and words.
// TOLERANCE  none.
TEST(SolveFactors, TakesNoNanForAFile) {
  proves({}, Oracle::exact, "exit codes and words");
  const TemporaryFolder folder;
  const std::string factors = folder.add("F.csv", "0,1\n1,0\n").string();
  for (const std::string word : {"nan", "NaN", "inf", "-inf", "+infinity", "1e999"}) {
    const Ended ended = run_etendue({"solve", "--factors", factors, "--reflectance", "0.5", "--emission", word});
    const std::string expected = "--emission: found '" + word + "', expected a finite number";
    EXPECT_TRUE(holds(ended.code == 3 && ended.err.find(expected) != std::string::npos))
        << word << ended.code << ended.err;
  }
  EXPECT_EQ(run_etendue({"solve", "--factors", factors, "--reflectance", "0.5", "--emission", "nano"}).code, 5);
}

}  // namespace
}  // namespace etendue::validation
