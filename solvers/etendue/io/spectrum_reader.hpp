// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/io/scene_node.hpp"
#include "etendue/optics/spectrum.hpp"

namespace etendue {

/// A spectrum that covers the visible light: pairs of a wavelength and a value, or values at equal steps. What is wrong is
/// reported: values outside the interval, fewer than two, wavelengths that do not ascend, or that leave out visible ones.
[[nodiscard]] std::optional<Spectrum> read_spectrum(const SceneNode& node, const ValueRange& values);

/// "D65", "A", the temperature of a black body [K], or a spectrum some of which is visible.
[[nodiscard]] std::optional<Illuminant> read_illuminant(const SceneNode& node);

/// A material's reflectance; its colour by daylight becomes k_d and k_a, which may not stand beside it, nor may a pattern.
void read_reflectance(const SceneNode& material_node, Material& material);

}  // namespace etendue
