// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "etendue/io/scene_reader.hpp"
#include "etendue/optics/colour.hpp"
#include "etendue/optics/illuminants.hpp"
#include "support/evidence.hpp"
#include "support/process.hpp"
#include "support/single_samples.hpp"

// scenes/lamps: three bays, whose lamps weaken by three laws, under two illuminants.
namespace etendue::validation {
namespace {

Scene lamps(const char* file) {
  return read_scene(source_root() / "scenes/lamps" / file).value().scene;
}

/// What a bay's wall shows in a white light, at (across, up) from the point before which its lamp hangs: 0.5 I_p f(d) (N·L), with the
/// numbers of the scene.
double on_the_wall(int bay, double across, double up) {
  const double before = 0.25, d = std::hypot(before, across, up);
  const double arriving = bay == 0 ? 1 : bay == 1 ? 1.25 / (d + 1) : 0.0625 / (d * d);
  return 0.5 * arriving * before / d;
}

/// Colour of a black body relative to daylight's, as bright: Planck's law with rounded constants, over the observer's table.
Rgb white_of_black_body(double c2_over_t_nm) {
  Xyz sum = Xyz::Zero(), day = Xyz::Zero();
  for (int i = 0; i < 81; ++i) {
    const double nm = 380 + 5 * i;
    sum += observer(nm) / (std::pow(nm / 560, 5) * std::expm1(c2_over_t_nm / nm));
    day += observer(nm) * daylight_d65()[static_cast<std::size_t>(i)];
  }
  return (linear_srgb(Xyz(sum / sum.y())) / linear_srgb(Xyz(day / day.y()))).eval();
}

// CLAIM      IU.2-5, IU.2.6a, IU.2.1: with its distance a lamp weakens not at all, by 1/(d + d0), or by 1/d², as the pictures of the three
//            bays show by the light of the sun and of an incandescent lamp.
// ORACLE     closed form: the laws, written out, at the wall's point of each pixel; the light's colour is Planck's, c2/T = 1.438777e7/5772
//            for the sun and 1.435e7/2848 for illuminant A.
// TOLERANCE  1e-12 for the law's few dozen roundings, at most 16 times as bright as nearby; 4e-7 for c2, whose last digit is rounded.
TEST(Lamps, WeakenAsTheirLawsSay) {
  proves({"IU.2-5", "IU.2.6a", "IU.2.1"}, Oracle::closed_form, "three laws and two spectra, pixel by pixel");
  constexpr double kNearest = 1e-12 + 4e-7;
  for (const auto& [file, c2_over_t] :
       {std::pair{"sun.json", 1.438777e7 / 5772}, {"incandescent.json", 1.435e7 / 2848}}) {
    const Scene scene = lamps(file);
    const Image picture = traced_once(scene).image;
    const Rgb white = white_of_black_body(c2_over_t);
    const double edge = 6 * std::tan(14.2 * std::numbers::pi / 180);
    std::size_t seen = 0;
    for (int row = 0; row < picture.rows; ++row) {
      for (int column = 0; column < picture.columns; ++column) {
        const double x = edge * ((column + 0.5) / 240 - 1), z = edge * (84 - row - 0.5) / 240;
        const bool hidden = std::abs(std::abs(x) - 0.5) < 0.06;  // behind a partition, or next to it
        if (hidden || std::abs(x) > 1.49 || std::abs(z) > 0.49) continue;
        const int bay = static_cast<int>(std::lround(x)) + 1;
        const Rgb right = white * on_the_wall(bay, x - (bay - 1), z);
        EXPECT_TRUE(within((picture.at(column, row) - right).abs().maxCoeff(), kNearest));
        ++seen;
      }
    }
    EXPECT_GT(seen, 60000u);
  }
}

}  // namespace
}  // namespace etendue::validation
