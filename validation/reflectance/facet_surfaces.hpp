// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "etendue/reflectance/facets.hpp"

namespace etendue::validation {

/// Every pair of a distribution and a shadowing that Facets has.
struct FacetSurface {
  FacetDistribution distribution;
  FacetShadowing shadowing;
};
inline constexpr std::array<FacetSurface, 5> kFacetSurfaces{{{FacetDistribution::beckmann, FacetShadowing::grooves},
                                                             {FacetDistribution::beckmann, FacetShadowing::smith},
                                                             {FacetDistribution::gaussian, FacetShadowing::grooves},
                                                             {FacetDistribution::ggx, FacetShadowing::grooves},
                                                             {FacetDistribution::ggx, FacetShadowing::smith}}};

}  // namespace etendue::validation
