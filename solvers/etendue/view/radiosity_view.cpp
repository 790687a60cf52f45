// SPDX-License-Identifier: Apache-2.0
#include "etendue/view/radiosity_view.hpp"

#include <algorithm>
#include <string>

#include "etendue/raster/gouraud.hpp"
#include "etendue/scene/camera_frame.hpp"

namespace etendue {

namespace {

constexpr int kLargestPicture = 1 << 16;  // samples along an edge; with the margin below, half of kLargestCoordinate
constexpr double kMargin = 1.5;           // what is drawn beyond the picture's edge, where cuts cannot be seen

/// A corner in the frame of the camera.
struct Corner {
  Vec3 place;  // right, up, forward
  Rgb value;
};
using Outline = std::vector<Corner>;

// The part of a convex outline where distance ≥ 0, `distance` linear. New corners are computed from the inner end of an
// edge to the outer one: the same bits from both elements that share the edge.
template <class Distance>
Outline clipped(const Outline& outline, const Distance& distance) {
  Outline result;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Corner& a = outline[k];
    const Corner& b = outline[(k + 1) % outline.size()];
    const double at_a = distance(a.place), at_b = distance(b.place);
    if (at_a >= 0) result.push_back(a);
    if ((at_a >= 0) == (at_b >= 0)) continue;
    const auto between = [](const Corner& in, const Corner& out, double at_in, double at_out) {
      const double t = at_in / (at_in - at_out);
      return Corner{in.place + t * (out.place - in.place), in.value + t * (out.value - in.value)};
    };
    result.push_back(at_a >= 0 ? between(a, b, at_a, at_b) : between(b, a, at_b, at_a));
  }
  return result;
}

class Painter {
 public:
  Painter(const CameraFrame& frame, int columns, int rows, double near, const Rgb& background)
      : frame_(frame), columns_(columns), rows_(rows), near_(near), raster_(columns, rows, background) {}

  void draw(const Polygon& polygon, const std::vector<Rgb>& values) {
    if (polygon.normal().dot(frame_.eye - polygon.centroid()) <= 0) return;  // its back
    Rgb mean = Rgb::Zero();
    for (const Rgb& value : values) mean += value;
    const Corner centre = seen(polygon.centroid(), mean / static_cast<double>(values.size()));
    const auto& vertices = polygon.vertices();
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      const std::size_t next = (k + 1) % vertices.size();
      draw({centre, seen(vertices[k], values[k]), seen(vertices[next], values[next])});
    }
  }

  const Image& picture() const { return raster_.picture(); }

 private:
  Corner seen(const Vec3& point, const Rgb& value) const {
    const Vec3 d = point - frame_.eye;
    return {{d.dot(frame_.right), d.dot(frame_.up), d.dot(frame_.forward)}, value};
  }

  void draw(Outline outline) {
    const double h = kMargin * frame_.tan_horizontal, v = kMargin * frame_.tan_vertical;
    outline = clipped(outline, [&](const Vec3& p) { return p.z() - near_; });
    outline = clipped(outline, [&](const Vec3& p) { return h * p.z() - p.x(); });
    outline = clipped(outline, [&](const Vec3& p) { return h * p.z() + p.x(); });
    outline = clipped(outline, [&](const Vec3& p) { return v * p.z() - p.y(); });
    outline = clipped(outline, [&](const Vec3& p) { return v * p.z() + p.y(); });
    for (std::size_t k = 2; k < outline.size(); ++k) {
      raster_.draw({projected(outline[0]), projected(outline[k - 1]), projected(outline[k])});
    }
  }

  GouraudVertex projected(const Corner& corner) const {
    const double x = (corner.place.x() / (corner.place.z() * frame_.tan_horizontal) + 1) / 2;
    const double y = (corner.place.y() / (corner.place.z() * frame_.tan_vertical) + 1) / 2;
    return {{x * columns_, (1 - y) * rows_}, 1 / corner.place.z(), corner.value};
  }

  const CameraFrame& frame_;
  int columns_, rows_;
  double near_;
  DepthRaster raster_;
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
