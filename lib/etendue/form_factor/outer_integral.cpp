// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/outer_integral.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "etendue/core/rounding.hpp"

namespace etendue {

namespace {

/// Nodes a side; each rule is judged by its difference from the one before.
constexpr std::array<int, 6> kLadder{2, 3, 5, 8, 12, 17};
/// Point evaluations after which the integral is returned with the bound it has.
constexpr int kMostEvaluations = 400000;

/// The difference of two rules is the error of the coarser one, mostly a hundred times that of the finer; but it may
/// vanish by accident, so the highest coefficients that the finer rule resolves, which do not, keep it from below.
/// Measured over cells between random polygons: NOTES.md §5.
constexpr double kTailShare = 0.02;
constexpr double kSafety = 1.5;
/// In a cell that a curve crosses, the spread of the samples times this is the least error believed.
constexpr double kCurvedSpread = 0.02;

/// A chord of the cell along an event curve, and how far the curve leaves it compared with its length.
struct Chord {
  Vec2 normal;
  double level;
  double sag;
};

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
  const double sag = slope != 0 ? std::abs(curve.at(middle) / slope) : 1;
  return Chord{normal, normal.dot(middle), sag};
}

}  // namespace

OuterIntegral::OuterIntegral(const SightSpace& space, double free) {
  zones_.reserve(space.zones.size());
  for (const SightZone& zone : space.zones) {
    Zone made{ShadowView(space.receiver, zone.outlines), space.receiver, &zone};
    for (const Outline& outline : zone.outlines) made.near.insert(made.near.end(), outline.begin(), outline.end());
    zones_.push_back(std::move(made));
  }
  for (std::size_t z = 0; z < space.zones.size(); ++z) add_zone(space, z);
  // The smaller of the two integrals keeps the more digits; a look at the cells' centres decides.
  double hidden = 0;
  for (const Piece& piece : pieces_) {
    hidden += piece.cell.area() * zones_[piece.zone].view.from(piece.cell.centre(), ShadowView::Want::hidden).hidden;
    ++evaluations_;
  }
  bool dark = false;
  for (const SightZone& zone : space.zones) dark = dark || zone.dark;
  integrand_ = dark || hidden > 0.5 * free ? Integrand::visible : Integrand::hidden;
  for (Piece& piece : pieces_) measure(piece, true);

  double reach = 0, outline = 0, area = 0;
  for (const Zone& zone : zones_) {
    for (const Vec3& p : zone.near) reach = std::max(reach, p.norm());
    const std::vector<Vec2>& c = zone.zone->corners;
    for (std::size_t i = 0; i < c.size(); ++i) outline += (c[(i + 1) % c.size()] - c[i]).norm();
  }
  for (const Piece& piece : pieces_) area += piece.cell.area();
  constexpr double kRoundings = 64;  // Lambert's sums, and every corner moved by the turn into the frame
  rounding_ = kRoundings * kUnitRoundoff * (area + reach * outline);
}

void OuterIntegral::add_zone(const SightSpace& space, std::size_t index) {
  const SightZone& zone = space.zones[index];
  if (zone.dark) return;  // nothing is seen
  for (const Cell& cell : cells_between(zone.corners, critical_lines(space.receiver, zone))) {
    if (!(cell.area() > 0)) continue;
    add_cell(space, index, cell, event_curves(space.receiver, zone.outlines, cell), 0, 0);
  }
}

