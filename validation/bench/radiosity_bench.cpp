// SPDX-License-Identifier: Apache-2.0
// The radiosity equation of 6,000 patches and three channels, to a proved 1e-10, beside what there is to compare with: an LU
// of LAPACK (where OpenBLAS was found) or Eigen's with three solves, and a plain matrix–vector product on all threads.
#include <benchmark/benchmark.h>

#include <Eigen/LU>
#include <cmath>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include "etendue/assembly/schedule.hpp"
#include "etendue/radiosity/certificate.hpp"
#include "etendue/radiosity/solve.hpp"

#ifdef ETENDUE_OPENBLAS
extern "C" void dgesv_(const int* n, const int* rhs, double* a, const int* lda, int* pivots, double* b, const int* ldb,
                       int* info);
#endif

namespace {

using etendue::DenseFactors;
using etendue::RadiosityEquation;
using etendue::RadiosityGoal;
using etendue::RadiositySolver;
using etendue::RowMatrix;

constexpr Eigen::Index kPatches = 6000;

/// A closed room, wider than high: patches at random on its six walls, their exchange that of small patches, closed and
/// kept reciprocal by symmetric scaling. ρ up to 0.8, a few lamps.
RadiosityEquation room() {
  const Eigen::Index n = kPatches;
  std::uint64_t state = 1;
  const auto draw = [&state] {  // splitmix64
    std::uint64_t z = state += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  };
  const double size[3] = {6, 4, 2.5};
  Eigen::MatrixXd points(3, n), normals = Eigen::MatrixXd::Zero(3, n);
  RadiosityEquation equation{nullptr, Eigen::MatrixXd(n, 3), Eigen::MatrixXd::Zero(n, 3), Eigen::VectorXd(n), {}};
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index wall = i % 6, axis = wall / 2;
    for (Eigen::Index k = 0; k < 3; ++k) points(k, i) = size[k] * draw();
    points(axis, i) = wall % 2 == 0 ? 0 : size[axis];
    normals(axis, i) = wall % 2 == 0 ? 1 : -1;
    equation.areas(i) = 0.5 + draw();
    for (Eigen::Index c = 0; c < 3; ++c) equation.reflectance(i, c) = 0.8 * draw();
    equation.reflectance(i, 0) = 0.8;
    if (i % 97 == 5) equation.emission.row(i).setConstant(100);
  }
  RowMatrix exchange(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      const Eigen::Vector3d line = points.col(j) - points.col(i);
      const double r2 = line.squaredNorm() + 0.05;
      const double cosines = std::max(0.0, line.dot(normals.col(i))) * std::max(0.0, -line.dot(normals.col(j)));
      exchange(i, j) = exchange(j, i) = cosines / (r2 * r2) * equation.areas(i) * equation.areas(j);
    }
  }
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(n);
  for (int sweep = 0; sweep < 40; ++sweep) {
    const Eigen::VectorXd sums = exchange * scale;
    scale = (scale.array() * equation.areas.array() / sums.array()).sqrt().matrix();
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) exchange(i, j) *= scale(i) * scale(j) / equation.areas(i);
  }
  equation.factors = std::make_shared<DenseFactors>(std::move(exchange), etendue::on_threads(0));
  return equation;
}

const RadiosityEquation& shared_room() {
  static const RadiosityEquation equation = room();
  return equation;
}

const RowMatrix& matrix() {
  return dynamic_cast<const DenseFactors&>(*shared_room().factors).matrix();
}

/// All n² numbers of F, once.
constexpr double kPass = static_cast<double>(kPatches) * static_cast<double>(kPatches) * sizeof(double);

void bandwidth(benchmark::State& state, double passes) {
  state.counters["GB/s"] = benchmark::Counter(passes * kPass * 1e-9, benchmark::Counter::kIsIterationInvariantRate,
                                              benchmark::Counter::kIs1000);
}

