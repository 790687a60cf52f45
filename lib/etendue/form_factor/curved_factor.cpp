// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/curved_factor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>
#include <vector>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/gauss_legendre.hpp"
#include "etendue/form_factor/patch_chart.hpp"

namespace etendue {

namespace {

constexpr std::size_t kNodes = 5;  ///< of the rule along each side of a cell
/// Of the difference between the two rules, which is the error of the coarser one.
constexpr double kShare = 0.8;
/// Halvings of a cell before any point of it is looked from.
constexpr int kMostSeeding = 8;
/// Of the error of a cell each quarter takes over so much at least: where all nodes of both rules miss a kink that runs
/// along a side, the difference is zero by accident, but not time after time.
constexpr double kInherited = 1.0 / 64;
/// And so much of what the cell's value and the sum of its quarters' differ by.
constexpr double kMissed = 1.0 / 16;
/// And of what the corners of a cell see where its nodes see nothing.
constexpr double kCorner = 1.0 / 8;
/// A cell twice as wide as its distance from what is seen still shows it in all its nodes; one twice as wide as the radius of
/// a shadow has nodes in it.
constexpr double kWidest = 2;

struct Cell {
  std::size_t chart;
  double s, t, side;  ///< least corner in the chart's square
  Bounded exchange{};
  double rounding = 0;
};

struct Order {
  double error;
  std::size_t cell;
  bool operator<(const Order& other) const { return error != other.error ? error < other.error : cell > other.cell; }
};

/// What makes the integrand change quickly: near it cells must be small.
struct Feature {
  Vec3 from, to;  ///< a stretch from which its surface is no farther than `size`
  double size;
  double distance(const Vec3& point) const {
    const Vec3 along = to - from;
    const double length = along.squaredNorm();
    const double share = length > 0 ? std::clamp((point - from).dot(along) / length, 0.0, 1.0) : 0;
    return (point - from - share * along).norm();
  }
};

/// From where on the source a blocker hides some of what is seen: around the line from the receiver through it.
struct Shadow {
  Vec3 blocker, receiver;
  double size, receiver_size;  ///< of balls around the two

  struct At {
    double aside, radius;  ///< of a point from that line; of the shadow there
    double share;          ///< a factor that cannot be hidden there in larger part
  };
  At at(const Vec3& point) const {
    const Vec3 back = blocker - receiver;
    const double apart = std::max(back.norm(), size), distance = (point - blocker).norm();
    const Vec3 way = point - receiver;
    const double widening = distance / apart, whole = std::max(distance, size),
                 seen = std::max(way.norm(), receiver_size);
    return {(way - way.dot(back) / std::max(back.squaredNorm(), size * size) * back).norm(),
            size + (size + receiver_size) * widening,
            std::min((size / whole) * (size / whole), (receiver_size / seen) * (receiver_size / seen))};
  }
};

PatchBall ball_of(const CurvedBlocker& blocker) {
  if (const auto* sphere = std::get_if<Sphere>(&blocker)) return ball_around(*sphere);
  if (const auto* disc = std::get_if<Disc>(&blocker)) return ball_around(*disc);
  if (const auto* cylinder = std::get_if<Cylinder>(&blocker)) return ball_around(*cylinder);
  const std::vector<Vec3>& points = std::get<Blocker>(blocker).points();
  PatchBall ball{Vec3::Zero(), 0};
  for (const Vec3& point : points) ball.middle += point / static_cast<double>(points.size());
  for (const Vec3& point : points) ball.size = std::max(ball.size, (point - ball.middle).norm());
  return ball;
}

template <class Shape>
Feature feature_of(const Shape& shape) {
  if (const auto* ball = std::get_if<Sphere>(&shape)) return {ball->centre, ball->centre, ball->radius};
  if (const auto* plate = std::get_if<Disc>(&shape)) return {plate->centre, plate->centre, plate->radius};
  const auto& cylinder = std::get<Cylinder>(shape);
  return {cylinder.base, cylinder.top, cylinder.radius};
}

class Integral {
 public:
  Integral(const CurvedPatch& from, const CurvedPatch& to, std::span<const CurvedBlocker* const> blockers,
           const CurvedGoal& goal)
      : to_(to), blockers_(blockers), goal_(goal) {
    const PatchBall ball = ball_around(to);
    charts_ = PatchChart::covering(from, ball.middle, ball.size, cuts_of(from, to, blockers));
    if (!std::holds_alternative<Polygon>(to)) features_.push_back(feature_of(to));
    for (const CurvedBlocker* blocker : blockers) {
      if (!std::holds_alternative<Blocker>(*blocker)) features_.push_back(feature_of(*blocker));
      const PatchBall around = ball_of(*blocker);
      shadows_.push_back({around.middle, ball.middle, around.size, ball.size});
    }
  }

