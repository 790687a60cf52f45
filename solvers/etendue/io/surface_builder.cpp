// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/surface_builder.hpp"

#include <algorithm>
#include <cstdio>

#include "etendue/io/atomic_file.hpp"
#include "etendue/text/fingerprint.hpp"
#include "etendue/text/number_text.hpp"

namespace etendue {

std::optional<Polygon> SurfaceBuilder::polygon(std::vector<Vec3> vertices, std::size_t line,
                                               const std::string& called) {
  auto flat = flattened(std::move(vertices));
  if (!flat) {
    errors_.add(line, called + ": " + flat.error().message);
    return std::nullopt;
  }
  if (flat->moved > 0) {
    ++flattened_;
    most_moved_ = std::max(most_moved_, flat->moved);
  }
  return flat->polygon;
}

std::size_t SurfaceBuilder::face(const Polygon& polygon, std::size_t line, const std::string& name) {
  model_.mesh.faces.push_back({polygon, model_.mesh.faces.size(), 0});
  model_.face_names.push_back(name);
  lines_.push_back(line);
  return model_.mesh.faces.size() - 1;
}

std::size_t SurfaceBuilder::element(const Polygon& polygon, std::size_t face) {
  model_.mesh.elements.push_back({polygon, face, model_.mesh.patches++});
  return model_.mesh.elements.size() - 1;
}

void SurfaceBuilder::finish() {
  if (!model_.mesh.faces.empty()) {
    std::vector<Polygon> polygons;
    for (const Face& face : model_.mesh.faces) polygons.push_back(face.polygon);
    for (const Overlapping& pair : overlapping(polygons, kTouching * diagonal(model_.mesh))) {
      const auto called = [&](std::size_t k) { return "'" + model_.face_names[k] + "'"; };
      errors_.add(lines_[pair.second], "surface " + called(pair.second) + " " + described(pair.how) + " surface " +
                                           called(pair.first) + " of line " + std::to_string(lines_[pair.first]));
    }
  }
  if (flattened_ == 0) return;
  model_.notes.push_back(std::to_string(flattened_) +
                         " surfaces were not flat to 12 digits: their vertices were moved onto "
                         "their planes, by at most " +
                         rounded(most_moved_, 2) + " (in the file's unit)");
}

Result<SurfaceModel> built_from(const std::filesystem::path& path,
                                const std::function<void(std::string_view, SurfaceModel&, ReadErrors&)>& build) {
  const auto bytes = read_file(path);
  if (!bytes) return bytes.error();
  ReadErrors errors(path.string());
  SurfaceModel model;
  model.name = path.stem().string();
  model.hash = Fingerprint().add(*bytes).hex();
  build(*bytes, model, errors);
  if (errors.count() > 0) return errors.error();
  return model;
}

}  // namespace etendue
