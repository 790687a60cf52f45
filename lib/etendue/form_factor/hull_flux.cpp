// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/hull_flux.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "etendue/form_factor/certified_flux.hpp"

namespace etendue {

namespace {

/// What looking at one cell costs, in evaluations of an arc.
constexpr std::int64_t kCellWork = 3;
/// What enclosing the flux through one piece may cost: what needs more is cut instead.
constexpr std::int64_t kFluxWork = 128;
/// Of the goal, of what a cell leaves open anyway, and of what it hides: as much may a flux be unknown by.
constexpr double kFluxShare = 0.125, kOpenShare = 0x1p-4, kRelative = 0x1p-9;

double upper_area(const ReceiverPiece& piece) {
  return (Interval(0.5) * norm(doubled_area_of(EnclosedOutline(piece.begin(), piece.end())))).upper;
}

/// Lambert's sum at a point, enclosed.
Interval factor_from(const Interval3& x, const Interval3& unit_normal, const ReceiverPiece& piece) {
  Interval sum;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Interval3 p = Interval3(piece[i]) - x, q = Interval3(piece[(i + 1) % piece.size()]) - x;
    const Interval3 across = cross(q, p);
    const Interval sine = norm(across);
    sum = sum + angle(sine, dot(p, q)) * (dot(unit_normal, across) / sine);
  }
  return sum / (Interval(2) * pi());
}

/// Lower bound on the distance of two sets of points and all between them: along the line of their middles.
template <class A, class B>
double apart(const A& first, const B& second, double off) {
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();
  for (const Vec3& p : first) a += p / static_cast<double>(first.size());
  for (const Vec3& p : second) b += p / static_cast<double>(second.size());
  const Vec3 way = b - a;
  double low = way.dot(second[0] - a), high = way.dot(first[0] - a);
  for (const Vec3& p : second) low = std::min(low, way.dot(p - a));
  for (const Vec3& p : first) high = std::max(high, way.dot(p - a));
  constexpr double kRoom = 1 - 0x1p-40;  // for the rounding of the quotient, the rest is in `off`
  return (low - high) / way.norm() * kRoom - off;
}

/// Lambert's sum at a point in plain doubles: which cell to cut next, never a bound.
double rough_factor(const Vec3& x, const Vec3& normal, const ReceiverPiece& piece) {
  double sum = 0;
  for (std::size_t i = 0; i < piece.size(); ++i) {
    const Vec3 p = piece[i] - x, q = piece[(i + 1) % piece.size()] - x, c = q.cross(p);
    const double s = c.norm();
    if (s > 0) sum += std::atan2(s, p.dot(q)) * normal.dot(c) / s;
  }
  constexpr double kHalfTurn = 6.283185307179586;
  return std::max(0.0, std::abs(sum) / kHalfTurn);
}

/// One triangle of the source, one part of the receiver.
class HullFlux {
 public:
  HullFlux(const ReceiverPiece& source, const ReceiverPiece& receiver, const std::vector<HullBlocker>& blockers,
           double reach, double goal, std::int64_t budget)
      : receiver_(receiver), blockers_(blockers), reach_(reach), goal_(goal), budget_(budget) {
    for (std::size_t k = 0; k < 3; ++k) source_[k] = Interval3(source[k]);
    const Interval3 normal = cross(source_[1] - source_[0], source_[2] - source_[0]);
    area_ = Interval(0.5) * norm(normal);
    unit_normal_ = (Interval(1) / norm(normal)) * normal;
    normal_ = normal.middle().normalized();
    for (std::size_t i = 1; i + 1 < receiver.size(); ++i) {
      receiver_normal_ += (receiver[i] - receiver[0]).cross(receiver[i + 1] - receiver[0]);
    }
    receiver_normal_.normalize();
    // Corners of pieces lie between the receiver's but for the rounding of cuts.
    for (const Vec3& v : receiver)
      receiver_off_ = std::max(receiver_off_, std::abs(receiver_normal_.dot(v - receiver[0])));
    receiver_off_ += 2 * kHeightRounding * reach;
  }

  HiddenFlux enclose() {
    add({{{0, 0}, {1, 0}, {0, 1}}});
    while (work_ < budget_ && 0.5 * open_ > goal_ && !heap_.empty()) {
      std::pop_heap(heap_.begin(), heap_.end());
      const Cell cell = heap_.back();
      heap_.pop_back();
      open_ = std::max(0.0, open_ - cell.flux.width());
      const auto& c = cell.corners;
      const std::array<Vec2, 3> m{0.5 * (c[1] + c[2]), 0.5 * (c[2] + c[0]), 0.5 * (c[0] + c[1])};
      add({c[0], m[2], m[1]});
      add({m[2], c[1], m[0]});
      add({m[1], m[0], c[2]});
      add({m[0], m[1], m[2]});
    }
    Interval flux(-slivers_, slivers_);
    for (const Cell& cell : heap_) flux = flux + cell.flux;
    return {{std::max(0.0, flux.lower), std::max(0.0, flux.upper)}, work_};
  }

