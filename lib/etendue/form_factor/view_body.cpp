// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/view_body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "etendue/geometry/meeting.hpp"

namespace etendue {

namespace {

/// Seen at a lower angle than this a flat surface is a line: its factor is smaller still.
constexpr double kEdgeOn = 0x1p-45;

std::vector<Vec3> seen_from(const Vec3& eye, std::span<const Vec3> points) {
  std::vector<Vec3> seen;
  seen.reserve(points.size());
  for (const Vec3& point : points) seen.push_back(point - eye);
  return seen;
}

struct Joined {
  double from = 0, to = ViewBody::kNothing;     ///< stretch of a ray
  void below(double slope, double at_origin) {  ///< slope · t ≤ at_origin
    if (slope < 0) {
      from = std::max(from, at_origin / slope);
    } else if (slope > 0) {
      to = std::min(to, at_origin / slope);
    } else if (at_origin < 0) {
      to = -1;
    }
  }
  double entry() const { return from < to ? from : ViewBody::kNothing; }
};

}  // namespace

void ViewBody::surround(std::span<const Vec3> points) {
  middle_ = Vec3::Zero();
  for (const Vec3& point : points) middle_ += point;
  middle_ /= static_cast<double>(points.size());
  size_ = 0;
  for (const Vec3& point : points) size_ = std::max(size_, (point - middle_).norm());
}

std::optional<ViewBody> ViewBody::flat(std::vector<Vec3> corners, Vec3 normal) {
  ViewBody body(Kind::flat);
  body.surround(corners);
  body.offset_ = normal.dot(body.middle_);
  if (std::abs(body.offset_) <= kEdgeOn * (body.middle_.norm() + body.size_)) return std::nullopt;
  if (body.offset_ > 0) {  // its back is seen: turn it, so that it runs counter-clockwise
    std::reverse(corners.begin(), corners.end());
    normal = -normal;
    body.offset_ = -body.offset_;
  }
  body.axis_ = normal;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 &a = corners[k], &b = corners[(k + 1) % corners.size()];
    body.outline_.push_back(ViewCurve::segment(a, b));
    body.planes_.push_back((b - a).cross(a.squaredNorm() < b.squaredNorm() ? a : b));
  }
  return body;
}

std::optional<ViewBody> ViewBody::solid(const Blocker& blocker, const Vec3& eye) {
  ViewBody body(Kind::solid);
  const std::vector<Vec3> points = seen_from(eye, blocker.points());
  body.surround(points);
  std::vector<bool> faces_eye;
  for (const Blocker::Face& face : blocker.faces()) {
    body.sides_.push_back({face.normal, face.normal.dot(points[face.corners.front()])});
    faces_eye.push_back(body.sides_.back().offset < -kEdgeOn * (body.middle_.norm() + body.size_));
  }
  if (std::find(faces_eye.begin(), faces_eye.end(), true) == faces_eye.end()) return std::nullopt;
  for (const Blocker::Edge& edge : blocker.edges()) {
    if (faces_eye[edge.left] == faces_eye[edge.right]) continue;
    const Vec3& a = points[faces_eye[edge.left] ? edge.start : edge.end];
    const Vec3& b = points[faces_eye[edge.left] ? edge.end : edge.start];
    body.outline_.push_back(ViewCurve::segment(a, b));
    body.planes_.push_back((b - a).cross(a.squaredNorm() < b.squaredNorm() ? a : b));
  }
  return body;
}

ViewBody ViewBody::sphere(const Vec3& centre, double radius) {
  ViewBody body(Kind::sphere);
  const double distance = centre.norm();
  const double sine = std::min(1.0, radius / distance);
  const double cosine = std::sqrt((1 - sine) * (1 + sine));
  body.centre_ = body.middle_ = centre;
  body.radius_ = body.size_ = radius;
  const Vec3 towards = centre / distance;
  const TangentFrame frame = tangent_frame(-towards);  // u × v points to the eye
  // The directions of the tangents, as a circle on the unit sphere.
  ViewCurve::add_arc(cosine * towards, sine * frame.u, sine * frame.v, 0, 2 * std::numbers::pi, body.outline_);
  body.reach_ = std::sqrt(std::max(0.0, distance - radius) * (distance + radius));
  body.cones_.push_back(towards * towards.transpose() - cosine * cosine * Mat3::Identity());
  return body;
}

