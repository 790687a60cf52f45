// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/parallelogram.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/facing_pair.hpp"
#include "etendue/form_factor/sharp_plane.hpp"

namespace etendue {

Parallelogram parallelogram(const Polygon& polygon, std::uint32_t plane) {
  const auto& v = polygon.vertices();
  Parallelogram patch{};
  patch.corner = v[0];
  patch.normal = polygon.normal();
  patch.area = polygon.area();
  patch.plane = plane;
  if (v.size() != 4) return patch;
  const Vec3 first = 0.5 * (v[1] - v[0]), second = 0.5 * (v[3] - v[0]);
  patch.half[0] = first;
  patch.half[1] = second;
  patch.centre = first + second;
  patch.length[0] = first.norm();
  patch.length[1] = second.norm();
  patch.direction[0] = first / patch.length[0];
  patch.direction[1] = second / patch.length[1];
  patch.skew =
      std::max({std::abs(patch.direction[0].dot(patch.direction[1])), std::abs(patch.direction[0].dot(patch.normal)),
                std::abs(patch.direction[1].dot(patch.normal))});
  patch.radius = std::max((first + second).norm(), (first - second).norm());
  // What the fourth corner misses moves the outline, and the plane; differences and the normal err by a few roundings.
  constexpr double kDifferences = 8;
  const double off = (v[2] - v[1] - 2 * second).norm() + kDifferences * kUnitRoundoff * patch.radius;
  patch.flatness = off;
  patch.shape = 4 * off * (patch.length[0] + patch.length[1]) / patch.area +
                kDifferences * kUnitRoundoff * patch.length[0] * patch.length[1] / patch.area;
  constexpr double kRounded = 0x1p-40;  // more than rounding: no parallelogram
  patch.valid = off <= kRounded * std::min(patch.length[0], patch.length[1]);
  return patch;
}

namespace {

/// Brings the largest coordinate into [1, 2) without rounding.
double power_of_two_scale(const std::vector<Vec3>& vertices) {
  double size = 0;
  for (const Vec3& p : vertices) size = std::max(size, p.cwiseAbs().maxCoeff());
  return size > 0 ? std::ldexp(1.0, -std::ilogb(size)) : 1;
}

}  // namespace

std::vector<std::uint32_t> planes_of(const std::vector<Polygon>& polygons) {
  struct Group {
    SharpPlane plane;
    double scale;
    std::uint32_t number;
  };
  std::map<std::array<long, 3>, std::vector<Group>> groups;
  std::uint32_t count = 0;
  std::vector<std::uint32_t> planes;
  for (const Polygon& polygon : polygons) {
    const auto& v = polygon.vertices();
    // Candidates by a rounded normal: a near miss costs time, no more. Only flat ones have a plane that others can lie in.
    constexpr double kDirections = 1 << 16;
    const Vec3& n = polygon.normal();
    auto& candidates =
        groups[{std::lround(kDirections * n.x()), std::lround(kDirections * n.y()), std::lround(kDirections * n.z())}];
    const auto in_plane = [&](const Group& group) {
      return std::all_of(v.begin(), v.end(), [&](const Vec3& p) { return group.plane.height(group.scale * p) == 0; });
    };
    constexpr std::size_t kMostCandidates = 64;
    const auto end = candidates.begin() + static_cast<std::ptrdiff_t>(std::min(candidates.size(), kMostCandidates));
    const auto found = std::find_if(candidates.begin(), end, in_plane);
    planes.push_back(found != end ? found->number : count);
    if (found != end) continue;
    ++count;
    const double scale = power_of_two_scale(v);
    SharpPlane own(localised(v, Vec3::Zero(), scale));
    if (own.flatness() == 0) candidates.push_back({std::move(own), scale, planes.back()});
  }
  return planes;
}

}  // namespace etendue
