// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "etendue/scene/scene.hpp"

namespace etendue {

/// Elements along one edge of a face, and in all of an object: beyond, form-factor matrices fit into no memory.
inline constexpr int kMostElementsAlong = 4096;
inline constexpr long kMostElements = 1L << 20;

/// A side may exceed Subdivision::element_size by this share: 0.3 m in elements of 0.1 m are three, not four.
inline constexpr double kOverlong = 0x1p-40;

/// How a face of a shape so divided is divided: by the counts that are asked for, or, where there is an element size, as
/// coarsely as keeps every side within it.
///
///     quadrilateral   elements = patches · ⌈longer of two opposite edges / (patches · size)⌉
///     triangle        n² of them with n = ⌈longest edge / size⌉: elements {n, n}
///     more corners    undivided where no edge is longer than the size, else n² in each triangle of an edge and the centroid,
///                     n = ⌈longest of edges and ways from the corners to the centroid / size⌉: elements {n, n}
///
/// Returns   elements and patches; kMostElementsAlong + 1 where it would be more
[[nodiscard]] Subdivision division_of(const Subdivision& asked, const Polygon& face);

/// The same for a quadrilateral whose longer first and second edges have these lengths.
[[nodiscard]] Subdivision division_of(const Subdivision& asked, double first_edge, double second_edge);

/// How many elements a face of so many corners then has.
[[nodiscard]] double count_of(const Subdivision& division, std::size_t corners);

}  // namespace etendue
