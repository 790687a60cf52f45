// SPDX-License-Identifier: Apache-2.0
#include "etendue/view/first_hits.hpp"

#include <utility>

#include "etendue/view/radiosity_view.hpp"

namespace etendue {

Result<FirstHits> FirstHits::make(const Camera& camera, const ElementMesh& mesh) {
  const auto frame = camera_frame(camera);
  if (!frame) return frame.error();
  FirstHits hits(camera, *frame, kNearPlane * diagonal(mesh));
  hits.scene_ = std::make_unique<Scene>();
  hits.scene_->materials.emplace_back();
  for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
    const Polygon& polygon = mesh.elements[k].polygon;
    if (polygon.normal().dot(hits.frame_.eye - polygon.centroid()) <= 0) continue;  // its back
    hits.scene_->objects.push_back({"", polygon, 0, {}});
    hits.elements_.push_back(k);
  }
  hits.accelerator_ = make_accelerator(*hits.scene_, AcceleratorKind::bounding_volumes);
  return hits;
}

std::optional<FirstHits::Shown> FirstHits::at(int column, int row, double across, double down) const {
  Ray ray = eye_ray(frame_, picture_point(camera_, column, row, across, down));
  ray.t_min = near_ / ray.direction.dot(frame_.forward);
  const Nearest found = accelerator_->nearest(ray);
  if (!found.hit) return std::nullopt;
  return Shown{elements_[found.hit->object], found.hit->hit.point};
}

}  // namespace etendue
