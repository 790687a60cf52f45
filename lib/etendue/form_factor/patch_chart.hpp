// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "etendue/form_factor/flat_part.hpp"
#include "etendue/form_factor/view_body.hpp"
#include "etendue/geometry/plane.hpp"

namespace etendue {

/// A point of a patch, its normal, and the area that a unit of the chart's square has there.
struct PatchSpot {
  Vec3 point;
  Vec3 normal;
  double area;
};

/// The plane of a flat patch: a point and the normal.
[[nodiscard]] std::optional<Plane> plane_of(const CurvedPatch& patch);

/// Where a blocker stands on a flat patch, nothing is seen from there: a convex loop, or, where that is empty, a circle.
struct Footprint {
  std::vector<Vec3> loop;
  Vec3 centre = Vec3::Zero();
  double radius = 0;
};
/// That of `blocker` on `patch`; added to `footprints` where there is one.
void add_footprint(const CurvedPatch& patch, const CurvedBlocker& blocker, std::vector<Footprint>& footprints);

/// Across which lines what is seen from a flat patch may change at one stroke: it is cut there.
struct PatchCuts {
  std::vector<Footprint> footprints;
  std::vector<Plane> fronts;    ///< what lies behind sees nothing
  std::vector<Plane> partings;  ///< of plates that stand on it
};
/// Those of a patch towards another past blockers.
[[nodiscard]] PatchCuts cuts_of(const CurvedPatch& patch, const CurvedPatch& to,
                                std::span<const CurvedBlocker* const> blockers);

/// A smooth map of the unit square onto a part of a patch.
class PatchChart {
 public:
  [[nodiscard]] PatchSpot at(double s, double t) const;

  /// Charts that cover `patch`, turned towards the ball of radius `size` around `towards`: of a sphere or a cylinder only
  /// what can see some of that ball; of a flat patch not what `cuts` leave out.
  static std::vector<PatchChart> covering(const CurvedPatch& patch, const Vec3& towards, double size,
                                          const PatchCuts& cuts = {});

 private:
  enum class Kind { bilinear, fan, wedge, sphere, wall };
  explicit PatchChart(Kind kind) : kind_(kind) {}
  static void add(std::span<const Vec3> corners, const Vec3& normal, std::vector<PatchChart>& charts);
  static std::vector<PatchChart> of_flat(const CurvedPatch& patch, const PatchCuts& cuts);
  static std::vector<PatchChart> of(const Sphere& sphere, const Vec3& towards, double size);
  static std::vector<PatchChart> of(const Cylinder& cylinder, const Vec3& towards, double size);

  Kind kind_;
  Vec3 a_ = Vec3::Zero(), b_ = Vec3::Zero(), c_ = Vec3::Zero(), d_ = Vec3::Zero();  ///< corners; centre, frame
  Vec3 normal_ = Vec3::UnitZ();
  double radius_ = 0;
  Wedge wedge_{};
  double turn_ = 0, turns_ = 0;  ///< first angle around the axis, and how much of it the chart spans
  double tilt_ = 0, tilts_ = 0;  ///< the same from the pole of a sphere
};

/// Middle and radius of a ball around a patch.
struct PatchBall {
  Vec3 middle;
  double size;
};
[[nodiscard]] PatchBall ball_around(const CurvedPatch& patch);

/// Area of the side that radiates [length²].
[[nodiscard]] double area_of(const CurvedPatch& patch);

}  // namespace etendue
