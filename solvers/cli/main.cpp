// SPDX-License-Identifier: Apache-2.0
#include <csignal>
#include <iostream>
#include <string>
#include <vector>

#include "stop.hpp"
#include "table.hpp"

int main(int count, char** words) {
  std::signal(SIGPIPE, SIG_IGN);  // a reader that leaves early is a write error (5), not a silent death
  std::signal(SIGXFSZ, SIG_IGN);  // nor may a limit on the size of files end us before the message and the cleaning up
  etendue::cli::watch_stop_signals();
  return etendue::cli::run(std::vector<std::string>(words + (count > 0 ? 1 : 0), words + count), std::cout, std::cerr);
}
