// SPDX-License-Identifier: Apache-2.0
#include "grade/judge.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue::validation {

namespace {

using Json = nlohmann::json;

constexpr std::size_t kShown = 80;  ///< characters of what a program printed, in a message

std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

/// Why there is no answer to judge, if that is so.
std::string broken(const Ended& ended) {
  const std::string said = last_line(ended.err);
  const std::string because = said.empty() ? "" : ": " + printable(said, kShown);
  if (ended.too_long) return "no answer in time, killed after " + rounded(ended.seconds) + " s";
  if (ended.too_much) return "killed: it printed far more than an answer";
  if (ended.signal != 0) return "crashed by signal " + std::to_string(ended.signal) + because;
  if (ended.code != 0) return "ended with " + std::to_string(ended.code) + because;
  return {};
}

CaseVerdict failed(std::string reason) {
  CaseVerdict verdict;
  verdict.mark = Mark::failed;
  verdict.reason = std::move(reason);
  return verdict;
}

std::string kind_asked(const Enclosure& truth) {
  return truth.array ? "an array of " + std::to_string(truth.low.size()) + " numbers" : "a number";
}

std::string shown(const std::vector<double>& values, bool array) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + shortest(value);
  return array ? "[" + text + "]" : text;
}

CaseVerdict judge_numbers(const GradeCase& asked, const std::vector<double>& values) {
  CaseVerdict verdict;
  double worst = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double off = std::max({0.0, asked.truth.low[i] - values[i], values[i] - asked.truth.high[i]});
    worst = std::max(worst, off / asked.tolerance);
  }
  verdict.share = worst;
  verdict.mark = worst <= 1 ? Mark::passed : Mark::failed;
  if (verdict.mark == Mark::failed) {
    verdict.reason = "answered " + shown(values, asked.truth.array) + ", right is " +
                     shown(asked.truth.low, asked.truth.array) + ": off by " + rounded(worst) + " tolerances";
  }
  return verdict;
}

CaseVerdict judge_value(const GradeCase& asked, const Json& value) {
  const Enclosure& truth = asked.truth;
  if (value == "none") {
    CaseVerdict verdict;
    if (!truth.none) return failed("answered \"none\", right is " + shown(truth.low, truth.array));
    verdict.mark = Mark::passed;
    verdict.share = 0;
    return verdict;
  }
  if (value.is_null()) return failed("its value is null, as NaN becomes in many a JSON writer");
  std::vector<double> values;
  const bool array = value.is_array();
  for (const auto& entry : array ? value : Json::array({value})) {
    if (!entry.is_number()) return failed("its value is " + printable(value.dump(), kShown) + ", not numbers");
    values.push_back(entry.get<double>());
  }
  if (!std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }))
    return failed("its value is not finite");
  if (truth.none) return failed("answered " + shown(values, array) + ", right is \"none\"");
  if (array != truth.array || values.size() != truth.low.size())
    return failed("its value is " + printable(value.dump(), kShown) + "; asked is " + kind_asked(truth));
  return judge_numbers(asked, values);
}

CaseVerdict judge_answer(const GradeCase& asked, const std::string& printed) {
  if (printed.find_first_not_of(" \t\r\n") == std::string::npos) return failed("printed no answer");
  const Json answer = Json::parse(printed, nullptr, false);
  if (answer.is_discarded()) {
    const bool nan = printed.find("NaN") != std::string::npos || printed.find("nan") != std::string::npos ||
                     printed.find("Inf") != std::string::npos;
    return failed("printed '" + printable(printed, kShown) + "', which is not JSON" +
                  (nan ? ": it knows no NaN and no infinity" : ""));
  }
  const bool value = answer.is_object() && answer.contains("value");
  const bool unsupported = answer.is_object() && answer.contains("unsupported");
  if (value == unsupported)
    return failed("printed '" + printable(printed, kShown) +
                  R"(', expected an object with "value" or with "unsupported")");
  CaseVerdict verdict;
  if (value) {
    verdict = judge_value(asked, answer["value"]);
    verdict.answer = answer["value"].dump(-1, ' ', false, Json::error_handler_t::replace);
    return verdict;
  }
  if (!answer["unsupported"].is_string()) return failed("\"unsupported\" is not a text that says why");
  verdict.mark = Mark::unsupported;
  verdict.reason = printable(answer["unsupported"].get<std::string>(), 2 * kShown);
  return verdict;
}

}  // namespace

const char* name(Mark mark) {
  switch (mark) {
    case Mark::passed:
      return "passed";
    case Mark::failed:
      return "failed";
    case Mark::unsupported:
      return "unsupported";
    case Mark::not_run:
      return "not run";
  }
  return "unknown";
}

CaseVerdict judge(const GradeCase& asked, const Ended& ended) {
  const std::string why = broken(ended);
  CaseVerdict verdict = why.empty() ? judge_answer(asked, ended.out) : failed(why);
  verdict.seconds = ended.seconds;
  return verdict;
}

}  // namespace etendue::validation
