// SPDX-License-Identifier: Apache-2.0
#include "grade/cases.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "etendue/io/atomic_file.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue::validation {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

Error wrong(const fs::path& path, const std::string& what) {
  return Error{ErrorCode::invalid_input, quoted_path(path) + ": " + what};
}

/// A number, or an array of them; empty where it is neither.
std::vector<double> numbers(const Json& value) {
  if (value.is_number()) return {value.get<double>()};
  std::vector<double> all;
  if (!value.is_array()) return all;
  for (const auto& entry : value) {
    if (!entry.is_number()) return {};
    all.push_back(entry.get<double>());
  }
  return all;
}

Result<Enclosure> enclosure(const Json& truth) {
  Enclosure result;
  result.none = truth.value("none", false);
  if (result.none) return result;
  if (!truth.contains("low") || !truth.contains("high")) return Error{ErrorCode::invalid_input, "no low and high"};
  result.array = truth["low"].is_array();
  result.low = numbers(truth["low"]);
  result.high = numbers(truth["high"]);
  const bool ordered = std::equal(result.low.begin(), result.low.end(), result.high.begin(), result.high.end(),
                                  [](double low, double high) { return low <= high; });
  if (result.low.empty() || !ordered || truth["high"].is_array() != result.array)
    return Error{ErrorCode::invalid_input, "low and high are not numbers in their order"};
  return result;
}

Result<GradeCase> parse_case(const fs::path& path, const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || json.value("format", Json()) != "etendue-case" || json.value("version", Json()) != 1)
    return wrong(path, R"(expected an object with "format": "etendue-case" and "version": 1)");
  for (const char* key : {"id", "subject", "title"}) {
    if (!json.value(key, Json()).is_string()) return wrong(path, std::string("expected a text as \"") + key + "\"");
  }
  for (const char* key : {"question", "truth", "tolerance"}) {
    if (!json.value(key, Json()).is_object()) return wrong(path, std::string("expected an object as \"") + key + "\"");
  }
  GradeCase result{json["id"], json["subject"], json["title"], {}, text, {}, 0};
  const Json tolerance = json["tolerance"].value("value", Json());
  if (!tolerance.is_number() || !(tolerance.get<double>() > 0))
    return wrong(path, "/tolerance/value: expected a number above 0");
  result.tolerance = tolerance.get<double>();
  const auto truth = enclosure(json["truth"]);
  if (!truth) return wrong(path, "/truth: " + truth.error().message);
  result.truth = *truth;
  Json question;
  for (const char* key : {"format", "version", "id", "subject", "title", "scene", "question"}) {
    if (json.contains(key)) question[key] = json[key];
  }
  question["tolerance"] = result.tolerance;
  result.question = question.dump(1) + "\n";
  return result;
}

bool is_case(const fs::path& path) {
  const std::string name = path.filename().string();
  constexpr std::string_view kSchema = ".schema.json";
  const bool schema = name.size() >= kSchema.size() && name.substr(name.size() - kSchema.size()) == kSchema;
  return path.extension() == ".json" && !schema;
}

}  // namespace

fs::path own_cases() {
  return fs::path(ETENDUE_SOURCE_ROOT) / "validation" / "cases";
}

Result<std::vector<GradeCase>> read_cases(const fs::path& folder) {
  std::vector<GradeCase> cases;
  std::error_code error;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (!is_case(it->path()) || !it->is_regular_file(error)) continue;
    const auto text = read_file(it->path());
    if (!text) return text.error();
    const auto one = parse_case(it->path(), *text);
    if (!one) return one.error();
    cases.push_back(*one);
  }
  if (error) {
    return Error{ErrorCode::input_output, "cannot read the cases in " + quoted_path(folder) + ": " + error.message()};
  }
  if (cases.empty()) return wrong(folder, "there is no case in this folder");
  std::sort(cases.begin(), cases.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  const auto twice =
      std::adjacent_find(cases.begin(), cases.end(), [](const auto& a, const auto& b) { return a.id == b.id; });
  if (twice != cases.end()) return wrong(folder, "two cases are called " + printable(twice->id));
  return cases;
}

}  // namespace etendue::validation
