// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "cli/furnace_text.hpp"
#include "etendue/assembly/scene_radiosity.hpp"
#include "etendue/io/image_file.hpp"
#include "etendue/io/scene_reader.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

Ended solve(const std::filesystem::path& scene, const std::string& name, std::vector<std::string> more) {
  more.insert(more.begin(), {"solve", scene.string(), "--output", (scene.parent_path() / (name + ".png")).string()});
  return run_etendue(more);
}

/// The furnace with a floor that reflects little: no two rows of its system are alike.
std::string uneven_furnace() {
  const std::string dark = replaced(furnace_text(), "\"materials\": {", "\"materials\": {\"dark\": {\"rho\": 0.1},");
  return replaced(dark, "\"floor\", \"material\": \"glowing\"", "\"floor\", \"material\": \"dark\"");
}

/// The numbers of each "radiosity": [r, g, b] of a report; 17 digits, so that they are the program's doubles.
std::vector<std::array<double, 3>> radiosities(const std::string& report) {
  const std::string key = "\"radiosity\": [";
  std::vector<std::array<double, 3>> found;
  for (std::size_t at = report.find(key); at != std::string::npos; at = report.find(key, at + 1)) {
    const char* next = report.c_str() + at + key.size();
    std::array<double, 3> one{};
    for (double& value : one) {
      char* end = nullptr;
      value = std::strtod(next, &end);
      next = end + 1;  // a comma or the bracket
    }
    found.push_back(one);
  }
  return found;
}

/// The same by the library in this process.
std::vector<std::array<double, 3>> radiosities(const std::filesystem::path& path, RadiositySolver solver) {
  const auto file = read_scene(path);
  const auto mesh = mesh_elements(file.value().scene);
  const FormFactorMatrix matrix = assemble_form_factors(mesh.value(), AssemblyTolerance{}, Execution{});
  const auto solution = solve_scene_radiosity(file.value().scene, mesh.value(), matrix, {solver});
  std::vector<std::array<double, 3>> all;
  for (const Rgb& b : solution.value().radiosity) all.push_back({b(0), b(1), b(2)});
  return all;
}

// CLAIM      --solver takes the method that it names: the radiosities have its bits, and report and picture its name.
//            eigen is another word for lu, and gauss what is taken unasked.
// ORACLE     identity: the library's solvers, called in this process; their roundings differ.
// TOLERANCE  none: equal doubles.
TEST(SolvePictures, ComeFromTheSolverThatWasNamed) {
  proves({}, Oracle::identity, "the bits of the library's solver of that name");
  const TemporaryFolder folder;
  const auto scene = folder.add("uneven.json", uneven_furnace());
  std::vector<std::string> names = solver_names();
  names.insert(names.end(), {"eigen", "default"});
  std::set<std::vector<std::array<double, 3>>> distinct;
  for (const std::string& name : names) {
    const std::string told = name == "default" ? "gauss" : name == "eigen" ? "lu" : name;
    const auto expected = radiosities(scene, solver_named(told).value());
    distinct.insert(expected);
    const auto options = name == "default" ? std::vector<std::string>{} : std::vector<std::string>{"--solver", name};
    const Ended ended = solve(scene, name, options);
    ASSERT_EQ(ended.code, 0) << ended.err;
    const std::string report = read_text(folder.path() / (name + ".json"));
    EXPECT_TRUE(holds(radiosities(report) == expected)) << name;
    EXPECT_TRUE(holds(report.find("\"solver\": \"" + told + "\"") != std::string::npos)) << name;
    const auto metadata = read_image_metadata(folder.path() / (name + ".exr"));
    ASSERT_TRUE(metadata.ok());
    EXPECT_TRUE(holds(std::count(metadata->begin(), metadata->end(),
                                 std::pair<std::string, std::string>("etendue:solver", told)) == 1));
  }
  ASSERT_EQ(distinct.size(), solver_names().size()) << "they must be told apart by their roundings";
}

/// The curve of IEC 61966-2-1, and its inverse.
double srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

// CLAIM      The EXR holds the radiosities, the PNG the same times --exposure through the sRGB curve, rounded to a byte;
//            without --exposure the largest value becomes white.
// ORACLE     closed form: E/(1 − ρ) in every pixel of the furnace, and the curve written out here.
// TOLERANCE  EXR: the nearest float. PNG: half a level, and 1e-4 of one for the float and the curve's own rounding.
TEST(SolvePictures, HaveTheExposureInThePngOnly) {
  proves({}, Oracle::closed_form, "E/(1 − ρ), exposure and sRGB curve");
  const TemporaryFolder folder;
  const auto scene = folder.add("furnace.json", furnace_text());
  const double truth[] = {3, 8, 10};
  for (const double exposure : {0.0625, 0.015625, 0.1}) {
    const auto options = exposure == 0.1
                             ? std::vector<std::string>{"--samples=1"}  // 1 / the largest, blue
                             : std::vector<std::string>{"--samples=1", "--exposure", std::to_string(exposure)};
    ASSERT_EQ(solve(scene, "out", options).code, 0);
    const auto exr = read_image(folder.path() / "out.exr"), png = read_image(folder.path() / "out.png");
    ASSERT_TRUE(exr.ok() && png.ok());
    ASSERT_EQ(exr->pixels.size(), png->pixels.size());
    for (std::size_t k = 0; k < exr->pixels.size(); k += 97) {
      for (Eigen::Index c = 0; c < 3; ++c) {
        EXPECT_TRUE(near(exr->pixels[k](c), truth[c], truth[c] * 0x1p-24));
        const double level = 255 * srgb(png->pixels[k](c));
        EXPECT_TRUE(near(level, 255 * srgb(truth[c] * exposure), 0.5 + 1e-4));
        EXPECT_TRUE(near(level, std::round(level), 1e-4));
      }
    }
  }
}

