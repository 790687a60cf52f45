// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "etendue/assembly/exchange_method.hpp"
#include "etendue/assembly/surface_model.hpp"

namespace etendue {

struct RaySettings {
  int rays = 10000;        ///< from every element
  std::uint64_t seed = 1;  ///< another seed, other rays
};

/// Probability that a single bound of the ray method does not hold.
inline constexpr double kRayDoubt = 1e-6;

/// Half-width of the interval in which the chance of an event lies that happened `count` times of `of`, by Chernoff's bound
/// of − log(δ/2)/of on the relative entropy: holds at any count with probability 1 − `doubt`.
/// Source    Chernoff 1952, Hoeffding 1963 (theorem 1)
[[nodiscard]] double chance_bound(std::uint64_t count, std::uint64_t of, double doubt);

/// The rough method: rays leave each element as Lambert's law wants, and are counted where they arrive. Needs no formula
/// and no case, so it judges the others; a digit more costs a hundred times the rays.               @eq IU.6-4
///
/// Accuracy  each bound holds with probability 1 − kRayDoubt: proved, up to the quality of the generator. Of the two
///           elements of a pair the smaller sends the rays that count
/// Order     the same rays with any number of threads
class RayExchange : public ExchangeMethod {
 public:
  /// Sends all rays, from the elements of the mesh and then from `rounds`. Neither need outlive it. When stopped it holds nothing: see complete().
  RayExchange(const ElementMesh& mesh, const RaySettings& settings, const Execution& execution,
              std::span<const RoundSurface> rounds = {});
  void find(std::span<const SurfacePair> pairs, std::span<Bounded> exchanges, TileReport& report) const override;

  bool complete() const { return complete_; }

 private:
  using Arrivals = std::vector<std::pair<std::size_t, std::uint64_t>>;  ///< element, rays; ordered by element
  RaySettings settings_;
  std::vector<double> areas_;
  std::vector<Arrivals> arrivals_;
  bool complete_ = false;
};

}  // namespace etendue
