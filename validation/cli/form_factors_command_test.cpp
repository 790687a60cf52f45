// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "cli/form_factors_runs.hpp"
#include "io/surface_texts.hpp"
#include "support/evidence.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {
namespace {

/// An obstruction in the middle of the box of room_texts().
std::string floating_plate() {
  return "V 9 .5 .2 .5\nV 10 1.5 .2 .5\nV 11 1.5 .8 .6\nV 12 .5 .8 .6\nO 7 9 10 11 12\n";
}

/// A room with a screen and a great many pairs behind it: seconds of work.
std::string slow_scene(int cells) {
  std::string text = R"({"format": "etendue-scene", "version": 1, "unit": "m",
 "camera": {"eye": [0, 0, 0], "gaze": [0, 1, 0], "up": [0, 0, 1], "horizontal_fov_deg": 60, "resolution": [8, 8]},
 "materials": {"m": {"k_d": 0.5}},
 "objects": [
  {"type": "polygon", "name": "floor", "material": "m", "vertices": [[0,0,0],[4,0,0],[4,4,0],[0,4,0]], "elements": CELLS},
  {"type": "polygon", "name": "ceiling", "material": "m", "vertices": [[0,0,3],[0,4,3],[4,4,3],[4,0,3]], "elements": CELLS},
  {"type": "polygon", "name": "screen", "material": "m", "vertices": [[1,1,1],[3,1.2,1.1],[3,3,1.2],[1,2.8,1.1]]}]})";
  const std::string elements = "[" + std::to_string(cells) + ", " + std::to_string(cells) + "]";
  for (std::size_t at = text.find("CELLS"); at != std::string::npos; at = text.find("CELLS")) {
    text.replace(at, 5, elements);
  }
  return text;
}

// CLAIM      Without --output a summary says how many surfaces there are, whether they close, the worst row's defect, the
//            largest bound and the time; --json says the same for a machine.
// ORACLE     exact: the furnace is closed; its numbers are compared between the two forms.
// TOLERANCE  none: words, and equality of what both print.
TEST(FormFactorsCommand, SummarisesAScene) {
  proves({}, Oracle::exact, "the words, and a closed scene");
  const Ended text = form_factors({furnace()}), json = form_factors({furnace(), "--json"});
  EXPECT_EQ(text.code, 0) << text.err;
  for (const char* words : {"surfaces     48\n", "closed: every row sums to 1 within its bounds", "worst row    ",
                            "bound        ", "time         ", "219 averted, 909 clear\n"}) {
    EXPECT_TRUE(holds(has(text.out, words))) << words << "\n" << text.out;
  }
  const auto parsed = nlohmann::json::parse(json.out);
  EXPECT_TRUE(
      holds(parsed.at("n") == 48 && parsed.at("closed") == true && parsed.at("pairs").at("beyond_tolerance") == 0));
  EXPECT_TRUE(within(parsed.at("worst_row_defect").get<double>(), 48 * 1e-6));
  EXPECT_TRUE(holds(form_factors({furnace(), "--quiet"}).out.empty()));
}

