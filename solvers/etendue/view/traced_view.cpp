// SPDX-License-Identifier: Apache-2.0
#include "etendue/view/traced_view.hpp"

#include <algorithm>
#include <limits>

#include "etendue/acceleration/accelerator.hpp"
#include "etendue/raytracing/camera_rays.hpp"
#include "etendue/view/radiosity_view.hpp"

namespace etendue {

namespace {

/// The elements that turn their front to the eye, as a scene for rays.
struct Fronts {
  Scene scene;
  std::vector<std::size_t> elements;  ///< of each object
};

Fronts fronts(const ElementMesh& mesh, const Vec3& eye) {
  Fronts result;
  result.scene.materials.emplace_back();
  for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
    const Polygon& polygon = mesh.elements[k].polygon;
    if (polygon.normal().dot(eye - polygon.centroid()) <= 0) continue;  // its back
    result.scene.objects.push_back({"", polygon, 0, {}});
    result.elements.push_back(k);
  }
  return result;
}

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
  const auto frame = camera_frame(camera);
  if (!frame) return frame.error();
  const CameraFrame& seen_from = *frame;
  const Fronts front = fronts(mesh, seen_from.eye);
  const auto accelerator = make_accelerator(front.scene, AcceleratorKind::bounding_volumes);
  const double near = kNearPlane * diagonal(mesh);
  Image picture(camera.columns, camera.rows);
  const auto trace_row = [&](std::size_t index) {
    const int row = static_cast<int>(index);
    for (int column = 0; column < camera.columns; ++column) {
      Rgb sum = Rgb::Zero();
      for (int sample = 0; sample < samples * samples; ++sample) {
        const double across = (sample % samples + 0.5) / samples, down = (sample / samples + 0.5) / samples;
        Ray ray = eye_ray(seen_from, picture_point(camera, column, row, across, down));
        ray.t_min = near / ray.direction.dot(seen_from.forward);
        const Nearest found = accelerator->nearest(ray);
        if (!found.hit) {
          sum += background;
          continue;
        }
        const std::size_t element = front.elements[found.hit->object];
        sum += value_at(found.hit->hit.point, mesh.elements[element].polygon, radiosities.corners[element]);
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
