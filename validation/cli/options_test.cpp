// SPDX-License-Identifier: Apache-2.0
#include "cli/options.hpp"

#include <sstream>

#include "cli/progress.hpp"
#include "cli/table.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

/// One command with every kind of option, parsed.
struct Parsed {
  std::optional<int> code;
  std::string out, err;
  std::filesystem::path scene;
  std::string method = "lu";
  double tolerance = 0.5;
  cli::CommonOptions common;
};

Parsed parse(const std::vector<std::string>& arguments) {
  Parsed parsed;
  cli::Options options("probe", "Tries the options.");
  options.argument("SCENE", "scene file", parsed.scene);
  options.choice("--method", {"lu", "gauss"}, "how to solve", parsed.method);
  options.real("--tolerance", "X", "when to stop", parsed.tolerance, 0, 1);
  cli::add_common(options, parsed.common, "where to write");
  options.example("etendue probe x.json");
  std::ostringstream out, err;
  parsed.code = options.parse(arguments, out, err);
  parsed.out = out.str();
  parsed.err = err.str();
  return parsed;
}

// CLAIM      Options arrive where they were declared, in both spellings, in any order.
// ORACLE     exact: the words given.
// TOLERANCE  none.
TEST(Options, ArriveInBothSpellings) {
  proves({}, Oracle::exact, "the words given");
  const Parsed parsed =
      parse({"--threads", "3", "x.json", "--method=gauss", "--tolerance", "1e-3", "--json", "--output=a=b.png"});
  EXPECT_FALSE(parsed.code.has_value()) << parsed.err;
  EXPECT_EQ(parsed.scene, "x.json");
  EXPECT_EQ(parsed.method, "gauss");
  EXPECT_EQ(parsed.tolerance, 1e-3);
  EXPECT_EQ(parsed.common.threads, 3);
  EXPECT_TRUE(parsed.common.json);
  EXPECT_FALSE(parsed.common.quiet);
  EXPECT_EQ(parsed.common.output, "a=b.png");
  EXPECT_EQ(parse({"--", "--odd.json"}).scene, "--odd.json");
  EXPECT_EQ(parse({"-"}).scene, "-");
  EXPECT_TRUE(all_agree(::testing::Test::HasFailure() ? 1 : 0, 9));
}

// CLAIM      Each wrong use is refused with exit code 2 and a sentence that names it; the nearest option is suggested.
// ORACLE     exact: the messages, to the letter.
// TOLERANCE  none.
TEST(Options, RefuseEachWrongUse) {
  proves({}, Oracle::exact, "the messages, to the letter");
  struct Wrong {
    std::vector<std::string> arguments;
    std::string message;
  };
  const std::string threads = ", expected an integer in [1, 1024]";
  const std::vector<Wrong> all{
      {{}, "missing argument SCENE (scene file)"},
      {{"a", "b"}, "unexpected argument 'b'"},
      {{""}, "SCENE: found '', expected a file name"},
      {{"a", "--thread", "2"}, "unknown option '--thread'; did you mean '--threads'?"},
      {{"a", "--theads=2"}, "unknown option '--theads'; did you mean '--threads'?"},
      {{"a", "--frobnicate"}, "unknown option '--frobnicate'"},
      {{"a", "-t"}, "unknown option '-t'"},
      {{"a", "--threads", "0"}, "option '--threads': found '0'" + threads},
      {{"a", "--threads", "-1"}, "option '--threads': found '-1'" + threads},
      {{"a", "--threads", "two"}, "option '--threads': found 'two'" + threads},
      {{"a", "--threads", "2x"}, "option '--threads': found '2x'" + threads},
      {{"a", "--threads", " 2"}, "option '--threads': found ' 2'" + threads},
      {{"a", "--threads", "99999999999999999999"}, "option '--threads': found '99999999999999999999'" + threads},
      {{"a", "--threads="}, "option '--threads': found ''" + threads},
      {{"a", "--threads"}, "option '--threads' needs a value: --threads N"},
      {{"a", "--threads", "--json"}, "option '--threads' needs a value: --threads N"},
      {{"a", "--threads", "1", "--threads", "2"}, "option '--threads' is given twice"},
      {{"a", "--json=yes"}, "option '--json' takes no value, found '--json=yes'"},
      {{"a", "--tolerance", "nan"}, "option '--tolerance': found 'nan', expected a number in [0, 1]"},
      {{"a", "--tolerance", "2"}, "option '--tolerance': found '2', expected a number in [0, 1]"},
      {{"a", "--method", "gaus"}, "option '--method': found 'gaus', expected one of lu, gauss; did you mean 'gauss'?"},
      {{"a", "--output", ""}, "option '--output': found '', expected a file name"},
  };
  std::uint64_t wrong = 0;
  for (const Wrong& use : all) {
    const Parsed parsed = parse(use.arguments);
    const std::string expected = "etendue probe: " + use.message + "\nTry 'etendue probe --help'.\n";
    if (parsed.code != 2 || parsed.err != expected || !parsed.out.empty()) ++wrong;
    EXPECT_EQ(parsed.code, 2);
    EXPECT_EQ(parsed.err, expected);
  }
  EXPECT_TRUE(all_agree(wrong, all.size()));
}

// CLAIM      --help goes to standard output with exit code 0, whatever else is given, and ends with the sample runs.
// ORACLE     exact: the last lines.
// TOLERANCE  none.
TEST(Options, HelpEndsWithSampleRuns) {
  proves({}, Oracle::exact, "the last lines of the help");
  for (const auto& arguments : std::vector<std::vector<std::string>>{{"--help"}, {"-h"}, {"--wrong", "--help"}}) {
    const Parsed parsed = parse(arguments);
    EXPECT_EQ(parsed.code, 0);
    EXPECT_EQ(parsed.err, "");
    const std::string end = "\nExamples:\n  etendue probe x.json\n";
    ASSERT_GT(parsed.out.size(), end.size());
    EXPECT_EQ(parsed.out.substr(parsed.out.size() - end.size()), end);
    for (const char* name : {"--threads N", "--output FILE", "--method lu|gauss", "--quiet", "--json", "SCENE"}) {
      EXPECT_NE(parsed.out.find(name), std::string::npos) << name;
    }
  }
  EXPECT_TRUE(all_agree(::testing::Test::HasFailure() ? 1 : 0, 3));
}

// CLAIM      The progress bar writes nothing to what is not a terminal.
// ORACLE     exact: an empty stream.
// TOLERANCE  none.
TEST(Options, ProgressIsSilentAwayFromATerminal) {
  proves({}, Oracle::exact, "an empty stream");
  std::ostringstream err;
  {
    cli::Progress progress(err, "probe", {});
    for (std::size_t i = 0; i <= 10; ++i) progress.show(i, 10);
    EXPECT_FALSE(progress.visible());
    EXPECT_FALSE(static_cast<bool>(cli::execution({}, progress).progress));
  }
  EXPECT_EQ(err.str(), "");
  EXPECT_TRUE(all_agree(err.str().empty() ? 0 : 1, 1));
}

}  // namespace
}  // namespace etendue::validation
