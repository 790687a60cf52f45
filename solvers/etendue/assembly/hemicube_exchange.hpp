// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "etendue/assembly/exchange_method.hpp"
#include "etendue/assembly/pixel_projection.hpp"
#include "etendue/assembly/sight.hpp"

namespace etendue {

struct HemicubeSettings {
  PixelBody body = PixelBody::hemicube;
  int resolution = 200;    ///< pixels along an edge; even
  int points = 1;          ///< along each side of an element: points² bodies stand on it; 1: on its centroid
  bool rotate = false;     ///< turn each body about the normal by an angle of its own
  std::uint64_t seed = 1;  ///< of these angles
};

/// A point that stands for a part of an element.
struct StandPoint {
  Vec3 point;
  double share;  ///< of the element's area; the shares sum to one
};
/// Quadrilaterals: the centres of per_side² cells of (s, t); others: of per_side² triangles for each triangle of a fan.
[[nodiscard]] std::vector<StandPoint> stand_points(const Polygon& polygon, int per_side);

/// The angle by which the body on a point of an element is turned: in [0, 2π), a function of its arguments alone.
[[nodiscard]] double turn_of(std::uint64_t seed, std::size_t element, std::size_t point);

/// What a body of pixels sees of an element.
struct SeenShare {
  std::size_t element = 0;
  double factor = 0;  ///< F_iq summed over the pixels that show it
};

/// What looking from points needs of memory, to be used again and again by one thread at a time.
class LookingDesk {
 public:
  LookingDesk() = default;

 private:
  friend class ItemScene;
  std::vector<ItemBuffer> buffers_;  ///< one a view
  std::vector<std::size_t> above_;   ///< the items that reach over the horizon
  std::vector<char> fronts_;         ///< does an element show its front?
  std::vector<double> factors_;      ///< of each element
};

/// The elements of a scene, to be looked at from points. Faces hide from both sides, elements are seen from the front.
class ItemScene {
 public:
  /// `mesh` must outlive it.
  explicit ItemScene(const ElementMesh& mesh);
  /// What is seen from a point of the front of face `own_face`; by number of element.             @eq IU.6.4
  [[nodiscard]] std::vector<SeenShare> seen_from(const Vec3& point, std::size_t own_face,
                                                 const PixelProjection& projection, double turn) const;
  /// The same bits, in memory of `desk`, each view drawn on one of so many threads (0: all cores).
  [[nodiscard]] std::vector<SeenShare> seen_from(const Vec3& point, std::size_t own_face,
                                                 const PixelProjection& projection, double turn, LookingDesk& desk,
                                                 int threads) const;

 private:
  struct Item {
    const Polygon* polygon;
    std::size_t face;
  };
  const ElementMesh& mesh_;
  std::vector<Item> items_;                         ///< elements, then faces
  std::vector<std::vector<std::size_t>> overlaid_;  ///< of faces on which elements overlap, or that have none: theirs
  std::vector<std::size_t> drawn_;                  ///< items that go into the buffer
};

/// What is seen from the front of an element: the mean over the points on which bodies stand, by number of element.
/// @param number of the element, by which its bodies are turned
[[nodiscard]] std::vector<SeenShare> mean_seen(const ItemScene& scene, const Element& from, std::size_t number,
                                               const HemicubeSettings& settings, const PixelProjection& projection,
                                               LookingDesk& desk, int threads);

/// Form factors by the hemicube, or by the cubic tetrahedron: an item buffer on each element tells what its pixels see.
///
///     F_ij ≈ Σ_k a_k Σ_q ΔF_q [q sees j from p_k],   A_i F_ij = (A_j (A_i F_ij) + A_i (A_j F_ji))/(A_i + A_j)
///                                                                                  @eq IU.6-10, IU.6.4, E21
/// Symbols   p_k points of element i, a_k their shares of its area; ΔF_q exact delta form factors. Of the two sides the
///           smaller element counts more: its inner integral varies less
/// Accuracy  the method has no bound of its own, so its factors are judged by others: of a clear pair the bound is the
///           distance to form_factor() and that one's bound; of a partly obstructed one only that F lies between zero and
///           the unobstructed factor. Both hold; neither changes a value. How large errors are: docs/hemicube.md
/// Order     the same bits with any number of threads
/// Source    Cohen and Greenberg 1985; Beran-Koehn and Pavicic 1991; Nishita and Nakamae 1985 for the buffer
class HemicubeExchange : public ExchangeMethod {
 public:
  /// Looks from all elements. `mesh` must outlive it. When stopped it holds nothing: see complete().
  HemicubeExchange(const ElementMesh& mesh, const HemicubeSettings& settings, const Execution& execution);
  void find(std::span<const SurfacePair> pairs, std::span<Bounded> exchanges, TileReport& report) const override;
  std::vector<std::size_t> blockers(const SurfacePair& pair) const override;

  bool complete() const { return complete_; }
  /// What element i saw; by number of element.
  const std::vector<SeenShare>& seen_by(std::size_t element) const { return seen_[element]; }

 private:
  double seen_exchange(std::size_t from, std::size_t to) const;

  const ElementMesh& mesh_;
  HemicubeSettings settings_;
  std::vector<double> areas_;
  std::vector<std::vector<SeenShare>> seen_;
  SightMap sight_;
  bool complete_ = false;
};

}  // namespace etendue
