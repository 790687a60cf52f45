// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "cli/furnace_text.hpp"
#include "support/evidence.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {
namespace {

using Json = nlohmann::json;

const char* const kSensors = R"({"format": "etendue-sensors", "version": 1, "unit": "cm",
 "sensors": [{"name": "a \"desk\"", "position": [50, 60, 75], "normal": [0, 0, 3]},
             {"position": [120, 40, 0], "normal": [0, 0, 1]}],
 "grids": [{"name": "wall", "origin": [0, 0, 0], "edges": [[0, 300, 0], [0, 0, 150]], "counts": [3, 2]}]})";

Ended solve(const TemporaryFolder& folder, const std::filesystem::path& scene, const std::filesystem::path& sensors,
            std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"solve", scene.string(), "--sensors", sensors.string(), "--output",
                             (folder.path() / "out.png").string(), "--samples", "1"});
  return run_etendue(more);
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> found;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) found.push_back(line);
  return found;
}

// CLAIM      In an evenly glowing room every sensor, in the air, on the floor and on a wall, receives E/(1 − ρ) to its bound,
//            and 179 lm/W of it, or what --efficacy says, as lux; NAME.json and NAME.sensors.csv say the same.
// ORACLE     closed form: the furnace, H = B = E/(1 − ρ) = 3, 8, 10 W/m².
// TOLERANCE  the bound in the report; lux: four roundings.
TEST(SolveSensors, ReceiveWhatTheFurnaceGlows) {
  proves({"IU.6-2", "IU.6-7"}, Oracle::closed_form, "furnace, H = E/(1 − ρ)");
  const TemporaryFolder folder;
  const auto scene = folder.add("furnace.json", furnace_text());
  const auto sensors = folder.add("sensors.json", kSensors);
  const double expected[] = {3, 8, 10};
  for (const double efficacy : {179.0, 100.0}) {
    std::vector<std::string> more;
    if (efficacy != 179) more = {"--efficacy", "100"};
    const Ended ended = solve(folder, scene, sensors, more);
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_TRUE(holds(ended.out.find("8 sensors") != std::string::npos)) << ended.out;
    const Json report = Json::parse(read_text(folder.path() / "out.json"))["sensors"];
    EXPECT_EQ(report["count"], 8);
    EXPECT_EQ(report["lumens_per_watt"], efficacy);
    const std::vector<std::string> table = lines(read_text(folder.path() / "out.sensors.csv"));
    ASSERT_EQ(table.size(), 9u);
    for (std::size_t k = 0; k < 8; ++k) {
      const Json& one = report["readings"][k];
      for (std::size_t c = 0; c < 3; ++c) {
        const double bound = one["bound"][c].get<double>();
        EXPECT_TRUE(near(one["irradiance"][c].get<double>(), expected[c], bound)) << k;
        EXPECT_TRUE(within(bound, 1e-9 * expected[c])) << k;  // form factors to 1e-12, 46 elements, 1/(1 − ρ) = 10
      }
      const double lux =
          efficacy * (0.2126 * one["irradiance"][0].get<double>() + 0.7152 * one["irradiance"][1].get<double>() +
                      0.0722 * one["irradiance"][2].get<double>());
      EXPECT_TRUE(near(one["illuminance"].get<double>(), lux, 4 * 0x1p-53 * lux));
      EXPECT_TRUE(holds(table[k + 1].find("," + one["irradiance"][1].dump() + ",") != std::string::npos))
          << table[k + 1];
      EXPECT_TRUE(holds(table[k + 1].find(",,,,") != std::string::npos)) << "no estimate without --extrapolate";
    }
    // Centimetres became metres, a normal its unit vector, the wall's cells are counted along its first edge.
    EXPECT_EQ(report["readings"][0]["position"], Json::array({0.5, 0.6, 0.75}));
    EXPECT_EQ(report["readings"][0]["normal"], Json::array({0, 0, 1}));
    EXPECT_EQ(report["readings"][3]["name"], "wall[2,1]");
    EXPECT_EQ(report["readings"][3]["position"], Json::array({0, 1.5, 0.375}));
    EXPECT_TRUE(holds(table[1].rfind("0,\"a \"\"desk\"\"\",0.5,0.6,0.75,0,0,1,", 0) == 0)) << table[1];
  }
}

