// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/scene_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "etendue/io/placement.hpp"
#include "etendue/io/scene_keys.hpp"
#include "io/example_scene.hpp"
#include "io/scene_texts.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

// CLAIM      What a scene file says is what the scene holds, defaults included.
// ORACLE     exact: the documented meaning of each key, on the documented example.
// TOLERANCE  4 units of 2^-53 for the half angle (one conversion of degrees to radians); else none.
TEST(SceneReader, HoldsWhatTheFileSays) {
  proves({}, Oracle::exact, "the documented example");
  const TemporaryFolder folder;
  const Scene scene = read(folder, example_scene());
  EXPECT_EQ(scene.name, "every kind of thing once");
  EXPECT_EQ(scene.metres_per_unit, 0.01);
  EXPECT_EQ(scene.camera.eye, Vec3(0, -400, 150));
  EXPECT_EQ(scene.camera.gaze, Vec3(0, 400, -100));
  EXPECT_EQ(scene.camera.columns, 320);
  EXPECT_EQ(scene.camera.rows, 240);
  EXPECT_TRUE(near(scene.camera.horizontal_half_angle, std::numbers::pi / 8, 4 * 0x1p-53));
  EXPECT_TRUE((scene.background == Rgb(0.02, 0.02, 0.05)).all());
  EXPECT_TRUE((scene.ambient == 0.3).all());

  ASSERT_EQ(scene.materials.size(), 5u);
  const Material &wall = scene.materials[0], &gloss = scene.materials[1], &glass = scene.materials[3];
  EXPECT_EQ(wall.name, "wall");
  EXPECT_TRUE((wall.k_d == 0.6).all() && (wall.k_a == 0.6).all() && (wall.rho == 0.5).all());
  EXPECT_TRUE((gloss.k_a == 0.1).all() && (gloss.rho == 0.3).all());
  EXPECT_TRUE(gloss.k_s == 0.9 && gloss.phong_exponent == 40 && gloss.k_r == 0 && gloss.eta == 1);
  EXPECT_TRUE(scene.materials[2].k_r == 0.9 && glass.k_t == 0.99 && glass.eta == 1.5);
  EXPECT_TRUE((scene.materials[4].emission == Rgb(10, 10, 9)).all());

  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(std::get<PointLight>(scene.lights[0]).position, Vec3(0, -100, 200));
  const auto& sun = std::get<DirectionalLight>(scene.lights[1]);
  EXPECT_TRUE(near((sun.direction - Vec3(1, -1, 2) / std::sqrt(6)).norm(), 0, 4 * 0x1p-53));
  EXPECT_TRUE((sun.intensity == Rgb(0.5, 0.5, 0.4)).all());

  ASSERT_EQ(scene.objects.size(), 16u);
  EXPECT_EQ(scene.objects[0].name, "/objects/0");
  EXPECT_EQ(scene.objects[2].name, "back wall");
  EXPECT_EQ(scene.objects[6].name, "table/top");
  EXPECT_EQ(scene.objects[2].subdivision.elements[0], 10);
  EXPECT_EQ(scene.objects[2].subdivision.patches[1], 5);
  EXPECT_EQ(scene.objects[2].subdivision.element_size, 0);
  EXPECT_EQ(scene.objects[6].subdivision.element_size, 7.5);
  EXPECT_TRUE(holds(scene.align_mesh));
  EXPECT_EQ(scene.objects[1].material, 3u);
  const auto& triangles = std::get<Mesh>(scene.objects[8].shape).triangles;
  ASSERT_EQ(triangles.size(), 6u);
  EXPECT_EQ(triangles[3], (std::array<std::uint32_t, 3>{3, 0, 4}));
  EXPECT_EQ(triangles[4], (std::array<std::uint32_t, 3>{0, 3, 2}));  // the quad 0 3 2 1: a b c …
  EXPECT_EQ(triangles[5], (std::array<std::uint32_t, 3>{0, 2, 1}));  // … and a c d

  // A cone, its caps as objects of their own; then the rest.
  EXPECT_EQ(std::get<Cone>(scene.objects[9].shape).top_radius, 6);
  EXPECT_EQ(scene.objects[10].name, "bollard/base");
  EXPECT_EQ(scene.objects[11].name, "bollard/top");
  const auto &base = std::get<Disc>(scene.objects[10].shape), &top = std::get<Disc>(scene.objects[11].shape);
  EXPECT_TRUE(base.centre == Vec3(30, -60, 0) && base.normal == Vec3(0, 0, -1) && base.radius == 12);
  EXPECT_TRUE(top.centre == Vec3(30, -60, 40) && top.normal == Vec3(0, 0, 1) && top.radius == 6);
  EXPECT_EQ(std::get<Torus>(scene.objects[12].shape).tube, 5);
  EXPECT_EQ(std::get<BezierSurface>(scene.objects[14].shape).control[3][1], Vec3(120, 30, 0));
  EXPECT_EQ(std::get<PolygonWithHoles>(scene.objects[15].shape).holes()[1][2], Vec3(-100, 58, 50));
}

