// SPDX-License-Identifier: Apache-2.0
#include "table.hpp"

#include <algorithm>
#include <exception>
#include <new>
#include <ostream>

#include "catalogue_command.hpp"
#include "etendue/core/contract.hpp"
#include "etendue/core/result.hpp"
#include "etendue/core/version.hpp"
#include "etendue/io/nearest.hpp"
#include "etendue/text/utf8.hpp"
#include "form_factors_command.hpp"
#include "ray_tree_command.hpp"
#include "render_command.hpp"
#include "solve_command.hpp"
#include "validate_command.hpp"
#include "view_command.hpp"

namespace etendue::cli {

namespace {

constexpr int exit_code(ErrorCode code) {
  return static_cast<int>(code);
}

void print_usage(std::ostream& out) {
  out << "etendue: verified light transport\n\nUsage: etendue COMMAND [OPTIONS] …\n\nCommands:\n";
  std::size_t width = 0;
  for (const auto& command : commands()) width = std::max(width, std::string(command.name).size() + 2);
  for (const auto& command : commands()) {
    const std::string name = command.name;
    out << "  " << name << std::string(width - name.size(), ' ') << command.summary << '\n';
  }
  out << "\n  --help     print this and exit; after a command: its options\n"
         "  --version  print the version and exit\n"
         "\n"
         "Exit codes: 0 done, 1 a check failed, 2 usage, 3 invalid input, 4 tolerance or convergence\n"
         "not reached, 5 input/output, 6 stopped with what was done saved.\n"
         "\n"
         "Examples:\n"
         "  etendue --version\n"
         "  etendue render scenes/minimal/scene.json --output minimal.png\n";
}

int unknown(const std::string& word, std::ostream& err) {
  std::vector<std::string> names{"--help", "--version"};
  for (const auto& command : commands()) names.emplace_back(command.name);
  const char* kind = word.rfind("-", 0) == 0 ? "option" : "command";
  err << "etendue: unknown " << kind << " '" << printable(word) << "'" << did_you_mean(word, names)
      << "\nTry 'etendue --help'.\n";
  return exit_code(ErrorCode::usage);
}

int unexpected(const std::string& word, const std::string& after, std::ostream& err) {
  err << "etendue: unexpected argument '" << printable(word) << "' after " << after << "\nTry 'etendue --help'.\n";
  return exit_code(ErrorCode::usage);
}

int dispatch(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  if (arguments.empty()) {
    print_usage(err);
    return exit_code(ErrorCode::usage);
  }
  const std::string& first = arguments.front();
  const bool about = first == "--version" || first == "--help" || first == "-h";
  if (about && arguments.size() > 1) return unexpected(arguments[1], first, err);
  if (first == "--version") {
    out << "etendue " << version() << '\n';
    return 0;
  }
  if (about) {
    print_usage(out);
    return 0;
  }
  for (const auto& command : commands()) {
    if (first == command.name) return command.run({arguments.begin() + 1, arguments.end()}, out, err);
  }
  return unknown(first, err);
}

}  // namespace

const std::vector<Command>& commands() {
  static const std::vector<Command> table{
      {"solve", "solve a scene by radiosity", solve},
      {"view", "show a saved solution from any side", view},
      {"form-factors", "find the form factors between a scene's surfaces", form_factors},
      {"render", "render a scene by ray tracing", render},
      {"ray-tree", "print or draw the tree of rays of one pixel", ray_tree},
      {"catalogue", "closed-form form factors: list, page, picture, value", catalogue},
      {"validate", "check every claim against its oracle", validate},
  };
  return table;
}

int run(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  int code = 0;
  try {
    code = dispatch(arguments, out, err);
  } catch (const std::bad_alloc&) {
    err << "etendue: out of memory\n";
    code = exit_code(ErrorCode::input_output);
  } catch (const ContractViolation& defect) {
    err << "etendue: internal check failed (a defect of this program): " << printable(defect.what()) << '\n';
    code = exit_code(ErrorCode::check_failed);
  } catch (const std::exception& defect) {
    err << "etendue: unexpected failure: " << printable(defect.what()) << '\n';
    code = exit_code(ErrorCode::check_failed);
  }
  out.flush();
  if (out) return code;
  err << "etendue: cannot write to standard output: not all data got through\n";
  return code == 0 ? exit_code(ErrorCode::input_output) : code;
}

}  // namespace etendue::cli
