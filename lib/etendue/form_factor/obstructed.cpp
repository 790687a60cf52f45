// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/obstructed.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/critical_lines.hpp"
#include "etendue/form_factor/gauss_legendre.hpp"
#include "etendue/form_factor/point_polygon.hpp"
#include "etendue/form_factor/polygon_polygon.hpp"
#include "etendue/form_factor/shaft.hpp"
#include "etendue/form_factor/visible_part.hpp"

namespace etendue {

namespace {

using Points = std::vector<Vec3>;

constexpr int kCoarseNodes = 2;
constexpr int kFineNodes = 4;
/// Point evaluations after which the integral is returned with the bound it has.
constexpr int kMostEvaluations = 60000;
/// The embedded difference may be lucky where the integrand is not smooth, so the sum of all errors counts twice.
constexpr double kSafety = 2;
/// Where no critical line crosses the cell the difference is the error of the coarser rule, four orders behind the finer.
constexpr double kSmoothShare = 0.1;
/// In a cell that a critical line crosses, the spread of the samples times this is the least error believed.
constexpr double kCrossedSpread = 0.02;

struct Pointwise {
  double free = 0;
  double visible = 0;
};

/// The factor from points of the source to the receiver, without and with the blockers.
class Integrand {
 public:
  Integrand(Vec3 normal, Points receiver, const std::vector<Points>& blockers)
      : normal_(std::move(normal)), receiver_(std::move(receiver)), blockers_(blockers) {}

  Pointwise at(const Vec3& x) const {
    const Points receiver = moved(receiver_, x);
    std::vector<Points> blockers;
    blockers.reserve(blockers_.size());
    for (const Points& b : blockers_) blockers.push_back(moved(b, x));
    Pointwise result;
    result.free = lambert_sum(receiver, normal_).value;
    for (const Points& part : visible_part(receiver, blockers)) result.visible += lambert_sum(part, normal_).value;
    return result;
  }

 private:
  static Points moved(const Points& points, const Vec3& x) {
    Points result;
    result.reserve(points.size());
    for (const Vec3& p : points) result.push_back(p - x);
    return result;
  }

  Vec3 normal_;
  Points receiver_;
  const std::vector<Points>& blockers_;
};

struct Cell {
  Points corners;
  std::vector<const CriticalLine*> lines;
  double sign = 1;
  double area = 0;
  double visible = 0;
  double hidden = 0;
  double error = 0;
};

/// Integrates over the quadrilateral c (a triangle repeats a corner) with n × n nodes.
struct Samples {
  double visible = 0;
  double hidden = 0;
  double low = 1;
  double high = 0;
};

void sample(const Integrand& integrand, const Vec3 (&c)[4], const Vec3& normal, int n, Samples& sum) {
  for (const QuadratureNode& s : gauss_legendre(n)) {
    for (const QuadratureNode& t : gauss_legendre(n)) {
      const double u = 0.5 * (1 + s.x), v = 0.5 * (1 + t.x);
      const Vec3 along_s = (1 - v) * (c[1] - c[0]) + v * (c[2] - c[3]);
      const Vec3 along_t = (1 - u) * (c[3] - c[0]) + u * (c[2] - c[1]);
      const Vec3 x = c[0] + u * along_s + v * (c[3] - c[0]);
      const double weight = 0.25 * s.weight * t.weight * std::abs(along_s.cross(along_t).dot(normal));
      const Pointwise f = integrand.at(x);
      sum.visible += weight * f.visible;
      sum.hidden += weight * (f.free - f.visible);
      sum.low = std::min(sum.low, f.visible);
      sum.high = std::max(sum.high, f.visible);
    }
  }
}

Samples integrate(const Integrand& integrand, const Points& corners, const Vec3& normal, int n) {
  Samples sum;
  for (std::size_t i = 1; i + 1 < corners.size(); i += 2) {
    const Vec3 quad[4] = {corners[0], corners[i], corners[i + 1], corners[i + 2 < corners.size() ? i + 2 : 0]};
    sample(integrand, quad, normal, n, sum);
  }
  return sum;
}

double area_of(const Points& corners, const Vec3& normal) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    sum += 0.5 * (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]).dot(normal);
  }
  return sum;
}

