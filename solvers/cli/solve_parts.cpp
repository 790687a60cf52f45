// SPDX-License-Identifier: Apache-2.0
#include "solve_parts.hpp"

#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"
#include "outputs.hpp"

namespace etendue::cli {

namespace fs = std::filesystem;

fs::path solution_path(const fs::path& output, const fs::path& scene, const char* ending) {
  std::string stem = output_stem(output, scene).string();
  std::error_code absent;  // what does not exist is not the scene
  if (output.empty() && fs::equivalent(stem + ".json", scene, absent)) stem += "-radiosity";
  return stem + ending;
}

void add_write(Options& options, std::vector<fs::path>& files) {
  options.paths("--write", "FILE",
                "also: .csv, .npy (numbers), .vtu (ParaView), .obj, .gltf, .glb (coloured surfaces); repeatable",
                files);
}

Result<Done> write_solutions(const std::vector<fs::path>& files, const SolvedSurfaces& solved) {
  std::vector<NewFile> all;
  for (const fs::path& path : files) all.push_back(solution_file(path, solved));
  return write_files(all);
}

std::vector<std::string> left_out(const Scene& scene) {
  std::vector<std::string> lines;
  if (!scene.lights.empty()) {
    lines.push_back(counted(scene.lights.size(), "point or directional light") + ": only surfaces emit here");
  }
  for (const Material& material : scene.materials) {
    if (material.k_s > 0 || material.k_r > 0 || material.k_t > 0) {
      lines.push_back("k_s, k_r and k_t of material '" + printable(material.name) +
                      "': every surface is ideally diffuse here");
    }
  }
  return lines;
}

}  // namespace etendue::cli
