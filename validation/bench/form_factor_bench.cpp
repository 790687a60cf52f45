// SPDX-License-Identifier: Apache-2.0
// Rates of the form factors, beside the rule that many programs use: 4 × 4 × 4 × 4 Gauss nodes, no error bound.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "etendue/execution/execution.hpp"
#include "etendue/form_factor/factor_rows.hpp"
#include "etendue/form_factor/gauss_legendre.hpp"
#include "etendue/form_factor/obstructed.hpp"
#include "etendue/form_factor/polygon_polygon.hpp"
#include "reference/pair_geometry.hpp"

namespace {

using etendue::Polygon;
using etendue::Vec3;

Polygon rectangle(const Vec3& o, const Vec3& a, const Vec3& b) {
  return Polygon::make({o, o + a, o + a + b, o + b}).value();
}

const Polygon kFloor = rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});

Polygon leaning_at(double distance) {
  return rectangle({0.3, 0.2, distance}, {0, 1, 0.1}, {1, 0, 0.2});
}

double tensor_rule(const Polygon& from, const Polygon& to) {
  const auto nodes = etendue::gauss_legendre(4);
  const auto at = [](const Polygon& p, double s, double t) {
    const auto& v = p.vertices();
    return Vec3(v[0] + 0.5 * (1 + s) * (v[1] - v[0]) + 0.5 * (1 + t) * (v[3] - v[0]));
  };
  double sum = 0;
  for (const auto& a : nodes) {
    for (const auto& b : nodes) {
      const Vec3 p = at(from, a.x, b.x);
      for (const auto& c : nodes) {
        for (const auto& d : nodes) {
          const Vec3 r = at(to, c.x, d.x) - p;
          const double square = r.squaredNorm();
          sum -=
              a.weight * b.weight * c.weight * d.weight * r.dot(from.normal()) * r.dot(to.normal()) / (square * square);
        }
      }
    }
  }
  return sum * to.area() / (16 * std::numbers::pi);
}

void baseline_gauss_4_4_4_4(benchmark::State& state) {
  const Polygon to = leaning_at(static_cast<double>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(tensor_rule(kFloor, to));
}

/// Distance in tenths of a side, digits asked.
void form_factor_at(benchmark::State& state) {
  const Polygon to = leaning_at(0.1 * static_cast<double>(state.range(0)));
  double asked = 1;
  for (int i = 0; i < state.range(1); ++i) asked /= 10;
  for (auto _ : state) benchmark::DoNotOptimize(etendue::form_factor(kFloor, to, {asked, 0}));
}

void form_factor_of_a_shared_edge(benchmark::State& state) {
  const Polygon wall = rectangle({0, 0, 0}, {0, 1, 0}, {-0.3, 0, 1});
  for (auto _ : state) benchmark::DoNotOptimize(etendue::form_factor(kFloor, wall, {1e-10, 0}));
}

void obstructed_by_one_in_the_middle(benchmark::State& state) {
  const Polygon to = leaning_at(1);
  const std::vector<Polygon> blockers{rectangle({0.3, 0.3, 0.5}, {0.4, 0, 0.1}, {0, 0.5, 0})};
  for (auto _ : state) {
    benchmark::DoNotOptimize(etendue::obstructed_form_factor(kFloor, to, blockers, {1e-4, 1e-6}));
  }
}

/// 64 random quadrilaterals of edge 0.6 to 1 at `distance`, or hinged where it is 0: median and worst of a hundred.
void single_pairs(benchmark::State& state) {
  const double distance = 0.01 * static_cast<double>(state.range(0));
  double asked = 1;
  for (int i = 0; i < state.range(1); ++i) asked /= 10;
  std::vector<std::pair<Polygon, Polygon>> pairs;
  for (std::size_t i = 0; pairs.size() < 64; ++i) {
    etendue::validation::pairs::Random random(40, i);
    const auto edge = [&] { return random.between(0.6, 1); };
    const auto r = etendue::validation::pairs::random_rotation(random);
    const auto axis = [&](std::size_t k) { return Vec3(r[k][0], r[k][1], r[k][2]); };
    const Vec3 a = edge() * axis(0), b = edge() * axis(1), floor_a(edge(), 0, 0), floor_b(0, edge(), 0);
    if (distance == 0) {
      if (axis(0).z() > 0.1)
        pairs.emplace_back(rectangle({0, 0, 0}, floor_a, floor_b), rectangle({0, 0, 0}, floor_b, a));
      continue;
    }
    const Vec3 centre(random.between(-0.3, 0.3), random.between(-0.3, 0.3), 1), way = distance * centre.normalized();
    const bool away = a.cross(b).dot(way) > 0;
    pairs.emplace_back(rectangle(-0.5 * (floor_a + floor_b), floor_a, floor_b),
                       rectangle(way - 0.5 * (a + b), away ? b : a, away ? a : b));
  }
  std::vector<double> times;
  for (auto _ : state) {
    for (const auto& [from, to] : pairs) {
      const auto start = std::chrono::steady_clock::now();
      benchmark::DoNotOptimize(etendue::form_factor(from, to, {asked, 0}));
      times.push_back(std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count());
    }
  }
  std::sort(times.begin(), times.end());
  state.counters["p50_ns"] = times[times.size() / 2];
  state.counters["p99_ns"] = times[times.size() * 99 / 100];
}

/// An empty cube of 6 × 26 × 26 = 4,056 squares.
std::vector<Polygon> squares_of_a_room() {
  constexpr int kSide = 26;
  std::vector<Polygon> polygons;
  const auto wall = [&](const Vec3& o, const Vec3& a, const Vec3& b) {
    for (int i = 0; i < kSide; ++i) {
      for (int j = 0; j < kSide; ++j)
        polygons.push_back(rectangle(o + a * i / kSide + b * j / kSide, a / kSide, b / kSide));
    }
  };
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), o(0, 0, 0);
  wall(o, x, y);
  wall(z, y, x);
  wall(o, z, x);
  wall(y, x, z);
  wall(o, y, z);
  wall(x, z, y);
  return polygons;
}

