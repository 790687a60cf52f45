// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <string>

#include "fuzz/target.hpp"
#include "support/temporary_folder.hpp"

// Every input of a corpus once more, in the ordinary build: what a fuzzer once found stays found.
//     etendue-fuzz-replay CORPUS          a folder of folders, each named after its target
int main(int count, char** arguments) {
  namespace fs = std::filesystem;
  if (count != 2) {
    std::cerr << "usage: etendue-fuzz-replay CORPUS\n";
    return 2;
  }
  int inputs = 0;
  for (const auto* targets : {&etendue::fuzz::reader_targets(), &etendue::fuzz::kernel_targets()}) {
    for (const auto& target : *targets) {
      const fs::path folder = fs::path(arguments[1]) / target.name;
      if (!fs::is_directory(folder)) {
        std::cerr << "etendue-fuzz-replay: no folder " << folder << ": each target needs a first input\n";
        return 1;
      }
      for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string bytes = etendue::validation::read_text(entry.path());
        std::cout << entry.path().string() << std::endl;  // a crash is the fault of the last name
        target.run({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
        ++inputs;
      }
    }
  }
  std::cout << inputs << " inputs, none does harm\n";
  return inputs > 0 ? 0 : 1;
}
