// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cli/furnace_text.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

using Json = nlohmann::json;

Ended solve(const std::filesystem::path& scene, std::vector<std::string> more, const ProcessOptions& options = {}) {
  more.insert(more.begin(), {"solve", scene.string(), "--output", (scene.parent_path() / "out.png").string()});
  return run_etendue(more, options);
}

Json report_of(const TemporaryFolder& folder, const std::string& name) {
  return Json::parse(read_text(folder.path() / name));
}

/// The furnace with 12 × 12 patches on floor and ceiling: enough that shooting takes a while.
std::string fine_furnace() {
  const std::string text =
      replaced(furnace_text(), "\"elements\": [4, 3]", "\"elements\": [12, 12], \"patches\": [12, 12]");
  return replaced(text, "\"elements\": [3, 4]", "\"elements\": [12, 12], \"patches\": [12, 12]");
}

// CLAIM      solve --method progressive|adaptive with exact form factors finds E/(1 − ρ) in the furnace within the bound that it
//            reports; adaptive divides nothing where nothing changes but single elements.
// ORACLE     closed form: E/(1 − ρ) on every element.
// TOLERANCE  the reported bound.
TEST(RefinedCommand, SolvesTheFurnaceWithinItsBound) {
  proves({"IU.6.6"}, Oracle::closed_form, "E/(1 − ρ) in the saved report");
  const TemporaryFolder folder;
  const auto scene = folder.add("furnace.json", furnace_text());
  const double expected[] = {3, 8, 10};
  const char* const channels[] = {"red", "green", "blue"};
  for (const std::string method : {"progressive", "adaptive"}) {
    const Ended ended = solve(scene, {"--method", method, "--factors-by", "exact", "--unshot", "1e-6"});
    ASSERT_EQ(ended.code, 0) << ended.err;
    const Json report = report_of(folder, "out.json");
    EXPECT_EQ(report["status"], "solved");
    EXPECT_EQ(folder.contents(), "furnace.json out.exr out.json out.png");
    for (std::size_t c = 0; c < 3; ++c) {
      const double bound = report["channels"][channels[c]]["bound"].get<double>();
      EXPECT_TRUE(within(bound, 1e-2));
      for (const Json& element : report["elements"]) {
        EXPECT_TRUE(near(element["radiosity"][c].get<double>(), expected[c], bound + 1e-9));
      }
    }
  }
  const Ended pixels = solve(scene, {"--method", "hemicube", "--resolution", "64"});
  EXPECT_EQ(pixels.code, 0) << pixels.err;
  const Json report = report_of(folder, "out.json");
  EXPECT_EQ(report["form_factors"]["bounded"], false);
  for (const Json& element : report["elements"]) {  // rows as seen sum to one, so even pixels find this one
    for (std::size_t c = 0; c < 3; ++c) EXPECT_TRUE(near(element["radiosity"][c].get<double>(), expected[c], 1e-9));
  }
}

