// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>
#include <regex>

#include "cli/solve_runs.hpp"
#include "support/evidence.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {
namespace {

using Json = nlohmann::json;

// One polygon of n × n elements.
std::string plate_text(int n) {
  return R"({"format": "etendue-scene", "version": 1, "unit": "m", "materials": {"grey": {"rho": 0.5, "emission": 1}},
 "camera": {"eye": [0.5, 0.5, 2], "look_at": [0.5, 0.5, 0], "up": [0, 1, 0], "horizontal_fov_deg": 60,
            "resolution": [16, 16]},
 "objects": [{"type": "polygon", "name": "plate", "material": "grey", "elements": [)" +
         std::to_string(n) + ", " + std::to_string(n) + R"(],
              "vertices": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]}]})";
}

// CLAIM      Where form factors are less certain than --tolerance asks, solve ends with 4, saves everything, and names
//            the number of pairs, the worst pair, its bound and what was asked; where they are not, it ends with 0.
// ORACLE     identity: the same scene with a tolerance that is kept, and with one below what double carries.
// TOLERANCE  none.
TEST(SolveCommand, EndsWith4WhenTheToleranceIsMissed) {
  proves({}, Oracle::identity, "exit code, files and message");
  const TemporaryFolder folder;
  // One element a wall: what cannot be reached is tried for long.
  const std::regex divisions(", \"elements\": \\[[0-9], [0-9]\\]");
  const auto scene = folder.add("screened.json", std::regex_replace(furnace_with(kScreen), divisions, ""));
  const Ended kept = solve(scene, {"--tolerance", "1e-3"});
  EXPECT_EQ(kept.code, 0) << kept.err;
  EXPECT_EQ(kept.err, "");
  EXPECT_TRUE(holds(says(kept, "tolerance    0.001: kept by all pairs"))) << kept.out;
  const Ended missed = solve(scene, {"--tolerance", "1e-12", "--json"});
  EXPECT_TRUE(holds(missed.code == 4)) << missed.code << missed.err;
  EXPECT_EQ(folder.contents(), "out.exr out.json out.png screened.json");
  const Json report = Json::parse(read_text(folder.path() / "out.json"));
  EXPECT_EQ(report["status"], "tolerance missed");
  const Json& worst = report["missed_tolerance"];
  EXPECT_TRUE(holds(worst["pairs"] > 0 && worst["bound"] > worst["asked"]));
  EXPECT_EQ(report, [&] {
    Json summary = Json::parse(missed.out);
    summary.erase("files");
    summary.erase("seconds");
    for (const char* key : {"elements", "faces", "contacts"}) summary[key] = report[key];
    return summary;
  }());
  const auto object = [&](std::size_t k) {
    return report["elements"][worst["worst_elements"][k].get<std::size_t>()]["object"].get<std::string>();
  };
  for (const std::string& words :
       std::vector<std::string>{"etendue solve: tolerance not reached: ", worst["pairs"].dump() + " pairs",
                                "(" + object(0) + ")", "(" + object(1) + ")", "--tolerance 1e-12", "all was saved"}) {
    EXPECT_TRUE(holds(says({0, 0, "", missed.err, 0}, words))) << words << " in " << missed.err;
  }
}

// CLAIM      Interrupted while the picture is drawn, solve ends with 6; the radiosities are saved before it begins.
// ORACLE     closed form: E/(1 − ρ) on every element of the furnace.
// TOLERANCE  the bound with form factors that the report states.
TEST(SolveCommand, KeepsTheRadiositiesWhenInterruptedInThePicture) {
  proves({}, Oracle::closed_form, "E/(1 − ρ) in the saved report");
  const TemporaryFolder folder;
  const auto scene = folder.add("large.json", replaced(furnace_text(), "[64, 48]", "[1600, 1200]"));
  ProcessOptions options;
  options.interrupt_at = "picture [";
  const Ended ended = solve(scene, {"--samples", "2"}, options);
  EXPECT_EQ(ended.signal, 0);
  EXPECT_TRUE(holds(ended.code == 6)) << ended.code << ended.err;
  EXPECT_TRUE(holds(says(ended, "stopped; sensors or pictures are missing; the radiosities are in"))) << ended.err;
  EXPECT_EQ(folder.contents(), "large.json out.factors.resume out.json");
  const Json report = Json::parse(read_text(folder.path() / "out.json"));
  const double expected[] = {3, 8, 10};
  const char* const channels[] = {"red", "green", "blue"};
  for (std::size_t c = 0; c < 3; ++c) {
    const double bound = report["channels"][channels[c]]["bound_with_form_factors"].get<double>();
    for (const Json& element : report["elements"]) {
      EXPECT_TRUE(near(element["radiosity"][c].get<double>(), expected[c], bound));
    }
  }
}

