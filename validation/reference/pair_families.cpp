// SPDX-License-Identifier: Apache-2.0
#include "reference/pair_families.hpp"

#include <array>
#include <utility>
#include <vector>

namespace etendue::validation::pairs {

namespace {

Pair general(Random& random) {
  const Point at = above(random, 0.2, 3);
  const Loops from{placed(star(random, 3 + random.below(6)), kOrigin, kFloor)};
  const Axes axes = facing(random_axes(random), at, kOrigin);
  return {from, {placed(star(random, 3 + random.below(6)), at, axes)}};
}

/// From y = 0 along (0, y, z): the edge from (0, 0, 0) to (1, 0, 0) belongs to both.
Pair hinged(Random& random, double y, double z) {
  const auto far = [&] { return dyadic(random.between(0.3, 2)); };
  const auto slant = [&] { return dyadic(random.between(-0.4, 0.4)); };
  const double h = far(), k = far(), a = far(), b = far(), s = slant(), t = slant();
  return {{{{0, 0, 0}, {1, 0, 0}, {1 + slant(), a, 0}, {slant(), b, 0}}},
          {{{1, 0, 0}, {0, 0, 0}, {s, h * y, h * z}, {1 + t, k * y, k * z}}}};
}

Pair shared_edge(Random& random) {
  const double t = random.between(0.05, 2.5);  // tan of half the dihedral angle, from 6° to 136°
  return hinged(random, dyadic((1 - t * t) / (1 + t * t)), dyadic(2 * t / (1 + t * t)));
}

Pair shared_vertex(Random& random) {
  const auto between = [&](double low, double high) { return dyadic(random.between(low, high)); };
  const double a = between(0.3, 1), b = between(0.3, 1);
  std::vector<Point> from{{0, 0, 0}, {between(0.5, 1), between(-0.3, 0.2), 0}, {a, b, 0}};
  if (random.below(2) == 0) from.push_back({between(-0.4, 0), between(0.5, 1), 0});
  const Point p{between(-1, 1), between(-1, 1), between(0.2, 1)}, q{between(-1, 1), between(-1, 1), between(0.3, 1)};
  const Axes axes = facing({p, q}, kOrigin, {0.4, 0.4, 0});
  std::vector<Point> to{kOrigin, axes.u, axes.v};
  if (random.below(2) == 0) to = {kOrigin, axes.u, combine(kOrigin, 0.75, axes.u, 0.625, axes.v), axes.v};
  return {{from}, {to}};
}

Pair coplanar_neighbours(Random& random, std::size_t index) {
  double slope = 1;  // folded up a little, or (every fourth) not at all
  for (std::size_t k = 0; k < 3 + index / 4 % 18; ++k) slope /= 2;
  if (index % 4 == 3) slope = 0;
  Pair pair = hinged(random, -1, slope);
  if (index % 4 == 2) {
    const double shift = dyadic(random.between(-1.5, 1.5));  // beside one another along the common line
    for (Point& p : pair.to[0]) p[0] += shift;
  }
  return pair;
}

Pair standing_on(Random& random) {
  const auto between = [&](double low, double high) { return dyadic(random.between(low, high)); };
  const Point foot{between(-0.5, 0.2), between(-0.5, 0.5), 0}, along{between(0.2, 1), between(-0.5, 0.5), 0};
  const Point up{between(-0.6, 0.6), between(-0.6, 0.6), between(0.3, 1.5)};
  const double lean = between(-0.3, 0.3);
  std::vector<Point> wall{combine(foot, 1, along, 0, up), foot, combine(foot, lean, along, 1, up),
                          combine(foot, 0.75, along, 1.25, up)};
  if (random.below(2) == 0) wall = {wall[1], wall[0], wall[3], wall[2]};
  return {{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}}, {wall}};
}

Pair near_touch(Random& random, std::size_t index) {
  const double gap = dyadic(power_of_ten(3 + static_cast<double>(index % 6), random), 0x1p-40);
  const Flat flat = star(random, 3 + random.below(4));
  const Point shift{dyadic(random.between(-0.5, 0.5)), dyadic(random.between(-0.5, 0.5)), gap};
  if (index / 6 % 2 == 0) {  // plates
    const Flat other = index / 12 % 2 == 0 ? flat : star(random, 3 + random.below(4));
    const Point at = index / 24 % 2 == 0 ? Point{0, 0, gap} : shift;
    std::vector<Point> to = placed(other, at, kFloor);
    return {{placed(flat, kOrigin, kFloor)}, {{to.rbegin(), to.rend()}}};
  }
  // A panel that leans over the floor, its lowest edge or corner a gap above.
  const Point along{dyadic(random.between(0.3, 1)), dyadic(random.between(-0.3, 0.3)),
                    index / 12 % 2 == 0 ? 0 : dyadic(random.between(0.1, 1))};
  const Point up{dyadic(random.between(-0.5, 0.5)), dyadic(random.between(-1, 1)), dyadic(random.between(0.1, 1))};
  const Axes axes = facing({along, up}, {0, 0, 1}, kOrigin);
  return {{placed(flat, kOrigin, kFloor)},
          {{shift, combine(shift, 1, axes.u, 0, axes.v), combine(shift, 1, axes.u, 1, axes.v),
            combine(shift, 0, axes.u, 1, axes.v)}}};
}

Pair size_ratio(Random& random, std::size_t index) {
  double scale = 1;
  for (std::size_t k = 0; k < index % 21; ++k) scale /= 2;  // to 2^-20 ≈ 1e-6
  const Point at = above(random, 0.3, 2);
  const Loops from{placed(star(random, 3 + random.below(4)), kOrigin, kFloor)};
  const Axes axes = facing(random_axes(random), at, kOrigin);
  Pair pair{from, {placed(star(random, 3 + random.below(4)), at, axes, scale)}};
  if (index / 21 % 2 == 0) std::swap(pair.from, pair.to);
  return pair;
}

Pair distance(Random& random, std::size_t index) {
  double far = 1;
  for (std::size_t k = 0; k < index % 21; ++k) far *= 2;
  const Point way = above(random, 0.3, 1);
  const Point at{far * way[0], far * way[1], far * way[2]};
  const Loops from{placed(star(random, 3 + random.below(4)), kOrigin, kFloor)};
  const Axes axes = facing(random_axes(random), at, kOrigin);
  return {from, {placed(star(random, 3 + random.below(4)), at, axes)}};
}

Pair sliver(Random& random, std::size_t index) {
  double narrow = 1;
  for (std::size_t k = 0; k < 3 + index % 18; ++k) narrow /= 2;
  const auto thin = [&](Flat flat) {
    for (auto& p : flat) p[1] *= narrow;
    return flat;
  };
  const std::size_t kind = index / 18 % 4;
  if (kind == 3) {  // hinged on a broad one along its long edge
    Pair pair = shared_edge(random);
    for (std::size_t i = 2; i < 4; ++i) {
      for (std::size_t c = 1; c < 3; ++c) pair.to[0][i][c] *= narrow;
    }
    if (index / 72 % 2 == 0) std::swap(pair.from, pair.to);
    return pair;
  }
  const Point at = above(random, 0.2, 1.5);
  const Flat a = star(random, 3 + random.below(3)), b = star(random, 3 + random.below(3));
  return {{placed(kind != 1 ? thin(a) : a, kOrigin, kFloor)},
          {placed(kind != 0 ? thin(b) : b, at, facing(random_axes(random), at, kOrigin))}};
}

/// A star with one or two holes around the middle, every radius of the star beyond them.
Loops holed(Random& random, const Point& at, const Axes& axes, bool plain) {
  Loops region{placed(star(random, 6 + random.below(6), 0.62), at, axes)};
  if (plain) return region;
  const auto hole = [&](double x, double y, double size) {
    Flat flat;
    for (const auto& p : star(random, 3 + random.below(3), 0.6)) flat.push_back({x + size * p[0], y + size * p[1]});
    std::vector<Point> loop = placed(flat, at, axes);
    region.push_back({loop.rbegin(), loop.rend()});
  };
  if (random.below(2) == 0) {
    hole(0, 0, 0.25);
  } else {
    hole(-0.15625, 0.03125, 0.125);
    hole(0.15625, -0.0625, 0.125);
  }
  return region;
}

Pair with_holes(Random& random, std::size_t index) {
  const Point at = above(random, 0.5, 2.5);
  return {holed(random, kOrigin, kFloor, index % 4 == 1),
          holed(random, at, facing(random_axes(random), at, kOrigin), index % 4 == 2)};
}

}  // namespace

