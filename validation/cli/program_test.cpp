// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <sstream>
#include <string>
#include <vector>

#include "etendue/core/version.hpp"
#include "etendue/io/image_file.hpp"
#include "io/example_scene.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

std::string minimal_scene() {
  return (source_root() / "scenes" / "minimal" / "scene.json").string();
}

/// The minimal scene, seen in another resolution.
std::string minimal_scene_of(const std::string& resolution) {
  std::string text = read_text(minimal_scene());
  const std::string own = "[64, 64]";
  return text.replace(text.find(own), own.size(), resolution);
}

// CLAIM      `etendue --version` opens no OpenImageIO, which is what lets it answer in milliseconds (ci/measure).
// ORACLE     exact: the dynamic linker's own account.
// TOLERANCE  none.
TEST(Program, AnswersVersionAtOnce) {
  proves({}, Oracle::exact, "the dynamic linker's account");
  const Ended ended = run_etendue({"--version"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.out, std::string("etendue ") + version() + "\n");
  EXPECT_EQ(ended.err, "");
  ProcessOptions traced;
  traced.environment = {{"LD_DEBUG", "libs"}};
  const Ended linking = run_etendue({"--version"}, traced);
  EXPECT_NE(linking.err.find("libstdc++"), std::string::npos) << "the account must be there to prove anything";
  EXPECT_EQ(linking.err.find("OpenImageIO"), std::string::npos);
  EXPECT_EQ(linking.err.find("etendue_io"), std::string::npos);
  EXPECT_TRUE(all_agree(::testing::Test::HasFailure() ? 1 : 0, 6));
}

// CLAIM      Wrong use of the program itself is refused with exit code 2, on standard error, with the nearest word.
// ORACLE     exact: the messages.
// TOLERANCE  none.
TEST(Program, RefusesWrongUse) {
  proves({}, Oracle::exact, "the messages, to the letter");
  const Ended command = run_etendue({"rendr"}), option = run_etendue({"--vresion"}), nothing = run_etendue({});
  EXPECT_EQ(command.code, 2);
  EXPECT_EQ(command.out, "");
  EXPECT_EQ(command.err, "etendue: unknown command 'rendr'; did you mean 'render'?\nTry 'etendue --help'.\n");
  EXPECT_EQ(option.code, 2);
  EXPECT_EQ(option.err, "etendue: unknown option '--vresion'; did you mean '--version'?\nTry 'etendue --help'.\n");
  EXPECT_EQ(nothing.code, 2);
  EXPECT_EQ(nothing.out, "");
  for (const std::string about : {"--version", "--help", "-h"}) {
    const Ended more = run_etendue({about, "foo"});
    EXPECT_EQ(more.code, 2);
    EXPECT_EQ(more.out, "");
    EXPECT_EQ(more.err, "etendue: unexpected argument 'foo' after " + about + "\nTry 'etendue --help'.\n");
  }
  EXPECT_EQ(run_etendue({"render"}).code, 2);
  const Ended threads = run_etendue({"render", minimal_scene(), "--threads", "0"});
  EXPECT_EQ(threads.code, 2);
  EXPECT_NE(threads.err.find("'--threads': found '0', expected an integer in [1, 1024]"), std::string::npos);
  EXPECT_NE(run_etendue({"solve", "--thread", "1"}).err.find("did you mean '--threads'?"), std::string::npos);
  EXPECT_TRUE(all_agree(::testing::Test::HasFailure() ? 1 : 0, 9));
}

// CLAIM      Data that do not get through to standard output make exit code 5: a full device, a reader that has gone.
// ORACLE     exact: /dev/full and a pipe without a reader.
// TOLERANCE  none.
TEST(Program, NoticesLostOutput) {
  proves({}, Oracle::exact, "/dev/full and a pipe without a reader");
  ProcessOptions full, closed;
  full.out = "/dev/full";
  closed.closed_pipe = true;
  for (const auto& options : {full, closed}) {
    for (const auto& arguments : std::vector<std::vector<std::string>>{
             {"--version"}, {"--help"}, {"render", "--help"}, {"render", minimal_scene(), "--ray-tree", "0,0"}}) {
      const Ended ended = run_etendue(arguments, options);
      EXPECT_EQ(ended.code, 5);
      EXPECT_EQ(ended.signal, 0);
      EXPECT_EQ(ended.err, "etendue: cannot write to standard output: not all data got through\n");
    }
  }
  EXPECT_TRUE(all_agree(::testing::Test::HasFailure() ? 1 : 0, 8));
}

/// A scene file that is wrong in one way, and what the program must say of it.
struct WrongScene {
  std::string text, place_and_pointer, words;
};

std::string with(const std::string& original, const std::string& instead) {
  std::string text = example_scene();
  return text.replace(text.find(original), original.size(), instead);
}

// CLAIM      The program ends with 3 and the located message for each kind of wrong scene, and makes no picture.
// ORACLE     exact: lines and columns counted by hand in the documented example.
// TOLERANCE  none.
TEST(Program, RefusesWrongScenesWithTheirPlace) {
  proves({}, Oracle::exact, "places counted by hand");
  const std::vector<WrongScene> all{
      {with("\"ambient\"", "\"ambeint\""), "15:3: /ambeint: ", "did you mean 'ambient'?"},
      {with("\"radius\": 30", "\"radius\": -30"),
       "30:77: /objects/1/radius: ", "found -30, expected a number in (0, 1e+50]"},
      {with("\"glass\", \"centre\"", "\"glas\", \"centre\""), "30:36: /objects/1/material: ", "did you mean 'glass'?"},
      {with("\"rho\": 0.5", "\"rho\": 1"), "18:45: /materials/wall/rho: ", "expected a number in [0, 1)"},
      {with("  \"unit\": \"cm\",\n", ""), "1:1: ", "no key \"unit\""},
      {with("\"ambient\": 0.3", "\"ambient\": 1e999"), "15:14: /ambient: ", "that a double can hold"},
      {with("100, 0], [100, 100, 0]", "100, 0], [100, 101, 0]"),
       "32:19: /objects/2/vertices: ", "found a polygon that is none: vertex"},
      {std::string(1000, '['), "1:66: ", "nesting deeper than 64"},
      {"", "1:1: ", "found the end of the file, expected a value"},
      {std::string("\x7f"
                   "ELF\x02\x01\x00\xff\xfe",
                   9),
       "1:8: ", "not UTF-8"},
      {with("{\n  \"$schema\"", "{\"include\": [\"scene.json\"],\n  \"$schema\""),
       "1:14: /include/0: ", "without a cycle"},
      {with("{\n  \"$schema\"", "{\"include\": [\"none.json\"],\n  \"$schema\""), "1:14: /include/0: ", "No such file"},
  };
  std::uint64_t wrong = 0;
  for (const WrongScene& scene : all) {
    const TemporaryFolder folder;
    const std::string path = folder.add("scene.json", scene.text).string();
    for (const std::string command : {"render", "solve"}) {
      const Ended ended = run_etendue({command, path, "--output", (folder.path() / "out.png").string()});
      const std::string expected = path + ":" + scene.place_and_pointer;
      const bool right = ended.code == 3 && ended.out.empty() && ended.err.find(expected) != std::string::npos &&
                         ended.err.find(scene.words) != std::string::npos &&
                         ended.err.find("1 error\n") != std::string::npos && folder.contents() == "scene.json";
      if (right) continue;
      ++wrong;
      ADD_FAILURE() << command << " ended with " << ended.code << ", holds " << folder.contents() << "\nfound\n"
                    << ended.err << "expected\n"
                    << expected << " … " << scene.words;
    }
  }
  EXPECT_TRUE(all_agree(wrong, 2 * all.size()));
}

// CLAIM      Scenes that cannot be read and pictures that cannot be written make exit code 5 (a wrong kind of picture:
//            2), and leave nothing half-written.
// ORACLE     exact: the folder's contents.
// TOLERANCE  none.
TEST(Program, RefusesFilesItCannotReadOrWrite) {
  proves({}, Oracle::exact, "the folder's contents");
  const TemporaryFolder folder;
  const std::string dir = folder.path().string();
  folder.add("file", "x");
  std::filesystem::create_directory(folder.path() / "folder.png");
  struct Case {
    std::string scene, output;
    int code;
    std::string words;
  };
  const std::vector<Case> all{
      {dir + "/none.json", dir + "/a.png", 5, "cannot read '" + dir + "/none.json': No such file or directory"},
      {dir, dir + "/a.png", 5, "cannot read '" + dir + "': is a directory"},
      {dir + "/file/scene.json", dir + "/a.png", 5, "Not a directory"},
      {minimal_scene(), dir + "/none/a.png", 5, "cannot write '" + dir + "/none/a.exr'"},
      {minimal_scene(), dir + "/file/a.exr", 5, "cannot write '" + dir + "/file/a.exr'"},
      {minimal_scene(), dir + "/folder.png", 5, "is a directory"},
      {minimal_scene(), dir + "/a.jpg", 2, "expected .exr or .png"},
  };
  std::uint64_t wrong = 0;
  for (const Case& c : all) {
    const Ended ended = run_etendue({"render", c.scene, "--output", c.output});
    const bool right = ended.code == c.code && ended.err.find(c.words) != std::string::npos &&
                       folder.contents() == "file folder.png" &&
                       std::filesystem::is_empty(folder.path() / "folder.png");
    if (right) continue;
    ++wrong;
    ADD_FAILURE() << "ended with " << ended.code << ", expected " << c.code << "; holds " << folder.contents() << "\n"
                  << ended.err;
  }
  ProcessOptions elsewhere;
  elsewhere.environment = {{"ETENDUE_IO", dir + "/none.so"}};
  const Ended moduleless = run_etendue({"render", minimal_scene(), "--output", dir + "/a.png"}, elsewhere);
  EXPECT_EQ(moduleless.code, 5);
  EXPECT_NE(moduleless.err.find("the module libetendue_io.so is not at '" + dir + "/none.so'"), std::string::npos);
  EXPECT_TRUE(all_agree(wrong, all.size()));
}

// CLAIM      A picture carries version and scene hash; --quiet says nothing; no carriage return reaches a pipe or a
//            file.
// ORACLE     exact: the streams and the picture's attributes.
// TOLERANCE  none.
TEST(Program, KeepsItsStreamsClean) {
  proves({}, Oracle::exact, "the streams and the picture's attributes");
  const TemporaryFolder folder;
  const std::string picture = (folder.path() / "a.exr").string();
  const Ended loud = run_etendue({"render", minimal_scene(), "--output", picture});
  EXPECT_EQ(loud.code, 0) << loud.err;
  EXPECT_EQ((loud.out + loud.err).find('\r'), std::string::npos);
  EXPECT_EQ((loud.out + loud.err).find('\033'), std::string::npos);
  const auto metadata = read_image_metadata(picture);
  ASSERT_TRUE(metadata.ok());
  const auto has = [&](const std::string& value) {
    return std::any_of(metadata->begin(), metadata->end(), [&](const auto& pair) { return pair.second == value; });
  };
  EXPECT_TRUE(has(version()));
  EXPECT_TRUE(has("etendue:scene_hash") || std::any_of(metadata->begin(), metadata->end(), [](const auto& pair) {
                return pair.first == "etendue:scene_hash";
              }));
  const Ended quiet = run_etendue({"render", minimal_scene(), "--quiet", "--output", picture});
  EXPECT_EQ(quiet.code, 0);
  EXPECT_EQ(quiet.out + quiet.err, "");
  EXPECT_TRUE(all_agree(::testing::Test::HasFailure() ? 1 : 0, 6));
}

// CLAIM      The pictures that solve makes carry how they were made; --samples and --exposure are in them.
// ORACLE     exact: the attributes of both files.
// TOLERANCE  none.
TEST(Program, SignsThePicturesOfSolve) {
  proves({}, Oracle::exact, "the attributes of both pictures");
  const TemporaryFolder folder;
  const std::string scene = (source_root() / "scenes" / "furnace" / "scene.json").string();
  const Ended ended = run_etendue({"solve", scene, "--quiet", "--samples", "2", "--exposure", "0.25", "--tolerance",
                                   "1e-5", "--output", (folder.path() / "out.png").string()});
  EXPECT_EQ(ended.out + ended.err, "");
  const std::string report = read_text(folder.path() / "out.json");
  const auto attribute = [&](const char* file, const char* name) {
    const auto metadata = read_image_metadata(folder.path() / file);
    if (!metadata) return metadata.error().message;
    for (const auto& [key, value] : *metadata) {
      if (key == name) return value;
    }
    return std::string("none");
  };
  for (const char* file : {"out.exr", "out.png"}) {
    EXPECT_TRUE(holds(attribute(file, "etendue:version") == version())) << file;
    EXPECT_TRUE(holds(attribute(file, "etendue:method") == "radiosity, full matrix, Gouraud")) << file;
    EXPECT_TRUE(holds(attribute(file, "etendue:scene") == "furnace")) << file;
    EXPECT_TRUE(holds(report.find("\"hash\": \"" + attribute(file, "etendue:scene_hash") + "\"") != std::string::npos))
        << file;
    EXPECT_TRUE(holds(attribute(file, "etendue:solver") == "gauss")) << file;
    EXPECT_TRUE(holds(attribute(file, "etendue:tolerance") == "1e-05")) << file;
    EXPECT_TRUE(holds(attribute(file, "etendue:samples_per_side") == "2")) << file;
  }
  EXPECT_TRUE(holds(attribute("out.exr", "etendue:values") == "radiosity [W/m2]"));
  EXPECT_TRUE(holds(attribute("out.exr", "etendue:exposure") == "none"));
  EXPECT_TRUE(holds(attribute("out.png", "etendue:values") == "radiosity times exposure"));
  EXPECT_TRUE(holds(attribute("out.png", "etendue:exposure") == "0.25"));
}

// CLAIM      An interrupted rendering ends with 6, having saved what was done; the interruption is no crash. Two signals
//            of one moment, as timeout sends to its command and to the command's group, are one request.
// ORACLE     exact: exit code and the folder's contents.
// TOLERANCE  none; the rendering of 8·10⁸ rays would last minutes, the program is there after milliseconds.
TEST(Program, SavesWhatIsDoneWhenInterrupted) {
  proves({}, Oracle::exact, "exit code and the folder's contents");
  const TemporaryFolder folder;
  const auto scene = folder.add("large.json", minimal_scene_of("[900, 900]")).string();
  ProcessOptions options;
  options.interrupt_after = 1.5;
  options.interrupt_again = 0.02;
  const auto saves = [&](const Ended& ended, const std::string& name) {
    EXPECT_EQ(ended.signal, 0);
    EXPECT_TRUE(holds(ended.code == 6)) << ended.code << ended.err;
    EXPECT_TRUE(
        holds(folder.contents() == name + ".incomplete.exr " + name + ".incomplete.png " + name + ".resume large.json"))
        << folder.contents();
    std::filesystem::remove(folder.path() / (name + ".incomplete.exr"));
    std::filesystem::remove(folder.path() / (name + ".incomplete.png"));
    std::filesystem::remove(folder.path() / (name + ".resume"));
  };
  saves(run_etendue({"render", scene, "--samples", "32", "--output", (folder.path() / "a.exr").string()}, options),
        "a");
  const std::string program = etendue_program().string(), picture = (folder.path() / "b.exr").string();
  saves(run_process("/usr/bin/timeout", {"--signal=INT", "--preserve-status", "1.5", program, "render", scene,
                                         "--samples=32", "--output", picture}),
        "b");
}

// CLAIM      A signal that comes more than a second after the first ends the program at once, as if nobody had watched.
// ORACLE     exact: the signal that ended it, and the folder's contents.
// TOLERANCE  none; a row of 9,000 pixels of 4,096 rays lasts longer than the two seconds and a half.
TEST(Program, IsEndedByASignalThatComesLater) {
  proves({}, Oracle::exact, "the signal that ended it");
  const TemporaryFolder folder;
  const auto scene = folder.add("wide.json", minimal_scene_of("[9000, 9]")).string();
  ProcessOptions options;
  options.interrupt_after = 1;
  options.interrupt_again = 1.5;
  const Ended ended = run_etendue(
      {"render", scene, "--samples", "64", "--threads", "1", "--output", (folder.path() / "a.exr").string()}, options);
  EXPECT_TRUE(holds(ended.signal == SIGINT)) << ended.signal << " " << ended.code << ended.err;
  EXPECT_TRUE(holds(folder.contents() == "wide.json")) << folder.contents();
}

// CLAIM      One signal ends a program that waits for its scene, with 6: nobody has opened the pipe, or nobody writes to it.
// ORACLE     exact: exit code and message; the folder stays as it was.
// TOLERANCE  none; the program waits for ever, the signal comes when it has waited for about a second.
TEST(Program, IsStoppedWhileItWaitsForItsScene) {
  proves({}, Oracle::exact, "exit code, message and the folder's contents");
  const TemporaryFolder folder;
  const std::string pipe = (folder.path() / "scene.json").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  ProcessOptions options;
  options.folder = folder.path();
  options.interrupt_after = 1;
  const auto stops = [&](const std::string& command, const std::string& scene) {
    const Ended ended = run_etendue({command, scene}, options);
    const bool right = ended.code == 6 && ended.err == "etendue: stopped before anything was done\n" &&
                       folder.contents().find(' ') == std::string::npos;
    EXPECT_TRUE(holds(right)) << command << " ended with " << ended.code << ", signal " << ended.signal << ", holds "
                              << folder.contents() << "\n"
                              << ended.err;
  };
  stops("solve", pipe);
  const int writer = ::open(pipe.c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_GE(writer, 0);
  stops("render", pipe);
  ::close(writer);
  std::filesystem::rename(pipe, folder.path() / "scene.vs3");
  stops("form-factors", (folder.path() / "scene.vs3").string());
}

// CLAIM      No output of a command replaces the scene it was made from: refused with 2, the scene as it was.
// ORACLE     exact: exit code and the file's bytes.
// TOLERANCE  none.
TEST(Program, NeverReplacesItsScene) {
  proves({}, Oracle::exact, "exit code and the scene's bytes");
  const TemporaryFolder folder;
  const std::string text = read_text(minimal_scene());
  const auto scene = folder.add("room.json", text);
  const std::string picture = (folder.path() / "room.png").string();
  EXPECT_EQ(run_etendue({"solve", scene.string(), "--output", picture}).code, 2);
  EXPECT_EQ(read_text(scene), text);
  EXPECT_EQ(run_etendue({"render", scene.string(), "--ray-tree", "1,1", "--output", scene.string()}).code, 2);
  EXPECT_EQ(read_text(scene), text);
  EXPECT_TRUE(all_agree(::testing::Test::HasFailure() ? 1 : 0, 4));
}

/// The sample runs at the end of a help text.
std::vector<std::string> sample_runs(const std::string& help) {
  std::vector<std::string> runs;
  std::istringstream lines(help);
  bool begun = false;
  for (std::string line; std::getline(lines, line);) {
    if (line == "Examples:" || line == "Sample runs") begun = true;
    if (begun && line.rfind("  etendue", 0) == 0) runs.push_back(line.substr(2));
  }
  return runs;
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// CLAIM      Every sample run that a --help shows works as it stands, from a folder that holds scenes/.
// ORACLE     exact: exit code 0.
// TOLERANCE  none.
TEST(Program, SampleRunsWork) {
  proves({}, Oracle::exact, "exit code of each line");
  const TemporaryFolder folder;
  std::filesystem::create_symlink(source_root() / "scenes", folder.path() / "scenes");
  ProcessOptions options;
  options.folder = folder.path();
  std::uint64_t wrong = 0, decided = 0;
  for (const auto& command : std::vector<std::vector<std::string>>{{"--help"},
                                                                   {"solve", "--help"},
                                                                   {"view", "--help"},
                                                                   {"form-factors", "--help"},
                                                                   {"render", "--help"},
                                                                   {"catalogue", "--help"}}) {
    const auto runs = sample_runs(run_etendue(command).out);
    EXPECT_FALSE(runs.empty()) << command.front();
    for (const std::string& run : runs) {
      std::vector<std::string> words = words_of(run);
      ASSERT_EQ(words.front(), "etendue");
      words.erase(words.begin());
      const Ended ended = run_etendue(words, options);
      ++decided;
      if (ended.code == 0) continue;
      ++wrong;
      ADD_FAILURE() << run << "\nended with " << ended.code << "\n" << ended.err;
    }
  }
  EXPECT_TRUE(all_agree(wrong, decided));
}

}  // namespace
}  // namespace etendue::validation