/// Adaptive integration over the source: cells are cut along critical lines while any crosses them, then halved.
class OuterIntegral {
 public:
  OuterIntegral(const Integrand& integrand, const Vec3& normal) : integrand_(integrand), normal_(normal) {}

  void start(const Points& source, const std::vector<CriticalLine>& lines) {
    std::vector<const CriticalLine*> all;
    for (const CriticalLine& line : lines) all.push_back(&line);
    if (is_convex(source)) {
      push(source, all, 1);
    } else {
      for (std::size_t i = 1; i + 1 < source.size(); ++i) {
        Points triangle{source[0], source[i], source[i + 1]};
        const double area = area_of(triangle, normal_);
        if (area < 0) std::swap(triangle[1], triangle[2]);
        if (area != 0) push(triangle, all, area < 0 ? -1 : 1);
      }
    }
  }

  void refine_worst() {
    std::pop_heap(cells_.begin(), cells_.end(), less);
    const Cell cell = std::move(cells_.back());
    cells_.pop_back();
    for (const Points& half : split(cell)) push(half, cell.lines, cell.sign);
  }

  double visible() const { return total(&Cell::visible); }
  double hidden() const { return total(&Cell::hidden); }
  double error() const {
    double sum = 0;
    for (const Cell& cell : cells_) sum += cell.error;
    return kSafety * sum;
  }
  bool exhausted() const { return evaluations_ >= kMostEvaluations || cells_.empty(); }

 private:
  static bool less(const Cell& a, const Cell& b) { return a.error < b.error; }

  double total(double Cell::*member) const {
    double sum = 0;
    for (const Cell& cell : cells_) sum += cell.sign * cell.*member;
    return sum;
  }

  bool is_convex(const Points& p) const {
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vec3& b = p[(i + 1) % p.size()];
      if ((b - p[i]).cross(p[(i + 2) % p.size()] - b).dot(normal_) < 0) return false;
    }
    return true;
  }

  void push(const Points& corners, const std::vector<const CriticalLine*>& lines, double sign) {
    if (corners.size() < 3) return;
    Cell cell;
    cell.corners = corners;
    cell.sign = sign;
    cell.area = area_of(corners, normal_);
    if (!(cell.area > 0)) return;
    for (const CriticalLine* line : lines) {
      if (meets(*line, corners)) cell.lines.push_back(line);
    }
    const Samples coarse = integrate(integrand_, corners, normal_, kCoarseNodes);
    const Samples fine = integrate(integrand_, corners, normal_, kFineNodes);
    evaluations_ +=
        static_cast<int>((corners.size() - 1) / 2) * (kCoarseNodes * kCoarseNodes + kFineNodes * kFineNodes);
    cell.visible = fine.visible;
    cell.hidden = fine.hidden;
    cell.error = std::max(std::abs(fine.visible - coarse.visible), std::abs(fine.hidden - coarse.hidden));
    if (cell.lines.empty()) {
      cell.error *= kSmoothShare;
    } else {
      const double spread = std::max(fine.high, coarse.high) - std::min(fine.low, coarse.low);
      cell.error = std::max(cell.error, kCrossedSpread * spread * cell.area);
    }
    cells_.push_back(std::move(cell));
    std::push_heap(cells_.begin(), cells_.end(), less);
  }

  /// Along the critical line that halves the cell best, or across its longest direction.
  std::vector<Points> split(const Cell& cell) const {
    Vec3 normal = Vec3::Zero();
    double level = 0, balance = 0;
    for (const CriticalLine* line : cell.lines) {
      double low = 0, high = 0;
      for (const Vec3& v : cell.corners) {
        const double h = line->normal.dot(v) - line->level;
        low = std::min(low, h);
        high = std::max(high, h);
      }
      const double share = std::min(-low, high) / (high - low);
      if (share > balance) {
        balance = share;
        normal = line->normal;
        level = line->level;
      }
    }
    if (balance == 0) {
      double longest = 0;
      for (std::size_t i = 0; i < cell.corners.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          const Vec3 across = cell.corners[i] - cell.corners[j];
          if (across.squaredNorm() <= longest) continue;
          longest = across.squaredNorm();
          normal = across;
        }
      }
      // A square's diagonal makes slivers; its longer side halves it into rectangles.
      for (std::size_t i = 0; i < cell.corners.size() && cell.corners.size() == 4; ++i) {
        const Vec3 side = cell.corners[(i + 1) % 4] - cell.corners[i];
        if (i == 0 || side.squaredNorm() > longest) {
          longest = side.squaredNorm();
          normal = side;
        }
      }
      Vec3 centre = Vec3::Zero();
      for (const Vec3& v : cell.corners) centre += v / static_cast<double>(cell.corners.size());
      level = normal.dot(centre);
    }
    std::vector<double> heights;
    for (const Vec3& v : cell.corners) heights.push_back(normal.dot(v) - level);
    std::vector<Points> halves{clip(cell.corners, heights)};
    for (double& h : heights) h = -h;
    halves.push_back(clip(cell.corners, heights));
    return halves;
  }

  const Integrand& integrand_;
  Vec3 normal_;
  std::vector<Cell> cells_;
  int evaluations_ = 0;
};

