// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/shadow_hull.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

/// A cut's corner p + t (q − p) is off its edge by at most 4u of the reach in each coordinate.
constexpr double kCutRounding = 8 * kUnitRoundoff;
/// Beyond so many pieces the rest stays as it is: the enclosure is wider then.
constexpr std::size_t kMostPieces = 64;

double one_norm(const Vec3& v) {
  return v.cwiseAbs().sum();
}

/// Towards the middle, so that every edge moves by about `distance`, but by a sixteenth of the way at most.
std::vector<Vec3> drawn_in(const std::vector<Vec3>& corners, double distance) {
  if (distance == 0) return corners;
  Vec3 middle = Vec3::Zero(), area = Vec3::Zero();
  for (const Vec3& v : corners) middle += v / static_cast<double>(corners.size());
  double longest = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    area += (corners[i] - middle).cross(corners[(i + 1) % corners.size()] - middle);
    longest = std::max(longest, (corners[i] - middle).norm());
  }
  const double narrow = 0.25 * area.norm() / longest;
  constexpr double kMostShare = 0x1p-4;
  const double share = narrow > 0 ? std::min(kMostShare, distance / narrow) : kMostShare;
  std::vector<Vec3> result;
  for (const Vec3& v : corners) result.push_back(v + share * (middle - v));
  return result;
}

/// What of the outline is in front of a plane: exact signs, enclosed cuts. A corner that an earlier cut made and whose side
/// is in doubt is kept, which only adds to the blocker.
EnclosedOutline in_front(const EnclosedOutline& outline, const ExactPlane& plane) {
  std::vector<Interval> heights;
  bool doubt = false;
  for (const Interval3& v : outline) {
    const bool point = v.x.width() == 0 && v.y.width() == 0 && v.z.width() == 0;
    Interval h = point ? plane.height(v.middle()) : plane.height(v);
    doubt = doubt || (h.contains(0.0) && h.upper > 0);
    heights.push_back(h.contains(0.0) ? Interval() : h);
  }
  EnclosedOutline kept = clipped(outline, heights);
  return kept.empty() && doubt ? outline : kept;
}

}  // namespace

HullBlocker hull_blocker(const std::vector<Vec3>& corners, const ExactPlane& from, const ExactPlane& to,
                         double distance) {
  HullBlocker result;
  EnclosedOutline front = in_front(EnclosedOutline(corners.begin(), corners.end()), from);
  if (!front.empty()) front = in_front(front, to);
  if (front.empty()) return result;
  result.corners = corners;
  result.inward = drawn_in(corners, distance);
  for (const Interval3& v : front) result.front.push_back(v.middle());
  result.kept = drawn_in(result.front, distance);
  // The ribbon between the part in front and what is kept: two triangles for each edge.
  Interval ribbon;
  for (std::size_t i = 0; i < front.size(); ++i) {
    const std::size_t next = (i + 1) % front.size();
    const Interval3 edge = front[next] - front[i], image = Interval3(result.kept[next]) - front[i];
    ribbon = ribbon + norm(cross(edge, image)) + norm(cross(image, Interval3(result.kept[i]) - front[i]));
  }
  result.lost = (Interval(0.5) * ribbon).upper;
  const std::size_t n = corners.size();
  for (std::size_t i = 1; i + 1 < n; ++i) {
    result.normal += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
  }
  for (const Vec3& v : corners) {
    result.bent =
        std::max(result.bent, dot(Interval3(result.normal), Interval3(v) - Interval3(corners[0])).magnitude());
  }
  return result;
}

ShadowHulls::ShadowHulls(const std::array<Vec3, 3>& cell, const std::vector<HullBlocker>& blockers, double reach)
    : cell_(cell), blockers_(blockers), reach_(reach) {}

double ShadowHulls::pad(const Vec3& normal) const {
  return kHeightRounding * reach_ * one_norm(normal);
}

