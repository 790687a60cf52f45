// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/surface_file.hpp"

#include <bit>
#include <cmath>
#include <map>

#include "etendue/assembly/exact_exchange.hpp"
#include "etendue/form_factor/polygon_polygon.hpp"
#include "io/surface_texts.hpp"
#include "meshing/small_scenes.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {
namespace {

constexpr Tolerance kTolerance{1e-10, 1e-13};

/// The matrix of a model's rows.
ExchangeMatrix rows_of(const SurfaceModel& model) {
  ExchangeMatrix elements(areas_of(model.mesh));
  fill_exchanges(elements, ExactExchange(model.mesh, {kTolerance, kTolerance}), kTolerance, {});
  return composed(model, elements);
}

SurfaceModel read(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
  auto model = read_surfaces(folder.add(name, text));
  if (!model) throw std::runtime_error(model.error().message);
  return std::move(model).value();
}

double exchange(const Polygon& a, const Polygon& b) {
  return a.area() * form_factor(a, b, {1e-13, 0}).value;
}

/// The box 0 ≤ x ≤ 2, 0 ≤ y ≤ 1, 0 ≤ z ≤ 1 whose wall x = 0 has a subsurface, as .vs3.
const std::string kVertices =
    "T box, with parts\nF 3\nV 1 0 0 0\nV 2 2 0 0\nV 3 2 1 0\nV 4 0 1 0\nV 5 0 0 1\nV 6 2 0 1\nV 7 2 1 1\nV 8 0 1 1\n"
    "V 9 0 .25 .5\nV 10 0 .75 .5\nV 11 0 .75 1\nV 12 0 .25 1\nV 13 1 0 0\nV 14 1 1 0\n";

// CLAIM      Subsurfaces, combined surfaces and null surfaces follow the algebra of form factors: a base is what its
//            subsurfaces leave, a combined surface is the union, a null surface is gone.
// ORACLE     metamorphic: the same exchange areas from polygons put together in the test, one call each.
// TOLERANCE  1e-9 of the exchange area: both sides are asked for 1e-10.
TEST(SurfaceFile, PutsPartsTogetherByTheAlgebraOfFactors) {
  proves({"IU.6-3", "IU.6-5"}, Oracle::metamorphic, "polygons put together in the test");
  const TemporaryFolder folder;
  // Floor of two halves, combined; wall x = 0 with a window (5) and, in the wall x = 2, a null surface.
  const std::string parts = kVertices +
                            "V 15 2 .2 .2\nV 16 2 .8 .2\nV 17 2 .8 .8\nV 18 2 .2 .8\n"
                            "S 1 1 13 14 4 0 0 .9 floor\nS 2 13 2 3 14 0 1 .8 floor-2\nS 3 1 4 8 5 0 0 .7 west\n"
                            "S 4 3 2 6 7 0 0 .6 east ! seen from inside\nS 5 9 10 11 12 3 0 .5 window\n";
  const SurfaceModel model = read(folder, "box.vs3", parts + "N 6 15 16 17 18 4 0 .9 hole\n*\nthis is not read\n");
  const SurfaceModel turned = read(folder, "turned.vs3", parts + "N 6 18 17 16 15 4 0 .9 hole\n");
  ASSERT_EQ(model.rows.size(), 4u);
  const ExchangeMatrix matrix = rows_of(model);
  const Polygon floor = quadrilateral({0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0});
  const Polygon west = quadrilateral({0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1});
  const Polygon window = quadrilateral({0, .25, .5}, {0, .75, .5}, {0, .75, 1}, {0, .25, 1});
  // What is left of the wall around the window, in three pieces.
  const std::vector<Polygon> rest{quadrilateral({0, 0, 0}, {0, 1, 0}, {0, 1, .5}, {0, 0, .5}),
                                  quadrilateral({0, 0, .5}, {0, .25, .5}, {0, .25, 1}, {0, 0, 1}),
                                  quadrilateral({0, .75, .5}, {0, 1, .5}, {0, 1, 1}, {0, .75, 1})};
  double floor_to_rest = 0;
  for (const Polygon& part : rest) floor_to_rest += exchange(floor, part);
  const auto at = [&](const std::string& name) {
    for (std::size_t k = 0; k < model.rows.size(); ++k) {
      if (model.rows[k].name == name) return k;
    }
    throw std::runtime_error("no row " + name);
  };
  constexpr double kShare = 1e-9;
  const auto agrees = [&](const std::string& a, const std::string& b, double expected) {
    return near(matrix.exchange(at(a), at(b)), expected, kShare * expected);
  };
  EXPECT_TRUE(agrees("floor", "window", exchange(floor, window)));
  EXPECT_TRUE(
      agrees("floor", "east", rows_of(turned).exchange(at("floor"), at("east"))));  // whichever way a hole faces
  EXPECT_TRUE(agrees("floor", "west", floor_to_rest));
  EXPECT_TRUE(near(model.rows[at("west")].area, west.area() - window.area(), 1e-15));
  EXPECT_TRUE(near(model.rows[at("floor")].area, 2, 1e-15));
  EXPECT_TRUE(near(model.rows[at("east")].area, 1 - 0.36, 1e-15));
  EXPECT_TRUE(near(model.rows[at("floor")].emittance, 0.85, 1e-15));
}

// CLAIM      A mask sees its base and nothing else, and the base loses what it covers: F from the mask to the base is one.
// ORACLE     identity and metamorphic: the base without the covered part, computed as a subsurface would be.
// TOLERANCE  1e-9 of the exchange area.
TEST(SurfaceFile, LetsAMaskSeeItsBaseOnly) {
  proves({"IU.6-5"}, Oracle::identity, "F = 1 from a mask to its base");
  const TemporaryFolder folder;
  const std::string walls = kVertices + "S 1 1 2 3 4 0 0 .9 floor\nS 2 1 4 8 5 0 0 .7 west\n";
  const SurfaceModel masked = read(folder, "mask.vs3", walls + "M 3 12 11 10 9 2 0 .5 mask\n");
  const SurfaceModel divided = read(folder, "sub.vs3", walls + "S 3 9 10 11 12 2 0 .5 sub\n");
  const ExchangeMatrix with_mask = rows_of(masked), with_sub = rows_of(divided);
  EXPECT_TRUE(near(with_mask.factor(2, 1).value, 1, 0));
  EXPECT_TRUE(near(with_mask.factor(1, 2).value, 0.25, 0x1p-53));
  EXPECT_TRUE(near(with_mask.exchange(0, 2), 0, 0));
  EXPECT_TRUE(near(with_mask.exchange(0, 1), with_sub.exchange(0, 1), 1e-9 * with_sub.exchange(0, 1)));
  EXPECT_TRUE(near(masked.rows[1].area, 1, 0x1p-50));
}

// CLAIM      The two ways to give geometry, F 3 and F 3a, and OBJ and STL in both forms, describe the same room.
// ORACLE     metamorphic: the box of 6 walls written in each, and as our scene.
// TOLERANCE  the sum of both bounds; STL is binary32, but 0, 1 and 2 are exact in it.
TEST(SurfaceFile, ReadsTheSameRoomFromEveryFormat) {
  proves({"IU.6-3"}, Oracle::metamorphic, "one room in six forms");
  const TemporaryFolder folder;
  const SurfaceModel ours = *surface_model(room_of({0, 0, 0}, {2, 1, 1}));
  const ExchangeMatrix expected = rows_of(ours);
  for (const auto& [name, text] : room_texts()) {
    const SurfaceModel model = read(folder, name, text);
    const ExchangeMatrix found = rows_of(model);
    const std::size_t share = found.size() / 6;  // triangles: two a wall
    ASSERT_EQ(found.size(), 6 * share) << name;
    for (std::size_t i = 0; i < 6; ++i) {
      for (std::size_t j = 0; j < 6; ++j) {
        double sum = 0, bound = 0;
        for (std::size_t a = 0; a < share; ++a) {
          for (std::size_t b = 0; b < share; ++b) {
            sum += found.exchange(share * i + a, share * j + b);
            bound += found.exchange_bound(share * i + a, share * j + b);
          }
        }
        EXPECT_TRUE(near(sum, expected.exchange(i, j), bound + expected.exchange_bound(i, j) + 0x1p-50))
            << name << i << j;
      }
    }
  }
}

// CLAIM      A concave OBJ face, and a concave polygon of a scene, are one row, cut into triangles that add up to it.
// ORACLE     metamorphic: form_factor of the concave polygon as a whole.
// TOLERANCE  1e-9 of the exchange area.
TEST(SurfaceFile, CutsAConcaveFaceIntoOneRow) {
  proves({"IU.6-3"}, Oracle::metamorphic, "the concave polygon as a whole");
  const TemporaryFolder folder;
  const SurfaceModel model =
      read(folder, "l.obj",
           "o ell\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5 6\n"
           "o plate\nv 0.25 0.5 1.5\nv 0.25 1.5 1.5\nv 1.25 1.5 1.25\nv 1.25 0.5 1.25\nf -4 -3 -2 -1\n");
  ASSERT_EQ(model.rows.size(), 2u);
  EXPECT_EQ(model.mesh.elements.size(), 5u);
  const Polygon ell = polygon({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}});
  const Polygon plate = quadrilateral({.25, .5, 1.5}, {.25, 1.5, 1.5}, {1.25, 1.5, 1.25}, {1.25, .5, 1.25});
  const double whole = exchange(ell, plate);
  EXPECT_TRUE(near(rows_of(model).exchange(0, 1), whole, 1e-9 * whole));
  EXPECT_TRUE(near(model.rows[0].area, 3, 0x1p-50));
  const SurfaceModel scene = read(folder, "l.json", R"({"format": "etendue-scene", "version": 1, "unit": "m",
 "camera": {"eye": [0, 0, 9], "gaze": [0, 0, -1], "up": [0, 1, 0], "horizontal_fov_deg": 60, "resolution": [8, 8]},
 "materials": {"m": {"k_d": 0.5}}, "objects": [
  {"type": "polygon", "name": "ell", "material": "m", "vertices": [[0,0,0], [2,0,0], [2,1,0], [1,1,0], [1,2,0], [0,2,0]]},
  {"type": "polygon", "name": "plate", "material": "m",
   "vertices": [[0.25,0.5,1.5], [0.25,1.5,1.5], [1.25,1.5,1.25], [1.25,0.5,1.25]]}]})");
  ASSERT_EQ(scene.rows.size(), 2u);
  EXPECT_TRUE(holds(scene.rows[0].name == "ell" && scene.rows[0].area == model.rows[0].area));
  EXPECT_TRUE(near(rows_of(scene).exchange(0, 1), whole, 1e-9 * whole));
}

