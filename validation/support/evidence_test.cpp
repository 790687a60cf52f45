// SPDX-License-Identifier: Apache-2.0
#include "support/evidence.hpp"

#include <cmath>

namespace etendue::validation {
namespace {

// CLAIM      near, within and all_agree refuse what a careless comparison lets pass.
// ORACLE     identity: the definitions.
// TOLERANCE  none: each outcome is a yes or a no.
TEST(Evidence, RefusesNanNegativeErrorsAndEmptyChecks) {
  EXPECT_FALSE(near(std::nan(""), 1, 1));
  EXPECT_FALSE(near(1, std::nan(""), 1));
  EXPECT_FALSE(near(1, 1, -1));
  EXPECT_FALSE(within(-1e-300, 1));
  EXPECT_FALSE(near(1, 1 + 1e-9, 1e-10));
  EXPECT_FALSE(all_agree(0, 0));
  EXPECT_FALSE(all_agree(1, 10));
  EXPECT_FALSE(holds(false));
  EXPECT_TRUE(holds(true));
  EXPECT_FALSE(apart(1, 1 + 1e-10, 1e-9));
  EXPECT_FALSE(apart(1, std::nan(""), 1e-9));
  EXPECT_FALSE(apart(1, 2, std::nan("")));
  EXPECT_TRUE(apart(1, 2, 0.5));
  EXPECT_TRUE(apart(std::nan(""), 2, 0.5));
  EXPECT_TRUE(near(1, 1, 0));
  EXPECT_TRUE(all_agree(0, 10));
}

}  // namespace
}  // namespace etendue::validation
