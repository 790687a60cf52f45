// SPDX-License-Identifier: Apache-2.0
#include "etendue/view/drawing.hpp"

#include <algorithm>
#include <utility>

#include "etendue/optics/spectrum.hpp"

namespace etendue {

std::vector<Drawing> drawings(const Scene& scene, int wavelengths) {
  const bool any = std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
    return scene.materials[object.material].reflectance.has_value();
  });
  if (wavelengths == 0 || !any) return {{Which::all, 0, scene.white()}};
  std::vector<Drawing> all{{Which::plain, 0, scene.white()}};
  auto samples = even_wavelengths(wavelengths);
  if (scene.illuminant) samples = lit(std::move(samples), *scene.illuminant);
  for (const WavelengthSample& sample : samples) all.push_back({Which::spectral, sample.wavelength, sample.weight});
  return all;
}

void colour_for(double wavelength, const Scene& scene, std::vector<Material>& materials) {
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const auto& reflectance = scene.materials[m].reflectance;
    if (wavelength > 0 && reflectance) materials[m].k_d = materials[m].k_a = Rgb::Constant(reflectance->at(wavelength));
  }
}

}  // namespace etendue
