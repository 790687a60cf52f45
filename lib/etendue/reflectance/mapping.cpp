// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/mapping.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "etendue/core/contract.hpp"
#include "etendue/optics/unit.hpp"

namespace etendue {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

void require_frame(const PatternFrame& frame) {
  require(is_unit(frame.pole) && is_unit(frame.equator), "mapping: pole and equator are unit vectors");
  require(std::abs(frame.pole.dot(frame.equator)) <= kUnitTolerance, "mapping: pole and equator are orthogonal");
}

// In [0, 1), from T_e; 0 on the axis.
double share_of_turn(const PatternFrame& frame, const Vec3& v) {
  const double angle = std::atan2(frame.pole.cross(frame.equator).dot(v), frame.equator.dot(v));
  const double share = angle / kTurn;
  if (share >= 0) return share == 0 ? 0 : share;  // −0 too
  return share + 1 < 1 ? share + 1 : 0;
}

}  // namespace

PatternPoint sphere_mapping(const PatternFrame& frame, const Vec3& normal) {
  require_frame(frame);
  require(is_unit(normal), "sphere_mapping: the normal is a unit vector");
  const double sine = frame.pole.cross(normal).norm();
  const double v = std::atan2(sine, -frame.pole.dot(normal)) / std::numbers::pi;
  if (v <= 0 || v >= 1) return {0, std::clamp(v, 0.0, 1.0)};
  return {share_of_turn(frame, normal), v};
}

Vec3 sphere_normal(const PatternFrame& frame, const PatternPoint& at) {
  require_frame(frame);
  const double latitude = std::numbers::pi * at.v, longitude = kTurn * at.u;
  return -std::cos(latitude) * frame.pole +
         std::sin(latitude) *
             (std::cos(longitude) * frame.equator + std::sin(longitude) * frame.pole.cross(frame.equator));
}

PatternPoint cylinder_mapping(const PatternFrame& frame, const Vec3& point, double height) {
  require_frame(frame);
  require(std::isfinite(height) && height > 0, "cylinder_mapping: height is positive");
  require(point.allFinite() && !frame.pole.cross(point).isZero(0), "cylinder_mapping: the point is not on the axis");
  return {share_of_turn(frame, point), frame.pole.dot(point) / height};
}

PatternPoint plane_mapping(const PatternFrame& frame, const Vec3& point, double width) {
  require_frame(frame);
  require(std::isfinite(width) && width > 0, "plane_mapping: width is positive");
  require(point.allFinite(), "plane_mapping: the point is finite");
  return {frame.equator.dot(point) / width, frame.pole.cross(frame.equator).dot(point) / width};
}

CubeView cube_view(CubeFace face) {
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  switch (face) {
    case CubeFace::right:
      return {x, -y, z};
    case CubeFace::left:
      return {-x, y, z};
    case CubeFace::back:
      return {y, x, z};
    case CubeFace::front:
      return {-y, -x, z};
    case CubeFace::top:
      return {z, x, -y};
    default:
      return {-z, x, y};
  }
}

CubePoint cube_mapping(const Vec3& direction) {
  require(direction.allFinite() && !direction.isZero(0), "cube_mapping: the direction is finite and not zero");
  const Vec3 size = direction.cwiseAbs();
  const std::size_t axis = size.x() >= size.y() && size.x() >= size.z() ? 0 : size.y() >= size.z() ? 1 : 2;
  const bool negative = direction[static_cast<Eigen::Index>(axis)] < 0;
  const CubeFace face = kCubeFaces[2 * axis + (negative ? 1 : 0)];
  const CubeView view = cube_view(face);
  const double depth = direction.dot(view.gaze);
  return {face, {0.5 * (1 + direction.dot(view.right) / depth), 0.5 * (1 + direction.dot(view.up) / depth)}};
}

CubeView outside_view(CubeFace face) {
  const CubeView inside = cube_view(face);
  const bool level = face == CubeFace::top || face == CubeFace::bottom;
  const Vec3 up = level ? Vec3(Vec3::UnitY()) : inside.up;
  return {inside.gaze, up.cross(inside.gaze), up};
}

CubePoint box_mapping(const PatternFrame& frame, const Vec3& point, const Vec3& edges) {
  require_frame(frame);
  require(edges.allFinite() && (edges.array() > 0).all(), "box_mapping: edges are positive");
  const Vec3 third = frame.pole.cross(frame.equator);
  const Vec3 q = Vec3(frame.equator.dot(point), third.dot(point), frame.pole.dot(point)).cwiseQuotient(edges / 2);
  const CubeFace face = cube_mapping(q).face;
  const CubeView view = outside_view(face);
  const double depth = q.dot(view.gaze);
  return {face, {0.5 * (1 + q.dot(view.right) / depth), 0.5 * (1 + q.dot(view.up) / depth)}};
}

Vec3 cube_direction(const CubePoint& point) {
  const CubeView view = cube_view(point.face);
  return view.gaze + (2 * point.at.u - 1) * view.right + (2 * point.at.v - 1) * view.up;
}

}  // namespace etendue
