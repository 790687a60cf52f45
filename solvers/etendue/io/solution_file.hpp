// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "etendue/core/result.hpp"
#include "etendue/io/atomic_file.hpp"
#include "etendue/view/vertex_radiosity.hpp"

namespace etendue {

/// A solution as other programs want it. Whoever makes one keeps scene, mesh and vertices alive.
struct SolvedSurfaces {
  const Scene& scene;
  const ElementMesh& mesh;
  const VertexRadiosities& vertices;  ///< of this mesh
  std::vector<Rgb> radiosity;         ///< B of each element [W/m²]
  std::vector<Rgb> irradiance;        ///< H of each element [W/m²]: B = E + ρ H
  std::vector<Rgb> emission;          ///< E of each element [W/m²]
  double exposure = 1;                ///< display value of 1 W/m²
};

/// One line an element after a header: index, object (quoted, printable), centroid, normal, area, B and H per channel.
/// Lengths in scene units. Digits as many as read as the same double.
[[nodiscard]] std::string solution_csv(const SolvedSurfaces& solved);

/// NumPy: B as n × 3 doubles, row by row.
[[nodiscard]] std::string solution_npy(const SolvedSurfaces& solved);

/// ParaView: an unstructured grid of polygons, in scene units; each element has its own corners. Data of cells: radiosity,
/// irradiance, reflectance, emission (doubles), patch, object; of points: the vertex radiosities. All bits are kept:
/// arrays are base64, in line, uncompressed, after a 64-bit length.
[[nodiscard]] std::string solution_vtu(const SolvedSurfaces& solved);

/// Wavefront OBJ, in scene units, with the widespread extension "v x y z r g b": the colours of corners are
/// srgb_encode(min(1, exposure × B)), as programs that read them show them.
[[nodiscard]] std::string solution_obj(const SolvedSurfaces& solved);

/// glTF 2.0: one mesh an object, each element a fan of triangles around its centroid, as view_radiosities() draws it.
/// COLOR_0 is linear, min(1, exposure × B), for the format allows no more than 1; materials are KHR_materials_unlit, so
/// that nothing lights the solution a second time. The attribute _RADIOSITY has B itself [W/m²]. Positions in metres;
/// single precision throughout, as the format has it. The root node turns the axis nearest to the camera's "up" into y,
/// which the format calls up; a camera that looks as the scene's does is included.
[[nodiscard]] std::string solution_gltf(const SolvedSurfaces& solved);  ///< JSON with the numbers as base64 in it
[[nodiscard]] std::string solution_glb(const SolvedSurfaces& solved);   ///< one binary file

/// Can solutions be written to these files? Endings choose the form: .csv, .npy, .vtu, .obj, .gltf or .glb.
/// Errors    usage: another ending; a file that is named twice
[[nodiscard]] Result<Done> check_solution_paths(const std::vector<std::filesystem::path>& paths);

/// The file of this name, not written yet.
/// Contract  check_solution_paths() lets it pass; one radiosity, irradiance and emission an element
[[nodiscard]] NewFile solution_file(const std::filesystem::path& path, const SolvedSurfaces& solved);

}  // namespace etendue
