// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "etendue/acceleration/accelerator.hpp"
#include "etendue/core/result.hpp"

namespace etendue {

/// Why Embree cannot be had: this build was made without its headers, or its library is not installed. Nothing if it can.
[[nodiscard]] std::optional<Error> embree_missing();

/// Triangles by Embree, which proposes them in single precision; each proposal is decided by intersect() in full. Rays
/// that pass near an edge are asked of BoundingVolumes again, and other shapes are BoundingVolumes' altogether.
///
/// Accuracy  a hit is always a true one, with the bits of intersect(), and no ray slips through a closed mesh. Not proved
///           to be that of brute force: where a ray passes a silhouette within about 2^-20 of the scene's size, or so low over
///           a triangle, Embree may see nothing or only what is behind. Never a judge (NOTES.md)
/// Contract  embree_missing() says nothing
[[nodiscard]] std::unique_ptr<const Accelerator> make_embree(const Scene& scene);

}  // namespace etendue
