// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "etendue/assembly/surface_model.hpp"
#include "etendue/io/read_errors.hpp"
#include "etendue/meshing/surface_checks.hpp"

namespace etendue {

/// Builds a model from the polygons of a text file; keeps where each came from, for messages.
class SurfaceBuilder {
 public:
  SurfaceBuilder(SurfaceModel& model, ReadErrors& errors) : model_(model), errors_(errors) {}

  /// The polygon, flattened where its coordinates have few digits; reports what is wrong with it, and how far the
  /// vertices were moved in a note at the end.
  std::optional<Polygon> polygon(std::vector<Vec3> vertices, std::size_t line, const std::string& called);

  /// Adds a face that blocks, and returns its index.
  std::size_t face(const Polygon& polygon, std::size_t line, const std::string& name);
  /// Adds an element in a face, and returns its index.
  std::size_t element(const Polygon& polygon, std::size_t face);

  /// Reports faces that are there twice, overlap or lie inside one another; notes what was flattened.
  void finish();

 private:
  SurfaceModel& model_;
  ReadErrors& errors_;
  std::vector<std::size_t> lines_;  ///< of the faces
  std::size_t flattened_ = 0;
  double most_moved_ = 0;
};

/// Reads a file into a model named after it, with its fingerprint; `build` gets the file's bytes.
///
/// Errors    input_output where it cannot be read, else those that `build` reports
[[nodiscard]] Result<SurfaceModel> built_from(
    const std::filesystem::path& path, const std::function<void(std::string_view, SurfaceModel&, ReadErrors&)>& build);

}  // namespace etendue
