// SPDX-License-Identifier: Apache-2.0
#include "fuzz/target.hpp"

#include <cstdio>
#include <cstdlib>

namespace etendue::fuzz {

const Target* find_target(std::string_view name) {
  for (const auto* targets : {&reader_targets(), &kernel_targets()}) {
    for (const Target& target : *targets) {
      if (target.name == name) return &target;
    }
  }
  return nullptr;
}

void fail(const char* what) {
  std::fprintf(stderr, "does not hold: %s\n", what);
  std::abort();
}

}  // namespace etendue::fuzz
