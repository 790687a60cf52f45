// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/chord.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace etendue {

std::optional<Chord> chord_of(const EventCurve& curve, const Cell& cell) {
  std::array<Vec2, 3> ends;
  std::size_t found = 0;
  for (int i = 0; i < cell.size(); ++i) {
    const Vec2 &a = cell[i], &b = cell[(i + 1) % cell.size()];
    const double at_a = curve.at(a), at_b = curve.at(b), middle = curve.at(0.5 * (a + b));
    // q(t) = c + b t + a t² through the three values
    const double c = at_a, square = 2 * (at_a + at_b - 2 * middle), linear = at_b - at_a - square;
    const double discriminant = linear * linear - 4 * square * c;
    if (!(discriminant > 0)) continue;
    const double half = -0.5 * (linear + std::copysign(std::sqrt(discriminant), linear));
    for (const double t : {square != 0 ? half / square : -1.0, half != 0 ? c / half : -1.0}) {
      if (!(t >= 0 && t < 1)) continue;
      if (found < ends.size()) ends[found] = a + t * (b - a);
      ++found;
    }
  }
  if (found != 2) return std::nullopt;
  const Vec2 along = ends[1] - ends[0];
  const double length = along.norm();
  if (!(length > 0)) return std::nullopt;
  const Vec2 normal(along.y() / length, -along.x() / length), middle = 0.5 * (ends[0] + ends[1]);
  constexpr double kStep = 0.01;
  const double slope =
      (curve.at(middle + kStep * length * normal) - curve.at(middle - kStep * length * normal)) / (2 * kStep);
  const double value = curve.at(middle), sag = slope != 0 ? std::abs(value / slope) : 1;
  return Chord{normal, normal.dot(middle), length, value, sag};
}

}  // namespace etendue
