// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "etendue/form_factor/blocker.hpp"
#include "etendue/meshing/elements.hpp"

namespace etendue {

/// What may come between two elements.
enum class PairSight {
  averted,    ///< no point of one lies before the other's plane: the form factor is zero
  clear,      ///< no face reaches into the space between them
  blocked,    ///< one face or solid hides all of one from all of the other: the form factor is zero
  undecided,  ///< some faces may reach into it: they are listed
};

struct SightLine {
  PairSight sight = PairSight::averted;
  std::vector<std::size_t> blockers;  ///< indices into ElementMesh::faces; empty unless undecided
  std::vector<const Blocker*>
      bodies;  ///< the same as solids, where an object or several close one, else as plates; they
               ///< live in the SightMap
};

/// Remembers what may stand between an element and any part of a face: pairs of the one with the elements of the other that
/// follow one another look no farther. To be used with one SightMap.
class Approach {
  friend class SightMap;
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::size_t first_ = kNone, face_ = kNone;
  std::vector<std::size_t> bodies_;
};

/// Which faces of a scene can stand between which elements.
///
/// `averted`, `clear` and `blocked` are decided conservatively: NOTES.md §1 proves that they are true up to slack(), the
/// rounding of coordinates. `undecided` claims nothing. Memory: of the order of faces and elements, not of their product.
class SightMap {
 public:
  explicit SightMap(const ElementMesh& mesh);
  [[nodiscard]] SightLine between(std::size_t first, std::size_t second) const;
  /// The same, sooner where `approach` was last asked for the same element and face.
  [[nodiscard]] SightLine between(std::size_t first, std::size_t second, Approach& approach) const;

  /// Distance [length] below which surfaces count as touching: kHeightRoundings times the rounding of the largest
  /// coordinate.
  double slack() const { return slack_; }

  /// A solid that stands in the way of some elements, and the faces that bound it.
  struct Solid {
    const Blocker* blocker;          ///< lives in the SightMap
    std::vector<std::size_t> faces;  ///< indices into ElementMesh::faces
  };
  [[nodiscard]] std::vector<Solid> solids() const {
    std::vector<Solid> result;
    for (const Body& body : bodies_) {
      if (blockers_[body.blocker].is_solid()) result.push_back({&blockers_[body.blocker], body.planes});
    }
    return result;
  }

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
  /// What goes around a polygon.
  struct Hull {
    Ball ball;
    Bounds bounds;
  };

  static Hull hull_of(const Polygon& polygon);
  SightLine look(std::size_t first, std::size_t second, std::span<const std::size_t> bodies) const;
  void gather_bodies();
  bool add_solid(std::span<const std::size_t> faces, const std::vector<Polygon>& welded_faces);
  void add_body(std::span<const std::size_t> faces, Blocker blocker);
  bool reached_into(const Body& body) const;
  bool stands_between(const Body& body, const Pair& pair) const;
  bool set_aside(const Body& body, const Pair& pair) const;
  bool beyond_face(const Body& body, const Pair& pair) const;
  bool reflected_apart(const Body& body, const Pair& pair) const;
  bool separated(const Body& body, const Pair& pair) const;
  bool splits(std::size_t face, const Pair& pair) const;
  bool pierces(const Body& body, const Pair& pair) const;
  bool hides_all(std::size_t face, const Pair& pair) const;
  bool hides_all(const Body& body, const Pair& pair) const;

  const ElementMesh& mesh_;
  double slack_ = 0;
  std::vector<Blocker> blockers_;
  std::vector<Body> bodies_;               ///< solids, then single faces; those that can never block are left out
  std::vector<std::vector<Vec3>> inward_;  ///< of each face's edges, across them, of length one
  std::vector<Hull> elements_, faces_;
  std::vector<std::size_t> counts_;      ///< elements of each face
  std::vector<std::size_t> all_bodies_;  ///< 0, 1, 2, …
};

}  // namespace etendue
