// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/furnace_text.hpp"
#include "support/evidence.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

namespace etendue::validation {
namespace {

using Json = nlohmann::json;

Ended certify(const std::filesystem::path& scene, const TemporaryFolder& folder, std::vector<std::string> more = {}) {
  more.insert(more.begin(),
              {"solve", scene.string(), "--certify", "--quiet", "--output", (folder.path() / "out.png").string()});
  return run_etendue(more);
}

// CLAIM      IU.6-9, IU.6-3: of a closed furnace every interval of `etendue solve --certify` holds E/(1 − ρ), the program's own
//            radiosities too, and the widest interval is the one that the summary names.
// ORACLE     closed form: B = E/(1 − ρ) whatever the shape and the division.
// TOLERANCE  none for the inclusion. Row sums between 1 − w and 1 + w make intervals of ρ w E (1/(1 − ρ)²) to either side, w the
//            half widths asked, 2e-6 in all (kCertifiedFree and as much again): B 2e-6 ρ/(1 − ρ), doubled for second order.
TEST(Certify, HoldsTheFurnaceInEveryInterval) {
  proves({"IU.6-9", "IU.6-3"}, Oracle::closed_form, "E/(1 − ρ), 48 elements, 3 channels");
  const TemporaryFolder folder;
  const Ended ended = certify(source_root() / "scenes" / "furnace" / "scene.json", folder, {"--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json json = Json::parse(read_text(folder.path() / "out.json"));
  const std::vector<double> truth{3, 8, 10}, reflectance{0.5, 0.75, 0.9};
  std::uint64_t outside = 0, decisions = 0;
  std::vector<double> widest(3, 0);
  for (const Json& element : json.at("elements")) {
    for (std::size_t c = 0; c < 3; ++c) {
      const double low = element.at("radiosity_interval")[c][0], high = element.at("radiosity_interval")[c][1];
      const double own = element.at("radiosity")[c];
      outside += !(low <= truth[c] && truth[c] <= high);
      outside += !(low <= own && own <= high);
      decisions += 2;
      widest[c] = std::max(widest[c], high - low);
      EXPECT_TRUE(within(high - low, 2 * 2 * 2e-6 * truth[c] * reflectance[c] / (1 - reflectance[c])));
    }
  }
  EXPECT_TRUE(all_agree(outside, decisions));
  const Json& channels = json.at("certified").at("channels");
  for (std::size_t c = 0; c < 3; ++c) {
    const double told = channels.at(c == 0 ? "red" : c == 1 ? "green" : "blue").at("widest_interval");
    EXPECT_TRUE(within(std::abs(told - widest[c]), 0x1p-48 * truth[c]));  // rounded up, once
  }
}

// CLAIM      IU.6-9, IU.6-4: past a screen in a furnace the intervals hold E/(1 − ρ) all the same: what the screen hides it
//            replaces by itself. One sheet and its reverse, both glowing. Pairs wider than asked end with 4 and are counted,
//            the intervals are written all the same.
// ORACLE     closed form: every point still receives what it sends out.
// TOLERANCE  none.
TEST(Certify, HoldsAFurnaceWithAScreen) {
  proves({"IU.6-9", "IU.6-4"}, Oracle::closed_form, "E/(1 − ρ) past a two-sided screen");
  const TemporaryFolder folder;
  std::string text = furnace_text();
  for (const char* elements :
       {", \"elements\": [4, 3]", ", \"elements\": [3, 4]", ", \"elements\": [5, 2]", ", \"elements\": [3, 3]"}) {
    text = replaced(text, elements, "");
  }
  text = replaced(text, "\"objects\": [", R"("objects": [
    {"type": "polygon", "name": "screen", "material": "glowing",
     "vertices": [[0.5, 1, 0.4], [1.4, 1.3, 0.4], [1.4, 1.3, 1.1], [0.5, 1, 1.1]]},
    {"type": "polygon", "name": "its back", "material": "glowing",
     "vertices": [[0.5, 1, 0.4], [0.5, 1, 1.1], [1.4, 1.3, 1.1], [1.4, 1.3, 0.4]]},)");
  folder.add("scene.json", text);
  const Ended loose = certify(folder.path() / "scene.json", folder, {"--certify-tolerance", "1"});
  EXPECT_EQ(loose.code, 0) << loose.err;
  const Ended ended = certify(folder.path() / "scene.json", folder, {"--certify-tolerance", "0.005"});
  EXPECT_EQ(ended.code, 4) << ended.err;
  const Json json = Json::parse(read_text(folder.path() / "out.json"));
  const Json& certified = json.at("certified");
  EXPECT_TRUE(holds(certified.at("status") == "enclosed" && json.at("status") == "tolerance missed"));
  EXPECT_TRUE(holds(certified.at("asked").at("obstructed") == 0.005));
  const std::string wide = std::to_string(certified.at("pairs").at("wider_than_asked").get<int>());
  EXPECT_TRUE(holds(wide != "0" &&
                    ended.err.find("of " + wide + " pairs of elements are wider than asked") != std::string::npos))
      << ended.err;
  EXPECT_TRUE(holds(json.at("certified").at("pairs").at("obstructed") > 0));
  const std::vector<double> truth{3, 8, 10};
  std::uint64_t outside = 0, decisions = 0;
  for (const Json& element : json.at("elements")) {
    for (std::size_t c = 0; c < 3; ++c) {
      outside +=
          !(element.at("radiosity_interval")[c][0] <= truth[c] && truth[c] <= element.at("radiosity_interval")[c][1]);
      ++decisions;
    }
  }
  EXPECT_TRUE(all_agree(outside, decisions));
}

// CLAIM      IU.6-9: form factors known too loosely end with 4 and say which row and why; all else is written.
// ORACLE     identity: ρ = 1 − 1e-9 in a closed box with enclosures of half width 1e-6.
// TOLERANCE  none.
TEST(Certify, SaysWhenTheFormFactorsAreTooLoose) {
  proves({"IU.6-9"}, Oracle::identity, "ρ Σ upper above 1");
  const TemporaryFolder folder;
  folder.add("scene.json", replaced(furnace_text(), "[0.5, 0.75, 0.9]", "[0.5, 0.75, 0.999999999]"));
  const Ended ended = certify(folder.path() / "scene.json", folder);
  EXPECT_EQ(ended.code, 4);
  EXPECT_TRUE(holds(ended.err.find("not certified: blue channel") != std::string::npos)) << ended.err;
  EXPECT_TRUE(holds(ended.err.find("known too loosely") != std::string::npos)) << ended.err;
  const Json json = Json::parse(read_text(folder.path() / "out.json"));
  EXPECT_TRUE(holds(json.at("certified").at("status") == "not enclosed"));
  EXPECT_TRUE(
      holds(json.at("elements")[0].contains("radiosity") && !json.at("elements")[0].contains("radiosity_interval")));
}

// CLAIM      IU.6-4: --pair with certified enclosures prints the two numbers and how they were found; the screen's pair holds
//            the value of exact integration.
// ORACLE     another method of the same program.
// TOLERANCE  the exact method's bound.
TEST(Certify, ShowsThePairAndHowItWasFound) {
  proves({"IU.6-4"}, Oracle::program, "--method exact");
  const TemporaryFolder folder;
  std::string text = replaced(furnace_text(), "\"objects\": [", R"("objects": [
    {"type": "polygon", "name": "screen", "material": "glowing",
     "vertices": [[0.5, 1, 0.4], [1.4, 1.3, 0.4], [1.4, 1.3, 1.1], [0.5, 1, 1.1]]},)");
  for (const char* elements :
       {", \"elements\": [4, 3]", ", \"elements\": [3, 4]", ", \"elements\": [5, 2]", ", \"elements\": [3, 3]"}) {
    text = replaced(text, elements, "");
  }
  folder.add("scene.json", text);
  const auto pair = [&](const char* method, const char* first, const char* second) {
    return run_etendue({"form-factors", (folder.path() / "scene.json").string(), "--method", method, "--relative",
                        "0.05", "--absolute", "1e-6", "--pair", first, second, "--json"});
  };
  const Ended certified = pair("certified", "near", "far"), exact = pair("exact", "near", "far");
  ASSERT_EQ(certified.code, 0) << certified.err;
  const Json two = Json::parse(certified.out), one = Json::parse(exact.out);
  const double low = two.at("enclosure")[0], high = two.at("enclosure")[1], value = one.at("factor"),
               bound = one.at("bound");
  EXPECT_TRUE(holds(low <= value + bound && value - bound <= high)) << low << " " << value << " " << high;
  EXPECT_TRUE(holds(low > 0 && high < 1 && low < high));
  EXPECT_TRUE(holds(two.at("found_by")[0] == "shadow hulls" || two.at("found_by")[0] == "event lines"))
      << certified.out;
  EXPECT_TRUE(holds(two.at("blockers") == std::vector<std::string>{"screen"}));
  const Json clear = Json::parse(pair("certified", "floor", "left").out);
  EXPECT_TRUE(holds(clear.at("enclosure")[0] < clear.at("enclosure")[1]));
  EXPECT_TRUE(holds(!one.contains("enclosure")));
  const Ended said = run_etendue({"form-factors", (folder.path() / "scene.json").string(), "--method", "certified",
                                  "--relative", "0.05", "--absolute", "1e-6", "--pair", "near", "far"});
  EXPECT_TRUE(holds(said.out.find("enclosure    [") != std::string::npos)) << said.out;
}

}  // namespace
}  // namespace etendue::validation
