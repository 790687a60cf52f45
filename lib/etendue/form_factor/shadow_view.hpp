// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "etendue/form_factor/sight_zone.hpp"

namespace etendue {

/// The receiver past the outlines of a zone, from one point of the source after the other: exact but for rounding.
///
/// The hidden part is taken off outline by outline, a half-space of its cone at a time; what is left over is seen. No
/// memory is asked for once the buffers have grown.
class ShadowView {
 public:
  ShadowView(std::span<const Vec3> receiver, std::span<const Outline> outlines);

  /// Factors of a point of the source: of the whole receiver, and of what is hidden of it.
  struct Seen {
    double free = 0;
    double hidden = 0;
    double bound = 0;  ///< on the rounding error of either, together
  };
  /// What is not asked for stays 0.
  enum class Want { hidden, both, both_bounded };
  Seen from(const Vec2& x, Want want);

  /// What a rule over a cell around x is chosen by.
  struct Survey {
    double free = 0, hidden = 0;
    bool none = true;  ///< nothing is hidden
    bool all = false;  ///< nothing is seen
    double reach = 0;  ///< how far x may move, to complex points even, before the factor stops being analytic: to the
                       ///< nearest edge, or until two that cross in the view are one; estimated, NOTES.md §5
  };
  [[nodiscard]] Survey survey(const Vec2& x);

 private:
  using Part = std::vector<Vec3>;
  /// What a survey gathers on the way.
  struct Trace {
    double to_edges;        ///< least distance of an edge of an outline that hides something
    double to_lines;        ///< of the line of an edge that cuts
    double least_sine = 1;  ///< of the angle in the view between two edges that meet there
  };
  void note_shadow(const Outline& loop, const Part& hidden, const Vec3& eye);
  void take_shadow(std::size_t outline, const Vec3& eye, bool last, Want want, Seen& seen);
  double turning_of(const Outline& loop, const Vec3& eye) const;

  std::span<const Vec3> receiver_;
  std::span<const Outline> outlines_;
  std::vector<Part> parts_, remaining_;  ///< of which the first `used` count
  std::size_t used_ = 0, kept_ = 0;
  std::vector<Vec3> planes_;
  std::vector<double> heights_;
  Part buffer_;
  Trace* trace_ = nullptr;  ///< only while surveying
};

}  // namespace etendue
