// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "etendue/refinement/adaptive_radiosity.hpp"
#include "refinement/shooting_scenes.hpp"

namespace etendue::validation {

/// A floor of reflectance one half, a square lamp above it, and a plate between: all but the floor is black, so that the
/// floor's irradiance is the lamp's alone.
struct Penumbra {
  double lamp_height = 2, plate_height = 0.4;
  std::array<double, 4> lamp{0.25, 0.75, 0.25, 0.75}, plate{0.35, 0.8, 0.4, 0.7};  // x low, x high, y low, y high

  Scene scene(int cells) const {
    const auto at = [](const std::array<double, 4>& r, double z) {
      return quadrilateral({r[0], r[2], z}, {r[0], r[3], z}, {r[1], r[3], z}, {r[1], r[2], z});
    };
    Scene made = scene_of(
        {quadrilateral({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}), at(lamp, lamp_height), at(plate, plate_height)});
    Material black = made.materials[0];
    black.name = "black";
    black.rho = Rgb::Zero();
    Material shining = black;
    shining.name = "lamp";
    shining.emission = Rgb::Constant(100);
    made.materials.insert(made.materials.end(), {black, shining});
    made.objects[1].material = 2;
    made.objects[2].material = 1;
    made.objects[0].subdivision = {{cells, cells}, {1, 1}};
    return made;
  }

  /// Radiosity of the floor at a point, in closed form: the lamp less the part that the plate hides, which from a point is
  /// a rectangle.
  double radiosity(double x, double y) const {
    const double grown = lamp_height / plate_height;
    const auto shadow = [&](double edge, double own) { return own + grown * (edge - own); };
    const double hidden_x0 = std::max(lamp[0], shadow(plate[0], x)), hidden_x1 = std::min(lamp[1], shadow(plate[1], x));
    const double hidden_y0 = std::max(lamp[2], shadow(plate[2], y)), hidden_y1 = std::min(lamp[3], shadow(plate[3], y));
    const auto seen = [&](double x0, double x1, double y0, double y1) {
      return x0 < x1 && y0 < y1
                 ? corner(x1 - x, y1 - y) - corner(x0 - x, y1 - y) - corner(x1 - x, y0 - y) + corner(x0 - x, y0 - y)
                 : 0;
    };
    return 0.5 * 100 * (seen(lamp[0], lamp[1], lamp[2], lamp[3]) - seen(hidden_x0, hidden_x1, hidden_y0, hidden_y1));
  }

  /// Form factor from a point to a parallel rectangle whose corner is above the point (Howell B-3), odd in both sides.
  double corner(double a, double b) const {
    const double u = a / lamp_height, v = b / lamp_height;
    const double p = std::sqrt(1 + u * u), q = std::sqrt(1 + v * v);
    return (u / p * std::atan(v / p) + v / q * std::atan(u / q)) / (2 * std::numbers::pi);
  }
};

inline constexpr AssemblyTolerance kGood{{1e-12, 1e-15}, {1e-5, 1e-8}};

inline FactorsOf exactly() {
  return [](const PatchModel& model) { return exact_factors(model, kGood); };
}

inline AdaptiveSolution adapted(const Scene& scene, const AdaptiveGoal& goal, double unshot = 1e-6) {
  auto begun = before_adapting(scene, model_of(scene), Beginning::halved_singles);
  return adapt_by_shooting(scene, *begun, exactly(), goal, {unshot, 100'000, ShotRule::unshot}).value();
}

/// Root mean square over points of the floor of constant radiosities on the elements less the closed form.
inline double error_on_floor(const Penumbra& penumbra, const AdaptiveSolution& solution) {
  constexpr int kPoints = 96;
  const Scene scene = penumbra.scene(4);
  const auto values = radiosities(scene, solution.model, emissions_of(scene, solution.model), solution.state);
  double sum = 0;
  for (int b = 0; b < kPoints; ++b) {
    for (int a = 0; a < kPoints; ++a) {
      const double x = (a + 0.5) / kPoints, y = (b + 0.5) / kPoints;
      for (std::size_t k = 0; k < values.size(); ++k) {
        const auto& v = solution.model.elements.elements[k].polygon.vertices();
        if (solution.mesh.cells[k].face != 0 || x < v[0].x() || x >= v[2].x() || y < v[0].y() || y >= v[2].y())
          continue;
        const double error = values[k](0) - penumbra.radiosity(x, y);
        sum += error * error;
      }
    }
  }
  return std::sqrt(sum / (kPoints * kPoints));
}

inline std::size_t floor_elements(const AdaptiveSolution& solution) {
  return static_cast<std::size_t>(std::count_if(solution.mesh.cells.begin(), solution.mesh.cells.end(),
                                                [](const MeshCell& c) { return c.face == 0; }));
}

}  // namespace etendue::validation