// CLAIM      IU.6-12, IU.6-7: sensors read solutions that patches shot, that were refined where radiosity changes, or eliminated by
//            hemicubes, as they read those of the full matrix, past a post as well; with exact factors to the bound that is told,
//            with hemicubes that shoot without one; a light turned to the double doubles what they receive.
// ORACLE     closed form: the furnace; another method: the full matrix of the same elements; identity: linearity.
// TOLERANCE  the bounds in the reports, which are below 0.1 % of the light; past the post also what form factors known to 1e-5 do,
//            ρ/(1 − ρ) times that on either side; hemicubes 1e-9: their rows sum to one by construction.
TEST(SolveSensors, ReadWhateverWasSolved) {
  proves({"IU.6-7", "IU.6-12", "IU.6-13"}, Oracle::closed_form, "furnace, H = E/(1 − ρ), shot and refined");
  const TemporaryFolder folder;
  const auto scene = folder.add("furnace.json", furnace_text());
  // A post on the floor; each element is a patch, so that what shoots is what the full matrix has.
  Json furnished = Json::parse(replaced(furnace_text(), "\"objects\": [", R"("objects": [
    {"type": "box", "name": "post", "material": "dim", "low": [0.7, 1.6, 0], "high": [1.15, 2.05, 0.6]},)"));
  furnished["materials"]["dim"] = {{"rho", {0.7, 0.2, 0.4}}};
  for (Json& object : furnished["objects"]) {
    if (object.contains("elements")) object["patches"] = object["elements"];
  }
  const auto post = folder.add("post.json", furnished.dump());
  const auto sensors = folder.add("sensors.json", kSensors);
  const auto readings = [&](const std::filesystem::path& of, const std::vector<std::string>& how) {
    const Ended ended = solve(folder, of, sensors, how);
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_TRUE(holds(ended.out.find("8 sensors") != std::string::npos)) << ended.out;
    const bool relit = !how.empty() && how[0] == "--relight";
    EXPECT_EQ(lines(read_text(folder.path() / (relit ? "out-relit.sensors.csv" : "out.sensors.csv"))).size(), 9u);
    return Json::parse(read_text(folder.path() / (relit ? "out-relit.json" : "out.json")))["sensors"]["readings"];
  };
  const double expected[] = {3, 8, 10};
  const std::vector<std::vector<std::string>> exact{
      {"--method", "progressive", "--factors-by", "exact", "--unshot", "1e-5"},
      {"--method", "adaptive", "--unshot", "1e-5", "--levels", "1"},
      {"--method", "adaptive", "--solve-by", "elimination", "--levels", "1"}};
  for (const auto& how : exact) {
    const Json glowing = readings(scene, how);
    for (std::size_t k = 0; k < 8; ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        const double bound = glowing[k]["bound"][c].get<double>();
        EXPECT_TRUE(near(glowing[k]["irradiance"][c].get<double>(), expected[c], bound)) << k;
        EXPECT_TRUE(within(bound, 1e-3 * expected[c])) << k;
      }
    }
  }
  const Json full = readings(post, {"--tolerance", "1e-5"});
  const Json past_the_post =
      readings(post, {"--method", "progressive", "--factors-by", "exact", "--unshot", "1e-5", "--tolerance", "1e-5"});
  for (std::size_t k = 0; k < 8; ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double h = full[k]["irradiance"][c].get<double>(), factors = 2 * 1e-5 * h / (1 - 0.9);
      EXPECT_TRUE(near(past_the_post[k]["irradiance"][c].get<double>(), h,
                       past_the_post[k]["bound"][c].get<double>() + full[k]["bound"][c].get<double>() + factors));
    }
  }
  const Json pixels = readings(scene, {"--method", "hemicube"});
  const Json shot = readings(scene, {"--method", "progressive", "--per-light", "--unshot", "1e-4"});
  const Json doubled = readings(scene, {"--relight", "glowing=2"});
  for (std::size_t k = 0; k < 8; ++k) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_TRUE(near(pixels[k]["irradiance"][c].get<double>(), expected[c], 1e-9 * expected[c]));
      EXPECT_TRUE(holds(shot[k]["bound"][c].is_null()));
      EXPECT_EQ(doubled[k]["irradiance"][c].get<double>(), 2 * shot[k]["irradiance"][c].get<double>());
    }
  }
  EXPECT_EQ(solve(folder, scene, sensors, {"--method", "progressive", "--extrapolate"}).code, 2);
}

