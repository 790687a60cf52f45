// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/json_tree.hpp"

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "io/example_scene.hpp"
#include "support/counter_random.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

using Json = nlohmann::json;

/// Same structure and the same values, bit by bit?
bool same(const JsonValue& ours, const Json& theirs) {
  switch (ours.kind) {
    case JsonValue::Kind::null:
      return theirs.is_null();
    case JsonValue::Kind::boolean:
      return theirs.is_boolean() && theirs.get<bool>() == ours.boolean;
    case JsonValue::Kind::number:
      return theirs.is_number() && theirs.get<double>() == ours.number;
    case JsonValue::Kind::string:
      return theirs.is_string() && theirs.get<std::string>() == ours.text;
    case JsonValue::Kind::array: {
      if (!theirs.is_array() || theirs.size() != ours.items.size()) return false;
      for (std::size_t i = 0; i < ours.items.size(); ++i) {
        if (!same(ours.items[i], theirs[i])) return false;
      }
      return true;
    }
    case JsonValue::Kind::object: {
      if (!theirs.is_object() || theirs.size() != ours.members.size()) return false;
      for (const JsonMember& member : ours.members) {
        const auto found = theirs.find(member.key);
        if (found == theirs.end() || !same(member.value, *found)) return false;
      }
      return true;
    }
  }
  return false;
}

bool holds_unrepresentable_number(const JsonValue& value) {
  if (value.kind == JsonValue::Kind::number) return std::isnan(value.number);
  for (const auto& item : value.items) {
    if (holds_unrepresentable_number(item)) return true;
  }
  for (const auto& member : value.members) {
    if (holds_unrepresentable_number(member.value)) return true;
  }
  return false;
}

/// A text with a byte deleted, replaced, doubled, or a stretch cut out.
std::string mutated(std::string text, CounterRandom& random) {
  constexpr std::string_view kBytes = "{}[]\",:0123456789.eE+-truefalsn\\u \n\t\xc3\xa9\x01";
  const int count = 1 + static_cast<int>(random.below(3));
  for (int i = 0; i < count && !text.empty(); ++i) {
    const std::size_t at = random.below(text.size());
    switch (random.below(4)) {
      case 0:
        text.erase(at, 1);
        break;
      case 1:
        text[at] = kBytes[random.below(kBytes.size())];
        break;
      case 2:
        text.insert(at, 1, kBytes[random.below(kBytes.size())]);
        break;
      default:
        text.erase(at, random.below(20));
        break;
    }
  }
  return text;
}

// CLAIM      The parser accepts exactly the JSON that RFC 8259 allows, and reads the values that stand there.
// ORACLE     another program: nlohmann::json, on 4000 mutations of a scene and of a text with every kind of token.
// TOLERANCE  none: same verdict, same structure, numbers equal bit by bit.
TEST(JsonTree, AgreesWithAnotherParserOnMutatedTexts) {
  proves({}, Oracle::program, "nlohmann::json");
  const std::string tokens =
      R"({"a": [null, true, false, -0, 0.5, 1e3, -1.25E-7, 123456789012345678], "é\u00e9\ud83d\ude00": "\"\\\/\b\f\n\r\t",)"
      R"( "": {}, "b": [[], [[1]], {"c": 2.2250738585072014e-308}], "d": 0.1, "e": 1.7976931348623157e308})";
  const std::string scene = example_scene();
  CounterRandom random(17);
  std::uint64_t wrong = 0, decided = 0, accepted = 0;
  for (int i = 0; i < 4000; ++i) {
    const std::string text = i == 0 ? tokens : mutated(i % 8 == 1 ? scene : tokens, random);
    const JsonDocument ours = parse_json(text);
    // A number beyond double's range is the reader's to judge with us, a syntax error with them.
    if (ours.complete && holds_unrepresentable_number(ours.root)) continue;
    const bool repeated = ours.complete && !ours.problems.empty();  // they keep the last of equal keys, we the first
    const Json theirs = Json::parse(text, nullptr, false);
    const bool agree =
        ours.complete == !theirs.is_discarded() && (!ours.complete || repeated || same(ours.root, theirs));
    ++decided;
    if (ours.complete) ++accepted;
    if (agree) continue;
    ++wrong;
    ADD_FAILURE() << text;
  }
  EXPECT_TRUE(all_agree(wrong, decided));
  EXPECT_GT(accepted, decided / 50);
  EXPECT_LT(accepted, decided / 2);
}

