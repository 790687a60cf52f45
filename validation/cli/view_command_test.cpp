// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "cli/furnace_text.hpp"
#include "etendue/geometry/vector.hpp"
#include "etendue/io/image_file.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

using Words = std::vector<std::string>;

/// The furnace with a dark floor and a right wall that shines less: no two sides look alike.
std::string uneven_furnace() {
  std::string text =
      replaced(furnace_text(), "\"materials\": {",
               R"("materials": {"dark": {"rho": 0.1}, "dim": {"rho": [0.7, 0.2, 0.4], "emission": 0.3},)");
  text = replaced(text, "\"floor\", \"material\": \"glowing\"", "\"floor\", \"material\": \"dark\"");
  return replaced(text, "\"right\", \"material\": \"glowing\"", "\"right\", \"material\": \"dim\"");
}

Ended run(const TemporaryFolder& folder, Words words) {
  ProcessOptions options;
  options.folder = folder.path();
  return run_etendue(words, options);
}

/// Are the pictures equal, each value?
bool equal(const std::filesystem::path& one, const std::filesystem::path& other) {
  const auto a = read_image(one), b = read_image(other);
  if (!a.ok() || !b.ok() || a->columns != b->columns || a->pixels.size() != b->pixels.size()) return false;
  for (std::size_t k = 0; k < a->pixels.size(); ++k) {
    if ((a->pixels[k] != b->pixels[k]).any()) return false;
  }
  return true;
}

/// Are NAME.exr and NAME.png of the two the same pictures?
bool same_pictures(const TemporaryFolder& folder, const std::string& one, const std::string& other) {
  return equal(folder.path() / (one + ".exr"), folder.path() / (other + ".exr")) &&
         equal(folder.path() / (one + ".png"), folder.path() / (other + ".png"));
}