// CLAIM      A scene that is open, or in which nothing sees anything, is called that; its elements are not called
//            covered.
// ORACLE     exact: the words.
// TOLERANCE  none.
TEST(SolveCommand, SaysWhetherASceneIsClosed) {
  proves({}, Oracle::exact, "the words");
  const TemporaryFolder folder;
  const auto closed = folder.add("closed.json", furnace_text());
  EXPECT_TRUE(holds(says(solve(closed, {}), "closure      closed: 48 elements see 1 to within ")));
  const auto plate = folder.add("plate.json", plate_text(2));
  const Ended alone = solve(plate, {});
  EXPECT_EQ(alone.code, 0) << alone.err;
  EXPECT_TRUE(holds(says(alone, "closure      none to judge: no element sees the front of another\n"))) << alone.out;
  EXPECT_TRUE(holds(says(alone, "void         4 elements see no front and face the void\n"))) << alone.out;
  EXPECT_TRUE(holds(!says(alone, "covered"))) << alone.out;
  std::string text = furnace_text();
  const std::size_t side = text.rfind(",\n    {\"type\": \"polygon\", \"name\": \"near\"");
  text.replace(side, text.rfind("\n  ]") - side, "");
  const Ended open = solve(folder.add("open.json", text), {});
  EXPECT_TRUE(holds(says(open, "closure      open: 0 elements see 1 to within their bounds, 47 less, 0 more")))
      << open.out;
}

// CLAIM      An element so small that the bounds of its form factors say nothing is called unknown, neither covered nor closed;
//            and the tolerance is not said to be kept by its own factors.
// ORACLE     exact: a triangle of 10⁻⁹ m in the middle of a closed box lies in and under nothing.
// TOLERANCE  none.
TEST(SolveCommand, SaysWhatItDoesNotKnowOfATinyElement) {
  proves({}, Oracle::exact, "a triangle in mid-air");
  const TemporaryFolder folder;
  const auto scene = folder.add("tiny.json", furnace_with(R"({"type": "polygon", "name": "speck", "material": "glowing",
        "vertices": [[1, 1, 0.7], [1.000000001, 1, 0.7], [1, 1.000000001, 0.7]]})"));
  const Ended ended = solve(scene, {"--samples", "1"});
  const Json closure = Json::parse(read_text(folder.path() / "out.json"))["closure"];
  EXPECT_TRUE(holds(closure["covered_elements"].empty() && closure["elements_unknown"] == 1)) << closure;
  EXPECT_TRUE(holds(closure["state"] == "unknown")) << closure;
  EXPECT_TRUE(holds(says(ended, "kept from the larger element of all pairs, not from 1 tiny element"))) << ended.out;
  EXPECT_TRUE(holds(says(ended, "unknown      1 element, whose form factors are known to 1 or worse"))) << ended.out;
}

// CLAIM      What radiosity cannot divide is refused with 3: every object of the file, each with file, line, column,
//            pointer and name, which cannot steer a terminal.
// ORACLE     exact: the places, counted by hand.
// TOLERANCE  none.
TEST(SolveCommand, RefusesEveryObjectThatItCannotDivide) {
  proves({}, Oracle::exact, "places counted by hand");
  const TemporaryFolder folder;
  const auto scene =
      folder.add("curved.json", furnace_with("{\"type\": \"sphere\", \"name\": \"ball\\u001b[2J\", \"material\": "
                                             "\"glowing\", \"centre\": [1, 1, 1], \"radius\": 0.2},\n"
                                             "{\"type\": \"disc\", \"material\": \"glowing\", \"centre\": [1, 1, 1], "
                                             "\"normal\": [0, 0, 1], \"radius\": 1}"));
  const Ended ended = solve(scene, {});
  EXPECT_TRUE(holds(ended.code == 3)) << ended.code;
  EXPECT_EQ(folder.contents(), "curved.json");
  EXPECT_TRUE(holds(says(ended, scene.string() + ":18:15: /objects/0: object 'ball"))) << ended.err;
  EXPECT_TRUE(holds(says(ended, "is a sphere: radiosity elements are flat"))) << ended.err;
  EXPECT_TRUE(holds(says(ended, scene.string() + ":19:1: /objects/1: object '/objects/1' is a disc"))) << ended.err;
  EXPECT_TRUE(holds(says(ended, "\n2 errors\n"))) << ended.err;
  EXPECT_EQ(ended.err.find('\x1b'), std::string::npos) << ended.err;

  const auto wrong = folder.add("wrong.json", replaced(replaced(furnace_text(), "\"left\", \"material\": \"glowing\"",
                                                                "\"left\", \"material\": \"glowin\""),
                                                       "\"horizontal_fov_deg\": 90", "\"horizontal_fov_deg\": 190"));
  const Ended both = solve(wrong, {});
  EXPECT_TRUE(holds(both.code == 3)) << both.code;
  EXPECT_TRUE(holds(says(both, wrong.string() + ":12:27: /camera/horizontal_fov_deg: found 190"))) << both.err;
  EXPECT_TRUE(holds(says(both, wrong.string() + ":23:53: /objects/2/material: "))) << both.err;
  EXPECT_TRUE(holds(says(both, "\n2 errors\n"))) << both.err;
}

