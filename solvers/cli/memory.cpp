// SPDX-License-Identifier: Apache-2.0
#include "memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>

#include "etendue/text/number_text.hpp"

namespace etendue::cli {

namespace {

/// The number in the first line of a file; nothing where there is none ("max" is no number).
std::optional<double> number_in(const char* path) {
  std::ifstream file(path);
  double value = 0;
  if (file >> value) return value;
  return std::nullopt;
}

/// What follows `key` in a file of lines "key: number kB".
std::optional<double> kibibytes_in(const char* path, const std::string& key) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.rfind(key + ":", 0) == 0) return std::strtod(line.c_str() + key.size() + 1, nullptr) * 1024;
  }
  return std::nullopt;
}

std::optional<double> of_the_machine() {
  return kibibytes_in("/proc/meminfo", "MemAvailable");
}

std::optional<double> of_the_group() {
  const auto most = number_in("/sys/fs/cgroup/memory.max"), used = number_in("/sys/fs/cgroup/memory.current");
  if (!most || !used) return std::nullopt;
  return std::max(0.0, *most - *used);
}

std::optional<double> of_the_process() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
  const auto pages = number_in("/proc/self/statm");  // its first number: all of the address space
  if (!pages) return std::nullopt;
  return std::max(0.0, static_cast<double>(limit.rlim_cur) - *pages * static_cast<double>(sysconf(_SC_PAGESIZE)));
}

}  // namespace

std::optional<double> available_memory() {
  std::optional<double> least;
  for (const auto& one : {of_the_machine(), of_the_group(), of_the_process()}) {
    if (one && (!least || *one < *least)) least = one;
  }
  return least;
}

std::optional<double> peak_memory() {
  return kibibytes_in("/proc/self/status", "VmHWM");
}

Result<Done> check_memory(const MemoryNeed& need) {
  const auto available = available_memory();
  if (!available || need.bytes <= *available) return Done{};
  const auto gigabytes = [](double bytes) { return rounded(bytes / 1e9, 3) + " GB"; };
  return Error{ErrorCode::input_output, need.subject + " " + gigabytes(need.bytes) + " of memory (" + need.reason +
                                            "), " + gigabytes(*available) + " are available: " + need.advice};
}

}  // namespace etendue::cli
