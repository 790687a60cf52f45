// SPDX-License-Identifier: Apache-2.0
// Generator of pair_form_factor.csv: pairs of polygons in general position, and their form factors at 600 bits.
//   cmake --build <dir> --target pair-form-factor-table; <dir>/validation/pair-form-factor-table > pair_form_factor.csv
// Each row: family, vertices of from, vertices of to (x y z x y z …, 17 digits), factor, the quadrature's estimate.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "oracles/pair_form_factor.hpp"
#include "support/counter_random.hpp"

namespace {

using etendue::oracle::Point;
using Loop = std::vector<Point>;
using Random = etendue::validation::CounterRandom;

/// A rotation from a random quaternion, then a shift and a scale.
struct Frame {
  std::array<Point, 3> axes;
  Point origin{};
  double scale = 1;

  Point place(const Point& p) const {
    Point r;
    for (std::size_t i = 0; i < 3; ++i) {
      r[i] = origin[i] + scale * (axes[0][i] * p[0] + axes[1][i] * p[1] + axes[2][i] * p[2]);
    }
    return r;
  }
  Loop place(const Loop& loop) const {
    Loop placed;
    for (const Point& p : loop) placed.push_back(place(p));
    return placed;
  }
};

Frame random_frame(Random& random) {
  double q[4], norm = 0;
  do {
    norm = 0;
    for (double& c : q) {
      c = random.between(-1, 1);
      norm += c * c;
    }
  } while (norm > 1 || norm < 0.1);
  for (double& c : q) c /= std::sqrt(norm);
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  return {{Point{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
           Point{2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
           Point{2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}},
          {},
          1};
}

/// Counter-clockwise in the plane z = 0, of size one: a triangle, a convex quadrilateral, or an L.
Loop flat(Random& random, int kind) {
  const auto wobble = [&] { return random.between(-0.1, 0.1); };
  if (kind == 0) return {{0, 0, 0}, {1 + wobble(), wobble(), 0}, {0.4 + wobble(), 0.9 + wobble(), 0}};
  if (kind == 1) return {{0, 0, 0}, {1 + wobble(), wobble(), 0}, {1 + wobble(), 1 + wobble(), 0}, {wobble(), 1, 0}};
  const double a = 0.5 + wobble(), b = 0.5 + wobble();
  return {{0, 0, 0}, {1, 0, 0}, {1, b, 0}, {a, b, 0}, {a, 1, 0}, {0, 1, 0}};
}

// One draw a statement: compilers evaluate arguments in orders of their own. The order below, a second polygon's place
// from the last coordinate to the first, then its shape, is the one in which the table was once drawn.

/// Turned around x by the angle (π faces straight down), its near side lifted to `height`, shifted sideways.
Loop facing(const Loop& loop, double angle, double height, double shift_x, double shift_y) {
  Loop turned;
  for (const Point& p : loop) {
    turned.push_back({p[0] + shift_x, std::cos(angle) * p[1] + shift_y, std::sin(angle) * p[1] + height});
  }
  return turned;
}

void print(const Loop& loop) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) std::printf("%s%.17g", i + c > 0 ? " " : "", loop[i][c]);
  }
}

void row(const char* family, const Loop& from, const Loop& to, double planarity) {
  const auto truth = etendue::oracle::pair_form_factor(from, to, planarity);
  // The finer level has about twice the digits of the difference; decisions must be clear of rounding.
  constexpr double kConverged = 1e-9, kClear = 1e-9;
  if (!(truth.factor > 0) || truth.estimate > kConverged || truth.margin < kClear) {
    std::fprintf(stderr, "%s missed its case: F %g, estimate %g, margin %g\n", family, truth.factor, truth.estimate,
                 truth.margin);
    std::exit(1);
  }
  std::printf("%s,", family);
  print(from);
  std::printf(",");
  print(to);
  std::printf(",%.17g,%.1e\n", truth.factor, truth.estimate);
}

constexpr double kPi = 3.14159265358979323846;
constexpr double kExactPlanarity = 1e-13;

void general(Random& random) {
  for (int i = 0; i < 24; ++i) {
    const Frame frame = random_frame(random);
    const Loop from = flat(random, i % 3);
    const double shift_y = random.between(0, 1);
    const double shift_x = random.between(-1, 1);
    const double height = random.between(1, 3);
    const double angle = random.between(2.2, 4);
    const Loop to = facing(flat(random, i / 3 % 3), angle, height, shift_x, shift_y);
    row("general", frame.place(from), frame.place(to), kExactPlanarity);
  }
}

/// The first edge in common: same two vertices, opposite order.
void hinged(Random& random) {
  for (int i = 0; i < 20; ++i) {
    const double angle = (30 + 30 * (i % 5)) * kPi / 180;
    const Frame frame = random_frame(random);
    const double right = random.between(0.3, 2);
    const double left = random.between(0.3, 2);
    const Loop from{{0, 0, 0}, {1, 0, 0}, {1, right, 0}, {0, left, 0}};
    const double h = random.between(0.3, 2);
    const double k = random.between(0.3, 2);
    const Loop to{{1, 0, 0},
                  {0, 0, 0},
                  {0, h * std::cos(angle), h * std::sin(angle)},
                  {1, k * std::cos(angle), k * std::sin(angle)}};
    Loop a = frame.place(from), b = frame.place(to);
    row("shared edge", a, b, kExactPlanarity);
  }
}

