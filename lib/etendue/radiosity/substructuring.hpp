// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "etendue/core/floating_point.hpp"

// Patches shoot, elements receive: elements refine the answer without enlarging the system.          @eq IU.6.7.1
namespace etendue {

/// Which patch each element is a part of, and how large it is.
struct Substructure {
  std::vector<Eigen::Index> patch_of;  ///< one entry an element; 0 … patches − 1, every patch has an element
  Eigen::VectorXd element_areas;       ///< [m²], positive
  Eigen::Index patches = 0;
};

/// A_i = Σ_q A_q. Errors (of all functions here): ContractViolation where sizes or indices do not fit.
[[nodiscard]] Eigen::VectorXd patch_areas(const Substructure& structure);

/// Radiosities of the elements from those of the patches.
///
///     B_q = E_q + ρ_q Σ_j B_j F_qj                                                                @eq IU.6-16
///
/// Symbols   F_qj form factors from element q to patch j, elements × patches; E_q, ρ_q of the elements; B_j [W/m²]
/// Accuracy  relative error ≤ γ_(n+2) for n patches, proved: all terms have one sign
[[nodiscard]] Eigen::VectorXd element_radiosities(const Eigen::MatrixXd& element_factors,
                                                  const Eigen::VectorXd& element_emission,
                                                  const Eigen::VectorXd& element_reflectance,
                                                  const Eigen::VectorXd& patch_radiosity);

/// The mean over each patch of a quantity of its elements, weighted by area; of B_q it is the radiosity of the patch.
///
///     B_i = (1/A_i) Σ_q B_q A_q                                                                   @eq IU.6-17
///
/// Accuracy  relative error ≤ γ_(2t+1) for t elements a patch and values of one sign, proved
[[nodiscard]] Eigen::VectorXd patch_means(const Substructure& structure, const Eigen::VectorXd& of_elements);

/// Form factors between patches from those of the elements: the means that 6-18 leaves in the brackets. The inner
/// integral is taken as constant over an element only, not over the patch, so this is better than one value a patch.
///
///     F_ij = (1/A_i) Σ_q F_qj A_q                                                         @eq IU.6-18, IU.6-19
///
/// Accuracy  relative error ≤ γ_(2t+1), proved
[[nodiscard]] Eigen::MatrixXd patch_form_factors(const Substructure& structure, const Eigen::MatrixXd& element_factors);

}  // namespace etendue