// CLAIM      Interrupted, solve --method progressive ends with 6 and saves what is shot; --resume ends in the same bytes as a run that
//            was not interrupted; so does a run in two parts by --steps. Another scene, or other settings, are refused.
// ORACLE     identity: equal files.
// TOLERANCE  none.
TEST(RefinedCommand, ResumesToTheSameBytes) {
  proves({"IU.6.6"}, Oracle::identity, "equal files");
  const TemporaryFolder folder;
  const auto scene = folder.add("fine.json", fine_furnace());
  const std::vector<std::string> method{"--method", "progressive", "--resolution", "240", "--unshot", "1e-3"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), method.begin(), method.end());
    return more;
  };
  ASSERT_EQ(solve(scene, with({})).code, 0);
  const std::string whole = read_text(folder.path() / "out.json");
  ProcessOptions options;
  options.interrupt_at = "% unshot";
  const Ended stopped = solve(scene, with({"--threads", "1"}), options);
  EXPECT_TRUE(holds(stopped.code == 6)) << stopped.code << stopped.err;
  const Json part = report_of(folder, "out.incomplete.json");
  EXPECT_EQ(part["status"], "stopped");
  EXPECT_LT(part["runs"][0]["steps"], Json::parse(whole)["runs"][0]["steps"]);
  const Ended resumed = solve(scene, with({"--resume"}));
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_TRUE(holds(read_text(folder.path() / "out.json") == whole));
  EXPECT_EQ(folder.contents(), "fine.json out.exr out.json out.png");

  EXPECT_EQ(solve(scene, with({"--steps", "7"})).code, 0);
  EXPECT_EQ(report_of(folder, "out.json")["status"], "steps used up");
  EXPECT_EQ(solve(scene, with({"--resume"})).code, 0);
  EXPECT_TRUE(holds(read_text(folder.path() / "out.json") == whole));

  std::vector<std::string> less = method;
  less.back() = "0.05";
  EXPECT_EQ(solve(scene, less).code, 0);
  EXPECT_EQ(report_of(folder, "out.json")["status"], "solved");
  EXPECT_EQ(solve(scene, with({"--resume"})).code, 0);
  EXPECT_TRUE(holds(read_text(folder.path() / "out.json") == whole)) << "also from what was finished";

  const Ended finer = solve(scene, {"--method", "progressive", "--resolution", "100", "--resume"});
  EXPECT_TRUE(holds(finer.code == 3 && finer.err.find("found by other settings") != std::string::npos)) << finer.err;
  const auto changed = folder.add("fine.json", fine_furnace() + "\n");
  const Ended other = solve(changed, with({"--resume"}));
  EXPECT_TRUE(holds(other.code == 3 && other.err.find("a solution of another scene") != std::string::npos))
      << other.err;
}

// CLAIM      IU.6.6: a saved solution that does not hold together is not gone on with: what is unshot is held to what is
//            emitted, absorbed and escaped, radiosities to irradiances; what was saved is, of shooting, overshooting and per light.
// ORACLE     identity: one number changed at a time.
// TOLERANCE  none: exit codes and messages.
TEST(RefinedCommand, RefusesASolutionThatContradictsItself) {
  proves({"IU.6.6"}, Oracle::identity, "one number changed at a time");
  const TemporaryFolder folder;
  const auto scene = folder.add("furnace.json", furnace_text());
  for (const std::string how : {"", "--overshoot", "--per-light"}) {
    std::vector<std::string> begun{"--method", "progressive", "--resolution", "64", "--samples", "1"};
    if (!how.empty()) begun.push_back(how);
    std::vector<std::string> more = begun;
    begun.insert(begun.end(), {"--steps", "3"});
    more.insert(more.end(), {"--resume", "--steps", "5"});
    ASSERT_EQ(solve(scene, begun).code, 0);
    const Json saved = report_of(folder, "out.json");
    const auto refused = [&](const std::string& pointer, double factor, const std::string& why) {
      Json changed = saved;
      Json& number = changed[Json::json_pointer(pointer)];
      number = number.get<double>() * factor;
      folder.add("out.json", changed.dump());
      const Ended ended = solve(scene, more);
      EXPECT_TRUE(holds(ended.code == 3 && ended.err.find("contradicts itself: " + why) != std::string::npos))
          << pointer << ended.code << ended.err;
    };
    const bool apart = how == "--per-light";
    refused(apart ? "/patches/4/unshot_by_light/0/1" : "/patches/4/unshot/1", 1 + 1e-9, "\"unshot\" of its patches");
    refused("/elements/7/radiosity/0", 1 + 1e-9, "\"radiosity\" of element 7 is not");
    refused(apart ? "/elements/7/irradiance_by_light/0/0" : "/elements/7/irradiance/0", 1.5,
            "\"radiosity\" of element 7");
    refused("/runs/0/emitted_watts/2", 1 + 1e-9, "\"emitted_watts\" is not what the scene emits");
    refused("/runs/0/absorbed_watts/2", 1 + 1e-9, "\"absorbed_watts\" is not");
    Json changed = saved;
    changed["runs"][0]["escaped_watts"][0] = changed["runs"][0]["escaped_watts"][0].get<double>() + 1e-6;
    folder.add("out.json", changed.dump());
    const Ended balance = solve(scene, more);
    EXPECT_TRUE(
        holds(balance.code == 3 && balance.err.find("absorbed, escaped and unshot together") != std::string::npos))
        << balance.err;
    folder.add("out.json", saved.dump());
    EXPECT_EQ(solve(scene, more).code, 0);
  }
}

