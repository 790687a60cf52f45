// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/critical_lines.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

// CLAIM      IU.6-4: the critical lines of a square blocker midway between two unit squares are x = 1/2 and y = 1/2: from
//            a receiver's vertex 0 or 1 the blocker's edges at 1/4 and 3/4 project to 1/2, −1/2, 3/2 and 1/2.
// ORACLE     closed form: similar triangles, exact in double.
// TOLERANCE  zero: all numbers are dyadic.
TEST(CriticalLines, AreWhereSimilarTrianglesPutThem) {
  proves({"IU.6-4"}, Oracle::closed_form, "a square blocker between unit squares: x = 1/2 and y = 1/2");
  const Loop floor = make_loop({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const std::vector<Vec3> ceiling{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
  const std::vector<std::vector<Vec3>> blocker{
      {{0.25, 0.25, 0.5}, {0.75, 0.25, 0.5}, {0.75, 0.75, 0.5}, {0.25, 0.75, 0.5}}};
  const std::vector<CriticalLine> lines = critical_lines(floor, ceiling, blocker);
  bool upright = false, level = false;
  for (const CriticalLine& line : lines) {
    // Where the plane normal · x = level meets the floor's axes; one of the two components is zero.
    const bool is_upright = std::abs(line.normal.x()) > std::abs(line.normal.y());
    const double at = line.level / (is_upright ? line.normal.x() : line.normal.y());
    EXPECT_TRUE(within(std::min(std::abs(line.normal.x()), std::abs(line.normal.y())), 0));
    EXPECT_TRUE(near(at, 0.5, 0));
    EXPECT_TRUE(line.bounded);
    (is_upright ? upright : level) = true;
  }
  EXPECT_TRUE(upright && level) << lines.size() << " lines";
}

}  // namespace
}  // namespace etendue::validation
