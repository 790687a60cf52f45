// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/view_curve.hpp"

#include <cmath>
#include <vector>

#include "etendue/form_factor/view_form.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

// CLAIM      IU.6-2: an arc of a circle through the eye is seen under no angle but in the circle's own plane: it has no share in the factor of
//            a surface whose normal lies in that plane; in several pieces, neither.
// ORACLE     identity: p' × p is across the plane.
// TOLERANCE  none.
TEST(ViewCurve, HasNoShareThroughTheEye) {
  proves({"IU.6-2"}, Oracle::identity, "circles through the eye");
  for (const double end : {1.5, 5.5}) {
    std::vector<ViewCurve> curves;
    ViewCurve::add_arc({1, 0, 0}, {1, 0, 0}, {0, 1, 0}, -end / 2, end / 2, curves);
    double share = 0;
    for (const ViewCurve& curve : curves) share += curve.share(curve.begin(), curve.end(), Vec3::UnitY());
    EXPECT_TRUE(within(std::abs(share), 0)) << end;
  }
}

// CLAIM      IU.6-4: two edges keep crossing on the same side, as seen, while the direction to their crossing turns by less than a
//            quarter.
// ORACLE     closed form: for edges along x at height 1, and along y = z − 3 at x = 1/2, the direction from (0, y, 0) is
//            ((y + 1)/2, −y (3 + y), 3 + y). With that from y = −2 its product is −2y² − 5.25 y + 2.75: positive from −3.0725 to 0.4475.
// TOLERANCE  none: numbers of few bits.
TEST(ViewForm, KeepsSidesForLessThanAQuarterTurn) {
  proves({"IU.6-4"}, Oracle::closed_form, "two skew edges, whose directions are parabolas");
  const std::vector<ViewEdge> edges{{{0, 0, 1}, {1, 0, 0}}, {{0.5, -1, 2}, {0, 1, 1}}};
  const ViewForm form{{0, 1, false}};
  const auto keeps = [&](double other) {
    const std::vector<Vec2> points{{0, -2}, {0, other}};
    return keeps_sides(edges, form, {0, -2}, points);
  };
  EXPECT_TRUE(holds(keeps(-1) && keeps(-3.0625) && keeps(0.4375)));
  EXPECT_TRUE(holds(!keeps(-3.09375) && !keeps(-4) && !keeps(0.46875) && !keeps(3)));
}

}  // namespace
}  // namespace etendue::validation