  CurvedExchangeArea find() {
    for (std::size_t k = 0; k < charts_.size(); ++k) seed({k, 0, 0, 1}, 0);
    double error = 0, value = 0;
    std::priority_queue<Order> open;
    for (std::size_t k = 0; k < cells_.size(); ++k) {
      look(cells_[k]);
      compare(cells_[k]);
      error += cells_[k].exchange.bound;
      value += cells_[k].exchange.value;
      open.push({cells_[k].exchange.bound, k});
    }
    while (error > std::max(goal_.absolute, goal_.relative * value) && views_ < goal_.most_views && !open.empty()) {
      const std::size_t worst = open.top().cell;
      open.pop();
      const Cell whole = cells_[worst];
      error -= whole.exchange.bound;
      value -= whole.exchange.value;
      std::array<Cell, 4> parts{};
      double missed = whole.exchange.value;
      for (std::size_t k = 0; k < parts.size(); ++k) {
        const double half = 0.5 * whole.side, along = k % 2 == 0 ? 0 : half, across = k < 2 ? 0 : half;
        parts[k] = {whole.chart, whole.s + along, whole.t + across, half};
        look(parts[k]);
        missed -= parts[k].exchange.value;
      }
      const double least = std::max(kInherited * whole.exchange.bound, kMissed * std::abs(missed));
      for (std::size_t k = 0; k < parts.size(); ++k) {
        parts[k].exchange.bound = std::max(parts[k].exchange.bound, least);
        error += parts[k].exchange.bound;
        value += parts[k].exchange.value;
        const std::size_t place = k == 0 ? worst : cells_.size();
        if (k == 0) {
          cells_[place] = parts[k];
        } else {
          cells_.push_back(parts[k]);
        }
        open.push({parts[k].exchange.bound, place});
      }
    }
    return summed();
  }

 private:
  void seed(const Cell& cell, int halvings) {
    if (halvings < kMostSeeding && too_wide(cell)) {
      const double half = 0.5 * cell.side;
      for (int k = 0; k < 4; ++k)
        seed({cell.chart, cell.s + (k % 2) * half, cell.t + (k / 2) * half, half}, halvings + 1);
      return;
    }
    cells_.push_back(cell);
  }

  bool too_wide(const Cell& cell) const {
    if (cell.side == 1 && !blockers_.empty()) return true;
    const PatchChart& chart = charts_[cell.chart];
    const Vec3 middle = chart.at(cell.s + 0.5 * cell.side, cell.t + 0.5 * cell.side).point;
    double reach = 0;
    for (int k = 0; k < 4; ++k) {
      const Vec3 corner = chart.at(cell.s + (k % 2) * cell.side, cell.t + (k / 2) * cell.side).point;
      reach = std::max(reach, (corner - middle).norm());
    }
    for (const Feature& feature : features_) {
      const double distance = feature.distance(middle);
      const double near = std::max(distance - reach, feature.size);
      // What the cell can exchange with it at most, or have hidden by it.
      const double most = 4 * reach * reach * std::min(1.0, (feature.size / near) * (feature.size / near));
      if (2 * reach > kWidest * distance && most > goal_.absolute) return true;
    }
    for (const Shadow& shadow : shadows_) {
      const Shadow::At at = shadow.at(middle);
      const double width = 2 * std::min(reach, at.radius);
      if (2 * reach > kWidest * at.radius && at.aside < reach + at.radius && width * width * at.share > goal_.absolute)
        return true;
    }
    return false;
  }