/// Every pair once, a row an item of work: digits asked, threads.
void empty_room(benchmark::State& state) {
  double asked = 1;
  for (int i = 0; i < state.range(0); ++i) asked /= 10;
  const std::vector<Polygon> polygons = squares_of_a_room();
  const std::size_t n = polygons.size();
  std::vector<double> worst(n, 0);
  for (auto _ : state) {
    const etendue::FactorRows rows(polygons);
    etendue::parallel_for(n, {static_cast<int>(state.range(1)), {}, nullptr}, [&](std::size_t i) {
      std::vector<etendue::IndexPair> pairs;
      pairs.reserve(n - i);
      for (std::size_t j = i + 1; j < n; ++j)
        pairs.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
      std::vector<etendue::Bounded> row(pairs.size());
      rows.pairs(pairs, {asked, 0}, etendue::AbsoluteError::of_this, row);
      double widest = 0;  // here, not in worst[i]: threads would wait for each other's cache lines
      for (const auto& f : row) widest = std::max(widest, f.bound > 0 ? f.bound / f.value : 0);
      worst[i] = widest;
    });
  }
  state.counters["ns_per_pair"] =
      benchmark::Counter(1e-9 * static_cast<double>(n * (n - 1) / 2),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["worst_bound"] = *std::max_element(worst.begin(), worst.end());
}

BENCHMARK(single_pairs)
    ->ArgsProduct({{5000, 1200, 600, 300, 150, 75, 0}, {6, 9, 12}})
    ->ArgNames({"distance_percent", "digits"});
BENCHMARK(empty_room)
    ->ArgsProduct({{6, 9}, {1, 2}})
    ->ArgNames({"digits", "threads"})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Repetitions(5)
    ->ReportAggregatesOnly();
BENCHMARK(baseline_gauss_4_4_4_4)->Arg(1);
BENCHMARK(form_factor_at)->ArgsProduct({{5, 10, 30, 100, 1000}, {6, 10}});
BENCHMARK(form_factor_of_a_shared_edge);
BENCHMARK(obstructed_by_one_in_the_middle);

}  // namespace
