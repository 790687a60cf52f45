// SPDX-License-Identifier: Apache-2.0
#include "io/scene_texts.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr const char* kRound = R"({"type": "sphere", "material": "b", "centre": [0, 0, 0], "radius": 7})";
constexpr const char* kFlat = R"({"type": "box", "material": "b", "low": [0, 0, 0], "high": [1, 2, 3]})";

std::string with_bump(const std::string& bump) {
  return R"({"format": "etendue-scene", "version": 1, "unit": "in", "materials": {"b": {"bump": )" + bump + "}}}";
}

// CLAIM      A bump is what the file says: its lengths in the unit of its own file, its defaults as documented, its random heights those of
//            its seed.
// ORACLE     exact: the documented meaning of each key; an inch is 2.54 centimetres.
// TOLERANCE  two roundings of each length.
TEST(BumpReader, HoldsWhatTheFileSays) {
  proves({"IU.4.2.1"}, Oracle::exact, "the documented meaning of each key");
  const TemporaryFolder folder;
  const auto bump_of = [&](const std::string& bump, const char* object) {
    folder.add("b.json", with_bump(bump));
    return read(folder, scene_of(object, R"("include": ["b.json"], )", "cm")).materials[0].bump.value();
  };
  const MaterialBump waves = bump_of(R"({"type": "waves", "height": -2, "waves": [3, 0]})", kRound);
  const auto& wave = std::get<WaveRelief>(waves.relief);
  EXPECT_TRUE(near(wave.amplitude, -5.08, 2 * 5.08 * 0x1p-53));
  EXPECT_TRUE(holds(wave.along_u == 3 && wave.along_v == 0 && !waves.lay));

  const MaterialBump table = bump_of(
      R"({"type": "table", "height": 0.5, "heights": [[1, 2, 3], [4, 5, 6]], "repeat": [7, 8], "size": 10,
          "origin": [1, 0, 0], "u": [0, 2, 0], "v": [0, 0, -3]})",
      kFlat);
  const auto& plate = std::get<TableRelief>(table.relief);
  EXPECT_TRUE(holds(plate.columns == 3 && plate.rows == 2 && plate.edges == TableEdges::periodic));
  EXPECT_TRUE(holds(plate.repeat_u == 7 && plate.repeat_v == 8));
  EXPECT_TRUE(near(plate.heights[4], 5 * 1.27, 3 * 8 * 0x1p-53));
  ASSERT_TRUE(table.lay.has_value());
  EXPECT_TRUE(holds(table.lay->u == Vec3(0, 1, 0) && table.lay->v == Vec3(0, 0, -1)));
  EXPECT_TRUE(near(table.lay->size, 25.4, 2 * 32 * 0x1p-53));
  EXPECT_TRUE(near(table.lay->origin.x(), 2.54, 2 * 4 * 0x1p-53));

  const MaterialBump once = bump_of(R"({"type": "table", "heights": [[1, 2]], "edges": "clamped"})", kRound);
  EXPECT_TRUE(holds(std::get<TableRelief>(once.relief).edges == TableEdges::clamped));
  const MaterialBump rough = bump_of(R"({"type": "rough", "height": 1, "cells": [5, 4], "seed": 9})", kRound);
  const TableRelief drawn = random_relief(5, 4, 2.54, 9);
  EXPECT_TRUE(holds(std::get<TableRelief>(rough.relief).heights == drawn.heights && drawn.columns == 5));
}

// CLAIM      What is wrong with a bump is said, at its place; also that a shape has no coordinates for it.
// ORACLE     exact: the words of each message.
// TOLERANCE  none.
TEST(BumpReader, RefusesABumpThatIsNone) {
  proves({}, Oracle::exact, "one message for each fault");
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& bump, const std::string& words, const std::string& object) {
    folder.add("b.json", with_bump(bump));
    const auto scene = read_scene(folder.add("scene.json", scene_of(object, R"("include": ["b.json"], )")));
    EXPECT_TRUE(holds(!scene && scene.error().message.find(words) != std::string::npos))
        << (scene ? "taken: " + bump : scene.error().message);
  };
  refused(R"({"type": "wave", "height": 1, "waves": [1, 2]})", R"(bump/type: found "wave", expected one of "waves")",
          kRound);
  refused(R"({"type": "waves", "height": 1})", R"(bump: found no key "waves")", kRound);
  refused(R"({"type": "waves", "height": 1, "waves": [1, 0.5]})", "bump/waves/1: found 0.5, expected an integer",
          kRound);
  refused(R"({"type": "waves", "height": 1, "waves": [1]})", "bump/waves: found an array of 1", kRound);
  refused(R"({"type": "table", "heights": [[1, 2], [3]]})", "bump/heights/1: found a row of 1, expected 2 numbers",
          kRound);
  refused(R"({"type": "table", "heights": [[1]], "edges": "clamped", "repeat": [1, 1]})", R"(found "repeat" beside)",
          kRound);
  refused(R"({"type": "rough", "height": 1, "cells": [4096, 4096]})", "bump/cells: found more than 2^20 cells", kRound);
  refused(R"({"type": "rough", "height": 1, "cells": [0, 1]})", "bump/cells/0: found 0", kRound);
  refused(R"({"type": "waves", "height": 1, "waves": [1, 1], "u": [1, 0, 0]})", R"(found "u" without "size")", kRound);
  refused(R"({"type": "waves", "height": 1, "waves": [1, 1], "size": 1, "v": [1, 0, 0]})", R"(found "u" along "v")",
          kRound);
  const std::string waves = R"({"type": "waves", "height": 1, "waves": [1, 1]})";
  refused(waves, R"(/objects/0: found a material whose "bump" has no "size")", kFlat);
  refused(waves, "the caps have no coordinates",
          R"({"type": "cylinder", "material": "b", "base": [0, 0, 0], "top": [0, 0, 1], "radius": 1, "caps": true})");
}

}  // namespace
}  // namespace etendue::validation
