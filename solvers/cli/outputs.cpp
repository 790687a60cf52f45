// SPDX-License-Identifier: Apache-2.0
#include "outputs.hpp"

#include <ostream>

#include "etendue/io/atomic_file.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue::cli {

namespace fs = std::filesystem;

fs::path output_stem(const fs::path& output, const fs::path& scene) {
  if (!output.empty()) return fs::path(output).replace_extension();
  const fs::path name = scene.stem();
  if (name != "scene") return name;
  std::error_code error;
  const fs::path folder =
      fs::weakly_canonical(scene.parent_path().empty() ? "." : scene.parent_path(), error).filename();
  return error || folder.empty() ? name : folder;
}

Result<Done> check_outputs(const std::vector<fs::path>& outputs, const std::vector<fs::path>& inputs) {
  for (const fs::path& output : outputs) {
    for (const fs::path& input : inputs) {
      std::error_code absent;  // what does not exist is no input
      if (!fs::equivalent(output, input, absent)) continue;
      return Error{ErrorCode::usage,
                   quoted_path(output) + " is a file of the scene and would be replaced; name another"};
    }
  }
  return check_writable(outputs);
}

std::string scene_line(const SceneFile& file) {
  const std::string name = file.scene.name.empty() ? "(no name)" : printable(file.scene.name);
  return name + ", " + counted(file.scene.objects.size(), "object") + ", hash " + file.hash;
}

int fail(std::ostream& err, const std::string& command, const Error& error) {
  err << "etendue " << command << ": " << printable_lines(error.message) << '\n';
  return static_cast<int>(error.code);
}

void warn(std::ostream& err, const std::string& command, const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) err << "etendue " << command << ": warning: " << warning << '\n';
}

}  // namespace etendue::cli
