// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/geometry/vector.hpp"

namespace etendue {

/// How the facets of a rough surface lean: share of their area by the angle α between their normals and the surface's.
enum class FacetDistribution {
  beckmann,  ///< exp(−tan²α/m²) / (π m² cos⁴α): slopes that a Gauss function describes
  gaussian,  ///< c exp(−(α/m)²): angles that one describes, the text's "usually"
  ggx,       ///< m² / (π (sin²α + m² cos²α)²): slopes of an ellipsoid, with long tails
};

/// How facets hide one another from the light and from the viewer.
enum class FacetShadowing {
  grooves,  ///< long symmetric V-shaped grooves: Torrance and Sparrow, as Cook and Torrance used them
  smith,    ///< heights and slopes apart, light's and viewer's side correlated by height; not for `gaussian`
};

/// Relative accuracy of Facets' functions; measured, facets_test.cpp.
inline constexpr double kFacetError = 1e-12;

/// A surface of facets that are mirrors and much larger than the wavelength.                          @eq IU.4.2.2
///
/// Symbols   m roughness: root mean square slope × √2 (beckmann), about it (others); α as above; n_h = N·H, n_v = N·V,
///           n_l = N·L, v_h = V·H, with H halfway between L and V
/// Domain    m in [kLeastRoughness, kGreatestRoughness]; cosines in [0, 1]
/// Errors    ContractViolation outside the domain, and for `smith` with `gaussian`, which has no closed form
/// Source    Cook and Torrance 1982; Walter et al. 2007 (ggx, Smith's functions); Heitz 2014 (correlation, identities)
class Facets {
 public:
  static constexpr double kLeastRoughness = 1e-4;
  static constexpr double kGreatestRoughness = 10;

  Facets(FacetDistribution distribution, double roughness, FacetShadowing shadowing);

  /// D [1/sr], so that ∫ D cos α dω = 1 over the hemisphere.
  double distribution(double n_h) const;
  /// Share of the facets with normal H, of those that face the direction, that is not hidden from it.
  double seen(double n_h, double n_v, double v_h) const;
  /// G: share seen by the viewer that the light reaches too.
  double shadowing(double n_h, double n_l, double n_v, double v_h) const;
  /// D G / (4 n_v) [1/sr]: of the light that falls on the surface, what mirrors would send towards the viewer.
  /// Domain    n_v > 0
  double sent(double n_h, double n_l, double n_v, double v_h) const;

 private:
  double smith(double cosine) const;  // Λ

  FacetDistribution kind_;
  FacetShadowing shadowing_;
  double roughness_;
  double scale_;  // of D
};

/// Directed reflection of a rough surface, to be multiplied by the Fresnel factor at cos = V·H of each wavelength:
///
///     k_s / F = D G / (4 (N·V)(N·L))                                                           @eq IU.4.2.2, IU.4.2.3, E5, G6
///
/// Symbols   N unit normal on the viewed side; L, V unit vectors towards light and viewer. A light of intensity I_p
///           sends I_p k_s (N·L) towards the viewer
/// Domain    unit vectors (kUnitTolerance)
/// Returns   [1/sr]; 0 where N·L ≤ 0 or N·V ≤ 0, where the printed quotient is 1/0 (G6). The printed π in place of 4
///           reflects 4/π times what arrives (E5)
/// Accuracy  relative kFacetError while N·L and N·V exceed 1e-3; measured. Finite however small they are, unless the value
///           itself is too large for a double
/// Errors    ContractViolation outside the domain
[[nodiscard]] double cook_torrance(const Facets& facets, const Vec3& normal, const Vec3& to_light,
                                   const Vec3& to_viewer);

}  // namespace etendue
