// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/atomic_file.hpp"

#include "support/evidence.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {
namespace {

// CLAIM      A file is replaced as a whole or not touched; however writing fails, nothing half-written stays behind.
// ORACLE     exact: the folder's contents before and after.
// TOLERANCE  none.
TEST(AtomicFile, ReplacesAsAWholeOrNotAtAll) {
  proves({}, Oracle::exact, "the folder's contents");
  const TemporaryFolder folder;
  const auto path = folder.add("data.csv", "old");
  // The second file cannot be made, so the first must not change either.
  const auto failing = write_files({{path, "new"}, {folder.path() / "none" / "b.csv", "new"}});
  ASSERT_FALSE(failing.ok());
  EXPECT_EQ(failing.error().message, "cannot write '" + (folder.path() / "none" / "b.csv").string() +
                                         "': there is no folder '" + (folder.path() / "none").string() + "'");
  EXPECT_EQ(folder.contents(), "data.csv");
  EXPECT_EQ(read_text(path), "old");
  ASSERT_TRUE(check_writable({path, folder.path() / "c.csv"}).ok());
  EXPECT_FALSE(check_writable({path, folder.path() / "none" / "b.csv"}).ok());
  EXPECT_EQ(folder.contents(), "data.csv");
  EXPECT_EQ(read_text(path), "old");
  ASSERT_TRUE(write_files({{path, "new"}, {folder.path() / "c.csv", "also"}}).ok());
  EXPECT_EQ(folder.contents(), "c.csv data.csv");
  std::filesystem::remove(folder.path() / "c.csv");

  ASSERT_TRUE(write_file(path, std::string(100000, 'n')).ok());
  EXPECT_EQ(read_text(path), std::string(100000, 'n'));
  EXPECT_EQ(folder.contents(), "data.csv");
  EXPECT_TRUE(all_agree(::testing::Test::HasFailure() ? 1 : 0, 10));
}

// CLAIM      A link stays a link, and devices and folders are never replaced.
// ORACLE     exact: a link, a folder, /dev/full, a path below a file.
// TOLERANCE  none.
TEST(AtomicFile, KeepsLinksDevicesAndFolders) {
  proves({}, Oracle::exact, "a link, a folder, a device");
  const TemporaryFolder folder;
  folder.add("real/data.txt", "old");
  std::filesystem::create_symlink("real/data.txt", folder.path() / "link.txt");
  ASSERT_TRUE(write_file(folder.path() / "link.txt", "new").ok());
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link.txt"));
  EXPECT_EQ(read_text(folder.path() / "real/data.txt"), "new");

  const std::string dir = folder.path().string();
  EXPECT_EQ(write_file(folder.path(), "x").error().message, "cannot write '" + dir + "': is a directory");
  EXPECT_EQ(write_file("/dev/full", "x").error().message, "cannot write '/dev/full': not a regular file");
  EXPECT_EQ(write_file(folder.path() / "real/data.txt/x", "x").error().message,
            "cannot write '" + dir + "/real/data.txt/x': Not a directory");
  EXPECT_EQ(write_file(folder.path() / "none/x", "x").error().code, ErrorCode::input_output);
  EXPECT_EQ(write_file("", "x").error().message, "cannot write '': no file name");
  EXPECT_EQ(read_file(folder.path()).error().message, "cannot read '" + dir + "': is a directory");
  EXPECT_EQ(read_file("").error().code, ErrorCode::input_output);
  EXPECT_EQ(*read_file(folder.path() / "link.txt"), "new");
  EXPECT_TRUE(all_agree(::testing::Test::HasFailure() ? 1 : 0, 8));
}

}  // namespace
}  // namespace etendue::validation