// CLAIM      IU.6.5v: view makes of NAME.json the pictures that solve made, value for value, whatever the method: full, progressive with
//            the ambient term, adaptive with its mesh drawn, cut where a box stands, relit lights; after the scene is gone, too.
// ORACLE     identity: equal pictures.
// TOLERANCE  none.
TEST(ViewCommand, ShowsWhatSolveShowed) {
  proves({"IU.6.5v"}, Oracle::identity, "the pictures of solve");
  const TemporaryFolder folder;
  const auto scene = folder.add("uneven.json", uneven_furnace());
  folder.add("post.json", replaced(uneven_furnace(), "\"objects\": [", R"("objects": [
    {"type": "box", "name": "post", "material": "dim", "low": [0.7, 1.6, 0], "high": [1.15, 2.05, 0.6]},)"));
  struct Case {
    Words solve, view;
    std::string scene = "uneven.json";
  };
  const std::vector<Case> cases{
      {{}, {}},
      {{"--exposure", "0.07", "--samples", "1"}, {"--samples", "1"}},
      {{"--method", "progressive", "--steps", "3", "--ambient"}, {"--ambient"}},
      {{"--method", "adaptive", "--mesh", "--threshold", "0.05"}, {"--mesh"}},
      {{"--method", "hemicube", "--resolution", "64", "--align-mesh"}, {}, "post.json"},
  };
  for (const Case& one : cases) {
    Words solve{"solve", one.scene, "-o", "a.png"}, view{"view", "a.json", "-o", "b.exr", "--scene", one.scene};
    solve.insert(solve.end(), one.solve.begin(), one.solve.end());
    view.insert(view.end(), one.view.begin(), one.view.end());
    ASSERT_EQ(run(folder, solve).code, 0);
    const Ended ended = run(folder, view);
    EXPECT_TRUE(holds(ended.code == 0)) << ended.err;
    EXPECT_TRUE(holds(same_pictures(folder, "a", "b"))) << solve.back();
  }
  ASSERT_EQ(run(folder, {"solve", "uneven.json", "--method", "progressive", "--per-light", "-o", "a.png"}).code, 0);
  ASSERT_EQ(run(folder, {"solve", "uneven.json", "--relight", "dim=4:0:1", "-o", "a.png"}).code, 0);
  std::filesystem::remove(scene);
  EXPECT_EQ(run(folder, {"view", "a-relit.json", "-o", "b.png"}).code, 0);
  EXPECT_TRUE(holds(same_pictures(folder, "a-relit", "b")));
  EXPECT_TRUE(holds(!same_pictures(folder, "a", "b"))) << "the lights differ";
  EXPECT_EQ(folder.contents(), "a-relit.exr a-relit.json a-relit.png a.exr a.json a.png b.exr b.png post.json");
}

// CLAIM      IU.6.5v: the cameras of --camera, in a file by themselves, in other units, in a scene file, and those that --eye, --look-at,
//            --gaze, --up, --fov and --resolution describe, show the one solution as a scene with that camera, solved anew, shows
//            its own; each by its --output, or all under one name.
// ORACLE     metamorphic: solve of the scene with the camera in it. Elements and form factors do not know of cameras.
// TOLERANCE  none where the camera's numbers are the same doubles.
TEST(ViewCommand, LooksThroughEveryCamera) {
  proves({"IU.6.5v"}, Oracle::metamorphic, "the scene solved anew with that camera");
  const TemporaryFolder folder;
  folder.add("uneven.json", uneven_furnace());
  ASSERT_EQ(run(folder, {"solve", "uneven.json", "-o", "s.png"}).code, 0);
  const std::string old = R"("eye": [1, 0.25, 0.75],
    "look_at": [1, 3, 0.75],
    "up": [0, 0, 1],
    "horizontal_fov_deg": 90,
    "resolution": [64, 48])";
  const std::string low = R"("eye": [0.5, 2.5, 0.5], "gaze": [1, -1, 0.25], "up": [0, 1, 4], "horizontal_fov_deg": 75,
     "resolution": [40, 30])";
  const std::string high =
      R"("eye": [1.5, 0.5, 1.25], "look_at": [0.25, 3, 0], "up": [0, 0, 1], "horizontal_fov_deg": 60,
     "resolution": [36, 24])";
  folder.add("low-scene.json", replaced(uneven_furnace(), old, low));
  folder.add("high-scene.json", replaced(uneven_furnace(), old, high));
  for (const std::string name : {"low", "high"}) {
    ASSERT_EQ(run(folder, {"solve", name + "-scene.json", "-o", name + ".png"}).code, 0);
  }
  folder.add("one.json", "{" + low + "}");
  folder.add("both.json", R"({"unit": "m", "cameras": {"first": {)" + low + R"(}, "second": {)" + high + "}}}");
  folder.add("cm.json", R"({"unit": "cm", "cameras": {"a": {)" +
                            replaced(replaced(high, "[1.5, 0.5, 1.25]", "[150, 50, 125]"), "\"look_at\": [0.25, 3, 0]",
                                     "\"gaze\": [-1.25, 2.5, -1.25]") +
                            "}}}");
  const auto shown = [&](const Words& more) {
    Words words{"view", "s.json"};
    words.insert(words.end(), more.begin(), more.end());
    const Ended ended = run(folder, words);
    EXPECT_TRUE(holds(ended.code == 0)) << ended.err;
  };
  shown({"--camera", "one.json", "-o", "v1.png"});
  EXPECT_TRUE(holds(same_pictures(folder, "v1", "low")));
  shown({"--camera", "both.json", "-o", "v2.png"});
  EXPECT_TRUE(holds(same_pictures(folder, "v2-first", "low") && same_pictures(folder, "v2-second", "high")));
  shown({"--camera=high-scene.json", "--camera=one.json", "-o", "v3.png", "-o", "v4.exr"});
  EXPECT_TRUE(holds(same_pictures(folder, "v3", "high") && same_pictures(folder, "v4", "low")));
  shown(
      {"--camera", "cm.json", "-o", "v5.png"});  // 0.01 · 150 and a normalised gaze may round otherwise: compared below
  shown({"--eye=1.5,0.5,1.25", "--look-at=0.25,3,0", "--fov=60", "--resolution=36x24", "-o", "v6.png"});
  EXPECT_TRUE(holds(same_pictures(folder, "v6", "high")));
  shown({"--eye", "0.5,2.5,0.5", "--gaze", "1,-1,0.25", "--up", "0,1,4", "--fov", "75", "--resolution", "40x30"});
  EXPECT_TRUE(holds(!same_pictures(folder, "s", "s-view")));
  const auto expected = read_image(folder.path() / "high.exr"), near_by = read_image(folder.path() / "v5.exr");
  const auto same = read_image(folder.path() / "low.exr"), gazed = read_image(folder.path() / "s-view.exr");
  ASSERT_TRUE(expected.ok() && near_by.ok() && same.ok() && gazed.ok());
  ASSERT_TRUE(expected->pixels.size() == near_by->pixels.size() && same->pixels.size() == gazed->pixels.size());
  std::uint64_t off = 0;  // a rounding moves no more than the sample that an outline passes
  for (std::size_t k = 0; k < expected->pixels.size(); ++k) {
    off += (expected->pixels[k] - near_by->pixels[k]).abs().maxCoeff() > 1e-4;
  }
  for (std::size_t k = 0; k < same->pixels.size(); ++k) {
    off += (same->pixels[k] - gazed->pixels[k]).abs().maxCoeff() > 1e-4;
  }
  EXPECT_TRUE(within(static_cast<double>(off), 4));
}

