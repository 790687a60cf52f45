// SPDX-License-Identifier: Apache-2.0
#include "options.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <ostream>
#include <sstream>

#include "etendue/core/result.hpp"
#include "etendue/io/nearest.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue::cli {

namespace {

/// More threads than any machine has; keeps a slip of the finger from starting millions.
constexpr int kMostThreads = 1024;

/// The number that all of `text` spells, if it does and the number is finite and in range.
template <class Number>
std::optional<Number> number(const std::string& text, Number low, Number high) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (!(value >= low && value <= high)) return std::nullopt;
  return value;
}

template <class Number>
std::string range(const char* kind, Number low, Number high) {
  std::ostringstream text;
  text << kind << " in [" << low << ", " << high << "]";
  return text.str();
}

std::string joined(const std::vector<std::string>& words, const char* separator) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

}  // namespace

Options::Options(std::string command, std::string summary)
    : command_(std::move(command)), summary_(std::move(summary)) {}

void Options::add(Option option) {
  options_.push_back(std::move(option));
}

void Options::argument(std::string name, std::string help, std::filesystem::path& target) {
  positional_.push_back({std::move(name), "", std::move(help), [&target](const std::string& text) {
                           target = text;
                           return text.empty() ? std::optional<std::string>("a file name") : std::nullopt;
                         }});
}

void Options::also(std::string usage) {
  also_ = std::move(usage);
}

void Options::flag(std::string name, std::string help, bool& target) {
  add({std::move(name), "", std::move(help), [&target](const std::string&) {
         target = true;
         return std::optional<std::string>();
       }});
}

void Options::text(std::string name, std::string value, std::string help, std::optional<std::string>& target) {
  add({std::move(name), std::move(value), std::move(help), [&target](const std::string& text) {
         target = text;
         return std::optional<std::string>();
       }});
}

void Options::path(std::string name, std::string value, std::string help, std::filesystem::path& target) {
  add({std::move(name), std::move(value), std::move(help), [&target](const std::string& text) {
         target = text;
         return text.empty() ? std::optional<std::string>("a file name") : std::nullopt;
       }});
}

void Options::paths(std::string name, std::string value, std::string help, std::vector<std::filesystem::path>& target) {
  Option option{std::move(name), std::move(value), std::move(help), [&target](const std::string& text) {
                  target.emplace_back(text);
                  return text.empty() ? std::optional<std::string>("a file name") : std::nullopt;
                }};
  option.repeatable = true;
  add(std::move(option));
}

void Options::integer(std::string name, std::string value, std::string help, int& target, int low, int high) {
  add({std::move(name), std::move(value), std::move(help),
       [&target, low, high](const std::string& text) -> std::optional<std::string> {
         const auto read = number(text, low, high);
         if (!read) return range("an integer", low, high);
         target = *read;
         return std::nullopt;
       }});
}

void Options::real(std::string name, std::string value, std::string help, double& target, double low, double high) {
  add({std::move(name), std::move(value), std::move(help),
       [&target, low, high](const std::string& text) -> std::optional<std::string> {
         const auto read = number(text, low, high);
         if (!read) return range("a number", low, high);
         target = *read;
         return std::nullopt;
       }});
}

void Options::choice(std::string name, std::vector<std::string> values, std::string help, std::string& target) {
  const std::string all = joined(values, "|");
  add({std::move(name), all, std::move(help),
       [&target, values = std::move(values)](const std::string& text) -> std::optional<std::string> {
         if (std::find(values.begin(), values.end(), text) == values.end()) {
           return "one of " + joined(values, ", ") + did_you_mean(text, values);
         }
         target = text;
         return std::nullopt;
       }});
}

void Options::two_texts(std::string name, std::string values, std::string help,
                        std::pair<std::string, std::string>& target) {
  Option option{std::move(name), std::move(values), std::move(help), [&target](const std::string& text) {
                  target.first = text;
                  return std::optional<std::string>();
                }};
  option.set_second = [&target](const std::string& text) { target.second = text; };
  add(std::move(option));
}

void Options::alias(std::string short_name, std::string name) {
  aliases_.emplace_back(std::move(short_name), std::move(name));
}

void Options::elsewhere(std::vector<std::string> names, std::string where) {
  elsewhere_.emplace_back(std::move(names), std::move(where));
}

void Options::example(std::string command_line) {
  examples_.push_back(std::move(command_line));
}

void Options::note(std::string text) {
  notes_.push_back(std::move(text));
}

const Options::Option* Options::find(const std::string& name) const {
  for (const auto& [short_name, full] : aliases_) {
    if (short_name == name) return find(full);
  }
  const auto found = std::find_if(options_.begin(), options_.end(), [&](const Option& o) { return o.name == name; });
  return found == options_.end() ? nullptr : &*found;
}

std::vector<std::string> Options::names() const {
  std::vector<std::string> all;
  for (const auto& option : options_) all.push_back(option.name);
  all.push_back("--help");
  return all;
}

std::optional<int> Options::parse(const std::vector<std::string>& arguments, std::ostream& out,
                                  std::ostream& err) const {
  const auto end = std::find(arguments.begin(), arguments.end(), "--");
  for (auto argument = arguments.begin(); argument != end; ++argument) {
    if (*argument != "--help" && *argument != "-h") continue;
    print_help(out);
    return 0;
  }
  if (const auto complaint = read(arguments)) return usage_error(err, *complaint);
  return std::nullopt;
}

