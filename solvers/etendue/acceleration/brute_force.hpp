// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/acceleration/surface_list.hpp"

namespace etendue {

/// Tests every surface of the scene: slow, and right by definition. The others are held against it. @eq IU.5.7
class BruteForce final : public Accelerator {
 public:
  explicit BruteForce(const Scene& scene) : Accelerator(scene), surfaces_(surfaces(scene)) {}

  [[nodiscard]] Nearest nearest(const Ray& ray) const override;
  [[nodiscard]] Obstruction obstruction(const Ray& ray) const override;

 private:
  std::vector<Surface> surfaces_;
};

}  // namespace etendue
