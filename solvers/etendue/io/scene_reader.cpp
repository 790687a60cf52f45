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
  EnvironmentFiles environments(fingerprint);
  result.scene = assemble_scene(*files, environments, errors);
  if (errors.count() > 0) return Error{ErrorCode::invalid_input, errors.text()};
  result.files.insert(result.files.end(), environments.files().begin(), environments.files().end());
  result.hash = fingerprint.hex();
  result.warnings = errors.warnings();
  return result;
}

}  // namespace etendue
