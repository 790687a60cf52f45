// SPDX-License-Identifier: Apache-2.0
#include "etendue/view/radiosity_view.hpp"

#include <algorithm>
#include <string>

#include "etendue/raster/projection.hpp"
#include "etendue/scene/camera_frame.hpp"

namespace etendue {

namespace {

constexpr int kLargestPicture = 1 << 16;  // samples along an edge: half of kLargestCoordinate, as Projection wants

class Painter {
 public:
  Painter(const CameraFrame& frame, int columns, int rows, double near, const Rgb& background)
      : frame_(frame), projection_(frame, columns, rows, near), raster_(columns, rows, background) {}

  void draw(const Polygon& polygon, const std::vector<Rgb>& values) {
    if (polygon.normal().dot(frame_.eye - polygon.centroid()) <= 0) return;  // its back
    Rgb mean = Rgb::Zero();
    for (const Rgb& value : values) mean += value;
    const SeenCorner centre = projection_.seen(polygon.centroid(), mean / static_cast<double>(values.size()));
    const auto& vertices = polygon.vertices();
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const std::size_t next = (k + 1) % vertices.size();
      projection_.project(
          {centre, projection_.seen(vertices[k], values[k]), projection_.seen(vertices[next], values[next])}, seen_);
      for (const auto& triangle : seen_) raster_.draw(triangle);
    }
  }

  const Image& picture() const { return raster_.picture(); }

 private:
  const CameraFrame& frame_;
  Projection projection_;
  DepthRaster raster_;
  std::vector<std::array<GouraudVertex, 3>> seen_;
};

Image averaged(const Image& fine, int samples) {
  Image picture(fine.columns / samples, fine.rows / samples);
  for (int row = 0; row < fine.rows; ++row) {
    for (int column = 0; column < fine.columns; ++column) {
      picture.at(column / samples, row / samples) += fine.at(column, row);
    }
  }
  for (auto& pixel : picture.pixels) pixel /= static_cast<double>(samples) * samples;
  return picture;
}

}  // namespace

Result<Image> view_radiosities(const Camera& camera, const ElementMesh& mesh, const VertexRadiosities& radiosities,
                               const Rgb& background, int samples, const Execution& execution) {
  require(samples >= 1, "view_radiosities: at least one sample a pixel");
  require(radiosities.corners.size() == mesh.elements.size(), "view_radiosities: vertex radiosities of this mesh");
  const auto frame = camera_frame(camera);
  if (!frame) return frame.error();
  if (std::max(camera.columns, camera.rows) > kLargestPicture / samples) {
    return Error{ErrorCode::invalid_input, "camera: " + std::to_string(camera.columns) + " × " +
                                               std::to_string(camera.rows) + " pixels of " + std::to_string(samples) +
                                               " × " + std::to_string(samples) + " samples are more than " +
                                               std::to_string(kLargestPicture) + " along an edge"};
  }
  Painter painter(*frame, camera.columns * samples, camera.rows * samples, kNearPlane * diagonal(mesh), background);
  for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
    if (execution.stopping()) return Error{ErrorCode::stopped, "the picture was stopped"};
    painter.draw(mesh.elements[k].polygon, radiosities.corners[k]);
    if (execution.progress) execution.progress(k + 1, mesh.elements.size());
  }
  return averaged(painter.picture(), samples);
}

double white_level(const Scene& scene, const ElementMesh& mesh, const VertexRadiosities& radiosities) {
  double reflected = 0, emitted = 0;
  for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
    const bool emits = (scene.materials[mesh.face_of(mesh.elements[k]).material].emission > 0).any();
    double& level = emits ? emitted : reflected;
    for (const Rgb& value : radiosities.corners[k]) level = std::max(level, value.maxCoeff());
  }
  if (reflected > 0) return reflected;
  return emitted > 0 ? emitted : 1;
}

}  // namespace etendue
