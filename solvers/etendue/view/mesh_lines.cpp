// SPDX-License-Identifier: Apache-2.0
#include "etendue/view/mesh_lines.hpp"

#include "etendue/raster/item_buffer.hpp"
#include "etendue/scene/camera_frame.hpp"

namespace etendue {

Result<Image> mesh_lines(const Camera& camera, const ElementMesh& mesh, int samples) {
  require(samples >= 1, "mesh_lines: at least one sample a pixel");
  const auto frame = camera_frame(camera);
  if (!frame) return frame.error();
  PixelView view;
  view.eye = frame->eye;
  view.across = frame->right;
  view.up = -frame->up;  // rows of a picture run downwards, and right × down = forward
  view.gaze = frame->forward;
  view.columns = camera.columns * samples;
  view.rows = camera.rows * samples;
  view.left = -frame->tan_horizontal;
  view.bottom = -frame->tan_vertical;
  view.pixel = 2 * frame->tan_horizontal / view.columns;
  ItemBuffer buffer(view);
  for (std::size_t k = 0; k < mesh.elements.size(); ++k) {
    const Polygon& polygon = mesh.elements[k].polygon;
    if (polygon.normal().dot(frame->eye - polygon.centroid()) <= 0) continue;  // its back
    buffer.draw(polygon.vertices(), polygon.normal(), static_cast<std::int32_t>(k));
  }
  Image lines(camera.columns, camera.rows);
  for (int row = 0; row < view.rows; ++row) {
    for (int column = 0; column < view.columns; ++column) {
      const std::int32_t own = buffer.item(column, row);
      const bool beside = column + 1 < view.columns && buffer.item(column + 1, row) != own;
      const bool below = row + 1 < view.rows && buffer.item(column, row + 1) != own;
      if (beside || below) lines.at(column / samples, row / samples) += 1;
    }
  }
  for (auto& pixel : lines.pixels) pixel /= static_cast<double>(samples) * samples;
  return lines;
}

Image drawn_over(const Image& picture, const Image& lines, double line) {
  require(picture.columns == lines.columns && picture.rows == lines.rows, "drawn_over: pictures of one size");
  Image result = picture;
  for (std::size_t k = 0; k < result.pixels.size(); ++k) {
    result.pixels[k] += lines.pixels[k] * (line - result.pixels[k]);
  }
  return result;
}

}  // namespace etendue
