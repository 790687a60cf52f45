// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/assembly/surface_model.hpp"

namespace etendue {

/// A round surface that reaches less than this share of its size into another is taken to touch it.
inline constexpr double kSunkShare = 1e-3;

/// Refuses round surfaces of which another surface cuts off a part: what is hidden
/// and what hides would change places within one outline.
///
/// Errors    invalid_input, one line for each pair: place in the file, both names; and their count
[[nodiscard]] Result<Done> check_rounds(const Scene& scene, const SurfaceModel& model);

/// Does the disc close an end of the cylinder?
[[nodiscard]] bool caps(const Disc& disc, const Cylinder& cylinder);

/// Adds a note on each cylinder with an end that neither a disc nor a polygon closes.
void note_open_cylinders(SurfaceModel& model);

}  // namespace etendue