// CLAIM      Transforms act in the order in which they stand, inner before outer; quarter turns are exact.
// ORACLE     exact: positions worked out by hand in integers.
// TOLERANCE  none: all results are integers.
TEST(SceneReader, PlacesShapesExactlyUnderQuarterTurns) {
  proves({}, Oracle::exact, "integer positions worked out by hand");
  const TemporaryFolder folder;
  const Scene scene = read(
      folder,
      scene_of(
          R"({"type": "group", "transform": [{"rotate": {"axis": [0, 0, 5], "angle_deg": 90}}, {"translate": [10, 0, 0]}],
        "children": [
          {"type": "sphere", "material": "a", "centre": [1, 2, 3], "radius": 2, "transform": [{"scale": 2}, {"translate": [0, 0, 1]}]},
          {"type": "disc", "material": "a", "centre": [1, 0, 0], "normal": [3, 0, 0], "radius": 1},
          {"type": "box", "material": "a", "low": [0, 0, 0], "high": [2, 4, 6], "transform": [{"scale": [1, 2, 3]}]},
          {"type": "plane", "material": "a", "point": [0, 1, 0], "normal": [0, 1, 0],
           "transform": [{"rotate": {"axis": [1, 0, 0], "angle_deg": -270}}]},
          {"type": "triangle", "material": "a", "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0]],
           "transform": [{"rotate": {"axis": [0, 1, 0], "angle_deg": 180}}, {"scale": [1, 1, 7]}, {"translate": [0, 0, 1]}]}]})"));
  ASSERT_EQ(scene.objects.size(), 5u);
  // Sphere: (1,2,3)·2 + (0,0,1) = (2,4,7); turned: (-4,2,7); moved: (6,2,7).
  const auto& sphere = std::get<Sphere>(scene.objects[0].shape);
  EXPECT_EQ(sphere.centre, Vec3(6, 2, 7));
  EXPECT_EQ(sphere.radius, 4);
  const auto& disc = std::get<Disc>(scene.objects[1].shape);
  EXPECT_EQ(disc.centre, Vec3(10, 1, 0));
  EXPECT_EQ(disc.normal, Vec3(0, 1, 0));
  // Box: edges 2, 8, 18 about (1,4,9); turned: centre (-4,1,9), moved (6,1,9).
  const auto& box = std::get<Box>(scene.objects[2].shape);
  EXPECT_EQ(box.centre, Vec3(6, 1, 9));
  EXPECT_EQ(box.half_edges, Vec3(1, 4, 9));
  EXPECT_EQ(box.axes.col(0), Vec3(0, 1, 0));
  EXPECT_EQ(box.axes.col(1), Vec3(-1, 0, 0));
  // Plane: −270° about x takes y to z.
  const auto& plane = std::get<Plane>(scene.objects[3].shape);
  EXPECT_EQ(plane.normal, Vec3(0, 0, 1));
  EXPECT_EQ(plane.point, Vec3(10, 0, 1));
  const auto& triangle = std::get<Triangle>(scene.objects[4].shape);
  EXPECT_EQ(triangle.b, Vec3(10, -1, 1));
  EXPECT_EQ(triangle.c, Vec3(9, 0, 1));
  EXPECT_TRUE(all_agree(::testing::Test::HasFailure() ? 1 : 0, 11));
}

