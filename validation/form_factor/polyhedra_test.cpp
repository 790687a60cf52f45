// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <vector>

#include "etendue/form_factor/polygon_polygon.hpp"
#include "etendue/geometry/clip.hpp"
#include "form_factor/shapes.hpp"
#include "reference/pair_families.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

Vec3 random_direction(pairs::Random& random) {
  for (;;) {
    const Vec3 v(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
    if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
  }
}

/// A big tetrahedron cut by random planes: each face is the tangent plane's square, cut by all other planes; the
/// fronts look inwards.
std::vector<Polygon> convex_polyhedron(std::size_t number, std::size_t planes) {
  pairs::Random random(30, number);
  std::vector<Plane> cuts;
  for (const Vec3& n : {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)}) {
    cuts.push_back({-1.5 * n.normalized(), n.normalized()});
  }
  for (std::size_t i = 0; i < planes; ++i) {
    const Vec3 n = random_direction(random);
    cuts.push_back({-random.between(0.7, 1.2) * n, n});
  }
  std::vector<Polygon> faces;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const Vec3 u = 20 * cuts[i].normal.unitOrthogonal(), v = cuts[i].normal.cross(u);
    std::vector<Vec3> face{cuts[i].point - u - v, cuts[i].point + u - v, cuts[i].point + u + v, cuts[i].point - u + v};
    for (std::size_t j = 0; j < cuts.size() && !face.empty(); ++j) {
      if (j != i) face = clip(face, cuts[j]);
    }
    if (face.size() < 3) continue;
    auto made = Polygon::make(face);
    if (made.ok()) faces.push_back(*made);
  }
  return faces;
}

// CLAIM      IU.6-6: the factors from every face of a random convex polyhedron sum up to one.
// ORACLE     identity: closure.
// TOLERANCE  kClosure, which 12 digits of each factor and corners rounded once allow.
TEST(FormFactor, ClosesRandomConvexPolyhedra) {
  proves({"IU.6-6", "IU.6-3"}, Oracle::identity, "Σ_j F_ij = 1 over 40 polyhedra of 4 to 13 faces");
  constexpr double kClosure = 1e-12;
  uses_seed(pairs::kSeed);
  for (std::size_t k = 0; k < 40; ++k) {
    const std::vector<Polygon> faces = convex_polyhedron(k, k % 10);
    ASSERT_GE(faces.size(), 4u);
    for (std::size_t i = 0; i < faces.size(); i += 1 + faces.size() / 4) {
      double sum = 0;
      for (std::size_t j = 0; j < faces.size(); ++j) {
        if (j != i) sum += form_factor(faces[i], faces[j]).value;
      }
      EXPECT_TRUE(near(sum, 1, kClosure)) << k << ' ' << i << " of " << faces.size();
    }
  }
}

Polygon moved(const Polygon& p, const std::array<pairs::Point, 3>& axes, double scale, const Vec3& shift) {
  std::vector<Vec3> placed;
  for (const Vec3& v : p.vertices()) {
    Vec3 r = shift;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        r[static_cast<Eigen::Index>(c)] += scale * axes[i][c] * v[static_cast<Eigen::Index>(i)];
      }
    }
    placed.push_back(r);
  }
  return polygon(placed);
}

Polygon from_pairs(const pairs::Loops& loops) {
  std::vector<Vec3> vertices;
  for (const auto& p : loops[0]) vertices.push_back({p[0], p[1], p[2]});
  return polygon(vertices);
}

// CLAIM      IU.6-3: whole-numbered rotations with a stretch, scales of 10^±6 and exact shifts change no factor beyond
//            its bound.
// ORACLE     metamorphic: the factor is invariant under similarity.
// TOLERANCE  the two returned bounds, and what the rounding of the moved corners may cost where they are rounded.
TEST(FormFactor, KeepsItsValueUnderSimilarities) {
  proves({"IU.6-3"}, Oracle::metamorphic, "rotation, scale 10^±6, shift by 2^20, on 160 pairs of the families");
  constexpr double kCorners = 1e-14;    // corners rounded once, of shapes of size one
  constexpr double kShifted = 0x1p-30;  // corners rounded to the grid at 2^20
  for (const std::size_t family : {0u, 1u, 2u, 4u}) {
    for (std::size_t i = 0; i < 40; ++i) {
      pairs::Random random(31, family * 100 + i);
      pairs::Pair pair = pairs::make(family, i);
      if (!pair.exact_frame) continue;
      const Polygon from = from_pairs(pair.from), to = from_pairs(pair.to);
      const Bounded plain = form_factor(from, to);
      const auto same = [&](const std::array<pairs::Point, 3>& axes, double scale, const Vec3& shift, double corners) {
        const Bounded f = form_factor(moved(from, axes, scale, shift), moved(to, axes, scale, shift));
        return near(f.value, plain.value, f.bound + plain.bound + corners);
      };
      const auto unit = pairs::rotation(1, 0, 0, 0);
      EXPECT_TRUE(same(pairs::rotation(2, 1, -1, 3), 1, Vec3::Zero(), 0)) << family << ' ' << i;
      EXPECT_TRUE(same(pairs::random_rotation(random), 1, Vec3::Zero(), kCorners)) << family << ' ' << i;
      EXPECT_TRUE(same(unit, 1e-6, Vec3::Zero(), kCorners)) << family << ' ' << i;
      EXPECT_TRUE(same(unit, 1e6, Vec3::Zero(), kCorners)) << family << ' ' << i;
      EXPECT_TRUE(same(unit, 1, Vec3(0x1p20, -0x1p20, 0x1p19), kShifted)) << family << ' ' << i;
    }
  }
}

// CLAIM      IU.6-3, IU.6-5: a receiver cut into triangles receives what it received; there and back exchange the same.
// ORACLE     identity: additivity over the receiver, and reciprocity, each side computed on its own.
// TOLERANCE  the returned bounds, with the areas' rounding.
TEST(FormFactor, AddsUpOverTheReceiverAndGoesBothWays) {
  proves({"IU.6-3", "IU.6-5"}, Oracle::identity, "fans of triangles and A_1 F_12 = A_2 F_21 on exact pairs");
  constexpr double kAreas = 0x1p-48;
  std::size_t judged = 0;
  for (const std::size_t family : {1u, 4u, 6u, 7u, 8u}) {
    for (std::size_t i = 0; i < 60; ++i) {
      const pairs::Pair pair = pairs::make(family, i);
      const Polygon from = from_pairs(pair.from), to = from_pairs(pair.to);
      const Bounded there = form_factor(from, to), back = form_factor(to, from);
      EXPECT_TRUE(near(from.area() * there.value, to.area() * back.value,
                       from.area() * there.bound + to.area() * back.bound + kAreas * from.area() * there.value))
          << family << ' ' << i;
      if (!pair.exact_frame || to.vertices().size() != 4) continue;
      const auto& v = to.vertices();
      const auto first = Polygon::make({v[0], v[1], v[2]}), second = Polygon::make({v[0], v[2], v[3]});
      if (!first.ok() || !second.ok() || first->normal().dot(second->normal()) < 0) continue;
      const Bounded a = form_factor(from, *first), b = form_factor(from, *second);
      EXPECT_TRUE(near(a.value + b.value, there.value, a.bound + b.bound + there.bound)) << family << ' ' << i;
      ++judged;
    }
  }
  EXPECT_GE(judged, 40u);
}

}  // namespace
}  // namespace etendue::validation