/// Writes random JSON and notes, while writing, where each value begins.
class Writer {
 public:
  explicit Writer(std::uint64_t seed) : random_(seed) {}

  void value(int depth, const std::string& pointer) {
    space();
    places[pointer] = {line_, column_};
    const std::uint64_t kind = random_.below(depth > 0 ? 5 : 3);
    if (kind == 0) put("-12.5e1");
    if (kind == 1) put("\"é𝄞 x\"");  // 2- and 4-byte characters are one column each
    if (kind == 2) put("true");
    if (kind == 3) {
      put("[");
      const std::uint64_t count = random_.below(4);
      for (std::uint64_t i = 0; i < count; ++i) {
        if (i > 0) put(",");
        value(depth - 1, pointer + "/" + std::to_string(i));
        space();
      }
      put("]");
    }
    if (kind == 4) {
      put("{");
      const std::uint64_t count = random_.below(4);
      for (std::uint64_t i = 0; i < count; ++i) {
        if (i > 0) put(",");
        space();
        put("\"k~/ß" + std::to_string(i) + "\"");
        space();
        put(":");
        value(depth - 1, pointer + "/k~0~1ß" + std::to_string(i));
        space();
      }
      put("}");
    }
  }

  std::string text;
  std::map<std::string, std::pair<int, int>> places;

 private:
  void space() {
    for (std::uint64_t i = random_.below(4); i > 0; --i) {
      const std::uint64_t kind = random_.below(4);
      put(kind == 0 ? "\n" : kind == 1 ? "\t" : kind == 2 ? "\r\n" : " ");
    }
  }
  void put(const std::string& piece) {
    text += piece;
    for (const char c : piece) {
      if (c == '\n') {
        ++line_;
        column_ = 1;
      } else if ((static_cast<unsigned char>(c) & 0xC0) != 0x80) {
        ++column_;
      }
    }
  }

  CounterRandom random_;
  int line_ = 1, column_ = 1;
};

void collect(const JsonValue& value, const std::string& pointer, std::map<std::string, std::pair<int, int>>& places) {
  places[pointer] = {value.place.line, value.place.column};
  for (std::size_t i = 0; i < value.items.size(); ++i) collect(value.items[i], pointer_to(pointer, i), places);
  for (const auto& member : value.members) collect(member.value, pointer_to(pointer, member.key), places);
}

// CLAIM      Every value knows its line, its column (in characters) and its JSON pointer.
// ORACLE     identity: a writer that notes the place of each value while it writes it.
// TOLERANCE  none.
TEST(JsonTree, KnowsThePlaceOfEveryValue) {
  proves({}, Oracle::identity, "places noted while the text was written");
  std::uint64_t wrong = 0, decided = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Writer writer(seed);
    writer.value(5, "");
    const JsonDocument document = parse_json(writer.text);
    ASSERT_TRUE(document.complete) << writer.text;
    std::map<std::string, std::pair<int, int>> places;
    collect(document.root, "", places);
    decided += writer.places.size();
    if (places != writer.places) ++wrong;
  }
  EXPECT_TRUE(all_agree(wrong, decided));
  EXPECT_GT(decided, 1000u);
}

// CLAIM      A byte order mark is skipped and does not count as a column.
// ORACLE     exact: a text with it and the same without.
// TOLERANCE  none.
TEST(JsonTree, SkipsAByteOrderMark) {
  proves({}, Oracle::exact, "the same text without it");
  const JsonDocument marked = parse_json("\xEF\xBB\xBF[7]");
  ASSERT_TRUE(marked.complete);
  EXPECT_EQ(marked.root.items[0].place.column, 2);
  EXPECT_EQ(marked.root.items[0].number, 7);
  EXPECT_TRUE(all_agree(0, 1));
}

}  // namespace
}  // namespace etendue::validation
