// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "etendue/core/floating_point.hpp"

namespace etendue {

/// The function f(u, v) by which a rough surface stands above a smooth one, and how it grows.              @eq IU.4.2.1
struct Relief {
  double height = 0;                ///< f [length]
  double along_u = 0, along_v = 0;  ///< ∂f/∂u, ∂f/∂v [length]
};

/// Waves: f = a cos(2π m u) cos(2π n v). With n = 0 they run along u alone. Nothing breaks at u or v = 1 where m, n are whole.
struct WaveRelief {
  double amplitude = 0;  ///< a [length]
  int along_u = 0;       ///< m
  int along_v = 0;       ///< n
};

/// What lies beyond a table of heights.
enum class TableEdges {
  periodic,  ///< the table again: the last value of a row is followed by the first
  clamped,   ///< its first and last values, on and on
};

/// Heights at columns × rows places and, between them, bicubic interpolation by Catmull and Rom: the cubic whose slope at a place is
/// half the difference of its neighbours.
///
///     f = Σ_ij k(x − i) k(y − j) h_ij;   periodic: x = m u columns, y = n v rows;  clamped: x = u (columns − 1), y = v (rows − 1)
///     k(t) = 1 − 5/2 t² + 3/2 |t|³ for |t| ≤ 1,   2 − 4|t| + 5/2 t² − 1/2 |t|³ for 1 ≤ |t| ≤ 2
struct TableRelief {
  int columns = 1, rows = 1;
  std::vector<double> heights;  ///< row by row, v growing [length]
  TableEdges edges = TableEdges::periodic;
  int repeat_u = 1, repeat_v = 1;  ///< m, n: how often a periodic table lies along u and v
};

using ReliefKind = std::variant<WaveRelief, TableRelief>;

/// f and its derivatives at a place.
///
/// Domain    finite u, v; a table of columns × rows heights, each at least 1, repeated at least once
/// Returns   continuous with its derivatives, but where waves or clamped tables end
/// Accuracy  waves: 8 u of a and of its slopes, plus what 2π m u loses: measured. Tables: the values of the kernel within 40 u of the
///           largest height. As an approximation of a smooth function sampled with step s, f is interpolated to O(s³), its
///           derivatives to O(s²); quadratic functions are reproduced. Proved: Keys 1981; tested
/// Errors    ContractViolation where the table has not as many heights as places
[[nodiscard]] Relief relief(const WaveRelief& waves, double u, double v);
[[nodiscard]] Relief relief(const TableRelief& table, double u, double v);
[[nodiscard]] Relief relief(const ReliefKind& kind, double u, double v);

/// A random part: a periodic table of independent heights, evenly distributed in [−a, a).                 @eq IU.4.2.1
///
/// Symbols   a amplitude [length]
/// Returns   height k, in rows, is a (2 r − 1) with r = number k of the counter that `seed` starts: mean 0, variance a²/3. The same
///           table on every machine; another seed, another table
/// Errors    ContractViolation unless columns, rows ≥ 1 and a is finite
[[nodiscard]] TableRelief random_relief(int columns, int rows, double amplitude, std::uint64_t seed);

}  // namespace etendue
