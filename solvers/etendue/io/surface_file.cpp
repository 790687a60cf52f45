// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/surface_file.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include "etendue/io/nearest.hpp"
#include "etendue/io/obj_reader.hpp"
#include "etendue/io/scene_reader.hpp"
#include "etendue/io/stl_reader.hpp"
#include "etendue/io/vs3_reader.hpp"
#include "etendue/meshing/surface_checks.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

Result<SurfaceModel> read_scene_surfaces(const std::filesystem::path& path) {
  const auto file = read_scene(path);
  if (!file) return file.error();
  auto model = surface_model(file->scene);
  if (!model) return model.error();
  SurfaceModel result = std::move(model).value();
  result.hash = file->hash;
  if (const auto apart = check_overlaps(file->scene, result.mesh); !apart) return apart.error();
  return result;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

Result<SurfaceModel> read_surfaces(const std::filesystem::path& path) {
  const std::string ending = lower(path.extension().string());
  if (ending == ".json") return read_scene_surfaces(path);
  if (ending == ".vs3") return read_vs3(path);
  if (ending == ".obj") return read_obj(path);
  if (ending == ".stl") return read_stl(path);
  return Error{ErrorCode::usage, quoted_path(path) + ": found ending '" + printable(ending) +
                                     "', expected .json, .vs3, .obj or .stl" +
                                     did_you_mean(ending, {".json", ".vs3", ".obj", ".stl"})};
}

}  // namespace etendue