 private:
  using Corners = std::array<Vec2, 3>;
  struct Cell {
    Corners corners;
    Interval flux;
    bool operator<(const Cell& other) const { return flux.width() < other.flux.width(); }
  };

  Interval3 at(const Vec2& uv) const {
    return source_[0] + Interval(uv.x()) * (source_[1] - source_[0]) + Interval(uv.y()) * (source_[2] - source_[0]);
  }
  std::array<Vec3, 3> placed(const Corners& c) const {
    return {at(c[0]).middle(), at(c[1]).middle(), at(c[2]).middle()};
  }
  /// Share of the source: dyadic, exact.
  static double share(const Corners& c) {
    return std::abs((c[1].x() - c[0].x()) * (c[2].y() - c[0].y()) - (c[1].y() - c[0].y()) * (c[2].x() - c[0].x()));
  }

  void add(const Corners& place) {
    work_ += kCellWork;
    const std::array<Vec3, 3> corners = placed(place);
    ShadowHulls hulls(corners, blockers_, reach_);
    const std::vector<ReceiverPiece> outer = hulls.outer(receiver_);
    Cell cell{place, Interval()};
    if (!outer.empty()) cell.flux = enclosed(place, corners, outer, hulls.inner(receiver_));
    slivers_ = above(slivers_ + hulls.slivers());
    if (cell.flux.upper == 0) return;
    open_ += cell.flux.width();
    heap_.push_back(cell);
    std::push_heap(heap_.begin(), heap_.end());
  }

  Interval enclosed(const Corners& place, const std::array<Vec3, 3>& corners, const std::vector<ReceiverPiece>& outer,
                    const std::vector<ReceiverPiece>& inner) {
    EnclosedPair pair;
    pair.from = {at(place[0]), at(place[1]), at(place[2])};
    pair.area = Interval(share(place)) * area_;
    const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3;
    double hidden = 0, open = 0;
    for (const ReceiverPiece& piece : outer) open += rough_factor(middle, normal_, piece);
    for (const ReceiverPiece& piece : inner) hidden += rough_factor(middle, normal_, piece);
    const double rough = std::max(kOpenShare * (open - hidden), kRelative * hidden) * pair.area.upper;
    const double wanted = std::max(kFluxShare * goal_ * share(place), rough);
    double least = 0, most = 0;
    for (const ReceiverPiece& piece : outer) most = above(most + through(pair, corners, piece, wanted).upper);
    for (const ReceiverPiece& piece : inner)
      least = std::max(0.0, below(least + through(pair, corners, piece, wanted).lower));
    most = std::min(most, pair.area.upper);
    return {std::min(least, most), most};
  }

  /// From the middle of the cell: there the linear part of the density cancels, and its curvature is bounded by itself.
  /// NOTES.md §14.
  Interval by_middle(const EnclosedPair& pair, const std::array<Vec3, 3>& corners, const ReceiverPiece& piece) {
    work_ += static_cast<std::int64_t>(piece.size());
    const double room = kHeightRounding * reach_;
    const double distance = apart(corners, piece, room);
    double height = std::numeric_limits<double>::infinity(), radius = 0;
    const Vec3 centre = (corners[0] + corners[1] + corners[2]) / 3;
    for (const Vec3& x : corners) {
      height = std::min(height, receiver_normal_.dot(x - receiver_[0]) - room);
      radius = std::max(radius, (x - centre).norm() + room);
    }
    if (!(distance > 0 && height > 0)) return Interval::everything();
    const Interval d(distance), h(height);
    const double growth = (Interval(radius) * (Interval(4) / d + Interval(1) / h)).upper;
    if (!(growth <= 1)) return Interval::everything();
    constexpr double kE = 2.7182818284590455;  // above e; e^x ≤ 1 + (e − 1) x up to 1
    Interval sides, around;
    for (std::size_t k = 0; k < 3; ++k) sides = sides + square(pair.from[(k + 1) % 3] - pair.from[k]);
    for (std::size_t i = 0; i < piece.size(); ++i) {
      around = around + norm(Interval3(piece[(i + 1) % piece.size()]) - Interval3(piece[i]));
    }
    const Interval3 middle = (Interval(1) / Interval(3)) * (pair.from[0] + pair.from[1] + pair.from[2]);
    const Interval factor = factor_from(middle, unit_normal_, piece);
    const Interval flat = around * receiver_off_, seen = flat / (pi() * square(d));
    const Interval most = (max(factor, Interval()) + seen) * (Interval(1) + Interval(kE - 1) * growth);
    const Interval bend = most * (Interval(10) / square(d) + Interval(4) / (d * h)) * sides / Interval(36);
    const double error = (pair.area * (bend + seen) + flat).upper;
    return pair.area * factor + Interval(-error, error);
  }

