// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace etendue::validation {

/// How a program ended, and what it said.
struct Ended {
  int code = -1;   ///< exit code; −1 when a signal ended it
  int signal = 0;  ///< that signal
  std::string out;
  std::string err;
  double seconds = 0;
  bool too_long = false;  ///< it was killed for its time, or
  bool too_much = false;  ///< for its output
};

struct ProcessOptions {
  std::filesystem::path folder;                                  ///< working directory; empty: ours
  std::vector<std::pair<std::string, std::string>> environment;  ///< set besides ours
  std::filesystem::path in;                                      ///< read on standard input; empty: ours
  std::filesystem::path out;                                     ///< where standard output goes instead
  bool closed_pipe = false;                                      ///< standard output is a pipe that nobody reads
  double interrupt_after = 0;                                    ///< seconds after which SIGINT is sent; 0: never
  std::string interrupt_at;                 ///< standard error is a terminal; SIGINT is sent when this appears on it
  double interrupt_again = 0;               ///< seconds after the first SIGINT at which a second is sent; 0: never
  double longest = 120;                     ///< seconds after which it is killed
  std::uintmax_t most = 0;                  ///< bytes on standard output beyond which it is killed; 0: any
  bool with_children = false;               ///< it is killed with all that it has started, which ends with it anyway
  const std::atomic<bool>* stop = nullptr;  ///< kills it when true
};

/// Runs a program to its end, or kills it where the options say so. Without a slash it is looked for in PATH. Throws where it cannot be
/// started.
Ended run_process(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                  const ProcessOptions& options = {});

/// The real program `etendue` of this build, or what the environment's ETENDUE_PROGRAM names.
Ended run_etendue(const std::vector<std::string>& arguments, const ProcessOptions& options = {});
const std::filesystem::path& etendue_program();

/// Root of the sources: scenes/, docs/ …
const std::filesystem::path& source_root();

}  // namespace etendue::validation
