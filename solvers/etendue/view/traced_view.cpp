// SPDX-License-Identifier: Apache-2.0
#include "etendue/view/traced_view.hpp"

#include <algorithm>
#include <limits>

#include "etendue/view/first_hits.hpp"

namespace etendue {

namespace {

/// The value at a point of an element: linear in the triangle of the fan around the centroid that the point is in, or, by
/// rounding, is nearest to.
Rgb value_at(const Vec3& point, const Polygon& polygon, const std::vector<Rgb>& corners) {
  const Vec3 centre = polygon.centroid();
  const auto& vertices = polygon.vertices();
  Rgb mean = Rgb::Zero();
  for (const Rgb& corner : corners) mean += corner;
  mean /= static_cast<double>(corners.size());
  double innermost = -std::numeric_limits<double>::infinity();
  Rgb value = mean;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const std::size_t next = (k + 1) % vertices.size();
    const Vec3 a = vertices[k] - centre, b = vertices[next] - centre, p = point - centre;
    const double area = a.cross(b).dot(polygon.normal());
    if (!(area > 0)) continue;  // the centroid lies on this side
    const double u = p.cross(b).dot(polygon.normal()) / area, v = a.cross(p).dot(polygon.normal()) / area;
    const double inside = std::min({u, v, 1 - u - v});
    if (inside <= innermost) continue;
    innermost = inside;
    value = mean + u * (corners[k] - mean) + v * (corners[next] - mean);
  }
  return value;
}

}  // namespace

Result<Image> trace_radiosities(const Camera& camera, const ElementMesh& mesh, const VertexRadiosities& radiosities,
                                const Rgb& background, int samples, const Execution& execution) {
  require(samples >= 1, "trace_radiosities: at least one sample a pixel");
  require(radiosities.corners.size() == mesh.elements.size(), "trace_radiosities: vertex radiosities of this mesh");
  const auto hits = FirstHits::make(camera, mesh);
  if (!hits) return hits.error();
  Image picture(camera.columns, camera.rows);
  const auto trace_row = [&](std::size_t index) {
    const int row = static_cast<int>(index);
    for (int column = 0; column < camera.columns; ++column) {
      Rgb sum = Rgb::Zero();
      for (int sample = 0; sample < samples * samples; ++sample) {
        const double across = (sample % samples + 0.5) / samples, down = (sample / samples + 0.5) / samples;
        const auto shown = hits->at(column, row, across, down);
        sum += shown
                   ? value_at(shown->point, mesh.elements[shown->element].polygon, radiosities.corners[shown->element])
                   : background;
      }
      picture.at(column, row) = sum / (samples * samples);
    }
  };
  if (!parallel_for(static_cast<std::size_t>(camera.rows), execution, trace_row)) {
    return Error{ErrorCode::stopped, "the picture was stopped"};
  }
  return picture;
}

}  // namespace etendue
