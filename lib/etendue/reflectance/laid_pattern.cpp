// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/laid_pattern.hpp"

#include <numbers>

namespace etendue {

namespace {

PatternPlace place(const LaidOnPlane& plane, const Vec3& x) {
  const Vec3 third = plane.frame.pole.cross(plane.frame.equator);
  return {{plane.frame.equator.dot(x) / plane.width, third.dot(x) / plane.height},
          plane.frame.equator / plane.width,
          third / plane.height};
}

PatternPlace place(const LaidOnCylinder& cylinder, const Vec3& x) {
  const Vec3& axis = cylinder.frame.pole;
  const Vec3 rise = axis / cylinder.height;
  if (axis.cross(x).isZero(0)) return {{0, rise.dot(x)}, Vec3::Zero(), rise};
  return {cylinder_mapping(cylinder.frame, x, cylinder.height), turn_slope(axis, x), rise};
}

PatternPlace place(const LaidOnSphere& sphere, const Vec3& x) {
  const double distance = x.stableNorm();
  if (!(distance > 0)) return {};
  const Vec3& pole = sphere.frame.pole;
  const Vec3 normal = x / distance;
  const Vec3 north = pole - pole.dot(normal) * normal;
  const double sine = north.norm();
  PatternPlace found{sphere_mapping(sphere.frame, normal.normalized()), turn_slope(pole, x), Vec3::Zero()};
  if (sine > 0) found.v_slope = north / (sine * std::numbers::pi * distance);
  return found;
}

PatternPlace place(const LaidOnBox& box, const Vec3& x) {
  if (x.isZero(0)) return {};
  const CubePoint found = box_mapping(box.frame, x, box.edges);
  const CubeView view = outside_view(found.face);
  Mat3 axes;
  axes << box.frame.equator, box.frame.pole.cross(box.frame.equator), box.frame.pole;
  // q = axesᵀ x / half edges; u = ½ + ½ q·right / q·out.
  const Vec3 q = (axes.transpose() * x).cwiseQuotient(box.edges / 2);
  const double depth = q.dot(view.gaze);
  const auto slope = [&](const Vec3& side) -> Vec3 {
    const Vec3 of_q = (side - q.dot(side) / depth * view.gaze) / (2 * depth);
    return axes * of_q.cwiseQuotient(box.edges / 2);
  };
  return {found.at, slope(view.right), slope(view.up)};
}

Vec3 middle(const LaidOnPlane& plane) {
  return plane.origin;
}
Vec3 middle(const LaidOnCylinder& cylinder) {
  return cylinder.origin;
}
Vec3 middle(const LaidOnSphere& sphere) {
  return sphere.centre;
}
Vec3 middle(const LaidOnBox& box) {
  return box.centre;
}

}  // namespace

PatternPlace place_in(const LaidPattern& pattern, const Vec3& point) {
  return std::visit([&](const auto& laid) { return place(laid, point - middle(laid)); }, pattern);
}

PlaneSlopes plane_slopes(const Vec3& first, const Vec3& second) {
  const Vec3 across = first.cross(second);
  const double size = across.squaredNorm();
  if (!(size > 0)) return {Vec3::Zero(), Vec3::Zero()};
  return {second.cross(across) / size, across.cross(first) / size};
}

Vec3 turn_slope(const Vec3& axis, const Vec3& x) {
  const Vec3 around = axis.cross(x);
  const double size = around.squaredNorm();
  return size > 0 ? Vec3(around / (2 * std::numbers::pi * size)) : Vec3(Vec3::Zero());
}

}  // namespace etendue
