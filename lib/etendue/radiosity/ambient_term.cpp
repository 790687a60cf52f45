// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/ambient_term.hpp"

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

/// Summed in the order of the indices, so that the bits do not depend on how Eigen was vectorised.
double weighted_sum(const Eigen::VectorXd& values, const Eigen::VectorXd& weights) {
  double sum = 0;
  for (Eigen::Index i = 0; i < values.size(); ++i) sum += values(i) * weights(i);
  return sum;
}

double total(const Eigen::VectorXd& areas) {
  require(areas.size() > 0 && areas.minCoeff() > 0, "ambient term: areas are positive");
  double sum = 0;
  for (Eigen::Index i = 0; i < areas.size(); ++i) sum += areas(i);
  return sum;
}

}  // namespace

Eigen::VectorXd estimated_form_factors(const Eigen::VectorXd& areas) {
  return areas / total(areas);
}

double mean_reflectance(const Eigen::VectorXd& reflectance, const Eigen::VectorXd& areas) {
  require(reflectance.size() == areas.size(), "mean_reflectance: one reflectance a patch");
  const double all = total(areas);
  require(reflectance.minCoeff() >= 0 && reflectance.maxCoeff() <= 1, "mean_reflectance: reflectances are in [0, 1]");
  return weighted_sum(reflectance, areas) / all;
}

double interreflection(double mean_reflectance) {
  require(mean_reflectance >= 0 && mean_reflectance < 1, "interreflection: the mean reflectance is in [0, 1)");
  return 1 / (1 - mean_reflectance);
}

double ambient_radiosity(const Eigen::VectorXd& unshot, const Eigen::VectorXd& reflectance,
                         const Eigen::VectorXd& areas) {
  require(unshot.size() == areas.size(), "ambient_radiosity: one unshot radiosity a patch");
  return interreflection(mean_reflectance(reflectance, areas)) * weighted_sum(unshot, estimated_form_factors(areas));
}

Eigen::VectorXd with_ambient_term(const Eigen::VectorXd& radiosity, const Eigen::VectorXd& reflectance,
                                  double ambient) {
  require(radiosity.size() == reflectance.size(), "with_ambient_term: one reflectance a patch");
  return radiosity + reflectance * ambient;
}

}  // namespace etendue
