// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/certified_flux.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "etendue/form_factor/certified_area.hpp"
#include "etendue/form_factor/certified_contour.hpp"

namespace etendue {

namespace {

/// What both of two enclosures of one number hold.
Interval common(const Interval& a, const Interval& b) {
  return {std::max(a.lower, b.lower), std::min(a.upper, b.upper)};
}

/// A first idea of 2π A_1 F, and of the size of the pair over its distance: sets goals, never a bound.
struct Rough {
  double size = 0;
  double nearness = 0;
};

struct Middle {
  Vec3 centre = Vec3::Zero();
  Vec3 area = Vec3::Zero();
  double radius = 0;
};

Middle middle_of(const EnclosedOutline& outline) {
  Middle result;
  for (const Interval3& v : outline) result.centre += v.middle() / static_cast<double>(outline.size());
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3 a = outline[i].middle() - result.centre, b = outline[(i + 1) % outline.size()].middle() - result.centre;
    result.area += 0.5 * a.cross(b);
    result.radius = std::max(result.radius, a.norm());
  }
  return result;
}

Rough rough_size(const EnclosedPair& pair) {
  const Middle a = middle_of(pair.from), b = middle_of(pair.to);
  const Vec3 r = b.centre - a.centre;
  const double square = r.squaredNorm();
  const double kernel = std::abs(r.dot(a.area)) * std::abs(r.dot(b.area)) / (square * square);
  constexpr double kPi = 3;  // about
  return {2 * std::min(kernel, kPi * std::min(a.area.norm(), b.area.norm())), (a.radius + b.radius) / r.norm()};
}

/// 2π A_1 F, narrower with every attempt.
class PairEnclosure {
 public:
  PairEnclosure(const EnclosedPair& pair, const CertifiedGoal& goal) : pair_(pair), goal_(goal) {
    scale_ = Interval(1) / (Interval(2) * pi() * pair.area);
  }

  CertifiedFactor enclose() {
    const Rough rough = rough_size(pair_);
    double wanted = 0.25 * asked(rough.size);
    // A contour loses digits like the square of the distance over the size, an area needs nodes when near.
    constexpr double kFar = 0.4;
    const bool area_first = rough.nearness < kFar;
    for (int attempt = 0; attempt < kAttempts && !reached() && work_ < goal_.work; ++attempt) {
      if (area_first) add_area(wanted);
      if (!reached()) add_contour(wanted);
      if (!area_first && !reached()) add_area(wanted);
      const double half = 0.5 * (sum_.upper - sum_.lower), least = std::min(std::abs(sum_.lower), std::abs(sum_.upper));
      // A quarter of the goal for what is known now; the rounding that is left is none of the quadrature's. Where the sum
      // may still be zero, its size is taken for this share of what is not known.
      constexpr double kLeastShare = 1e-3;
      wanted = std::min(0.25 * asked(std::max(least, kLeastShare * half)), 0.125 * wanted);
    }
    return {factor(), reached(), work_};
  }

 private:
  double asked(double size) const {
    return std::max(goal_.tolerance.absolute / scale_.middle(), goal_.tolerance.relative * size);
  }
  Interval factor() const {
    const Interval f = sum_ * scale_;
    // 0 ≤ F ≤ 1 holds for the truth, and F A_1 is at most the other's area.
    const double most = std::min(1.0, f.upper);
    return {std::min(std::max(0.0, f.lower), most), std::max(0.0, most)};
  }
  bool reached() const {
    const Interval f = factor();
    return 0.5 * f.width() <= std::max(goal_.tolerance.absolute, goal_.tolerance.relative * f.middle());
  }
  void add_contour(double wanted) {
    sum_ = common(sum_, enclosed_contour(pair_.from, pair_.to, wanted, goal_.work, work_));
  }
  void add_area(double wanted) {
    if (const auto area = enclosed_area(pair_.from, pair_.to, wanted, goal_.work - work_, work_)) {
      sum_ = common(sum_, *area);
    }
  }

  static constexpr int kAttempts = 3;
  const EnclosedPair& pair_;
  const CertifiedGoal& goal_;
  Interval scale_;
  Interval sum_ = Interval::everything();
  std::int64_t work_ = 0;
};

}  // namespace

CertifiedFactor enclosed_factor(const EnclosedPair& pair, const CertifiedGoal& goal) {
  if (pair.to.empty()) return {Interval(), true, 0};
  return PairEnclosure(pair, goal).enclose();
}

}  // namespace etendue