// CLAIM      IU.6-3, IU.6-6: the matrix that the program writes has rows that sum to one, and holds the closed form's value
//            for two opposite walls of a cube, whatever the format of the room.
// ORACLE     closed form: Howell C-11 for parallel squares of a cube, 0.19982489569838747.
// TOLERANCE  the bound that the .json beside it states; rows: n times the asked 1e-9.
TEST(FormFactorsCommand, WritesTheMatrix) {
  proves({"IU.6-3", "IU.6-6"}, Oracle::closed_form, "Howell C-11 for a cube");
  const TemporaryFolder folder;
  std::string obj;
  for (int k = 0; k < 8; ++k) {
    obj += "v " + digits(std::min(1.0, kBoxCorners[k][0])) + " " + digits(kBoxCorners[k][1]) + " " +
           digits(kBoxCorners[k][2]) + "\n";
  }
  for (const auto& wall : kBoxWalls) {
    obj += "f";
    for (const int corner : wall) obj += " " + std::to_string(corner + 1);
    obj += "\n";
  }
  const std::string scene = folder.add("cube.obj", obj).string(), csv = (folder.path() / "f.csv").string(),
                    json = (folder.path() / "f.json").string();
  ASSERT_EQ(form_factors({scene, "--relative", "1e-9", "-o", csv}).code, 0);
  ASSERT_EQ(form_factors({scene, "--relative", "1e-9", "--output", json}).code, 0);
  EXPECT_EQ(folder.contents(), "cube.obj f.csv f.json");
  const auto facts = nlohmann::json::parse(read_text(json));
  std::istringstream lines(read_text(csv));
  std::size_t row = 0;
  for (std::string line; std::getline(lines, line); ++row) {
    std::istringstream cells(line);
    double sum = 0;
    std::size_t column = 0;
    for (std::string cell; std::getline(cells, cell, ','); ++column) {
      const double value = std::stod(cell);
      sum += value;
      EXPECT_EQ(value, facts.at("F")[row][column].get<double>());
      const bool opposite = row / 2 == column / 2 && row != column;
      if (opposite) {
        EXPECT_TRUE(near(value, 0.19982489569838747, facts.at("bounds")[row][column].get<double>()));
      }
    }
    EXPECT_EQ(column, 6u);
    EXPECT_TRUE(near(sum, 1, 6e-9));
  }
  EXPECT_EQ(row, 6u);
}

// CLAIM      --pair prints one pair, by number or by name, with its bound and what stands between; an unknown name is refused
//            with the nearest.
// ORACLE     exact: the same numbers as in the matrix; the messages.
// TOLERANCE  none.
TEST(FormFactorsCommand, PrintsOnePair) {
  proves({}, Oracle::exact, "the matrix, and the messages");
  const TemporaryFolder folder;
  const std::string scene = folder.add("box.vs3", room_texts()[0].second + floating_plate()).string();
  const Ended one = form_factors({scene, "--relative", "1e-3", "--pair", "1", "wall-1", "--json"});
  ASSERT_EQ(one.code, 0) << one.err;
  const auto pair = nlohmann::json::parse(one.out);
  ASSERT_EQ(form_factors({scene, "--relative", "1e-3", "-o", (folder.path() / "m.json").string()}).code, 0);
  const auto matrix = nlohmann::json::parse(read_text(folder.path() / "m.json"));
  EXPECT_TRUE(holds(pair.at("factor") == matrix.at("F")[0][1] && pair.at("back") == matrix.at("F")[1][0]));
  EXPECT_TRUE(holds(pair.at("blockers") == std::vector<std::string>{"obstruction 7"}));
  const Ended text = form_factors({scene, "--relative", "1e-3", "--pair", "wall-0", "wall-4"});
  EXPECT_TRUE(holds(text.code == 0 && has(text.out, "partly obstructed by 'obstruction 7'") && has(text.out, "clamps")))
      << text.out;
  const Ended unknown = form_factors({scene, "--pair", "1", "wal-1"});
  EXPECT_TRUE(holds(unknown.code == 2 && has(unknown.err, "did you mean 'wall-"))) << unknown.err;
  EXPECT_EQ(form_factors({scene, "--pair", "1"}).code, 2);
  EXPECT_EQ(form_factors({scene, "--pair", "0", "1"}).code, 2);
  EXPECT_EQ(form_factors({scene, "--pair", "1", "2", "--drop", "1e-3"}).code, 2);
  EXPECT_EQ(form_factors({scene, "--pair", "1", "2", "--repair-closure"}).code, 2);
}

