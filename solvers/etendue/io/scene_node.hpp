// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "etendue/core/result.hpp"
#include "etendue/io/json_tree.hpp"
#include "etendue/io/scene_keys.hpp"
#include "etendue/scene/scene.hpp"

namespace etendue {

/// No number of a scene file is larger: fourth powers of lengths, as in a quadratic's discriminant, stay finite.
inline constexpr double kLargestNumber = 1e50;

/// What is wrong with the files of one scene, in the order of the files, then of the places.
class SceneErrors {
 public:
  /// `file` counts in reading order; `name` is how messages call it.
  void add(std::size_t file, const std::string& name, const JsonProblem& problem,
           ErrorCode code = ErrorCode::invalid_input);
  std::size_t count() const { return entries_.size(); }
  /// invalid_input, unless nothing is wrong but files that cannot be read.
  ErrorCode code() const;
  /// One line each, and a last line with their number.
  std::string text() const;

  /// What is odd, and yet has a meaning: the scene can be used.
  void warn(std::size_t file, const std::string& name, const JsonProblem& problem);
  std::vector<std::string> warnings() const;

 private:
  struct Entry {
    std::size_t file;
    Place place;
    std::string line;
    ErrorCode code = ErrorCode::invalid_input;
  };
  static std::vector<std::string> in_order(std::vector<Entry> entries);

  std::vector<Entry> entries_, warnings_;
};

/// The numbers that a key allows; ends belong to it unless open.
struct ValueRange {
  double low;
  double high;
  bool open_low = false;
  bool open_high = false;

  bool contains(double value) const;
  std::string text() const;  ///< "[0, 1)"
};
inline constexpr ValueRange kFraction{0, 1};
inline constexpr ValueRange kNonNegative{0, kLargestNumber};
inline constexpr ValueRange kPositive{0, kLargestNumber, true};
inline constexpr ValueRange kAnyNumber{-kLargestNumber, kLargestNumber};

/// A value in a scene file, with its place. Each reading function either returns what it was asked for, or reports what
/// was found and what is expected, and returns nothing.
class SceneNode {
 public:
  SceneNode(const JsonValue& json, std::size_t file, const std::string& name, SceneErrors& errors)
      : json_(&json), file_(file), name_(&name), errors_(&errors) {}

  const JsonValue& json() const { return *json_; }
  const std::string& pointer() const { return pointer_; }
  /// Where the faults of its file are told.
  const SceneErrors& errors() const { return *errors_; }
  /// Messages from here and below name this object.
  void belongs_to(const std::string& object) { object_ = object; }

  /// File, line, column and pointer, as messages begin: "scene.json:29:5: /objects/1".
  [[nodiscard]] std::string where() const;

  /// Reports "found <this value>, expected …" here.
  void expected(const std::string& what) const;
  /// Reports that the file named here cannot be read, in the words of who tried: an error of input.
  void cannot_be_read(const std::string& message) const;
  /// Reports any other sentence here.
  void complain(const std::string& message) const;
  /// The same for what is no error.
  void warn(const std::string& message) const;

  /// Is this an object whose keys are all known and which lacks none? Reports each that is not so.
  /// The answer is true as long as it is an object: what can be read should be, to find further errors.
  [[nodiscard]] bool is(const KeySet& keys) const;
  [[nodiscard]] bool is_object() const;
  [[nodiscard]] std::optional<SceneNode> member(const std::string& key) const;
  /// Of an object: its values in order, with their keys.
  [[nodiscard]] std::vector<std::pair<std::string, SceneNode>> members() const;

  /// Items of an array that should have `fewest` to `most` of `what` ("vertices"). Of an array that has more or fewer,
  /// which is reported, all the same, to find what is wrong with them too; of anything else none.
  [[nodiscard]] std::vector<SceneNode> items(std::size_t fewest, std::size_t most, const std::string& what) const;
  [[nodiscard]] std::optional<double> number(const ValueRange& interval) const;
  [[nodiscard]] std::optional<long> integer(long low, long high) const;
  [[nodiscard]] std::optional<std::string> text() const;
  [[nodiscard]] std::optional<bool> truth() const;  ///< true or false
  /// One of these words; the nearest is suggested.
  [[nodiscard]] std::optional<std::string> choice(const std::vector<std::string>& words) const;
  /// What "type" says, of an object that should be one of these kinds: a misspelt one is reported and guessed, so that
  /// the other errors of the object can be found too. A missing one is left to is().
  [[nodiscard]] std::optional<std::string> kind(const std::vector<std::string>& kinds) const;
  [[nodiscard]] std::optional<Vec3> vector(const ValueRange& interval = kAnyNumber) const;
  [[nodiscard]] std::optional<Vec3> direction() const;  ///< unit vector of a vector other than zero
  [[nodiscard]] std::optional<Rgb> colour(const ValueRange& interval) const;  ///< one number, or three

 private:
  SceneNode at(const JsonValue& json, std::string pointer) const;
  std::vector<SceneNode> children() const;  ///< items of an array
  std::string of_object() const;            ///< " (object 'lid')", or nothing

  const JsonValue* json_;
  std::size_t file_;
  const std::string* name_;
  SceneErrors* errors_;
  std::string pointer_;
  std::string object_;  ///< the name of the object that this is a part of; empty outside of objects
};

}  // namespace etendue
