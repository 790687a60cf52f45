// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "etendue/form_factor/blocker.hpp"
#include "etendue/meshing/elements.hpp"

namespace etendue {

/// What may come between two elements.
enum class Sight {
  averted,    ///< no point of one lies before the other's plane: the form factor is zero
  clear,      ///< no face reaches into the space between them
  blocked,    ///< one face hides all of one from all of the other: the form factor is zero
  undecided,  ///< some faces may reach into it: they are listed
};

struct SightLine {
  Sight sight = Sight::averted;
  std::vector<std::size_t> blockers;   ///< indices into ElementMesh::faces; empty unless undecided
  std::vector<const Blocker*> bodies;  ///< the same as solids, where a whole object is one, else as plates; they live
                                       ///< in the SightMap
};

/// Which faces of a scene can stand between which elements.
///
/// `averted`, `clear` and `blocked` are decided conservatively: NOTES.md §1 proves that they are true up to slack(), the
/// rounding of coordinates. `undecided` claims nothing.
class SightMap {
 public:
  explicit SightMap(const ElementMesh& mesh);
  [[nodiscard]] SightLine between(std::size_t first, std::size_t second) const;

  /// Distance [length] below which surfaces count as touching: kHeightRoundings times the rounding of the largest
  /// coordinate.
  double slack() const { return slack_; }

 private:
  struct Range {
    double low, high;
  };
  struct Bounds {
    Vec3 low, high;
  };

  bool may_block(std::size_t face, std::size_t first, std::size_t second) const;
  bool separated(std::size_t face, std::size_t first, std::size_t second) const;
  bool hides_all(std::size_t face, std::size_t first, std::size_t second) const;

  void gather_bodies();

  const ElementMesh& mesh_;
  double slack_ = 0;
  std::vector<Blocker> bodies_;
  std::vector<std::size_t> body_of_;  ///< of every face
  std::vector<Bounds> face_bounds_;
  std::vector<Bounds> element_bounds_;
  std::vector<Range> heights_;  ///< of elements over faces' planes: [face · elements + element]
};

}  // namespace etendue
