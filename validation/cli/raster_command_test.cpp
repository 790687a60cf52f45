// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "etendue/io/image_file.hpp"
#include "support/evidence.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {
namespace {

std::string scene(const char* name) {
  return (source_root() / "scenes" / name / "scene.json").string();
}

// CLAIM      etendue render --method raster draws a scene with each shading, tells how many triangles, draws a scan line, and says once what
//            it leaves out; without anything to leave out it says nothing.
// ORACLE     table: the mirror scene's materials; the spheres' 48 × 24 facets, of which the polar ones are single triangles.
// TOLERANCE  none.
TEST(RasterCommand, DrawsAndSaysWhatIsMissing) {
  proves({"IU.3.1", "IU.3.2b", "IU.3.3", "IU.3.4"}, Oracle::table, "materials and counts of the scenes");
  const TemporaryFolder folder;
  const std::string picture = (folder.path() / "ball.png").string();
  for (const char* const shading : {"flat", "gouraud", "phong", "dot"}) {
    const Ended ended = run_etendue({"render", scene("glossy-spheres"), "--method", "raster", "--shading", shading,
                                     "--size", "60x40", "--scan-line", "12,10,50", "--json", "--output", picture});
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.err, "etendue render: --method raster leaves out shadows; --method raytrace has it\n");
    const auto report = nlohmann::json::parse(ended.out);
    EXPECT_TRUE(holds(report["triangles"] == 6 * (2 * 48 * 24 - 2 * 48)));
    EXPECT_TRUE(holds(report["left_out"] == nlohmann::json::array({"shadows"})));
    EXPECT_TRUE(holds(report["settings"]["shading"].get<std::string>().rfind(shading, 0) == 0));
    EXPECT_TRUE(holds(report["scan_line"]["row"] == 12 && report["scan_line"]["perceived_jump"] >= 0));
    const std::string svg = read_text(folder.path() / "ball.row-12.svg");
    EXPECT_TRUE(holds(svg.find("</svg>") != std::string::npos && svg.find("perceived") != std::string::npos));
  }
  const Ended mirrors =
      run_etendue({"render", scene("mirrors"), "--method", "raster", "--shading", "flat", "--output", picture});
  EXPECT_TRUE(holds(mirrors.code == 3)) << mirrors.err;  // its floor is infinite
  EXPECT_NE(mirrors.err.find("is an infinite plane, which has no corners to be shaded at: use --shading phong or "
                             "--method raytrace"),
            std::string::npos)
      << mirrors.err;
  std::vector<std::string> drawn{"render", scene("slab"), "--method", "raster", "--size", "30x20", "--output", picture};
  const Ended slab = run_etendue(drawn);
  EXPECT_EQ(slab.code, 0);
  EXPECT_EQ(slab.err,
            "etendue render: --method raster leaves out reflection (k_r of 'glass'), refraction (k_t of 'glass') and "
            "shadows; --method raytrace has them\n");
  drawn.emplace_back("--quiet");
  const Ended quiet = run_etendue(drawn);
  EXPECT_TRUE(holds(quiet.code == 0 && quiet.out.empty() && quiet.err.empty())) << quiet.err;
}

// CLAIM      A material that only the rasteriser sees through is named where rays are traced; it is not with --quiet, nor by
//            the rasteriser.
// ORACLE     table: the scene's materials.
// TOLERANCE  none.
TEST(RasterCommand, NamesWhatRaysDoNotSeeThrough) {
  proves({"IU.4.4a"}, Oracle::table, "the materials of figure 28");
  const TemporaryFolder folder;
  const auto told = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"render", scene("see-through"), "--size", "9x6", "--output",
                                     (folder.path() / "vase.png").string()});
    const Ended ended = run_etendue(options);
    EXPECT_EQ(ended.code, 0) << ended.err;
    return ended.err.find("warning: rays do not see through '") != std::string::npos;
  };
  EXPECT_TRUE(holds(told({"--samples", "1"})));
  EXPECT_TRUE(holds(!told({"--samples", "1", "--quiet"})));
  EXPECT_TRUE(holds(!told({"--method", "raster"})));
}

