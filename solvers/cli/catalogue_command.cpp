// SPDX-License-Identifier: Apache-2.0
#include "catalogue_command.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>

#include "etendue/form_factor/catalogue/catalogue.hpp"
#include "etendue/io/atomic_file.hpp"
#include "etendue/io/nearest.hpp"
#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"
#include "options.hpp"
#include "outputs.hpp"

namespace etendue::cli {

namespace {

namespace cat = etendue::catalogue;
using Json = nlohmann::ordered_json;

int fail(std::ostream& err, const Error& error) {
  return cli::fail(err, "catalogue", error);
}

std::string parameter_names(const cat::Entry& entry) {
  std::string names;
  for (const auto& parameter : entry.parameters) names += (names.empty() ? "" : ", ") + std::string(parameter.symbol);
  return names;
}

/// Howell's number, with the doubt where it was not seen beside its title.
std::string howell(const cat::Entry& entry) {
  const std::string number = entry.number;
  if (number.empty()) return "";
  return number == entry.id ? number : number + " (number not confirmed)";
}

const char* accuracy(const cat::Entry& entry) {
  return entry.accuracy == cat::Accuracy::proved
             ? "proved: every rounding is counted, in twice the digits of double"
             : "measured: the difference of two Gauss rules besides the count of roundings";
}

std::string picture_path(const cat::Entry& entry) {
  return "docs/catalogue/" + std::string(entry.id) + ".svg";
}

Json page_json(const cat::Entry& entry) {
  Json json{{"id", entry.id}, {"howell", howell(entry)}, {"title", entry.title}, {"picture", picture_path(entry)}};
  json["parameters"] = Json::array();
  for (const auto& p : entry.parameters) {
    json["parameters"].push_back(
        {{"symbol", p.symbol}, {"meaning", p.meaning}, {"unit", cat::unit(p.quantity)}, {"domain", cat::domain(p)}});
  }
  json["conditions"] = Json::array();
  for (const auto& condition : entry.conditions) json["conditions"].push_back(condition.rule);
  json["widest_ratio_of_lengths"] = entry.widest_ratio;
  json["formula"] = entry.formula;
  json["source"] = entry.source;
  json["care"] = entry.care;
  json["accuracy"] = accuracy(entry);
  return json;
}

void print_page(const cat::Entry& entry, std::ostream& out) {
  out << entry.id << "  " << entry.title << "\n\n";
  if (const std::string name = howell(entry); !name.empty()) out << "Howell     " << name << '\n';
  out << "Picture    " << picture_path(entry) << " (or --svg FILE)\n\nParameters\n";
  std::size_t width = 0;
  for (const auto& p : entry.parameters) width = std::max(width, std::string(p.symbol).size());
  for (const auto& p : entry.parameters) {
    const std::string symbol = p.symbol;
    out << "  --" << symbol << std::string(width - symbol.size() + 2, ' ') << p.meaning << ": " << cat::domain(p)
        << '\n';
  }
  out << "\nDomain     lengths within a ratio of " << rounded(entry.widest_ratio, 2) << '\n';
  for (const auto& condition : entry.conditions) out << "           " << condition.rule << '\n';
  out << "Formula    " << entry.formula << "\nSource     " << entry.source << "\nCare       " << entry.care
      << "\nAccuracy   " << accuracy(entry) << '\n';
}

void print_list(bool json, std::ostream& out) {
  if (json) {
    Json list = Json::array();
    for (const auto& entry : cat::entries()) list.push_back(page_json(entry));
    out << list.dump(1) << '\n';
    return;
  }
  std::size_t width = 0;
  for (const auto& entry : cat::entries()) width = std::max(width, std::string(entry.id).size());
  for (const auto& entry : cat::entries()) {
    const std::string id = entry.id;
    out << id << std::string(width - id.size() + 2, ' ') << entry.title << " (" << parameter_names(entry) << ")\n";
  }
}

/// The value with its bound; the factor back, where both areas are finite.
int print_factor(const cat::Entry& entry, const std::vector<double>& parameters, bool json, std::ostream& out,
                 std::ostream& err) {
  const auto factor = cat::form_factor(entry, parameters);
  if (!factor.ok()) return fail(err, factor.error());
  const auto reverse = cat::reverse_form_factor(entry, parameters);
  if (!reverse.ok()) return fail(err, reverse.error());
  if (json) {
    Json report{{"id", entry.id}, {"title", entry.title}, {"parameters", Json::object()}};
    for (std::size_t i = 0; i < parameters.size(); ++i)
      report["parameters"][entry.parameters[i].symbol] = parameters[i];
    report["factor"] = factor->value;
    report["bound"] = factor->bound;
    report["reverse_factor"] = *reverse ? Json((*reverse)->value) : Json(nullptr);
    report["reverse_bound"] = *reverse ? Json((*reverse)->bound) : Json(nullptr);
    report["accuracy"] = accuracy(entry);
    out << report.dump(1) << '\n';
    return 0;
  }
  out << "F12 = " << shortest(factor->value) << "  within " << rounded(factor->bound, 2) << '\n';
  if (*reverse) out << "F21 = " << shortest((*reverse)->value) << "  within " << rounded((*reverse)->bound, 2) << '\n';
  return 0;
}

struct Request {
  bool json = false;
  std::filesystem::path svg;
};

void declare(Options& options, Request& request) {
  options.flag("--json", "print as JSON", request.json);
  options.path("--svg", "FILE", "write the picture of a configuration", request.svg);
}

int list(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  Request request;
  Options options("catalogue", "Closed-form form factors: the list, the page of one configuration, its value.");
  options.also("ID [--PARAMETER X ...] [OPTIONS]");
  declare(options, request);
  options.note(
      "Give an ID for its page, and its parameters for its value: `etendue catalogue ID --help` names them.\nLengths "
      "are in any unit, the same for all; angles are in degrees.");
  options.example("etendue catalogue");
  options.example("etendue catalogue C-11");
  options.example("etendue catalogue C-11 --a 1 --b 1 --c 1");
  options.example("etendue catalogue element-sphere-cut --h -0.5 --l 2 --r 1 --json");
  options.example("etendue catalogue hinged-rectangles --svg hinged-rectangles.svg");
  if (const auto code = options.parse(arguments, out, err)) return *code;
  if (!request.svg.empty()) return options.usage_error(err, "option '--svg' needs an id: whose picture?");
  print_list(request.json, out);
  return 0;
}

/// "C-13" is asked for, but its number is not confirmed: the entry that it may be.
std::string by_number(const std::string& word) {
  for (const auto& entry : cat::entries()) {
    if (word == entry.number) return std::string("; Howell's number may be '") + entry.id + "' here";
  }
  std::vector<std::string> ids;
  for (const auto& entry : cat::entries()) ids.emplace_back(entry.id);
  return did_you_mean(word, ids);
}

int one(const cat::Entry& entry, const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  constexpr double kAny = std::numeric_limits<double>::max();
  Request request;
  Options options("catalogue " + std::string(entry.id), std::string(entry.title) + ".");
  std::vector<double> parameters(entry.parameters.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto& p = entry.parameters[i];
    options.real("--" + std::string(p.symbol), "X", std::string(p.meaning) + ": " + cat::domain(p), parameters[i],
                 -kAny, kAny);
  }
  declare(options, request);
  if (const auto code = options.parse(arguments, out, err)) return *code;
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i] != parameters[i]) missing.push_back("--" + std::string(entry.parameters[i].symbol));
  }
  if (!missing.empty() && missing.size() < parameters.size()) {
    std::string names;
    for (const auto& name : missing) names += (names.empty() ? "" : ", ") + name;
    return options.usage_error(err, "missing " + names + ": all parameters for the value, none for the page");
  }
  if (!request.svg.empty() && request.svg.extension() != ".svg") {
    return options.usage_error(err, "option '--svg': found " + quoted_path(request.svg) + ", expected a name in .svg");
  }
  if (!request.svg.empty()) {
    if (const auto free = check_outputs({request.svg}, {}); !free) return fail(err, free.error());
  }
  if (missing.empty()) {
    const int code = print_factor(entry, parameters, request.json, out, err);
    if (code != 0) return code;
  }
  if (!request.svg.empty()) {
    const auto written = write_file(request.svg, cat::svg(entry));
    if (!written.ok()) return fail(err, written.error());
  }
  if (missing.empty() || !request.svg.empty()) return 0;
  if (request.json) {
    out << page_json(entry).dump(1) << '\n';
  } else {
    print_page(entry, out);
  }
  return 0;
}

}  // namespace

int catalogue(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  if (arguments.empty() || arguments.front().rfind("-", 0) == 0) return list(arguments, out, err);
  const cat::Entry* entry = cat::find(arguments.front());
  if (entry) return one(*entry, {arguments.begin() + 1, arguments.end()}, out, err);
  err << "etendue catalogue: unknown configuration '" << printable(arguments.front()) << "'"
      << by_number(arguments.front()) << "\nTry 'etendue catalogue' for the list.\n";
  return static_cast<int>(ErrorCode::usage);
}

}  // namespace etendue::cli