// d · Q d = |δ d − (m · d) c|² − R² (m · d)² for the cone over a circle.
void ViewBody::add_cone(const Vec3& centre, const Vec3& normal, double radius) {
  const double size = centre.norm() + radius;
  const Vec3 c = centre / size;
  const Mat3 across = normal.dot(c) * Mat3::Identity() - c * normal.transpose();
  const double r = radius / size;
  cones_.push_back(across.transpose() * across - r * r * normal * normal.transpose());
}

std::optional<ViewBody> ViewBody::disc(const Vec3& centre, const Vec3& normal, double radius) {
  ViewBody body(Kind::disc);
  body.centre_ = body.middle_ = centre;
  body.radius_ = body.size_ = radius;
  const double offset = normal.dot(centre);
  if (std::abs(offset) <= kEdgeOn * (centre.norm() + radius)) return std::nullopt;
  body.axis_ = offset < 0 ? normal : Vec3(-normal);
  body.offset_ = -std::abs(offset);
  const TangentFrame frame = tangent_frame(body.axis_);
  ViewCurve::add_arc(centre, radius * frame.u, radius * frame.v, 0, 2 * std::numbers::pi, body.outline_);
  body.add_cone(centre, body.axis_, radius);
  return body;
}

void ViewBody::stand(const Cylinder& cylinder, const Vec3& eye) {
  const Vec3 along = cylinder.top - cylinder.base;
  length_ = along.norm();
  axis_ = along / length_;
  centre_ = cylinder.base - eye;
  radius_ = cylinder.radius;
  middle_ = centre_ + 0.5 * along;
  size_ = std::hypot(radius_, 0.5 * length_);
  height_ = -centre_.dot(axis_);
  const Vec3 from_axis = -centre_ - height_ * axis_;
  lateral_ = from_axis.norm();
  outward_ = lateral_ > 0 ? Vec3(from_axis / lateral_) : tangent_frame(axis_).u;
}

// Seen from outside the base runs from left to right, the top from right to left: a wall along the near rim, what is
// filled along the far one where its end is seen.
std::optional<ViewBody> ViewBody::cylinder(Kind kind, const Cylinder& cylinder, const Vec3& eye) {
  ViewBody body(kind);
  body.stand(cylinder, eye);
  const bool ends = kind == Kind::filled;
  const bool below = ends && body.height_ < 0, above = ends && body.height_ > body.length_;
  const Vec3 top = body.centre_ + body.length_ * body.axis_;
  if (body.within_wall()) {
    if (!ends) return std::nullopt;
    return disc(below ? body.centre_ : top, body.axis_, body.radius_);  // hides what is behind it
  }
  const Vec3 u = body.radius_ * body.outward_, v = body.radius_ * body.axis_.cross(body.outward_);
  const double angle = std::acos(body.radius_ / body.lateral_);  // of the silhouettes, from the direction of the eye
  const auto add_side = [&](double turn, bool upwards) {
    const Vec3 rim = std::cos(turn) * u + std::sin(turn) * v;
    const Vec3 from = (upwards ? body.centre_ : top) + rim, to = (upwards ? top : body.centre_) + rim;
    body.outline_.push_back(ViewCurve::segment(from, to));
    body.planes_.push_back((to - from).cross(from));
  };
  constexpr double kTurn = 2 * std::numbers::pi;
  if (below) {
    ViewCurve::add_arc(body.centre_, u, -v, angle, kTurn - angle, body.outline_);
  } else {
    ViewCurve::add_arc(body.centre_, u, v, -angle, angle, body.outline_);
  }
  add_side(angle, true);
  if (above) {
    ViewCurve::add_arc(top, u, v, angle, kTurn - angle, body.outline_);
  } else {
    ViewCurve::add_arc(top, u, -v, -angle, angle, body.outline_);
  }
  add_side(-angle, false);
  body.add_cone(body.centre_, body.axis_, body.radius_);
  body.add_cone(top, body.axis_, body.radius_);
  return body;
}

std::optional<ViewBody> ViewBody::seen(const CurvedPatch& patch, const Vec3& eye) {
  if (const auto* polygon = std::get_if<Polygon>(&patch)) {
    if (polygon->normal().dot(eye - polygon->centroid()) <= 0) return std::nullopt;
    return flat(seen_from(eye, polygon->vertices()), polygon->normal());
  }
  if (const auto* ball = std::get_if<Sphere>(&patch)) return sphere(ball->centre - eye, ball->radius);
  if (const auto* plate = std::get_if<Disc>(&patch)) {
    if (plate->normal.dot(eye - plate->centre) <= 0) return std::nullopt;
    return disc(plate->centre - eye, plate->normal, plate->radius);
  }
  return cylinder(Kind::wall, std::get<Cylinder>(patch), eye);
}

