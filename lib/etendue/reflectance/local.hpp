// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

#include "etendue/geometry/vector.hpp"
#include "etendue/reflectance/highlight.hpp"

namespace etendue {

/// What a surface does with light that comes straight from a source. Arrays hold red, green, blue.
struct LocalReflection {
  Eigen::Array3d k_a = Eigen::Array3d::Zero();  ///< ambient; k_d in most of the formulas
  Eigen::Array3d k_d = Eigen::Array3d::Zero();  ///< diffuse: carries the surface's colour
  double k_s = 0;                               ///< directed: keeps the light's colour
  double exponent = 1;                          ///< n of phong()
  const Highlight* highlight = nullptr;         ///< another law in place of phong()
};

/// Light of one source at the point that is shaded.
struct IncidentLight {
  Vec3 to_light = Vec3::UnitZ();                      ///< unit vector
  Eigen::Array3d intensity = Eigen::Array3d::Zero();  ///< I_p, red, green, blue
  double attenuation = 1;                             ///< f of linear_attenuation(); 0 for a light that is hidden
};

/// The local model of illumination: ambient + diffuse + directed reflection, summed over the lights.   @eq IU.2.2
///
///     I = k_a I_a + Σ_i I_p,i f_i [k_d (N·L_i) + k_s (R_i·V)ⁿ]     @eq IU.2-4, IU.2-5, IU.2-6, IU.2-7, IU.2.8, IU.2.9
///
/// Symbols   f_i = 1/(d_i + d0); R_i mirror direction of the i-th light (E3). k_d weighs the diffuse part only; in
///           front of the whole sum, as 5-2 prints it, a black but glossy surface would have no highlight (E2)
///           Where surface.highlight is set, directed_reflection() stands in place of (R_i·V)ⁿ
/// Domain    unit vectors (kUnitTolerance), normal on the viewed side
/// Returns   red, green, blue; not limited above: clamp(), scale_image(), scale_pixel()
/// Accuracy  of lambert() and phong(), weighed and summed
/// Errors    ContractViolation outside the domain of lambert(), phong() or directed_reflection()
[[nodiscard]] Eigen::Array3d local_reflection(const LocalReflection& surface, const Vec3& normal, const Vec3& to_viewer,
                                              const Eigen::Array3d& ambient_light,
                                              std::span<const IncidentLight> lights);

}  // namespace etendue
