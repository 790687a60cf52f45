// SPDX-License-Identifier: Apache-2.0
#include "oracles/obstructed_factor.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "oracles/corners.hpp"
#include "support/counter_random.hpp"

namespace etendue::oracle {

namespace {

struct HalfSpace {
  Point normal;
  double level;
};

void cut(Corners& loop, const HalfSpace& half) {
  Corners kept;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point &a = loop[i], &b = loop[(i + 1) % loop.size()];
    const double ha = dot(half.normal, a) - half.level, hb = dot(half.normal, b) - half.level;
    if (ha >= 0) kept.push_back(a);
    if (ha * hb < 0) kept.push_back(mix(a, b, ha / (ha - hb)));
  }
  loop.swap(kept);
}

/// Lambert's formula, for a loop relative to the point.
double lambert(const Corners& loop, const Point& up) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point &a = loop[i], &b = loop[(i + 1) % loop.size()];
    const Point n = cross(b, a);
    const double size = norm(n);
    if (size > 0) sum += std::atan2(size, dot(a, b)) * dot(n, up) / size;
  }
  return sum / (2 * std::numbers::pi);
}

class View {
 public:
  explicit View(const ObstructedPair& pair) : pair_(pair) {
    const Point n = newell(pair.from);
    const double size = norm(n);
    up_ = {n[0] / size, n[1] / size, n[2] / size};
  }

  double visible(const Point& x) const {
    Corners receiver;
    for (const Point& p : pair_.to) receiver.push_back(sub(p, x));
    std::vector<std::vector<HalfSpace>> shadows;
    for (const Corners& plate : pair_.plates) {
      Corners seen;
      for (const Point& p : plate) seen.push_back(sub(p, x));
      Point n = newell(seen);
      double level = dot(n, seen[0]);
      const double side = level > 0 ? 1 : -1;
      if (level == 0) continue;
      for (double& v : n) v *= side;
      std::vector<HalfSpace> shadow{{n, side * level}};
      for (std::size_t i = 0; i < seen.size(); ++i) {
        Point wall = cross(seen[i], seen[(i + 1) % seen.size()]);
        for (double& v : wall) v *= side;
        shadow.push_back({wall, 0});
      }
      shadows.push_back(std::move(shadow));
    }
    return lambert(receiver, up_) - hidden(receiver, shadows, 0);
  }

 private:
  // |S_1 ∪ S_2 ∪ …| = Σ_i (|S_i| − |S_i ∩ (S_i+1 ∪ …)|), all within `region`
  double hidden(const Corners& region, const std::vector<std::vector<HalfSpace>>& shadows, std::size_t first) const {
    double sum = 0;
    for (std::size_t i = first; i < shadows.size(); ++i) {
      Corners inside = region;
      for (const HalfSpace& half : shadows[i]) {
        cut(inside, half);
        if (inside.size() < 3) break;
      }
      if (inside.size() >= 3) sum += lambert(inside, up_) - hidden(inside, shadows, i + 1);
    }
    return sum;
  }

  const ObstructedPair& pair_;
  Point up_;
};

/// Gauss and Kronrod's 7 and 15 nodes (QUADPACK's table).
constexpr std::array<double, 8> kNodes{0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
                                       0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
                                       0.586087235467691130294144691693,    0.405845151377397166906606412076961,
                                       0.207784955007898467600689403773245, 0.0};