bool ViewBody::add(const CurvedBlocker& blocker, const Vec3& eye, std::vector<ViewBody>& bodies) {
  const auto keep = [&bodies](std::optional<ViewBody> body) {
    if (body) bodies.push_back(*std::move(body));
  };
  if (const auto* faces = std::get_if<Blocker>(&blocker)) {
    if (faces->is_solid()) {
      auto body = solid(*faces, eye);
      const bool outside = body.has_value();
      keep(std::move(body));
      return outside;
    }
    for (const Blocker::Face& face : faces->faces()) {
      std::vector<Vec3> corners;
      for (const std::size_t corner : face.corners) corners.push_back(faces->points()[corner] - eye);
      keep(flat(std::move(corners), face.normal));
    }
    return true;
  }
  if (const auto* ball = std::get_if<Sphere>(&blocker)) {
    if ((ball->centre - eye).norm() < ball->radius * (1 - kEdgeOn)) return false;
    keep(sphere(ball->centre - eye, ball->radius));
    return true;
  }
  if (const auto* plate = std::get_if<Disc>(&blocker)) {
    keep(disc(plate->centre - eye, plate->normal, plate->radius));
    return true;
  }
  ViewBody body(Kind::filled);
  body.stand(std::get<Cylinder>(blocker), eye);
  const double slack = kEdgeOn * (body.middle_.norm() + body.size_);
  if (body.within_wall() && body.height_ >= -slack && body.height_ <= body.length_ + slack) return false;
  keep(cylinder(Kind::filled, std::get<Cylinder>(blocker), eye));
  return true;
}

double ViewBody::cylinder_depth(const Vec3& w) const {
  const double along = w.dot(axis_);
  const Vec3 across = w - along * axis_;
  const double a = across.squaredNorm(), b = across.dot(outward_) * lateral_;
  const double c = (lateral_ - radius_) * (lateral_ + radius_), square = b * b - a * c;
  if (!(square > 0) || !(a > 0)) return kNothing;
  // The eye is outside: it looks inwards or misses.
  if (b >= 0) return kNothing;
  const double root = std::sqrt(square), entry = c / (-b + root), exit = (-b + root) / a;
  if (kind_ == Kind::wall) {
    const double height = height_ + entry * along;
    return height >= 0 && height <= length_ ? entry : kNothing;
  }
  Joined ray{entry, exit};
  ray.below(-along, height_);
  ray.below(along, length_ - height_);
  return ray.entry();
}

double ViewBody::depth(const Vec3& w) const {
  switch (kind_) {
    case Kind::flat:
      for (const Vec3& plane : planes_) {
        if (plane.dot(w) < 0) return kNothing;
      }
      return axis_.dot(w) < 0 ? offset_ / axis_.dot(w) : kNothing;
    case Kind::solid: {
      Joined ray;
      for (const Side& side : sides_) ray.below(side.normal.dot(w), side.offset);
      return ray.entry();
    }
    case Kind::sphere: {
      const double along = w.dot(centre_);
      const double off = (centre_ - along * w).squaredNorm();
      return along > 0 && off < radius_ * radius_ ? along - std::sqrt(radius_ * radius_ - off) : kNothing;
    }
    case Kind::disc: {
      const double slope = axis_.dot(w);
      if (!(slope < 0)) return kNothing;
      const double t = offset_ / slope;
      return (t * w - centre_).squaredNorm() <= radius_ * radius_ ? t : kNothing;
    }
    default:
      return cylinder_depth(w);
  }
}

void ViewBody::cut(const ViewCurve& curve, std::vector<double>& cuts) const {
  for (const Vec3& plane : planes_) curve.cut_by_plane(plane, cuts);
  for (const Mat3& cone : cones_) curve.cut_by_cone(cone, cuts);
}

bool ViewBody::may_overlap(const ViewBody& other) const {
  const double first = middle_.norm(), second = other.middle_.norm();
  if (first <= size_ || second <= other.size_) return true;
  const double angle = std::asin(size_ / first) + std::asin(other.size_ / second);
  constexpr double kRoom = 0x1p-20;  // of the arcs' rounding, generously
  return angle + kRoom >= std::numbers::pi || middle_.dot(other.middle_) >= first * second * std::cos(angle + kRoom);
}

}  // namespace etendue
