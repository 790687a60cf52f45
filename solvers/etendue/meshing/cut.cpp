// SPDX-License-Identifier: Apache-2.0
#include "etendue/meshing/cut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

struct Halves {
  Polygon left, right;
};

/// A segment, and the heights of points to the left of it.
struct Knife {
  Vec3 from, along, left;
  double length, touching;

  Knife(const Segment& segment, const Vec3& normal, double slack)
      : from(segment.from), along(segment.to - segment.from), length(along.norm()), touching(slack) {
    along /= length;
    left = normal.cross(along);
  }

  /// Zero for what lies on the line, as far as the slack goes.
  double height(const Vec3& point) const {
    const double exact = left.dot(point - from);
    return std::abs(exact) <= touching ? 0 : exact;
  }
};

/// Where the line passes the side from a to b: from the lexicographically smaller end, so that both polygons at this side
/// compute the same.
Vec3 crossing(const Vec3& a, double at_a, const Vec3& b, double at_b) {
  const bool in_order = std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
  const Vec3 &first = in_order ? a : b, &second = in_order ? b : a;
  const double at_first = in_order ? at_a : at_b, at_second = in_order ? at_b : at_a;
  return first + at_first / (at_first - at_second) * (second - first);
}

/// Both sides of a convex polygon; nothing where the segment does not run through its inside.
std::optional<Halves> halves(const Polygon& polygon, const Knife& knife) {
  const auto& v = polygon.vertices();
  std::vector<double> heights;
  for (const Vec3& point : v) heights.push_back(knife.height(point));
  const auto [lowest, highest] = std::minmax_element(heights.begin(), heights.end());
  if (*lowest >= 0 || *highest <= 0) return std::nullopt;

  std::vector<Vec3> left, right;
  double low = std::numeric_limits<double>::infinity(), high = -low;  // of the chord, along the segment
  for (std::size_t k = 0; k < v.size(); ++k) {
    const std::size_t next = (k + 1) % v.size();
    const auto on_line = [&](const Vec3& point) {
      const double t = knife.along.dot(point - knife.from);
      low = std::min(low, t);
      high = std::max(high, t);
      left.push_back(point);
      right.push_back(point);
    };
    if (heights[k] == 0) on_line(v[k]);
    if (heights[k] > 0) left.push_back(v[k]);
    if (heights[k] < 0) right.push_back(v[k]);
    if ((heights[k] > 0 && heights[next] < 0) || (heights[k] < 0 && heights[next] > 0)) {
      on_line(crossing(v[k], heights[k], v[next], heights[next]));
    }
  }
  if (std::min(high, knife.length) - std::max(low, 0.0) <= knife.touching) return std::nullopt;
  auto made_left = Polygon::make(std::move(left)), made_right = Polygon::make(std::move(right));
  if (!made_left || !made_right) return std::nullopt;
  return Halves{std::move(made_left).value(), std::move(made_right).value()};
}

}  // namespace

std::vector<CutPiece> cut_along(std::span<const Polygon> polygons, const Vec3& normal,
                                std::span<const Segment> segments, double touching) {
  require(touching > 0, "cut_along: touching is a length above zero");
  std::vector<Knife> knives;
  for (const Segment& segment : segments) {
    if ((segment.to - segment.from).norm() > touching) knives.emplace_back(segment, normal, touching);
  }
  std::vector<CutPiece> result;
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    std::vector<Polygon> pieces{polygons[k]};
    for (const Knife& knife : knives) {
      std::vector<Polygon> next;
      for (Polygon& piece : pieces) {
        auto cut = halves(piece, knife);
        if (!cut) {
          next.push_back(std::move(piece));
          continue;
        }
        next.push_back(std::move(cut->left));
        next.push_back(std::move(cut->right));
      }
      pieces = std::move(next);
    }
    for (Polygon& piece : pieces) result.push_back({std::move(piece), k});
  }
  return result;
}

}  // namespace etendue