// CLAIM      A rotation about z by any angle takes (1, 0, 0) to (cos, sin, 0), right-handed.
// ORACLE     closed form: cosine and sine in long double, angles of both signs beyond one turn.
// TOLERANCE  4 units of 2^-53: reducing the angle is exact, converting to radians errs by one unit of at most π/4 and a
//            half for π, sine or cosine by one more; two products and sums round on top.
TEST(SceneReader, RotatesByAnyAngle) {
  proves({}, Oracle::closed_form, "cosine and sine in long double");
  for (int degrees = -725; degrees <= 725; degrees += 7) {
    const Mat3 turn = rotation(Vec3::UnitZ(), degrees);
    const long double angle = degrees * std::numbers::pi_v<long double> / 180;
    EXPECT_TRUE(near(turn(0, 0), static_cast<double>(std::cos(angle)), 4 * 0x1p-53));
    EXPECT_TRUE(near(turn(1, 0), static_cast<double>(std::sin(angle)), 4 * 0x1p-53));
    EXPECT_TRUE(near(turn(0, 1), -static_cast<double>(std::sin(angle)), 4 * 0x1p-53));
    EXPECT_TRUE(near(turn(2, 2), 1, 4 * 0x1p-53));
  }
}

// CLAIM      Normals stay orthogonal to the plane under unequal scales and arbitrary turns.
// ORACLE     identity: three points of the placed mesh span the plane whose placed normal is tested.
// TOLERANCE  16 units of 2^-53 of the vectors' lengths: a chain of five roundings on each side, times √3.
TEST(SceneReader, MapsNormalsByTheInverseTranspose) {
  proves({}, Oracle::identity, "points of the plane, placed by the same transform");
  const TemporaryFolder folder;
  CounterRandom random(3);
  for (int i = 0; i < 40; ++i) {
    std::ostringstream transform;
    transform << R"("transform": [{"scale": [)" << 1 + random.below(9) << ", " << 1 + random.below(9)
              << R"(, 2]}, {"rotate": {"axis": [)" << 1 + random.below(9) << ", -3, " << random.below(9)
              << R"(], "angle_deg": )" << random.below(360) << "}}]";
    // The plane x + y + z = 1 and three of its points.
    const Scene scene =
        read(folder, scene_of(R"({"type": "plane", "material": "a", "point": [1, 0, 0], "normal": [1, 1, 1], )" +
                              transform.str() + R"(}, {"type": "mesh", "material": "a", )" + transform.str() +
                              R"(, "vertices": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "triangles": [[0, 1, 2]]})"));
    const auto& plane = std::get<Plane>(scene.objects[0].shape);
    const auto& mesh = std::get<Mesh>(scene.objects[1].shape);
    for (int k = 1; k < 3; ++k) {
      const Vec3 edge = mesh.vertices[static_cast<std::size_t>(k)] - mesh.vertices[0];
      EXPECT_TRUE(near(edge.normalized().dot(plane.normal), 0, 16 * 0x1p-53));
    }
    EXPECT_TRUE(near(plane.normal.norm(), 1, 4 * 0x1p-53));
  }
}