// CLAIM      A tilted quadrilateral written with six digits is made flat and said to be; one that is off by more is
//            refused with its deviation in the file's unit.
// ORACLE     exact: the deviation is chosen.
// TOLERANCE  none: messages.
TEST(SurfaceFile, SaysWhatItFlattens) {
  proves({}, Oracle::exact, "a chosen deviation");
  const TemporaryFolder folder;
  const auto quad = [](const std::string& z) { return "v 0 0 0\nv 3 0 0\nv 3 3 " + z + "\nv 0 3 0\nf 1 2 3 4\n"; };
  const auto flat = read_surfaces(folder.add("a.obj", quad("4e-6")));
  ASSERT_TRUE(flat.ok()) << flat.error().message;
  ASSERT_EQ(flat->notes.size(), 1u);
  EXPECT_TRUE(holds(flat->notes[0] ==
                    "1 surfaces were not flat to 12 digits: their vertices were moved onto their planes, "
                    "by at most 1e-06 (in the file's unit)"))
      << flat->notes[0];
  const auto bent = read_surfaces(folder.add("b.obj", quad("0.004")));
  ASSERT_FALSE(bent.ok());
  EXPECT_TRUE(holds(bent.error().message.find(
                        "b.obj:5: surface 'face': is not flat: a vertex is 0.001 off its plane") != std::string::npos))
      << bent.error().message;
}