// CLAIM      --samples N averages N × N samples of a pixel: with one, edges are hard; with two or three, they have steps of
//            a quarter or a ninth.
// ORACLE     render: a plate of radiosity 1 before nothing, turned in the picture, so that its edges cross pixels.
// TOLERANCE  the nearest float, and the roundings of nine values of 1: 1e-6.
TEST(SolvePictures, AverageAsManySamplesAsAsked) {
  proves({}, Oracle::render, "the steps of grey at a plate's edges");
  const TemporaryFolder folder;
  const auto scene = folder.add("plate.json", R"({"format": "etendue-scene", "version": 1, "unit": "m",
 "camera": {"eye": [0.5, 0.5, 2], "look_at": [0.5, 0.5, 0], "up": [0.3, 1, 0], "horizontal_fov_deg": 60,
            "resolution": [32, 32]},
 "materials": {"grey": {"rho": 0.5, "emission": 1}},
 "objects": [{"type": "polygon", "name": "plate", "material": "grey",
              "vertices": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]}]})");
  for (const int samples : {1, 2, 3}) {
    ASSERT_EQ(solve(scene, "out", {"--samples", std::to_string(samples)}).code, 0);
    const auto picture = read_image(folder.path() / "out.exr");
    ASSERT_TRUE(picture.ok());
    std::vector<int> steps(static_cast<std::size_t>(samples * samples) + 1, 0);
    for (const Rgb& pixel : picture->pixels) {
      const double step = pixel(0) * samples * samples;
      EXPECT_TRUE(near(step, std::round(step), 1e-6));
      ++steps.at(static_cast<std::size_t>(std::lround(step)));
    }
    EXPECT_TRUE(holds(std::count(steps.begin(), steps.end(), 0) == 0)) << samples << ": every step occurs";
  }
}

// CLAIM      --write takes files for other programs, several and of every ending, with the full method and with those that
//            refine; radiosity and irradiance in the CSV are those of the solution. Another ending (2), a file of the
//            scene (2) and a path that cannot be written (5) are refused before anything is computed or written.
// ORACLE     closed form: B = H = E/(1 − ρ) in the furnace; the report's radiosities, digit for digit.
// TOLERANCE  full: 1e-9, above the reported bounds, 4e-11; progressive: 1e-5, for light that is unshot.
TEST(SolvePictures, WritesFilesForOtherPrograms) {
  proves({}, Oracle::closed_form, "E/(1 − ρ)");
  const double expected[] = {3, 8, 10};
  for (const std::string method : {"full", "progressive"}) {
    const TemporaryFolder folder;
    const auto scene = folder.add("scene.json", furnace_text());
    std::vector<std::string> more = {"--method", method};
    if (method != "full") more.insert(more.end(), {"--unshot", "1e-7", "--factors-by", "exact"});
    for (const char* ending : {"csv", "npy", "vtu", "obj", "gltf", "glb"}) {
      more.insert(more.end(), {"--write", (folder.path() / "w.").string() + ending});
    }
    const Ended ended = solve(scene, "out", more);
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_NE(ended.out.find("w.glb\n"), std::string::npos) << ended.out;
    EXPECT_EQ(folder.contents(), "out.exr out.json out.png scene.json w.csv w.glb w.gltf w.npy w.obj w.vtu");
    const auto saved = nlohmann::json::parse(read_text(folder.path() / "out.json"))["elements"];
    std::istringstream lines(read_text(folder.path() / "w.csv"));
    std::string line;
    std::getline(lines, line);
    std::size_t k = 0;
    for (; std::getline(lines, line); ++k) {
      std::istringstream cells(line);
      std::vector<double> row;
      for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::strtod(cell.c_str(), nullptr));
      ASSERT_EQ(row.size(), 15u);
      ASSERT_LT(k, saved.size());
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_EQ(row[9 + c], saved[k]["radiosity"][c].get<double>());
        EXPECT_TRUE(near(row[9 + c], expected[c], method == "full" ? 1e-9 : 1e-5));
        EXPECT_TRUE(near(row[12 + c], expected[c], method == "full" ? 1e-9 : 1e-5));
      }
    }
    EXPECT_TRUE(holds(k == 48 && k == saved.size()));
  }
  for (const std::string method : {"full", "progressive"}) {
    const TemporaryFolder folder;
    const auto scene = folder.add("scene.csv", furnace_text());
    const auto refused = [&](const std::string& file, int code, const std::string& words) {
      const Ended ended = solve(scene, "out", {"--method", method, "--write", file});
      EXPECT_TRUE(holds(ended.code == code)) << ended.code;
      EXPECT_NE(ended.err.find(words), std::string::npos) << ended.err;
      EXPECT_TRUE(holds(folder.contents() == "scene.csv" && read_text(scene) == furnace_text()));
    };
    refused((folder.path() / "w.ply").string(), 2,
            "found ending '.ply', expected .csv, .npy, .vtu, .obj, .gltf or .glb");
    refused(scene.string(), 2, "is a file of the scene and would be replaced");
    refused((folder.path() / "no" / "w.csv").string(), 5, "there is no folder");
  }
}

}  // namespace
}  // namespace etendue::validation