// CLAIM      Included files bring materials, lights and objects; their lengths are converted; each file is read once.
// ORACLE     exact: a metre is a hundred centimetres.
// TOLERANCE  1 unit of 2^-53 for the conversion factor.
TEST(SceneReader, JoinsIncludedFiles) {
  proves({}, Oracle::exact, "unit conversion by hand");
  const TemporaryFolder folder;
  folder.add("parts/ball.json", R"({"format": "etendue-scene", "version": 1, "unit": "m", "include": ["paint.json"],
    "lights": [{"type": "point", "position": [1, 0, 0], "intensity": 1}],
    "objects": [{"type": "sphere", "material": "paint", "centre": [1, 0, 2], "radius": 0.5}]})");
  folder.add("parts/paint.json",
             R"({"format": "etendue-scene", "version": 1, "unit": "in", "materials": {"paint": {}}})");
  const Scene scene =
      read(folder, scene_of(R"({"type": "sphere", "material": "paint", "centre": [0, 0, 0], "radius": 7})",
                            R"("include": ["parts/ball.json", "parts/../parts/paint.json"], )", "cm"));
  ASSERT_EQ(scene.objects.size(), 2u);
  const auto& ball = std::get<Sphere>(scene.objects[0].shape);
  EXPECT_TRUE(near(ball.radius, 50, 50 * 0x1p-52));
  EXPECT_TRUE(near((ball.centre - Vec3(100, 0, 200)).norm(), 0, 224 * 0x1p-52));
  EXPECT_EQ(std::get<Sphere>(scene.objects[1].shape).radius, 7);
  EXPECT_TRUE(near(std::get<PointLight>(scene.lights[0]).position.x(), 100, 100 * 0x1p-52));
  EXPECT_EQ(scene.materials.size(), 2u);
}

// CLAIM      The inside of transparent materials: absorption per length of its own file, dispersion by name or by formula (the
//            index without a wavelength is then n_d), Fresnel's shares and priority; all off by default.
// ORACLE     exact: the documented meaning of each key; 0.5 per inch is 0.5/2.54 per centimetre.
// TOLERANCE  four roundings of the factor; n_d to its printed digits.
TEST(SceneReader, HoldsTheInsideOfTransparentMaterials) {
  proves({}, Oracle::exact, "the documented meaning of each key");
  const TemporaryFolder folder;
  folder.add("ink.json", R"({"format": "etendue-scene", "version": 1, "unit": "in",
    "materials": {"ink": {"k_t": 1, "absorption": [0, 0.5, 2], "priority": -3},
                  "flint": {"k_t": 1, "dispersion": "F2", "fresnel": true},
                  "cauchy": {"k_t": 1, "dispersion": {"a": 1.5, "b": 0.004}},
                  "own": {"dispersion": {"strength": [0.75, 0.5], "resonance": [0.01, 100]}}}})");
  const Scene scene =
      read(folder, scene_of(R"({"type": "sphere", "material": "ink", "centre": [0, 0, 0], "radius": 7})",
                            R"("include": ["ink.json"], )", "cm"));
  ASSERT_EQ(scene.materials.size(), 5u);
  const Material &ink = scene.materials[0], &flint = scene.materials[1], &plain = scene.materials[4];
  EXPECT_TRUE(holds(ink.absorption[0] == 0 && ink.priority == -3 && !ink.fresnel && !ink.dispersion && ink.eta == 1));
  EXPECT_TRUE(near(ink.absorption[1], 0.5 / 2.54, 4 * 0x1p-53));
  EXPECT_TRUE(near(ink.absorption[2], 2 / 2.54, 4 * 0x1p-53));
  EXPECT_TRUE(holds(flint.fresnel && flint.dispersion.has_value() && (flint.absorption == 0).all()));
  EXPECT_TRUE(near(flint.eta, 1.62004, 5e-6));
  EXPECT_TRUE(near(refractive_index(*scene.materials[2].dispersion, 500), 1.516, 4 * 0x1p-52));
  const Sellmeier& own = std::get<Sellmeier>(*scene.materials[3].dispersion);
  EXPECT_TRUE(holds(own.strength[1] == 0.5 && own.resonance[0] == 0.01 && own.strength[2] == 0));
  EXPECT_TRUE(holds(plain.priority == 0 && !plain.fresnel && !plain.dispersion && (plain.absorption == 0).all()));
}

