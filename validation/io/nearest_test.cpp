// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/nearest.hpp"

#include <set>

#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

/// All words over {a, b} that one insertion, deletion, substitution or swap of neighbours makes.
std::set<std::string> neighbours(const std::string& word) {
  std::set<std::string> all;
  for (std::size_t i = 0; i <= word.size(); ++i) {
    for (const char letter : {'a', 'b'}) {
      all.insert(word.substr(0, i) + letter + word.substr(i));
      if (i < word.size()) all.insert(word.substr(0, i) + letter + word.substr(i + 1));
    }
    if (i < word.size()) all.insert(word.substr(0, i) + word.substr(i + 1));
    if (i + 1 < word.size()) all.insert(word.substr(0, i) + word[i + 1] + word[i] + word.substr(i + 2));
  }
  return all;
}

// CLAIM      edit_distance is 0 for equal words and 1 for exactly the words that one edit makes.
// ORACLE     exact: all words over two letters, up to six long, and all their single edits.
// TOLERANCE  none.
TEST(Nearest, CountsSingleEdits) {
  proves({}, Oracle::exact, "enumeration of all single edits");
  std::vector<std::string> words{""};
  for (std::size_t i = 0; words[i].size() < 6; ++i) {
    words.push_back(words[i] + 'a');
    words.push_back(words[i] + 'b');
  }
  std::uint64_t wrong = 0, decided = 0;
  for (const auto& from : words) {
    const auto near = neighbours(from);
    for (const auto& to : words) {
      const std::size_t distance = edit_distance(from, to);
      const bool expected_one = from != to && near.count(to) == 1;
      ++decided;
      if ((distance == 0) != (from == to) || (distance == 1) != expected_one) ++wrong;
    }
  }
  EXPECT_TRUE(all_agree(wrong, decided));
}

// CLAIM      The nearest candidate is suggested, whatever the case; a word unlike all gets no suggestion.
// ORACLE     exact: words chosen by hand.
// TOLERANCE  none.
TEST(Nearest, SuggestsOnlyWhatIsNear) {
  proves({}, Oracle::exact, "words chosen by hand");
  const std::vector<std::string> keys{"k_d", "radius", "centre", "horizontal_fov_deg"};
  EXPECT_EQ(nearest("raduis", keys), "radius");
  EXPECT_EQ(nearest("Radius", keys), "radius");
  EXPECT_EQ(nearest("kd", keys), "k_d");
  EXPECT_EQ(nearest("center", keys), "centre");
  EXPECT_EQ(nearest("horizontal_fov", keys), "horizontal_fov_deg");
  EXPECT_EQ(nearest("albedo", keys), std::nullopt);
  EXPECT_EQ(nearest("", keys), std::nullopt);
  EXPECT_EQ(nearest(std::string(1000000, 'x'), keys), std::nullopt);
  EXPECT_EQ(did_you_mean("albedo", keys), "");
  // The length may differ by a third of the candidate's, or by one.
  EXPECT_EQ(nearest("raddius__", {"radius"}), std::nullopt);
  EXPECT_EQ(nearest("raddius_", {"radius"}), "radius");
  EXPECT_EQ(nearest("ab", {"abc"}), "abc");
  // Thousands of names are not searched for each of thousands of errors.
  EXPECT_EQ(nearest("raduis", std::vector<std::string>(1000, "radius")), "radius");
  EXPECT_EQ(nearest("raduis", std::vector<std::string>(1001, "radius")), std::nullopt);
  EXPECT_TRUE(all_agree(::testing::Test::HasFailure() ? 1 : 0, 14));
}

}  // namespace
}  // namespace etendue::validation
