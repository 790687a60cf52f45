// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/scene_reader.hpp"

#include "etendue/io/scene_assembly.hpp"
#include "etendue/io/scene_files.hpp"

namespace etendue {

Result<SceneFile> read_scene(const std::filesystem::path& path) {
  SceneErrors errors;
  auto files = load_scene_files(path, errors);
  if (!files) return files.error();
  SceneFile result;
  for (const LoadedFile& file : files->files) result.files.emplace_back(file.name);
  Fingerprint fingerprint = files->fingerprint;
  TextureFiles textures(fingerprint);
  EnvironmentFiles environments(fingerprint);
  result.scene = assemble_scene(*files, textures, environments, errors);
  if (errors.count() > 0) return Error{errors.code(), errors.text()};
  for (const auto* images : {&textures.files(), &environments.files()})
    result.files.insert(result.files.end(), images->begin(), images->end());
  result.hash = fingerprint.hex();
  result.warnings = errors.warnings();
  return result;
}

}  // namespace etendue
