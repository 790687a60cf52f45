// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "etendue/core/result.hpp"

namespace etendue::validation {

/// A test and the ids that it proves.
struct TestClaims {
  std::string test;    ///< Suite.Name
  std::string oracle;  ///< the kind that its first proves() names; empty where it has none
  std::vector<std::string> claims;
};

/// Which test proves what, without computing anything: a child process runs every test up to its proves().
/// There is no second list that could go stale. Tests come in the order in which they run.
[[nodiscard]] Result<std::vector<TestClaims>> probe_tests();

/// Is this process inside a probe? Then a test has started us, and probing again would never end.
bool inside_probe();

}  // namespace etendue::validation
