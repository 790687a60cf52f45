// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/polygon_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/area_rule.hpp"
#include "etendue/form_factor/contour.hpp"
#include "etendue/form_factor/facing_pair.hpp"

namespace etendue {

namespace {

std::vector<Vec3> shifted(const std::vector<Vec3>& vertices, const Vec3& offset) {
  std::vector<Vec3> result;
  result.reserve(vertices.size());
  for (const Vec3& v : vertices) result.push_back(v + offset);
  return result;
}

/// A first idea of 2π A_1 F, good to a small factor: sets the goal of the quadrature, never a bound.
double rough_size(const Loop& from, const Loop& to, const Vec3& offset) {
  Vec3 centre_1 = Vec3::Zero(), centre_2 = Vec3::Zero();
  for (const Vec3& v : from.vertices) centre_1 += v / static_cast<double>(from.vertices.size());
  for (const Vec3& v : to.vertices) centre_2 += v / static_cast<double>(to.vertices.size());
  const Vec3 r = offset + (centre_2 - centre_1);
  const double square = r.squaredNorm();
  const double cosines = std::abs(r.dot(from.normal)) * std::abs(r.dot(to.normal)) / square;
  const double kernel = cosines * from.area * to.area / square;
  return 2 * std::min(kernel, std::numbers::pi * std::min(from.area, to.area));
}

/// Kernel evaluations up to which the area rule is cheaper than the contour.
constexpr double kCheapArea = 1500;
/// Kernel evaluations up to which it is preferred to cutting the pair into smaller ones.
constexpr double kCostlyArea = 10000;
/// The least rounding that a contour can have, per product of the perimeters; decides only what is tried.
constexpr double kContourTerms = 4 * kUnitRoundoff;
/// Pieces into which a pair may be cut for every factor of ten by which the whole contour misses its goal, and at most.
constexpr double kPiecesPerFactor = 64;
constexpr double kMostPieces = 20000;

double perimeter(const std::vector<Vec3>& v) {
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i) sum += (v[(i + 1) % v.size()] - v[i]).norm();
  return sum;
}

Loop with_vertices(const Loop& loop, std::vector<Vec3> vertices) {
  Loop part = make_loop(std::move(vertices));
  part.normal = loop.normal;
  part.flatness = std::max(part.flatness, loop.flatness);
  return part;
}

/// What of a + b the rounded middle misses.
double middle_error(const Vec3& a, const Vec3& b, const Vec3& middle) {
  const Vec3 doubled = 2 * middle;
  const Vec3 part = doubled - a;
  return 0.5 * ((a - (doubled - part)) + (b - part)).norm();
}

struct Halves {
  std::vector<Loop> parts;
  double swept = 0;  ///< bound on the area between the loop and its parts' outline
};

/// The two halves of a loop, cut across its longest edge: quadrilaterals between the middles of opposite edges.
Halves halves(const Loop& loop) {
  const auto& v = loop.vertices;
  const std::size_t n = v.size();
  std::size_t i = 0;
  for (std::size_t k = 1; k < n; ++k) {
    if ((v[(k + 1) % n] - v[k]).squaredNorm() > (v[(i + 1) % n] - v[i]).squaredNorm()) i = k;
  }
  const Vec3& a = v[i];
  const Vec3& b = v[(i + 1) % n];
  const Vec3& c = v[(i + 2) % n];
  const Vec3& d = v[(i + 3) % n];
  Halves result;
  if (n <= 4) {
    const Vec3 middle = 0.5 * (a + b);
    const Vec3 opposite = n == 3 ? c : Vec3(0.5 * (c + d));
    result.swept = middle_error(a, b, middle) * (b - a).norm();
    if (n == 3) {
      result.parts = {with_vertices(loop, {a, middle, c}), with_vertices(loop, {middle, b, c})};
    } else {
      result.swept += middle_error(c, d, opposite) * (d - c).norm();
      result.parts = {with_vertices(loop, {a, middle, opposite, d}), with_vertices(loop, {middle, b, c, opposite})};
    }
    return result;
  }
  const Vec3 centre = mean(v);
  std::vector<double> heights;
  double reach = 0;
  for (const Vec3& p : v) {
    heights.push_back((p - centre).dot(b - a));
    reach = std::max(reach, p.norm());
  }
  constexpr double kCutRoundings = 8;
  result.swept = kCutRoundings * kUnitRoundoff * reach * perimeter(v);
  for (int side = 0; side < 2; ++side) {
    std::vector<Vec3> part = clip(v, heights);
    if (!part.empty()) result.parts.push_back(with_vertices(loop, std::move(part)));
    for (double& h : heights) h = -h;
  }
  return result;
}

/// 2π A_1 F of a pair, by whichever method keeps its digits; pairs that none serves are cut in two.
class PairIntegral {
 public:
  PairIntegral(const FacingPair& pair, double budget) : offset_(pair.offset), budget_(budget) {}

