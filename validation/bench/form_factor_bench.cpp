// SPDX-License-Identifier: Apache-2.0
// Rates of the form factors, beside the rule that many programs use: 4 × 4 × 4 × 4 Gauss nodes, no error bound.
#include <benchmark/benchmark.h>

#include <numbers>
#include <vector>

#include "etendue/form_factor/gauss_legendre.hpp"
#include "etendue/form_factor/obstructed.hpp"
#include "etendue/form_factor/polygon_polygon.hpp"

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

BENCHMARK(baseline_gauss_4_4_4_4)->Arg(1);
BENCHMARK(form_factor_at)->ArgsProduct({{5, 10, 30, 100, 1000}, {6, 10}});
BENCHMARK(form_factor_of_a_shared_edge);
BENCHMARK(obstructed_by_one_in_the_middle);

}  // namespace
