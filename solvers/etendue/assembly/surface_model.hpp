// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "etendue/assembly/exchange_matrix.hpp"
#include "etendue/core/result.hpp"
#include "etendue/form_factor/view_body.hpp"
#include "etendue/meshing/elements.hpp"

namespace etendue {

/// A row of the matrix that is handed out, made of elements: those of the surface itself and of what is combined with
/// it, less those of its subsurfaces.
struct ComposedRow {
  struct Term {
    std::size_t element;  ///< index into ElementMesh::elements
    double sign;          ///< 1 or −1
  };
  std::string name;
  std::vector<Term> terms;
  double area = 0;       ///< [length²]
  double emittance = 1;  ///< handed through to the output; factors do not depend on it
};

/// A surface that covers part of another and faces it: sees nothing else.
struct Mask {
  std::size_t row, base;  ///< indices of rows
};

/// A sphere, a disc or the wall of a cylinder, undivided. Its elements are numbered after those of the mesh.
struct RoundSurface {
  CurvedPatch shape;
  std::string name;
  std::size_t object = 0;  ///< index into Scene::objects
};

/// The surfaces between which form factors are asked for, whatever file they come from.
struct SurfaceModel {
  std::string name;
  ElementMesh mesh;  ///< faces block; elements exchange. A face without elements only blocks
  std::vector<std::string> face_names;
  std::vector<RoundSurface> rounds;  ///< block and exchange
  std::vector<ComposedRow> rows;
  std::vector<Mask> masks;
  std::optional<double> metres_per_unit;  ///< nothing where the file does not say: factors have no unit
  std::string hash;                       ///< of the file's bytes
  std::vector<std::string> notes;         ///< what the reader left out, one line each

  /// Of a face, or, numbered after them, of a round surface.
  const std::string& blocker_name(std::size_t blocker) const {
    return blocker < face_names.size() ? face_names[blocker] : rounds[blocker - face_names.size()].name;
  }

  std::size_t elements() const { return mesh.elements.size() + rounds.size(); }
  double element_area(std::size_t element) const;  ///< [length²]

  /// Is each row just the element of the same number?
  bool plain() const;
};

/// The model of a scene: a row an element, "name" or "name[3]" where the object has several. Spheres, discs and walls of
/// cylinders are one row each.
///
/// Errors    what mesh_elements() refuses of flat objects; infinite planes; round objects that pierce another
[[nodiscard]] Result<SurfaceModel> surface_model(const Scene& scene);

/// Areas of the elements, in their order.
[[nodiscard]] std::vector<double> areas_of(const SurfaceModel& model);

/// What share of a row's tolerance its parts may use up. Errors of all terms add, in both rows of a pair, while values may
/// cancel: (area of a row / sum of its terms' areas)², the least of all rows, but at least a hundredth. 1 for a plain model.
[[nodiscard]] double share_of_parts(const SurfaceModel& model);

/// The exchange area of two rows from those of their elements; `between(a, b)` is asked for a ≠ b.
[[nodiscard]] Bounded row_exchange(const SurfaceModel& model, std::size_t r, std::size_t s,
                                   const std::function<Bounded(std::size_t a, std::size_t b)>& between);

/// The matrix of the model's rows from that of its elements:
///
///     G'_rs = Σ_a Σ_b sign_a sign_b G_ab   over the terms a of r and b of s                       @eq IU.6-5
///
/// Contract  a complete matrix of the model's elements
/// Accuracy  bounds add up, those of what is subtracted too; a value below 0 is held at 0, which its bound allows
[[nodiscard]] ExchangeMatrix composed(const SurfaceModel& model, const ExchangeMatrix& elements);

}  // namespace etendue
