// SPDX-License-Identifier: Apache-2.0
#include "oracles/obstructed_pairs.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "support/counter_random.hpp"

namespace etendue::oracle {

namespace {

/// Counter-based: the k-th number of a pair depends on nothing else.
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : random_(seed * 0x9e3779b97f4a7c15u) {}
  double unit() { return random_.unit(); }
  double in(double low, double high) { return random_.between(low, high); }
  Point vector(double reach) { return {in(-reach, reach), in(-reach, reach), in(-reach, reach)}; }

 private:
  validation::CounterRandom random_;
};

Point sum(const Point& a, const Point& b, double t = 1) {
  return {a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]};
}

Corners parallelogram(const Point& o, const Point& a, const Point& b) {
  return {o, sum(o, a), sum(sum(o, a), b), sum(o, b)};
}

/// Parallelograms in the height between the two polygons, leaning anyhow.
Corners floating(Numbers& random, const ObstructedPair& pair, double size) {
  const Point p = sum(pair.from[0], sum(pair.from[2], pair.from[0], -1), random.in(0.1, 0.9));
  const Point q = sum(pair.to[0], sum(pair.to[2], pair.to[0], -1), random.in(0.1, 0.9));
  const Point centre = sum(p, sum(q, p, -1), random.in(0.2, 0.8));
  const Point a = random.vector(0.5 * size), b = random.vector(0.5 * size);
  return parallelogram(sum(sum(centre, a, -0.5), b, -0.5), a, b);
}

struct Surface {
  Point origin, a, b, up;  ///< a parallelogram and its unit normal, towards the other
};

Surface surface(const Corners& c) {
  const Point a = sum(c[1], c[0], -1), b = sum(c[3], c[0], -1);
  Point n{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  const double size = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (double& v : n) v /= size;
  return {c[0], a, b, n};
}

Point on(const Surface& s, double u, double v) {
  return sum(sum(s.origin, s.a, u), s.b, v);
}

Corners special(Numbers& random, PairFamily family, const ObstructedPair& pair) {
  const Surface s = surface(random.unit() < 0.5 ? pair.from : pair.to);
  // One number a statement, here and below: the order in which arguments are evaluated is the compiler's choice.
  const double p_v = random.in(0.1, 0.9), p_u = random.in(0.1, 0.9);
  const double q_v = random.in(-0.2, 1.2), q_u = random.in(-0.2, 1.2);
  const Point p = on(s, p_u, p_v), q = on(s, q_u, q_v);
  const double height = random.in(0.1, 0.5);
  const Point lean = random.vector(0.2);
  const Point rise = sum({s.up[0] * height, s.up[1] * height, s.up[2] * height}, lean, height);
  switch (family) {
    case PairFamily::on_an_edge:
      return parallelogram(p, sum(q, p, -1), rise);
    case PairFamily::on_a_vertex: {
      Point start = p;
      if (random.unit() >= 0.5) {
        const double v = random.unit() < 0.5 ? 0 : 1, u = random.unit() < 0.5 ? 0 : 1;
        start = on(s, u, v);
      }
      return {start, sum(sum(start, rise), random.vector(0.3 * height)), sum(start, rise, 1.5)};
    }
    case PairFamily::hugging: {
      const double gap = std::pow(10.0, random.in(-6, -2));
      const Point base = sum(p, s.up, gap);
      const double along_b = random.in(-0.5, 0.5), along_a = random.in(-0.5, 0.5);
      return parallelogram(base, sum({0, 0, 0}, s.a, along_a), sum({0, 0, 0}, s.b, along_b));
    }
    case PairFamily::tiny:
      return floating(random, pair, 1e-3);
    case PairFamily::standing: {
      const double u = random.unit();
      if (u < 0.3) return parallelogram(on(s, 0, random.unit()), s.a, rise);    // right across
      if (u < 0.5) return parallelogram(on(s, 0, 0), s.b, rise);                // along a border
      if (u < 0.7) return parallelogram(on(s, 0.5, random.unit()), s.a, rise);  // across the border
      return parallelogram(p, sum(q, p, -1), {s.up[0] * height, s.up[1] * height, s.up[2] * height});  // upright
    }
    default:
      return floating(random, pair, 1);
  }
}

/// Two rectangles that share an edge, and a partition on an edge of one of them.
ObstructedPair cornered(Numbers& random) {
  ObstructedPair pair;
  const double length = random.in(0.3, 2), width = random.in(0.3, 2), height = random.in(0.3, 2);
  const double lean = random.in(-0.5, 0.5) * height;
  pair.from = parallelogram({0, 0, 0}, {width, 0, 0}, {0, length, 0});
  pair.to = parallelogram({0, 0, 0}, {0, length, 0}, {lean, 0, height});
  const double part = random.in(0.2, 1.1), along = random.in(0, 0.6);
  const double u = random.unit();
  const double top = random.in(0.2, 1.2) * height;
  if (u < 0.3) {  // from wall to wall across the floor, as high as the other or not
    pair.plates.push_back(parallelogram({part * width, 0, 0}, {0, length, 0}, {random.in(-0.2, 0.2), 0, top}));
  } else if (u < 0.6) {  // out of the shared edge, across both
    const double at = along * length;
    pair.plates.push_back(parallelogram({0, at, 0}, {part * width, 0, 0}, {part * lean, 0, part * height}));
  } else if (u < 0.8) {  // hanging from the upper edge
    pair.plates.push_back(parallelogram({lean, 0, height}, {0, part * length, 0}, {0.5 * width, 0, -0.3 * top}));
  } else {  // a triangle into the corner
    pair.plates.push_back({{0, along * length, 0}, {part * width, along * length, 0}, {lean, length, part * height}});
  }
  return pair;
}

/// Two rectangles that share an edge, and a partition that stands on the one and nearly touches the other.
ObstructedPair gapped(Numbers& random) {
  ObstructedPair pair;
  pair.from = parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  pair.to = parallelogram({0, 0, 0}, {0, 1, 0}, {0, 0, 1});
  const double at = random.in(0.2, 0.8), gap = std::pow(10.0, random.in(-5, -2));
  const double slant = random.unit() < 0.5 ? gap : 0;
  const double width = random.in(0.2, 1), height = random.in(0.2, 1);
  const double foot = slant > 0 ? 0 : gap;
  pair.plates.push_back({{foot, at, 0}, {width, at, 0}, {width, at, height}, {foot + slant, at, height}});
  return pair;
}

/// Two plates that leave a corner open each, and a triangle between them.
ObstructedPair stacked(Numbers& random) {
  ObstructedPair pair;
  pair.from = parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  pair.to = parallelogram({0, 0, 1}, {0, 1, 0.3}, {1, 0, 0});
  const double edge = random.in(0.3, 0.7), tip = random.in(-0.99, -0.8);
  pair.plates.push_back(parallelogram({-5, -5, 0.3}, {10, 0, 0}, {0, 5 + edge, 0}));
  pair.plates.push_back(parallelogram({-5, -5, 0.6}, {5 + edge, 0, 0}, {0, 10, 0}));
  pair.plates.push_back({{-3, 2, 0.5}, {3, tip, 0.45}, {3, 4, 0.46}});
  return pair;
}

}  // namespace

