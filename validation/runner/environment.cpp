// SPDX-License-Identifier: Apache-2.0
#include <sys/utsname.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "runner/report.hpp"

namespace etendue::validation {

namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(std::min(line.size(), line.find(':') + 2));
  }
  return "unknown";
}

std::string system_name() {
  utsname name{};
  if (::uname(&name) != 0) return "unknown";
  return std::string(name.sysname) + " " + name.release + ", " + name.machine;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> environment() {
  return {{"Processor", processor() + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads"},
          {"System", system_name()},
          {"etendue", "Apache-2.0"},
          {"Eigen " ETENDUE_EIGEN_VERSION, "linear algebra; MPL-2.0"},
          {"GoogleTest " ETENDUE_GTEST_VERSION, "runs the tests; BSD-3-Clause"},
          {"nlohmann/json " ETENDUE_JSON_VERSION, "scene files and reports; MIT"},
          {"CGAL " ETENDUE_CGAL_VERSION, "exact geometry, as an oracle; LGPL-3.0-or-later, in parts GPL-3.0-or-later"},
          {"Arb and FLINT", "ball arithmetic, as an oracle; LGPL-2.1-or-later"},
          {"MPFR and GMP", "many digits and rationals, as oracles; LGPL-3.0-or-later"},
          {"OpenImageIO", "reads and writes pictures; BSD-3-Clause"}};
}

}  // namespace etendue::validation
