// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/solve_runs.hpp"
#include "support/evidence.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {
namespace {

using Json = nlohmann::json;

// CLAIM      Interrupted in the form factors, solve ends with 6 and saves the factors and bounds of the rows that are
//            done.
// ORACLE     identity: closure of the rows of a box, F_ij = A_j F_ji / A_i from the rows above.
// TOLERANCE  the bounds saved with them, and 400 roundings of sums of 311 terms.
TEST(SolveResume, SavesTheRowsThatAreDoneWhenInterrupted) {
  proves({}, Oracle::identity, "closure of the saved rows");
  const TemporaryFolder folder;
  // Twelve times the elements of floor and ceiling last long enough to be interrupted.
  std::string text = replaced(furnace_text(), "[4, 3]", "[12, 12]");
  const auto scene = folder.add("fine.json", replaced(text, "[3, 4]", "[12, 12]"));
  ProcessOptions options;
  options.interrupt_at = "form factors [";
  const Ended ended = solve(scene, {"--threads", "1"}, options);
  EXPECT_EQ(ended.signal, 0);
  EXPECT_TRUE(holds(ended.code == 6)) << ended.code << ended.err;
  EXPECT_TRUE(holds(says(ended, "stopped; what was done is in"))) << ended.err;
  EXPECT_EQ(folder.contents(), "fine.json out.factors.resume out.incomplete.json");
  const Json report = Json::parse(read_text(folder.path() / "out.incomplete.json"));
  EXPECT_EQ(report["status"], "stopped");
  const Json& elements = report["elements"];
  const Json& rows = report["rows"];
  EXPECT_TRUE(holds(rows.size() > 0 && rows.size() == report["rows_done"])) << rows.size();
  std::size_t next = 0;
  for (const Json& row : rows) {
    const auto i = row["row"].get<std::size_t>();
    EXPECT_EQ(i, next++) << "one thread: in order";
    EXPECT_EQ(elements[i]["row_done"], true);
    EXPECT_EQ(row["factors"].size(), elements.size() - i - 1);
    EXPECT_EQ(row["bounds"].size(), elements.size() - i - 1);
    double sum = 0, bound = 400 * 0x1p-53;
    for (std::size_t j = i + 1; j < elements.size(); ++j) {
      sum += row["factors"][j - i - 1].get<double>();
      bound += row["bounds"][j - i - 1].get<double>();
    }
    for (std::size_t j = 0; j < i; ++j) {
      const double ratio = elements[j]["area"].get<double>() / elements[i]["area"].get<double>();
      sum += rows[j]["factors"][i - j - 1].get<double>() * ratio;
      bound += rows[j]["bounds"][i - j - 1].get<double>() * ratio;
    }
    EXPECT_TRUE(near(sum, 1, bound));
  }
}

// CLAIM      solve --resume goes on with the rows that an interrupted run has saved, to the same bytes as a run without a pause,
//            and clears up; interrupted in the picture, it goes on as well. Rows of another scene, of another tolerance or mesh,
//            and damaged ones are refused with 3 and what differs; where there are none it begins anew and says so.
// ORACLE     identity: equal files.
// TOLERANCE  none.
TEST(SolveResume, ResumesToTheSameBytes) {
  proves({}, Oracle::identity, "equal files");
  const TemporaryFolder folder;
  std::string text = replaced(furnace_with(kScreen), "[4, 3]", "[10, 10]");
  text = replaced(text, "[3, 4]", "[10, 10]");
  const auto scene = folder.add("fine.json", text);
  const auto with = [](std::vector<std::string> more) {
    more.insert(more.end(), {"--tolerance", "1e-4", "--samples", "1"});
    return more;
  };
  const Ended whole = solve(scene, with({"--resume"}));
  EXPECT_EQ(whole.code, 0) << whole.err;
  EXPECT_TRUE(holds(says(whole, "nothing to resume, beginning anew: there is no"))) << whole.err;
  const auto result = folder.path() / "out.json", saved = folder.path() / "out.factors.resume";
  const std::string bytes = read_text(result), picture = read_text(folder.path() / "out.png");
  ASSERT_TRUE(std::filesystem::remove(result) && std::filesystem::remove(folder.path() / "out.exr"));
  ProcessOptions options;
  options.interrupt_at = "form factors [";
  const Ended stopped = solve(scene, with({"--threads", "1"}), options);
  EXPECT_TRUE(holds(stopped.code == 6)) << stopped.code << stopped.err;
  EXPECT_TRUE(holds(says(stopped, "and --resume goes on from '" + saved.string() + "'"))) << stopped.err;
  const std::size_t rows = Json::parse(read_text(folder.path() / "out.incomplete.json"))["rows_done"];
  EXPECT_TRUE(holds(rows > 0 && rows < Json::parse(bytes)["rows_done"])) << rows;

  const std::string kept = read_text(saved);
  const auto refused = [&](const std::vector<std::string>& more, const std::string& why) {
    const Ended ended = solve(scene, with(more));
    EXPECT_TRUE(holds(ended.code == 3 && says(ended, saved.string() + "': " + why))) << ended.code << ended.err;
    EXPECT_TRUE(holds(read_text(saved) == kept));
  };
  refused({"--resume", "--align-mesh"}, "its rows were computed with --align-mesh off, not with on");
  refused({"--resume", "--element-size", "0.5"}, "its rows were computed with --element-size as the scene says, not");
  folder.add("fine.json", text + "\n");
  refused({"--resume"}, "its rows were computed with scene hash ");
  folder.add("fine.json", text);
  const Ended finer = solve(scene, {"--resume", "--samples", "1", "--tolerance", "1e-5"});
  EXPECT_TRUE(holds(finer.code == 3 && says(finer, "with --tolerance 1e-04, not with 1e-05"))) << finer.err;
  std::string damaged = kept;
  damaged[damaged.size() - 100] = static_cast<char>(damaged[damaged.size() - 100] ^ 1);
  for (const std::string& other : {damaged, kept.substr(0, kept.size() - 16)}) {
    folder.add("out.factors.resume", other);
    EXPECT_TRUE(holds(solve(scene, with({"--resume"})).code == 3));
  }
  folder.add("out.factors.resume", kept);

  const Ended resumed = solve(scene, with({"--resume", "--threads", "2"}));
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_TRUE(holds(read_text(result) == bytes));
  EXPECT_TRUE(holds(read_text(folder.path() / "out.png") == picture));
  EXPECT_EQ(folder.contents(), "fine.json out.exr out.json out.png");
}

// CLAIM      Interrupted in an elimination, solve --factors ends with 6, writes nothing and says that there is nothing to save; an
//            iteration writes what it has reached.
// ORACLE     exact: exit code, files and words.
// TOLERANCE  none.
TEST(SolveResume, SaysThatAnEliminationHasNothingToSave) {
  proves({}, Oracle::exact, "exit code, files and words");
  const TemporaryFolder folder;
  const auto output = folder.path() / "B.csv";
  constexpr std::size_t kPatches = 1500;
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (1500, 1500), }";
  header += std::string(127 - 10 - header.size(), ' ') + "\n";
  std::string bytes = std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header;
  const auto word = std::bit_cast<std::array<char, 8>>(1.0 / kPatches);
  for (std::size_t k = 0; k < kPatches * kPatches; ++k) bytes.append(word.data(), word.size());
  const std::string factors = folder.add("large.npy", bytes).string();
  const auto stopped = [&](const std::string& solver, const std::string& reflectance) {
    ProcessOptions options;
    options.interrupt_at = solver + " [";
    return run_etendue({"solve", "--factors", factors, "--reflectance", reflectance, "--emission", "1", "--solver",
                        solver, "-o", output.string()},
                       options);
  };
  const Ended elimination = stopped("gauss", "0.5");
  EXPECT_TRUE(holds(elimination.code == 6 && says(elimination, "there is nothing to save"))) << elimination.err;
  EXPECT_TRUE(holds(!std::filesystem::exists(output)));
  const Ended iteration = stopped("jacobi", "0.9999");
  EXPECT_TRUE(holds(iteration.code == 6 && says(iteration, "the result is what was reached"))) << iteration.err;
  const std::string csv = read_text(output);
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), 1 + kPatches);
}

}  // namespace
}  // namespace etendue::validation
