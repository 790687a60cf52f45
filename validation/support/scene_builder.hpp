// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <utility>

#include "etendue/scene/scene.hpp"

// Small scenes for tests, put together in a line or two.
namespace etendue::validation {

/// Adds an object with a material of its own.
inline std::size_t add(Scene& scene, Shape shape, const Material& material, const char* name = "") {
  scene.materials.push_back(material);
  Object object;
  object.name = name;
  object.shape = std::move(shape);
  object.material = scene.materials.size() - 1;
  scene.objects.push_back(std::move(object));
  return scene.objects.size() - 1;
}

/// Grey, purely diffuse; also for the ambient light.
inline Material diffuse(double k_d) {
  Material material;
  material.k_d = Rgb::Constant(k_d);
  material.k_a = material.k_d;
  return material;
}

/// Nothing but global reflection and transmission.
inline Material specular(double k_r, double k_t, double eta = 1) {
  Material material;
  material.k_r = k_r;
  material.k_t = k_t;
  material.eta = eta;
  return material;
}

/// A camera at the origin that looks along z, its picture 2 wide at the distance 1.
inline Camera straight(int columns, int rows, double shutter = 0) {
  Camera camera;
  camera.gaze = {0, 0, 1};
  camera.up = {0, -1, 0};  // so that x runs to the right
  camera.horizontal_half_angle = std::atan(1.0);
  camera.columns = columns;
  camera.rows = rows;
  camera.shutter = shutter;
  return camera;
}

/// A square of edge 2 · half around `centre`, across `normal`.
inline Polygon square(const Vec3& centre, const Vec3& normal, double half) {
  const Vec3 u = normal.unitOrthogonal() * half;
  const Vec3 v = normal.normalized().cross(u);
  return Polygon::make({centre - u - v, centre + u - v, centre + u + v, centre - u + v}).value();
}

}  // namespace etendue::validation