// CLAIM      A repair that is refused loses no factor: they stay in the checkpoint, the message says so, and --resume writes them.
// ORACLE     exact: an open scene cannot be closed; the files, and the matrix of a run without repair.
// TOLERANCE  none.
TEST(FormFactorsCommand, KeepsTheFactorsOfARefusedRepair) {
  proves({}, Oracle::exact, "the files, and the message");
  const TemporaryFolder folder;
  const std::string scene = folder.add("a.json", slow_scene(1)).string();
  const std::string csv = (folder.path() / "f.csv").string(), whole = (folder.path() / "w.csv").string();
  const Ended refused = form_factors({scene, "--repair-closure", "-o", csv});
  EXPECT_TRUE(holds(refused.code == 4 && has(refused.err, "f.csv.checkpoint: --resume takes"))) << refused.err;
  EXPECT_EQ(folder.contents(), "a.json f.csv.checkpoint");
  EXPECT_EQ(form_factors({scene, "--resume", "-o", csv}).code + form_factors({scene, "-o", whole}).code, 0);
  EXPECT_TRUE(holds(read_text(csv) == read_text(whole) && folder.contents() == "a.json f.csv w.csv"));
}

// CLAIM      A tolerance that is not reached makes exit code 4 and names the worst pair and its bound; the matrix is written
//            all the same.
// ORACLE     exact: nothing reaches a relative error of 1e-15 past an obstruction.
// TOLERANCE  none.
TEST(FormFactorsCommand, SaysWhatItDidNotReach) {
  proves({}, Oracle::exact, "exit code and words");
  const TemporaryFolder folder;
  const std::string scene = folder.add("box.vs3", room_texts()[0].second + floating_plate()).string();
  const Ended ended =
      form_factors({scene, "--relative", "1e-16", "--absolute", "0", "-o", (folder.path() / "m.npy").string()});
  EXPECT_EQ(ended.code, 4);
  EXPECT_TRUE(holds(has(ended.err, "tolerance not reached: ") && has(ended.err, "the largest is "))) << ended.err;
  EXPECT_EQ(folder.contents(), "box.vs3 m.npy");
}

// CLAIM      IU.6.4: hemicube and cubic tetrahedron are methods of the command: asked for nothing they end with 0, asked for
//            more than pixels reach with 4; an odd resolution is refused; the same seed gives the same bytes, another others.
// ORACLE     exact: exit codes, words, and outputs compared.
// TOLERANCE  none.
TEST(FormFactorsCommand, LooksThroughPixels) {
  proves({"IU.6.4"}, Oracle::exact, "exit codes, words, bytes");
  for (const std::string method : {"hemicube", "tetrahedron"}) {
    const std::vector<std::string> base{furnace(), "--method", method, "--resolution", "50", "--rotate"};
    const auto with = [&](std::vector<std::string> more) {
      more.insert(more.begin(), base.begin(), base.end());
      return form_factors(more);
    };
    const Ended plain = with({});
    EXPECT_EQ(plain.code, 0) << plain.err;
    EXPECT_TRUE(holds(has(plain.out, "measured against exact integration"))) << plain.out;
    const Ended asked = with({"--relative", "1e-6"});
    EXPECT_EQ(asked.code, 4);
    EXPECT_TRUE(holds(has(asked.err, "tolerance not reached")));
    const std::vector<std::string> pair{"--pair", "1", "20", "--json"};
    const std::vector<std::string> other{"--pair", "1", "20", "--json", "--seed", "2"};
    EXPECT_TRUE(holds(with(pair).out == with(pair).out));
    EXPECT_TRUE(holds(with(pair).out != with(other).out));
  }
  EXPECT_EQ(form_factors({furnace(), "--method", "hemicube", "--resolution", "51"}).code, 2);
  EXPECT_EQ(form_factors({furnace(), "--method", "hemicube", "--resolution", "48"}).code, 2);
}

