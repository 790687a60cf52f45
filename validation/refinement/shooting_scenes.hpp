// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "etendue/refinement/scene_shooting.hpp"
#include "meshing/small_scenes.hpp"

namespace etendue::validation {

/// The unit cube, each wall divided so often along each edge, one patch an element; the floor emits 1 W/m², all reflect
/// one half.
inline Scene glowing_cube(int cells) {
  Scene scene = room_of({0, 0, 0}, {1, 1, 1});
  Material lamp = scene.materials[0];
  lamp.name = "lamp";
  lamp.emission = Rgb::Ones();
  scene.materials.push_back(lamp);
  scene.objects[0].material = 1;
  for (Object& object : scene.objects) object.subdivision = {{cells, cells}, {cells, cells}};
  return scene;
}

/// A room with a lamp under the ceiling, a box, walls of three colours, and, if asked for, a wall less: cells × cells
/// elements in patches × patches on each wall.
inline Scene furnished(int cells, int patches, bool open) {
  Scene scene = room_of({0, 0, 0}, {2, 3, 1.5});
  if (open) scene.objects.pop_back();
  Material red = scene.materials[0], lamp = scene.materials[0], lantern = scene.materials[0];
  red.name = "red";
  red.rho = Rgb(0.7, 0.2, 0.1);
  lamp.name = "lamp";
  lamp.rho = Rgb::Zero();
  lamp.emission = Rgb(10, 9, 8);
  lantern.name = "lantern";
  lantern.emission = Rgb(0, 1, 4);
  scene.materials.insert(scene.materials.end(), {red, lamp, lantern});
  for (Object& object : scene.objects) object.subdivision = {{cells, cells}, {patches, patches}};
  scene.objects[2].material = 1;
  scene.objects.push_back({"lamp", quadrilateral({0.7, 1, 1.4}, {0.7, 2, 1.4}, {1.3, 2, 1.4}, {1.3, 1, 1.4}), 2, {}});
  const Scene box = room_of({1.7, 2.6, 0.8}, {1.1, 2.0, 0.1});  // low above high: seen from outside
  for (const Object& side : box.objects) scene.objects.push_back(side);
  scene.objects.back().material = 3;
  return scene;
}

inline PatchModel model_of(const Scene& scene) {
  return *patch_model(scene, *mesh_elements(scene));
}

inline SceneShooting begin(const Scene& scene, const PatchModel& model) {
  return before_shooting(model, emissions_of(scene, model));
}

/// All floating-point values of two states are the same.
inline bool same_bits(const SceneShooting& x, const SceneShooting& y) {
  const auto same = [](const std::vector<Rgb>& a, const std::vector<Rgb>& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t k = 0; k < a.size(); ++k) {
      if (!(a[k] == b[k]).all()) return false;
    }
    return true;
  };
  return same(x.irradiance, y.irradiance) && same(x.unshot, y.unshot) && (x.absorbed == y.absorbed).all() &&
         (x.escaped == y.escaped).all() && x.steps == y.steps && x.shooters == y.shooters &&
         x.unshot_shares == y.unshot_shares;
}

}  // namespace etendue::validation
