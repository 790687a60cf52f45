// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/catalogue/drawing.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

namespace etendue::catalogue {

namespace {

constexpr double kWidth = 420, kHeight = 320, kMargin = 46;
/// The viewer stands 32° to the right of the front and 24° above.
constexpr double kAzimuth = 32 * std::numbers::pi / 180, kElevation = 24 * std::numbers::pi / 180;
constexpr int kCorners = 72;   ///< of a drawn circle
constexpr double kAside = 13;  ///< of a letter from its line [pixels]
/// What is drawn is of order one; shorter than this it has no direction and no scale, and only must not divide by zero.
constexpr double kLeastLength = 1e-12;

constexpr const char* fill_of(Surface which) {
  switch (which) {
    case Surface::from:
      return "fill:#4a90d9;fill-opacity:.45;stroke:#1f4e86";
    case Surface::to:
      return "fill:#f0a030;fill-opacity:.45;stroke:#94580a";
    case Surface::other:
      break;
  }
  return "fill:#bbbbbb;fill-opacity:.25;stroke:#777777";
}

constexpr const char* trace_of(Surface which) {
  switch (which) {
    case Surface::from:
      return "fill:none;stroke:#1f5fae;stroke-width:4";
    case Surface::to:
      return "fill:none;stroke:#d98200;stroke-width:4";
    case Surface::other:
      break;
  }
  return "fill:none;stroke:#888888;stroke-width:3";
}

/// Two unit vectors that span the plane across `axis`.
std::pair<Vec3, Vec3> across(const Vec3& axis) {
  const Vec3 n = axis.normalized();
  const Vec3 start = std::abs(n.z()) < 0.9 ? Vec3(0, 0, 1) : Vec3(1, 0, 0);
  const Vec3 a = n.cross(start).normalized();
  return {a, n.cross(a)};
}

std::string number(double value) {
  char text[32];
  const double tenths = std::round(10 * value) / 10;
  return {text, std::to_chars(text, text + sizeof text, tenths == 0 ? 0.0 : tenths, std::chars_format::fixed, 1).ptr};
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else {
      result += c;
    }
  }
  return result;
}

}  // namespace

Drawing::Drawing(View view) : view_(view) {}

Vec2 Drawing::project(const Vec3& p) const {
  if (view_ == View::section) return {p.x(), -p.z()};
  const double right = std::cos(kAzimuth) * p.x() + std::sin(kAzimuth) * p.y();
  const double into = -std::sin(kAzimuth) * p.x() + std::cos(kAzimuth) * p.y();
  return {right, -(std::cos(kElevation) * p.z() + std::sin(kElevation) * into)};
}

Vec3 Drawing::towards_viewer() const {
  return {std::sin(kAzimuth) * std::cos(kElevation), -std::cos(kAzimuth) * std::cos(kElevation), std::sin(kElevation)};
}

std::vector<Vec2> Drawing::projected(const std::vector<Vec3>& points) const {
  std::vector<Vec2> result;
  for (const Vec3& p : points) result.push_back(project(p));
  return result;
}

std::vector<Vec3> Drawing::circle(const Vec3& centre, const Vec3& axis, double radius) const {
  const auto [a, b] = across(axis);
  std::vector<Vec3> points;
  for (int k = 0; k < kCorners; ++k) {
    const double t = 2 * std::numbers::pi * k / kCorners;
    points.push_back(centre + radius * (std::cos(t) * a + std::sin(t) * b));
  }
  return points;
}

void Drawing::fill(Surface which, std::vector<std::vector<Vec2>> outlines) {
  shapes_.push_back({std::move(outlines), true, std::string(fill_of(which)) + ";stroke-width:1.4", false});
}

void Drawing::stroke(const std::vector<Vec3>& points, std::string_view style, bool closed, bool arrows) {
  shapes_.push_back({{projected(points)}, closed, std::string(style), arrows});
}

void Drawing::polygon(Surface which, const std::vector<Vec3>& corners) {
  fill(which, {projected(corners)});
}

void Drawing::rectangle(Surface which, const Vec3& corner, const Vec3& a, const Vec3& b) {
  polygon(which, {corner, corner + a, corner + a + b, corner + b});
}

