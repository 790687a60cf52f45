// SPDX-License-Identifier: Apache-2.0
#include "etendue/text/utf8.hpp"

#include <array>
#include <nlohmann/json.hpp>
#include <string>

#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

bool well_formed_by_another(const std::string& text) {
  const nlohmann::json value(text);
  try {
    (void)value.dump();
    return true;
  } catch (const nlohmann::json::type_error&) {  // 316: invalid UTF-8
    return false;
  }
}

// CLAIM      first_invalid_utf8 accepts exactly well-formed UTF-8: no overlong forms, surrogates or values beyond
//            U+10FFFF.
// ORACLE     another program: nlohmann::json's strict writer, on all sequences of four of the bytes at which rules
//            change.
// TOLERANCE  none.
TEST(Utf8, AcceptsExactlyWhatIsWellFormed) {
  proves({}, Oracle::program, "nlohmann::json's strict writer");
  constexpr std::array<unsigned char, 18> kBytes{0x41, 0x7F, 0x80, 0x8F, 0x90, 0x9F, 0xA0, 0xBF, 0xC1,
                                                 0xC2, 0xDF, 0xE0, 0xED, 0xEF, 0xF0, 0xF4, 0xF5, 0xFF};
  std::uint64_t wrong = 0, decided = 0, accepted = 0;
  for (const auto a : kBytes) {
    for (const auto b : kBytes) {
      for (const auto c : kBytes) {
        for (const auto d : kBytes) {
          const std::string text{static_cast<char>(a), static_cast<char>(b), static_cast<char>(c),
                                 static_cast<char>(d)};
          const bool ours = !first_invalid_utf8(text);
          ++decided;
          if (ours) ++accepted;
          if (ours != well_formed_by_another(text)) ++wrong;
        }
      }
    }
  }
  EXPECT_TRUE(all_agree(wrong, decided));
  EXPECT_GT(accepted, 100u);
}

// CLAIM      printable leaves what can be seen and shows the rest as escapes: controls, line separators, marks that turn
//            the direction of writing, bytes that are not UTF-8. What is printable is not changed again.
// ORACLE     exact: pairs written by hand.
// TOLERANCE  none.
TEST(Utf8, ShowsWhatCannotBeSeen) {
  proves({}, Oracle::exact, "pairs written by hand");
  struct Pair {
    std::string text, shown;
  };
  const std::vector<Pair> all{
      {"", ""},
      {"plain, é, étendue, 光, \U0001F308", "plain, é, étendue, 光, \U0001F308"},
      {"a\\b", "a\\b"},
      {"a\nb\tc\rd", "a\\nb\\tc\\x0dd"},
      {"\x1b[31m\x7f", "\\x1b[31m\\x7f"},
      {std::string("\0", 1), "\\x00"},
      {"\xC2\x80\xC2\x9F\xC2\xA0", "\\u0080\\u009f\xC2\xA0"},
      {"\u200e\u2028\u202e\u202f", "\\u200e\\u2028\\u202e\u202f"},
      {"\u2065\u2066\u2069\ufeff", "\u2065\\u2066\\u2069\\ufeff"},
      {"\xff\xC2", "\\xff\\xc2"},
      {"\xE2\x80", "\\xe2\\x80"},
  };
  std::uint64_t wrong = 0;
  for (const Pair& pair : all) {
    EXPECT_EQ(printable(pair.text), pair.shown);
    wrong += printable(pair.text) != pair.shown || printable(pair.shown) != pair.shown;
  }
  EXPECT_EQ(printable("éé\n1", 3), "éé\\n…");
  EXPECT_EQ(printable("éé1", 3), "éé1");
  EXPECT_EQ(printable_lines("a\x1b\nb\n"), "a\\x1b\nb\n");
  EXPECT_EQ(quoted_path("a\nb"), "'a\\nb'");
  EXPECT_TRUE(all_agree(wrong + (::testing::Test::HasFailure() ? 1 : 0), all.size()));
}

}  // namespace
}  // namespace etendue::validation
