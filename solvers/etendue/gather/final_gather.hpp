// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "etendue/assembly/sight.hpp"
#include "etendue/core/bounded.hpp"
#include "etendue/gather/radiosity_field.hpp"
#include "etendue/meshing/elements.hpp"

namespace etendue {

/// The factor from a point to an element: the fraction of what a differential element there would send out.
struct ElementFactor {
  std::size_t element = 0;
  Bounded factor;
};

/// What arrives at a point.
struct Gathered {
  Rgb irradiance = Rgb::Zero();  ///< H [W/m²]
  Rgb bound = Rgb::Zero();       ///< on |H − what exact solution of the discrete equation sends there| [W/m²]
};

/// Parts of an element larger than this share of their distance, by their radius, are quartered, at most so often: in what is
/// left a linear radiosity counts with its value at one point, chosen to second order.
inline constexpr double kNearShare = 0.125;
inline constexpr int kMostNearQuarterings = 6;

/// How near the irradiance from an element in full view then comes, as a share of its factor times what the radiosity changes
/// by over it: measured, from distances of a tenth of its side to twice its side (final_gather_test).
inline constexpr double kLinearShare = 0x1p-16;

/// Looks from points at the elements of a mesh, past everything that stands in the way.
///
///     H(x, n) = Σ_j F_xj B_j,   F_xj = ∫_j V cos a_x cos a_j / (π r²) dA_j                      @eq IU.6-2, IU.6-4
///
/// Symbols   x a point, n the unit normal of a surface there; V one where x sees the point of element j, else zero; r
///           distance; a_x, a_j angles to n and to the element's normal [rad]
/// Accuracy  each factor as visible_point_to_polygon(): rounding alone, counted. Nothing is sampled
class FinalGather {
 public:
  /// `mesh` must outlive it.
  explicit FinalGather(const ElementMesh& mesh);

  /// Why nothing can be measured there.
  struct Obstacle {
    enum class Kind {
      inside,    ///< of a solid
      oblique,   ///< on a surface, within slack(), but facing neither along its normal nor against it: a hair's breadth
                 ///< decides what it sees
      facing_in  ///< on a solid's face, looking into it
    } kind;
    std::size_t object;  ///< index into Scene::objects
  };
  [[nodiscard]] std::optional<Obstacle> obstacle(const Vec3& point, const Vec3& normal) const;

  /// Elements with a factor, or the bound of one, above zero, in their order.
  ///
  /// Domain    normal of length one within 16 u; any finite point with no obstacle(). A point on a surface sees nothing
  ///           of it
  [[nodiscard]] std::vector<ElementFactor> factors(const Vec3& point, const Vec3& normal) const;

  /// The irradiance of a field over these elements: Σ F B over the elements, and where the field is linear over parts of
  /// them, so small as kNearShare says, each with the value at its centre as the point weighs it: to kLinearShare where nothing
  /// hides part of it.
  ///
  /// Domain    as factors()
  /// Returns   H and a bound: on what the field's own errors (RadiosityField::bound_at) and rounding can do. What the
  ///           elements are too coarse for is not in it: extrapolated() estimates that
  [[nodiscard]] Gathered irradiance(const Vec3& point, const Vec3& normal, const RadiosityField& field) const;

  /// Distance [length] below which a point counts as on a surface.
  double slack() const { return sights_.slack(); }

 private:
  struct Ball {
    Vec3 centre;
    double radius;
  };
  /// A plate or a solid.
  struct Body {
    const Blocker* blocker;
    std::vector<std::size_t> faces;
    Ball ball;
  };
  /// On which sides of a plane something lies, beyond slack().
  struct Sides {
    bool over = false, under = false;
  };

  /// One point, and what may hide something from it.
  struct Look;
  /// One element as seen from there.
  struct Target {
    std::size_t element;
    std::vector<std::size_t> hiding;       ///< numbers of Look's bodies
    std::vector<const Blocker*> blockers;  ///< the same, where one of them crosses the element's plane
  };

  void add_body(const Blocker* blocker, std::vector<std::size_t> faces);
  std::vector<const Body*> in_the_way(const Vec3& point) const;
  bool may_hide(const Body& body, const Vec3& point, std::size_t element) const;
  bool crosses_plane(const Body& body, std::size_t element) const;
  bool aim(const Look& look, std::size_t element, Target& target) const;
  std::optional<Bounded> seen(Look& look, const Target& target, std::span<const Vec3> corners) const;
  void add(Look& look, const Target& target, const RadiosityField& field, std::span<const Vec3> corners,
           int quarterings, Gathered& sum) const;
  bool is_on(std::size_t face, const Vec3& point) const;
  double height(std::size_t face, const Vec3& point) const;

  const ElementMesh& mesh_;
  SightMap sights_;
  std::vector<Blocker> plates_;
  std::vector<Body> bodies_;
  std::vector<Ball> balls_;       ///< around the elements
  std::vector<Sides> sides_;      ///< of each face, of each face's plane: [plane · faces + face]
  std::vector<Sides> all_sides_;  ///< of all faces, of each face's plane
};

}  // namespace etendue