// CLAIM      No damaged file crashes the readers: each either is read, or is refused with a message.
// ORACLE     exact: seeded mutations of sound files (bytes changed, cut out, repeated; numbers made huge).
// TOLERANCE  none.
TEST(SurfaceFile, SurvivesDamage) {
  constexpr std::uint64_t kSeed = 20261122;
  proves({}, Oracle::exact, "seeded mutations");
  uses_seed(kSeed);
  const TemporaryFolder folder;
  CounterRandom random(kSeed);
  auto texts = room_texts();
  texts.emplace_back("parts.vs3", kVertices +
                                      "S 1 1 2 3 4 0 0 .9 floor\nS 2 1 4 8 5 0 0 .7 west\nM 3 12 11 10 9 2 0 .5 m\n"
                                      "O 4 13 14 8 5\n");
  const std::vector<std::string> planted{"nan",  "1e400", "-1",    "99999999999999999999", "\n", " ", "0",
                                         "\xff", "S ",    "F 3a\n"};
  std::uint64_t read = 0, refused = 0, wrong = 0;
  for (int round = 0; round < 3000; ++round) {
    const auto& [name, sound] = texts[random.below(texts.size())];
    std::string text = sound;
    for (std::uint64_t k = 1 + random.below(3); k > 0; --k) {
      const std::size_t at = random.below(text.size());
      switch (random.below(5)) {
        case 0:
          text[at] = static_cast<char>(random.below(256));
          break;
        case 1:
          text.erase(at, 1 + random.below(20));
          break;
        case 2:
          text.insert(at, text.substr(random.below(text.size()), 1 + random.below(60)));
          break;
        case 3:
          text.insert(at, planted[random.below(planted.size())]);
          break;
        default:
          text.resize(at + 1);
      }
      if (text.empty()) text = " ";
    }
    const auto model = read_surfaces(folder.add(name, text));
    if (model) {
      ++read;
      wrong += model->rows.empty() || model->face_names.size() != model->mesh.faces.size();
    } else {
      ++refused;
      wrong +=
          model.error().code != ErrorCode::invalid_input || model.error().message.find("error") == std::string::npos;
    }
  }
  EXPECT_GT(read, 50u);
  EXPECT_GT(refused, 1000u);
  EXPECT_TRUE(all_agree(wrong, read + refused));
}

}  // namespace
}  // namespace etendue::validation