/// The yardstick: Eigen's product, the rows divided evenly among the threads.
void plain_product(benchmark::State& state) {
  const RowMatrix& f = matrix();
  const Eigen::VectorXd x = shared_room().areas;
  Eigen::VectorXd y(kPatches);
  const auto threads = static_cast<Eigen::Index>(std::max(1u, std::thread::hardware_concurrency()));
  for (auto _ : state) {
    std::vector<std::thread> team;
    for (Eigen::Index t = 0; t < threads; ++t) {
      team.emplace_back([&, t] {
        const Eigen::Index first = t * kPatches / threads, count = (t + 1) * kPatches / threads - first;
        y.segment(first, count).noalias() = f.middleRows(first, count) * x;
      });
    }
    for (std::thread& thread : team) thread.join();
    benchmark::DoNotOptimize(y.data());
  }
  bandwidth(state, 1);
}
BENCHMARK(plain_product)->Unit(benchmark::kMillisecond)->UseRealTime();

void product_of_three_channels(benchmark::State& state) {
  const Eigen::MatrixXd x = shared_room().reflectance;
  for (auto _ : state) benchmark::DoNotOptimize(shared_room().factors->times(x));
  bandwidth(state, 1);
}
BENCHMARK(product_of_three_channels)->Unit(benchmark::kMillisecond)->UseRealTime();

void bound_of_a_solution(benchmark::State& state) {
  const etendue::RadiosityJudge judge(shared_room(), etendue::row_sums(*shared_room().factors));
  const Eigen::MatrixXd b = shared_room().emission;
  for (auto _ : state) benchmark::DoNotOptimize(judge.judge(b));
  bandwidth(state, 1);
}
BENCHMARK(bound_of_a_solution)->Unit(benchmark::kMillisecond)->UseRealTime();

void solve(benchmark::State& state) {
  RadiosityGoal goal;
  goal.solver = static_cast<RadiositySolver>(state.range(0));
  double passes = 0;
  for (auto _ : state) {
    const auto solution = etendue::solve_radiosity(shared_room(), goal);
    if (!solution || solution->status != etendue::RadiosityStatus::reached) state.SkipWithError("not solved to 1e-10");
    if (solution) passes = static_cast<double>(solution->passes);
  }
  state.SetLabel(etendue::name(goal.solver));
  state.counters["passes"] = passes;
  bandwidth(state, passes);
}
BENCHMARK(solve)
    ->Arg(static_cast<int>(RadiositySolver::conjugate_gradients))
    ->Arg(static_cast<int>(RadiositySolver::gmres))
    ->Arg(static_cast<int>(RadiositySolver::bicgstab))
    ->Arg(static_cast<int>(RadiositySolver::jacobi))
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// One factorisation of I − diag(ρ)F and three right-hand sides.
void lu_and_three_solves(benchmark::State& state) {
  const RadiosityEquation& equation = shared_room();
  for (auto _ : state) {
    state.PauseTiming();
    Eigen::MatrixXd m = -(equation.reflectance.col(0).asDiagonal() * Eigen::MatrixXd(matrix()));
    m.diagonal().array() += 1;
    Eigen::MatrixXd b = equation.emission;
    state.ResumeTiming();
#ifdef ETENDUE_OPENBLAS
    const int n = static_cast<int>(kPatches), rhs = 3;
    int info = 0;
    std::vector<int> pivots(static_cast<std::size_t>(kPatches));
    dgesv_(&n, &rhs, m.data(), &n, pivots.data(), b.data(), &n, &info);
    if (info != 0) state.SkipWithError("singular");
#else
    b = m.partialPivLu().solve(b).eval();
#endif
    benchmark::DoNotOptimize(b.data());
  }
#ifdef ETENDUE_OPENBLAS
  state.SetLabel("OpenBLAS dgesv");
#else
  state.SetLabel("Eigen; no OpenBLAS was found");
#endif
}
BENCHMARK(lu_and_three_solves)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);

}  // namespace
