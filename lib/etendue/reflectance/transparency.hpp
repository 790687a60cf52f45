// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "etendue/core/floating_point.hpp"

namespace etendue {

/// How clear an object is where the view grazes it and where it meets it head-on: 0 opaque, 1 perfectly clear.
struct TransparencyRange {
  double least = 0;     ///< t_min, at the silhouette
  double greatest = 1;  ///< t_max, facing the viewer
};

/// Which of the two laws, and between which ends.
struct TransparencyLaw {
  TransparencyRange range;
  double power = 1;  ///< m; 1: linear
};

/// Transparency of a curved, solid object, which is less at its silhouettes: there the light crosses more of it.
///
///     t = t_min + (t_max − t_min) n_z                                                         @eq IU.4.4b
///
/// Symbols   n_z in [0, 1] cosine between the normal and the direction towards the viewer
/// Domain    0 ≤ t_min ≤ t_max ≤ 1
/// Accuracy  absolute error of at most 3.1 u
/// Errors    ContractViolation outside the domain
[[nodiscard]] double transparency(double n_z, const TransparencyRange& range);

/// The same with the silhouette's fall confined to a rim, the narrower the greater m is (2 or 3 are usual; 1 is
/// linear).
///
///     t = t_min + (t_max − t_min) [1 − (1 − n_z)^m]                                            @eq IU.4.4b
///
/// Domain    as above, m ≥ 1
/// Accuracy  absolute error of at most (6 + m) u for a pow that errs by less than one ulp
[[nodiscard]] double transparency(double n_z, const TransparencyRange& range, double m);

/// The law's transparency: of the linear one without a power.
[[nodiscard]] double transparency(double n_z, const TransparencyLaw& law);

/// What is seen through a clear object: a part of its own light and a part of what lies behind.
///
///     I = (1 − t) I_f + t I_b                                                                 @eq IU.4.4a
///
/// Symbols   I_f, I_b intensities of the front and the back object, per channel; t transparency of the front object,
///           the one that refracts (E10). The text prints t I_f + (1 − t) I_b with t = 1 opaque, and then uses t as a
///           transparency: its silhouettes would be the clearest parts (E4)
/// Accuracy  absolute error of at most 3.1 u max(I_f, I_b)
/// Errors    ContractViolation unless t is in [0, 1]
[[nodiscard]] Eigen::Array3d see_through(const Eigen::Array3d& front, const Eigen::Array3d& back, double transparency);

}  // namespace etendue