// CLAIM      Options of one method are refused with the other, by name; scan lines outside of the picture too.
// ORACLE     table: the options and what belongs to which.
// TOLERANCE  none.
TEST(RasterCommand, RefusesOptionsOfTheOtherMethod) {
  proves({}, Oracle::table, "which options belong to which method");
  const TemporaryFolder folder;
  const std::string picture = (folder.path() / "no.png").string();
  const auto refused = [&](std::vector<std::string> options, const std::string& words) {
    std::vector<std::string> all{"render", scene("matt-spheres"), "--output", picture};
    all.insert(all.end(), options.begin(), options.end());
    const Ended ended = run_etendue(all);
    return holds(ended.code == 2 && ended.err.find(words) != std::string::npos) << ended.err;
  };
  EXPECT_TRUE(refused({"--shading", "flat"}, "option '--shading' is for --method raster"));
  EXPECT_TRUE(refused({"--facets", "8"}, "option '--facets' is for --method raster"));
  EXPECT_TRUE(refused({"--crease", "8"}, "option '--crease' is for --method raster"));
  EXPECT_TRUE(refused({"--stepping", "incremental"}, "option '--stepping' is for --method raster"));
  const std::string flat = "' says how normals at corners are made; --shading flat takes those of the facets";
  EXPECT_TRUE(refused({"--method", "raster", "--shading", "flat", "--crease", "8"}, "option '--crease" + flat));
  EXPECT_TRUE(refused({"--method", "raster", "--shading", "flat", "--vertex-normals", "area"},
                      "option '--vertex-normals" + flat));
  for (const auto& [option, value] : std::vector<std::pair<std::string, std::string>>{{"--depth", "3"},
                                                                                      {"--sampling", "jittered"},
                                                                                      {"--aov", "depth"},
                                                                                      {"--crop", "0,0,2,2"},
                                                                                      {"--ray-tree", "1,1"},
                                                                                      {"--filter", "tent"},
                                                                                      {"--accelerator", "grid"}}) {
    EXPECT_TRUE(refused({"--method", "raster", option, value}, "option '" + option + "' is for --method raytrace"));
  }
  EXPECT_TRUE(refused({"--scan-line", "288"}, "ROW from 0 to 287 and 0 <= FIRST < LAST <= 640"));
  EXPECT_TRUE(refused({"--scan-line", "5,9,9"}, "ROW from 0 to 287"));
  EXPECT_TRUE(refused({"--scan-line", "5,9"}, "ROW from 0 to 287"));
}

// CLAIM      IU.2.8, IU.2.9: --overflow shows values above 1 in the three ways of the text, in pictures by rays and by rasteriser; the EXR keeps
//            them.
// ORACLE     closed form: each treatment of the values that the EXR has, encoded by the formula of sRGB.
// TOLERANCE  half of a grey level, and as much for the rounding of the EXR to single precision: 0.51/255.
TEST(RasterCommand, ShowsOverflowInThreeWays) {
  proves({"IU.2.8", "IU.2.9"}, Oracle::closed_form, "three treatments, of the EXR's values");
  const TemporaryFolder folder;
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  const auto encoded = [](double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; };
  for (const char* const method : {"raytrace", "raster"}) {
    for (const char* const overflow : {"clamp", "scale-image", "scale-pixel"}) {
      const Ended ended =
          run_etendue({"render", scene("facets"), "--method", method, "--size", "48x25", "--exposure", "2", "--samples",
                       "1", "--overflow", overflow, "--json", "--output", path("a.png")});
      ASSERT_EQ(ended.code, 0) << ended.err;
      EXPECT_TRUE(holds(nlohmann::json::parse(ended.out)["settings"]["overflow"] == overflow));
      const auto exact = read_image(path("a.exr")), shown = read_image(path("a.png"));
      ASSERT_TRUE(exact.ok() && shown.ok());
      double largest = 1, worst = 0;
      std::size_t above = 0;
      for (const auto& pixel : exact->pixels) largest = std::max(largest, 2 * pixel.maxCoeff());
      EXPECT_GT(largest, 1.1);
      for (std::size_t i = 0; i < exact->pixels.size(); ++i) {
        Eigen::Array3d value = 2 * exact->pixels[i];
        above += value.maxCoeff() > 1;
        if (overflow == std::string("clamp")) value = value.min(1.0);
        if (overflow == std::string("scale-image")) value /= largest;
        if (overflow == std::string("scale-pixel")) value /= std::max(1.0, value.maxCoeff());
        for (Eigen::Index c = 0; c < 3; ++c)
          worst = std::max(worst, std::abs(encoded(value[c]) - encoded(shown->pixels[i][c])));
      }
      EXPECT_GT(above, 3u);
      EXPECT_TRUE(within(worst, 0.51 / 255));
    }
  }
}

}  // namespace
}  // namespace etendue::validation
