// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace etendue::cli {

/// The options and arguments of one command: declared, then parsed into the variables they were declared with.
///
///     Options options("render", "Render a scene by recursive ray tracing.");
///     options.argument("SCENE", "scene file (JSON)", scene);
///     options.integer("--depth", "N", "bounces to follow", depth, 0, 64);
///     options.example("etendue render scenes/minimal/scene.json --output minimal.png");
///     if (const auto code = options.parse(arguments, out, err)) return *code;
///
/// Understood: `--name value`, `--name=value`, flags, `--` before arguments that begin with a dash, `--help`, `-h`.
class Options {
 public:
  Options(std::string command, std::string summary);

  void argument(std::string name, std::string help, std::filesystem::path& target);
  /// A second way to use the command, whose first words it takes itself: "ID [OPTIONS]". Told by --help only.
  void also(std::string usage);
  void flag(std::string name, std::string help, bool& target);
  void text(std::string name, std::string value, std::string help, std::optional<std::string>& target);
  void path(std::string name, std::string value, std::string help, std::filesystem::path& target);
  /// May be given several times; each adds a path.
  void paths(std::string name, std::string value, std::string help, std::vector<std::filesystem::path>& target);
  void integer(std::string name, std::string value, std::string help, int& target, int low, int high);
  void real(std::string name, std::string value, std::string help, double& target, double low, double high);
  void choice(std::string name, std::vector<std::string> values, std::string help, std::string& target);
  /// Two words in turn: `--pair I J`.
  void two_texts(std::string name, std::string values, std::string help, std::pair<std::string, std::string>& target);
  /// A short name for an option: `-o`.
  void alias(std::string short_name, std::string name);
  /// Names that are unknown here but not elsewhere: the refusal says where, "--method full".
  void elsewhere(std::vector<std::string> names, std::string where);
  /// A command line that works from the root of the project; CI runs it.
  void example(std::string command_line);
  /// Further lines between the options and the examples.
  void note(std::string text);

  /// The exit code to return at once: 0 after --help, 2 after a usage error; nothing when the command may go on.
  [[nodiscard]] std::optional<int> parse(const std::vector<std::string>& arguments, std::ostream& out,
                                         std::ostream& err) const;

  /// For what only the command can see: prints "etendue command: message" and where to read on; returns 2.
  [[nodiscard]] int usage_error(std::ostream& err, const std::string& message) const;

 private:
  struct Option {
    std::string name;
    std::string value;  ///< what to call the value in --help; empty for a flag
    std::string help;
    std::function<std::optional<std::string>(const std::string&)> set;  ///< returns what is expected if it is not that
    std::function<void(const std::string&)> set_second = nullptr;       ///< for the second of two words
    bool repeatable = false;
  };

  void print_help(std::ostream& out) const;
  void add(Option option);
  const Option* find(const std::string& name) const;
  std::vector<std::string> names() const;
  std::optional<std::string> read(const std::vector<std::string>& arguments) const;
  std::optional<std::string> read_option(const std::vector<std::string>& arguments, std::size_t& next,
                                         std::vector<std::string>& seen) const;

  std::string command_;
  std::string summary_;
  std::string also_;
  std::vector<Option> positional_;
  std::vector<Option> options_;
  std::vector<std::pair<std::string, std::string>> aliases_;
  std::vector<std::pair<std::vector<std::string>, std::string>> elsewhere_;
  std::vector<std::string> notes_;
  std::vector<std::string> examples_;
};

/// What every command understands.
struct CommonOptions {
  int threads = 0;  ///< 0: all cores
  bool quiet = false;
  bool json = false;
  std::filesystem::path output;
};

/// Declares --threads, --quiet, --json and --output (which `output_help` describes).
void add_common(Options& options, CommonOptions& common, const std::string& output_help);
/// The same without --output, for who declares that otherwise.
void add_running(Options& options, CommonOptions& common);

}  // namespace etendue::cli
