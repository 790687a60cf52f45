// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "etendue/geometry/vector.hpp"

namespace etendue::catalogue {

/// How a picture looks at its configuration.
enum class View {
  solid,    ///< parallel projection from the front, the right and above: x to the right, y into the picture, z up
  section,  ///< the plane y = 0, seen along y: for what is infinitely long in y
};

/// Which of the configuration's two surfaces is drawn; `other` is drawn grey.
enum class Surface { from, to, other };

enum class Stroke { edge, thin, dashed };

/// A line drawing with labelled dimensions, made of a few kinds of shapes in space; svg() fits it into a page.
class Drawing {
 public:
  explicit Drawing(View view = View::solid);

  void polygon(Surface which, const std::vector<Vec3>& corners);
  void rectangle(Surface which, const Vec3& corner, const Vec3& a, const Vec3& b);
  void disc(Surface which, const Vec3& centre, const Vec3& axis, double radius, double hole = 0);
  /// The lateral surface between two coaxial circles: cylinder, cone (a radius of zero) or frustum.
  void frustum(Surface which, const Vec3& base, double base_radius, const Vec3& top, double top_radius);
  void ball(Surface which, const Vec3& centre, double radius);
  /// Part of a sphere around the axis z, between two heights above its centre.
  void zone(Surface which, const Vec3& centre, double radius, double low, double high);
  /// A small square with its normal and the label dA₁.
  void element(const Vec3& at, const Vec3& normal);
  /// In a section: the thick trace of a surface.
  void trace(Surface which, const std::vector<Vec3>& points);
  void circle_trace(Surface which, const Vec3& centre, double radius, double from_deg = 0, double to_deg = 360);
  /// A narrow ring around the axis z.
  void ring(const Vec3& centre, double radius, const Vec3& width);

  void line(const Vec3& a, const Vec3& b, Stroke stroke = Stroke::dashed);
  /// A double arrow and its letter.
  void dimension(const Vec3& a, const Vec3& b, std::string_view text);
  /// The same, moved sideways in the picture by `aside`, beside what it measures.
  void height(const Vec3& foot, const Vec3& head, double aside, std::string_view text);
  /// An arc from one direction to another around `at`, and its letter.
  void angle(const Vec3& at, const Vec3& from, const Vec3& to, double radius, std::string_view text);
  void label(const Vec3& at, std::string_view text);

  [[nodiscard]] std::string svg(std::string_view title) const;

 private:
  struct Shape {
    std::vector<std::vector<Vec2>> outlines;  ///< several: a surface with holes
    bool closed = false;
    std::string style;
    bool arrows = false;
  };
  struct Text {
    Vec2 at;
    Vec2 aside;  ///< direction in which the text is moved away [pixels]
    std::string text;
  };

  Vec2 project(const Vec3& p) const;
  Vec3 towards_viewer() const;
  std::vector<Vec2> projected(const std::vector<Vec3>& points) const;
  std::vector<Vec3> circle(const Vec3& centre, const Vec3& axis, double radius) const;
  void fill(Surface which, std::vector<std::vector<Vec2>> outlines);
  void stroke(const std::vector<Vec3>& points, std::string_view style, bool closed, bool arrows = false);

  View view_;
  std::vector<Shape> shapes_;
  std::vector<Text> texts_;
};

}  // namespace etendue::catalogue
