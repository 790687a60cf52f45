// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "etendue/acceleration/accelerator.hpp"
#include "etendue/core/result.hpp"
#include "etendue/meshing/elements.hpp"
#include "etendue/raytracing/camera_rays.hpp"

namespace etendue {

/// What a camera sees of a mesh: fronts only, the nearest first; nothing nearer than kNearPlane.
class FirstHits {
 public:
  /// Where a ray ends, on the element's plane up to the rounding of a ray's point (Hit).
  struct Shown {
    std::size_t element;
    Vec3 point;
  };

  /// `mesh` need not outlive it.
  ///
  /// Errors    those of camera_frame()
  [[nodiscard]] static Result<FirstHits> make(const Camera& camera, const ElementMesh& mesh);

  /// Domain    `across` and `down` in [0, 1], within the pixel
  /// Returns   nothing where the ray meets nothing
  [[nodiscard]] std::optional<Shown> at(int column, int row, double across, double down) const;

 private:
  FirstHits(const Camera& camera, const CameraFrame& frame, double near)
      : camera_(camera), frame_(frame), near_(near) {}

  Camera camera_;
  CameraFrame frame_;
  double near_;
  std::unique_ptr<Scene> scene_;       ///< the fronts, as objects; where it lies does not change
  std::vector<std::size_t> elements_;  ///< of each object
  std::unique_ptr<const Accelerator> accelerator_;
};

}  // namespace etendue
