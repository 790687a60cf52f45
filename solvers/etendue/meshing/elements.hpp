// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "etendue/core/result.hpp"
#include "etendue/meshing/cut.hpp"
#include "etendue/scene/scene.hpp"

namespace etendue {

/// A planar convex side of an object, undivided. It radiates from the side that its normal points to and blocks light
/// from both.
struct Face {
  Polygon polygon;
  std::size_t object = 0;    ///< index into Scene::objects
  std::size_t material = 0;  ///< index into Scene::materials
};

/// Of an element that is no cell of a grid: a part of one, or of a face that is no quadrilateral.
inline constexpr std::size_t kNoCell = static_cast<std::size_t>(-1);

/// The smallest piece of a face, with one radiosity.                                               @eq IU.6.7.1
struct Element {
  Polygon polygon;
  std::size_t face = 0;        ///< index into ElementMesh::faces
  std::size_t patch = 0;       ///< running number over the whole scene; elements of a patch share it
  std::size_t cell = kNoCell;  ///< which cell of its face's grid it is, counted along the first edge fastest
};

/// A segment at which another face stands on a face, or pierces it.
struct Contact {
  std::size_t face = 0;  ///< index into ElementMesh::faces
  Segment segment;
};

/// A scene cut into elements. Elements of a face follow one another, along its first edge fastest.
struct ElementMesh {
  std::vector<Face> faces;
  std::vector<Element> elements;
  std::size_t patches = 0;
  std::vector<Contact> contacts = {};  ///< along which elements were cut; a display keeps their two sides apart

  const Face& face_of(const Element& element) const { return faces[element.face]; }
};

/// Surfaces nearer to each other than this share of the scene's diagonal count as touching: transforms and subdivision
/// round coordinates to 2^-53 of their size, and a wall must not cut a slice of 2^-53 from its own corner.
inline constexpr double kTouching = 0x1p-40;

/// Diagonal of the axis-parallel box around all faces [length].
[[nodiscard]] double diagonal(const ElementMesh& mesh);

/// Sine of the largest turn to the right that still counts as going straight on: corners that transforms have rounded.
inline constexpr double kStraightTurn = 0x1p-40;

[[nodiscard]] bool is_convex(const Polygon& polygon);

/// Whoever takes spheres, discs and cylinders whole asks for a mesh of the rest, which may be empty.
enum class CurvedObjects { refused, left_out };

/// Cuts the objects of a scene into elements and groups them into patches.
///
///     quadrilateral   p(s, t) = (1−s)(1−t) v_0 + s(1−t) v_1 + s t v_2 + (1−s) t v_3,  s = a/elements[0],  t = b/elements[1]
///     triangle        n² congruent ones; where there are more corners, n² in each triangle of two corners and the centroid
///
/// as division_of() counts them. With Scene::align_mesh they are then cut_at_contacts().
///
/// with s and t from division_line() where the object has a grading.
///
/// Domain    polygons, triangles, meshes (an element a triangle), boxes (six faces, seen from outside). Every object
///           takes part, whatever its reflectance: a black wall still closes the room
/// Returns   faces, elements and patches; a concave polygon is divided into convex faces. Neighbouring elements of a face share their corners to the last bit, but where
///           a cut of one ends at a side of another. What is not a quadrilateral is one patch
/// Errors    spheres, discs, cylinders (elements are flat; where `curved` says so they are left out instead), infinite
///           planes, counted elements or patches of what is no convex quadrilateral, patches that do not divide
///           elements, an element size that asks for too many; one line for each object that has one: its place in the
///           file, its name, and what to use instead; and their count
[[nodiscard]] Result<ElementMesh> mesh_elements(const Scene& scene, CurvedObjects curved = CurvedObjects::refused);

}  // namespace etendue
