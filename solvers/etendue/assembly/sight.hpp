// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
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
  std::vector<std::size_t> blockers;  ///< indices into ElementMesh::faces; empty unless undecided
  std::vector<const Blocker*>
      bodies;  ///< the same as solids, where an object or several close one, else as plates; they
               ///< live in the SightMap
};

/// Which faces of a scene can stand between which elements.
///
/// `averted`, `clear` and `blocked` are decided conservatively: NOTES.md §1 proves that they are true up to slack(), the
/// rounding of coordinates. `undecided` claims nothing. Memory: of the order of faces and elements, not of their product.
class SightMap {
 public:
  explicit SightMap(const ElementMesh& mesh);
  [[nodiscard]] SightLine between(std::size_t first, std::size_t second) const;

  /// Distance [length] below which surfaces count as touching: kHeightRoundings times the rounding of the largest
  /// coordinate.
  double slack() const { return slack_; }

 private:
  struct Bounds {
    Vec3 low, high;
  };
  /// A sphere around a polygon or a body.
  struct Ball {
    Vec3 centre;
    double radius;
  };
  /// What can stand in the way: a solid, or a single face.
  struct Body {
    Ball ball;
    Bounds bounds;
    std::vector<Vec3> directions;     ///< of its edges, parallel ones once
    std::vector<std::size_t> faces;   ///< those with elements on both sides of their planes
    std::vector<std::size_t> planes;  ///< all of them
    std::size_t blocker;              ///< index into blockers_
  };
  struct Pair;

  void gather_bodies();
  bool add_solid(std::span<const std::size_t> faces, const std::vector<Polygon>& welded_faces);
  void add_body(std::span<const std::size_t> faces, Blocker blocker);
  bool reached_into(const Body& body) const;
  bool stands_between(const Body& body, const Pair& pair) const;
  bool separated(const Body& body, const Pair& pair) const;
  bool splits(std::size_t face, const Pair& pair) const;
  bool hides_all(std::size_t face, const Pair& pair) const;

  const ElementMesh& mesh_;
  double slack_ = 0;
  std::vector<Blocker> blockers_;
  std::vector<Body> bodies_;               ///< solids, then single faces; those that can never block are left out
  std::vector<std::vector<Vec3>> inward_;  ///< of each face's edges, across them, of length one
  std::vector<Bounds> element_bounds_;
  std::vector<Ball> element_balls_;
};

}  // namespace etendue