// CLAIM      An interrupted run ends with 6 and keeps its checkpoint; --resume finishes to the same bytes; without --resume
//            the checkpoint is not overwritten, and with another geometry it is refused by the surface's name.
// ORACLE     metamorphic: the bytes of an undisturbed run.
// TOLERANCE  none.
TEST(FormFactorsCommand, ResumesAfterAnInterruption) {
  proves({}, Oracle::metamorphic, "the bytes of an undisturbed run");
  const TemporaryFolder folder;
  const std::string scene = (folder.path() / "slow.json").string(), output = (folder.path() / "m.npy").string(),
                    whole = (folder.path() / "whole.npy").string();
  const std::vector<std::string> settings{scene, "--relative", "1e-2", "--absolute", "1e-6", "--quiet", "-o"};
  const auto with = [&](std::vector<std::string> more) {
    std::vector<std::string> all{"form-factors"};
    all.insert(all.end(), settings.begin(), settings.end());
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  ProcessOptions interrupted;
  interrupted.interrupt_after = 1;
  // As many elements as keep this machine busy for longer than that.
  int cells = 12;
  Ended first;
  for (; cells <= 96; cells += cells / 4) {
    folder.add("slow.json", slow_scene(cells));
    first = run_etendue(with({output, "--threads", "1"}), interrupted);
    if (first.code == 6) break;
    std::filesystem::remove(output);
  }
  ASSERT_EQ(first.code, 6) << first.err;
  EXPECT_EQ(first.signal, 0);
  EXPECT_EQ(folder.contents(), "m.npy.checkpoint slow.json");
  EXPECT_EQ(run_etendue(with({output})).code, 2) << "there is a checkpoint already";
  folder.add("slow.json", [&] {
    std::string text = slow_scene(cells);
    return text.replace(text.find("[1,1,1],[3,1.2,1.1]"), 7, "[1,1,1.0000001]")
        .replace(text.find("[1,2.8,1.1]"), 11, "[1,2.8,1.1000001]");
  }());
  const Ended differs = run_etendue(with({output, "--resume"}));
  EXPECT_TRUE(holds(differs.code == 3 && has(differs.err, "'screen'"))) << differs.err;
  folder.add("slow.json", slow_scene(cells));
  const Ended again = run_etendue(with({output, "--resume"}));
  EXPECT_TRUE(holds(!has(again.err, "nothing to resume"))) << again.err;
  EXPECT_TRUE(again.code == 0 || again.code == 4) << again.err;
  const Ended undisturbed = run_etendue(with({whole, "--threads", "1"}));
  EXPECT_EQ(undisturbed.code, again.code);
  EXPECT_TRUE(holds(read_text(output) == read_text(whole)));
  EXPECT_EQ(folder.contents(), "m.npy slow.json whole.npy");
}

/// A file that is wrong in one way, and what must be said of it.
struct WrongFile {
  std::string name, text, place, words;
};

std::vector<WrongFile> wrong_files() {
  const std::string box = room_texts()[0].second, obj = room_texts()[2].second, stl = ascii_stl();
  const auto with = [](std::string text, const std::string& original, const std::string& instead) {
    return text.replace(text.find(original), original.size(), instead);
  };
  const std::string head = "F 3\nV 1 0 0 0\nV 2 1 0 0\nV 3 1 1 0\nV 4 0 1 0\nV 5 0 0 1\nV 6 .5 .1 0\nV 7 2 2 0\n";
  return {
      {"a.vs3", with(box, "S 3", "Q 3"), ":14: ", "found unknown record 'Q'"},
      {"a.vs3", with(box, "V 3 2 1 0", "V 3 2 nan 0"), ":6: ", "vertex 3: found 'nan', expected a finite number"},
      {"a.vs3", with(box, "V 3 2 1 0", "V 3 2 1e60 0"), ":6: ", "vertex 3: found '1e60'"},
      {"a.vs3", with(box, "V 3 2 1 0", "V 4 2 1 0"),
       ":6: ", "vertex 3, its number: found '4', expected an integer in [3, 3]"},
      {"a.vs3", with(box, "V 3 2 1 0", "V 3 2 1"), ":6: ", "vertex 3: found 2 coordinates, expected x y z"},
      {"a.vs3", with(box, "S 2 5 8 7 6", "S 2 5 8 7 66"),
       ":13: ", "surface 2 'wall-1', corner 4: found '66', expected a vertex in [1, 8] or 0"},
      {"a.vs3", with(box, "0 0 0.9 wall-2", "9 0 0.9 wall-2"), ":14: ", "surface 3 'wall-2': found base 9"},
      {"a.vs3", with(box, "0 0 0.9 wall-2", "0 3 0.9 wall-2"), ":14: ", "expected a lower number than its own"},
      {"a.vs3", with(box, "0 0 0.9 wall-2", "0 0 1.9 wall-2"), ":14: ", "surface 3 'wall-2', emit: found '1.9'"},
      {"a.vs3", with(box, "eps=1e-5", "esp=1e-5"), ":2: ", "unknown control 'esp'"},
      {"a.vs3", with(box, "F 3\n", "F 2\n"), ":3: ", "record F: found '2', expected 3 or 3a"},
      {"a.vs3", "T nothing\n", ": ", "found no record 'F 3' or 'F 3a'"},
      {"a.vs3", box + "S 7 1 2 3 4 0 0 .9 again\n",
       ":18: ", "surface 'again' is there twice: it covers the same area as surface 'wall-0' of line 12"},
      {"a.vs3", head + "S 1 1 2 3 4 0 0 1 a\nS 2 1 2 6 4 0 0 1 b\n", ":10: ", "surface 2 'b': is concave"},
      {"a.vs3", head + "S 1 1 2 3 4 0 0 1 a\nS 2 1 3 2 4 0 0 1 b\n", ":10: ", "surface 2 'b': polygon: "},
      {"a.vs3", head + "S 1 1 2 3 4 0 0 1 a\nS 2 1 2 2 4 0 0 1 b\n", ":10: ", "coincide"},
      {"a.vs3", head + "S 1 1 2 3 5 0 0 1 a\n", ":9: ", "surface 1 'a': is not flat: a vertex is "},
      {"a.vs3", head + "S 1 1 2 3 4 0 0 1 a\nS 2 1 6 7 0 0 0 1 b\n",
       ":10: ", "surface 'b' overlaps surface 'a' of line 9"},
      {"a.vs3", head + "S 1 1 2 3 4 0 0 1 a\nS 2 1 6 3 0 0 0 1 b\n", ":10: ", "surface 'b' lies inside surface 'a'"},
      {"a.vs3", head + "S 1 1 2 3 4 0 0 1 a\nS 2 1 6 7 0 1 0 1 b\n", ":10: ", "reaches beyond its base surface 1 'a'"},
      {"a.vs3", head + "S 1 1 2 3 4 0 0 1 a\nS 2 1 3 6 0 1 0 1 b\n", ":10: ", "faces its base surface 1 'a'"},
      {"a.vs3", head + "S 1 1 2 5 0 0 0 1 a\nS 2 1 2 3 4 1 0 1 b\n", ":10: ", "off the plane of its base"},
      {"a.vs3", "F 3a\nS 1 R 0 0 1 a\n 0 0 0 0 90 1\nS 2 R 0 0 1 b\n", ":2: ", "found 6 numbers below it, expected 7"},
      {"a.json",
       with(slow_scene(1), R"({"type": "polygon", "name": "floor")",
            R"({"type": "sphere", "name": "ball", "material": "m", "centre": [1,1,0], "radius": 0.5},
                         {"type": "polygon", "name": "floor")"),
       ":5:3: /objects/0: ", "object 'ball' pierces or lies in object 'floor'"},
      {"a.obj", with(obj, "f 1 2", "f 1 29"), ":11: ", "face 1, corner 2: found '29', expected a vertex in [1, 8]"},
      {"a.obj", with(obj, "v 2 1 0", "v 2 inf 0"), ":5: ", "vertex 3: found 'inf'"},
      {"a.obj", obj + "f 1 2 3\n", ":17: ", "surface 'box[7]' lies inside surface 'box[1]'"},
      {"a.obj", with(obj, "f 1 2 3 4", "f 1 2"), ":11: ", "face 1: found 2 corners, expected 3 or more"},
      {"a.obj", with(obj, "f 1 2 3 4", "curv 1 2"), ":11: ", "found unknown record 'curv'"},
      {"a.obj", "v 0 0 0\n", ": ", "found no face"},
      {"a.stl", with(stl, "vertex 2 0 0", "vertex 2 x 0"), ":5: ", "triangle 1, vertex: found 'x'"},
      {"a.stl", with(stl, "vertex 2 0 0\n", ""), ":7: ", "found 2 vertices, expected 3"},
      {"a.stl", stl.substr(0, stl.size() / 2), ":44: ", "cut short"},
      {"a.stl", binary_stl().substr(0, 600), ": ", "found 600 bytes, expected 684 for the 12 triangles"},
      {"a.stl", std::string("\x7f", 1), ": ", "do not begin with 'solid'"},
      {"a.stl", std::string(80, ' ') + "\xff\xff\xff\xff", ": ", "for the 4294967295 triangles"},
  };
}

// CLAIM      Each kind of wrong file makes exit code 3 and a message with file, line and surface; nothing is written.
// ORACLE     exact: files that are wrong in one way each, lines counted by hand.
// TOLERANCE  none.
TEST(FormFactorsCommand, RefusesWrongFilesWithTheirPlace) {
  proves({}, Oracle::exact, "files that are wrong in one way each");
  std::uint64_t wrong = 0;
  const auto files = wrong_files();
  for (const WrongFile& file : files) {
    const TemporaryFolder folder;
    const std::string path = folder.add(file.name, file.text).string();
    const Ended ended = form_factors({path, "-o", (folder.path() / "m.csv").string()});
    const bool right = ended.code == 3 && ended.out.empty() && has(ended.err, path + file.place) &&
                       has(ended.err, file.words) && (has(ended.err, " error") || file.name == "a.json") &&
                       folder.contents() == file.name;
    if (right) continue;
    ++wrong;
    ADD_FAILURE() << "ended with " << ended.code << ", found\n"
                  << ended.err << "expected\n"
                  << file.place << " … " << file.words;
  }
  EXPECT_TRUE(all_agree(wrong, files.size()));
}

// CLAIM      All errors of a file are reported at once, in the order of their lines.
// ORACLE     exact: three errors planted.
// TOLERANCE  none.
TEST(FormFactorsCommand, ReportsAllErrorsAtOnce) {
  proves({}, Oracle::exact, "three errors planted");
  const TemporaryFolder folder;
  const std::string path =
      folder.add("a.vs3", "F 3\nV 1 0 0 0\nV 2 x 0 0\nV 3 1 1 0\nZ 1\nS 1 1 2 9 0 0 0 1 a\n").string();
  const Ended ended = form_factors({path});
  const std::string expected = "etendue form-factors: " + path +
                               ":3: vertex 2: found 'x', expected a finite number no larger than 1e50\n" + path +
                               ":5: found unknown record 'Z', expected one of T C F V S M N O X / E *\n" + path +
                               ":6: surface 1 'a', corner 3: found '9', expected a vertex in [1, 3]\n3 errors\n";
  EXPECT_TRUE(holds(ended.err == expected)) << ended.err;
}

// CLAIM      --resume where no run was interrupted begins anew, and says so.
// ORACLE     exact: the message to the letter; the folder's contents.
// TOLERANCE  none.
TEST(FormFactorsCommand, SaysThatThereIsNothingToResume) {
  proves({}, Oracle::exact, "the message and the folder's contents");
  const TemporaryFolder folder;
  const std::string output = (folder.path() / "m.csv").string();
  const Ended ended = form_factors({furnace(), "--resume", "--quiet", "-o", output});
  EXPECT_TRUE(holds(ended.code == 0)) << ended.code;
  EXPECT_TRUE(holds(ended.err == "etendue form-factors: nothing to resume, beginning anew: there is no '" + output +
                                     ".checkpoint'\n"))
      << ended.err;
  EXPECT_EQ(folder.contents(), "m.csv");
}

// CLAIM      Wrong use is refused with exit code 2: another ending, an output that would replace the scene, --resume
//            without a file, a tolerance out of range.
// ORACLE     exact: exit codes.
// TOLERANCE  none.
TEST(FormFactorsCommand, RefusesWrongUse) {
  proves({}, Oracle::exact, "exit codes");
  const TemporaryFolder folder;
  const std::string scene = folder.add("box.json", read_text(furnace())).string();
  EXPECT_TRUE(holds(form_factors({scene, "-o", scene}).code == 2));
  EXPECT_TRUE(holds(form_factors({scene, "-o", (folder.path() / "a.txt").string()}).code == 2));
  EXPECT_TRUE(holds(form_factors({scene, "--resume"}).code == 2));
  EXPECT_TRUE(holds(form_factors({scene, "--relative", "-1"}).code == 2));
  EXPECT_TRUE(holds(form_factors({scene, "--method", "guess"}).code == 2));
  EXPECT_TRUE(holds(form_factors({folder.add("a.dxf", "x").string()}).code == 2));
  EXPECT_TRUE(holds(form_factors({(folder.path() / "none.vs3").string()}).code == 5));
  EXPECT_EQ(read_text(scene), read_text(furnace()));
}

// CLAIM      IU.6-3: a polygon of 10,000 vertices is no harder than it must be: form-factors finds the factor from a square to
//            it, solve the radiosities, both in seconds where each vertex was once held against the sum over all.
// ORACLE     closed form: from an element to a coaxial disc (Hamilton and Morgan 1952), averaged over the square.
// TOLERANCE  1e-6: h²/24 times second derivatives below 4 for the midpoints of h = 1e-3; 7e-8 for what of the disc the
//            polygon leaves out; the bound that is printed.
TEST(FormFactorsCommand, TakesAPolygonOfTenThousandVertices) {
  proves({"IU.6-3"}, Oracle::closed_form, "element to disc, averaged");
  constexpr int kVertices = 10000, kCells = 1000;
  std::ostringstream scene;
  scene.precision(17);
  scene << R"({"format": "etendue-scene", "version": 1, "unit": "m", "materials": {"m": {"rho": 0.5, "emission": 1}},
 "camera": {"eye": [0, 0, 0.5], "gaze": [0, 1, 0], "up": [0, 0, 1], "horizontal_fov_deg": 60, "resolution": [8, 8]},
 "objects": [{"type": "polygon", "name": "lid", "material": "m", "vertices": [[-1,-1,1],[-1,1,1],[1,1,1],[1,-1,1]]},
  {"type": "polygon", "name": "round", "material": "m", "vertices": [[1, 0, 0])";
  for (int k = 1; k < kVertices; ++k) {
    const double angle = 2 * std::numbers::pi * k / kVertices;
    scene << ",[" << std::cos(angle) << ',' << std::sin(angle) << ",0]";
  }
  const TemporaryFolder folder;
  const Ended pair =
      form_factors({folder.add("a.json", scene.str() + "]}]}").string(), "--pair", "lid", "round", "--json"});
  ASSERT_EQ(pair.code, 0) << pair.err;
  double mean = 0;  // of a quarter, as of all
  for (int i = 0; i < kCells * kCells; ++i) {
    const double d = std::hypot((i % kCells + 0.5) / kCells, (i / kCells + 0.5) / kCells);
    mean += (1 - d * d / std::sqrt((2 + d * d) * (2 + d * d) - 4 * d * d)) / 2 / kCells / kCells;
  }
  const auto report = nlohmann::json::parse(pair.out);
  EXPECT_TRUE(near(report.at("factor").get<double>(), mean, 1e-6 + report.at("bound").get<double>()));
  const Ended solved = run_etendue(
      {"solve", (folder.path() / "a.json").string(), "--quiet", "--output", (folder.path() / "out.png").string()});
  EXPECT_TRUE(holds(solved.code == 0 && solved.err.empty())) << solved.code << solved.err;
}

}  // namespace
}  // namespace etendue::validation
