// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "etendue/core/result.hpp"
#include "etendue/geometry/hit.hpp"
#include "etendue/geometry/ray.hpp"

namespace etendue {

/// A simple planar polygon, convex or concave. Vertices run counter-clockwise as seen from the front.
class Polygon {
 public:
  /// Refuses fewer than three vertices, non-finite coordinates, coincident vertices, zero area, vertices off the plane
  /// and crossing edges; the message names the vertex.
  [[nodiscard]] static Result<Polygon> make(std::vector<Vec3> vertices);

  const std::vector<Vec3>& vertices() const { return vertices_; }
  const Vec3& normal() const { return normal_; }      ///< unit; Newell's sum
  double area() const { return area_; }               ///< [length²]
  const Vec3& centroid() const { return centroid_; }  ///< of the area, not of the vertices

 private:
  Polygon() = default;
  std::vector<Vec3> vertices_;
  Vec3 normal_ = Vec3::UnitZ();
  double area_ = 0;
  Vec3 centroid_ = Vec3::Zero();
};

[[nodiscard]] std::optional<Hit> intersect(const Ray& ray, const Polygon& polygon);

}  // namespace etendue
