// SPDX-License-Identifier: Apache-2.0
#include "oracles/round_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "oracles/corners.hpp"
#include "oracles/line_view.hpp"
#include "support/counter_random.hpp"

namespace etendue::oracle {

namespace {

using Kind = RoundBody::Kind;
using validation::CounterRandom;

constexpr double kTurn = 2 * std::numbers::pi;

Point sum(const Point& a, const Point& b, double t = 1) {
  return {a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]};
}
Point scaled(const Point& p, double s) {
  return {s * p[0], s * p[1], s * p[2]};
}
Point unit(const Point& p) {
  return scaled(p, 1 / norm(p));
}

Point direction(CounterRandom& random) {
  const double z = random.between(-1, 1), turn = random.between(0, kTurn), r = std::sqrt(1 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

/// Within an angle of some 50 degrees of an axis.
Point about(CounterRandom& random, const Point& axis) {
  return unit(sum(axis, direction(random), 0.8));
}

/// The farthest point in a direction.
Point support(const RoundBody& body, const Point& way) {
  const auto on_rim = [&](const Point& centre, const Point& normal) {
    const Point across = sum(way, normal, -dot(way, normal));
    const double size = norm(across);
    return size > 0 ? sum(centre, across, body.radius / size) : centre;
  };
  switch (body.kind) {
    case Kind::polygon:
      return *std::max_element(body.corners.begin(), body.corners.end(),
                               [&](const Point& a, const Point& b) { return dot(a, way) < dot(b, way); });
    case Kind::sphere:
      return sum(body.centre, unit(way), body.radius);
    case Kind::disc:
      return on_rim(body.centre, body.axis);
    case Kind::cylinder:
      return on_rim(dot(body.axis, way) > 0 ? sum(body.centre, body.axis) : body.centre, unit(body.axis));
    default: {
      Point corner = body.centre;
      for (const Point& edge : body.edges) {
        if (dot(edge, way) > 0) corner = sum(corner, edge);
      }
      return corner;
    }
  }
}

/// Is there a plane between the two? Gilbert's walk to the nearest point of their difference; bodies that are nearer to one
/// another than a few hundred steps can tell count as meeting.
bool apart(const RoundBody& a, const RoundBody& b) {
  const auto difference = [&](const Point& way) { return sub(support(a, way), support(b, scaled(way, -1))); };
  const double close = 1e-6 * (ball_of(a).size + ball_of(b).size);
  Point nearest = difference({0.3, 0.9, 0.2});
  for (int step = 0; step < 300; ++step) {
    if (norm(nearest) <= close) return false;
    const Point corner = difference(scaled(nearest, -1));
    if (dot(corner, nearest) > 0) return true;
    const Point way = sub(corner, nearest);
    const double length = dot(way, way);
    if (!(length > 0)) return false;
    nearest = sum(nearest, way, std::clamp(-dot(nearest, way) / length, 0.0, 1.0));
  }
  return false;
}

RoundBody sphere(const Point& centre, double radius) {
  RoundBody body;
  body.centre = centre, body.radius = radius;
  return body;
}

RoundBody disc(const Point& centre, const Point& normal, double radius) {
  RoundBody body = sphere(centre, radius);
  body.kind = Kind::disc, body.axis = normal;
  return body;
}

RoundBody cylinder(const Point& base, const Point& axis, double radius) {
  RoundBody body = disc(base, axis, radius);
  body.kind = Kind::cylinder;
  return body;
}

/// Corners on an ellipse: convex.
RoundBody polygon(CounterRandom& random, const Point& centre, const Point& normal, double size) {
  RoundBody body;
  body.kind = Kind::polygon;
  const LightFrame plane = LightFrame::of(normal);
  const int corners = 3 + static_cast<int>(random.below(4));
  const double narrow = random.between(0.4, 1), start = random.between(0, kTurn);
  for (int k = 0; k < corners; ++k) {
    const double at = start + kTurn * (k + random.between(0, 0.6)) / corners;
    body.corners.push_back(sum(sum(centre, plane.x, size * std::cos(at)), plane.y, narrow * size * std::sin(at)));
  }
  return body;
}

/// A box with one face across `up`, its middle in `foot`.
RoundBody box(CounterRandom& random, const Point& foot, const Point& up, double size) {
  RoundBody body;
  body.kind = Kind::box;
  const LightFrame plane = LightFrame::of(up);
  const double turn = random.between(0, kTurn), long_side = size * random.between(0.4, 1),
               short_side = size * random.between(0.4, 1), height = size * random.between(0.4, 2);
  const Point a = sum(scaled(plane.x, std::cos(turn)), plane.y, std::sin(turn));
  const Point b = cross(up, a);
  body.edges = {scaled(a, long_side), scaled(b, short_side), scaled(up, height)};
  body.centre = sum(sum(foot, body.edges[0], -0.5), body.edges[1], -0.5);
  return body;
}

/// A patch around a point that looks about in the direction `towards`; what is flat does, the rest has no front.
RoundBody patch(CounterRandom& random, Kind kind, const Point& middle, const Point& towards, double size) {
  switch (kind) {
    case Kind::polygon:
      return polygon(random, middle, about(random, towards), size);
    case Kind::sphere:
      return sphere(middle, size);
    case Kind::disc:
      return disc(middle, about(random, towards), size);
    default: {
      const double share = random.between(0.2, 0.95);
      const Point axis = scaled(direction(random), 2 * share * size);
      return cylinder(sum(middle, axis, -0.5), axis, std::sqrt(1 - share * share) * size);
    }
  }
}

Kind any_patch(CounterRandom& random) {
  constexpr std::array kKinds{Kind::polygon, Kind::sphere, Kind::disc, Kind::cylinder};
  return kKinds[random.below(kKinds.size())];
}

RoundBody thing(CounterRandom& random, const Point& middle, double size) {
  const std::uint64_t kind = random.below(5);
  if (kind == 4) {
    const Point up = direction(random);
    return box(random, middle, up, size);
  }
  constexpr std::array kKinds{Kind::polygon, Kind::sphere, Kind::disc, Kind::cylinder};
  const Point towards = direction(random);
  return patch(random, kKinds[kind], middle, towards, size);
}

/// Something of the size asked for between the two, somewhere.
RoundBody between(CounterRandom& random, const RoundPair& pair, double size, double scatter) {
  const BodyBall a = ball_of(pair.from), b = ball_of(pair.to);
  const double share = random.between(0.25, 0.75), aside = scatter * random.unit() * std::max(a.size, b.size);
  const Point off = direction(random);
  return thing(random, sum(sum(a.middle, sub(b.middle, a.middle), share), off, aside), size);
}

/// Stands or lies on a plate, inside its outline: a cylinder, a box, a sphere.
RoundBody standing(CounterRandom& random, const RoundBody& plate, double size) {
  const BodyBall ball = ball_of(plate);
  const Point up = plate.kind == Kind::disc ? plate.axis : unit(newell(plate.corners));
  const Point way = direction(random);
  const Point across = sum(way, up, -dot(way, up));
  const Point foot = sum(ball.middle, across, 0.4 * random.unit() * ball.size);
  switch (random.below(3)) {
    case 0: {
      const double height = size * random.between(0.3, 3);
      return cylinder(foot, scaled(up, height), 0.5 * size);
    }
    case 1:
      return box(random, foot, up, size);
    default:
      return sphere(sum(foot, up, 0.5 * size), 0.5 * size);
  }
}

bool flat(const RoundBody& body) {
  return body.kind == Kind::polygon || body.kind == Kind::disc;
}
bool round(const RoundBody& body) {
  return body.kind != Kind::polygon && body.kind != Kind::box;
}

/// A pair, and which two touch: numbers of the first, the second, the blockers.
struct Drawn {
  RoundPair pair;
  std::size_t touching = 0, touched = 0;
};

Drawn drawn(RoundFamily family, CounterRandom& random) {
  Drawn result;
  RoundPair& pair = result.pair;
  const Point way = direction(random);
  const Point origin = scaled(direction(random), 3 * random.unit());
  const double size = random.between(0.4, 1);
  Kind first = any_patch(random), second = any_patch(random);
  if (family == RoundFamily::standing) first = random.below(2) == 0 ? Kind::polygon : Kind::disc;
  if (family == RoundFamily::free && first == Kind::polygon && second == Kind::polygon) second = Kind::cylinder;
  double other = random.between(0.2, 1);
  if (family == RoundFamily::tiny && random.below(2) == 0) other = random.scale(1e-3, 1e-1);
  const double distance =
      (size + other) * (family == RoundFamily::free ? random.scale(1.0, 30) : random.between(0.9, 2.5));
  pair.from = patch(random, first, origin, way, size);
  const Point back = scaled(way, -1);
  pair.to = patch(random, second, sum(origin, way, distance), back, other);
  int more = 0;
  switch (family) {
    case RoundFamily::free:
      break;
    case RoundFamily::floating:
      more = 1 + static_cast<int>(random.below(3));
      break;
    case RoundFamily::standing: {
      const double small = size * random.scale(0.05, 0.6);
      const RoundBody on = standing(random, pair.from, small);
      // The pair may be what stands and what it stands on.
      if (on.kind != Kind::box && random.below(3) == 0) {
        pair.to = on;
        result.touching = 1;
      } else {
        pair.blockers.push_back(on);
        result.touching = 2;
      }
      more = static_cast<int>(random.below(2));
      break;
    }
    case RoundFamily::touching: {
      if (!flat(pair.from)) {
        pair.from = sphere(origin, size);
        pair.to = sphere(sum(origin, way, size + other), other);
      } else {
        do pair.to = standing(random, pair.from, other);
        while (pair.to.kind == Kind::box);
      }
      result.touching = 1;
      more = static_cast<int>(random.below(3));
      break;
    }
    case RoundFamily::tiny:
      pair.blockers.push_back(between(random, pair, random.scale(1e-3, 1e-1), 0.5));
      more = static_cast<int>(random.below(2));
      break;
    case RoundFamily::hidden:
      pair.blockers.push_back(between(random, pair, random.between(0.6, 1.2) * std::max(size, other), 0.2));
      more = static_cast<int>(random.below(2));
      break;
  }
  for (int k = 0; k < more; ++k) {
    const double small = random.scale(0.05, 0.6);
    pair.blockers.push_back(between(random, pair, small, 1));
  }
  if (random.below(2) == 0) {
    std::swap(pair.from, pair.to);
    if (result.touching > 1) result.touched = 1;
  }
  return result;
}

/// Something is round, and nothing meets another but what touches it as it was made.
bool sound(const Drawn& drawn) {
  const RoundPair& pair = drawn.pair;
  std::vector<const RoundBody*> all{&pair.from, &pair.to};
  for (const RoundBody& body : pair.blockers) all.push_back(&body);
  if (std::none_of(all.begin(), all.end(), [](const RoundBody* body) { return round(*body); })) return false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (i == std::max(drawn.touching, drawn.touched) && j == std::min(drawn.touching, drawn.touched)) continue;
      if (!apart(*all[i], *all[j])) return false;
    }
  }
  return true;
}

}  // namespace

std::string_view name(RoundFamily family) {
  constexpr std::array<std::string_view, 6> kNames{"free", "floating", "standing", "touching", "tiny", "hidden"};
  return kNames[static_cast<std::size_t>(family)];
}

RoundPair round_pair(RoundFamily family, int index) {
  // Another factor than the generator's own step, or one pair's numbers would be the next one's.
  constexpr std::uint64_t kApart = 0xd1342543de82ef95u;
  CounterRandom random(kApart * (7919u * (1 + static_cast<std::uint64_t>(family)) + static_cast<std::uint64_t>(index)));
  for (;;) {
    const Drawn one = drawn(family, random);
    // Where no line of a few thousand passes there is nothing to find.
    if (sound(one) && round_exchange_by_lines(one.pair, 7, 1).value > 0) return one.pair;
  }
}

}  // namespace etendue::oracle
