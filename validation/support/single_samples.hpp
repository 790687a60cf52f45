// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/raytracing/render.hpp"
#include "etendue/view/shaded_view.hpp"

// The same pixels by both methods, one sample at the centre of each.
namespace etendue::validation {

/// By rays; the objects that they meet are told as well.
inline Rendering traced_once(const Scene& scene) {
  RenderOptions options;
  options.sampling.samples_per_side = 1;
  options.facts = {PictureFact::object};
  return render(*make_accelerator(scene, AcceleratorKind::bounding_volumes), options, {}).value();
}

/// By rasteriser, normals interpolated, with so many facets around what is round.
inline Image drawn_once(const Scene& scene, int facets) {
  ShadingOptions options;
  options.samples = 1;
  options.net.facets = facets;
  return view_shaded(scene, options).value().image;
}

}  // namespace etendue::validation
