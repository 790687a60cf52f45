// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <variant>

#include "etendue/reflectance/laid_pattern.hpp"
#include "etendue/reflectance/squares.hpp"
#include "etendue/reflectance/texture.hpp"

namespace etendue {

/// An image, shared by all materials that show it, and what lies beyond its edges.
struct TextureImage {
  std::shared_ptr<const TexturePyramid> pyramid;
  Wraps wraps;
};

/// Colours laid on a surface; k_d and k_a are multiplied by them.                                   @eq IU.4-1, IU.4.1.2
struct MaterialTexture {
  std::variant<TextureImage, ColourSquares> colours;
  /// In the coordinates of the object's own numbers; none: by the surface's parameters.
  std::optional<LaidPattern> laid;
  std::array<double, 2> tiles{1, 1};  ///< by which u and v are multiplied
};

/// Coordinates in which an object's own numbers were given: own = to_own (world − origin), in the scene's unit.
struct OwnCoordinates {
  Mat3 to_own = Mat3::Identity();
  Vec3 origin = Vec3::Zero();
};

}  // namespace etendue
