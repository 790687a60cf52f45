// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "etendue/core/rounding.hpp"
#include "etendue/view/shaded_view.hpp"
#include "support/evidence.hpp"
#include "support/scene_builder.hpp"

namespace etendue::validation {
namespace {

constexpr double kBlending =
    8 * kUnitRoundoff;  // two blends of colours below 2, each within 3.1 u of them: header of see_through()

Image drawn(const Scene& scene, Shading shading = Shading::phong, int facets = 48) {
  ShadingOptions options;
  options.shading = shading;
  options.samples = 1;
  options.net.facets = facets;
  auto view = view_shaded(scene, options);
  EXPECT_TRUE(view.ok());
  return view->image;
}

Material clear(const Rgb& k_a, const TransparencyLaw& law) {
  Material material;
  material.k_a = k_a;
  material.see_through = law;
  return material;
}

Scene before(int columns, int rows) {
  Scene scene;
  scene.camera = straight(columns, rows);
  scene.ambient = Rgb::Ones();
  scene.background = {0.9, 0.1, 0.4};
  return scene;
}

// CLAIM      IU.4.4a, figure 28: where a polygon p_f stands before p_b, pixels show (1 − t) of the front's light and t of what they show without
//            it, by every shading; elsewhere they show what they did.
// ORACLE     metamorphic: pictures without the front, and with an opaque one.
// TOLERANCE  kBlending.
TEST(SeeThrough, BlendsAFrontWithWhatLiesBehind) {
  proves({"IU.4.4a", "E4"}, Oracle::metamorphic, "pictures without the front, and with an opaque one");
  const Shape front = square({-0.4, 0.1, 2}, {0.2, 0.1, -1}, 0.9);
  Scene without = before(60, 50);
  add(without, square({0.5, -0.2, 4}, {0, 0.3, -1}, 1.1), diffuse(0.6), "p_b");
  without.lights = {DirectionalLight{Vec3(1, 2, -2) / 3, {0.9, 0.6, 0.3}}};
  Material yellow = diffuse(0.5);
  yellow.k_d = {0.8, 0.7, 0.1};
  for (const Shading shading : {Shading::flat, Shading::gouraud, Shading::phong, Shading::dot}) {
    Scene opaque = without, seen = without;
    add(opaque, front, yellow, "p_f");
    yellow.see_through = TransparencyLaw{{0.35, 0.35}, 1};
    add(seen, front, yellow, "p_f");
    yellow.see_through.reset();
    Scene alone = opaque;
    alone.background = {-1, -1, -1};
    alone.objects.erase(alone.objects.begin());
    const Image a = drawn(opaque, shading), b = drawn(without, shading), both = drawn(seen, shading),
                mask = drawn(alone, shading);
    int blended = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
      const bool through = mask.pixels[i][0] >= 0;
      const Rgb expected = through ? Rgb(0.65 * a.pixels[i] + 0.35 * b.pixels[i]) : b.pixels[i];
      EXPECT_TRUE(within((both.pixels[i] - expected).abs().maxCoeff(), kBlending));
      blended += through && (a.pixels[i] != b.pixels[i]).any() ? 1 : 0;
    }
    EXPECT_GT(blended, 200);
  }
}

// CLAIM      IU.4.4a: sheets are laid over each other from the farthest to the nearest, pixel by pixel, in whatever order a scene names them, and
//            where they pierce each other; opaque ones hide what is behind them and nothing else.
// ORACLE     exact: depths of planes along the ray of each pixel decide the order, in doubles of the test's own.
// TOLERANCE  kBlending for each of four sheets; pixels whose depths differ by less than 1e-3 are left out, for corners are snapped.
TEST(SeeThrough, SortsBackToFrontInEachPixel) {
  proves({"IU.4.4a"}, Oracle::exact, "depths along rays");
  struct Sheet {
    Vec3 point, normal;
    Rgb colour;
    double t;
  };
  const Sheet sheets[] = {{{0, 0, 4}, {0.5, 0, -1}, {0.9, 0, 0}, 0.3},
                          {{0, 0, 4}, {-0.5, 0.2, -1}, {0, 0.8, 0}, 0.6},
                          {{0, 0, 3}, {0, -0.4, -1}, {0, 0, 0.7}, 0.45},
                          {{0, 0, 5}, {0, 0.1, -1}, {0.5, 0.5, 0}, 0}};  // opaque
  int order[] = {0, 1, 2, 3};
  int compared = 0;
  do {
    Scene scene = before(40, 40);
    for (const int s : order) {
      const Sheet& sheet = sheets[s];
      Material material;
      material.k_a = sheet.colour;
      if (sheet.t > 0) material.see_through = TransparencyLaw{{sheet.t, sheet.t}, 1};
      add(scene, square(sheet.point, sheet.normal, 8), material);
    }
    const Image picture = drawn(scene);
    for (int row = 0; row < 40; row += 3) {
      for (int column = 0; column < 40; column += 3) {
        const Vec3 ray((column + 0.5) / 20 - 1, (row + 0.5) / 20 - 1, 1);
        std::vector<std::pair<double, int>> met;
        for (int s = 0; s < 4; ++s)
          met.emplace_back(sheets[s].point.dot(sheets[s].normal) / ray.dot(sheets[s].normal), s);
        std::sort(met.rbegin(), met.rend());
        bool close = false;
        for (std::size_t k = 1; k < met.size(); ++k) close |= met[k - 1].first - met[k].first < 1e-3;
        if (close) continue;
        Rgb expected = scene.background;
        for (const auto& [depth, s] : met) expected = (1 - sheets[s].t) * sheets[s].colour + sheets[s].t * expected;
        EXPECT_TRUE(within((picture.at(column, row) - expected).abs().maxCoeff(), 4 * kBlending));
        ++compared;
      }
    }
  } while (std::next_permutation(order, order + 4));
  EXPECT_GT(compared, 24 * 100);
}

// CLAIM      IU.4.4b, figure 29: through a ball of glass, both of whose walls count, one sees less at the silhouette, linearly in n_z or confined to a
//            rim by a power: I = I_f + t² (I_b − I_f), from t_max² in the middle on.
// ORACLE     closed form: n_z = N·V where the pixel's ray meets the ball, in long double.
// TOLERANCE  a net of 512 × 256 facets lies within R (1 − cos π/256) = 8e-5 R of the ball: n_z, above 0.2, is off by less than
//            8e-5/0.2 + 1e-4 = 5e-4, t by m (t_max − t_min) times this, I by 2 t times that: 2.1e-3 for m = 3.
TEST(SeeThrough, IsLessClearAtSilhouettes) {
  proves({"IU.4.4b", "E4"}, Oracle::closed_form, "a ball of glass in long double");
  const Vec3 centre(0.1, -0.2, 5);
  constexpr double kRadius = 1.6, kLeast = 0.2, kGreatest = 0.9;
  for (const double m : {1.0, 2.0, 3.0}) {
    Scene scene = before(90, 90);
    scene.camera.horizontal_half_angle = 0.4;
    add(scene, Sphere{centre, kRadius}, clear({0.2, 0.5, 0.3}, {{kLeast, kGreatest}, m}));
    const Image picture = drawn(scene, Shading::phong, 512);
    int ball = 0;
    for (int row = 0; row < 90; ++row) {
      for (int column = 0; column < 90; ++column) {
        using Long = long double;
        const Long tangent = std::tan(static_cast<Long>(0.4));
        Eigen::Matrix<Long, 3, 1> d(((2 * column + 1) / static_cast<Long>(90) - 1) * tangent,
                                    ((2 * row + 1) / static_cast<Long>(90) - 1) * tangent, 1);
        d.normalize();
        const Long along = d.dot(centre.cast<Long>()), r = kRadius;
        const Long squared = r * r - (centre.cast<Long>().squaredNorm() - along * along);
        const Long n_z = squared > 0 ? std::sqrt(squared) / r : 0;
        if (n_z < 0.2L) continue;
        const Long t = kLeast + (static_cast<Long>(kGreatest) - kLeast) * (1 - std::pow(1 - n_z, static_cast<Long>(m)));
        const double share = static_cast<double>(t * t);
        const Rgb expected = (1 - share) * Rgb(0.2, 0.5, 0.3) + share * scene.background;
        constexpr double kNet = 5e-4 * 2 * (kGreatest - kLeast);
        EXPECT_TRUE(within((picture.at(column, row) - expected).abs().maxCoeff(), m * kNet))
            << m << " " << column << " " << row;
        ++ball;
      }
    }
    EXPECT_GT(ball, 2000);
  }
}

}  // namespace
}  // namespace etendue::validation
