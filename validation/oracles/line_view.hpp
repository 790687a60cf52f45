// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "oracles/round_factor.hpp"

// Bodies as parallel light shows them: outlines in a plane across the light, and where lines along it enter and leave.
namespace etendue::oracle {

struct Flat {
  double x, y;
};
inline Flat operator+(Flat a, Flat b) {
  return {a.x + b.x, a.y + b.y};
}
inline Flat operator-(Flat a, Flat b) {
  return {a.x - b.x, a.y - b.y};
}
inline Flat operator*(double s, Flat a) {
  return {s * a.x, s * a.y};
}
inline double cross(Flat a, Flat b) {
  return a.x * b.y - a.y * b.x;
}
inline double dot(Flat a, Flat b) {
  return a.x * b.x + a.y * b.y;
}

/// A direction and two axes across it.
struct LightFrame {
  Point x, y, along;
  static LightFrame of(const Point& direction);
  Point in(const Point& p) const;
};

/// c + u s for s in [0, 1], or c + u cos s + v sin s for s in [0, 2π].
struct Outline {
  bool round;
  Flat c, u, v;
  Flat middle;   ///< of a circle around it
  double reach;  ///< its radius

  static Outline segment(Flat from, Flat to);
  static Outline ellipse(Flat centre, Flat u, Flat v);
  double end() const;  ///< a cut in the middle is always made: silhouettes of cylinders touch there
  Flat at(double s) const;
  Flat along(double s) const;
  /// ½ ∫ p × dp
  double swept(double from, double to) const;
  /// Where this crosses the other, as parameters of this.
  void cross(const Outline& other, std::vector<double>& cuts) const;
};

/// Where a line enters and leaves a body, and whether through what radiates.
struct Crossing {
  double in, out;
  bool enters_patch, leaves_patch;
  double middle() const { return 0.5 * (in + out); }
};

/// A body in the frame of the light.
class LitBody {
 public:
  LitBody(const RoundBody& body, const LightFrame& frame);
  const std::vector<Outline>& outlines() const { return outlines_; }
  Flat middle() const { return middle_; }
  double reach() const { return reach_; }
  std::optional<Crossing> crossing(Flat line) const;

 private:
  std::optional<Crossing> through_polygon(Flat line) const;
  std::optional<Crossing> through_cylinder(Flat line) const;
  std::optional<Crossing> through_box(Flat line) const;

  RoundBody body_;  ///< in the frame: z along the light
  std::vector<Outline> outlines_;
  Flat middle_{};
  double reach_ = 0;
  Point normal_{};  ///< of what is flat
};

}  // namespace etendue::oracle