  Interval through(EnclosedPair& pair, const std::array<Vec3, 3>& corners, const ReceiverPiece& piece, double wanted) {
    const double most = std::min(upper_area(piece), pair.area.upper);
    if (most <= 0.5 * wanted) return {0, most};
    Interval flux = by_middle(pair, corners, piece);
    flux = {std::clamp(flux.lower, 0.0, most), std::clamp(flux.upper, 0.0, most)};
    if (flux.width() <= wanted || work_ >= budget_) return flux;
    pair.to = EnclosedOutline(piece.begin(), piece.end());
    const CertifiedFactor factor = enclosed_factor(pair, {{0, wanted / pair.area.upper}, kFluxWork});
    work_ += factor.work;
    const Interval other = factor.factor * pair.area;
    return {std::max(flux.lower, other.lower), std::min(flux.upper, other.upper)};
  }

  std::array<Interval3, 3> source_;
  const ReceiverPiece& receiver_;
  const std::vector<HullBlocker>& blockers_;
  double reach_, goal_;
  std::int64_t budget_;
  Interval area_;
  Interval3 unit_normal_;
  Vec3 normal_, receiver_normal_ = Vec3::Zero();
  double receiver_off_ = 0;  ///< how far a piece's corner may be off the plane through the receiver's first
  std::vector<Cell> heap_;
  double open_ = 0, slivers_ = 0;
  std::int64_t work_ = 0;
};

}  // namespace

HullPair::HullPair(const EnclosedPair& pair, const ExactPlane& from, const ExactPlane& to)
    : from_(from),
      to_(to),
      sources_(rounded(signed_triangles(pair.from), swept_)),
      receivers_(rounded(signed_parts(pair.to), swept_)) {
  // At most so much for each part of the other.
  swept_ = above(swept_ * static_cast<double>(sources_.size() * receivers_.size()));
}

std::vector<HullPair::Part> HullPair::rounded(const std::vector<SignedPart>& parts, double& swept) {
  std::vector<Part> result;
  for (const SignedPart& part : parts) {
    Part middles{{}, part.sign};
    Interval moved, length;
    for (std::size_t i = 0; i < part.outline.size(); ++i) {
      const Interval3& v = part.outline[i];
      middles.corners.push_back(v.middle());
      moved = max(moved, norm(v - Interval3(middles.corners.back())));
      length = length + norm(part.outline[(i + 1) % part.outline.size()] - v);
    }
    swept = above(swept + above(part.uncertain + (Interval(2) * moved * (length + Interval(8) * moved)).upper));
    result.push_back(std::move(middles));
  }
  return result;
}

double HullPair::reach_with(std::span<const std::vector<Vec3>> blockers) const {
  double reach = 0;
  const auto count = [&reach](const std::vector<Vec3>& points) {
    for (const Vec3& p : points) reach = std::max(reach, p.cwiseAbs().maxCoeff());
  };
  for (const std::vector<Part>* parts : {&sources_, &receivers_}) {
    for (const Part& part : *parts) count(part.corners);
  }
  for (const std::vector<Vec3>& blocker : blockers) count(blocker);
  return reach;
}

std::optional<double> HullPair::lost_past(const std::vector<Vec3>& blocker) const {
  const double reach = reach_with({&blocker, 1});
  // What is well apart is shown to be without a loss.
  for (const double distance : {0.0, kDrawnIn * reach}) {
    const std::vector<HullBlocker> one{hull_blocker(blocker, from_, to_, distance)};
    if (one.front().front.empty()) return 0.0;
    if (const auto lost = lost_past(one, reach)) return lost;
  }
  return std::nullopt;
}

std::optional<double> HullPair::lost_past(const std::vector<HullBlocker>& one, double reach) const {
  double lost = 0;
  for (const Part& source : sources_) {
    const std::array<Vec3, 3> cell{source.corners[0], source.corners[1], source.corners[2]};
    for (const Part& receiver : receivers_) {
      ShadowHulls hulls(cell, one, reach);
      if (!hulls.outer(receiver.corners).empty()) return std::nullopt;
      lost = above(lost + above(one.front().lost + hulls.slivers()));
    }
  }
  return above(lost + swept_);
}

HiddenFlux HullPair::hidden_flux(const std::vector<std::vector<Vec3>>& blockers, double goal,
                                 std::int64_t budget) const {
  const double reach = reach_with(blockers);
  std::vector<HullBlocker> hulls;
  double lost = 0;
  for (const auto& corners : blockers) {
    HullBlocker blocker = hull_blocker(corners, from_, to_, kDrawnIn * reach);
    if (blocker.front.empty()) continue;
    lost = above(lost + blocker.lost);
    hulls.push_back(std::move(blocker));
  }
  const auto pieces = static_cast<double>(sources_.size() * receivers_.size());
  const auto share = std::max<std::int64_t>(1, static_cast<std::int64_t>(static_cast<double>(budget) / pieces));
  HiddenFlux total;
  for (const Part& source : sources_) {
    for (const Part& receiver : receivers_) {
      const HiddenFlux one = HullFlux(source.corners, receiver.corners, hulls, reach, goal / pieces, share).enclose();
      const Interval flux = one.flux + Interval(0, lost);
      total.flux = source.sign * receiver.sign > 0 ? total.flux + flux : total.flux - flux;
      total.work += one.work;
    }
  }
  total.flux = total.flux + Interval(-swept_, swept_);
  return total;
}

}  // namespace etendue
