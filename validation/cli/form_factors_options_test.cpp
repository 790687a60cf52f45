// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/form_factors_runs.hpp"
#include "io/surface_texts.hpp"
#include "support/evidence.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {
namespace {

/// Two squares that face one another, 1 apart, as an OBJ; and the same in a scene with a box.
constexpr const char* kPlates =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\no floor\nf 1 2 3 4\no lid\nf 8 7 6 5\n";

std::string scene_of(const std::string& objects) {
  return R"({"format": "etendue-scene", "version": 1, "unit": "m",
"camera": {"eye": [0, -4, 0], "look_at": [0, 0, 0], "up": [0, 0, 1], "horizontal_fov_deg": 40, "resolution": [8, 8]},
"materials": {"m": {"k_d": 0.5}},
"objects": [
)" + objects +
         "]}\n";
}

// CLAIM      An option that the method has no use for is refused, as is a unit for a scene that says its own.
// ORACLE     exact: exit code 2, the option's name in the message; exit code 0 with the method that uses it.
// TOLERANCE  none.
TEST(FormFactorsOptions, RefusesWhatTheMethodHasNoUseFor) {
  proves({}, Oracle::exact, "exit codes and the option's name");
  const std::vector<std::vector<std::string>> useless{{"--rays", "10"},  {"--seed", "2"}, {"--resolution", "100"},
                                                      {"--points", "2"}, {"--rotate"},    {"--unit", "mm"}};
  for (const auto& option : useless) {
    std::vector<std::string> arguments{furnace(), "--quiet"};
    arguments.insert(arguments.end(), option.begin(), option.end());
    const Ended ended = form_factors(arguments);
    EXPECT_TRUE(holds(ended.code == 2 && has(ended.err, option.front()))) << option.front() << ended.err;
  }
  EXPECT_EQ(form_factors({furnace(), "--quiet", "--method", "rays", "--resolution", "100"}).code, 2);
  EXPECT_EQ(form_factors({furnace(), "--quiet", "--method", "hemicube", "--rays", "10"}).code, 2);
  EXPECT_EQ(form_factors({furnace(), "--quiet", "--method", "rays", "--rays", "10", "--seed", "2"}).code, 0);
}

// CLAIM      With --unit the areas of a file without one come in square metres too, and --pair says what areas are in;
//            without it, that this is not known.
// ORACLE     exact: a square of one foot has 0.3048² m².
// TOLERANCE  none: the product as double rounds it.
TEST(FormFactorsOptions, GivesFilesAUnit) {
  proves({}, Oracle::exact, "a square foot in square metres");
  const TemporaryFolder folder;
  const std::string scene = folder.add("plates.obj", kPlates).string(), output = (folder.path() / "m.json").string();
  ASSERT_EQ(form_factors({scene, "--quiet", "--unit", "ft", "-o", output}).code, 0);
  const auto known = nlohmann::json::parse(read_text(output));
  EXPECT_TRUE(holds(known.at("metres_per_unit") == 0.3048));
  EXPECT_TRUE(holds(known.at("areas_m2").at(0) == 0.3048 * 0.3048));
  EXPECT_TRUE(holds(known.at("areas").at(0) == 1.0));
  std::filesystem::remove(output);
  ASSERT_EQ(form_factors({scene, "--quiet", "-o", output}).code, 0);
  const auto unknown = nlohmann::json::parse(read_text(output));
  EXPECT_TRUE(holds(unknown.at("metres_per_unit").is_null() && !unknown.contains("areas_m2")));
  EXPECT_TRUE(holds(has(form_factors({scene, "--pair", "1", "2"}).out, "unit         not known")));
  EXPECT_TRUE(holds(has(form_factors({scene, "--pair", "1", "2", "--unit", "ft"}).out, "unit         0.3048 m")));
  EXPECT_EQ(form_factors({scene, "--unit", "yd"}).code, 2);
}

// CLAIM      A checkpoint of another method is refused before rays are shot, not afterwards.
// ORACLE     exact: exit code 3 within a second, of a run whose rays alone take minutes.
// TOLERANCE  none.
TEST(FormFactorsOptions, RefusesAnotherMethodsCheckpointAtOnce) {
  proves({}, Oracle::exact, "the exit code, and that it ends");
  const TemporaryFolder folder;
  const std::string output = (folder.path() / "m.csv").string();
  folder.add("m.csv.checkpoint", "no checkpoint at all");
  ProcessOptions patient;
  patient.interrupt_after = 20;
  const Ended ended = run_etendue(
      {"form-factors", furnace(), "--quiet", "--method", "rays", "--rays", "100000000", "--resume", "-o", output},
      patient);
  EXPECT_EQ(ended.code, 3) << ended.err;
}

// CLAIM      Surfaces that see nothing because they lie inside a solid are named, those that face the void are not.
// ORACLE     exact: a triangle in a closed box; a plate that looks away from everything.
// TOLERANCE  none.
TEST(FormFactorsOptions, NamesSurfacesInsideOthers) {
  proves({}, Oracle::exact, "a triangle in a closed box");
  const TemporaryFolder folder;
  const std::string objects =
      R"({"type": "polygon", "name": "floor", "material": "m", "vertices": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]]},
{"type": "polygon", "name": "away", "material": "m", "vertices": [[0,0,3],[1,0,3],[1,1,3],[0,1,3]]},
{"type": "box", "name": "crate", "material": "m", "low": [0.2,0.2,0.5], "high": [0.8,0.8,0.9]},
{"type": "polygon", "name": "buried", "material": "m", "vertices": [[0.4,0.4,0.6],[0.4,0.5,0.6],[0.5,0.5,0.6]]}
)";
  const std::string scene = folder.add("a.json", scene_of(objects)).string();
  const Ended text = form_factors({scene});
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_TRUE(holds(has(text.out, "see nothing, since they lie inside or under others: 'buried'\n"))) << text.out;
  const auto json = nlohmann::json::parse(form_factors({scene, "--json"}).out);
  EXPECT_TRUE(holds(json.at("remarks").size() == 1 && has(json.at("remarks").at(0), "'buried'")));
}

// CLAIM      What is wrong with a polygon, or with any part of an object, is said with the object's name.
// ORACLE     exact: the end of the message.
// TOLERANCE  none.
TEST(FormFactorsOptions, NamesTheObjectOfAnError) {
  proves({}, Oracle::exact, "the end of the message");
  const TemporaryFolder folder;
  const std::string objects =
      R"({"type": "polygon", "name": "bent", "material": "m", "vertices": [[0,0,0],[1,0,0],[1,1,0.1],[0,1,0]]},
{"type": "group", "name": "set", "children": [
 {"type": "sphere", "name": "ball", "material": "m", "centre": [0,0,0], "radius": -1}]},
{"type": "sphere", "material": "m", "centre": [0,0,0], "radius": -2}
)";
  const Ended ended = form_factors({folder.add("a.json", scene_of(objects)).string()});
  EXPECT_EQ(ended.code, 3);
  EXPECT_TRUE(holds(has(ended.err, "edges do not cross (object 'bent')\n"))) << ended.err;
  EXPECT_TRUE(holds(has(ended.err, "found -1, expected a number in (0, 1e+50] (object 'set/ball')\n"))) << ended.err;
  EXPECT_TRUE(holds(has(ended.err, "found -2, expected a number in (0, 1e+50]\n"))) << ended.err;
}

}  // namespace
}  // namespace etendue::validation