// CLAIM      Surfaces that overlap are refused with 3, the place and both names: their light would leave one place twice.
// ORACLE     exact: places counted by hand.
// TOLERANCE  none.
TEST(SolveCommand, RefusesSurfacesThatOverlap) {
  proves({}, Oracle::exact, "places counted by hand");
  const TemporaryFolder folder;
  const auto scene =
      folder.add("twice.json", furnace_with(R"({"type": "polygon", "name": "again", "material": "glowing",
     "vertices": [[0, 0, 0], [2, 0, 0], [2, 3, 0], [0, 3, 0]]},
    {"type": "polygon", "name": "part", "material": "glowing",
     "vertices": [[1, 1, 1.5], [1, 4, 1.5], [3, 4, 1.5], [3, 1, 1.5]]})"));
  const Ended ended = solve(scene, {});
  EXPECT_TRUE(holds(ended.code == 3)) << ended.code;
  EXPECT_EQ(folder.contents(), "twice.json");
  EXPECT_TRUE(
      holds(says(ended, scene.string() + ":22:5: /objects/2: object 'floor' is there twice: it covers the same " +
                            "area as object 'again'")))
      << ended.err;
  EXPECT_TRUE(holds(says(ended, ": /objects/3: object 'ceiling' overlaps object 'part'"))) << ended.err;
  EXPECT_TRUE(holds(says(ended, "\n2 errors\n"))) << ended.err;
}

// CLAIM      A mesh whose matrix cannot be held is refused with 5 before it is begun: elements, bytes, and what to do.
// ORACLE     closed form: 40 n² bytes.
// TOLERANCE  none: the printed digits.
TEST(SolveCommand, RefusesAMatrixThatNoMemoryHolds) {
  proves({}, Oracle::closed_form, "40 n² bytes");
  const TemporaryFolder folder;
  const Ended ended = solve(folder.add("huge.json", plate_text(600)), {});
  EXPECT_TRUE(holds(ended.code == 5)) << ended.code;
  // 360,000² · 40 = 5.184e12 bytes.
  EXPECT_TRUE(
      holds(says(ended, "huge.json: 360000 elements need 5.18e+03 GB of memory (40 bytes for each of n² pairs), ")))
      << ended.err;
  EXPECT_TRUE(holds(says(ended, "divide the surfaces into fewer elements"))) << ended.err;
  EXPECT_EQ(folder.contents(), "huge.json");
}

// CLAIM      An exposure of zero, which would make every picture black, is refused by both commands.
// ORACLE     exact: exit code and message.
// TOLERANCE  none.
TEST(SolveCommand, RefusesAnExposureOfZero) {
  proves({}, Oracle::exact, "exit code and message");
  const std::string scene = (source_root() / "scenes" / "furnace" / "scene.json").string();
  for (const std::string command : {"solve", "render"}) {
    const Ended ended = run_etendue({command, scene, "--exposure", "0"});
    EXPECT_TRUE(holds(ended.code == 2)) << command << ended.code;
    EXPECT_TRUE(holds(says(ended, "option '--exposure': found '0', expected a number in [1e-12, 1e+12]"))) << ended.err;
  }
}

/// The numbers of a line of text, without its first word.
std::vector<double> numbers(const std::string& text, const std::string& first_word) {
  const std::size_t begin = text.find("\n" + first_word + " ");
  if (begin == std::string::npos) return {};
  std::string line = text.substr(begin + 1 + first_word.size(), text.find('\n', begin + 1) - begin - 1);
  line = line.substr(0, line.find('\n'));
  std::vector<double> found;
  const std::regex number(R"((^|[ (])(-?[0-9][0-9.]*(e[+-]?[0-9]+)?))");
  for (std::sregex_iterator at(line.begin(), line.end(), number), end; at != end; ++at)
    found.push_back(std::stod((*at)[2]));
  return found;
}

