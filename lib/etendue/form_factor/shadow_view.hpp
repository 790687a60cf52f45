// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "etendue/form_factor/sight_zone.hpp"
#include "etendue/form_factor/view_form.hpp"

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
    // How far x may move, to complex points even, before the factor stops being analytic; estimated, NOTES.md §5.
    double to_edges = 0;      ///< the nearest edge
    double to_crossings = 0;  ///< until two edges that cross in the view are one
  };
  /// The form of what is hidden is added to `form`.
  [[nodiscard]] Survey survey(const Vec2& x, ViewForm& form);

  /// What the corners of a form refer to; the receiver's edges come first.
  std::span<const ViewEdge> edges() const { return edges_; }
  /// The form of the whole receiver.
  const ViewForm& receiver_form() const { return receiver_form_; }

 private:
  /// A corner of a part of the receiver, and the edge along which the part goes on from there.
  struct Corner {
    Vec3 at;
    ViewCorner name;
    std::uint32_t edge;
  };
  using Part = std::vector<Corner>;
  /// What a survey gathers on the way.
  struct Trace {
    ViewForm& form;
    double to_edges;      ///< square of the least distance of an edge of an outline that hides something
    double to_crossings;  ///< least square of how far the eye may move until two edges that cross in the view are one
  };
  void add_loop(std::span<const Vec3> loop);
  void note_shadow(std::size_t first, std::size_t last, const Part& hidden, const Vec3& eye);
  double square_to_crossing(const ViewCorner& corner, const Vec3& eye) const;
  void take_shadow(std::size_t outline, const Vec3& eye, bool last, Want want, Seen& seen);
  void split(Part& part, std::uint32_t edge, const Vec3& eye, Part* outside);
  ViewCorner crossing(std::uint32_t part_edge, std::uint32_t edge, const Vec3& at, const Vec3& eye) const;
  double turning_of(const Outline& loop, const Vec3& eye) const;
  static double factor_of(const Part& part);

  std::span<const Vec3> receiver_;
  std::span<const Outline> outlines_;
  std::vector<ViewEdge> edges_;
  std::vector<std::uint32_t> next_;  ///< the edge after each in its loop
  ViewForm receiver_form_;
  std::vector<Part> parts_, remaining_;  ///< of which the first `used` count
  std::size_t used_ = 0, kept_ = 0;
  std::vector<Vec3> planes_;
  std::vector<double> heights_;
  Part buffer_;
  Trace* trace_ = nullptr;  ///< only while surveying
};

}  // namespace etendue
