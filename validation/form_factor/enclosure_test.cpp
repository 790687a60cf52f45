// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "etendue/form_factor/polygon_polygon.hpp"
#include "form_factor/shapes.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr double kAsked = 1e-11;

/// The inside of a box, each face cut n × n, in a tilted frame.
std::vector<Polygon> box_inside(const Vec3& size, int n) {
  const Vec3 x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
  const std::array<std::array<Vec3, 3>, 6> faces{
      {{Vec3::Zero(), x, y}, {z, y, x}, {Vec3::Zero(), y, z}, {x, z, y}, {Vec3::Zero(), z, x}, {y, x, z}}};
  std::vector<Polygon> patches;
  for (const auto& face : faces) {
    const Vec3 &corner = face[0], &a = face[1], &b = face[2];
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const auto at = [&](int k, int l) { return tilted(corner + a * (k / double(n)) + b * (l / double(n))); };
        patches.push_back(polygon({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}));
      }
    }
  }
  return patches;
}

/// Largest |Σ_j F_ij − 1|, and the sum of the bounds in that row.
void expect_closed(const std::vector<Polygon>& patches, double demanded) {
  for (const Polygon& from : patches) {
    double sum = 0, bound = 0;
    for (const Polygon& to : patches) {
      const Bounded f = form_factor(from, to, {kAsked, 0});
      sum += f.value;
      bound += f.bound;
    }
    EXPECT_TRUE(near(sum, 1, demanded));
    // What the bounds do not cover: shared corners are the same doubles, but the faces' grids are flat only to
    // rounding.
    constexpr double kGrid = 64 * 0x1p-53;
    EXPECT_TRUE(near(sum, 1, bound + kGrid));
  }
}

constexpr double kClosure = 1e-10;

// CLAIM      IU.6-6: in a closed box, whole or cut into 54 patches, in a tilted frame, Σ_j F_ij = 1.
// ORACLE     identity: closure.
// TOLERANCE  kClosure, and the sum of the returned bounds.
TEST(FormFactor, ClosesABox) {
  proves({"IU.6-6"}, Oracle::identity, "rows of a 1 x 2 x 0.5 box with 6 and 54 patches sum to one");
  expect_closed(box_inside({1, 2, 0.5}, 1), kClosure);
  expect_closed(box_inside({1, 2, 0.5}, 3), kClosure);
}

// CLAIM      IU.6-6: the same in a tetrahedron, whose faces meet at sharp angles.
// ORACLE     identity: closure; and (3 − √3)/6 between two faces that meet at a right angle.
// TOLERANCE  kClosure, and the returned bounds.
TEST(FormFactor, ClosesATetrahedron) {
  proves({"IU.6-6", "IU.6-3"}, Oracle::identity, "the corner tetrahedron: closure and (3 - sqrt 3)/6");
  const Vec3 o = tilted({0, 0, 0}), x = tilted({1, 0, 0}), y = tilted({0, 1, 0}), z = tilted({0, 0, 1});
  const std::vector<Polygon> faces{polygon({o, x, y}), polygon({o, z, x}), polygon({o, y, z}), polygon({x, z, y})};
  expect_closed(faces, kClosure);
  const Bounded f = form_factor(faces[0], faces[1], {kAsked, 0});
  EXPECT_TRUE(near(f.value, (3 - std::sqrt(3.0)) / 6, f.bound + 8 * 0x1p-53));
}

