// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace etendue {

/// Where something begins in a text: counted from 1, columns in characters (not bytes).
struct Place {
  int line = 1;
  int column = 1;
};

struct JsonMember;

/// A JSON value that knows where it stands.
struct JsonValue {
  enum class Kind { null, boolean, number, string, array, object };

  Kind kind = Kind::null;
  Place place;
  bool boolean = false;
  double number = 0;  ///< nearest double; NaN when the text names a number that double cannot hold (1e999, 1e-999)
  std::string text;   ///< of a string: its characters, unescaped; of a number: as spelt in the file
  std::vector<JsonValue> items;
  std::vector<JsonMember> members;  ///< in the file's order; a repeated key stands once, its first occurrence

  const JsonMember* find(std::string_view key) const;
};

struct JsonMember {
  std::string key;
  Place place;  ///< of the key
  JsonValue value;
};

/// What is wrong, where.
struct JsonProblem {
  Place place;
  std::string pointer;  ///< of the value that the problem is in (RFC 6901)
  std::string message;
};

/// `complete` is false when a syntax error ended the reading: it is the last problem, and `root` must not be used.
/// Repeated keys are problems too, but do not end the reading.
struct JsonDocument {
  bool complete = false;
  JsonValue root;
  std::vector<JsonProblem> problems;
};

/// Deeper nesting than this is a syntax error: nothing sensible has it, and the stack is finite.
inline constexpr int kDeepestJson = 64;

/// Reads RFC 8259 JSON strictly: UTF-8 (a byte order mark is skipped), no comments, no trailing commas, no NaN.
[[nodiscard]] JsonDocument parse_json(std::string_view text);

/// `pointer` extended by a key or an index, escaped as RFC 6901 wants.
[[nodiscard]] std::string pointer_to(const std::string& pointer, std::string_view key);
[[nodiscard]] std::string pointer_to(const std::string& pointer, std::size_t index);

/// What to call the value in a message: itself when it is short, otherwise its kind and size.
[[nodiscard]] std::string describe(const JsonValue& value);

}  // namespace etendue