// CLAIM      What is wrong with the inside of a material is said: two indices, a medium that no one knows, formulas that are none.
// ORACLE     exact: the words of each message.
// TOLERANCE  none.
TEST(SceneReader, RefusesAnInsideThatIsNone) {
  proves({}, Oracle::exact, "one message for each fault");
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& keys, const std::string& words) {
    folder.add("b.json",
               R"({"format": "etendue-scene", "version": 1, "unit": "m", "materials": {"b": {)" + keys + "}}}");
    const auto scene = read_scene(
        folder.add("scene.json", scene_of(R"({"type": "sphere", "material": "b", "centre": [0, 0, 0], "radius": 7})",
                                          R"("include": ["b.json"], )")));
    EXPECT_TRUE(holds(!scene && scene.error().message.find("/materials/b/" + words) != std::string::npos))
        << (scene ? "taken: " + keys : scene.error().message);
  };
  refused(R"("eta": 1.5, "dispersion": "F2")", R"(dispersion: found "dispersion" beside "eta", expected one of them)");
  refused(R"("dispersion": "N-BK6")", R"(dispersion: found "N-BK6", expected one of "water", "fused silica", "N-BK7")");
  refused(R"("dispersion": 1.5)", "dispersion: found 1.5, expected the name of a medium, or an object with");
  refused(R"("dispersion": {"strength": [1], "resonance": [0.25]})",
          "dispersion: found a formula whose index leaves [0.1, 10]");
  refused(R"("dispersion": {"strength": [1, 1], "resonance": [0]})",
          "dispersion/resonance: found 1 resonances, expected as many as strengths, 2");
  refused(R"("dispersion": {"b": 1})", R"(dispersion: found no key "a", expected one: it is mandatory here)");
  refused(R"("absorption": -1)", "absorption: found -1, expected a number in [0, 1e+50]");
  refused(R"("priority": 0.5)", "priority: found 0.5, expected an integer in [-1000, 1000]");
  refused(R"("fresnel": 1)", "fresnel: found 1, expected true or false");
}

// CLAIM      The hash is FNV-1a (64 bit) of the bytes and lengths of all files, and so depends on every byte.
// ORACLE     closed form: FNV-1a by its definition, the prime as a sum; the published value of the text "a".
// TOLERANCE  none.
TEST(SceneReader, FingerprintsTheBytesRead) {
  proves({}, Oracle::closed_form, "FNV-1a by its definition");
  const auto fnv1a = [](const std::string& bytes) {
    std::uint64_t state = 14695981039346656037u;
    for (const char byte : bytes) {
      state ^= static_cast<unsigned char>(byte);
      state = (state << 40) + 435 * state;  // the prime is 2^40 + 435
    }
    return state;
  };
  ASSERT_EQ(fnv1a("a"), 0xaf63dc4c8601ec8cu);  // Noll's test vector
  const TemporaryFolder folder;
  const std::string text = scene_of(R"({"type": "sphere", "material": "a", "centre": [0, 0, 0], "radius": 7})");
  const auto path = folder.add("scene.json", text);
  std::string with_length = text;
  for (std::uint64_t size = text.size(), i = 0; i < 8; ++i, size /= 256) with_length += static_cast<char>(size % 256);
  std::ostringstream expected;
  expected << std::hex << std::setw(16) << std::setfill('0') << fnv1a(with_length);
  EXPECT_EQ(read_scene(path)->hash, expected.str());
  folder.add("scene.json", text + " ");
  EXPECT_NE(read_scene(path)->hash, expected.str());
  EXPECT_TRUE(all_agree(::testing::Test::HasFailure() ? 1 : 0, 2));
}

