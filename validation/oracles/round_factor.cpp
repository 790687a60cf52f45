// SPDX-License-Identifier: Apache-2.0
#include "oracles/round_factor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

#include "oracles/corners.hpp"
#include "oracles/line_view.hpp"
#include "support/counter_random.hpp"

namespace etendue::oracle {

namespace {

constexpr double kPi = std::numbers::pi;

/// Lines are tried so far beside an outline, as a share of the bodies' size: what is narrower counts as nothing.
constexpr double kBeside = 1e-10;

Point scaled(const Point& p, double s) {
  return {s * p[0], s * p[1], s * p[2]};
}
Point sum(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Point unit(const Point& p) {
  return scaled(p, 1 / norm(p));
}

/// The pair as one direction shows it.
class Light {
 public:
  Light(const RoundPair& pair, const LightFrame& frame, double size)
      : from_(pair.from, frame), to_(pair.to, frame), beside_(kBeside * size) {
    if (!meet(from_, to_)) return;
    open_ = true;
    for (const RoundBody& body : pair.blockers) {
      LitBody blocker(body, frame);
      if (meet(blocker, from_) && meet(blocker, to_)) blockers_.push_back(std::move(blocker));
    }
  }

  /// Does a line leave the one and arrive at the other?
  bool passes(Flat line) const {
    const auto a = from_.crossing(line);
    if (!a || !a->leaves_patch) return false;
    const auto b = to_.crossing(line);
    if (!b || !b->enters_patch || !(a->middle() < b->middle())) return false;
    for (const LitBody& blocker : blockers_) {
      const auto c = blocker.crossing(line);
      if (c && a->middle() < c->middle() && c->middle() < b->middle()) return false;
    }
    return true;
  }

  double area() {
    if (!open_) return 0;
    std::vector<const Outline*> all;
    const auto add = [&all](const LitBody& body) {
      for (const Outline& outline : body.outlines()) all.push_back(&outline);
    };
    add(from_), add(to_);
    for (const LitBody& blocker : blockers_) add(blocker);
    double total = 0;
    for (const Outline* outline : all) {
      cuts_.assign({0, 0.5 * outline->end(), outline->end()});
      for (const Outline* other : all) {
        if (other != outline) outline->cross(*other, cuts_);
      }
      std::sort(cuts_.begin(), cuts_.end());
      for (std::size_t k = 0; k + 1 < cuts_.size(); ++k) {
        if (cuts_[k + 1] > cuts_[k]) total += bounded(*outline, cuts_[k], cuts_[k + 1]);
      }
    }
    return total;
  }

 private:
  static bool meet(const LitBody& a, const LitBody& b) {
    const Flat apart = a.middle() - b.middle();
    const double reaches = a.reach() + b.reach();
    return dot(apart, apart) < reaches * reaches;
  }

  double bounded(const Outline& outline, double from, double to) const {
    const double s = 0.5 * (from + to);
    const Flat middle = outline.at(s), way = outline.along(s);
    const double length = std::hypot(way.x, way.y);
    if (!(length > 0)) return 0;
    const Flat left = (beside_ / length) * Flat{-way.y, way.x};
    const int kind = int(passes(middle + left)) - int(passes(middle - left));
    return kind == 0 ? 0 : kind * outline.swept(from, to);
  }

  LitBody from_, to_;
  std::vector<LitBody> blockers_;
  std::vector<double> cuts_;
  double beside_;
  bool open_ = false;
};

/// Directions around a middle one: the plane's point at the distance r is the direction at the angle 2 asin(r/2), so areas
/// are solid angles.
class Directions {
 public:
  Directions(const RoundPair& pair, double turn) {
    const BodyBall a = ball_of(pair.from), b = ball_of(pair.to);
    const Point way = sub(b.middle, a.middle);
    const double distance = norm(way), sizes = a.size + b.size;
    origin_ = a.middle;
    size_ = sizes;
    const auto flat_side = [](const RoundBody& body) -> std::optional<Point> {
      if (body.kind == RoundBody::Kind::polygon) return unit(newell(body.corners));
      if (body.kind == RoundBody::Kind::disc) return body.axis;
      return std::nullopt;
    };
    double widest = kPi;
    Point middle = distance > 0 ? unit(way) : Point{0, 0, 1};
    if (distance > sizes) widest = std::asin(sizes / distance);
    const auto first = flat_side(pair.from), second = flat_side(pair.to);
    if (widest >= 0.25 * kPi && (first || second)) {
      middle = first ? *first : scaled(*second, -1);
      widest = 0.5 * kPi;
    }
    // Another middle for another turn: kinks and cells shall not meet in the same way twice.
    const LightFrame plain = LightFrame::of(middle);
    const double off = 0.1 * std::sin(turn) * std::min(widest, 0.5 * kPi);
    frame_ = LightFrame::of(unit(sum(middle, scaled(plain.x, std::tan(off)))));
    const double c = std::cos(turn), s = std::sin(turn);
    const Point x = sum(scaled(frame_.x, c), scaled(frame_.y, s));
    frame_.y = sum(scaled(frame_.y, c), scaled(frame_.x, -s));
    frame_.x = x;
    reach_ = 2 * std::sin(0.5 * std::min(kPi, widest + std::abs(off)));
  }

  double reach() const { return reach_; }
  double size() const { return size_; }

  /// 0 outside of the sphere.
  double area(const RoundPair& pair, double x, double y) const {
    const auto direction = at(x, y);
    return direction ? Light(pair, LightFrame::of(*direction), size_).area() : 0;
  }

  std::optional<Point> at(double x, double y) const {
    const double square = x * x + y * y;
    if (square >= 4) return std::nullopt;
    const double across = std::sqrt(1 - 0.25 * square);
    return unit(
        sum(sum(scaled(frame_.x, x * across), scaled(frame_.y, y * across)), scaled(frame_.along, 1 - 0.5 * square)));
  }

 private:
  LightFrame frame_{};
  Point origin_{};
  double reach_ = 2, size_ = 1;
};

struct Cell {
  double x, y, side, value, error;
  bool operator<(const Cell& other) const { return error < other.error; }
};

/// Bodies moved so that numbers are small where lines are.
RoundPair centred(RoundPair pair) {
  const Point away = scaled(ball_of(pair.from).middle, -1);
  const auto move = [&away](RoundBody& body) {
    body.centre = sum(body.centre, away);
    for (Point& corner : body.corners) corner = sum(corner, away);
  };
  move(pair.from), move(pair.to);
  for (RoundBody& body : pair.blockers) move(body);
  return pair;
}

}  // namespace

BodyBall ball_of(const RoundBody& body) {
  switch (body.kind) {
    case RoundBody::Kind::polygon: {
      BodyBall ball{{0, 0, 0}, 0};
      for (const Point& corner : body.corners) ball.middle = sum(ball.middle, corner);
      ball.middle = scaled(ball.middle, 1 / static_cast<double>(body.corners.size()));
      for (const Point& corner : body.corners) ball.size = std::max(ball.size, norm(sub(corner, ball.middle)));
      return ball;
    }
    case RoundBody::Kind::cylinder:
      return {sum(body.centre, scaled(body.axis, 0.5)), std::hypot(0.5 * norm(body.axis), body.radius)};
    case RoundBody::Kind::box: {
      const Point diagonal = sum(sum(body.edges[0], body.edges[1]), body.edges[2]);
      return {sum(body.centre, scaled(diagonal, 0.5)), 0.5 * norm(diagonal)};
    }
    default:
      return {body.centre, body.radius};
  }
}

double area_of(const RoundBody& body) {
  switch (body.kind) {
    case RoundBody::Kind::polygon:
      return 0.5 * norm(newell(body.corners));
    case RoundBody::Kind::sphere:
      return 4 * kPi * body.radius * body.radius;
    case RoundBody::Kind::disc:
      return kPi * body.radius * body.radius;
    case RoundBody::Kind::cylinder:
      return 2 * kPi * body.radius * norm(body.axis);
    default:
      return 0;
  }
}

Estimate round_exchange(const RoundPair& given, double turn, double goal, long most_directions) {
  constexpr int kNodes = 4, kFirst = 6;
  constexpr std::array<double, kNodes> kX{-0.86113631159405258, -0.33998104358485626, 0.33998104358485626,
                                          0.86113631159405258};
  constexpr std::array<double, kNodes> kWeight{0.34785484513745386, 0.65214515486254614, 0.65214515486254614,
                                               0.34785484513745386};
  /// Of a cell's error each quarter takes over at least.
  constexpr double kInherited = 1.0 / 32;
  const RoundPair pair = centred(given);
  const Directions directions(pair, turn);
  Estimate result;
  const auto look = [&](double x, double y, double side) {
    double sum = 0;
    for (int a = 0; a < kNodes; ++a) {
      for (int b = 0; b < kNodes; ++b) {
        sum += kWeight[static_cast<std::size_t>(a)] * kWeight[static_cast<std::size_t>(b)] *
               directions.area(pair, x + 0.5 * side * (1 + kX[static_cast<std::size_t>(a)]),
                               y + 0.5 * side * (1 + kX[static_cast<std::size_t>(b)]));
      }
    }
    result.evaluations += kNodes * kNodes;
    return 0.25 * side * side * sum / kPi;
  };
  std::priority_queue<Cell> open;
  const double first = 2 * directions.reach() / kFirst;
  for (int k = 0; k < kFirst * kFirst; ++k) {
    const double x = (k % kFirst) * first - directions.reach(), y = (k / kFirst) * first - directions.reach();
    const double value = look(x, y, first);
    open.push({x, y, first, value, 1e300});
  }
  std::vector<Cell> quarters;
  double error = 0;
  // Every first cell is quartered once, which is what tells its error.
  for (long known = -kFirst * kFirst; !open.empty() && (known < 0 || error > goal); ++known) {
    if (known >= 0 && result.evaluations >= most_directions) break;
    const Cell whole = open.top();
    open.pop();
    quarters.clear();
    double parts = 0, apart = 0;
    for (int k = 0; k < 4; ++k) {
      const double half = 0.5 * whole.side, x = whole.x + (k % 2) * half, y = whole.y + (k / 2) * half;
      quarters.push_back({x, y, half, look(x, y, half), 0});
      parts += quarters.back().value;
    }
    apart = std::abs(parts - whole.value);
    if (whole.error < 1e300) error -= whole.error;
    for (Cell& quarter : quarters) {
      quarter.error = std::max(0.25 * apart, whole.error < 1e300 ? kInherited * whole.error : 0);
      error += quarter.error;
      open.push(quarter);
    }
  }
  std::vector<double> values;
  for (; !open.empty(); open.pop()) {
    result.error += open.top().error;
    values.push_back(open.top().value);
  }
  std::sort(values.begin(), values.end());
  for (const double value : values) result.value += value;
  return result;
}

Estimate round_exchange_by_lines(const RoundPair& given, int side, std::uint64_t seed) {
  const RoundPair pair = centred(given);
  const Directions directions(pair, 0.4);
  const BodyBall from = ball_of(pair.from), to = ball_of(pair.to);
  validation::CounterRandom random(seed);
  double sum = 0, squares = 0;
  const double reach = directions.reach();
  const BodyBall& smaller = from.size < to.size ? from : to;
  // Each line: a direction in the chart, and a place in the square around the smaller one's ball.
  const double share = 4 * reach * reach * 4 * smaller.size * smaller.size / kPi;
  const long strata = static_cast<long>(side) * side * side * side;
  for (long s = 0; s < strata; ++s) {
    const auto in = [&](long k) { return 2 * ((static_cast<double>(k % side) + random.unit()) / side) - 1; };
    const double x = in(s), y = in(s / side), u = in(s / side / side), v = in(s / side / side / side);
    const auto direction = directions.at(reach * x, reach * y);
    if (!direction) continue;
    const LightFrame frame = LightFrame::of(*direction);
    const Point middle = frame.in(smaller.middle);
    const Light light(pair, frame, directions.size());
    if (!light.passes({middle[0] + smaller.size * u, middle[1] + smaller.size * v})) continue;
    sum += share;
    squares += share * share;
  }
  const double mean = sum / static_cast<double>(strata);
  return {mean, std::sqrt((squares / static_cast<double>(strata) - mean * mean) / static_cast<double>(strata)), strata};
}

}  // namespace etendue::oracle