// CLAIM      Where no object that reflects has more than one element along an edge, --extrapolate is refused with 3: the coarser mesh
//            would be the same, and an error of 0 a wrong estimate. Where some have, those that have not are named; what only
//            emits needs no elements and is not.
// ORACLE     exact: the objects, counted by hand.
// TOLERANCE  none.
TEST(SolveSensors, SayWhatExtrapolationCannotEstimate) {
  proves({}, Oracle::exact, "objects counted by hand");
  const TemporaryFolder folder;
  Json scene = Json::parse(furnace_text());
  scene["materials"]["lamp"] = {{"rho", 0}, {"emission", 5}};
  for (Json& object : scene["objects"]) object["elements"] = {1, 1};
  scene["objects"].back()["material"] = "lamp";
  const auto sensors = folder.add("sensors.json", kSensors);
  const auto path = folder.add("cube.json", scene.dump());
  const Ended refused = solve(folder, path, sensors, {"--extrapolate"});
  EXPECT_TRUE(holds(refused.code == 3 && refused.err.find("no mesh is coarser") != std::string::npos)) << refused.err;
  EXPECT_EQ(folder.contents(), "cube.json sensors.json");
  scene["objects"][0]["elements"] = {2, 2};
  scene["objects"][1]["elements"] = {4, 1};
  folder.add("cube.json", scene.dump());
  const Ended some = solve(folder, path, sensors, {"--extrapolate"});
  ASSERT_EQ(some.code, 0) << some.err;
  EXPECT_TRUE(holds(some.out.find("not halved   4 objects of a single element along an edge") != std::string::npos))
      << some.out;
  const Json report = Json::parse(read_text(folder.path() / "out.json"))["sensors"]["extrapolated"];
  EXPECT_EQ(report["not_halved"], Json({"ceiling", "left", "right", "far"}));
  for (Json& object : scene["objects"]) object["elements"] = {2, 2};
  scene["objects"].back()["elements"] = {1, 1};
  folder.add("cube.json", scene.dump());
  const Ended all = solve(folder, path, sensors, {"--extrapolate"});
  EXPECT_TRUE(holds(all.code == 0 && all.out.find("not halved") == std::string::npos)) << all.out;
}

// CLAIM      Sensors are read strictly: each error is told with file, line and what was expected, all at once, with exit code 3;
//            a text file does as well as JSON.
// ORACLE     identity: files with one error each.
// TOLERANCE  none.
TEST(SolveSensors, RefuseFilesThatMakeNoSense) {
  proves({}, Oracle::identity, "messages and exit codes");
  const TemporaryFolder folder;
  const auto scene = folder.add("furnace.json", furnace_text());
  const auto refusal = [&](const std::string& name, const std::string& text, std::vector<std::string> more = {}) {
    const Ended ended = solve(folder, scene, folder.add(name, text), std::move(more));
    EXPECT_EQ(ended.code, 3) << name << ended.err;
    EXPECT_TRUE(holds(!std::filesystem::exists(folder.path() / "out.json"))) << name;
    return ended.err;
  };
  const auto says = [](const std::string& text, const std::string& words) {
    return holds(text.find(words) != std::string::npos) << "no '" << words << "' in " << text;
  };
  const std::string words =
      refusal("words.csv", "# x y z normal\n0.5 0.6 0.7 0 0 1\n1 2 3\n\n1,2,zero,0,0,1\n1 1 1 0 0 0\n");
  EXPECT_TRUE(says(words, "words.csv:3: found 3 words, expected six numbers"));
  EXPECT_TRUE(says(words, "words.csv:5: column 3: found 'zero', expected a number"));
  EXPECT_TRUE(says(words, "words.csv:6: found a normal of length zero"));
  EXPECT_TRUE(says(words, "3 errors"));
  EXPECT_TRUE(says(refusal("none.csv", "# nothing\n"), "none.csv: holds no sensor"));
  const std::string json =
      refusal("bad.json", R"({"format": "etendue-sensors", "version": 1, "unit": "m", "sensros": [],
 "sensors": [{"position": [1, 2], "normal": [0, 0, 0]}],
 "grids": [{"origin": [0, 0, 0], "edges": [[1, 0, 0], [2, 0, 0]], "counts": [1, 0]},
           {"origin": [0, 0, 0], "edges": [[1, 0, 0], [2, 0, 0]], "counts": [1, 1]}]})");
  EXPECT_TRUE(says(json, "bad.json:1:"));
  EXPECT_TRUE(says(json, "did you mean 'sensors'?"));
  EXPECT_TRUE(says(json, "/sensors/0/position"));
  EXPECT_TRUE(says(json, "/sensors/0/normal"));
  EXPECT_TRUE(says(json, "/grids/0/counts/1"));
  EXPECT_TRUE(says(json, "/grids/1/edges: found edges of length zero, or parallel ones"));
  EXPECT_TRUE(says(refusal("empty.json", R"({"format": "etendue-sensors", "version": 1, "unit": "m"})"),
                   "found neither \"sensors\" nor \"grids\""));
  EXPECT_TRUE(says(refusal("askew.csv", "0.5 0.5 0 0 1 1\n"), "askew.csv:1: sensor '0' lies on object 'floor'"));
  EXPECT_TRUE(says(refusal("odd.csv", "0.5 0.5 0.5 0 0 1\n", {"--extrapolate"}),
                   "object 'floor' has an odd number of elements along an edge"));
  EXPECT_EQ(run_etendue({"solve", scene.string(), "--extrapolate"}).code, 2);
  EXPECT_EQ(solve(folder, scene, folder.path() / "missing.csv").code, 5);
}

