// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "etendue/assembly/exact_exchange.hpp"
#include "etendue/assembly/surface_model.hpp"

namespace etendue {

/// Exact integration over a model that has round surfaces too. Pairs of flat elements with nothing round between them are
/// ExactExchange's; all others are curved_exchange()'s, past every body that may stand between.    @eq IU.6-3, IU.6-4
///
/// Accuracy  as those say: where something round takes part, measured
class CurvedExchange : public ExchangeMethod {
 public:
  /// `model` must outlive it.
  CurvedExchange(const SurfaceModel& model, const AssemblyTolerance& tolerance);
  void find(std::span<const SurfacePair> pairs, std::span<Bounded> exchanges, TileReport& report) const override;
  /// As SurfaceModel::blocker_name() numbers them.
  std::vector<std::size_t> blockers(const SurfacePair& pair) const override;

 private:
  struct Body {
    CurvedBlocker shape;
    std::vector<Vec3> points;           ///< of a flat body, its corners
    std::size_t first_face, last_face;  ///< of a flat body
    std::optional<std::size_t> round;   ///< of a round one
    std::optional<Vec3> plane_normal;   ///< of a plate
  };
  struct Patch {
    CurvedPatch shape;
    std::size_t face;                  ///< of a flat one
    std::optional<std::size_t> round;  ///< of a round one
    std::optional<Vec3> normal;        ///< of a flat one or a disc
    double area;
  };

  Patch patch(std::size_t element) const;
  bool own(const Body& body, const Patch& patch) const;
  bool may_block(const Body& body, const Patch& first, const Patch& second) const;
  std::vector<const CurvedBlocker*> between(const Patch& first, const Patch& second, bool* round) const;
  Bounded find(const Patch& first, const Patch& second, TileReport& report) const;

  const SurfaceModel& model_;
  AssemblyTolerance tolerance_;
  std::optional<ExactExchange> flat_;
  std::vector<Body> bodies_;
  std::vector<std::vector<std::size_t>>
      capped_by_;  ///< of each round surface: discs that close it, the cylinder it closes
  double slack_ = 0;
};

}  // namespace etendue