constexpr std::array<double, 8> kKronrod{0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
                                         0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
                                         0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
                                         0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
constexpr std::array<double, 4> kGauss{0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
                                       0.381830050505118944950369775488975, 0.417959183673469387755102040816327};

template <class Function>
Estimate adaptive(const Function& f, double a, double b, double goal, int depth) {
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  double kronrod = kKronrod[7] * f(middle), gauss = kGauss[3] * f(middle);
  for (std::size_t k = 0; k < 7; ++k) {
    const double both = f(middle - half * kNodes[k]) + f(middle + half * kNodes[k]);
    kronrod += kKronrod[k] * both;
    if (k % 2 == 1) gauss += kGauss[k / 2] * both;
  }
  const Estimate whole{half * kronrod, std::abs(half * (kronrod - gauss)), 16};
  if (whole.error <= goal || depth == 0) return whole;
  const Estimate left = adaptive(f, a, middle, 0.5 * goal, depth - 1);
  const Estimate right = adaptive(f, middle, b, 0.5 * goal, depth - 1);
  return {left.value + right.value, left.error + right.error, left.evaluations + right.evaluations + 16};
}

/// Whether d points between a and b as seen from the origin, with a margin: a break too many does no harm.
bool between(const Point& d, const Point& a, const Point& b) {
  constexpr double kMargin = 1e-6;
  const Point n = cross(a, b);
  const double square = dot(n, n);
  if (!(square > 0)) return true;
  const double size = norm(d);
  const double on_a = dot(cross(d, b), n) / square * norm(a), on_b = dot(cross(a, d), n) / square * norm(b);
  return on_a >= -kMargin * size && on_b >= -kMargin * size;
}

class Slices {
 public:
  Slices(const ObstructedPair& pair, double angle, double goal) : pair_(pair), view_(pair), goal_(goal) {
    const Point n = newell(pair.from);
    const Point edge = sub(pair.from[1], pair.from[0]);
    const double size = norm(n), length = norm(edge);
    Point x, y;
    for (std::size_t k = 0; k < 3; ++k) x[k] = edge[k] / length;
    y = cross(n, x);
    for (std::size_t k = 0; k < 3; ++k) {
      y[k] /= size;
      along_[k] = std::cos(angle) * x[k] + std::sin(angle) * y[k];
      across_[k] = -std::sin(angle) * x[k] + std::cos(angle) * y[k];
    }
    loops_.push_back(pair.to);
    loops_.insert(loops_.end(), pair.plates.begin(), pair.plates.end());
  }

  Estimate integrate() {
    std::vector<double> breaks;
    for (const Point& p : pair_.from) breaks.push_back(dot(sub(p, pair_.from[0]), across_));
    std::sort(breaks.begin(), breaks.end());
    const double first = breaks.front(), last = breaks.back(), span = last - first;
    for (const double s : corner_slices()) {
      if (s > first && s < last) breaks.push_back(s);
    }
    std::sort(breaks.begin(), breaks.end());
    Estimate sum;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      const double width = breaks[i + 1] - breaks[i];
      if (!(width > 1e-14 * span)) continue;
      constexpr int kDeepest = 24;
      const Estimate part =
          adaptive([&](double s) { return slice(s, span); }, breaks[i], breaks[i + 1], goal_ * width / span, kDeepest);
      sum.value += part.value;
      sum.error += part.error;
    }
    sum.error += 4 * goal_;  // the slices' own goals
    sum.evaluations = evaluations_;
    return sum;
  }

 private:
  Point at(double s, double t) const {
    Point p = pair_.from[0];
    for (std::size_t k = 0; k < 3; ++k) p[k] += s * across_[k] + t * along_[k];
    return p;
  }

  /// The slices through the points of `from` that see two corners in line, or hold a corner: where lines end or meet, and
  /// small shadows begin.
  std::vector<double> corner_slices() const {
    std::vector<double> slices;
    const Point up = newell(pair_.from);
    const double reach = norm(sub(pair_.from[2], pair_.from[0]));
    const auto note = [&](const Point& x) {
      if (norm(sub(x, pair_.from[0])) < 2 * reach) slices.push_back(dot(sub(x, pair_.from[0]), across_));
    };
    for (std::size_t i = 0; i < loops_.size(); ++i) {
      for (const Point& a : loops_[i]) {
        const double height = dot(up, sub(a, pair_.from[0]));
        if (height == 0) note(a);
        for (std::size_t j = 0; j < i; ++j) {
          for (const Point& b : loops_[j]) {
            const double other = dot(up, sub(b, pair_.from[0]));
            if (other != height) note(mix(a, b, height / (height - other)));
          }
        }
      }
    }
    return slices;
  }

  double slice(double s, double span) {
    double low = 1e300, high = -1e300;
    for (std::size_t i = 0; i < pair_.from.size(); ++i) {
      const Point a = sub(pair_.from[i], pair_.from[0]);
      const Point b = sub(pair_.from[(i + 1) % pair_.from.size()], pair_.from[0]);
      const double sa = dot(a, across_) - s, sb = dot(b, across_) - s;
      if (sa * sb > 0 || sa == sb) continue;
      const double t = dot(mix(a, b, sa / (sa - sb)), along_);
      low = std::min(low, t);
      high = std::max(high, t);
    }
    if (!(high > low)) return 0;
    std::vector<double> breaks{low, high};
    find_breaks(s, low, high, breaks);
    std::sort(breaks.begin(), breaks.end());
    double sum = 0;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      const double width = breaks[i + 1] - breaks[i];
      if (!(width > 1e-13 * (high - low))) continue;
      constexpr int kDeepest = 30;
      const double goal = goal_ / span * std::max(width / (high - low), 1e-3);
      const Estimate part =
          adaptive([&](double t) { return view_.visible(at(s, t)); }, breaks[i], breaks[i + 1], goal, kDeepest);
      sum += part.value;
      evaluations_ += part.evaluations;
    }
    return sum;
  }

  void find_breaks(double s, double low, double high, std::vector<double>& breaks) const {
    const Point p0 = at(s, low), p1 = at(s, high);
    const auto note = [&](double share) { breaks.push_back(low + share * (high - low)); };
    const auto crossing = [&](const Point& normal, const Point& on) {
      const double h0 = dot(normal, sub(p0, on)), h1 = dot(normal, sub(p1, on));
      return h0 * h1 < 0 ? h0 / (h0 - h1) : -1;
    };
    for (const Corners& plate : pair_.plates) {
      const double t = crossing(newell(plate), plate[0]);
      if (t > 0) note(t);
    }
    for (std::size_t i = 0; i < loops_.size(); ++i) {
      for (std::size_t j = 0; j < loops_.size(); ++j) {
        if (i != j) corner_breaks(loops_[i], loops_[j], p0, p1, crossing, note);
      }
    }
    for (std::size_t i = 0; i < loops_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        for (std::size_t k = 0; k < j; ++k) curve_breaks(loops_[i], loops_[j], loops_[k], p0, p1, note);
      }
    }
  }

  template <class Crossing, class Note>
  static void corner_breaks(const Corners& corners, const Corners& edges, const Point& p0, const Point& p1,
                            const Crossing& crossing, const Note& note) {
    for (const Point& v : corners) {
      for (std::size_t e = 0; e < edges.size(); ++e) {
        const Point &a = edges[e], &b = edges[(e + 1) % edges.size()];
        const double t = crossing(cross(sub(a, v), sub(b, v)), v);
        if (!(t > 0)) continue;
        const Point x = mix(p0, p1, t);
        if (between(sub(v, x), sub(a, x), sub(b, x))) note(t);
      }
    }
  }

  template <class Note>
  static void curve_breaks(const Corners& first, const Corners& second, const Corners& third, const Point& p0,
                           const Point& p1, const Note& note) {
    const Point middle = mix(p0, p1, 0.5);
    for (std::size_t i = 0; i < first.size(); ++i) {
      const Point &a0 = first[i], &a1 = first[(i + 1) % first.size()];
      for (std::size_t j = 0; j < second.size(); ++j) {
        const Point &b0 = second[j], &b1 = second[(j + 1) % second.size()];
        for (std::size_t k = 0; k < third.size(); ++k) {
          const Point &c0 = third[k], &c1 = third[(k + 1) % third.size()];
          const auto value = [&](const Point& x) {
            return dot(cross(cross(sub(a0, x), sub(a1, x)), cross(sub(b0, x), sub(b1, x))),
                       cross(sub(c0, x), sub(c1, x)));
          };
          const double start = value(p0), half = value(middle), end = value(p1);
          const double square = 2 * (start + end - 2 * half), linear = end - start - square;
          const double under = linear * linear - 4 * square * start;
          if (!(under >= 0)) continue;
          const double root = -0.5 * (linear + std::copysign(std::sqrt(under), linear));
          for (const double t : {root / square, start / root}) {
            if (!(t > 0 && t < 1)) continue;
            const Point x = mix(p0, p1, t);
            Point d = cross(cross(sub(a0, x), sub(a1, x)), cross(sub(b0, x), sub(b1, x)));
            if (dot(d, sub(a0, x)) < 0) {
              for (double& v : d) v = -v;
            }
            if (between(d, sub(a0, x), sub(a1, x)) && between(d, sub(b0, x), sub(b1, x)) &&
                between(d, sub(c0, x), sub(c1, x))) {
              note(t);
            }
          }
        }
      }
    }
  }

  const ObstructedPair& pair_;
  View view_;
  double goal_;
  Point along_{}, across_{};
  std::vector<Corners> loops_;
  long evaluations_ = 0;
};

