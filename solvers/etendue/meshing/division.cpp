// SPDX-License-Identifier: Apache-2.0
#include "etendue/meshing/division.hpp"

#include <algorithm>
#include <cmath>

namespace etendue {

namespace {

/// Parts of at most `size`, a multiple of `groups`.
int parts(double length, double size, int groups) {
  const double each = std::ceil(length / (size * groups) * (1 - kOverlong));
  const double all = groups * std::max(each, 1.0);
  return all <= kMostElementsAlong ? static_cast<int>(all) : kMostElementsAlong + 1;
}

}  // namespace

Subdivision division_of(const Subdivision& asked, const Polygon& face) {
  if (!(asked.element_size > 0)) return asked;
  Subdivision division = asked;
  const auto& v = face.vertices();
  const auto side = [&](std::size_t k) { return (v[(k + 1) % v.size()] - v[k]).norm(); };
  if (v.size() == 4) return division_of(asked, std::max(side(0), side(2)), std::max(side(1), side(3)));
  double longest = 0;
  for (std::size_t k = 0; k < v.size(); ++k) longest = std::max(longest, side(k));
  const bool whole = parts(longest, asked.element_size, 1) == 1;
  for (std::size_t k = 0; k < v.size() && v.size() > 3 && !whole; ++k) {
    longest = std::max(longest, (v[k] - face.centroid()).norm());
  }
  division.elements[0] = division.elements[1] = parts(longest, asked.element_size, 1);
  return division;
}

Subdivision division_of(const Subdivision& asked, double first_edge, double second_edge) {
  if (!(asked.element_size > 0)) return asked;
  Subdivision division = asked;
  division.elements[0] = parts(first_edge, asked.element_size, asked.patches[0]);
  division.elements[1] = parts(second_edge, asked.element_size, asked.patches[1]);
  return division;
}

double count_of(const Subdivision& division, std::size_t corners) {
  const double cells = static_cast<double>(std::max(division.elements[0], 0)) * std::max(division.elements[1], 0);
  return corners > 4 && cells > 1 ? cells * static_cast<double>(corners) : cells;
}

}  // namespace etendue
