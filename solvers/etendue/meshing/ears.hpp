// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "etendue/geometry/vector.hpp"

namespace etendue {

/// A simple polygon, holes cut from it, as triangles on its corners: chains of indices into `points`.
///
/// Each hole is joined with what is around it by a bridge, an edge that is passed both ways; ears are cut off what is then one
/// chain of n corners.
/// Domain    the outline runs left around, holes either way; chains do not touch each other, holes lie in the outline
/// Returns   n − 2 triangles that turn left; n the corners of all chains, and two for each hole. Where coordinates have been
///           rounded onto one line some have no area
/// Accuracy  every decision exact: orientation()
/// Source    Meisters 1980: every simple polygon has two ears
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> ears(const std::vector<Vec2>& points,
                                                             std::vector<std::uint32_t> outline,
                                                             std::vector<std::vector<std::uint32_t>> holes = {});

}  // namespace etendue
