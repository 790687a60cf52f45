// SPDX-License-Identifier: Apache-2.0
#include "cli/catalogue_command.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/example_scene.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

struct Said {
  int code;
  std::string out, err;
};

Said say(const std::vector<std::string>& words) {
  std::ostringstream out, err;
  const int code = cli::catalogue(words, out, err);
  return {code, out.str(), err.str()};
}

bool has(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

// CLAIM      IU.6-3: `etendue catalogue C-41 …` prints factor, bound and the factor back.
// ORACLE     closed form: discs of radii 1 and 2 at the distance 2: x = 9, S = √65, F12 = 8/(9 + √65), F21 = F12/4.
// TOLERANCE  the printed bound, itself 2u of the factor at most.
TEST(CatalogueCommand, PrintsTheFactorThereAndBack) {
  proves({"IU.6-3", "IU.6-5"}, Oracle::closed_form, "8/(9 + √65), by hand");
  const Said text = say({"C-41", "--r1", "1", "--r2", "2", "--h", "2"});
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_TRUE(holds(text.out.rfind("F12 = 0.46887", 0) == 0 && has(text.out, "\nF21 = 0.11721"))) << text.out;
  const Said json = say({"C-41", "--r1", "1", "--r2=2", "--h", "2", "--json"});
  ASSERT_EQ(json.code, 0);
  const auto report = nlohmann::json::parse(json.out);
  const double right = 8 / (9 + std::sqrt(65.0)), bound = report["bound"].get<double>();
  EXPECT_TRUE(near(report["factor"].get<double>(), right, bound + 0x1p-52));
  EXPECT_TRUE(within(bound, 0x1p-51 * right));
  EXPECT_TRUE(near(report["reverse_factor"].get<double>(), right / 4, bound + 0x1p-52));
  EXPECT_EQ(report["parameters"]["r2"], 2);
  const Said element = say({"B-12", "--h", "1", "--r", "1", "--json"});
  EXPECT_TRUE(holds(nlohmann::json::parse(element.out)["reverse_factor"].is_null()));
}

// CLAIM      The list names every configuration with its parameters, the page all that is known of one.
// ORACLE     exact: the words of the output.
// TOLERANCE  none.
TEST(CatalogueCommand, PrintsListAndPage) {
  proves({}, Oracle::exact, "the words of list and page");
  const Said list = say({});
  EXPECT_EQ(list.code, 0);
  EXPECT_TRUE(
      holds(has(list.out, "C-11 ") && has(list.out, "Equal, parallel, directly opposed rectangles (a, b, c)\n")));
  const auto lines = std::count(list.out.begin(), list.out.end(), '\n');
  EXPECT_GE(lines, 60);
  EXPECT_EQ(nlohmann::json::parse(say({"--json"}).out).size(), static_cast<std::size_t>(lines));
  const Said page = say({"hinged-rectangles"});
  EXPECT_EQ(page.code, 0);
  for (const char* words :
       {"Rectangles at any angle, sharing an edge", "C-16 (number not confirmed)",
        "docs/catalogue/hinged-rectangles.svg", "--phi  angle between them: an angle in [1, 179] degrees", "Formula ",
        "Source ", "Care ", "measured"}) {
    EXPECT_TRUE(holds(has(page.out, words))) << words << "\n" << page.out;
  }
  EXPECT_EQ(nlohmann::json::parse(say({"C-11", "--json"}).out)["parameters"].size(), 3u);
}

// CLAIM      Wrong words end with 2 and the nearest right ones; parameters outside the domain with 3, naming parameter,
//            finding and rule; nothing reaches standard output.
// ORACLE     exact: codes and messages.
// TOLERANCE  none.
TEST(CatalogueCommand, RefusesWhatItCannotCompute) {
  proves({}, Oracle::exact, "codes and messages");
  struct Case {
    std::vector<std::string> words;
    int code;
    std::string message;
  };
  const std::vector<Case> cases{
      {{"C-111"}, 2, "unknown configuration 'C-111'; did you mean 'C-11'?"},
      {{"sphere-dics"}, 2, "did you mean 'sphere-disc'?"},
      {{"C-13"}, 2, "unknown configuration 'C-13'; Howell's number may be 'parallel-rectangles' here"},
      {{"sphere-sphere", "--r11", "1"}, 2, "unknown option '--r11'; did you mean '--r1'?"},
      {{"C-11", "--a", "1", "--b", "1"}, 2, "missing --c: all parameters for the value, none for the page"},
      {{"C-11", "--a", "x", "--b", "1", "--c", "1"}, 2, "option '--a': found 'x', expected a number"},
      {{"C-11", "--a", "nan", "--b", "1", "--c", "1"}, 2, "option '--a': found 'nan', expected a number"},
      {{"C-11", "--a", "1e999", "--b", "1", "--c", "1"}, 2, "option '--a': found '1e999'"},
      {{"C-11", "--a", "1", "--a", "1"}, 2, "option '--a' is given twice"},
      {{"--svg", "x.svg"}, 2, "option '--svg' needs an id"},
      {{"C-11", "--a", "0", "--b", "1", "--c", "1"}, 3, "C-11: a = 0 (side): expected a length in [1e-100, 1e+100]"},
      {{"C-11", "--a", "-1", "--b", "1", "--c", "1"}, 3, "C-11: a = -1 (side): expected a length"},
      {{"C-77", "--r1", "2", "--r2", "1", "--h", "1"},
       3,
       "C-77: r2 = 1 (radius of the outer cylinder): expected r2 >= 1.001 r1"},
      {{"C-5", "--alpha", "180"},
       3,
       "C-5: alpha = 180 (angle between them): expected an angle in [0.001, 179.999] degrees"},
      {{"C-11", "--svg", "/none/x.svg"}, 5, "cannot write '/none/x.svg'"},
  };
  std::uint64_t wrong = 0;
  for (const Case& c : cases) {
    const Said said = say(c.words);
    if (said.code == c.code && said.out.empty() && has(said.err, c.message)) continue;
    ++wrong;
    ADD_FAILURE() << "ended with " << said.code << ", expected " << c.code << " and '" << c.message << "'\n"
                  << said.err << said.out;
  }
  EXPECT_TRUE(all_agree(wrong, cases.size()));
}

// CLAIM      --svg writes the picture, with the value or alone.
// ORACLE     exact: the file.
// TOLERANCE  none.
TEST(CatalogueCommand, WritesThePicture) {
  proves({}, Oracle::exact, "the file's beginning and end");
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "a.svg").string();
  const Said alone = say({"C-11", "--svg", path});
  EXPECT_EQ(alone.code, 0) << alone.err;
  EXPECT_EQ(alone.out, "");
  const std::string svg = read_text(path);
  EXPECT_TRUE(holds(has(svg, "<title>C-11: Equal, parallel") && has(svg, "</svg>")));
  const Said both = say({"C-11", "--a", "1", "--b", "1", "--c", "1", "--svg", path});
  EXPECT_TRUE(holds(both.code == 0 && has(both.out, "F12 = 0.19982489569838"))) << both.out;
  // What is refused leaves nothing behind.
  const std::string other = (folder.path() / "b.svg").string();
  EXPECT_TRUE(holds(say({"C-11", "--a", "1", "--svg", other}).code == 2));
  EXPECT_TRUE(holds(say({"C-11", "--a", "1", "--b", "1", "--c", "-1", "--svg", other}).code == 3));
  EXPECT_TRUE(holds(say({"C-11", "--svg", (folder.path() / "b.png").string()}).code == 2));
  EXPECT_EQ(folder.contents(), "a.svg");
  EXPECT_TRUE(holds(!has(say({"C-11\x1b[2J"}).err, "\x1b")));
}

}  // namespace
}  // namespace etendue::validation
