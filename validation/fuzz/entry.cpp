// SPDX-License-Identifier: Apache-2.0
#include "fuzz/target.hpp"

// What libFuzzer calls: the target ETENDUE_FUZZ_TARGET, which the build names.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const etendue::fuzz::Target* const target = etendue::fuzz::find_target(ETENDUE_FUZZ_TARGET);
  if (target == nullptr) etendue::fuzz::fail("a target of this name: " ETENDUE_FUZZ_TARGET);
  target->run({data, size});
  return 0;
}