/// The scene with other numbers of elements; one stays one.
Json scaled(Json scene, double factor) {
  scene["camera"]["resolution"] = {8, 8};
  for (Json& object : scene["objects"]) {
    for (Json& count : object["elements"]) {
      const int n = count.get<int>();
      if (n > 1) count = std::max(2, 2 * static_cast<int>(factor * n / 2 + 0.5));
    }
  }
  return scene;
}

struct Misses {
  double rms = 0, worst = 0;
};

/// Solves a scene of scenes/ on `factor` times its elements, and compares with the reference; all values relatively.
Misses misses(const std::string& name, const std::string& sensors, const std::string& reference, double factor) {
  const TemporaryFolder folder;
  const auto scenes = source_root() / "scenes" / name;
  const Json scene = scaled(Json::parse(read_text(scenes / "scene.json")), factor);
  const Ended ended = solve(folder, folder.add("scene.json", scene.dump()), scenes / sensors,
                            {"--extrapolate", "--solver", "cg", "--tolerance", "1e-3", "--quiet"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  const Json readings = Json::parse(read_text(folder.path() / "out.json"))["sensors"]["readings"];
  Misses found;
  std::size_t count = 0;
  double squares = 0;
  std::istringstream table(read_text(source_root() / "validation" / "reference" / reference));
  for (std::string line; std::getline(table, line);) {
    if (line.starts_with('#')) continue;
    const Json row = Json::parse("[" + line + "]");
    for (std::size_t c = 0; c < 3; ++c) {
      const double miss = readings.at(count)["irradiance"][c].get<double>() / row[c].get<double>() - 1;
      squares += miss * miss;
      found.worst = std::max(found.worst, std::abs(miss));
    }
    ++count;
  }
  EXPECT_EQ(count, readings.size());
  found.rms = std::sqrt(squares / static_cast<double>(3 * count));
  return found;
}

// CLAIM      An empty cube with a light in its ceiling, on half the scene's elements: sensors all over, some 2 cm from edges, are
//            within 10⁻³ rms of the reference. (On all elements within 10⁻⁴: ci/accuracy.)
// ORACLE     table: reference/unit_cube_sensors.csv, by a finer mesh of another grading (reference/sensor_references).
// TOLERANCE  10⁻³ rms, 10⁻² at worst: errors of extrapolated values fall at least like h², so a bar of 10⁻⁴ at h is 4·10⁻⁴ at
//            2h, and 10⁻³ leaves room for an order of 3.3.
TEST(SolveSensors, ComeNearTheTruthInACube) {
  proves({"IU.6-2", "IU.6-7"}, Oracle::table, "unit_cube_sensors.csv");
  const Misses found = misses("unit-cube", "sensors.json", "unit_cube_sensors.csv", 0.5);
  EXPECT_TRUE(within(found.rms, 1e-3));
  EXPECT_TRUE(within(found.worst, 1e-2));
}

// CLAIM      A closed room with two blocks, on two thirds of the scene's rows and columns: 80 sensors on all surfaces are
//            within 0.6 % rms of the reference and 6 % at worst. (On all elements within 0.1 % and 1 %: ci/accuracy.)
// ORACLE     table: reference/cornell_sensors.csv, by a finer mesh of another grading (reference/sensor_references); random walks
//            confirm it (SensorReferences).
// TOLERANCE  guards against a loss of accuracy, no more: between the bars of the whole mesh (0.1 % and 1 %) and what half of it
//            was measured to reach (2 % and 23 %), at their slope: 1.5^4.5 times the former.
TEST(SolveSensors, ComeNearTheTruthAmongBlocks) {
  proves({"IU.6-2", "IU.6-4", "IU.6.5.1"}, Oracle::table, "cornell_sensors.csv");
  const Misses found = misses("cornell", "sensors.csv", "cornell_sensors.csv", 2.0 / 3);
  EXPECT_TRUE(within(found.rms, 6e-3));
  EXPECT_TRUE(within(found.worst, 6e-2));
}

}  // namespace
}  // namespace etendue::validation
