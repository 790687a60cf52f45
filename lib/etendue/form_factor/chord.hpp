// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "etendue/form_factor/cell.hpp"
#include "etendue/form_factor/event_curves.hpp"

namespace etendue {

/// A chord of the cell along an event curve, and how far the curve leaves it compared with its length.
struct Chord {
  Vec2 normal;
  double level;
  double length;
  double value;  ///< the curve's, in the middle of the chord
  double sag;
};

/// Nothing where the curve does not cross the cell's boundary exactly twice.
[[nodiscard]] std::optional<Chord> chord_of(const EventCurve& curve, const Cell& cell);

}  // namespace etendue
