// SPDX-License-Identifier: Apache-2.0
#include "etendue/io/scene_node.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>

#include "etendue/io/nearest.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

std::string quoted(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + ("\"" + words[i] + "\"");
  }
  return text;
}

/// The numbers that all these are, if they are three; what is no such number is reported.
std::optional<Vec3> three(const std::vector<SceneNode>& parts, const ValueRange& interval) {
  std::vector<double> numbers;
  for (const SceneNode& part : parts) {
    if (const auto number = part.number(interval)) numbers.push_back(*number);
  }
  if (parts.size() != 3 || numbers.size() != 3) return std::nullopt;
  return Vec3(numbers[0], numbers[1], numbers[2]);
}

/// "scene.json:29:5: /objects/1"
std::string located(const std::string& name, const Place& place, const std::string& pointer) {
  constexpr std::size_t kLongestPointer = 200;
  const std::string text = printable(name) + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
  return pointer.empty() ? text : text + ": " + printable(pointer, kLongestPointer);
}

}  // namespace

void SceneErrors::add(std::size_t file, const std::string& name, const JsonProblem& problem, ErrorCode code) {
  entries_.push_back(
      {file, problem.place, located(name, problem.place, problem.pointer) + ": " + printable(problem.message), code});
}

ErrorCode SceneErrors::code() const {
  const bool files_only = std::all_of(entries_.begin(), entries_.end(),
                                      [](const Entry& entry) { return entry.code == ErrorCode::input_output; });
  return files_only && !entries_.empty() ? ErrorCode::input_output : ErrorCode::invalid_input;
}

void SceneErrors::warn(std::size_t file, const std::string& name, const JsonProblem& problem) {
  warnings_.push_back(
      {file, problem.place, located(name, problem.place, problem.pointer) + ": " + printable(problem.message)});
}

std::vector<std::string> SceneErrors::in_order(std::vector<Entry> entries) {
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.file, a.place.line, a.place.column) < std::tie(b.file, b.place.line, b.place.column);
  });
  std::vector<std::string> lines;
  for (const Entry& entry : entries) lines.push_back(entry.line);
  return lines;
}

std::string SceneErrors::text() const {
  std::string text;
  for (const std::string& line : in_order(entries_)) text += line + "\n";
  return text + counted_errors(entries_.size());
}

std::vector<std::string> SceneErrors::warnings() const {
  return in_order(warnings_);
}

bool ValueRange::contains(double value) const {
  return (open_low ? value > low : value >= low) && (open_high ? value < high : value <= high);
}

std::string ValueRange::text() const {
  return (open_low ? "(" : "[") + rounded(low, 6) + ", " + rounded(high, 6) + (open_high ? ")" : "]");
}

SceneNode SceneNode::at(const JsonValue& json, std::string pointer) const {
  SceneNode node(json, file_, *name_, *errors_);
  node.pointer_ = std::move(pointer);
  node.object_ = object_;
  return node;
}

std::string SceneNode::of_object() const {
  constexpr std::size_t kLongestName = 80;
  return object_.empty() ? "" : " (object '" + printable(object_, kLongestName) + "')";
}

std::string SceneNode::where() const {
  return located(*name_, json_->place, pointer_);
}

void SceneNode::complain(const std::string& message) const {
  errors_->add(file_, *name_, {json_->place, pointer_, message + of_object()});
}

void SceneNode::warn(const std::string& message) const {
  errors_->warn(file_, *name_, {json_->place, pointer_, message + of_object()});
}

void SceneNode::expected(const std::string& what) const {
  complain("found " + describe(*json_) + ", expected " + what);
}

void SceneNode::cannot_be_read(const std::string& message) const {
  errors_->add(file_, *name_, {json_->place, pointer_, message + of_object()}, ErrorCode::input_output);
}

bool SceneNode::is_object() const {
  if (json_->kind == JsonValue::Kind::object) return true;
  expected("an object");
  return false;
}

bool SceneNode::is(const KeySet& keys) const {
  if (!is_object()) return false;
  const std::vector<std::string> known = keys.all();
  std::vector<std::string> misspelt;  // a key that was meant is not reported again as missing
  for (const JsonMember& member : json_->members) {
    if (std::find(known.begin(), known.end(), member.key) != known.end()) continue;
    const auto guess = nearest(member.key, known);
    if (guess) misspelt.push_back(*guess);
    const std::string expected = guess ? "a known one; did you mean '" + *guess + "'?" : "one of " + quoted(known);
    errors_->add(
        file_, *name_,
        {member.place, pointer_to(pointer_, member.key), "found an unknown key, expected " + expected + of_object()});
  }
  for (const std::string& key : keys.mandatory) {
    if (json_->find(key) || std::find(misspelt.begin(), misspelt.end(), key) != misspelt.end()) continue;
    complain("found no key \"" + key + "\", expected one: it is mandatory here");
  }
  return true;
}

