// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "etendue/meshing/elements.hpp"

namespace etendue {

/// Radiosity over the elements of a mesh: constant, or linear within each.
///
///     B(p) = max(0, B_k + g_k · (p − c_k))   per channel, p in element k, c_k its centroid: its mean stays B_k but for the cut at 0
struct RadiosityField {
  std::vector<Rgb> value;  ///< B_k [W/m²]
  std::vector<std::array<Vec3, 3>>
      slope;  ///< g_k of each channel [W/m² / length], in the element's plane; zero where constant
  std::vector<double>
      spread;  ///< by how much an error of 1 in all B may change B(p) more, for a |p − c_k| of 1 [1/length]
  Rgb largest = Rgb::Zero();  ///< B_k of all
  Rgb bound = Rgb::Zero();    ///< on |B_k − exact B_k| of all elements [W/m²]

  [[nodiscard]] Rgb at(std::size_t element, const Vec3& from_centroid) const;
  /// On the error of at(): the cut at 0 only makes it smaller. Rounding included.
  [[nodiscard]] Rgb bound_at(std::size_t element, const Vec3& from_centroid) const;
};

/// The elements' radiosities as they are.
[[nodiscard]] RadiosityField constant_field(std::span<const Rgb> radiosity, const Rgb& bound);

/// The same with the slope, in each element, of the quadratic that fits its neighbours and theirs best: in least squares,
/// weighted by 1/distance⁴, through its own value. Where there are not enough of them, of the linear function; else none.
///
/// Domain    neighbours are elements of one face that share a corner to the last bit; `left_out` (elements inside or under
///           other surfaces) are nobody's, and a contact (ElementMesh::contacts) keeps its two sides apart
/// Accuracy  exact for radiosities that are the means of one linear function over a face; for smooth ones B(p) is of second
///           order in the element size, inside a face of third: measured
/// Order     the same bits from every compiler
[[nodiscard]] RadiosityField linear_field(const ElementMesh& mesh, std::span<const Rgb> radiosity,
                                          std::span<const std::size_t> left_out, const Rgb& bound);

}  // namespace etendue
