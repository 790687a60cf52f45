// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/utf8.hpp"

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

}  // namespace
}  // namespace etendue::validation
