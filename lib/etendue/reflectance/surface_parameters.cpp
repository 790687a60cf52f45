// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/surface_parameters.hpp"

#include "etendue/geometry/meeting.hpp"
#include "etendue/geometry/surface_chart.hpp"

namespace etendue {

namespace {

PatternPoint point_of(const Vec2& uv) {
  return {uv.x(), uv.y()};
}

/// Of surfaces with coordinates of their own.
template <class Shape>
PatternPlace on_chart(const Shape& shape, const Hit& hit) {
  const ChartPoint there = chart(shape, hit.point);
  const PlaneSlopes slopes = plane_slopes(there.along_u, there.along_v);
  return {point_of(hit.uv), slopes.first, slopes.second};
}

/// Coordinates in [−1, 1] along two unit vectors, as shares of the whole.
PatternPlace across(const Vec2& offset, const Vec3& u, double half_u, const Vec3& v, double half_v) {
  return {{(1 + offset.x()) / 2, (1 + offset.y()) / 2}, u / (2 * half_u), v / (2 * half_v)};
}

}  // namespace

PatternPlace parameters(const Sphere& sphere, const Hit& hit, std::size_t) {
  return on_chart(sphere, hit);
}

PatternPlace parameters(const Cylinder& cylinder, const Hit& hit, std::size_t) {
  return on_chart(cylinder, hit);
}

PatternPlace parameters(const Cone& cone, const Hit& hit, std::size_t) {
  return on_chart(cone, hit);
}

PatternPlace parameters(const Torus& torus, const Hit& hit, std::size_t) {
  return on_chart(torus, hit);
}

PatternPlace parameters(const BezierSurface& surface, const Hit& hit, std::size_t) {
  const BezierPoint there = at(surface, hit.uv.x(), hit.uv.y());
  const PlaneSlopes slopes = plane_slopes(there.along_u, there.along_v);
  return {point_of(hit.uv), slopes.first, slopes.second};
}

PatternPlace parameters(const Disc& disc, const Hit& hit, std::size_t) {
  const TangentFrame frame = tangent_frame(disc.normal);
  return across(hit.uv, frame.u, disc.radius, frame.v, disc.radius);
}

PatternPlace parameters_on(const Disc& disc, const Vec3& point) {
  const TangentFrame frame = tangent_frame(disc.normal);
  const Vec3 x = (point - disc.centre) / disc.radius;
  return across({frame.u.dot(x), frame.v.dot(x)}, frame.u, disc.radius, frame.v, disc.radius);
}

PatternPlace parameters_on(const Box& box, Eigen::Index axis, const Vec3& point) {
  const Eigen::Index u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Vec3 x = (box.axes.transpose() * (point - box.centre)).cwiseQuotient(box.half_edges);
  return across({x[u], x[v]}, box.axes.col(u), box.half_edges[u], box.axes.col(v), box.half_edges[v]);
}

PatternPlace parameters(const Box& box, const Hit& hit, std::size_t) {
  Eigen::Index axis = 0;
  (box.axes.transpose() * hit.normal).cwiseAbs().maxCoeff(&axis);
  PatternPlace found = parameters_on(box, axis, hit.point);
  found.at = {(1 + hit.uv.x()) / 2, (1 + hit.uv.y()) / 2};
  return found;
}

PatternPlace parameters(const Quadric& quadric, const Hit& hit, std::size_t) {
  const Box& box = quadric.box;
  return across(hit.uv, box.axes.col(0), box.half_edges[0], box.axes.col(1), box.half_edges[1]);
}

PatternPlace parameters_on(const Polygon& polygon, const Vec3& point) {
  const auto& vertices = polygon.vertices();
  const Vec3 first = vertices[1] - vertices.front();
  Vec3 last = vertices.back() - vertices.front();
  // A corner that is none, between edges on one line: a square on the first edge.
  if (!(first.cross(last).norm() > kUnitNormal * first.norm() * last.norm())) last = polygon.normal().cross(first);
  const PlaneSlopes slopes = plane_slopes(first, last);
  const Vec3 x = point - vertices.front();
  return {{slopes.first.dot(x), slopes.second.dot(x)}, slopes.first, slopes.second};
}

PatternPlace parameters(const Polygon& polygon, const Hit& hit, std::size_t) {
  return parameters_on(polygon, hit.point);
}

PatternPlace parameters(const PolygonWithHoles& polygon, const Hit& hit, std::size_t) {
  return parameters_on(polygon.outline(), hit.point);
}

PatternPlace between(const Triangle& triangle, const std::array<Vec2, 3>& corners, const Vec2& at) {
  const PlaneSlopes slopes = plane_slopes(triangle.b - triangle.a, triangle.c - triangle.a);
  const Vec2 first = corners[1] - corners[0], second = corners[2] - corners[0];
  return {point_of(corners[0] + at.x() * first + at.y() * second),
          first.x() * slopes.first + second.x() * slopes.second, first.y() * slopes.first + second.y() * slopes.second};
}

PatternPlace parameters(const Triangle& triangle, const Hit& hit, std::size_t) {
  return between(triangle, {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}, hit.uv);
}

PatternPlace parameters(const Plane& plane, const Hit& hit, std::size_t) {
  const TangentFrame frame = tangent_frame(plane.normal);
  return {point_of(hit.uv), frame.u, frame.v};
}

PatternPlace parameters(const Mesh& mesh, const Hit& hit, std::size_t part) {
  const Triangle triangle = mesh.triangle(part);
  if (mesh.texture.empty()) return parameters(triangle, hit);
  const auto& corner = mesh.triangles[part];
  return between(triangle, {mesh.texture[corner[0]], mesh.texture[corner[1]], mesh.texture[corner[2]]}, hit.uv);
}

}  // namespace etendue