// CLAIM      What solve reports of the furnace are the furnace's facts: elements, pairs, row sums, power, exposure.
// ORACLE     closed form: the box of 2 × 3 × 1.5 m, E/(1 − ρ) on every element, E A emitted and absorbed.
// TOLERANCE  the bounds that the report states; 1e-12 of what is summed over 48 elements in double.
TEST(SolveCommand, ReportsTheFactsOfTheFurnace) {
  proves({}, Oracle::closed_form, "the facts of a box that glows evenly");
  const TemporaryFolder folder;
  const auto scene = folder.add("box.json", furnace_text());
  const Ended ended = solve(scene, {"--json", "--solver", "eigen", "--exposure", "0.125"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json report = Json::parse(read_text(folder.path() / "out.json")), printed = Json::parse(ended.out);
  EXPECT_TRUE(holds(report["status"] == "solved" && report["rows_done"] == 48 && report["exposure"] == 0.125));
  EXPECT_TRUE(holds(report["scene"]["name"] == "furnace" && report["scene"]["metres_per_unit"] == 1));
  EXPECT_TRUE(holds(report["settings"]["solver"] == "lu" && report["settings"]["tolerance_obstructed"] == 1e-6));
  EXPECT_TRUE(holds(report["mesh"] == Json({{"faces", 6}, {"patches", 6}, {"elements", 48}})));
  EXPECT_TRUE(holds(printed["files"]["scene"] == scene.string() && printed["seconds"] > 0));
  for (const std::string kind : {"json", "exr", "png"}) {
    EXPECT_TRUE(holds(printed["files"][kind] == (folder.path() / ("out." + kind)).string()));
  }
  // Elements of one wall do not see each other: 12, 12, 10, 4, 9 and 1 of them.
  const Json& pairs = report["pairs"];
  EXPECT_TRUE(holds(pairs["averted"] == 66 + 66 + 45 + 6 + 36 && pairs["clear"] == 48 * 47 / 2 - 219)) << pairs;
  EXPECT_TRUE(holds(pairs["blocked"] == 0 && pairs["obstructed"] == 0)) << pairs;
  EXPECT_TRUE(holds(report["missed_tolerance"] == Json({{"pairs", 0}})));
  const Json& closure = report["closure"];
  EXPECT_TRUE(holds(closure["state"] == "closed" && closure["elements_closed"] == 48 && closure["elements_open"] == 0 &&
                    closure["elements_exceeded"] == 0 && closure["elements_facing_void"] == 0));
  EXPECT_TRUE(holds(closure["covered_elements"] == Json::array()));

  constexpr double kSummed = 1e-12;  // 48 roundings of 2^-53 and those of the elements' areas, with room
  const double area = 2 * (2 * 3 + 3 * 1.5 + 2 * 1.5), emission[] = {1.5, 2, 1}, rho[] = {0.5, 0.75, 0.9};
  double areas = 0, worst = 0;
  for (const Json& element : report["elements"]) {
    areas += element["area"].get<double>();
    const double defect = std::abs(element["row_sum"].get<double>() - 1);
    EXPECT_TRUE(within(defect, closure["largest_row_bound"].get<double>()));
    if (element["element"] == closure["worst_element"]) worst = defect;
    EXPECT_TRUE(holds(element["material"] == "glowing" && element["reflectance"] == Json(rho) &&
                      element["emission"] == Json(emission)));
    const std::string wall = element["object"];
    const Json& centre = element["centroid"];
    const Json& normal = element["normal"];
    if (wall == "ceiling") {
      EXPECT_TRUE(holds(centre[2] == 1.5 && normal == Json({0, 0, -1})));
    }
    if (wall == "right") {
      EXPECT_TRUE(holds(centre[0] == 2 && normal == Json({-1, 0, 0})));
    }
    if (wall == "far") {
      EXPECT_TRUE(holds(centre[1] == 3 && normal == Json({0, -1, 0})));
    }
  }
  EXPECT_TRUE(near(areas, area, area * kSummed));
  EXPECT_TRUE(near(worst, closure["defect"].get<double>(), 0));
  const char* const channels[] = {"red", "green", "blue"};
  for (std::size_t c = 0; c < 3; ++c) {
    const Json& channel = report["channels"][channels[c]];
    const auto value = [&](const char* key) { return channel[key].get<double>(); };
    const double power = emission[c] * area;
    // Every element's radiosity is known to within the bound, and what is absorbed and escapes follows from it.
    const double known = value("bound_with_form_factors") * area + power * kSummed;
    EXPECT_TRUE(near(value("emitted_watts"), power, power * kSummed));
    EXPECT_TRUE(near(value("absorbed_watts"), power, known));
    EXPECT_TRUE(near(value("escaped_watts"), 0, known + power / (1 - rho[c]) * closure["total_bound"].get<double>()));
    EXPECT_TRUE(within(std::abs(value("balance_defect_watts")), known));
    // ‖B − B*‖ ≤ residual / (1 − ρ Σ F), and the bound counts the residual's rounding as well; without it none is 0.
    EXPECT_TRUE(holds(value("bound") >= value("residual") / (1 - rho[c]) * (1 - kSummed)));
    EXPECT_TRUE(holds(value("bound_with_form_factors") > value("bound") && value("bound") > 0));
    EXPECT_TRUE(within(value("backward_error"), 48 * 0x1p-52));
  }
}

// CLAIM      The text that solve prints says what its JSON says, with four digits.
// ORACLE     identity: the two reports of one scene, with and without --json.
// TOLERANCE  four digits: 5e-4 of each number.
TEST(SolveCommand, PrintsWhatItsReportHolds) {
  proves({}, Oracle::identity, "text against JSON");
  const TemporaryFolder folder;
  const std::regex divisions(", \"elements\": \\[[0-9], [0-9]\\]");
  std::string text = std::regex_replace(furnace_with(kScreen), divisions, "");
  text = replaced(text, "\"name\": \"furnace\",\n", "");
  text = replaced(text, "\"materials\"", R"("lights": [{"type": "point", "position": [1, 1, 1], "intensity": 1}],
  "materials")");
  text = replaced(text, "\"glowing\": {", "\"glowing\": {\"k_s\": 0.5, ");
  const auto scene = folder.add("screened.json", text);
  const Ended ended = solve(scene, {"--tolerance", "1e-3"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.err,
            "etendue solve: left out: 1 point or directional light: only surfaces emit here\n"
            "etendue solve: left out: k_s, k_r and k_t of material 'glowing': every surface is ideally diffuse here\n");
  const Json report = Json::parse(read_text(folder.path() / "out.json"));
  EXPECT_TRUE(holds(
      ("\n" + ended.out)
          .find("\nscene        (no name), 7 objects, hash " + report["scene"]["hash"].get<std::string>() + "\n") == 0))
      << ended.out;
  EXPECT_TRUE(holds(says(ended, "\nclosure      " + report["closure"]["state"].get<std::string>() + ": ")))
      << ended.out;
  const auto agree = [&](const std::string& word, const std::vector<Json>& expected) {
    const auto found = numbers("\n" + ended.out, word);
    EXPECT_TRUE(holds(found.size() >= expected.size())) << word << "\n" << ended.out;
    for (std::size_t k = 0; k < std::min(found.size(), expected.size()); ++k) {
      const double whole = expected[k].get<double>();
      EXPECT_TRUE(near(found[k], whole, 5e-4 * std::abs(whole))) << word << ", number " << k << "\n" << ended.out;
    }
  };
  agree("mesh", {report["mesh"]["elements"], report["mesh"]["patches"], report["mesh"]["faces"]});
  const Json& pairs = report["pairs"];
  agree("pairs", {pairs["clear"], pairs["obstructed"], pairs["blocked"], pairs["averted"]});
  const Json& reciprocity = report["reciprocity"];
  agree("reciprocity", {reciprocity["defect"], reciprocity["pairs_checked"], reciprocity["pairs_beyond_bounds"]});
  agree("tolerance", {report["settings"]["tolerance_obstructed"], reciprocity["pairs_refined"]});
  for (const std::string channel : {"red", "green", "blue"}) {
    const Json& c = report["channels"][channel];
    agree(channel, {c["residual"], c["bound"], c["bound_with_form_factors"], c["emitted_watts"], c["absorbed_watts"],
                    c["escaped_watts"], c["balance_defect_watts"]});
  }
  agree("vertices", {report["vertices"]["distinct"], report["vertices"]["clamped"]});
  agree("exposure", {report["exposure"], 1 / report["exposure"].get<double>()});
  for (const std::string kind : {"exr", "png", "json"}) {
    EXPECT_TRUE(holds(says(ended, "\n" + (folder.path() / ("out." + kind)).string() + "\n"))) << ended.out;
  }
}

}  // namespace
}  // namespace etendue::validation
