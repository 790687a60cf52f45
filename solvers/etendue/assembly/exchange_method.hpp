// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "etendue/assembly/exchange_matrix.hpp"
#include "etendue/execution/execution.hpp"
#include "etendue/meshing/elements.hpp"

namespace etendue {

/// Two surfaces, i < j.
struct SurfacePair {
  std::size_t i, j;
};

/// A way to find exchange areas A_i F_ij. To add one, derive from this and name it in the command form-factors.
class ExchangeMethod {
 public:
  virtual ~ExchangeMethod() = default;

  /// Finds the exchange areas of `pairs`, in their order, and their bounds [length²]; counts what happened in `report`.
  /// The answer for a pair depends on nothing but the pair. Called from several threads at once.
  virtual void find(std::span<const SurfacePair> pairs, std::span<Bounded> exchanges, TileReport& report) const = 0;

  /// The faces that may stand between two surfaces; empty where the method does not ask.
  virtual std::vector<std::size_t> blockers(const SurfacePair& pair) const;

  /// How the answer for a pair is found, in a few words; empty where all pairs are alike.
  virtual std::string manner(const SurfacePair& pair) const;
};

/// What to ask of a factor for `asked`: a little less, so that a bound that just reaches it still does after the roundings
/// that lead to the exchange area.
[[nodiscard]] inline Tolerance with_room(const Tolerance& asked) {
  constexpr double kRoomForRounding = 1 - 0x1p-10;
  return {kRoomForRounding * asked.relative, kRoomForRounding * asked.absolute};
}

/// Is the bound of an exchange area within the tolerance, for the factor from either side?
[[nodiscard]] bool reached(const Bounded& exchange, double area_i, double area_j, const Tolerance& tolerance);

/// Fills the tiles of `matrix` that are not done, each pair once. Pairs beyond `tolerance` are counted, never dropped.
///
/// Order     the same bits with any number of threads, and however often stopped; stops between tiles
/// Returns   whether the matrix is complete
bool fill_exchanges(ExchangeMatrix& matrix, const ExchangeMethod& method, const Tolerance& tolerance,
                    const Execution& execution);

/// Areas of the elements, in their order.
[[nodiscard]] std::vector<double> areas_of(const ElementMesh& mesh);

}  // namespace etendue