bool stops(const Corners& plate, const Point& p, const Point& q) {
  const Point n = newell(plate), d = sub(q, p);
  const double hp = dot(n, sub(p, plate[0])), hq = dot(n, sub(q, plate[0]));
  if (hp * hq >= 0) return false;
  const double side = hq > 0 ? 1 : -1;
  for (std::size_t i = 0; i < plate.size(); ++i) {
    if (side * dot(cross(sub(plate[i], p), sub(plate[(i + 1) % plate.size()], p)), d) < 0) return false;
  }
  return true;
}

/// Of a triangle fan, by area: uniform.
Point point_in(const Corners& c, double u, double v) {
  double total = 0;
  std::vector<double> areas;
  for (std::size_t i = 1; i + 1 < c.size(); ++i) {
    areas.push_back(norm(cross(sub(c[i], c[0]), sub(c[i + 1], c[0]))));
    total += areas.back();
  }
  u *= total;
  std::size_t i = 0;
  while (i + 1 < areas.size() && u > areas[i]) u -= areas[i++];
  const double r = std::sqrt(std::min(u / areas[i], 1.0));
  return mix(c[0], mix(c[i + 1], c[i + 2], v), r);
}

}  // namespace

Estimate obstructed_exchange(const ObstructedPair& pair, double angle, double goal) {
  return Slices(pair, angle, goal).integrate();
}