// CLAIM      solve --per-light keeps each light's own solution, and --relight combines them as a fresh solve of the scene with those
//            emissions does; a light that does not exist, and a factor that is none, are refused with 2.
// ORACLE     metamorphic: a fresh solve.
// TOLERANCE  the bounds that both report.
TEST(RefinedCommand, RelightsWhatItSolvedPerLight) {
  proves({"IU.6-7"}, Oracle::metamorphic, "a fresh solve");
  const TemporaryFolder folder;
  const std::string other = "\"other\": {\"k_d\": [0.5, 0.5, 0.5], \"emission\": [2, 4, 6]},\n    \"glowing\": {";
  const auto scene = folder.add("lit.json", replaced(replaced(furnace_text(), "\"left\", \"material\": \"glowing\"",
                                                              "\"left\", \"material\": \"other\""),
                                                     "\"glowing\": {", other));
  const std::vector<std::string> exact{"--method", "progressive", "--factors-by", "exact", "--unshot", "1e-6"};
  std::vector<std::string> apart = exact;
  apart.push_back("--per-light");
  const Ended both = solve(scene, apart);
  ASSERT_EQ(both.code, 0) << both.err;
  const Ended relit = solve(scene, {"--relight", "other=2:0.5:0"});
  ASSERT_EQ(relit.code, 0) << relit.err;
  const Json combined = report_of(folder, "out-relit.json");
  EXPECT_EQ(combined["status"], "relit");
  EXPECT_EQ(combined["runs"].size(), 2u);
  folder.add("lit.json", replaced(read_text(scene), "[2, 4, 6]", "[4, 2, 0]"));
  ASSERT_EQ(solve(scene, exact).code, 0);
  const Json fresh = report_of(folder, "out.json");
  const char* const channels[] = {"red", "green", "blue"};
  for (std::size_t c = 0; c < 3; ++c) {
    const double slack = fresh["channels"][channels[c]]["bound"].get<double>() +
                         combined["channels"][channels[c]]["bound"].get<double>() + 1e-12;
    for (std::size_t q = 0; q < fresh["elements"].size(); ++q) {
      const double expected = fresh["elements"][q]["radiosity"][c].get<double>();
      EXPECT_TRUE(near(combined["elements"][q]["radiosity"][c].get<double>(), expected, slack));
    }
    EXPECT_TRUE(within(slack, 0.01));
  }
  EXPECT_EQ(solve(scene, {"--relight", "other=1"}).code, 3) << "the scene was changed";
  folder.add("lit.json", replaced(read_text(scene), "[4, 2, 0]", "[2, 4, 6]"));
  ASSERT_EQ(solve(scene, apart).code, 0);
  for (const std::string wrong : {"lamp=1", "other", "other=-1", "other=1:2", "other=x", "other=1,other=2"}) {
    const Ended refused = solve(scene, {"--relight", wrong});
    EXPECT_TRUE(holds(refused.code == 2)) << wrong << ": " << refused.code << refused.err;
  }
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--method", "hemicube", "--steps", "3"},
                                                {"--method", "progressive", "--resolution", "63"},
                                                {"--method", "progressive", "--solve-by", "elimination"},
                                                {"--method", "adaptive", "--per-light"}}) {
    EXPECT_TRUE(holds(solve(scene, wrong).code == 2)) << wrong[1];
  }
  const std::pair<std::vector<std::string>, std::string> strayed[] = {
      {{"--method", "progressive", "--solver", "lu"}, "option '--solver' belongs to --method full\n"},
      {{"--unshot", "0.1"}, "option '--unshot' belongs to --method progressive and adaptive\n"}};
  for (const auto& [options, words] : strayed) {
    const Ended refused = solve(scene, options);
    EXPECT_TRUE(holds(refused.code == 2 && refused.err.find(words) != std::string::npos)) << refused.err;
  }
}