// CLAIM      IU.6-7, IU.6.5v: view --method gather shows E + ρ H, H what solve --sensors finds at the same points of the same
//            solution, past a box, on elements that were cut for it; the same pictures on one thread and on two.
// ORACLE     another path: irradiance from NAME.sensors.csv, at the ends of the pixels' rays, found here.
// TOLERANCE  2^-23 of the brightest: the EXR holds floats; the sensors' bounds, rounding, are far below.
TEST(ViewCommand, GathersWhatSensorsReceive) {
  proves({"IU.6-7", "IU.6.5v"}, Oracle::program, "solve --sensors at the points that the pixels show");
  const TemporaryFolder folder;
  const Eigen::Array3d low(0.7, 1.6, 0), high(1.15, 2.05, 0.6), room(2, 3, 1.5);
  folder.add("post.json", replaced(uneven_furnace(), "\"objects\": [", R"("objects": [
    {"type": "box", "name": "post", "material": "dim", "low": [0.7, 1.6, 0], "high": [1.15, 2.05, 0.6]},)"));
  const Eigen::Array3d eye(1.625, 0.25, 1.125);
  const int columns = 12, rows = 9;
  std::string sensors;
  std::vector<std::string> shown;  // material
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Vec3 g = Vec3(-1, 2, -0.75).normalized();
      const Vec3 x = g.cross(Vec3(0, 0, 1)).normalized(), y = x.cross(g);
      const double s = 2 * (column + 0.5) / columns - 1, t = (1 - 2 * (row + 0.5) / rows) * rows / columns;
      const Eigen::Array3d d = g + s * std::tan(std::numbers::pi / 4) * x + t * std::tan(std::numbers::pi / 4) * y;
      const Eigen::Array3d to_low = (low - eye) / d, to_high = (high - eye) / d;
      const double enters = to_low.min(to_high).maxCoeff(), leaves = to_low.max(to_high).minCoeff();
      const bool post = enters < leaves && enters > 0;
      const Eigen::Array3d walls = ((d > 0).select(room, Eigen::Array3d::Zero()) - eye) / d;
      Eigen::Index axis = 0;
      const double far = post ? to_low.min(to_high).maxCoeff(&axis) : walls.minCoeff(&axis);
      Eigen::Array3d p = eye + far * d, n = Eigen::Array3d::Zero();
      n(axis) = d(axis) > 0 ? -1 : 1;
      if (post) {
        p(axis) = d(axis) > 0 ? low(axis) : high(axis);
      } else {
        p(axis) = d(axis) > 0 ? room(axis) : 0;
      }
      const bool right = !post && axis == 0 && d(0) > 0, floor = !post && axis == 2 && d(2) < 0;
      shown.push_back(post || right ? "dim" : floor ? "dark" : "glowing");
      std::ostringstream line;
      line.precision(17);
      line << p(0) << ' ' << p(1) << ' ' << p(2) << ' ' << n(0) << ' ' << n(1) << ' ' << n(2) << '\n';
      sensors += line.str();
    }
  }
  folder.add("points.txt", sensors);
  ASSERT_EQ(run(folder, {"solve", "post.json", "--align-mesh", "--sensors", "points.txt", "-o", "s.png"}).code, 0);
  const Words view{"view",         "s.json", "--method", "gather",     "--samples", "1",
                   "--fov",        "90",     "--gaze",   "-1,2,-0.75", "--eye",     "1.625,0.25,1.125",
                   "--resolution", "12x9",   "-o",       "v.png",      "--threads"};
  Words one = view, two = view;
  one.push_back("1");
  two.push_back("2");
  ASSERT_EQ(run(folder, one).code, 0);
  std::filesystem::copy(folder.path() / "v.exr", folder.path() / "w.exr");
  const Ended again = run(folder, two);
  EXPECT_TRUE(holds(again.code == 0 && equal(folder.path() / "v.exr", folder.path() / "w.exr"))) << again.err;
  const auto picture = read_image(folder.path() / "v.exr");
  const auto solution = nlohmann::json::parse(read_text(folder.path() / "s.json"));
  std::map<std::string, std::array<nlohmann::json, 2>> materials;
  for (const auto& element : solution["elements"]) {
    materials[element["material"]] = {element["emission"], element["reflectance"]};
  }
  const auto& readings = solution["sensors"]["readings"];
  ASSERT_TRUE(picture.ok() && picture->pixels.size() == readings.size() && readings.size() == shown.size());
  std::size_t posts = 0;
  for (std::size_t k = 0; k < shown.size(); ++k) {
    posts += shown[k] == "dim";
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [emission, rho] = materials.at(shown[k]);
      const double b = emission[c].get<double>() + rho[c].get<double>() * readings[k]["irradiance"][c].get<double>();
      EXPECT_TRUE(near(picture->pixels[k](static_cast<Eigen::Index>(c)), b, 0x1p-23 * 10)) << shown[k] << k;
    }
  }
  EXPECT_TRUE(holds(posts > 10 && posts < 90)) << posts;
}

double srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

// CLAIM      --tone maps what the PNG shows, by its formula, with solve, view and render alike; the EXR never changes.
// ORACLE     closed form: L_avg of the EXR and the formulas of Reinhard and others 2002, written out here.
// TOLERANCE  half a level of the PNG, and 1e-3 of one for the EXR's rounding to float.
TEST(ViewCommand, TonesThePngAndLeavesTheExr) {
  proves({}, Oracle::closed_form, "the formulas on the values of the EXR");
  const TemporaryFolder folder;
  folder.add("uneven.json", uneven_furnace());
  ASSERT_EQ(run(folder, {"solve", "uneven.json", "-o", "plain.png"}).code, 0);
  const std::vector<Words> commands{
      {"solve", "uneven.json", "--method", "progressive"},
      {"solve", "uneven.json"},
      {"view", "plain.json"},
      {"render", (source_root() / "scenes/mirrors/scene.json").string(), "--columns", "60"}};
  for (const Words& command : commands) {
    Words plain = command;
    plain.insert(plain.end(), {"-o", "p.png", "--exposure", "0.3"});
    if (command[0] == "render") plain[plain.size() - 4] = "--output";
    ASSERT_EQ(run(folder, plain).code, 0) << command[0];
    for (const bool reinhard : {false, true}) {
      Words words = plain;
      words[words.size() - 3] = "t.png";
      words.insert(words.end(), {"--tone", reinhard ? "reinhard" : "key", "--key", "0.25"});
      if (reinhard) words.insert(words.end(), {"--white", "3"});
      const Ended ended = run(folder, words);
      ASSERT_EQ(ended.code, 0) << ended.err;
      EXPECT_TRUE(holds(equal(folder.path() / "p.exr", folder.path() / "t.exr"))) << "the EXR stays as computed";
      const auto exr = read_image(folder.path() / "t.exr"), png = read_image(folder.path() / "t.png");
      ASSERT_TRUE(exr.ok() && png.ok());
      const auto weighed = [](const Eigen::Array3d& p) { return 0.2126 * p(0) + 0.7152 * p(1) + 0.0722 * p(2); };
      double sum = 0, count = 0;
      for (const Eigen::Array3d& pixel : exr->pixels) {
        if (weighed(pixel) <= 0) continue;
        sum += std::log(weighed(pixel));
        ++count;
      }
      const double scale = 0.3 * 0.25 / std::exp(sum / count);
      for (std::size_t k = 0; k < exr->pixels.size(); k += 7) {
        const double l = scale * weighed(exr->pixels[k]);
        const double factor = reinhard ? scale * (1 + l / 9) / (1 + l) : scale;
        for (Eigen::Index c = 0; c < 3; ++c) {
          const double shown = std::min(1.0, factor * exr->pixels[k](c));
          EXPECT_TRUE(near(255 * srgb(png->pixels[k](c)), 255 * srgb(shown), 0.5 + 1e-3));
        }
      }
    }
  }
}