Points shifted(const Points& points, const Vec3& offset) {
  Points result;
  for (const Vec3& p : points) result.push_back(p + offset);
  return result;
}

}  // namespace

Bounded obstructed_form_factor(const Polygon& from, const Polygon& to, std::span<const Polygon> blockers,
                               Tolerance tolerance) {
  constexpr double kFreeShare = 0.1;  // the certified part of the error, beside which the rest is measured
  const Bounded free = form_factor(from, to, {kFreeShare * tolerance.relative, kFreeShare * tolerance.absolute});
  if (free.value == 0 || blockers.empty()) return free;
  const FacingPair pair = facing_pair(from, to);
  const Shaft between = shaft(pair, from.vertices().front(), blockers);
  if (between.blockers.empty()) return free;
  if (between.hides_all) return {0, 0};
  if (free.value + free.bound <= tolerance.absolute) return {0.5 * free.value, 0.5 * free.value + free.bound};

  const Points receiver = shifted(pair.to.vertices, pair.offset);
  const auto lines = critical_lines(pair.from, receiver, between.blockers);
  const Integrand integrand(pair.from.normal, receiver, between.blockers);
  OuterIntegral outer(integrand, pair.from.normal);
  outer.start(pair.from.vertices, lines);
  Bounded result;
  for (;;) {
    const double visible = outer.visible() / pair.from_area, hidden = outer.hidden() / pair.from_area;
    // The certified free factor less the hidden part, where that is the smaller: its error is all there is.
    const bool by_hidden = hidden < visible;
    result.value = by_hidden ? free.value - hidden : visible;
    result.bound = outer.error() / pair.from_area + (by_hidden ? free.bound : 0);
    if (result.bound <= std::max(tolerance.absolute, tolerance.relative * result.value) || outer.exhausted()) break;
    outer.refine_worst();
  }
  // 0 ≤ F ≤ F_free holds for the truth: moving the value into the range by at most its error only brings it nearer.
  result.value = std::clamp(result.value, 0.0, free.value);
  result.bound = std::min(result.bound, free.value + free.bound);
  return result;
}

Bounded visible_point_to_polygon(const Vec3& point, const Vec3& normal, const Polygon& polygon,
                                 std::span<const Polygon> blockers) {
  const Bounded free = point_to_polygon(point, normal, polygon);
  if (free.value == 0) return free;
  const Vec3 unit = normal.normalized();
  const auto seen = [&](const Points& vertices, bool above) {
    Points result = shifted(vertices, -point);
    std::vector<double> heights;
    for (const Vec3& v : result) heights.push_back(v.dot(unit));
    return above ? clip(result, heights) : result;
  };
  std::vector<Points> obstacles;
  for (const Polygon& blocker : blockers) obstacles.push_back(seen(blocker.vertices(), false));
  Bounded sum;
  for (const Points& part : visible_part(seen(polygon.vertices(), true), obstacles)) {
    const Bounded term = lambert_sum(part, unit);
    sum.value += term.value;
    sum.bound += term.bound;
  }
  sum.value = std::clamp(sum.value, 0.0, free.value);
  return sum;
}

}  // namespace etendue
