// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/transparency.hpp"

#include <cmath>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

void require_domain(double n_z, const TransparencyRange& range) {
  require(0 <= n_z && n_z <= 1, "transparency: n_z is in [0, 1]");
  require(0 <= range.least && range.least <= range.greatest && range.greatest <= 1,
          "transparency: 0 <= least <= greatest <= 1");
}

}  // namespace

double transparency(double n_z, const TransparencyRange& range) {
  require_domain(n_z, range);
  return range.least + (range.greatest - range.least) * n_z;
}

double transparency(double n_z, const TransparencyRange& range, double m) {
  require_domain(n_z, range);
  require(std::isfinite(m) && m >= 1, "transparency: m is finite and at least one");
  return range.least + (range.greatest - range.least) * (1 - std::pow(1 - n_z, m));
}

double transparency(double n_z, const TransparencyLaw& law) {
  return law.power == 1 ? transparency(n_z, law.range) : transparency(n_z, law.range, law.power);
}

Eigen::Array3d see_through(const Eigen::Array3d& front, const Eigen::Array3d& back, double transparency) {
  require(0 <= transparency && transparency <= 1, "see_through: transparency is in [0, 1]");
  return (1 - transparency) * front + transparency * back;
}

}  // namespace etendue