ObstructedPair reversed(const ObstructedPair& pair) {
  return {pair.to, pair.from, pair.plates};
}

Estimate obstructed_exchange_by_points(const ObstructedPair& pair, int side, std::uint64_t seed) {
  const Point n1 = newell(pair.from), n2 = newell(pair.to);
  double sum = 0, squares = 0;
  const long strata = static_cast<long>(side) * side * side * side;
  for (long s = 0; s < strata; ++s) {
    long rest = s;
    std::array<double, 4> u{};
    for (std::size_t k = 0; k < 4; ++k) {
      validation::CounterRandom random(seed * 0x2545f4914f6cdd1du + static_cast<std::uint64_t>(4 * s) + k);
      u[k] = (static_cast<double>(rest % side) + random.unit()) / side;
      rest /= side;
    }
    const Point p = point_in(pair.from, u[0], u[1]), q = point_in(pair.to, u[2], u[3]);
    bool hidden = false;
    for (const Corners& plate : pair.plates) hidden = hidden || stops(plate, p, q);
    const Point d = sub(q, p);
    const double square = dot(d, d);
    const double term = hidden ? 0 : -dot(d, n1) * dot(d, n2) / (4 * std::numbers::pi * square * square);
    sum += term;
    squares += term * term;
  }
  const auto count = static_cast<double>(strata);
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(squares / count - mean * mean, 0.0) / count), strata};
}

}  // namespace etendue::oracle