// CLAIM      IU.6.2: F_ii = 0 for planar patches, convex or concave; coplanar patches exchange nothing.
// ORACLE     identity: a plane does not see itself.
// TOLERANCE  zero: no rounding is excused.
TEST(FormFactor, OfAPlanarPatchToItselfIsZero) {
  proves({"IU.6.2"}, Oracle::identity, "F_ii = 0 exactly");
  const Polygon square = tilted(rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  const Polygon l_shape = tilted(polygon({{0, 0, 0}, {1, 0, 0}, {1, 0.5, 0}, {0.5, 0.5, 0}, {0.5, 1, 0}, {0, 1, 0}}));
  const Polygon beside = tilted(rectangle({1, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  for (const Polygon* p : {&square, &l_shape}) EXPECT_TRUE(within(form_factor(*p, *p).value, 0));
  EXPECT_TRUE(within(form_factor(square, beside).value, 0));
}

// CLAIM      E20: "the n factors F_ii are zero" fails for concave patches: a hemisphere keeps half of what it emits.
// ORACLE     identity: of a dome over a flat base, A_base leaves through it: F_ii = 1 − A_base/A_dome, 0.5 in the
//            limit.
// TOLERANCE  the summed bounds, and kSums for the areas.
TEST(FormFactor, OfADomeToItselfTendsToOneHalf) {
  proves({"E20", "IU.6.2"}, Oracle::identity, "a dome of 12 x 5 facets: 1 - A_base/A_dome, near 0.5");
  constexpr int kSectors = 12, kBands = 5;
  const auto at = [](int sector, int band) {
    const double azimuth = 2 * std::numbers::pi * (sector % kSectors) / kSectors;
    const double height = 0.5 * std::numbers::pi * band / kBands;
    return tilted(Vec3(std::cos(height) * std::cos(azimuth), std::cos(height) * std::sin(azimuth), std::sin(height)));
  };
  const Vec3 top = tilted(Vec3(0, 0, 1));
  std::vector<Polygon> dome;
  std::vector<Vec3> rim;
  for (int s = 0; s < kSectors; ++s) {
    rim.push_back(at(s, 0));
    for (int b = 0; b + 1 < kBands; ++b) {
      dome.push_back(polygon({at(s, b), at(s, b + 1), at(s + 1, b + 1), at(s + 1, b)}));
    }
    dome.push_back(polygon({at(s, kBands - 1), top, at(s + 1, kBands - 1)}));
  }
  double area = 0, kept = 0, bound = 0;
  for (const Polygon& from : dome) {
    area += from.area();
    for (const Polygon& to : dome) {
      const Bounded f = form_factor(from, to, {1e-8, 1e-12});
      kept += from.area() * f.value;
      bound += from.area() * f.bound;
    }
  }
  constexpr double kSums = 1e-13;
  EXPECT_TRUE(near(kept / area, 1 - polygon(rim).area() / area, bound / area + kSums));
  constexpr double kFacets = 0.03;  // the facets' deficit of area at 12 sectors and 5 bands
  EXPECT_TRUE(near(kept / area, 0.5, kFacets));
}

// CLAIM      E21: the hemicube on the one patch or on the other differ by A_j/A_i: a factor of 4 for areas 1 and 4.
// ORACLE     identity: reciprocity; the printed mixture would need F_ij = F_ji.
// TOLERANCE  the returned bounds.
TEST(FormFactor, DiffersByTheRatioOfAreasBetweenItsTwoEnds) {
  proves({"E21", "IU.6-5"}, Oracle::identity, "F_12 = 4 F_21 for areas 1 and 4");
  const Polygon small = tilted(rectangle({0.5, 0.5, 0}, {1, 0, 0}, {0, 1, 0}));
  const Polygon large = tilted(rectangle({0, 0, 1}, {0, 2, 0}, {2, 0, 0}));
  const Bounded up = form_factor(small, large), down = form_factor(large, small);
  ASSERT_GT(std::abs(up.value - down.value), 0.1) << "taken for one another the two are far apart";
  EXPECT_TRUE(near(up.value, 4 * down.value, up.bound + 4 * down.bound + 16 * 0x1p-53 * up.value));
}

// CLAIM      E19: a form factor does not include what a third patch reflects: with it, rows would sum to more than one.
// ORACLE     identity: closure, Σ_j (F_ij + ρ Σ_k F_ik F_kj) = 1 + ρ in a closed box.
// TOLERANCE  kClosure, twice for the product.
TEST(FormFactor, ExcludesReflectedLight) {
  proves({"E19", "IU.6-6"}, Oracle::identity, "the row with one reflection sums to 1 + rho, the code's to 1");
  constexpr double kReflectance = 0.5;
  const std::vector<Polygon> box = box_inside({1, 2, 0.5}, 1);
  const auto f = [&](std::size_t i, std::size_t j) { return form_factor(box[i], box[j], {kAsked, 0}).value; };
  double direct = 0, with_reflection = 0;
  for (std::size_t j = 0; j < box.size(); ++j) {
    direct += f(0, j);
    with_reflection += f(0, j);
    for (std::size_t k = 0; k < box.size(); ++k) with_reflection += kReflectance * f(0, k) * f(k, j);
  }
  EXPECT_TRUE(near(direct, 1, kClosure));
  EXPECT_TRUE(near(with_reflection, 1 + kReflectance, 2 * kClosure));
}

}  // namespace
}  // namespace etendue::validation