std::optional<SceneNode> SceneNode::member(const std::string& key) const {
  const JsonMember* found = json_->find(key);
  if (!found) return std::nullopt;
  return at(found->value, pointer_to(pointer_, key));
}

std::vector<std::pair<std::string, SceneNode>> SceneNode::members() const {
  std::vector<std::pair<std::string, SceneNode>> all;
  for (const JsonMember& member : json_->members) {
    all.emplace_back(member.key, at(member.value, pointer_to(pointer_, member.key)));
  }
  return all;
}

std::vector<SceneNode> SceneNode::items(std::size_t fewest, std::size_t most, const std::string& what) const {
  const std::size_t count = json_->items.size();
  if (json_->kind != JsonValue::Kind::array || count < fewest || count > most) {
    const std::string number = fewest == most ? std::to_string(fewest) : std::to_string(fewest) + " or more";
    expected("an array of " + number + " " + what);
  }
  return children();
}

std::vector<SceneNode> SceneNode::children() const {
  std::vector<SceneNode> nodes;
  nodes.reserve(json_->items.size());
  for (std::size_t i = 0; i < json_->items.size(); ++i) {
    nodes.push_back(at(json_->items[i], pointer_to(pointer_, i)));
  }
  return nodes;
}

std::optional<double> SceneNode::number(const ValueRange& interval) const {
  const bool is_number = json_->kind == JsonValue::Kind::number;
  if (is_number && interval.contains(json_->number)) return json_->number;
  expected("a number in " + interval.text() +
           (is_number && std::isnan(json_->number) ? " that a double can hold" : ""));
  return std::nullopt;
}

std::optional<long> SceneNode::integer(long low, long high) const {
  const double value = json_->number;
  if (json_->kind == JsonValue::Kind::number && std::floor(value) == value && value >= static_cast<double>(low) &&
      value <= static_cast<double>(high)) {
    return static_cast<long>(value);
  }
  expected(low == high ? std::to_string(low)
                       : "an integer in [" + std::to_string(low) + ", " + std::to_string(high) + "]");
  return std::nullopt;
}

std::optional<std::string> SceneNode::text() const {
  if (json_->kind == JsonValue::Kind::string) return json_->text;
  expected("a text in quotes");
  return std::nullopt;
}

std::optional<bool> SceneNode::truth() const {
  if (json_->kind == JsonValue::Kind::boolean) return json_->boolean;
  expected("true or false");
  return std::nullopt;
}

std::optional<std::string> SceneNode::choice(const std::vector<std::string>& words) const {
  const bool is_text = json_->kind == JsonValue::Kind::string;
  if (is_text && std::find(words.begin(), words.end(), json_->text) != words.end()) return json_->text;
  expected((words.size() == 1 ? "" : "one of ") + quoted(words) + (is_text ? did_you_mean(json_->text, words) : ""));
  return std::nullopt;
}

std::optional<std::string> SceneNode::kind(const std::vector<std::string>& kinds) const {
  if (json_->kind != JsonValue::Kind::object) return std::nullopt;
  const auto type = member("type");
  if (!type) return std::nullopt;
  if (auto word = type->choice(kinds)) return word;
  return type->json().kind == JsonValue::Kind::string ? nearest(type->json().text, kinds) : std::nullopt;
}

std::optional<Vec3> SceneNode::vector(const ValueRange& interval) const {
  return three(items(3, 3, "numbers"), interval);
}

std::optional<Vec3> SceneNode::direction() const {
  const auto value = vector();
  if (!value) return std::nullopt;
  if (value->isZero(0)) {
    complain("found [0, 0, 0], expected a direction");
    return std::nullopt;
  }
  return value->stableNormalized();
}

std::optional<Rgb> SceneNode::colour(const ValueRange& interval) const {
  if (json_->kind == JsonValue::Kind::number) {
    const auto value = number(interval);
    return value ? std::optional<Rgb>(Rgb::Constant(*value)) : std::nullopt;
  }
  if (json_->kind != JsonValue::Kind::array || json_->items.size() != 3) {
    expected("a number in " + interval.text() + ", or an array of 3 of them (red, green, blue)");
  }
  const auto value = three(children(), interval);
  return value ? std::optional<Rgb>(value->array()) : std::nullopt;
}

}  // namespace etendue
