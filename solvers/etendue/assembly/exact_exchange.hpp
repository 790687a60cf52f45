// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/assembly/exchange_method.hpp"
#include "etendue/assembly/form_factor_matrix.hpp"
#include "etendue/assembly/sight.hpp"

namespace etendue {

/// Exact integration: form_factor() where nothing stands between two elements, obstructed_form_factor() where something
/// does.                                                                                   @eq IU.6-3, IU.6-4
///
/// Accuracy  clear pairs: as form_factor() bounds them, proved. Obstructed pairs: computed from both sides; the larger
///           value is taken, since what an adaptive rule overlooks is a narrow gap, and its bound is the larger of the
///           two estimates and of the difference: measured (two_sided_factor()). Touching surfaces: as kTouching says
class ExactExchange : public ExchangeMethod {
 public:
  /// `mesh` must outlive it.
  ExactExchange(const ElementMesh& mesh, const AssemblyTolerance& tolerance);
  void find(std::span<const SurfacePair> pairs, std::span<Bounded> exchanges, TileReport& report) const override;
  std::vector<std::size_t> blockers(const SurfacePair& pair) const override;

 private:
  const ElementMesh& mesh_;
  SightMap sights_;
  AssemblyTolerance tolerance_;
};

}  // namespace etendue
