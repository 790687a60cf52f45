// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/preview.hpp"

#include <algorithm>

#include "etendue/core/contract.hpp"
#include "etendue/raytracing/camera_rays.hpp"

namespace etendue {

Result<std::optional<Image>> preview(const Accelerator& accelerator, const RenderOptions& options, int step,
                                     const Execution& execution) {
  require(step >= 1, "preview: squares have a side");
  const Camera& camera = accelerator.scene().camera;
  const auto frame = camera_frame(camera);
  if (!frame) return frame.error();
  const PixelWindow window = options.crop.value_or(PixelWindow{0, 0, camera.columns, camera.rows});
  const Media around = media_around(frame->eye, accelerator);
  Image image(window.columns(), window.rows());
  const int first = window.top / step, last = (window.bottom - 1) / step;
  const bool complete = parallel_for(static_cast<std::size_t>(last - first + 1), execution, [&](std::size_t index) {
    const int square_row = first + static_cast<int>(index);
    const int top = square_row * step, bottom = std::min(top + step, camera.rows);
    for (int left = window.left / step * step; left < window.right; left += step) {
      const int right = std::min(left + step, camera.columns);
      const PicturePoint centre{(left + right) / 2.0 / camera.columns,
                                (camera.rows - (top + bottom) / 2.0) / camera.rows};
      const Rgb colour = see(eye_ray(*frame, centre), accelerator, options, around).colour;
      for (int row = std::max(top, window.top); row < std::min(bottom, window.bottom); ++row) {
        for (int column = std::max(left, window.left); column < std::min(right, window.right); ++column)
          image.at(column - window.left, row - window.top) = colour;
      }
    }
  });
  if (!complete) return std::optional<Image>();
  return std::optional<Image>(std::move(image));
}

}  // namespace etendue
