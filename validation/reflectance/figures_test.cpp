// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "etendue/optics/reflect.hpp"
#include "etendue/reflectance/bump.hpp"
#include "support/evidence.hpp"
#include "support/figure_drawing.hpp"
#include "support/process.hpp"
#include "support/temporary_folder.hpp"

// Figures 22 and 24, drawn from what the library computes.
namespace etendue::validation {
namespace {

// CLAIM      IU.4.2.1, figure 22: a smooth surface with its normals, the same surface displaced by f with the normals that it then has, and the
//            smooth one with the perturbed normals: they point as those of the displaced one do.
// ORACLE     closed form: the slope of the displaced profile, of which nothing but the first order in f is left out.
// TOLERANCE  f κ f' for the curvature κ, and what the slope's own square leaves: 0.02 here; the drawing is the one that is shipped.
TEST(Figures, DrawBumpMapping) {
  proves({"IU.4.2.1"}, Oracle::closed_form, "slopes of the displaced profile");
  FigureDrawing drawing(9, 6.6, 80);
  constexpr double kRound = 12;  // radius of the profile
  const auto at = [&](double s, double height) {
    const double turn = (s - 4.5) / kRound;
    return Vec3(4.5 + (kRound + height) * std::sin(turn), 0, (kRound + height) * std::cos(turn) - kRound);
  };
  const WaveRelief waves{0.12, 5, 0};
  const double levels[] = {5.1, 3, 0.9};
  for (int row = 0; row < 3; ++row) {
    const Vec3 up(0, 0, levels[row]);
    std::vector<Vec3> profile;
    for (int k = 0; k <= 160; ++k) {
      const double s = 0.5 + 8 * k / 160.0;
      profile.push_back(at(s, row == 1 ? relief(waves, k / 160.0, 0).height : 0) + up);
    }
    drawing.line(profile, kBlack);
    for (int k = 0; k <= 40; ++k) {
      const double s = 0.5 + 8 * k / 40.0, turn = (s - 4.5) / kRound;
      const Relief here = relief(waves, k / 40.0, 0);
      const Vec3 normal(std::sin(turn), 0, std::cos(turn)), along = 8 * Vec3(std::cos(turn), 0, -std::sin(turn));
      const Vec3 bumped = bumped_normal(normal, height_gradient(along, Vec3::UnitY(), here));
      // Of q + f n: (1 + f/κ⁻¹) q' + f' n, turned by a right angle.
      const Vec3 tangent = (1 + here.height / kRound) * along + here.along_u * normal;
      const Vec3 displaced = Vec3(-tangent.z(), 0, tangent.x()).normalized();
      EXPECT_TRUE(within((bumped - displaced).norm(), 0.02));
      const Vec3 foot = at(s, row == 1 ? here.height : 0) + up;
      drawing.arrow(foot, foot + 0.5 * (row == 0 ? normal : row == 1 ? displaced : bumped), kRed);
    }
  }
  drawing.text({0.2, 0, 6.2}, "Q(u): a smooth surface");
  drawing.text({0.2, 0, 4.1}, "Q′ = Q + f(u) n: displaced");
  drawing.text({0.2, 0, 2.0}, "bump mapping: Q with the normals of Q′");
  const std::string svg = drawing.done();
  EXPECT_TRUE(holds(read_text(source_root() / "docs/figure-22.svg") == svg)) << svg;
}

/// Where two segments cross, as a share of the first; −1 where they do not.
double crossing(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 first = b - a, second = d - c, way = c - a;
  const double both = first.x() * second.z() - first.z() * second.x();
  const double s = (way.x() * second.z() - way.z() * second.x()) / both;
  const double t = (way.x() * first.z() - way.z() * first.x()) / both;
  return s >= 0 && s <= 1 && t >= 0 && t <= 1 ? s : -1;
}

// CLAIM      Figure 24, of the model of Cook and Torrance: of facets that are mirrors each, those whose normal halves the angle between light and
//            viewer send light to him: a, c and e. Of c a part is dark, in b's shadow; what e sends meets f.
// ORACLE     closed form: crossings of straight lines.
// TOLERANCE  reflection_error(), and as much for the normal; the drawing is the one that is shipped.
TEST(Figures, DrawMicrofacets) {
  proves({}, Oracle::closed_form, "crossings of lines");
  const Vec3 light(-0.8, 0, 0.6), viewer(0.6, 0, 0.8), half = (light + viewer).normalized();
  const Vec3 along(half.z(), 0, -half.x());
  const Vec3 a0(0.4, 0, 0.9), a1 = a0 + 1.6 * along, b0(2.6, 0, 1.85), c0(3.1, 0, 1), c1 = c0 + 2 * along,
                              e0(5.6, 0, 0.55), e1 = e0 + 1.6 * along, f1(7.9, 0, 2.9), end(8.6, 0, 1.3);
  const std::array<std::array<Vec3, 2>, 3> mirrors{{{a0, a1}, {c0, c1}, {e0, e1}}};
  for (const auto& facet : mirrors) {
    const Vec3 way = (facet[1] - facet[0]).normalized();
    const Vec3 sent = reflect(-light, Vec3(-way.z(), 0, way.x()));
    EXPECT_TRUE(within((sent - viewer).norm(), 2 * reflection_error()));
  }
  FigureDrawing drawing(9, 4.4, 100);
  drawing.line({a0, a1, b0, c0, c1, e0, e1, f1, end}, kBlack);
  // Light that passes the top of b: it meets c, and what lies before that is dark.
  const double dark = crossing(c0, c1, b0, b0 - 4 * light);
  EXPECT_TRUE(holds(dark > 0.1 && dark < 0.9));
  const Vec3 edge = c0 + dark * (c1 - c0);
  drawing.line({b0 + 1.6 * light, edge}, kDotted);
  drawing.line({c0, edge}, "stroke=\"#999\" stroke-width=\"6\"");
  const auto lit = [&](const Vec3& at) {
    drawing.arrow(at + 1.8 * light, at, kDotted);
    return at;
  };
  const Vec3 on_a = lit(a0 + 0.6 * (a1 - a0)), on_c = lit(c0 + 0.7 * (c1 - c0)), on_e = lit(e0 + 0.7 * (e1 - e0));
  const std::vector<std::array<Vec3, 2>> walls{{a1, b0}, {b0, c0}, {e1, f1}, {f1, end}};
  for (const Vec3& at : {on_a, on_c}) {
    for (const auto& wall : walls) EXPECT_TRUE(holds(crossing(at, at + 4 * viewer, wall[0], wall[1]) < 0));
    drawing.arrow(at, at + 1.9 * viewer, kRed);
  }
  const double met = crossing(on_e, on_e + 4 * viewer, e1, f1);
  EXPECT_TRUE(holds(met > 0));
  const Vec3 on_f = on_e + met * 4 * viewer, across = Vec3(-(f1 - e1).z(), 0, (f1 - e1).x()).normalized();
  drawing.arrow(on_e, on_f, kRed);
  drawing.arrow(on_f, on_f + 1.2 * reflect(viewer, across), kGrey);
  drawing.text(a0 + Vec3(0.5, 0, -0.2), "a");
  drawing.text({2.9, 0, 1.5}, "b");
  drawing.text(c0 + Vec3(1.2, 0, -0.1), "c");
  drawing.text({5.4, 0, 1.0}, "d");
  drawing.text(e0 + Vec3(0.7, 0, -0.2), "e");
  drawing.text({7.75, 0, 1.9}, "f");
  drawing.text({0.1, 0, 3.9}, "light (dashed) comes from the left; red: to the viewer");
  const std::string svg = drawing.done();
  EXPECT_TRUE(holds(read_text(source_root() / "docs/figure-24.svg") == svg)) << svg;
}

}  // namespace
}  // namespace etendue::validation
