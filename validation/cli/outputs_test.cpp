// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>
#include <vector>

#include "etendue/io/image_file.hpp"
#include "support/evidence.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {
namespace {

std::string scene_of(const std::string& name) {
  return (source_root() / "scenes" / name / "scene.json").string();
}

std::string head(const std::string& command) {
  return "etendue " + command + ": ";
}

// CLAIM      Each file that a command may write, also one that only an interrupted run would, is tried before anything
//            is computed: exit code 5, one line that names this file as the user does, and nothing is left.
// ORACLE     exact: folders put in the way of each file; the rendering of 8·10⁸ rays would outlast the test's patience, and
//            solve would first say what it left out.
// TOLERANCE  none.
TEST(Program, TriesAllItsOutputsFirst) {
  proves({}, Oracle::exact, "folders in the way of each file");
  std::string large = read_text(scene_of("minimal"));
  large.replace(large.find("[64, 64]"), 8, "[900, 900]");
  struct Command {
    std::string name, scene;
    std::vector<std::string> files;
  };
  const TemporaryFolder scenes;
  // solve says what it leaves out once it has computed: here a light, and so a line too many where it tried too late.
  std::string lit = read_text(scene_of("furnace"));
  lit.replace(lit.find('{'), 1, R"({"lights": [{"type": "point", "position": [0, 0, 0], "intensity": 1}],)");
  const auto with_light = scenes.add("lit.json", lit);
  const std::vector<Command> all{
      {"render", scenes.add("large.json", large).string(), {"a.exr", "a.png", "a.incomplete.exr", "a.incomplete.png"}},
      {"solve", with_light.string(), {"a.exr", "a.png", "a.json", "a.incomplete.json", "a.factors.resume"}},
  };
  std::uint64_t wrong = 0, decided = 0;
  for (const Command& command : all) {
    for (const std::string& file : command.files) {
      const TemporaryFolder folder;
      std::filesystem::create_directory(folder.path() / file);
      const std::string picture = (folder.path() / "a.png").string();
      const Ended ended = run_etendue({command.name, command.scene,
                                       command.name == "render" ? "--samples=16" : "--threads=1", "--output", picture});
      const std::string expected =
          head(command.name) + "cannot write '" + (folder.path() / file).string() + "': is a directory\n";
      ++decided;
      if (ended.code == 5 && ended.err == expected && ended.out.empty() && folder.contents() == file) continue;
      ++wrong;
      ADD_FAILURE() << "ended with " << ended.code << ", holds " << folder.contents() << "\n"
                    << ended.err << "expected\n"
                    << expected;
    }
  }
  EXPECT_TRUE(all_agree(wrong, decided));
}

// CLAIM      The reason why a file cannot be made is said of the user's path, never of an internal name: a missing
//            folder, a file in a folder's place, a file system that takes no files, a name that is too long.
// ORACLE     exact: the messages, to the letter.
// TOLERANCE  none.
TEST(Program, SaysWhyAnOutputCannotBeMade) {
  proves({}, Oracle::exact, "the messages, to the letter");
  const TemporaryFolder folder;
  const std::string dir = folder.path().string(), stem(260, 'a');
  folder.add("file", "x");
  struct Case {
    std::string output, message;
  };
  const std::vector<Case> all{
      {dir + "/none/a.png", "cannot write '" + dir + "/none/a.exr': there is no folder '" + dir + "/none'\n"},
      {dir + "/file/a.exr", "cannot write '" + dir + "/file/a.exr': Not a directory\n"},
      {"/proc/a.png", "cannot write '/proc/a.exr': No such file or directory\n"},
      {dir + "/" + stem + ".png", "cannot write '" + dir + "/" + stem + ".exr': File name too long\n"},
  };
  std::uint64_t wrong = 0, decided = 0;
  for (const Case& c : all) {
    for (const std::string command : {"render", "solve"}) {
      const Ended ended = run_etendue({command, scene_of("minimal"), "--output", c.output});
      ++decided;
      if (ended.code == 5 && ended.err == head(command) + c.message && folder.contents() == "file") continue;
      ++wrong;
      ADD_FAILURE() << "ended with " << ended.code << "\n" << ended.err << "expected\n" << c.message;
    }
  }
  EXPECT_TRUE(all_agree(wrong, decided));
}

/// The program under a limit on the size of the files that it writes, in blocks of 512 bytes.
Ended run_limited(const std::string& blocks, std::vector<std::string> arguments) {
  std::vector<std::string> words{"-c", "ulimit -f " + blocks + " && exec \"$@\"", "sh", etendue_program().string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run_process("/bin/sh", words);
}

// CLAIM      When the room for a file runs out while it is written, none of the run's files appears or changes, the
//            exit code is 5, and the one line names the user's path: also when only the last file is too large.
// ORACLE     exact: a limit on the size of files (RLIMIT_FSIZE); the folder's contents.
// TOLERANCE  none.
TEST(Program, LeavesNothingHalfWritten) {
  proves({}, Oracle::exact, "a limit on the size of files");
  const TemporaryFolder folder;
  const std::string dir = folder.path().string(), picture = dir + "/a.png";
  folder.add("a.exr", "old");
  const Ended first = run_limited("8", {"render", scene_of("minimal"), "--output", picture});
  EXPECT_EQ(first.code, 5) << first.signal;
  EXPECT_EQ(first.err, "etendue render: cannot write '" + dir + "/a.exr': File too large\n");
  EXPECT_EQ(folder.contents(), "a.exr");
  EXPECT_EQ(read_text(folder.path() / "a.exr"), "old");

  // How large each file is tells which limit only the last exceeds.
  const TemporaryFolder whole;
  ASSERT_EQ(run_etendue({"solve", scene_of("furnace"), "--output", (whole.path() / "a.png").string()}).code, 0);
  const auto size = [&](const char* name) { return std::filesystem::file_size(whole.path() / name); };
  const std::uintmax_t pictures = std::max(size("a.exr"), size("a.png"));
  ASSERT_GT(size("a.json"), pictures + 1024) << "the last file must be the largest, or this proves nothing";
  const Ended last =
      run_limited(std::to_string(pictures / 512 + 1), {"solve", scene_of("furnace"), "--output", picture});
  EXPECT_EQ(last.code, 5) << last.signal;
  EXPECT_EQ(last.err, "etendue solve: cannot write '" + dir + "/a.json': File too large\n");
  EXPECT_EQ(folder.contents(), "a.exr");
  EXPECT_EQ(read_text(folder.path() / "a.exr"), "old");
  EXPECT_TRUE(all_agree(::testing::Test::HasFailure() ? 1 : 0, 8));
}

// CLAIM      No file that a scene was read from, an included one neither, is replaced by what is made from it; without
//            --output the files are named after the scene, or the folder of a scene.json, also a folder called "..".
// ORACLE     exact: exit code, bytes and names.
// TOLERANCE  none.
TEST(Program, NamesItsOutputsAfterTheSceneAndSparesIt) {
  proves({}, Oracle::exact, "exit code, bytes and names");
  const TemporaryFolder folder;
  const std::string text = read_text(scene_of("minimal"));
  const std::string part = "{\"format\": \"etendue-scene\", \"version\": 1, \"unit\": \"m\"}";
  folder.add("parts.json", part);
  const auto main = folder.add("main.json", "{\"include\": [\"parts.json\"]," + text.substr(text.find('{') + 1));
  const std::string output = (folder.path() / "parts.png").string();
  const Ended refused = run_etendue({"solve", main.string(), "--output", output});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("'" + (folder.path() / "parts.json").string() + "' is a file of the scene"),
            std::string::npos)
      << refused.err;
  EXPECT_EQ(read_text(folder.path() / "parts.json"), part);

  const TemporaryFolder named;
  named.add("lamp/scene.json", text);
  std::filesystem::create_directory(named.path() / "lamp" / "below");
  ProcessOptions below;
  below.folder = named.path() / "lamp" / "below";
  EXPECT_EQ(run_etendue({"render", "../scene.json", "--quiet"}, below).code, 0);
  EXPECT_TRUE(std::filesystem::exists(below.folder / "lamp.exr"));
  EXPECT_TRUE(std::filesystem::exists(below.folder / "lamp.png"));
  EXPECT_TRUE(all_agree(::testing::Test::HasFailure() ? 1 : 0, 6));
}

}  // namespace
}  // namespace etendue::validation
