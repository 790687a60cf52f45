// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "etendue/image/image.hpp"
#include "etendue/io/image_file.hpp"
#include "etendue/io/scene_reader.hpp"
#include "etendue/io/solution_file.hpp"
#include "memory.hpp"
#include "options.hpp"
#include "tone_options.hpp"

// What all methods of `etendue solve` share.
namespace etendue::cli {

/// What every method is told: the scene, what to write, how to show it.
struct SolutionRequest {
  CommonOptions common;
  std::filesystem::path scene;
  std::vector<std::filesystem::path> written;  ///< --write
  ToneOptions tone;
  int samples = 3;
  double element_size = 0;  ///< 0, which --element-size does not take: as the scene says
  bool align_mesh = false;  ///< or as the scene says
};

/// Declares --element-size and --align-mesh.
void add_meshing(Options& options, SolutionRequest& request);

/// Declares --exposure and the like, --samples, --write and what every command understands.
void add_results(Options& options, SolutionRequest& request);

/// What a run has written; empty paths for what it has not.
struct SolutionFiles {
  std::filesystem::path exr, png, json;
  std::vector<std::filesystem::path> written;  ///< by --write
};

/// The output's name with another ending; never that of the scene itself, where no name is asked for.
[[nodiscard]] std::filesystem::path solution_path(const SolutionRequest& request, const std::string& ending);

/// Reads the scene, with the meshing that is asked for, and asks of all files that the run may write whether they can be.
/// @param suffix to their names
[[nodiscard]] Result<SceneFile> opened(const SolutionRequest& request, const std::string& suffix = "");

/// check_memory(), whose refusal names the scene.
[[nodiscard]] Result<Done> check_memory(const std::filesystem::path& scene, const MemoryNeed& need);

/// Says what radiosity leaves out of this scene, a line each, and that nothing emits where nothing does.
void tell_left_out(std::ostream& err, const SolutionRequest& request, const Scene& scene);

/// What the scene's camera sees of the radiosities; ErrorCode::stopped when the user asked for it meanwhile.
[[nodiscard]] Result<Image> drawn(const Scene& scene, const ElementMesh& mesh, const VertexRadiosities& vertices,
                                  const SolutionRequest& request, std::ostream& err);

/// What linear values are multiplied by, in the PNG, where it is linear, and in files for other programs: so that white
/// is the brightest surface that does not emit, unless --exposure says otherwise.
[[nodiscard]] double linear_exposure(const ToneOptions& tone, double white_level);

/// A picture before it is written.
struct Shown {
  Image radiosities;     ///< [W/m²]
  ToneMapped displayed;  ///< of them
};

/// Both pictures as files: radiosities as EXR, what is displayed of them as PNG, with `facts` inside.
[[nodiscard]] Result<std::vector<NewFile>> encode_pictures(const SolutionFiles& files, const Shown& shown,
                                                           const ToneMapping& mapping, ImageMetadata facts);
/// Writes both.
[[nodiscard]] Result<Done> write_pictures(const SolutionFiles& files, const Shown& shown, const ToneMapping& mapping,
                                          const ImageMetadata& facts);

/// Writes the solution to these files, all or none.
[[nodiscard]] Result<Done> write_solutions(const std::vector<std::filesystem::path>& files,
                                           const SolvedSurfaces& solved);

/// Their names, a line each.
void print_files(std::ostream& out, const SolutionFiles& files);

}  // namespace etendue::cli