std::string_view name(PairFamily family) {
  constexpr std::array<std::string_view, 9> kNames{"floating", "on_an_edge", "on_a_vertex", "hugging", "tiny",
                                                   "standing", "cornered",   "gapped",      "stacked"};
  return kNames[static_cast<std::size_t>(family)];
}

ObstructedPair obstructed_pair(PairFamily family, int index) {
  Numbers random(1000003u * (1 + static_cast<std::uint64_t>(family)) + static_cast<std::uint64_t>(index));
  if (family == PairFamily::cornered) return cornered(random);
  if (family == PairFamily::gapped) return gapped(random);
  if (family == PairFamily::stacked) return stacked(random);
  ObstructedPair pair;
  const double distance = random.in(0.3, 2), size = random.in(0.3, 1.5);
  pair.from = parallelogram({0, 0, 0}, {1, 0, 0}, {random.in(-0.3, 0.3), random.in(0.5, 1.5), 0});
  // Above `from`, leaning by less than would let its plane meet it.
  const double lean = random.in(-0.25, 0.25) * distance;
  const double rise = random.in(-0.1, 0.1);
  const double x = random.in(-0.5, 0.7), y = random.in(-0.5, 0.7);
  pair.to = parallelogram({x, y, distance}, {0, size, rise}, {size, 0, lean * size});
  pair.plates.push_back(special(random, family, pair));
  if (family == PairFamily::standing) return pair;
  // One plate in fifteen pairs of twenty, two in four, three in one.
  const int more = index % 20 < 15 ? 0 : index % 20 < 19 ? 1 : 2;
  for (int k = 0; k < more; ++k) pair.plates.push_back(floating(random, pair, 1));
  return pair;
}

}  // namespace etendue::oracle
