// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "etendue/assembly/exchange_method.hpp"
#include "etendue/assembly/pair_factor.hpp"
#include "etendue/assembly/sight.hpp"
#include "etendue/form_factor/factor_rows.hpp"

namespace etendue {

/// Of the pairs with nothing between them, one in so many is also computed from the other side.
inline constexpr std::size_t kCheckedClearPairs = 16;

/// A pair of elements and F_ij; zero where they are averted or blocked.
struct SeenPair {
  PairSight sight = PairSight::averted;
  PairFactor found;
};

/// Exact integration: FactorRows where nothing stands between two elements, obstructed_form_factor() where something does.
///                                                                                            @eq IU.6-3, IU.6-4
/// Accuracy  clear pairs: as form_factor() bounds them, proved. Obstructed pairs: as obstructed_form_factor()
///           estimates them, measured; one in kCheckedObstructedPairs, and those sampled across curves of three edges, from
///           both sides, with the larger of the two estimates and of the difference (two_sided_factor()). Touching surfaces: as kTouching says
/// Order     a pair's bits depend on nothing but the pair: clear ones are computed from the lower number
class ExactExchange : public ExchangeMethod {
 public:
  /// `mesh` must outlive it.
  ExactExchange(const ElementMesh& mesh, const AssemblyTolerance& tolerance);
  void find(std::span<const SurfacePair> pairs, std::span<Bounded> exchanges, TileReport& report) const override;
  std::vector<std::size_t> blockers(const SurfacePair& pair) const override;

  /// F_ij of each pair, in their order. `error` says whether the absolute tolerance is asked of F_ji, too.
  [[nodiscard]] std::vector<SeenPair> factors(std::span<const SurfacePair> pairs, AbsoluteError error) const;

 private:
  struct Tile;
  void find_clear(const Tile& tile, AbsoluteError error, std::vector<SeenPair>& seen) const;
  void find_obstructed(const Tile& tile, AbsoluteError error, std::vector<SeenPair>& seen) const;

  const ElementMesh& mesh_;
  SightMap sights_;
  FactorRows rows_;
  AssemblyTolerance tolerance_;
};

}  // namespace etendue
