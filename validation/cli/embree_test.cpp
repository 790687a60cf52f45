// SPDX-License-Identifier: Apache-2.0
#include "etendue/acceleration/embree.hpp"

#include "etendue/io/image_file.hpp"
#include "support/evidence.hpp"
#include "support/image_compare.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {
namespace {

// CLAIM      `--accelerator embree` makes the picture of `bvh` where Embree is there, built in and installed; where it is not, or its
//            library cannot be opened, nothing is written, the message names it, and the exit code is that of usage (not built in) or
//            of input and output.
// ORACLE     metamorphic: the picture of the default accelerator, on all shapes, triangles and a mesh among them.
// TOLERANCE  none: all bits.
TEST(RenderCommand, TakesEmbreeOrSaysWhyNot) {
  proves({"IU.5.7"}, Oracle::metamorphic, "the picture by bounding volumes");
  const TemporaryFolder folder;
  const auto run = [&](const std::string& accelerator, const ProcessOptions& process) {
    return run_etendue(
        {"render", (source_root() / "scenes" / "shapes" / "scene.json").string(), "--columns", "64", "--samples", "1",
         "--quiet", "--accelerator", accelerator, "--output", (folder.path() / (accelerator + ".exr")).string()},
        process);
  };
  ProcessOptions without;
  without.environment.emplace_back("LD_LIBRARY_PATH",
                                   folder.add("libembree3.so.3", "no library").parent_path().string());
  const auto missing = embree_missing();
  const bool built_in = !missing || missing->code != ErrorCode::usage;
  const int code = built_in ? 5 : 2;
  const std::string why = built_in ? "embree: it cannot be opened" : "embree: this program was built without it";
  const Ended refused = run("embree", without);
  EXPECT_TRUE(holds(refused.code == code && refused.err.find(why) != std::string::npos)) << refused.err;
  EXPECT_TRUE(holds(folder.contents() == "libembree3.so.3")) << folder.contents();

  const Ended taken = run("embree", {});
  if (missing) {
    EXPECT_TRUE(holds(taken.code == code && taken.err.find(missing->message) != std::string::npos)) << taken.err;
    return;
  }
  ASSERT_EQ(taken.code, 0) << taken.err;
  ASSERT_EQ(run("bvh", {}).code, 0);
  const auto found = read_image(folder.path() / "embree.exr"), expected = read_image(folder.path() / "bvh.exr");
  ASSERT_TRUE(found.ok() && expected.ok());
  const ImageDifference difference = compare(*found, *expected, 0, 0);
  EXPECT_TRUE(difference.comparable) << difference.message;
  EXPECT_TRUE(all_agree(difference.pixels_above, expected->pixels.size()));
}

}  // namespace
}  // namespace etendue::validation
