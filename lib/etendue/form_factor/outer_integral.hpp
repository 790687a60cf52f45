// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "etendue/form_factor/cell_rule.hpp"
#include "etendue/form_factor/event_curves.hpp"

namespace etendue {

/// The integral over the source of what is hidden, or seen, of the receiver: cells between critical lines first, then
/// the cell with the largest error gets a rule of higher order, or is halved.
///
/// Accuracy  error() is an estimate: NOTES.md §5
class OuterIntegral {
 public:
  /// `free` is the integral without blockers; by it the smaller of the two integrands is chosen.
  OuterIntegral(const SightSpace& space, double free);

  Integrand integrand() const { return integrand_; }
  double value() const;
  double error() const;
  /// What rounding may have done to the value.
  double rounding() const { return rounding_; }
  int cells() const { return static_cast<int>(pieces_.size()); }
  int evaluations() const { return evaluations_; }
  bool exhausted() const;

  /// Refines all cells whose errors stand out, until the sum may have come down to `goal`.
  void refine(double goal);

 private:
  struct Zone {
    ShadowView view;
    std::vector<Vec3> near;  ///< corners of all loops
    const SightZone* zone;
  };
  struct Piece {
    Cell cell;
    std::size_t zone = 0;
    std::size_t order = 0;  ///< index into the ladder of rules
    double bend = 0;        ///< what a curve that the cell was cut along by its chord leaves, as a share of the spread
    bool curved = false;    ///< a curve crosses the cell
    double value = 0;
    double error = 0;
  };

  void add_zone(const SightSpace& space, std::size_t zone);
  void add_cell(const SightSpace& space, std::size_t zone, const Cell& cell, std::vector<EventCurve> curves,
                double bend, int depth);
  void measure(Piece& piece, bool fresh);
  void halve(std::size_t index);

  std::vector<Zone> zones_;
  std::vector<Piece> pieces_;
  Integrand integrand_ = Integrand::hidden;
  double rounding_ = 0;
  int evaluations_ = 0;
};

}  // namespace etendue