// CLAIM      IU.6.5.1: --element-size and --align-mesh divide as asked, with every method; a run on pieces goes on to the same bytes,
//            and not with another mesh; a size of zero is misuse.
// ORACLE     closed form: elements by hand: 2.25 m and 1.5 m a patch in elements within 0.75 m make 6 × 6, 6 × 6, 4 times 6 × 4,
//            twice 6 × 4 and 1; identity for bytes.
// TOLERANCE  none.
TEST(RefinedCommand, DividesAsAsked) {
  proves({"IU.6.5.1"}, Oracle::closed_form, "elements by hand, equal bytes");
  const TemporaryFolder folder;
  const auto scene = folder.add("leak.json", read_text(source_root() / "scenes/leak/scene.json"));
  const std::vector<std::string> small{"--samples", "1", "--tolerance", "1e-3", "--method", "progressive"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), small.begin(), small.end());
    return solve(scene, more);
  };
  const Ended sized = with({"--element-size", "0.75", "--steps", "1"});
  ASSERT_EQ(sized.code, 0) << sized.err;
  Json mesh = report_of(folder, "out.json")["mesh"];
  EXPECT_TRUE(holds(mesh["elements"] == 36 + 36 + 4 * 24 + 2 * 24 + 1 && mesh["element_size"] == 0.75)) << mesh;
  EXPECT_TRUE(holds(!mesh.contains("aligned")));
  const Ended zero = with({"--element-size", "0"});
  EXPECT_EQ(zero.code, 2);
  EXPECT_TRUE(holds(zero.err.find("--element-size") != std::string::npos)) << zero.err;

  const Ended whole = with({"--align-mesh", "--factors-by", "exact", "--steps", "40"});
  ASSERT_EQ(whole.code, 0) << whole.err;
  const std::string bytes = read_text(folder.path() / "out.json");
  mesh = Json::parse(bytes)["mesh"];
  EXPECT_TRUE(holds(mesh["aligned"] == true && mesh["elements"] == 69)) << mesh;
  ASSERT_EQ(with({"--align-mesh", "--factors-by", "exact", "--steps", "15"}).code, 0);
  EXPECT_TRUE(holds(read_text(folder.path() / "out.json") != bytes));
  const Ended other = with({"--factors-by", "exact", "--steps", "40", "--resume"});
  EXPECT_EQ(other.code, 3);
  EXPECT_TRUE(holds(other.err.find("found by other settings") != std::string::npos)) << other.err;
  ASSERT_EQ(with({"--align-mesh", "--factors-by", "exact", "--steps", "40", "--resume"}).code, 0);
  EXPECT_TRUE(holds(read_text(folder.path() / "out.json") == bytes));
}

// CLAIM      IU.6-7: a scene in which nothing emits is solved: every radiosity is 0, and it is said, with every method; one that
//            emits is not told so.
// ORACLE     closed form: 0.
// TOLERANCE  none.
TEST(RefinedCommand, SaysWhenNothingEmits) {
  proves({"IU.6-7"}, Oracle::closed_form, "no emission, no radiosity");
  const TemporaryFolder folder;
  const auto dark = folder.add("dark.json", replaced(furnace_text(), R"("emission": [1.5, 2, 1])", R"("emission": 0)"));
  const auto bright = folder.add("bright.json", furnace_text());
  const std::string words = "nothing emits: every radiosity is 0";
  std::uint64_t wrong = 0, elements = 0;
  for (const char* method : {"full", "hemicube", "progressive", "adaptive"}) {
    const auto solved = [&](const std::filesystem::path& scene) {
      return run_etendue({"solve", scene.string(), "--method", method, "--samples", "1", "--output",
                          (folder.path() / "out.png").string()});
    };
    EXPECT_TRUE(holds(solved(bright).err.find(words) == std::string::npos)) << method;
    const Ended ended = solved(dark);
    EXPECT_TRUE(holds(ended.code == 0 && ended.err.find(words) != std::string::npos)) << method << ended.err;
    const auto solution = nlohmann::json::parse(read_text(folder.path() / "out.json"));
    for (const auto& element : solution["elements"]) {
      wrong += element["radiosity"] != nlohmann::json::array({0, 0, 0});
      ++elements;
    }
  }
  EXPECT_TRUE(all_agree(wrong, elements));
}

}  // namespace
}  // namespace etendue::validation
