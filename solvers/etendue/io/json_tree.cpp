// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/json_tree.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <unordered_set>

#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Value of a hexadecimal digit, or −1.
int hex_digit(char c) {
  if (is_digit(c)) return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// Recursive descent over one text. Every function that returns bool has reported the syntax error when it returns
/// false.
class JsonParser {
 public:
  explicit JsonParser(std::string_view text) : text_(text) {}

  JsonDocument parse() {
    if (text_.substr(0, 3) == "\xEF\xBB\xBF") text_.remove_prefix(3);
    if (const auto bad = first_invalid_utf8(text_)) {
      fail(*bad, "found a byte that is not UTF-8, expected JSON text in UTF-8");
      return std::move(document_);
    }
    skip_space();
    if (!value(document_.root, 0)) return std::move(document_);
    skip_space();
    if (at_ != text_.size()) {
      fail(at_, "found " + here() + ", expected the end of the file");
      return std::move(document_);
    }
    document_.complete = true;
    return std::move(document_);
  }

 private:
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  void skip_space() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n' || text_[at_] == '\r' || text_[at_] == '\t'))
      ++at_;
  }

  /// Line and column of an offset; amortised linear, since offsets are asked for in (nearly) rising order.
  Place place(std::size_t offset) {
    if (offset < placed_) {
      placed_ = 0;
      last_ = {};
    }
    for (; placed_ < offset; ++placed_) {
      if (text_[placed_] == '\n') {
        ++last_.line;
        last_.column = 0;
      }
      const bool continues = placed_ + 1 < text_.size() && is_utf8_continuation(text_[placed_ + 1]);
      if (!continues) ++last_.column;
    }
    return last_;
  }

  bool fail(std::size_t offset, std::string message) {
    document_.problems.push_back({place(offset), pointer_, std::move(message)});
    return false;
  }

  /// What stands at the current position, for a message.
  std::string here() const {
    if (at_ >= text_.size()) return "the end of the file";
    const auto byte = static_cast<unsigned char>(text_[at_]);
    if (byte < 0x20 || byte == 0x7f) return "control character " + std::to_string(byte);
    std::size_t end = at_ + 1;
    while (end < text_.size() && is_utf8_continuation(text_[end])) ++end;
    return "'" + std::string(text_.substr(at_, end - at_)) + "'";
  }

  bool value(JsonValue& into, int depth) {
    into.place = place(at_);
    if (depth > kDeepestJson) {
      return fail(at_, "found nesting deeper than " + std::to_string(kDeepestJson) + ", expected less");
    }
    switch (peek()) {
      case '{':
        return object(into, depth);
      case '[':
        return array(into, depth);
      case '"':
        into.kind = JsonValue::Kind::string;
        return string(into.text);
      case 't':
        return boolean(into, "true", true);
      case 'f':
        return boolean(into, "false", false);
      case 'n':
        return word("null");
      default:
        break;
    }
    if (peek() == '-' || is_digit(peek())) return number(into);
    return fail(at_, "found " + here() + ", expected a value");
  }

  bool word(std::string_view expected) {
    if (text_.substr(at_, expected.size()) != expected) return fail(at_, "found " + here() + ", expected a value");
    at_ += expected.size();
    return true;
  }

  bool boolean(JsonValue& into, std::string_view spelling, bool meaning) {
    into.kind = JsonValue::Kind::boolean;
    into.boolean = meaning;
    return word(spelling);
  }

  bool digits() {
    if (!is_digit(peek())) return fail(at_, "found " + here() + ", expected a digit");
    while (is_digit(peek())) ++at_;
    return true;
  }

  bool number(JsonValue& into) {
    const std::size_t begin = at_;
    if (peek() == '-') ++at_;
    if (peek() == '0') {
      ++at_;
      if (is_digit(peek())) return fail(at_, "found a digit after a leading 0, expected '.', 'e' or the number's end");
    } else if (!digits()) {
      return false;
    }
    if (peek() == '.') {
      ++at_;
      if (!digits()) return false;
    }
    if (peek() == 'e' || peek() == 'E') {
      ++at_;
      if (peek() == '+' || peek() == '-') ++at_;
      if (!digits()) return false;
    }
    into.kind = JsonValue::Kind::number;
    into.text = text_.substr(begin, at_ - begin);
    const auto [end, error] = std::from_chars(into.text.data(), into.text.data() + into.text.size(), into.number);
    if (error != std::errc()) into.number = std::numeric_limits<double>::quiet_NaN();
    return true;
  }

  bool string(std::string& into) {
    const std::size_t begin = at_++;
    while (at_ < text_.size() && text_[at_] != '"') {
      const char c = text_[at_];
      if (static_cast<unsigned char>(c) < 0x20)
        return fail(at_, "found " + here() + " in a string, expected an escape");
      if (c == '\\') {
        if (!escape(into)) return false;
      } else {
        into += c;
        ++at_;
      }
    }
    if (at_ >= text_.size()) return fail(begin, "found the end of the file in a string, expected '\"'");
    ++at_;
    return true;
  }

  bool escape(std::string& into) {
    const std::size_t begin = at_++;
    const char kind = peek();
    if (kind == 'u') {
      ++at_;
      return unicode_escape(begin, into);
    }
    constexpr std::string_view kNames = "\"\\/bfnrt";
    constexpr std::string_view kMeanings = "\"\\/\b\f\n\r\t";
    const std::size_t found = at_ < text_.size() ? kNames.find(kind) : std::string_view::npos;
    if (found == std::string_view::npos)
      return fail(begin, "found an unknown escape, expected one of \\\" \\\\ \\/ \\b \\f \\n \\r \\t \\u");
    into += kMeanings[found];
    ++at_;
    return true;
  }

  /// Four hexadecimal digits, or −1.
  std::int32_t code_unit() {
    std::int32_t unit = 0;
    for (int i = 0; i < 4; ++i) {
      const int digit = hex_digit(peek());
      if (digit < 0) return -1;
      unit = unit * 16 + digit;
      ++at_;
    }
    return unit;
  }

  bool unicode_escape(std::size_t begin, std::string& into) {
    const auto is_high = [](std::int32_t unit) { return unit >= 0xD800 && unit < 0xDC00; };
    const auto is_low = [](std::int32_t unit) { return unit >= 0xDC00 && unit < 0xE000; };
    std::int32_t code = code_unit();
    if (is_high(code) && text_.substr(at_, 2) == "\\u") {
      at_ += 2;
      const std::int32_t low = code_unit();
      code = is_low(low) ? 0x10000 + (code - 0xD800) * 0x400 + (low - 0xDC00) : -1;
    }
    if (code < 0 || is_high(code) || is_low(code)) {
      return fail(begin, "found a broken \\u escape, expected four hexadecimal digits that make a character");
    }
    append_utf8(into, static_cast<char32_t>(code));
    return true;
  }

  bool array(JsonValue& into, int depth) {
    into.kind = JsonValue::Kind::array;
    ++at_;
    skip_space();
    if (peek() == ']') {
      ++at_;
      return true;
    }
    const std::string outer = pointer_;
    for (;;) {
      pointer_ = pointer_to(outer, into.items.size());
      if (!value(into.items.emplace_back(), depth + 1)) return false;
      skip_space();
      const char separator = peek();
      if (separator != ',' && separator != ']') return fail(at_, "found " + here() + ", expected ',' or ']'");
      ++at_;
      if (separator == ']') break;
      skip_space();
    }
    pointer_ = outer;
    return true;
  }

  bool object(JsonValue& into, int depth) {
    into.kind = JsonValue::Kind::object;
    ++at_;
    skip_space();
    if (peek() == '}') {
      ++at_;
      return true;
    }
    const std::string outer = pointer_;
    std::unordered_set<std::string> seen;  // asked for membership only: its order is not used
    for (;;) {
      JsonMember member;
      member.place = place(at_);
      if (peek() != '"') return fail(at_, "found " + here() + ", expected a key in quotes");
      if (!string(member.key)) return false;
      pointer_ = pointer_to(outer, member.key);
      skip_space();
      if (peek() != ':') return fail(at_, "found " + here() + ", expected ':' after the key");
      ++at_;
      skip_space();
      if (!value(member.value, depth + 1)) return false;
      if (seen.insert(member.key).second) {
        into.members.push_back(std::move(member));
      } else {
        document_.problems.push_back({member.place, pointer_, "found the key a second time, expected each key once"});
      }
      skip_space();
      pointer_ = outer;
      const char separator = peek();
      if (separator != ',' && separator != '}') return fail(at_, "found " + here() + ", expected ',' or '}'");
      ++at_;
      if (separator == '}') return true;
      skip_space();
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::string pointer_;
  JsonDocument document_;
  std::size_t placed_ = 0;
  Place last_;
};

}  // namespace

const JsonMember* JsonValue::find(std::string_view key) const {
  const auto found = std::find_if(members.begin(), members.end(), [&](const JsonMember& m) { return m.key == key; });
  return found == members.end() ? nullptr : &*found;
}

JsonDocument parse_json(std::string_view text) {
  return JsonParser(text).parse();
}

std::string pointer_to(const std::string& pointer, std::string_view key) {
  std::string extended = pointer + "/";
  for (const char c : key) {
    if (c == '~') {
      extended += "~0";
    } else if (c == '/') {
      extended += "~1";
    } else {
      extended += c;
    }
  }
  return extended;
}

std::string pointer_to(const std::string& pointer, std::size_t index) {
  return pointer + "/" + std::to_string(index);
}

std::string describe(const JsonValue& value) {
  constexpr std::size_t kLongest = 40;
  const auto counted = [](std::size_t count, const char* one) {
    return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
  };
  switch (value.kind) {
    case JsonValue::Kind::null:
      return "null";
    case JsonValue::Kind::boolean:
      return value.boolean ? "true" : "false";
    case JsonValue::Kind::number:
      return printable(value.text, kLongest);
    case JsonValue::Kind::string:
      return "\"" + printable(value.text, kLongest) + "\"";
    case JsonValue::Kind::array:
      return "an array of " + counted(value.items.size(), "item");
    case JsonValue::Kind::object:
      return "an object of " + counted(value.members.size(), "key");
  }
  return "nothing";
}

}  // namespace etendue