void Drawing::disc(Surface which, const Vec3& centre, const Vec3& axis, double radius, double hole) {
  std::vector<std::vector<Vec2>> outlines{projected(circle(centre, axis, radius))};
  if (hole > 0) outlines.push_back(projected(circle(centre, axis, hole)));
  fill(which, std::move(outlines));
}

void Drawing::frustum(Surface which, const Vec3& base, double base_radius, const Vec3& top, double top_radius) {
  const Vec3 axis = top - base;
  const auto [a, b] = across(axis);
  const Vec3 eye = towards_viewer();
  // The outline is where the normal, cos φ a + sin φ b + slope · axis, is across the line of sight.
  const double slope = (base_radius - top_radius) / axis.norm();
  const double x = a.dot(eye), y = b.dot(eye), z = slope * axis.normalized().dot(eye);
  const double middle = std::atan2(y, x), ratio = std::clamp(-z / std::hypot(x, y), -1.0, 1.0);
  const double half = std::acos(ratio);
  // The side that faces us, as a patch between the two outlines, and both circles.
  std::vector<Vec3> patch;
  constexpr int kSteps = kCorners / 2;
  for (int k = 0; k <= kSteps; ++k) {
    const double t = middle - half + 2 * half * k / kSteps;
    patch.push_back(base + base_radius * (std::cos(t) * a + std::sin(t) * b));
  }
  for (int k = kSteps; k >= 0; --k) {
    const double t = middle - half + 2 * half * k / kSteps;
    patch.push_back(top + top_radius * (std::cos(t) * a + std::sin(t) * b));
  }
  constexpr const char* kHidden = "fill:none;stroke:#555555;stroke-width:.8";
  if (base_radius > 0) stroke(circle(base, axis, base_radius), kHidden, true);
  if (top_radius > 0) stroke(circle(top, axis, top_radius), kHidden, true);
  polygon(which, patch);
}

void Drawing::ball(Surface which, const Vec3& centre, double radius) {
  fill(which, {projected(circle(centre, view_ == View::section ? Vec3(0, 1, 0) : towards_viewer(), radius))});
  if (view_ == View::solid) {
    stroke(circle(centre, {0, 0, 1}, radius), "fill:none;stroke:#555555;stroke-width:.6;stroke-dasharray:3 3", true);
  }
}

void Drawing::zone(Surface which, const Vec3& centre, double radius, double low, double high) {
  const Vec3 right(std::cos(kAzimuth), std::sin(kAzimuth), 0), front(std::sin(kAzimuth), -std::cos(kAzimuth), 0);
  // At the height z the sphere's normal is across the line of sight where the circle has turned by −t and π + t,
  // sin t = z tan(elevation)/r; beyond ±radius cos(elevation) all of the circle faces us, or none.
  const double seen = radius * std::cos(kElevation), from = std::max(low, -seen), to = std::min(high, seen);
  const auto at = [&](double z, double t) {
    const double r = std::sqrt(std::max(0.0, radius * radius - z * z));
    return Vec3(centre + Vec3(0, 0, z) + r * (std::cos(t) * right + std::sin(t) * front));
  };
  const auto turn = [&](double z) {
    return -std::asin(std::clamp(z * std::tan(kElevation) / std::sqrt(radius * radius - z * z), -1.0, 1.0));
  };
  constexpr int kSteps = kCorners / 2;
  // closer towards both ends, where the outline turns
  const auto level = [&](int k) { return from + (to - from) * (1 - std::cos(std::numbers::pi * k / kSteps)) / 2; };
  std::vector<Vec3> outline;
  for (int k = 0; k <= kSteps; ++k) outline.push_back(at(level(k), turn(level(k))));
  for (int k = 0; k <= kSteps; ++k) {
    outline.push_back(at(to, turn(to) + (std::numbers::pi - 2 * turn(to)) * k / kSteps));
  }
  for (int k = kSteps; k >= 0; --k) outline.push_back(at(level(k), std::numbers::pi - turn(level(k))));
  for (int k = kSteps; k >= 0; --k) {
    outline.push_back(at(from, turn(from) + (std::numbers::pi - 2 * turn(from)) * k / kSteps));
  }
  fill(which, {projected(outline)});
  constexpr const char* kHidden = "fill:none;stroke:#777777;stroke-width:.6;stroke-dasharray:3 3";
  for (const double z : {low, high}) {
    if (std::abs(z) < radius)
      stroke(circle(centre + Vec3(0, 0, z), {0, 0, 1}, std::sqrt(radius * radius - z * z)), kHidden, true);
  }
}

