// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "support/evidence.hpp"
#include "support/scene_builder.hpp"
#include "support/single_samples.hpp"

// Point lights that weaken with distance, in pictures.
namespace etendue::validation {
namespace {

/// A wall at distance 4, and a lamp between it and the eye.
Scene lamp_before_a_wall(const Falloff& falloff) {
  Scene scene;
  scene.camera = straight(32, 24);
  add(scene, square({0, 0, 4}, {0, 0, -1}, 9), diffuse(0.5));
  scene.lights.emplace_back(PointLight{{0.3, -0.2, 2.5}, Rgb(3, 2, 1), falloff});
  return scene;
}

// CLAIM      IU.2-5, IU.2.6a: a point light's I_p is weakened by 1/max(1, d + d0), or by d², with the distance in the light's unit, for rays
//            and rasteriser, at every pixel.
// ORACLE     closed form: k_d I_p f(d) cos θ at the place that the pixel's centre sees, in long double.
// TOLERANCE  64 u of the value: the place errs by some u of its coordinates, f and cos θ by no more than four times that; the
//            rasteriser's place comes of barycentrics rounded in the picture, 2^-40 of the wall's 18.
TEST(Falloff, WeakensALampInPictures) {
  proves({"IU.2-5", "IU.2.6a"}, Oracle::closed_form, "lamp before a wall, pixel by pixel");
  using Law = Falloff::Law;
  for (const Falloff& falloff : {Falloff{Law::none, 1, 0}, Falloff{Law::linear, 1, 0.5}, Falloff{Law::linear, 0.5, 0},
                                 Falloff{Law::inverse_square, 1, 0}, Falloff{Law::inverse_square, 0.01, 0}}) {
    const Scene scene = lamp_before_a_wall(falloff);
    const Image rays = traced_once(scene).image, drawn = drawn_once(scene, 48);
    const long double tan_h = std::tan(static_cast<long double>(scene.camera.horizontal_half_angle));
    const long double tan_v = tan_h * rays.rows / rays.columns;
    for (int row = 0; row < rays.rows; ++row) {
      for (int column = 0; column < rays.columns; ++column) {
        const long double x = 4 * tan_h * (2 * (column + 0.5L) / rays.columns - 1) - 0.3L;
        const long double y = -4 * tan_v * (1 - 2 * (row + 0.5L) / rays.rows) + 0.2L, z = 1.5L;
        const long double distance = std::sqrt(x * x + y * y + z * z), d = distance / falloff.unit;
        const long double share = falloff.law == Law::none     ? 1.0L
                                  : falloff.law == Law::linear ? 1 / std::max(1.0L, d + falloff.d0)
                                                               : 1 / (d * d);
        const double expected = static_cast<double>(0.5L * 3 * share * z / distance);
        EXPECT_TRUE(near(rays.at(column, row)[0], expected, 64 * 0x1p-53 * expected));
        EXPECT_TRUE(near(drawn.at(column, row)[0], expected, 18 * 0x1p-40 * expected));
      }
    }
  }
}

}  // namespace
}  // namespace etendue::validation
