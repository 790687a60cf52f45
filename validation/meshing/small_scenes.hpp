// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "etendue/scene/scene.hpp"

namespace etendue::validation {

/// A polygon that the test knows to be sound.
inline Polygon polygon(std::vector<Vec3> vertices) {
  return *Polygon::make(std::move(vertices));
}

inline Polygon quadrilateral(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return polygon({a, b, c, d});
}

/// One object a shape, named "object 0", "object 1" …, all of material 0: reflectance 0.5, no emission.
inline Scene scene_of(const std::vector<Shape>& shapes) {
  Scene scene;
  Material grey;
  grey.name = "grey";
  grey.rho = Rgb::Constant(0.5);
  scene.materials.push_back(grey);
  for (const Shape& shape : shapes) {
    scene.objects.push_back({"object " + std::to_string(scene.objects.size()), shape, 0, {}});
  }
  return scene;
}

/// The six walls of a room from `low` to `high`, seen from inside: floor, ceiling, then x low, x high, y low, y high.
inline Scene room_of(const Vec3& low, const Vec3& high) {
  const auto at = [&](int x, int y, int z) {
    return Vec3(x ? high.x() : low.x(), y ? high.y() : low.y(), z ? high.z() : low.z());
  };
  return scene_of({quadrilateral(at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)),
                   quadrilateral(at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1)),
                   quadrilateral(at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)),
                   quadrilateral(at(1, 1, 0), at(1, 0, 0), at(1, 0, 1), at(1, 1, 1)),
                   quadrilateral(at(1, 0, 0), at(0, 0, 0), at(0, 0, 1), at(1, 0, 1)),
                   quadrilateral(at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1))});
}

}  // namespace etendue::validation
