// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/evidence.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {
namespace {

/// Floor and ceiling of a cube, of cells × cells squares each.
std::string two_grids(int cells) {
  std::string text = R"({"format": "etendue-scene", "version": 1, "unit": "m",
 "camera": {"eye": [0, 0, 0], "gaze": [0, 1, 0], "up": [0, 0, 1], "horizontal_fov_deg": 60, "resolution": [8, 8]},
 "materials": {"m": {"k_d": 0.5}},
 "objects": [)";
  const char* walls[] = {"[[0,0,0],[1,0,0],[1,1,0],[0,1,0]]", "[[0,0,1],[0,1,1],[1,1,1],[1,0,1]]"};  // the rest is open
  const std::string side = std::to_string(cells), elements = "[" + side + ", " + side + "]";
  for (const char* wall : walls) {
    text += std::string(wall == walls[0] ? "" : ",") + R"({"type": "polygon", "material": "m", "vertices": )" + wall +
            ", \"elements\": " + elements + "}";
  }
  return text + "]}";
}

// CLAIM      Beside the matrix, 12 bytes a pair in tiles, a run of form-factors takes no more than 5 % of it, with
//            and without a file, and dropping takes nothing: what grows with n is the matrix.
// ORACLE     exact: the peak as the kernel counts it, of 4,050 squares less that of 968.
// TOLERANCE  5 % of what the matrix grows by.
TEST(Memory, TakesNoMoreMemoryThanTheMatrix) {
  proves({}, Oracle::exact, "VmHWM of two sizes");
  const TemporaryFolder folder;
  const std::string output = (folder.path() / "m.npy").string();
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, {"--drop", "1e-5"}, {"--drop", "1e-5", "--output", output}}) {
    std::array<nlohmann::json, 2> runs;
    for (std::size_t k = 0; k < runs.size(); ++k) {
      std::vector<std::string> all{"form-factors", folder.add("a.json", two_grids(k == 0 ? 22 : 45)).string(), "--json",
                                   "--quiet"};
      all.insert(all.end(), more.begin(), more.end());
      const Ended ended = run_etendue(all);
      ASSERT_EQ(ended.code, 0) << ended.err;
      runs[k] = nlohmann::json::parse(ended.out);
      std::filesystem::remove(output);
    }
    const auto grown = [&](const char* key) { return runs[1].at(key).get<double>() - runs[0].at(key).get<double>(); };
    EXPECT_TRUE(within(grown("peak_memory_bytes"), 1.05 * grown("matrix_bytes")));
  }
}

}  // namespace
}  // namespace etendue::validation