void Drawing::element(const Vec3& at, const Vec3& normal) {
  constexpr double kSide = 0.1, kArrow = 0.42;
  const Vec3 n = normal.normalized();
  if (view_ == View::section) {
    const Vec3 along(n.z(), 0, -n.x());
    trace(Surface::from, {at - kSide * along, at + kSide * along});
  } else {
    const auto [a, b] = across(n);
    shapes_.push_back(
        {{projected({at - kSide * (a + b), at + kSide * (a - b), at + kSide * (a + b), at + kSide * (b - a)})},
         true,
         "fill:#1f5fae;stroke:#123a6b;stroke-width:1",
         false});
  }
  stroke({at, at + kArrow * n}, "fill:none;stroke:#1f5fae;stroke-width:1.6;marker-end:url(#tip)", false);
  label(at + kArrow * n, "n");
  texts_.push_back({project(at), {-18, 14}, "dA\u2081"});
}

void Drawing::trace(Surface which, const std::vector<Vec3>& points) {
  stroke(points, trace_of(which), false);
}

void Drawing::circle_trace(Surface which, const Vec3& centre, double radius, double from_deg, double to_deg) {
  std::vector<Vec3> points;
  for (int k = 0; k <= kCorners; ++k) {
    const double t = (from_deg + (to_deg - from_deg) * k / kCorners) * std::numbers::pi / 180;
    points.push_back(centre + radius * Vec3(std::cos(t), 0, std::sin(t)));
  }
  stroke(points, trace_of(which), false);
}

void Drawing::ring(const Vec3& centre, double radius, const Vec3& width) {
  const double outward = width.x();  // x: how much the radius grows; z: the height
  std::vector<std::vector<Vec2>> outlines{
      projected(circle(centre, {0, 0, 1}, radius)),
      projected(circle(centre + Vec3(0, 0, width.z()), {0, 0, 1}, radius + outward))};
  shapes_.push_back({std::move(outlines), true, "fill:#1f5fae;stroke:#123a6b;stroke-width:1", false});
}

void Drawing::line(const Vec3& a, const Vec3& b, Stroke kind) {
  const char* style = kind == Stroke::edge   ? "fill:none;stroke:#333333;stroke-width:1.4"
                      : kind == Stroke::thin ? "fill:none;stroke:#777777;stroke-width:.8"
                                             : "fill:none;stroke:#777777;stroke-width:.9;stroke-dasharray:5 4";
  stroke({a, b}, style, false);
}

void Drawing::dimension(const Vec3& a, const Vec3& b, std::string_view text) {
  stroke({a, b}, "fill:none;stroke:#aa2222;stroke-width:1", false, true);
  const Vec2 p = project(a), q = project(b);
  const double dx = q.x() - p.x(), dy = q.y() - p.y(), length = std::max(std::hypot(dx, dy), kLeastLength);
  // Beside the line: to the right of a steep one, above a flat one.
  Vec2 aside{-dy / length * kAside, dx / length * kAside};
  if (std::abs(dx) < 0.5 * std::abs(dy) ? aside.x() < 0 : aside.y() > 0) aside = {-aside.x(), -aside.y()};
  texts_.push_back({{(p.x() + q.x()) / 2, (p.y() + q.y()) / 2}, aside, std::string(text)});
}

void Drawing::height(const Vec3& foot, const Vec3& head, double aside, std::string_view text) {
  const Vec3 sideways = view_ == View::section ? Vec3(1, 0, 0) : Vec3(std::cos(kAzimuth), std::sin(kAzimuth), 0);
  dimension(foot + aside * sideways, head + aside * sideways, text);
}

