// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "etendue/assembly/exact_exchange.hpp"
#include "etendue/assembly/hemicube_exchange.hpp"
#include "etendue/refinement/patch_model.hpp"

namespace etendue {

/// Form factors between patches and elements, a patch or an element at a time.
class PatchFactors {
 public:
  virtual ~PatchFactors() = default;

  /// F_jq from patch j to the elements that it sees, by number of element.                        @eq IU.6-12, IU.6.7.2
  /// The bits depend on nothing but the patch. Empty where the execution was stopped: ask its flag.
  [[nodiscard]] virtual std::vector<SeenShare> from_patch(std::size_t patch, const Execution& execution) = 0;

  /// F_qj from element q to the patches that it sees; SeenShare::element is the patch.              @eq IU.6-16
  [[nodiscard]] virtual std::vector<SeenShare> from_element(std::size_t element) const = 0;

  /// Do Σ_q F_jq ≤ 1 and Σ_j A_j F_jq / A_q ≤ 1 hold but for errors that are bounded pair by pair? Only then the gap of
  /// the radiosities can be bounded: shooting_gap().
  [[nodiscard]] virtual bool reciprocal() const = 0;

  /// Pairs whose bound misses what was asked so far; always 0 where nothing is asked.
  [[nodiscard]] virtual std::size_t missed() const { return 0; }
};

/// One hemicube on the patch (or settings.points² of them) sees the elements; one on an element sees the patches.
///
/// Accuracy  no bound: the inner integral is taken as constant over the patch (docs/hemicube.md has measured errors). Each
///           pixel belongs to one element, so Σ_q F_jq ≤ 1 but for rounding; Σ_j A_j F_jq/A_q may exceed one
[[nodiscard]] std::unique_ptr<PatchFactors> hemicube_factors(const PatchModel& model, const HemicubeSettings& settings);

/// Exact integration between patch and element, past obstacles, as ExactExchange has it; the same value both ways.
[[nodiscard]] std::unique_ptr<PatchFactors> exact_factors(const PatchModel& model, const AssemblyTolerance& tolerance);

/// Elements that have received nothing and, by a coarse hemicube on their centroids, see no front: they lie under or in
/// something, or face the void. A display leaves them out of its means.
[[nodiscard]] std::vector<std::size_t> without_view(const PatchModel& model, const std::vector<Rgb>& irradiance,
                                                    const Execution& execution);

/// What a memory of columns may take: 256 bytes an element, but 8 MiB in any case.
[[nodiscard]] std::size_t column_budget(const PatchModel& model);

/// Keeps columns of `source` as long as they fit into `bytes`, for patches that shoot again. The same bits.
[[nodiscard]] std::unique_ptr<PatchFactors> remembered(std::unique_ptr<PatchFactors> source, std::size_t patches,
                                                       std::size_t bytes);

}  // namespace etendue
