// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/certified_outline.hpp"

namespace etendue {

/// A flat convex part of the receiver, by its corners as they are, rounded or not.
using ReceiverPiece = std::vector<Vec3>;

/// A convex blocker as shadow hulls want it.
struct HullBlocker {
  std::vector<Vec3> corners;  ///< as given
  std::vector<Vec3> inward;  ///< the same, drawn in by kDrawnIn: inner shadows are proposed for it, shown for the given
  std::vector<Vec3> front;   ///< what of it lies in front of both surfaces, rounded: outer shadows are proposed for it
  std::vector<Vec3> kept;    ///< front drawn in: outer shadows are shown for it
  double lost = 0;  ///< bounds the area between the part in front and `kept`: as much flux, at most, is not told
  Vec3 normal = Vec3::Zero();
  double bent = 0;  ///< bounds how far a corner is from the plane through the first one across `normal`, times |normal|
};

/// Edges of blockers are drawn in by this share of the reach, so that what touches is apart by more than rounding.
inline constexpr double kDrawnIn = 0x1p-40;

/// Of a height n · (p − a): 2u of each difference, 3u of the sum, 8u of where a corner of the cell is, times twice the reach.
inline constexpr double kHeightRounding = 32 * kUnitRoundoff;

/// Empty where no part is in front of both. Drawn in by `distance`, 0 or kDrawnIn of the reach.
[[nodiscard]] HullBlocker hull_blocker(const std::vector<Vec3>& corners, const ExactPlane& from, const ExactPlane& to,
                                       double distance);

/// The shadows of blockers from a whole triangle of the source: what is proposed in doubles is shown in bounded ones
/// before it counts, so no mistake of a proposal can make an enclosure wrong, only wide.
class ShadowHulls {
 public:
  /// `reach` bounds the absolute value of every coordinate; the triangle's corners are known within 2^-50 of it.
  ShadowHulls(const std::array<Vec3, 3>& cell, const std::vector<HullBlocker>& blockers, double reach);

  /// Of `receiver` what may be hidden by some blocker from some point of the cell: pieces that do not overlap. The rest
  /// is shown to be seen from all of it.
  [[nodiscard]] std::vector<ReceiverPiece> outer(const ReceiverPiece& receiver);
  /// Of `receiver` what is shown to be hidden by one blocker from all of the cell: pieces that do not overlap.
  [[nodiscard]] std::vector<ReceiverPiece> inner(const ReceiverPiece& receiver);

  /// Bounds the area by which cuts, rounded, fail to share out a receiver; since the start.
  double slivers() const { return slivers_; }

 private:
  struct Plane {
    Vec3 normal, anchor;
    double level = 0;  ///< where to cut
  };
  double height(const Plane& plane, const Vec3& point) const { return plane.normal.dot(point - plane.anchor); }
  double pad(const Vec3& normal) const;
  std::vector<Plane> proposed(const HullBlocker& blocker) const;
  std::vector<Plane> separating(const HullBlocker& blocker) const;
  std::vector<Plane> inside(const HullBlocker& blocker) const;
  bool hidden(const HullBlocker& blocker, const ReceiverPiece& piece) const;
  struct Parts {
    ReceiverPiece above, below;
  };
  Parts cut(const ReceiverPiece& piece, const Plane& plane);

  const std::array<Vec3, 3>& cell_;
  const std::vector<HullBlocker>& blockers_;
  double reach_, slivers_ = 0;
};

}  // namespace etendue
