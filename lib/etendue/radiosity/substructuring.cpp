// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/substructuring.hpp"

#include "etendue/core/contract.hpp"

namespace etendue {

Eigen::VectorXd patch_areas(const Substructure& structure) {
  const auto elements = static_cast<Eigen::Index>(structure.patch_of.size());
  require(structure.element_areas.size() == elements, "Substructure: one area an element");
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(structure.patches);
  for (Eigen::Index q = 0; q < elements; ++q) {
    const Eigen::Index i = structure.patch_of[static_cast<std::size_t>(q)];
    require(i >= 0 && i < structure.patches, "Substructure: every element belongs to a patch");
    require(structure.element_areas(q) > 0, "Substructure: areas are positive");
    areas(i) += structure.element_areas(q);
  }
  require(structure.patches > 0 && areas.minCoeff() > 0, "Substructure: every patch has an element");
  return areas;
}

Eigen::VectorXd element_radiosities(const Eigen::MatrixXd& element_factors, const Eigen::VectorXd& element_emission,
                                    const Eigen::VectorXd& element_reflectance,
                                    const Eigen::VectorXd& patch_radiosity) {
  const Eigen::Index elements = element_factors.rows();
  require(element_factors.cols() == patch_radiosity.size() && element_emission.size() == elements &&
              element_reflectance.size() == elements,
          "element_radiosities: the sizes fit");
  Eigen::VectorXd radiosity(elements);
  for (Eigen::Index q = 0; q < elements; ++q) {
    double irradiance = 0;
    for (Eigen::Index j = 0; j < patch_radiosity.size(); ++j) irradiance += patch_radiosity(j) * element_factors(q, j);
    radiosity(q) = element_emission(q) + element_reflectance(q) * irradiance;
  }
  return radiosity;
}

Eigen::VectorXd patch_means(const Substructure& structure, const Eigen::VectorXd& of_elements) {
  return patch_form_factors(structure, of_elements);
}

Eigen::MatrixXd patch_form_factors(const Substructure& structure, const Eigen::MatrixXd& element_factors) {
  const Eigen::VectorXd areas = patch_areas(structure);
  require(element_factors.rows() == structure.element_areas.size(), "patch means: one row an element");
  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(structure.patches, element_factors.cols());
  for (Eigen::Index q = 0; q < element_factors.rows(); ++q) {
    means.row(structure.patch_of[static_cast<std::size_t>(q)]) += element_factors.row(q) * structure.element_areas(q);
  }
  for (Eigen::Index i = 0; i < structure.patches; ++i) means.row(i) /= areas(i);
  return means;
}

}  // namespace etendue