// CLAIM      What view cannot show is refused before anything is written, with the reason: missing, cut, damaged or foreign files,
//            solutions that were stopped before there was one, another scene, cameras that see nothing definite, options that
//            contradict one another, outputs that cannot be written or would replace what is read.
// ORACLE     exact: one defect each.
// TOLERANCE  none.
TEST(ViewCommand, RefusesWhatItCannotShow) {
  proves({}, Oracle::exact, "one defect each");
  const TemporaryFolder folder;
  folder.add("scene.json", furnace_text());
  ASSERT_EQ(run(folder, {"solve", "scene.json", "-o", "s.png"}).code, 0);
  const std::string good = read_text(folder.path() / "s.json");
  const auto changed = [&](const std::string& name, const std::string& from, const std::string& to) {
    folder.add(name, replaced(good, from, to));
  };
  folder.add("cut.json", good.substr(0, good.size() / 2));
  folder.add("list.json", "[1, 2]");
  folder.add("other.json", R"({"method": "x", "scene": 3, "elements": [], "status": "solved"})");
  changed("nan.json", "\"radiosity\": [", "\"radiosity\": [1e999,");
  changed("text.json", "\"radiosity\": [", "\"radiosity\": [\"x\",");
  changed("null.json", "\"radiosity\": [", "\"radiosity\": [null,");
  changed("face.json", "\"face\": 0,", "\"face\": 99,");
  changed("corner.json", "\"vertices\": [", "\"vertices\": [[0,0,0],[0,0,0],");
  changed("old.json", "\"camera\": {", "\"no\": {");
  changed("parallel.json", "\"up\": [", "\"up\": [0,2.75,0],\"was\": [");
  folder.add("bare.json", R"({"eye": [1, 1, 1], "look_at": [1, 1, 1], "up": [0, 0, 1], "horizontal_fov_deg": 270,
"resolution": [0, 10]})");
  folder.add("empty.json", R"({"cameras": {}})");
  folder.add("named.json", R"({"cameras": {"../up": {"eye": [1, 1, 1], "gaze": [1, 0, 0], "up": [0, 0, 1],
"horizontal_fov_deg": 70, "resolution": [8, 8]}}})");
  const std::string camera = R"({"eye": [1, 1, 1], "gaze": [1, 0, 0], "up": [0, 0, 1], "horizontal_fov_deg": 70,