void Drawing::angle(const Vec3& at, const Vec3& from, const Vec3& to, double radius, std::string_view text) {
  const Vec3 a = from.normalized(), b = (to - to.dot(a) * a).normalized();
  const double whole = std::atan2(to.dot(b), to.dot(a));
  std::vector<Vec3> points;
  constexpr int kSteps = 24;
  for (int k = 0; k <= kSteps; ++k) {
    const double t = whole * k / kSteps;
    points.push_back(at + radius * (std::cos(t) * a + std::sin(t) * b));
  }
  stroke(points, "fill:none;stroke:#aa2222;stroke-width:1", false);
  const Vec3 middle = at + radius * (std::cos(whole / 2) * a + std::sin(whole / 2) * b);
  const Vec2 p = project(at), q = project(middle);
  const double length = std::max(std::hypot(q.x() - p.x(), q.y() - p.y()), kLeastLength);
  texts_.push_back({q, {(q.x() - p.x()) / length * kAside, (q.y() - p.y()) / length * kAside}, std::string(text)});
}

void Drawing::label(const Vec3& at, std::string_view text) {
  texts_.push_back({project(at), {12, -8}, std::string(text)});
}

std::string Drawing::svg(std::string_view title) const {
  double left = 1e300, right = -1e300, top = 1e300, bottom = -1e300;
  for (const Shape& shape : shapes_) {
    for (const auto& outline : shape.outlines) {
      for (const Vec2& p : outline) {
        left = std::min(left, p.x());
        right = std::max(right, p.x());
        top = std::min(top, p.y());
        bottom = std::max(bottom, p.y());
      }
    }
  }
  const double scale = std::min((kWidth - 2 * kMargin) / std::max(right - left, kLeastLength),
                                (kHeight - 2 * kMargin) / std::max(bottom - top, kLeastLength));
  const auto place = [&](const Vec2& p) {
    return Vec2{kWidth / 2 + scale * (p.x() - (left + right) / 2), kHeight / 2 + scale * (p.y() - (top + bottom) / 2)};
  };
  std::string out =
      "<!-- SPDX-License-Identifier: Apache-2.0 -->\n<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 420 320\" "
      "width=\"420\" height=\"320\" role=\"img\">\n<title>" +
      escaped(title) +
      "</title>\n<defs><marker id=\"tip\" viewBox=\"0 0 8 8\" refX=\"7\" refY=\"4\" markerWidth=\"7\" "
      "markerHeight=\"7\" orient=\"auto-start-reverse\"><path d=\"M0 0L8 4L0 8z\" fill=\"#1f5fae\"/></marker>"
      "<marker id=\"end\" viewBox=\"0 0 8 8\" refX=\"8\" refY=\"4\" markerWidth=\"8\" markerHeight=\"8\" "
      "orient=\"auto-start-reverse\"><path d=\"M0 1L8 4L0 7z\" fill=\"#aa2222\"/></marker></defs>\n"
      "<rect width=\"420\" height=\"320\" fill=\"white\"/>\n";
  for (const Shape& shape : shapes_) {
    out += "<path d=\"";
    for (const auto& outline : shape.outlines) {
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vec2 p = place(outline[i]);
        out += (i == 0 ? "M" : "L") + number(p.x()) + " " + number(p.y());
      }
      if (shape.closed) out += "Z";
    }
    out += "\" style=\"stroke-linejoin:round;fill-rule:evenodd;" + shape.style + "\"";
    if (shape.arrows) out += " marker-start=\"url(#end)\" marker-end=\"url(#end)\"";
    out += "/>\n";
  }
  for (const Text& text : texts_) {
    const Vec2 p = place(text.at);
    out += "<text x=\"" + number(p.x() + text.aside.x()) + "\" y=\"" + number(p.y() + text.aside.y() + 5) +
           "\" style=\"font:italic 15px "
           "Georgia,serif;text-anchor:middle;paint-order:stroke;stroke:white;stroke-width:4\">" +
           escaped(text.text) + "</text>\n";
  }
  return out + "</svg>\n";
}

}  // namespace etendue::catalogue
