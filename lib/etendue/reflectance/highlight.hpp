// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <variant>

#include "etendue/geometry/vector.hpp"
#include "etendue/reflectance/facets.hpp"

namespace etendue {

/// The scalar products of a light that the models of local reflection rest on, unlimited: what dot-product interpolation
/// carries from the corners of a polygon into it.
struct LightCosines {
  double incidence = 0;  ///< N·L
  double mirror = 0;     ///< R·V = 2 (N·L)(N·V) − L·V
  double halfway = 0;    ///< N·H, H = (L + V)/|L + V|; this and the next for laws other than Phong's
  double tilt = 0;       ///< V·H = L·H
  double view = 0;       ///< N·V
  double share = 1;      ///< of the light's intensity that arrives, arriving_share()
};

/// Phong's lobe, phong(), with Fresnel's factor of each channel for W(θ).
struct FresnelHighlight {
  double exponent = 1;
  Eigen::Array3d eta = Eigen::Array3d::Constant(1.5), k = Eigen::Array3d::Zero();  ///< as for FacetHighlight
};

/// Blinn's form of the lobe, blinn().
struct BlinnHighlight {
  double exponent = 1;
};

/// Cook and Torrance's facets, cook_torrance(), of a dielectric or a metal.
struct FacetHighlight {
  Facets facets;
  Eigen::Array3d eta = Eigen::Array3d::Constant(1.5);  ///< index over that of the air: red, green, blue
  Eigen::Array3d k = Eigen::Array3d::Zero();           ///< its imaginary part, 0 for a dielectric
};

/// Laws of the directed reflection beside Phong's with a constant k_s alone.
using Highlight = std::variant<BlinnHighlight, FacetHighlight, FresnelHighlight>;

/// What a surface with this law sends towards the viewer, as a share of a light's I_p, before k_s.     @eq IU.2.7.1, IU.4.2.2
///
///     FresnelHighlight  F(N·L) max(0, R·V)ⁿ
///     BlinnHighlight    max(0, N·H)ⁿ
///     FacetHighlight    π F(V·H) D G / (4 N·V)      = π F cook_torrance() (N·L)
///
/// In 2-4 a white matt surface sends I_p (N·L), 1/π of I_p's irradiance π I_p (N·L) into each direction: on this scale facets
/// count π, and with k_d + k_s ≤ 1 they reflect no more than arrives. The lobes lack the factor N·L, as 2-7 has them: under
/// grazing light broad ones do (Phong's of n = 1 at 89°: 12 times), narrow ones do not (n = 100: 6 %). F is the exact factor
/// of each channel: it colours the highlight of a metal, and whitens it where light grazes.         @eq IU.4.2.3, IU.4.2.2F
/// Domain    products in [−1, 1], all five of them (beyond, by rounding or interpolation, they are cut off); exponent ≥ 1, eta and
///           k as for fresnel_conductor()
/// Returns   red, green, blue; zero where N·L ≤ 0 or N·V ≤ 0
/// Accuracy  of phong(), blinn(), cook_torrance() and fresnel_conductor()
/// Errors    ContractViolation for exponent, eta or k outside the domain
[[nodiscard]] Eigen::Array3d directed_reflection(const Highlight& law, const LightCosines& cosines);

}  // namespace etendue
