// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "etendue/assembly/exchange_method.hpp"
#include "etendue/form_factor/certified.hpp"
#include "etendue/form_factor/certified_outline.hpp"

namespace etendue {

/// What is asked of enclosures, for the factor from either side of a pair.
struct CertifiedGoals {
  CertifiedGoal free, obstructed;
};

/// The exchange area of two surfaces between two numbers, and how that came about.
struct EnclosedExchange {
  Interval exchange;        ///< A_i F_ij [length²]
  CertifiedFactor factor;   ///< F_ij, what it took and what narrowed it
  bool averted = false;     ///< neither has a part in front of the other: certainly 0
  bool obstructed = false;  ///< some faces could not be shown to stay out of the way
};

/// Enclosures: exchange areas whose bounds are proved, rounding and all, by certified_form_factor(), past whatever faces
/// may stand in between.                                                                   @eq IU.6-3, IU.6-4
///
/// A face is left out only where that is shown: its own elements' pairs, faces beyond an axis-parallel plane or with both
/// elements on one side of theirs (exact signs); the rest is handed over.
///
/// Accuracy  proved, for what certified_form_factor() means by its polygons
class CertifiedExchange : public ExchangeMethod {
 public:
  /// `mesh` must outlive it. The tolerance is asked of all pairs.
  CertifiedExchange(const ElementMesh& mesh, const Tolerance& tolerance);
  CertifiedExchange(const ElementMesh& mesh, const CertifiedGoal& free, const CertifiedGoal& obstructed);
  void find(std::span<const SurfacePair> pairs, std::span<Bounded> exchanges, TileReport& report) const override;
  std::vector<std::size_t> blockers(const SurfacePair& pair) const override;
  std::string manner(const SurfacePair& pair) const override;

  [[nodiscard]] EnclosedExchange enclosed(const SurfacePair& pair) const;
  /// Of an element, half its Newell sum's length.
  const Interval& area(std::size_t element) const { return areas_[element]; }

 private:
  struct Bounds {
    Vec3 low, high;
  };
  bool may_block(std::size_t face, const SurfacePair& pair) const;

  const ElementMesh& mesh_;
  CertifiedGoals goals_;
  std::vector<Interval> areas_;
  std::vector<Bounds> face_bounds_, element_bounds_;
  std::vector<Interval> heights_;  ///< of elements' corners over faces' planes: [face · elements + element]
};

}  // namespace etendue
