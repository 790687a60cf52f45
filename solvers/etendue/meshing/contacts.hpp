// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "etendue/meshing/elements.hpp"

namespace etendue {

/// A corner that subdivision or a cut has made is off by some roundings of its coordinates: at most this share of the largest
/// coordinate, 32 units of roundoff. It matters where a scene is farther from the origin than 256 of its diagonals.
inline constexpr double kCornerRounding = 0x1p-48;

/// Corners nearer than this are one, and what is nearer to a plane lies in it: kTouching of the diagonal, or kCornerRounding
/// where that is more [length].
///
/// Contract  there is a face
[[nodiscard]] double touching_distance(const ElementMesh& mesh);

/// Where other faces touch or pierce the faces of a scene, in front of them: the lines at which light and shadow begin
/// abruptly.                                                                                       @eq IU.6.5.1
///
/// Symbols   touching: what is nearer than this to a face's plane lies in it [length]
/// Domain    convex faces
/// Returns   for each face in order the segments that the others have in common with it, longest first; also those along
///           its own border. Where only a point is common, where a face ends behind another, or lies in its plane, there
///           is none
[[nodiscard]] std::vector<Contact> contacts(std::span<const Face> faces, double touching);

/// Cuts the elements along the contacts of their faces, so that none lies on both sides of another face.
///
/// Returns   the mesh with its contacts; elements in their order, each replaced by its pieces. A patch of which an element
///           was cut falls into its elements, each a patch of its own: no patch lies on both sides either
[[nodiscard]] ElementMesh cut_at_contacts(const ElementMesh& mesh);

}  // namespace etendue