/// Planes that touch both, the cell above and the blocker below, up to rounding: what a hull is made of.
std::vector<ShadowHulls::Plane> ShadowHulls::proposed(const HullBlocker& blocker) const {
  std::vector<Plane> planes;
  const auto offer = [&](Vec3 normal, const Vec3& through, double bent) {
    const double length = normal.norm();
    if (!(length > 0)) return;
    normal /= length;
    const double slack = 2 * pad(normal) + bent / length;
    double lowest = normal.dot(cell_[0] - through), highest = lowest;
    for (const Vec3& p : cell_) {
      lowest = std::min(lowest, normal.dot(p - through));
      highest = std::max(highest, normal.dot(p - through));
    }
    if (highest <= slack) {  // the other way round
      normal = -normal;
      std::swap(lowest, highest);
      lowest = -lowest;
    }
    if (!(lowest >= -slack)) return;
    for (const Vec3& p : blocker.front) {
      if (!(normal.dot(p - through) <= slack)) return;
    }
    planes.push_back({normal, through, 0});
  };
  const auto& b = blocker.front;
  for (std::size_t i = 0; i < b.size(); ++i) {
    for (const Vec3& x : cell_) offer((b[(i + 1) % b.size()] - b[i]).cross(x - b[i]), b[i], 0);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    for (const Vec3& p : b) offer((cell_[(k + 1) % 3] - cell_[k]).cross(p - cell_[k]), cell_[k], 0);
  }
  offer(blocker.normal, b[0], blocker.bent);
  return planes;
}

/// Planes with the cell certainly on or above and `kept` certainly on or below: a line from the cell through the blocker
/// is below from there on. What rounding needs is won by a turn towards the mean of all proposals, which touches neither
/// where the two are apart; else by a shift either way.
std::vector<ShadowHulls::Plane> ShadowHulls::separating(const HullBlocker& blocker) const {
  const std::vector<Plane> proposals = proposed(blocker);
  if (proposals.empty()) return {};
  const auto mean = [&](const Vec3& p) {
    double sum = 0;
    for (const Plane& plane : proposals) sum += height(plane, p);
    return sum / static_cast<double>(proposals.size());
  };
  Vec3 mean_normal = Vec3::Zero();
  for (const Plane& plane : proposals) mean_normal += plane.normal / static_cast<double>(proposals.size());
  double apart = std::numeric_limits<double>::infinity();
  for (const Vec3& p : cell_) apart = std::min(apart, mean(p));
  for (const Vec3& p : blocker.kept) apart = std::min(apart, -mean(p));
  const auto shown = [&](const Plane& plane) {
    const double slack = pad(plane.normal);
    return std::all_of(cell_.begin(), cell_.end(), [&](const Vec3& p) { return height(plane, p) >= slack; }) &&
           std::all_of(blocker.kept.begin(), blocker.kept.end(),
                       [&](const Vec3& p) { return height(plane, p) <= -slack; });
  };
  std::vector<Plane> planes;
  for (const Plane& proposal : proposals) {
    const double slack = pad(proposal.normal);
    constexpr double kMostTurn = 0.25;
    const double turn = apart > 0 ? 8 * slack / apart : 1;
    std::array<Plane, 3> ways{proposal, proposal, proposal};
    if (turn <= kMostTurn) {
      const Vec3 normal = proposal.normal + turn * mean_normal;
      ways[0] = {normal, proposal.anchor - (turn * mean(proposal.anchor) / normal.squaredNorm()) * normal, 0};
    }
    ways[1].anchor -= 2 * slack * proposal.normal;
    ways[2].anchor += 2 * slack * proposal.normal;
    for (Plane& plane : ways) {
      if (!shown(plane)) continue;
      plane.level = 4 * pad(plane.normal);
      planes.push_back(plane);
      break;
    }
  }
  return planes;
}

ShadowHulls::Parts ShadowHulls::cut(const ReceiverPiece& piece, const Plane& plane) {
  Parts parts;
  const std::size_t n = piece.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 &p = piece[i], &q = piece[(i + 1) % n];
    const double here = height(plane, p) - plane.level, there = height(plane, q) - plane.level;
    (here > 0 ? parts.above : parts.below).push_back(p);
    if ((here > 0) == (there > 0)) continue;
    const double share = std::clamp(here / (here - there), 0.0, 1.0);
    const Vec3 point = p + share * (q - p);
    parts.above.push_back(point);
    parts.below.push_back(point);
    slivers_ = above(slivers_ + above(kCutRounding * reach_ * above(one_norm(q - p))));
  }
  return parts;
}