"resolution": [8, 8]})";
  folder.add("one.json", camera);
  folder.add("two.json", R"({"cameras": {"a": )" + camera + R"(, "b": )" + camera + "}}");
  folder.add("changed.json", furnace_text() + "\n");
  const std::string before = folder.contents();
  struct Case {
    Words words;
    int code;
    std::string message;
  };
  const std::vector<Case> cases{
      {{"none.json"}, 5, "cannot read 'none.json'"},
      {{"."}, 5, "cannot read '.'"},
      {{"cut.json"}, 3, "not JSON, or cut short"},
      {{"nan.json"}, 3, "not JSON, or cut short"},
      {{"list.json"}, 3, "no solution that etendue solve wrote"},
      {{"other.json"}, 3, "damaged"},
      {{"scene.json"}, 3, "a scene, no solution"},
      {{"s.png"}, 3, "not JSON"},
      {{"text.json"}, 3, "element 0: not three numbers"},
      {{"null.json"}, 3, "element 0: not three numbers"},
      {{"corner.json"}, 3, "element 0"},
      {{"face.json"}, 3, "element 0: there is no face 99"},
      {{"old.json"}, 3, "an earlier version wrote it"},
      {{"parallel.json"}, 3, "parallel"},
      {{"s.json", "--scene", "changed.json"}, 3, "a solution of another scene than 'changed.json'"},
      {{"s.json", "--scene", "none.json"}, 5, "cannot read 'none.json'"},
      {{"s.json", "--ambient"}, 3, "it holds no ambient term"},
      {{"s.json", "--camera", "none.json"}, 5, "cannot read 'none.json'"},
      {{"s.json", "--camera", "bare.json"}, 3, "bare.json:1:31: /look_at: found the point of \"eye\""},
      {{"s.json", "--camera", "bare.json"}, 3, "/horizontal_fov_deg: found 270, expected a number in (0, 180)"},
      {{"s.json", "--camera", "bare.json"}, 3, "/resolution/0: found 0, expected an integer in [1, 65536]"},
      {{"s.json", "--camera", "list.json"}, 3, "expected an object"},
      {{"s.json", "--camera", "empty.json"}, 3, "found 0 cameras"},
      {{"s.json", "--camera", "named.json"}, 3, "/cameras/..~1up: found a camera whose name makes no name of a file"},
      {{"s.json", "--eye", "1,2"}, 2, "option '--eye': found '1,2', expected three numbers X,Y,Z"},
      {{"s.json", "--eye", "1,,2,3"}, 2, "expected three numbers X,Y,Z"},
      {{"s.json", "--eye", "1,2,1e60"}, 2, "expected three numbers X,Y,Z"},
      {{"s.json", "--eye", "1,2,nan"}, 2, "expected three numbers X,Y,Z"},
      {{"s.json", "--look-at", "1,0.25,0.75"}, 2, "another point than the eye's"},
      {{"s.json", "--gaze", "0,0,0"}, 2, "a direction other than 0,0,0"},
      {{"s.json", "--gaze", "0,0,3"}, 2, "parallel"},
      {{"s.json", "--gaze", "0,1,0", "--look-at", "1,1,1"}, 2, "expected one of them"},
      {{"s.json", "--fov", "180"}, 2, "option '--fov': found '180'"},
      {{"s.json", "--fov", "0"}, 2, "option '--fov': found '0'"},
      {{"s.json", "--resolution", "0x5"}, 2, "COLUMNSxROWS"},
      {{"s.json", "--resolution", "640"}, 2, "COLUMNSxROWS"},
      {{"s.json", "--resolution", "65536x65536"}, 2, "at most 2^28"},
      {{"s.json", "--method", "gathr"}, 2, "expected one of raster, raytrace"},
      {{"s.json", "--key", "0.2"}, 2, "--key is for --tone key and --tone reinhard"},
      {{"s.json", "--tone", "key", "--white", "2"}, 2, "--white is for --tone reinhard"},
      {{"s.json", "--tone", "reinhart"}, 2, "did you mean 'reinhard'"},
      {{"s.json", "--tone", "key", "--key", "0"}, 2, "option '--key': found '0'"},
      {{"s.json", "-o", "v.jpg"}, 2, "v.jpg"},
      {{"s.json", "-o", "no/v.png"}, 5, "there is no folder"},
      {{"s.json", "-o", "v.png", "-o", "w.png"}, 2, "2 --outputs for 1 camera"},
      {{"s.json", "--camera", "one.json", "--camera", "one.json", "-o", "v.png"}, 2, "two pictures would be named"},
      {{"s.json", "--camera", "two.json", "-o", "v.png", "-o", "v.exr"}, 2, "two pictures would be named"},
      {{}, 2, "missing argument SOLUTION"},
  };
  std::uint64_t wrong = 0;
  for (const Case& one : cases) {
    Words words = one.words;
    words.insert(words.begin(), "view");
    const Ended ended = run(folder, words);
    const bool as_said = ended.code == one.code && ended.out.empty() &&
                         ended.err.find(one.message) != std::string::npos && folder.contents() == before;
    wrong += !as_said;
    EXPECT_TRUE(as_said) << one.message << "\n" << ended.code << " " << ended.err << ended.out << folder.contents();
  }
  EXPECT_TRUE(all_agree(wrong, cases.size()));
}

}  // namespace
}  // namespace etendue::validation