void OuterIntegral::add_cell(const SightSpace& space, std::size_t zone, const Cell& cell,
                             std::vector<EventCurve> curves, double bend, int depth) {
  constexpr int kDeepest = 8;
  constexpr double kStraight = 0.1;  // a curve that leaves its chord by less is cut along the chord
  std::erase_if(curves, [&](const EventCurve& curve) { return !curve.may_cross(cell); });
  if (curves.empty() || depth >= kDeepest) {
    if (!(cell.area() > 0)) return;
    Piece piece;
    piece.cell = cell;
    piece.zone = zone;
    piece.bend = bend;
    piece.curved = !curves.empty();
    pieces_.push_back(piece);
    return;
  }
  Cell::Halves halves;
  const auto chord = cell.size() < Cell::kMostCorners ? chord_of(curves.back(), cell) : std::nullopt;
  if (chord && chord->sag < kStraight) {
    halves = cell.cut(chord->normal, chord->level);
    bend += chord->sag * chord->sag * chord->sag;
    curves.pop_back();
  } else {
    const Vec2 across = cell.longest();
    halves = cell.cut(across, across.dot(cell.centre()));
  }
  for (const Cell* half : {&halves.above, &halves.below}) {
    if (half->size() >= 3) add_cell(space, zone, *half, curves, bend, depth + 1);
  }
}

void OuterIntegral::measure(Piece& piece, bool fresh) {
  Zone& zone = zones_[piece.zone];
  double before = piece.value;
  if (fresh) {
    const CellSum coarse = integrate(zone.view, integrand_, piece.cell, zone.near, kLadder[0]);
    evaluations_ += coarse.evaluations;
    before = coarse.value;
    piece.order = 0;
    if (coarse.low == 0 && coarse.high == 0 && zone.zone->outlines.size() == 1) {
      // One convex outline: what no point has seen hidden, between critical lines, nothing hides.
      piece.value = piece.error = 0;
      return;
    }
  }
  ++piece.order;
  const CellSum fine = integrate(zone.view, integrand_, piece.cell, zone.near, kLadder[piece.order]);
  evaluations_ += fine.evaluations;
  piece.value = fine.value;
  piece.error = kSafety * std::max(std::abs(fine.value - before), kTailShare * fine.tail);
  const double spread = (fine.high - fine.low) * piece.cell.area();
  piece.error = std::max(piece.error, piece.bend * spread);
  if (piece.curved) piece.error = std::max(piece.error, kCurvedSpread * spread);
}

double OuterIntegral::value() const {
  double sum = 0;
  for (const Piece& piece : pieces_) sum += piece.value;
  return sum;
}

double OuterIntegral::error() const {
  double sum = 0;
  for (const Piece& piece : pieces_) sum += piece.error;
  return sum;
}

bool OuterIntegral::exhausted() const {
  return evaluations_ >= kMostEvaluations || pieces_.empty();
}

void OuterIntegral::refine(double goal) {
  // Cells below their share cannot bring the sum down; all others are refined at once.
  const double share = goal / static_cast<double>(pieces_.size());
  const std::size_t count = pieces_.size();
  for (std::size_t i = 0; i < count && evaluations_ < kMostEvaluations; ++i) {
    Piece& piece = pieces_[i];
    if (piece.error <= share) continue;
    const bool smooth = !piece.curved && piece.error < 0.05 * piece.value && piece.order + 1 < kLadder.size();
    if (smooth) {
      measure(piece, false);
    } else {
      halve(i);
    }
  }
}

void OuterIntegral::halve(std::size_t index) {
  const Piece whole = pieces_[index];
  Vec2 across = whole.cell.longest();
  if (whole.cell.size() == 4) {
    // A square's diagonal makes slivers; its longer side halves it into rectangles.
    across = whole.cell[1] - whole.cell[0];
    for (int i = 1; i < 4; ++i) {
      const Vec2 side = whole.cell[(i + 1) % 4] - whole.cell[i];
      if (side.squaredNorm() > across.squaredNorm()) across = side;
    }
  }
  const Cell::Halves halves = whole.cell.cut(across, across.dot(whole.cell.centre()));
  bool first = true;
  for (const Cell* half : {&halves.above, &halves.below}) {
    if (half->size() < 3 || !(half->area() > 0)) continue;
    Piece piece;
    piece.cell = *half;
    piece.zone = whole.zone;
    piece.bend = whole.bend / 8;
    piece.curved = whole.curved;
    measure(piece, true);
    if (first) {
      pieces_[index] = piece;
    } else {
      pieces_.push_back(piece);
    }
    first = false;
  }
  if (first) pieces_[index].error = 0;  // lost in rounding
}

}  // namespace etendue
