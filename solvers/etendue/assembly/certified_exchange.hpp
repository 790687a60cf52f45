// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/assembly/exchange_method.hpp"
#include "etendue/assembly/sight.hpp"

namespace etendue {

/// Enclosures: exchange areas whose bounds are proved, rounding and all, by certified_form_factor(). Of a partly obstructed
/// pair nothing is known here but that its factor lies between 0 and the unobstructed one: the enclosure is that wide, and
/// such pairs count as beyond the tolerance unless the whole of it is within.                            @eq IU.6-3
///
/// Accuracy  proved, but for the decisions which faces may stand in between: those are true up to kTouching
class CertifiedExchange : public ExchangeMethod {
 public:
  /// `mesh` must outlive it.
  CertifiedExchange(const ElementMesh& mesh, const Tolerance& tolerance);
  void find(std::span<const SurfacePair> pairs, std::span<Bounded> exchanges, TileReport& report) const override;
  std::vector<std::size_t> blockers(const SurfacePair& pair) const override;

 private:
  const ElementMesh& mesh_;
  SightMap sights_;
  Tolerance tolerance_;
};

}  // namespace etendue
