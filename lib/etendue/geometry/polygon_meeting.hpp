// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "etendue/geometry/meeting.hpp"
#include "etendue/geometry/polygon.hpp"
#include "etendue/geometry/shear.hpp"

// What polygons with and without holes share; their users want polygon.hpp, polygon_with_holes.hpp.
namespace etendue {

/// Whether the ray's line passes through the closed chain: the Jordan test of encloses(), across the ray in place of a
/// coordinate axis (NOTES.md §5). Neighbours see the corners they share at the same doubles, so every line through their common
/// edge passes through exactly one of them.
[[nodiscard]] bool passes_through(const Shear& shear, const Vec3& origin, const std::vector<Vec3>& chain);

/// The hit of a ray whose line passes through the polygon.
[[nodiscard]] std::optional<Hit> hit_of_plane(const Ray& ray, const Polygon& polygon);

/// Six digits, for messages.
[[nodiscard]] std::string short_text(double value);

}  // namespace etendue