  QuadratureSum integrate(const Loop& from, const Loop& to, double goal, int depth = 0) {
    ++pieces_;
    if (auto area = double_area(from, to, offset_, goal, kCheapArea)) return *area;
    const bool last = pieces_ > budget_ || depth >= kDeepest;
    if (last || kContourTerms * perimeter(from.vertices) * perimeter(to.vertices) <= goal) {
      const QuadratureSum sum = double_contour(from.vertices, shifted(to.vertices, offset_), goal);
      if (last || sum.rounding <= kRoundingShare * goal) return sum;
    }
    if (auto area = double_area(from, to, offset_, goal, kCostlyArea)) return *area;
    const bool cut_from = radius(from.vertices) > radius(to.vertices);
    const Loop& whole = cut_from ? from : to;
    // Two new corners are off their edges by the rounding of a middle; what is swept sees at most all of the other, and
    // at a distance no more than area/(π gap²) of it.
    const double gap = least_distance(from, to, offset_);
    const double seen = std::min(std::numbers::pi, (cut_from ? to : from).area / (gap * gap));
    Halves cut = halves(whole);
    QuadratureSum sum;
    sum.rounding = 2 * seen * cut.swept;
    for (const Loop& half : cut.parts) {
      const QuadratureSum part =
          cut_from ? integrate(half, to, 0.5 * goal, depth + 1) : integrate(from, half, 0.5 * goal, depth + 1);
      sum.value += part.value;
      sum.truncation += part.truncation;
      sum.rounding += part.rounding;
    }
    return sum;
  }

 private:
  static constexpr double kRoundingShare = 2;
  static constexpr int kDeepest = 64;  // halvings in turn: beyond, pieces are lost in the rounding of their corners
  Vec3 offset_;
  double budget_;
  int pieces_ = 0;
};

/// What is asked of 2π A_1 F.
struct Goal {
  double relative;
  double absolute;

  double at(double size) const { return std::max(absolute, relative * std::abs(size)); }
};

QuadratureSum integrate(const FacingPair& pair, double goal, const Goal& asked) {
  if (auto area = double_area(pair.from, pair.to, pair.offset, goal, kCheapArea)) return *area;
  const QuadratureSum whole = double_contour(pair.from.vertices, shifted(pair.to.vertices, pair.offset), goal);
  const double reached = asked.at(whole.value);
  if (whole.truncation + whole.rounding <= reached || whole.truncation > whole.rounding) return whole;
  const double budget = std::min(kMostPieces, kPiecesPerFactor * whole.rounding / reached);
  const QuadratureSum cut = PairIntegral(pair, budget).integrate(pair.from, pair.to, std::max(goal, 0.25 * reached));
  return cut.truncation + cut.rounding < whole.truncation + whole.rounding ? cut : whole;
}

constexpr int kFinalRoundings = 8;  // the area, its product with 2π, the division

}  // namespace

Bounded form_factor(const Polygon& from, const Polygon& to, Tolerance tolerance) {
  require(tolerance.relative >= 0 && tolerance.absolute >= 0, "form_factor: tolerances are not negative");
  const FacingPair pair = facing_pair(from, to);
  const double to_factor = 1 / (2 * std::numbers::pi * pair.from_area);
  if (!pair.sees()) return {0, std::min(1.0, pair.moved / pair.from_area * (1 + gamma_bound(kFinalRoundings)))};
  const Goal asked{tolerance.relative, tolerance.absolute / to_factor};
  double size = 0.25 * rough_size(pair.from, pair.to, pair.offset);
  QuadratureSum sum;
  constexpr int kAttempts = 3;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    sum = integrate(pair, 0.5 * asked.at(size), asked);
    if (sum.truncation <= 0.5 * asked.at(sum.value) || sum.truncation <= sum.rounding) break;
    size = std::min(std::abs(sum.value), 0.25 * size);
  }
  constexpr double kMovedShare = 2 * std::numbers::pi;  // the sum is 2π A_1 F_12
  Bounded result;
  result.value = sum.value * to_factor;
  result.bound = (sum.truncation + sum.rounding + kMovedShare * pair.moved) * to_factor +
                 gamma_bound(kFinalRoundings) * std::abs(result.value);
  // 0 ≤ F ≤ 1 holds for the truth: moving the value into the range by at most its error only brings it nearer.
  result.value = std::clamp(result.value, 0.0, 1.0);
  result.bound = std::min(result.bound, 1.0);
  return result;
}

}  // namespace etendue
