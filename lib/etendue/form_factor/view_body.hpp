// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "etendue/form_factor/blocker.hpp"
#include "etendue/form_factor/view_curve.hpp"
#include "etendue/geometry/cylinder.hpp"
#include "etendue/geometry/disc.hpp"
#include "etendue/geometry/polygon.hpp"
#include "etendue/geometry/sphere.hpp"

namespace etendue {

/// A surface that radiates from one side: a convex polygon or a disc from its front, a sphere from outside, a cylinder
/// from the outside of its wall.
using CurvedPatch = std::variant<Polygon, Sphere, Disc, Cylinder>;

/// What stands in the way of light. A cylinder counts as filled: its ends stop light.
using CurvedBlocker = std::variant<Blocker, Sphere, Disc, Cylinder>;

/// A convex thing, or a cylinder's wall, as seen from an eye at the origin.
class ViewBody {
 public:
  static constexpr double kNothing = std::numeric_limits<double>::infinity();

  /// What of `patch` is seen from `eye`: nothing where only its back is.
  static std::optional<ViewBody> seen(const CurvedPatch& patch, const Vec3& eye);
  /// Adds the convex parts of `blocker`. False where the eye is within it, so that nothing is seen at all.
  [[nodiscard]] static bool add(const CurvedBlocker& blocker, const Vec3& eye, std::vector<ViewBody>& bodies);

  /// Its outline, with itself to the left.
  std::span<const ViewCurve> outline() const { return outline_; }
  /// The point that `curve` of the outline shows at x lies so far away.
  double distance(const ViewCurve& curve, double x) const { return reach_ * curve.distance(x); }
  /// Distance at which a ray in the direction of the unit vector `w` meets it; kNothing where it does not.
  double depth(const Vec3& w) const;
  /// Where `curve` may enter or leave its outline.
  void cut(const ViewCurve& curve, std::vector<double>& cuts) const;
  /// False where no direction can meet both.
  bool may_overlap(const ViewBody& other) const;
  /// May it reach above, or below, the plane through the eye across the unit vector `normal`?
  bool may_be_above(const Vec3& normal) const { return middle_.dot(normal) > -size_; }
  bool dips_below(const Vec3& normal) const { return middle_.dot(normal) < size_; }

 private:
  enum class Kind { flat, solid, sphere, disc, filled, wall };
  struct Side {  ///< of a solid: normal · p ≤ offset inside
    Vec3 normal;
    double offset;
  };

  explicit ViewBody(Kind kind) : kind_(kind) {}
  static std::optional<ViewBody> flat(std::vector<Vec3> corners, Vec3 normal);
  static std::optional<ViewBody> solid(const Blocker& blocker, const Vec3& eye);
  static ViewBody sphere(const Vec3& centre, double radius);
  static std::optional<ViewBody> disc(const Vec3& centre, const Vec3& normal, double radius);
  static std::optional<ViewBody> cylinder(Kind kind, const Cylinder& cylinder, const Vec3& eye);
  void stand(const Cylinder& cylinder, const Vec3& eye);
  void add_cone(const Vec3& centre, const Vec3& normal, double radius);
  void surround(std::span<const Vec3> points);
  bool within_wall() const { return lateral_ <= radius_; }
  double cylinder_depth(const Vec3& w) const;

  Kind kind_;
  std::vector<ViewCurve> outline_;
  std::vector<Vec3> planes_;  ///< inward, through the eye
  std::vector<Mat3> cones_;
  std::vector<Side> sides_;
  Vec3 middle_ = Vec3::Zero();  ///< of a ball around it
  double size_ = 0;             ///< radius of that ball
  double reach_ = 1;
  Vec3 centre_ = Vec3::Zero();  ///< of a sphere or disc; of a cylinder's base
  Vec3 axis_ = Vec3::UnitZ();   ///< of a disc or flat: its normal; of a cylinder: from base to top
  double radius_ = 0;
  double offset_ = 0;             ///< of a flat or disc: axis · its points
  double length_ = 0;             ///< of a cylinder
  double height_ = 0;             ///< of the eye over a cylinder's base
  double lateral_ = 0;            ///< of the eye from its axis
  Vec3 outward_ = Vec3::UnitX();  ///< from the axis towards the eye
};

}  // namespace etendue
