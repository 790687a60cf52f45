// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/solution_file.hpp"

#include <algorithm>

#include "etendue/core/contract.hpp"
#include "etendue/io/nearest.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

namespace fs = std::filesystem;

struct Form {
  const char* ending;
  std::string (*bytes)(const SolvedSurfaces&);
};

constexpr Form kForms[] = {{".csv", solution_csv}, {".npy", solution_npy},   {".vtu", solution_vtu},
                           {".obj", solution_obj}, {".gltf", solution_gltf}, {".glb", solution_glb}};

const Form* form_of(const fs::path& path) {
  const std::string ending = path.extension().string();
  const auto* found =
      std::find_if(std::begin(kForms), std::end(kForms), [&](const Form& f) { return ending == f.ending; });
  return found == std::end(kForms) ? nullptr : found;
}

}  // namespace

Result<Done> check_solution_paths(const std::vector<fs::path>& paths) {
  for (std::size_t k = 0; k < paths.size(); ++k) {
    const auto same = [&](const fs::path& other) { return other.lexically_normal() == paths[k].lexically_normal(); };
    if (std::any_of(paths.begin(), paths.begin() + static_cast<std::ptrdiff_t>(k), same)) {
      return Error{ErrorCode::usage, quoted_path(paths[k]) + " is named twice"};
    }
    if (form_of(paths[k])) continue;
    std::vector<std::string> known;
    for (const Form& form : kForms) known.emplace_back(form.ending);
    const std::string ending = paths[k].extension().string();
    return Error{ErrorCode::usage, quoted_path(paths[k]) + ": found ending '" + printable(ending) +
                                       "', expected .csv, .npy, .vtu, .obj, .gltf or .glb" +
                                       did_you_mean(ending, known)};
  }
  return Done{};
}

NewFile solution_file(const fs::path& path, const SolvedSurfaces& solved) {
  const std::size_t n = solved.mesh.elements.size();
  require(solved.radiosity.size() == n && solved.irradiance.size() == n && solved.emission.size() == n &&
              solved.vertices.corners.size() == n,
          "solution_file: values for each element");
  const Form* form = form_of(path);
  require(form != nullptr, "solution_file: a known ending");
  return {path, form->bytes(solved)};
}

}  // namespace etendue
