// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/transparency.hpp"

#include <cmath>

#include "etendue/core/contract.hpp"

namespace etendue {

double transparency(double n_z, const TransparencyRange& range) {
  return transparency(n_z, range, 1);
}

double transparency(double n_z, const TransparencyRange& range, double m) {
  require(0 <= n_z && n_z <= 1, "transparency: n_z is in [0, 1]");
  require(0 <= range.least && range.least <= range.greatest && range.greatest <= 1,
          "transparency: 0 <= least <= greatest <= 1");
  require(std::isfinite(m) && m >= 1, "transparency: m is finite and at least one");
  return range.least + (range.greatest - range.least) * (1 - std::pow(1 - n_z, m));
}

Eigen::Array3d see_through(const Eigen::Array3d& front, const Eigen::Array3d& back, double transparency) {
  require(0 <= transparency && transparency <= 1, "see_through: transparency is in [0, 1]");
  return (1 - transparency) * front + transparency * back;
}

}  // namespace etendue
