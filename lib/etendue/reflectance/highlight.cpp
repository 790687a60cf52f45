// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/highlight.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "etendue/core/contract.hpp"
#include "etendue/optics/fresnel.hpp"

namespace etendue {

namespace {

/// Fresnel's factor of each channel.
template <class Law>
Eigen::Array3d fresnel(const Law& law, double cosine) {
  const auto factor = [&](Eigen::Index c) { return fresnel_conductor(cosine, law.eta[c], law.k[c]); };
  return {factor(0), factor(1), factor(2)};
}

Eigen::Array3d directed(const BlinnHighlight& law, const LightCosines& cosines) {
  require(std::isfinite(law.exponent) && law.exponent >= 1, "highlight: exponent is finite and at least one");
  return Eigen::Array3d::Constant(std::pow(std::clamp(cosines.halfway, 0.0, 1.0), law.exponent));
}

Eigen::Array3d directed(const FacetHighlight& law, const LightCosines& cosines) {
  const double n_l = std::min(cosines.incidence, 1.0), n_v = std::min(cosines.view, 1.0);
  const double n_h = std::clamp(cosines.halfway, 0.0, 1.0), v_h = std::clamp(cosines.tilt, 0.0, 1.0);
  return std::numbers::pi * law.facets.sent(n_h, n_l, n_v, v_h) * fresnel(law, v_h);
}

Eigen::Array3d directed(const FresnelHighlight& law, const LightCosines& cosines) {
  require(std::isfinite(law.exponent) && law.exponent >= 1, "highlight: exponent is finite and at least one");
  const double lobe = std::pow(std::clamp(cosines.mirror, 0.0, 1.0), law.exponent);
  return lobe * fresnel(law, std::min(cosines.incidence, 1.0));
}

}  // namespace

Eigen::Array3d directed_reflection(const Highlight& law, const LightCosines& cosines) {
  if (!(cosines.incidence > 0 && cosines.view > 0)) return Eigen::Array3d::Zero();
  return std::visit([&](const auto& each) { return directed(each, cosines); }, law);
}

}  // namespace etendue