// CLAIM      The schema for editors knows exactly the keys that the reader knows, and the same are mandatory.
// ORACLE     identity: the two lists.
// TOLERANCE  none.
TEST(SceneReader, KnowsTheKeysOfTheSchema) {
  proves({}, Oracle::identity, "scenes/scene.schema.json");
  const auto schema = nlohmann::json::parse(read_text(source_root() / "scenes" / "scene.schema.json"));
  std::uint64_t wrong = 0, decided = 0, objects = 0;
  for (const KeySet& set : scene_key_sets()) {
    ASSERT_TRUE(schema["$defs"].contains(set.name)) << set.name;
    const auto& definition = schema["$defs"][set.name];
    std::vector<std::string> theirs, ours = set.all(), required, mandatory = set.mandatory;
    for (const auto& [key, value] : definition["properties"].items()) theirs.push_back(key);
    if (definition.contains("required")) required = definition["required"].get<std::vector<std::string>>();
    for (auto* list : {&theirs, &ours, &required, &mandatory}) std::sort(list->begin(), list->end());
    EXPECT_EQ(theirs, ours) << set.name;
    EXPECT_EQ(required, mandatory) << set.name;
    EXPECT_EQ(definition["additionalProperties"], false) << set.name;
    decided += ours.size();
    if (theirs != ours || required != mandatory) ++wrong;
  }
  for (const auto& [name, definition] : schema["$defs"].items()) objects += definition.contains("properties") ? 1u : 0u;
  EXPECT_EQ(objects, scene_key_sets().size());
  EXPECT_TRUE(all_agree(wrong, decided));
}

// CLAIM      Every scene that is shipped is accepted.
// ORACLE     identity: the files of scenes/.
// TOLERANCE  none.
TEST(SceneReader, AcceptsEveryShippedScene) {
  proves({}, Oracle::identity, "the files of scenes/");
  std::uint64_t wrong = 0, decided = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source_root() / "scenes")) {
    if (entry.path().filename() != "scene.json") continue;
    ++decided;
    const auto scene = read_scene(entry.path());
    if (!scene) ++wrong;
    EXPECT_TRUE(scene.ok()) << scene.error().message;
  }
  EXPECT_TRUE(all_agree(wrong, decided));
}

// CLAIM      Whatever the bytes, the reader gives a scene or errors with their places; it never crashes or throws.
// ORACLE     identity: the form of a message, and lines that exist, on 3000 mutations of the example and of random
//            bytes.
// TOLERANCE  none.
TEST(SceneReader, SurvivesMutatedFiles) {
  proves({}, Oracle::identity, "the form of a located message");
  const TemporaryFolder folder;
  const std::string sound = example_scene();
  const std::string name = (folder.path() / "scene.json").string();
  const std::vector<std::string> pieces{"-",  "0", "9e99", "1e999", "\"",   "null", "[]",
                                        "{}", ",", "-1",   "\xff",  "[[[[", "true"};
  CounterRandom random(5);
  std::uint64_t wrong = 0, decided = 0, accepted = 0;
  for (int i = 0; i < 800; ++i) {
    std::string text = sound;
    for (std::uint64_t k = random.below(3) + 1; k > 0; --k) {
      const std::size_t at = random.below(text.size());
      if (random.below(2) == 0)
        text.erase(at, 1 + random.below(3));
      else
        text.replace(at, random.below(4), pieces[random.below(pieces.size())]);
    }
    const auto lines = std::count(text.begin(), text.end(), '\n') + 1;
    const auto scene = read_scene(folder.add("scene.json", text));
    ++decided;
    if (scene) {
      ++accepted;
      continue;
    }
    std::istringstream message(scene.error().message);
    long errors = 0;
    bool sane = scene.error().code == ErrorCode::invalid_input;
    std::string line, last;
    for (; std::getline(message, line); last = line) {
      if (line.rfind(name, 0) != 0) continue;
      int at_line = 0, at_column = 0, read = 0;
      const int fields = std::sscanf(line.c_str() + name.size(), ":%d:%d: %n", &at_line, &at_column, &read);
      sane = sane && fields == 2 && at_line >= 1 && at_line <= lines && at_column >= 1;
      sane = sane && line.size() > name.size() + static_cast<std::size_t>(read);
      ++errors;
    }
    sane = sane && errors > 0 && last == std::to_string(errors) + (errors == 1 ? " error" : " errors");
    if (sane) continue;
    ++wrong;
    ADD_FAILURE() << scene.error().message;
  }
  EXPECT_TRUE(all_agree(wrong, decided));
  EXPECT_GT(accepted, 0u);
}

}  // namespace
}  // namespace etendue::validation