  // Rows and columns are judged one by one, so that errors of one do not make up for those of another: the rule of 5 nodes
  // against the one on three of them that is exact to degree 3.
  void look(Cell& cell) {
    const auto nodes = gauss_legendre(kNodes);
    std::array<double, kNodes> rows{}, columns{};
    double sum = 0, rounding = 0;
    for (std::size_t a = 0; a < kNodes; ++a) {
      for (std::size_t b = 0; b < kNodes; ++b) {
        const PatchSpot spot = charts_[cell.chart].at(cell.s + 0.5 * cell.side * (1 + nodes[a].x),
                                                      cell.t + 0.5 * cell.side * (1 + nodes[b].x));
        const Bounded factor = visible_point_to_patch(spot.point, spot.normal, to_, blockers_);
        const double density = 0.25 * cell.side * cell.side * spot.area;
        const double weight = nodes[a].weight * nodes[b].weight * density;
        sum += weight * factor.value;
        rounding += weight * factor.bound;
        rows[a] += difference(nodes, b) * density * factor.value;
        columns[b] += difference(nodes, a) * density * factor.value;
      }
    }
    double along = 0, across = 0;
    for (std::size_t k = 0; k < kNodes; ++k) {
      along += nodes[k].weight * std::abs(rows[k]);
      across += nodes[k].weight * std::abs(columns[k]);
    }
    views_ += static_cast<int>(kNodes * kNodes);
    cell.exchange = {sum, sum == 0 ? seen_from_corners(cell) : kShare * (along + across)};
    cell.rounding = rounding;
  }

  // From where a convex body hides a convex patch altogether is convex: a cell is dark where its corners are, for one such
  // body surely. Else what they see is of the order of what the nodes miss.
  double seen_from_corners(const Cell& cell) {
    double most = 0;
    for (int k = 0; k < 4 && !blockers_.empty(); ++k) {
      const PatchSpot spot = charts_[cell.chart].at(cell.s + (k % 2) * cell.side, cell.t + (k / 2) * cell.side);
      most = std::max(most, visible_point_to_patch(spot.point, spot.normal, to_, blockers_).value);
      ++views_;
    }
    const double area = charts_[cell.chart].at(cell.s + 0.5 * cell.side, cell.t + 0.5 * cell.side).area;
    return kCorner * most * area * cell.side * cell.side;
  }

  // Where a kink crosses all rows alike both rules may miss it by the same: a third rule does not. Of later cells the
  // quarters tell.
  void compare(Cell& cell) {
    constexpr std::size_t kOthers = 4;
    const auto nodes = gauss_legendre(kOthers);
    double sum = 0;
    for (const QuadratureNode& a : nodes) {
      for (const QuadratureNode& b : nodes) {
        const PatchSpot spot =
            charts_[cell.chart].at(cell.s + 0.5 * cell.side * (1 + a.x), cell.t + 0.5 * cell.side * (1 + b.x));
        const Bounded factor = visible_point_to_patch(spot.point, spot.normal, to_, blockers_);
        sum += a.weight * b.weight * 0.25 * cell.side * cell.side * spot.area * factor.value;
      }
    }
    views_ += static_cast<int>(kOthers * kOthers);
    cell.exchange.bound = std::max(cell.exchange.bound, std::abs(cell.exchange.value - sum));
  }

  /// Weight of a node in the rule of 5 less that in the rule on the outer nodes ±x and the middle: 1/(3x²) for the outer.
  static double difference(std::span<const QuadratureNode> nodes, std::size_t k) {
    const double outer = 1 / (3 * nodes[0].x * nodes[0].x);
    const double other = k == 0 || k == kNodes - 1 ? outer : k == kNodes / 2 ? 2 - 2 * outer : 0;
    return nodes[k].weight - other;
  }

  CurvedExchangeArea summed() const {
    CurvedExchangeArea area;
    double rounding = 0;
    for (const Cell& cell : cells_) {
      area.value += cell.exchange.value;
      area.bound += cell.exchange.bound;
      rounding += cell.rounding;
    }
    constexpr int kRoundings = 64;  // of a weight, a spot, and the sums, which add few digits to what is of one sign
    rounding += gamma_bound(kRoundings) * area.value;
    area.views = views_;
    area.reached = area.bound <= std::max(goal_.absolute, goal_.relative * area.value);
    area.bound += rounding;
    return area;
  }

  const CurvedPatch& to_;
  std::span<const CurvedBlocker* const> blockers_;
  CurvedGoal goal_;
  std::vector<PatchChart> charts_;
  std::vector<Feature> features_;
  std::vector<Shadow> shadows_;
  std::vector<Cell> cells_;
  int views_ = 0;
};

}  // namespace

CurvedExchangeArea curved_exchange(const CurvedPatch& from, const CurvedPatch& to,
                                   std::span<const CurvedBlocker* const> blockers, const CurvedGoal& goal) {
  require(goal.relative >= 0 && goal.absolute >= 0, "curved_exchange: tolerances are not negative");
  CurvedExchangeArea area = Integral(from, to, blockers, goal).find();
  // Holds for the truth: moving the value there only brings it nearer.
  area.value = std::min({area.value, area_of(from), area_of(to)});
  return area;
}

}  // namespace etendue
