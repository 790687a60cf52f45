// SPDX-License-Identifier: Apache-2.0
#include "progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string_view>
#include <utility>

#include "stop.hpp"

namespace etendue::cli {

namespace {

constexpr std::chrono::milliseconds kRedraw{100};
constexpr std::size_t kWidth = 40;

bool is_terminal(const std::ostream& stream) {
  const char* kind = std::getenv("TERM");
  return &stream == &std::cerr && ::isatty(STDERR_FILENO) && kind && std::string_view(kind) != "dumb";
}

}  // namespace

Progress::Progress(std::ostream& err, std::string title, const CommonOptions& common)
    : err_(err), title_(std::move(title)), visible_(!common.quiet && is_terminal(err)) {}

Progress::~Progress() {
  if (drawn_) err_ << "\r\033[K" << std::flush;
}

void Progress::show(std::size_t done, std::size_t total) {
  if (tells_tenths_ && total > 0) {
    const std::size_t tenths = 10 * done / total;
    if (tenths > told_) err_ << title_ << " " << 10 * tenths << " %\n" << std::flush;
    told_ = std::max(told_, tenths);
  }
  const auto now = std::chrono::steady_clock::now();
  if (!visible_ || total == 0 || now - last_ < kRedraw) return;
  last_ = now;
  drawn_ = true;
  const std::size_t filled = done >= total ? kWidth : kWidth * done / total;
  err_ << '\r' << title_ << " [" << std::string(filled, '#') << std::string(kWidth - filled, ' ') << "] "
       << 100 * done / total << " %" << (note_ ? note_(done, total) : "") << "\033[K" << std::flush;
}

Execution execution(const CommonOptions& common, Progress& progress) {
  Execution how;
  how.threads = common.threads;
  how.stop = &stop_requested();
  if (progress.visible() || progress.tells_tenths())
    how.progress = [&progress](std::size_t done, std::size_t total) { progress.show(done, total); };
  return how;
}

}  // namespace etendue::cli
