// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <string>

#include "oracles/double_exponential.hpp"

// The form factor of each configuration of the catalogue, from its definition: the kernel, integrated over the visible
// parts of both surfaces by double-exponential rules. Parameters are those of the catalogue's entry, in its order.
namespace etendue::oracle {

using Truth = std::function<Wide(const double* p)>;
using Truths = std::map<std::string, Truth>;

[[nodiscard]] Truths truths_of_elements();
[[nodiscard]] Truths truths_of_strips();
[[nodiscard]] Truths truths_of_rectangles();
[[nodiscard]] Truths truths_of_discs_and_cylinders();
[[nodiscard]] Truths truths_of_spheres_and_cones();

/// Share of an element's power that arrives at a sphere of radius r at (l, 0, h), the element at 0 facing z: over the
/// directions that meet it, cut by the horizon.
[[nodiscard]] Wide element_to_sphere(Wide h, Wide l, Wide r);

/// From an element at (x, 0, z) with a normal in the plane y = 0 to the upper side of a disc around (0, 0, height), below
/// it or beside; all of the disc is above the element's plane: Lambert's contour. Negative for the lower side.
[[nodiscard]] Wide element_to_disc(const WideVector& at, const WideVector& normal, Wide radius, Wide height);

}  // namespace etendue::oracle