std::optional<std::string> Options::read_option(const std::vector<std::string>& arguments, std::size_t& next,
                                                std::vector<std::string>& seen) const {
  const std::string& word = arguments[next++];
  const std::size_t equals = word.find('=');
  const std::string name = word.substr(0, equals);
  const Option* option = find(name);
  for (const auto& [others, where] : elsewhere_) {
    if (!option && std::find(others.begin(), others.end(), name) != others.end()) {
      return "option '" + name + "' belongs to " + where;
    }
  }
  if (!option) return "unknown option '" + name + "'" + did_you_mean(name, names());
  if (!option->repeatable && std::find(seen.begin(), seen.end(), option->name) != seen.end()) {
    return "option '" + option->name + "' is given twice";
  }
  seen.push_back(option->name);
  std::string value;
  if (option->value.empty()) {
    if (equals != std::string::npos) return "option '" + name + "' takes no value, found '" + word + "'";
  } else if (equals != std::string::npos) {
    value = word.substr(equals + 1);
  } else if (next == arguments.size() || arguments[next].rfind("--", 0) == 0) {
    return "option '" + name + "' needs a value: " + name + " " + option->value;
  } else {
    value = arguments[next++];
  }
  if (const auto expected = option->set(value)) {
    return "option '" + name + "': found '" + value + "', expected " + *expected;
  }
  if (option->set_second) {
    if (equals != std::string::npos || next == arguments.size() || arguments[next].rfind("--", 0) == 0) {
      return "option '" + name + "' needs two values: " + name + " " + option->value;
    }
    option->set_second(arguments[next++]);
  }
  return std::nullopt;
}

/// What is wrong with the arguments, if anything; else all targets are set.
std::optional<std::string> Options::read(const std::vector<std::string>& arguments) const {
  std::size_t positional = 0;
  std::vector<std::string> seen;
  bool options_end = false;
  for (std::size_t next = 0; next < arguments.size();) {
    const std::string& word = arguments[next];
    if (!options_end && word == "--") {
      options_end = true;
      ++next;
    } else if (!options_end && word.size() > 1 && word[0] == '-') {
      if (auto complaint = read_option(arguments, next, seen)) return complaint;
    } else if (positional == positional_.size()) {
      return "unexpected argument '" + word + "'";
    } else {
      const Option& target = positional_[positional++];
      if (const auto expected = target.set(word)) return target.name + ": found '" + word + "', expected " + *expected;
      ++next;
    }
  }
  if (positional < positional_.size()) {
    return "missing argument " + positional_[positional].name + " (" + positional_[positional].help + ")";
  }
  return std::nullopt;
}

int Options::usage_error(std::ostream& err, const std::string& message) const {
  err << "etendue " << command_ << ": " << printable(message) << "\nTry 'etendue " << command_ << " --help'.\n";
  return static_cast<int>(ErrorCode::usage);
}

void Options::print_help(std::ostream& out) const {
  out << summary_ << "\n\nUsage: etendue " << command_;
  if (!options_.empty()) out << " [OPTIONS]";
  for (const auto& argument : positional_) out << ' ' << argument.name;
  if (!also_.empty()) out << "\n       etendue " << command_ << ' ' << also_;
  out << "\n\n";

  const auto title = [this](const Option& o) {
    std::string name = o.name;
    for (const auto& [short_name, full] : aliases_) {
      if (full == o.name) name = short_name + ", " + name;
    }
    return o.value.empty() ? name : name + " " + o.value;
  };
  std::vector<Option> all = positional_;
  all.insert(all.end(), options_.begin(), options_.end());
  all.push_back({"--help", "", "print this and exit", nullptr});
  constexpr std::size_t kWidest = 24;  // longer titles have a line of their own
  std::size_t width = 0;
  for (const auto& option : all) {
    if (title(option).size() <= kWidest) width = std::max(width, title(option).size());
  }
  const std::string indent(width + 4, ' ');
  for (const auto& option : all) {
    const std::string name = title(option);
    out << "  " << name << (name.size() <= width ? std::string(width - name.size() + 2, ' ') : '\n' + indent);
    for (const char c : option.help) {
      out << c;
      if (c == '\n') out << indent;
    }
    out << '\n';
  }
  for (const auto& note : notes_) out << '\n' << note << '\n';
  if (!examples_.empty()) out << "\nExamples:\n";
  for (const auto& example : examples_) out << "  " << example << '\n';
}

void add_common(Options& options, CommonOptions& common, const std::string& output_help) {
  options.path("--output", "FILE", output_help, common.output);
  options.alias("-o", "--output");
  add_running(options, common);
}

void add_running(Options& options, CommonOptions& common) {
  options.integer("--threads", "N", "threads to compute on (default: all cores); results do not depend on it",
                  common.threads, 1, kMostThreads);
  options.flag("--json", "print the report as JSON", common.json);
  options.flag("--quiet", "no progress, no report; errors only", common.quiet);
}

}  // namespace etendue::cli
