// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <iosfwd>
#include <string>

#include "etendue/execution/execution.hpp"
#include "options.hpp"

namespace etendue::cli {

/// A bar on the terminal, one line, wiped at the end. Silent when standard error is not a terminal, or with --quiet:
/// no carriage return ever reaches a file or a pipe.
class Progress {
 public:
  Progress(std::ostream& err, std::string title, const CommonOptions& common);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// Shows done/total; at most a few times a second.
  void show(std::size_t done, std::size_t total);
  bool visible() const { return visible_; }
  /// A line for each tenth as well, where there is no terminal to draw on.
  void tell_tenths() { tells_tenths_ = !visible_; }
  bool tells_tenths() const { return tells_tenths_; }
  /// Further words after the percentage: rate, time that is left.
  void annotate(std::function<std::string(std::size_t done, std::size_t total)> note) { note_ = std::move(note); }

 private:
  std::ostream& err_;
  std::string title_;
  bool visible_;
  bool drawn_ = false;
  bool tells_tenths_ = false;
  std::size_t told_ = 0;  ///< tenths
  std::function<std::string(std::size_t, std::size_t)> note_;
  std::chrono::steady_clock::time_point last_{};
};

/// The threads of --threads, this bar, and the user's wish to stop. `progress` must outlive the result.
[[nodiscard]] Execution execution(const CommonOptions& common, Progress& progress);

}  // namespace etendue::cli
