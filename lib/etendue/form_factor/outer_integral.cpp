// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/outer_integral.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/chord.hpp"
#include "etendue/form_factor/near_edges.hpp"

namespace etendue {

namespace {

/// Point evaluations after which the integral is returned with the bound it has.
constexpr int kMostEvaluations = 400000;
/// Of what is asked, the most that a strip beside a near edge may hold without being cut further.
constexpr double kNegligible = 1.0 / 64;
/// Of the free integral: strips are not made finer for less, where rounding and the work limit come first.
constexpr double kLeastGoal = 1e-10;

// A cell on which the integrand is analytic: NOTES.md §5 has the estimate, and how these numbers were measured.

/// Coefficients are not believed to fall faster than this from one degree to the next.
constexpr double kLeastDecay = 1.0 / 16;
/// With two nodes a side the estimate counts by so much.
constexpr double kTwoNodes = 8;
/// The last coefficient counts by so much where a quadrilateral of the cell is collapsed to a triangle: what is seen may grow
/// from the corner on by high powers, and the stretch of the rule takes one of its degrees.
constexpr double kTriangle = 4;
/// Least quotient of the distance of the nearest singularity and the cell's radius at which rules converge fast.
constexpr double kLeastReach = 1.25;
constexpr int kMostNodes = 8;
/// Of the way to two of its corners: as far beside a cell's middle it is looked at. From the middle itself, in scenes on
/// a grid, edges meet in the view that have nothing to do with one another, and no name of such a corner holds around it.
constexpr double kAside = 0x1p-28;
/// Edges that this share of the radius brings together are one but for rounding, as the edge that two plates share.
constexpr double kDistinct = 0x1p-20;

// Any other cell.

/// Nodes a side; each rule is judged by its difference from the one before.
constexpr std::array<int, 6> kLadder{2, 3, 5, 8, 12, 17};
/// The difference of two rules is the error of the coarser one, mostly a hundred times that of the finer; but it may
/// vanish by accident, so the highest coefficients that the finer rule resolves, which do not, keep it from below.
constexpr double kTailShare = 0.02;
constexpr double kSafety = 3;
/// Of the first two rules.
constexpr double kFirstSafety = 10;
/// By how much the coefficients along two sides must differ for a cell to be cut by them instead of by its shape.
constexpr double kRougher = 4;
/// A cell with a larger share of error than this is halved instead of getting more nodes.
constexpr double kSmooth = 0.2;
/// In a cell that a curve crosses, this share of the samples' spread, and of what the curve may uncover, is the least error
/// believed: beyond a curve that no node lies beyond is less than the outermost 0.22 of the cell, where what it uncovers
/// grows with the square of the distance, to 0.22³/3 = 0.004 of what the whole cell could hold.
constexpr double kCurvedSpread = 0.02;

/// How often a cell is halved at first where curves cross it, and how far a curve may leave its chord, as a share of the
/// chord, when the cell is cut along that.
constexpr int kMostSteps = 8;
constexpr double kStraight = 0.1;
/// Of what is asked, the share that forms may err by which hold beside curves only.
constexpr double kStrayShare = 0.25;
/// A cell is halved once more where that makes its form good enough: halves err by 64 times less than the whole.
constexpr double kFarFrom = 64 * 64;
constexpr int kMoreSteps = 3;

double area_of(std::span<const Vec2> corners) {
  double area = 0;
  for (const Cell& cell : Cell::from(corners)) area += cell.area();
  return area;
}

}  // namespace

OuterIntegral::OuterIntegral(const SightSpace& space, double free, double goal) {
  zones_.reserve(space.zones.size());
  for (const SightZone& zone : space.zones) {
    Zone made{ShadowView(space.receiver, zone.outlines), space.receiver, &zone};
    for (const Outline& outline : zone.outlines) made.near.insert(made.near.end(), outline.begin(), outline.end());
    zones_.push_back(std::move(made));
  }
  double source = 0;
  for (const SightZone& zone : space.zones) source += area_of(zone.corners);
  for (std::size_t z = 0; z < space.zones.size(); ++z)
    add_zone(space, z, std::max(goal, kLeastGoal * free), kStrayShare * goal / source);
  // The smaller of the two integrals keeps the more digits; a look at the cells' centres decides.
  // A zone without outlines sees all.
  const auto open = [&](const Piece& piece) { return zones_[piece.zone].zone->outlines.empty(); };
  double hidden = 0;
  for (Piece& piece : pieces_) {
    piece.none = open(piece);
    if (!piece.none) survey(piece);
    hidden += piece.cell.area() * piece.hidden;
  }
  bool dark = false;
  for (const SightZone& zone : space.zones) dark = dark || zone.dark;
  integrand_ = dark || hidden > 0.5 * free ? Integrand::visible : Integrand::hidden;
  const double share = goal / static_cast<double>(pieces_.size());
  for (Piece& piece : pieces_) {
    if (integrand_ == Integrand::visible && open(piece)) survey(piece);
    measure(piece, share);
  }
  note();

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

void OuterIntegral::add_zone(const SightSpace& space, std::size_t index, double goal, double allowed) {
  const SightZone& zone = space.zones[index];
  if (zone.dark) return;  // nothing is seen
  LoopSides sides(space.receiver, zone);
  const EventCurves curves(sides);
  const NearEdges near(space.receiver, zone, kNegligible * goal);
  const std::vector<Cell> cells = near.graded(cells_between(zone.corners, critical_lines(sides)));
  pieces_.reserve(pieces_.size() + cells.size());
  for (const Cell& cell : cells) {
    Piece piece;
    piece.cell = cell;
    piece.zone = index;
    piece.curves = curves.across(cell);
    divide(std::move(piece), kMostSteps, allowed, pieces_);
  }
}

void OuterIntegral::divide(Piece piece, int steps, double allowed, std::vector<Piece>& parts) {
  if (piece.cell.size() < 3 || !(piece.cell.area() > 0)) return;
  std::erase_if(piece.curves, [&](const EventCurve& curve) { return !curve.may_cross(piece.cell); });
  // Beside a chord that is not its own a part has nothing to lose.
  std::erase_if(piece.chords, [&](const CutChord& chord) { return !chord.curve.may_cross(piece.cell); });
  piece.cut_stray = 0;
  for (const CutChord& chord : piece.chords) piece.cut_stray += chord.lost;
  const double most = allowed * piece.cell.area();
  piece.curve_stray = 0;
  for (const EventCurve& curve : piece.curves) piece.curve_stray += curve.stray(piece.cell);
  piece.stray = piece.cut_stray + piece.curve_stray;
  piece.told = piece.stray <= most;
  if (piece.told || piece.curves.empty() || steps == 0) {
    parts.push_back(std::move(piece));
    return;
  }
  const bool room = piece.cell.size() < Cell::kMostCorners;
  const EventCurve& curve = piece.curves.back();
  const auto chord = room ? chord_of(curve, piece.cell) : std::nullopt;
  Cell::Halves halves;
  const double lost = chord ? curve.gap(chord->value, piece.cell) * chord->sag * chord->length * chord->length : 0;
  const bool worth_halving = steps > kMostSteps - kMoreSteps && lost > most && lost <= kFarFrom * most;
  if (chord && chord->sag < kStraight && !worth_halving) {
    halves = piece.cell.cut(chord->normal, chord->level);
    piece.bend += chord->sag * chord->sag * chord->sag;
    piece.chords.push_back({curve, lost});
    piece.curves.pop_back();
  } else {
    const Vec2 across = piece.cell.longest();
    halves = piece.cell.cut(across, across.dot(piece.cell.centre()));
  }
  for (const Cell* half : {&halves.above, &halves.below}) {
    Piece part = piece;
    part.cell = *half;
    divide(std::move(part), steps - 1, allowed, parts);
  }
}

void OuterIntegral::survey(Piece& piece) {
  const Vec2 middle = piece.cell.centre();
  const Vec2 centre = middle + kAside * (0.6 * (piece.cell[0] - middle) + 0.3 * (piece.cell[1] - middle));
  double radius = 0;
  for (int i = 0; i < piece.cell.size(); ++i) radius = std::max(radius, (piece.cell[i] - centre).norm());
  piece.form = forms_.size();
  const ShadowView::Survey survey = zones_[piece.zone].view.survey(centre, forms_);
  piece.form_end = forms_.size();
  ++evaluations_;
  piece.free = survey.free;
  piece.hidden = survey.hidden;
  piece.none = survey.none;
  piece.all = survey.all;
  const auto keeps = [&] {
    return survey.to_crossings > kDistinct * radius &&
           keeps_sides(zones_[piece.zone].view.edges(), form_of(piece), centre, piece.cell.corners());
  };
  piece.formed = piece.told && (survey.to_crossings >= kLeastReach * radius || keeps());
  const double reach = std::min(survey.to_edges, survey.to_crossings) / radius;
  const bool analytic = piece.formed && reach >= kLeastReach;
  piece.decay = analytic ? std::max(kLeastDecay, 1 / (reach + std::sqrt(reach * reach - 1))) : 1;
}

// What is true of the centre, that nothing is hidden or that all is, is true of a cell that no line and no curve crosses.
void OuterIntegral::measure(Piece& piece, double share) {
  const bool settled = piece.told && (integrand_ == Integrand::hidden ? piece.none : piece.all);
  piece.formed = piece.formed || settled;
  if (!piece.formed) piece.stray = 0;
  if (settled) {
    piece.value = piece.error = 0;
  } else if (piece.decay < 1) {
    const double rough = kTwoNodes * piece.free * piece.cell.area() * std::pow(piece.decay, 3);
    measure_analytic(piece, rough <= share ? 2 : 3);
    if (piece.nodes == 2 && piece.error > share) measure_analytic(piece, 3);
  } else {
    measure_any(piece, true);
  }
}

CellView OuterIntegral::view_of(const Piece& piece) {
  ShadowView& view = zones_[piece.zone].view;
  if (!piece.formed) return {view, integrand_};
  return {view, integrand_, form_of(piece)};
}

std::span<const ViewCorner> OuterIntegral::form_of(const Piece& piece) const {
  return std::span(forms_).subspan(piece.form, piece.form_end - piece.form);
}

void OuterIntegral::measure_analytic(Piece& piece, int nodes) {
  const CellSum sum = integrate(view_of(piece), piece.cell, zones_[piece.zone].near, nodes);
  evaluations_ += sum.evaluations;
  const double decay = piece.decay, smooth = piece.free * piece.cell.area() * std::pow(decay, 2 * nodes);
  if (nodes > 2) {
    const double last = piece.cell.size() % 2 == 0 ? sum.tail : kTriangle * sum.tail;
    piece.error = std::max(smooth, last * decay * decay * decay);
  } else {
    const double centre = (integrand_ == Integrand::hidden ? piece.hidden : piece.free - piece.hidden);
    const double difference = std::abs(sum.value - centre * piece.cell.area());
    piece.error = kTwoNodes * std::max(smooth, std::max(sum.tail, difference) * decay * decay);
  }
  piece.value = sum.value;
  piece.nodes = nodes;
}

void OuterIntegral::measure_any(Piece& piece, bool fresh) {
  const CellView view = view_of(piece);
  const std::vector<Vec3>& near = zones_[piece.zone].near;
  double before = piece.value;
  if (fresh) {
    const CellSum coarse = integrate(view, piece.cell, near, kLadder[0]);
    evaluations_ += coarse.evaluations;
    before = coarse.value;
    piece.nodes = kLadder[0];
  }
  piece.nodes = *std::upper_bound(kLadder.begin(), kLadder.end(), piece.nodes);
  const CellSum fine = integrate(view, piece.cell, near, piece.nodes);
  evaluations_ += fine.evaluations;
  piece.value = fine.value;
  piece.tails = fine.tails;
  const double safety = piece.nodes == kLadder[1] ? kFirstSafety : kSafety;
  piece.error = safety * std::max(std::abs(fine.value - before), kTailShare * fine.tail);
  piece.error = std::max(piece.error, kSafety * unseen_at_ends(view, piece.cell, fine, piece.error, evaluations_));
  const double spread = (fine.high - fine.low) * piece.cell.area();
  if (piece.formed) return;
  piece.error = std::max({piece.error, piece.cut_stray, piece.bend * spread});
  if (!piece.curves.empty()) piece.error = std::max(piece.error, kCurvedSpread * std::max(spread, piece.curve_stray));
}

double OuterIntegral::sum_of_errors() const {
  double sum = 0;
  for (const Piece& piece : pieces_) sum += piece.error + piece.stray;
  return sum;
}

bool OuterIntegral::exhausted() const {
  return evaluations_ >= kMostEvaluations || pieces_.empty();
}

bool OuterIntegral::curved() const {
  return std::any_of(pieces_.begin(), pieces_.end(),
                     [](const Piece& piece) { return !piece.formed && (piece.bend > 0 || !piece.curves.empty()); });
}

void OuterIntegral::refine() {
  // Cells below their share cannot bring the sum down; all others are refined at once. The steps know nothing of what is
  // asked in the end: who asks for more goes the same way, farther, and where the work ends gets what was best on it.
  constexpr double kStep = 1.0 / 8;
  const double share = kStep * sum_of_errors() / static_cast<double>(pieces_.size());
  const std::size_t count = pieces_.size();
  for (std::size_t i = 0; i < count && evaluations_ < kMostEvaluations; ++i) {
    Piece& piece = pieces_[i];
    if (piece.error + piece.stray <= share) continue;
    if (piece.formed && piece.stray > kStrayShare * share && piece.curves.empty()) {
      sample(piece);
      continue;
    }
    const bool keeps_chords = std::max(piece.stray, piece.cut_stray) <= kStrayShare * share;
    if (keeps_chords && piece.decay < 1) {
      int nodes = piece.nodes + 1;
      while (nodes < kMostNodes && piece.error * std::pow(piece.decay, 2 * (nodes - piece.nodes)) > share) ++nodes;
      if (piece.error * std::pow(piece.decay, 2 * (nodes - piece.nodes)) <= share && nodes <= kMostNodes) {
        measure_analytic(piece, nodes);
        continue;
      }
    } else if (keeps_chords && (piece.formed || piece.curves.empty()) && piece.error < kSmooth * piece.value &&
               piece.nodes < kLadder.back()) {
      measure_any(piece, false);
      continue;
    }
    halve(i, share);
  }
  note();
}

/// What the form does not tell exactly enough is cut anew at every node.
void OuterIntegral::sample(Piece& piece) {
  piece.formed = piece.told = false;
  piece.decay = 1;
  piece.stray = 0;
  measure_any(piece, true);
}

void OuterIntegral::note() {
  const double error = sum_of_errors();
  if (error > error_) return;
  error_ = error;
  value_ = 0;
  for (const Piece& piece : pieces_) value_ += piece.value;
}

void OuterIntegral::halve(std::size_t index, double share) {
  Piece whole = pieces_[index];
  std::vector<Piece> parts;
  const double allowed = kStrayShare * share / whole.cell.area();
  const bool recut = whole.cut_stray > kStrayShare * share;
  if (recut) {
    // Cut along chords for a looser goal than there is now: from the curves again, in halves, so that chords are shorter.
    for (const CutChord& chord : whole.chords) whole.curves.push_back(chord.curve);
    whole.chords.clear();
    whole.bend = 0;
  }
  if (!recut && !whole.curves.empty() && !(whole.told && whole.stray <= kStrayShare * share)) {
    divide(std::move(whole), 1, allowed, parts);
  } else {
    Vec2 across = whole.cell.longest();
    if (!recut && whole.cell.size() == 4) {
      // Across the sides along which the integrand is the rougher; else across the longer ones.
      const Vec2 along = whole.cell[1] - whole.cell[0] + whole.cell[2] - whole.cell[3];
      const Vec2 up = whole.cell[3] - whole.cell[0] + whole.cell[2] - whole.cell[1];
      const bool longer = along.squaredNorm() > up.squaredNorm();
      const auto [first, second] = whole.tails;
      across = first > kRougher * second || (longer && second <= kRougher * first) ? along : up;
    }
    const Cell::Halves halves = whole.cell.cut(across, across.dot(whole.cell.centre()));
    whole.bend /= 8;
    for (const Cell* half : {&halves.above, &halves.below}) {
      Piece part = whole;
      part.cell = *half;
      divide(std::move(part), recut ? kMostSteps : 0, allowed, parts);
    }
  }
  for (Piece& part : parts) {
    survey(part);
    measure(part, share);
  }
  pieces_[index].value = pieces_[index].error = pieces_[index].stray = 0;  // where rounding has lost both
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (k == 0) {
      pieces_[index] = std::move(parts[0]);
    } else {
      pieces_.push_back(std::move(parts[k]));
    }
  }
}

}  // namespace etendue
