// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "etendue/form_factor/cell_rule.hpp"
#include "etendue/form_factor/event_curves.hpp"

namespace etendue {

/// The integral over the source of what is hidden, or seen, of the receiver: cells between critical lines first, then
/// the cells with the largest errors get rules of higher order, or are halved.
///
/// Accuracy  error() is an estimate: NOTES.md §5
class OuterIntegral {
 public:
  /// `free` is the integral without blockers; by it the smaller of the two integrands is chosen. The first rules are
  /// chosen so that the error may come out below `goal`.
  OuterIntegral(const SightSpace& space, double free, double goal);

  Integrand integrand() const { return integrand_; }
  double value() const { return value_; }
  double error() const { return error_; }
  /// What rounding may have done to the value.
  double rounding() const { return rounding_; }
  int cells() const { return static_cast<int>(pieces_.size()); }
  int evaluations() const { return evaluations_; }
  bool exhausted() const;
  /// Whether cells are sampled that curves cross, or that were cut along their chords.
  bool curved() const;

  /// Refines all cells whose errors stand out, to bring the sum down to an eighth. value() and error() are those of the
  /// best state so far.
  void refine();

 private:
  struct Zone {
    ShadowView view;
    std::vector<Vec3> near;  ///< corners of all loops
    const SightZone* zone;
  };
  struct CutChord {
    EventCurve curve;
    double lost;  ///< what the form errs by between the two
  };
  struct Piece {
    Cell cell;
    std::size_t zone = 0;
    int nodes = 0;     ///< a side, of the rule that gave the value
    double free = 0;   ///< the factor without blockers, at the centre
    double decay = 1;  ///< by which coefficients fall from one degree to the next; 1 where that is not known
    double bend = 0;   ///< what a curve that the cell was cut along by its chord leaves, as a share of the spread
    std::vector<EventCurve> curves;  ///< that may cross the cell
    std::vector<CutChord> chords;    ///< along which it was cut, of curves that may still cross it
    double cut_stray = 0;    ///< what the form errs by between curves and the chords that the cell was cut along
    double curve_stray = 0;  ///< what the form seen from the centre errs by beyond the curves that cross the cell
    double stray = 0;        ///< both together; nothing where no form is used
    bool told = true;        ///< that is little: the centre tells of all of the cell
    std::size_t form = 0, form_end = 0;  ///< of what is hidden, seen from the centre: in forms_
    bool formed = false;                 ///< that form holds in all of the cell
    bool none = false;                   ///< seen from the centre, nothing is hidden
    bool all = false;                    ///< seen from the centre, everything is
    double hidden = 0;                   ///< factor of what is, at the centre
    std::array<double, 2> tails{};       ///< CellSum::tails
    double value = 0;
    double error = 0;
  };

  void add_zone(const SightSpace& space, std::size_t zone, double goal, double allowed);
  /// Cuts a piece along its curves, or halves it, `steps` times at most, and adds the parts.
  /// A piece needs no cut whose stray is below its share of `allowed`, by area.
  static void divide(Piece piece, int steps, double allowed, std::vector<Piece>& parts);
  void survey(Piece& piece);
  CellView view_of(const Piece& piece);
  std::span<const ViewCorner> form_of(const Piece& piece) const;
  void measure(Piece& piece, double share);
  void measure_analytic(Piece& piece, int nodes);
  void measure_any(Piece& piece, bool fresh);
  void sample(Piece& piece);
  void halve(std::size_t index, double share);
  double sum_of_errors() const;
  void note();

  std::vector<Zone> zones_;
  std::vector<Piece> pieces_;
  ViewForm forms_;
  Integrand integrand_ = Integrand::hidden;
  double value_ = 0, error_ = std::numeric_limits<double>::infinity();
  double rounding_ = 0;
  int evaluations_ = 0;
};

}  // namespace etendue
