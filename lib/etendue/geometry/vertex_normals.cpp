// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/vertex_normals.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <numbers>
#include <numeric>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

/// A sum this small a share of its parts is their rounding: fins whose two sides cancel.
constexpr double kCancelled = 0x1p-40;

/// A triangle at a vertex, and the other ends of its edges there: the one that leaves and the one that arrives.
struct Corner {
  std::size_t triangle, corner;
  std::uint32_t leaves_to, arrives_from;
  std::size_t group;
};

double weight_at(const Mesh& mesh, const Corner& corner, NormalWeight weight) {
  const auto& ends = mesh.triangles[corner.triangle];
  const Vec3& at = mesh.vertices[ends[corner.corner]];
  const Vec3 u = mesh.vertices[corner.leaves_to] - at, v = mesh.vertices[corner.arrives_from] - at;
  const double doubled = u.cross(v).norm();
  if (weight == NormalWeight::area) return doubled / 2;
  return weight == NormalWeight::angle ? std::atan2(doubled, u.dot(v)) : 1;
}

std::size_t root(const std::vector<Corner>& around, std::size_t k) {
  while (around[k].group != k) k = around[k].group;
  return k;
}

/// Of each vertex the first that lies at the same place.
std::vector<std::uint32_t> first_at_its_place(const std::vector<Vec3>& vertices) {
  std::vector<std::uint32_t> order(vertices.size()), first(vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto place = std::weak_order(vertices[a][k], vertices[b][k]);
      if (place != 0) return place < 0;
    }
    return false;
  };
  std::stable_sort(order.begin(), order.end(), before);
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && !before(order[i - 1], order[i]) ? first[order[i - 1]] : order[i];
  return first;
}

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Joins the triangles around a vertex across edges that are no creases.
void join(std::vector<Corner>& around, const std::vector<Vec3>& normals, double crease_angle) {
  for (std::size_t i = 0; i < around.size(); ++i) {
    for (std::size_t j = 0; j < around.size(); ++j) {
      if (i == j || around[i].leaves_to != around[j].arrives_from) continue;
      if (angle_between(normals[around[i].triangle], normals[around[j].triangle]) > crease_angle) continue;
      around[root(around, i)].group = root(around, j);
    }
  }
}

}  // namespace

std::vector<Vec3> facet_normals(const Mesh& mesh) {
  std::vector<Vec3> normals;
  normals.reserve(mesh.triangles.size());
  for (const auto& ends : mesh.triangles) {
    for (const std::uint32_t end : ends) require(end < mesh.vertices.size(), "facet_normals: every corner is a vertex");
    const Vec3& a = mesh.vertices[ends[0]];
    normals.push_back((mesh.vertices[ends[1]] - a).cross(mesh.vertices[ends[2]] - a).stableNormalized());
  }
  return normals;
}

std::vector<std::array<Vec3, 3>> corner_normals(const Mesh& mesh, NormalWeight weight, double crease_angle) {
  require(crease_angle >= 0 && crease_angle <= std::numbers::pi, "corner_normals: crease_angle is in [0, pi]");
  const std::vector<Vec3> facets = facet_normals(mesh);
  const std::vector<std::uint32_t> first = first_at_its_place(mesh.vertices);
  std::vector<std::vector<Corner>> around(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (facets[t].isZero(0)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& ends = mesh.triangles[t];
      auto& corners = around[first[ends[k]]];
      corners.push_back({t, k, first[ends[(k + 1) % 3]], first[ends[(k + 2) % 3]], corners.size()});
    }
  }
  std::vector<std::array<Vec3, 3>> result(mesh.triangles.size());
  for (std::size_t t = 0; t < result.size(); ++t) result[t].fill(facets[t]);
  for (auto& corners : around) {
    join(corners, facets, crease_angle);
    std::vector<Vec3> sums(corners.size(), Vec3::Zero());
    std::vector<double> weights(corners.size(), 0.0);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const double share = weight_at(mesh, corners[k], weight);
      sums[root(corners, k)] += share * facets[corners[k].triangle];
      weights[root(corners, k)] += share;
    }
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec3& sum = sums[root(corners, k)];
      if (sum.norm() > kCancelled * weights[root(corners, k)]) {
        result[corners[k].triangle][corners[k].corner] = sum.normalized();
      }
    }
  }
  return result;
}

}  // namespace etendue
