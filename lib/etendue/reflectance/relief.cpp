// SPDX-License-Identifier: Apache-2.0
#include "etendue/reflectance/relief.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "etendue/core/contract.hpp"
#include "etendue/core/split_mix.hpp"

namespace etendue {

namespace {

/// Weights of four places in a row, for the value and for its slope, at t in [0, 1) behind the second.
struct Weights {
  std::array<double, 4> value, slope;
};

Weights catmull_rom(double t) {
  const double t2 = t * t, t3 = t2 * t;
  return {{(-t3 + 2 * t2 - t) / 2, (3 * t3 - 5 * t2 + 2) / 2, (-3 * t3 + 4 * t2 + t) / 2, (t3 - t2) / 2},
          {(-3 * t2 + 4 * t - 1) / 2, (9 * t2 - 10 * t) / 2, (-9 * t2 + 8 * t + 1) / 2, (3 * t2 - 2 * t) / 2}};
}

/// One direction of a table: the four places that count, their weights, and how the place grows with u or v.
struct Axis {
  std::array<std::size_t, 4> at;
  Weights weights;
  double growth;

  Axis(double share, int count, TableEdges edges, int repeat) {
    const bool periodic = edges == TableEdges::periodic;
    growth = periodic ? 1.0 * count * repeat : count - 1;
    // A period more or less changes nothing; without them the place is known as well as it can be.
    const double turns = share * repeat;
    const double place = periodic ? (turns - std::floor(turns)) * count : share * growth;
    const double first = std::floor(periodic ? place : std::clamp(place, -2.0, count + 1.0));
    const double beyond = periodic ? place - first : std::clamp(place, -2.0, count + 1.0) - first;
    weights = catmull_rom(beyond);
    for (int k = 0; k < 4; ++k) {
      const int index = static_cast<int>(first) + k - 1;
      at[static_cast<std::size_t>(k)] =
          static_cast<std::size_t>(periodic ? ((index % count) + count) % count : std::clamp(index, 0, count - 1));
    }
  }
};

}  // namespace

Relief relief(const WaveRelief& waves, double u, double v) {
  const double m = 2 * std::numbers::pi * waves.along_u, n = 2 * std::numbers::pi * waves.along_v;
  const double a = waves.amplitude;
  return {a * std::cos(m * u) * std::cos(n * v), -a * m * std::sin(m * u) * std::cos(n * v),
          -a * n * std::cos(m * u) * std::sin(n * v)};
}

Relief relief(const TableRelief& table, double u, double v) {
  require(table.columns >= 1 && table.rows >= 1 && table.repeat_u >= 1 && table.repeat_v >= 1,
          "relief: the table has columns and rows, and lies there at least once");
  const auto columns = static_cast<std::size_t>(table.columns), rows = static_cast<std::size_t>(table.rows);
  require(table.heights.size() == columns * rows, "relief: the table has a height for each place");
  require(std::isfinite(u) && std::isfinite(v), "relief: the place is finite");
  const Axis x(u, table.columns, table.edges, table.repeat_u), y(v, table.rows, table.edges, table.repeat_v);
  Relief sum;
  for (std::size_t j = 0; j < 4; ++j) {
    double value = 0, slope = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      const double height = table.heights[y.at[j] * columns + x.at[i]];
      value += x.weights.value[i] * height;
      slope += x.weights.slope[i] * height;
    }
    sum.height += y.weights.value[j] * value;
    sum.along_u += y.weights.value[j] * slope * x.growth;
    sum.along_v += y.weights.slope[j] * value * y.growth;
  }
  return sum;
}

Relief relief(const ReliefKind& kind, double u, double v) {
  return std::visit([&](const auto& each) { return relief(each, u, v); }, kind);
}

TableRelief random_relief(int columns, int rows, double amplitude, std::uint64_t seed) {
  require(columns >= 1 && rows >= 1, "random_relief: at least one column and one row");
  require(std::isfinite(amplitude), "random_relief: the amplitude is finite");
  TableRelief table;
  table.columns = columns;
  table.rows = rows;
  table.heights.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  const std::uint64_t start = split_mix(seed + kGoldenStep);
  for (std::size_t k = 0; k < table.heights.size(); ++k)
    table.heights[k] = amplitude * (2 * unit_interval(split_mix(start + (k + 1) * kGoldenStep)) - 1);
  return table;
}

}  // namespace etendue