void cornered(Random& random) {
  for (int i = 0; i < 10; ++i) {
    const Frame frame = random_frame(random);
    const Loop from = flat(random, i % 3);
    const double opening = random.between(0.5, 2);
    const Loop to = facing(flat(random, i % 2), opening, 0, 0, 0);
    Loop turned;  // the second polygon leans away from the first around their common corner
    for (const Point& p : to) turned.push_back({-p[0] * 0.8 + 0.3 * p[2], p[1], p[2] + 0.2 * std::abs(p[0])});
    // Keep it plane: three points of it, in the order that faces the first.
    Loop triangle{turned[0], turned[1], turned[2]};
    row("shared vertex", frame.place(from), frame.place(triangle), kExactPlanarity);
  }
}

void piercing(Random& random) {
  for (int i = 0; i < 12; ++i) {
    const Frame frame = random_frame(random);
    const Loop from = flat(random, i % 3);
    const double shift_y = random.between(0.5, 0.9);
    const double shift_x = random.between(-0.4, 0.4);
    const double height = random.between(-0.3, -0.1);
    const double angle = random.between(1.2, 2.2);
    const Loop to = facing(flat(random, i / 3 % 3), angle, height, shift_x, shift_y);
    row("piercing", frame.place(from), frame.place(to), kExactPlanarity);
  }
}

void scaled_and_moved(Random& random) {
  for (int i = 0; i < 18; ++i) {
    Frame frame = random_frame(random);
    const char* family = "scale 1e-6";
    if (i % 3 == 0) frame.scale = 1e-6;
    if (i % 3 == 1) {
      family = "scale 1e6";
      frame.scale = 1e6;
    }
    if (i % 3 == 2) {
      family = "offset 1e6";
      frame.origin = {1e6, -2e6, 1.5e6};
    }
    const Loop from = flat(random, i % 2);
    const double shift_y = random.between(0, 1);
    const double shift_x = random.between(-1, 1);
    const double height = random.between(0.8, 2);
    const double angle = random.between(2.2, 4);
    const Loop to = facing(flat(random, i / 3 % 2), angle, height, shift_x, shift_y);
    row(family, frame.place(from), frame.place(to), kExactPlanarity);
  }
}

void near(Random& random) {
  for (int i = 0; i < 12; ++i) {
    const Frame frame = random_frame(random);
    const double gap = i % 2 == 0 ? 1e-6 : 1e-3;
    const Loop from = flat(random, i % 3);
    const double tilt = i % 4 < 2 ? kPi : kPi - random.between(0.05, 1);
    const double shift_x = random.between(-0.3, 0.3);
    const Loop to = facing(flat(random, i % 2), tilt, gap, shift_x, tilt == kPi ? 1 : 0.1);
    row(i % 2 == 0 ? "gap 1e-6" : "gap 1e-3", frame.place(from), frame.place(to), kExactPlanarity);
  }
}

void far(Random& random) {
  for (int i = 0; i < 16; ++i) {
    const Frame frame = random_frame(random);
    const double distances[] = {10, 1e2, 1e4, 1e6};
    const char* families[] = {"distance 10", "distance 1e2", "distance 1e4", "distance 1e6"};
    const double d = distances[i % 4];
    const Loop from = flat(random, i % 3);
    const double shift_x = random.between(-0.5, 0.5) * d;
    const double angle = random.between(2.2, 4);
    const Loop to = facing(flat(random, i % 2), angle, d, shift_x, 0.1 * d);
    row(families[i % 4], frame.place(from), frame.place(to), kExactPlanarity);
  }
}

void unequal(Random& random) {
  for (int i = 0; i < 16; ++i) {
    const Frame frame = random_frame(random);
    Loop from = flat(random, i % 2);
    const bool sliver = i % 4 == 3;
    const double size = i % 2 == 0 ? 1e-2 : 1e-4;
    for (Point& p : from) {
      p[0] = p[0] * (sliver ? 10 : size) + 0.3;
      p[1] = p[1] * size + 0.3;
    }
    const double shift_x = random.between(-0.5, 0);
    const double height = random.between(0.3, 2);
    const double angle = random.between(2.2, 3.3);
    const Loop to = facing(flat(random, 1), angle, height, shift_x, 1);
    Loop a = frame.place(from), b = frame.place(to);
    if (i % 8 < 4) std::swap(a, b);
    row(sliver ? "sliver" : "unequal", a, b, kExactPlanarity);
  }
}

}  // namespace

int main() {
  std::printf("family,from,to,factor,estimate\n");
  Random random(20240229);
  general(random);
  hinged(random);
  cornered(random);
  piercing(random);
  scaled_and_moved(random);
  near(random);
  far(random);
  unequal(random);
}
