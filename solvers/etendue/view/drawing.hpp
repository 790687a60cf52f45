// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "etendue/scene/scene.hpp"

namespace etendue {

/// Samples that a wavelength colours, those that it leaves alone, or both.
enum class Which { all, plain, spectral };

/// One of the drawings that add up to a rasterised picture: which samples it draws, at which wavelength [nm] (0: in three
/// channels), and what they count.
struct Drawing {
  Which which;
  double wavelength;
  Rgb weight;
};

/// One drawing in the light's white where `wavelengths` is 0 or no object has a reflectance; else one of plain samples, and one
/// of spectral samples at each of even_wavelengths(), lit() by the scene's illuminant.                       @eq IU.2.9b
[[nodiscard]] std::vector<Drawing> drawings(const Scene& scene, int wavelengths);

/// Gives the materials of a scene the colours that a wavelength finds: k_d and k_a are the reflectance there. A copy of
/// scene.materials goes in, maybe with the colours of another wavelength; at 0 nothing changes.
void colour_for(double wavelength, const Scene& scene, std::vector<Material>& materials);

}  // namespace etendue
