// SPDX-License-Identifier: Apache-2.0
#include "runner/references.hpp"

#include <cstdlib>

#include "support/evidence.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {
namespace {

std::vector<ReferencePicture> references() {
  const auto all = read_references(source_root());
  EXPECT_TRUE(all.ok()) << all.error().message;
  return all.ok() ? all.value() : std::vector<ReferencePicture>{};
}

// CLAIM      Each picture that is kept beside a scene is what the program renders today; costly ones in the long run only
//            (ETENDUE_LONG_RUN).
// ORACLE     table: our own earlier output: a guard against changes that nobody meant, no proof.
// TOLERANCE  none: the same input gives the same bits, so there is no noise and no rounding to allow for.
TEST(References, AreWhatTheProgramRenders) {
  proves({}, Oracle::table, "scenes/references.json, our own earlier pictures: a guard, no proof");
  std::uint64_t other = 0, compared = 0;
  for (const ReferencePicture& reference : references()) {
    if (reference.costly && std::getenv("ETENDUE_LONG_RUN") == nullptr) continue;
    const TemporaryFolder folder;
    const auto rendered = render_reference(reference, source_root(), folder.path());
    ASSERT_TRUE(rendered.ok()) << reference.picture << ": " << rendered.error().message;
    const auto now = picture_fingerprint(*rendered);
    ASSERT_TRUE(now.ok()) << now.error().message;
    ++compared;
    if (now.value() == reference.pixels) continue;
    ++other;
    ADD_FAILURE() << reference.picture << ": shows something else than on " << reference.recorded
                  << "; if that is meant: etendue-validate --update-references " << reference.picture
                  << " --reason WHY";
  }
  EXPECT_TRUE(all_agree(other, compared));
  EXPECT_GE(compared, 10u);
}

// CLAIM      The pictures in the folders are those that were recorded, each with version, day and reason, and the scene's page says
//            how each is made.
// ORACLE     exact: fingerprints of the files; the page's text.
// TOLERANCE  none.
TEST(References, AreTheFilesThatWereRecorded) {
  proves({}, Oracle::exact, "fingerprints of the pictures; the commands on the pages of their scenes");
  std::uint64_t wrong = 0, decided = 0;
  for (const ReferencePicture& reference : references()) {
    const auto path = source_root() / reference.picture;
    const auto print = picture_fingerprint(path);
    ASSERT_TRUE(print.ok()) << print.error().message;
    ++decided;
    if (print.value() != reference.pixels || reference.reason.empty() || reference.recorded.size() != 10 ||
        reference.program.empty()) {
      ++wrong;
      ADD_FAILURE() << reference.picture << ": not the picture that was recorded, or without version, day and reason";
    }
    const std::string page = read_text(path.parent_path() / "README.md");
    if (page.find(path.filename().string()) != std::string::npos) continue;
    ++wrong;
    ADD_FAILURE() << reference.picture << ": its scene's README.md does not mention it";
  }
  EXPECT_TRUE(all_agree(wrong, decided));
}

}  // namespace
}  // namespace etendue::validation