std::vector<ReceiverPiece> ShadowHulls::outer(const ReceiverPiece& receiver) {
  std::vector<ReceiverPiece> lit{receiver}, shaded;
  for (const HullBlocker& blocker : blockers_) {
    const std::vector<Plane> planes = separating(blocker);
    std::vector<ReceiverPiece> still;
    for (ReceiverPiece& piece : lit) {
      // Above any one plane all is seen past this blocker.
      const auto above_of = [&](const Plane& plane) {
        return std::all_of(piece.begin(), piece.end(),
                           [&](const Vec3& p) { return height(plane, p) >= pad(plane.normal); });
      };
      if (std::any_of(planes.begin(), planes.end(), above_of)) {
        still.push_back(std::move(piece));
        continue;
      }
      for (const Plane& plane : planes) {
        if (still.size() >= kMostPieces) break;
        Parts parts = cut(piece, plane);
        if (parts.above.size() < 3 || parts.below.size() < 3) continue;
        const bool shown = std::all_of(parts.above.begin(), parts.above.end(),
                                       [&](const Vec3& p) { return height(plane, p) >= pad(plane.normal); });
        if (!shown) continue;
        still.push_back(std::move(parts.above));
        piece = std::move(parts.below);
      }
      shaded.push_back(std::move(piece));
    }
    lit = std::move(still);
  }
  return shaded;
}

/// Half-spaces, positive inside, of what a blocker hides from all three corners: proposals.
std::vector<ShadowHulls::Plane> ShadowHulls::inside(const HullBlocker& blocker) const {
  Vec3 normal = blocker.normal;
  const Vec3& first = blocker.corners[0];
  const double thick = blocker.bent + pad(normal);
  if (normal.dot(cell_[0] - first) > 0) normal = -normal;
  for (const Vec3& x : cell_) {
    if (!(normal.dot(x - first) <= -thick)) return {};
  }
  std::vector<Plane> planes{{normal, first, 2 * thick}};
  const auto& b = blocker.inward;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const Vec3 edge = b[(i + 1) % b.size()] - b[i];
    for (const Vec3& x : cell_) {
      Vec3 plane = edge.cross(x - b[i]);
      if (plane.dot(b[(i + 2) % b.size()] - b[i]) < 0) plane = -plane;
      planes.push_back({plane, b[i], 0});
    }
  }
  return planes;
}

/// Do all lines from the cell's corners to the piece's cross the blocker? Then all lines from the cell to the piece do:
/// what is hidden from a point is convex, and so is what a point is hidden from. Each line has the blocker's first
/// corner's plane between its ends, and turns the same way around every edge.
bool ShadowHulls::hidden(const HullBlocker& blocker, const ReceiverPiece& piece) const {
  const auto& b = blocker.corners;
  const double thick = blocker.bent + pad(blocker.normal);
  const double side = blocker.normal.dot(cell_[0] - b[0]) > 0 ? 1 : -1;
  for (const Vec3& y : piece) {
    if (!(side * blocker.normal.dot(y - b[0]) <= -thick)) return false;
  }
  const double off = 16 * kUnitRoundoff * reach_;  // of a difference of two corners
  for (const Vec3& x : cell_) {
    for (std::size_t i = 0; i < b.size(); ++i) {
      const Vec3 p = b[i] - x, q = b[(i + 1) % b.size()] - x;
      const Vec3 normal = p.cross(q);
      const double lp = one_norm(p) + off, lq = one_norm(q) + off;
      for (const Vec3& y : piece) {
        const Vec3 way = y - x;
        const double lw = one_norm(way) + off;
        const double error = off * (lp * lq + lq * lw + lw * lp) + 16 * kUnitRoundoff * lp * lq * lw;
        if (!(-side * normal.dot(way) > error)) return false;
      }
    }
  }
  return true;
}

std::vector<ReceiverPiece> ShadowHulls::inner(const ReceiverPiece& receiver) {
  std::vector<ReceiverPiece> open{receiver}, dark;
  for (const HullBlocker& blocker : blockers_) {
    const std::vector<Plane> planes = inside(blocker);
    if (planes.empty()) continue;
    std::vector<ReceiverPiece> still;
    for (const ReceiverPiece& piece : open) {
      ReceiverPiece within = piece;
      std::vector<ReceiverPiece> beside;
      for (const Plane& plane : planes) {
        Parts parts = cut(within, plane);
        if (parts.below.size() >= 3) beside.push_back(std::move(parts.below));
        within = std::move(parts.above);
        if (within.size() < 3) break;
      }
      const bool shown = within.size() >= 3 && hidden(blocker, within);
      if (!shown) {
        still.push_back(piece);
        continue;
      }
      dark.push_back(std::move(within));
      for (ReceiverPiece& part : beside) {
        if (still.size() < kMostPieces) still.push_back(std::move(part));
      }
    }
    open = std::move(still);
  }
  return dark;
}

}  // namespace etendue