Pair make(std::size_t family, std::size_t index) {
  Random random(family, index);
  Pair pair;
  if (family == 0) pair = general(random);
  if (family == 1) pair = shared_edge(random);
  if (family == 2) pair = shared_vertex(random);
  if (family == 3) pair = coplanar_neighbours(random, index);
  if (family == 4) pair = standing_on(random);
  if (family == 5) pair = near_touch(random, index);
  if (family == 6) pair = size_ratio(random, index);
  if (family == 7) pair = distance(random, index);
  if (family == 8) pair = sliver(random, index);
  if (family == 9) pair = with_holes(random, index);
  // Edges that overlap along a line would be hairs apart in a rounded frame, and their factors no longer known.
  const bool overlap = family == 3 && index % 4 == 2;
  pair.exact_frame = random.below(2) == 0 || overlap;
  const auto whole = [&] { return static_cast<double>(random.below(5)) - 2; };
  std::array<Point, 3> axes;
  if (pair.exact_frame) {  // in this order: that of arguments is the compiler's choice
    const double z = whole(), y = whole(), x = whole();
    axes = rotation(1 + static_cast<double>(random.below(3)), x, y, z);
  } else {
    axes = random_rotation(random);
  }
  for (Loops* loops : {&pair.from, &pair.to}) {
    for (auto& loop : *loops) {
      for (Point& p : loop)
        p = combine({axes[2][0] * p[2], axes[2][1] * p[2], axes[2][2] * p[2]}, p[0], axes[0], p[1], axes[1]);
    }
  }
  return pair;
}

}  // namespace etendue::validation::pairs
