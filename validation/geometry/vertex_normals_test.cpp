// SPDX-License-Identifier: Apache-2.0
#include "etendue/geometry/vertex_normals.hpp"

#include <cmath>
#include <numbers>

#include "support/counter_random.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr NormalWeight kAllWeights[] = {NormalWeight::equal, NormalWeight::area, NormalWeight::angle};

/// Normals are sums of a few unit vectors with weights of a few roundings each, normalised.
constexpr double kFewRoundings = 40 * 0x1p-53;

double apart_by(const Vec3& a, const Vec3& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

/// A cube around the origin, each face cut along the diagonal that the bit of `diagonals` says.
Mesh cube(unsigned diagonals) {
  Mesh mesh;
  for (int k = 0; k < 8; ++k) mesh.vertices.emplace_back((k & 1) ? 1 : -1, (k & 2) ? 1 : -1, (k & 4) ? 1 : -1);
  const std::uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (int f = 0; f < 6; ++f) {
    const auto* q = faces[f];
    if ((diagonals >> f) & 1U) {
      mesh.triangles.push_back({q[0], q[1], q[2]});
      mesh.triangles.push_back({q[0], q[2], q[3]});
    } else {
      mesh.triangles.push_back({q[0], q[1], q[3]});
      mesh.triangles.push_back({q[1], q[2], q[3]});
    }
  }
  return mesh;
}

// CLAIM      IU.3.2a: the normal at a vertex is the average of its polygons' normals: at a cube's corner that of three faces. The
//            polygons are squares; cut into triangles, whichever way, angles still give their average, and counting triangles or
//            areas does not.
// ORACLE     identity: the diagonal of the cube, for all 64 ways to cut its faces.
// TOLERANCE  40 u for angles; of the others at least one of the eight corners is off by 0.1 in most cuttings.
TEST(VertexNormals, AreTheAverageOfThePolygons) {
  proves({"IU.3.2a"}, Oracle::identity, "the diagonals of a cube, however its faces are cut");
  int equal_off = 0, area_off = 0;
  for (unsigned cut = 0; cut < 64; ++cut) {
    const Mesh mesh = cube(cut);
    double off[3] = {0, 0, 0};
    for (const NormalWeight weight : kAllWeights) {
      const auto normals = corner_normals(mesh, weight, kPi);
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
          const double error = apart_by(normals[t][k], mesh.vertices[mesh.triangles[t][k]] / std::sqrt(3.0));
          off[static_cast<int>(weight)] = std::max(off[static_cast<int>(weight)], error);
        }
      }
    }
    EXPECT_TRUE(within(off[static_cast<int>(NormalWeight::angle)], kFewRoundings));
    equal_off += off[static_cast<int>(NormalWeight::equal)] > 0.1;
    area_off += off[static_cast<int>(NormalWeight::area)] > 0.1;
  }
  EXPECT_GT(equal_off, 50);
  EXPECT_GT(area_off, 50);
}

// CLAIM      IU.3.2a: each weight is what it says, on random fans around a vertex.
// ORACLE     closed form: the average written out in long double, with areas and angles from dot products.
// TOLERANCE  40 u times the number of triangles.
TEST(VertexNormals, WeighWhatTheySay) {
  proves({"IU.3.2a"}, Oracle::closed_form, "weighted averages in long double");
  constexpr std::uint64_t kSeed = 611;
  uses_seed(kSeed);
  CounterRandom random(kSeed);
  for (int trial = 0; trial < 100; ++trial) {
    constexpr int kCount = 5;
    Mesh mesh;
    mesh.vertices.emplace_back(0, 0, random.between(0.2, 0.8));
    for (int k = 0; k < kCount; ++k) {
      const double turn = 2 * kPi * (k + 0.6 * random.between(0, 1)) / kCount, radius = random.between(0.5, 2);
      mesh.vertices.emplace_back(radius * std::cos(turn), radius * std::sin(turn), random.between(-0.2, 0.2));
    }
    for (std::uint32_t k = 0; k < kCount; ++k) mesh.triangles.push_back({0, k + 1, (k + 1) % kCount + 1});
    for (const NormalWeight weight : kAllWeights) {
      using LongVector = Eigen::Matrix<long double, 3, 1>;
      LongVector sum = LongVector::Zero();
      for (const auto& ends : mesh.triangles) {
        const auto at = [&](std::size_t k) { return LongVector(mesh.vertices[ends[k]].cast<long double>()); };
        const LongVector u = at(1) - at(0), v = at(2) - at(0), n = u.cross(v);
        long double share = 1;
        if (weight == NormalWeight::area) share = n.norm() / 2;
        if (weight == NormalWeight::angle) share = std::acos(u.dot(v) / (u.norm() * v.norm()));
        sum += share * n / n.norm();
      }
      const Vec3 expected = (sum / sum.norm()).cast<double>();
      for (const auto& normals : corner_normals(mesh, weight, kPi))
        EXPECT_TRUE(within(apart_by(normals[0], expected), kCount * kFewRoundings));
    }
  }
}

/// A strip of quadrilaterals across x, folded along lines y = constant at the given places.
Mesh folded(const std::vector<Vec2>& profile) {
  Mesh mesh;
  for (const Vec2& place : profile) {
    for (const double y : {0.0, 1.0, 2.0}) mesh.vertices.emplace_back(place.x(), y, place.y());
  }
  for (std::uint32_t i = 0; i + 1 < profile.size(); ++i) {
    for (std::uint32_t j = 0; j < 2; ++j) {
      const std::uint32_t a = 3 * i + j, b = a + 3;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return mesh;
}

// CLAIM      IU.3.2.1a: a wanted crease has two normals at each of its vertices, each the average over its own side; an edge that is
//            not wanted has one. Where a crease ends, at a vertex, all polygons around its end share one.
// ORACLE     closed form: a roof of 90° whose sides are each bent by 20°: angles of 35°, 55° and back on either side.
// TOLERANCE  40 u.
TEST(VertexNormals, AreTwoAtACrease) {
  proves({"IU.3.2.1a"}, Oracle::closed_form, "a roof of four strips");
  const auto slope = [](double degrees) { return Vec2(std::cos(degrees * kPi / 180), std::sin(degrees * kPi / 180)); };
  std::vector<Vec2> profile{{0, 0}};
  for (const double degrees : {35.0, 55.0, -55.0, -35.0}) profile.push_back(profile.back() + slope(degrees));
  const Mesh roof = folded(profile);
  const auto up = [](double degrees) { return Vec3(-std::sin(degrees * kPi / 180), 0, std::cos(degrees * kPi / 180)); };
  const auto creased = corner_normals(roof, NormalWeight::angle, 60 * kPi / 180);
  const auto smooth = corner_normals(roof, NormalWeight::angle, kPi);
  int at_ridge = 0;
  for (std::size_t t = 0; t < roof.triangles.size(); ++t) {
    const std::size_t strip = t / 4;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t line = roof.triangles[t][k] / 3;
      const double alone[] = {35, 45, strip == 1 ? 55.0 : -55.0, -45, -35};
      EXPECT_TRUE(within(apart_by(creased[t][k], up(alone[line])), kFewRoundings));
      const double together[] = {35, 45, 0, -45, -35};
      EXPECT_TRUE(within(apart_by(smooth[t][k], up(together[line])), kFewRoundings));
      at_ridge += line == 2;
    }
  }
  EXPECT_GT(at_ridge, 6);
  // A cube's corner as the end of a crease: with one face turned away it is one edge of three that is too sharp.
  Mesh corner{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0.2, 1}, {-1, 0, 0.1}},
              {{0, 1, 2}, {0, 2, 4}, {0, 4, 3}, {0, 3, 1}}};
  const auto facets = facet_normals(corner);
  double sharpest = 0;
  std::vector<double> bends;
  for (std::size_t t = 0; t < 4; ++t) {
    bends.push_back(std::acos(facets[t].dot(facets[(t + 1) % 4])));
    sharpest = std::max(sharpest, bends.back());
  }
  const auto ends = corner_normals(corner, NormalWeight::angle, sharpest - 1e-6);
  for (std::size_t t = 1; t < 4; ++t) EXPECT_TRUE(within(apart_by(ends[t][0], ends[0][0]), kFewRoundings));
}

// CLAIM      IU.3.2.1b: figure 19: on a zig-zag strip all averaged normals inside are parallel, so that it is shaded as if it were
//            flat; narrow polygons along its ridges mend that.
// ORACLE     exact: by symmetry the averages point straight up; with further polygons they lean to either side.
// TOLERANCE  40 u.
TEST(VertexNormals, OfAZigZagAreParallel) {
  proves({"IU.3.2.1b"}, Oracle::closed_form, "the symmetry of the zig-zag");
  std::vector<Vec2> plain, mended;
  for (int i = 0; i < 9; ++i) {
    plain.emplace_back(0.5 * i, 0.25 * (i % 2));
    const double turn = i % 2 ? -0.03 : 0.03;
    mended.emplace_back(0.5 * i - 0.06, 0.25 * (i % 2) + turn);
    mended.emplace_back(0.5 * i + 0.06, 0.25 * (i % 2) + turn);
  }
  for (const NormalWeight weight : kAllWeights) {
    const Mesh strip = folded(plain), better = folded(mended);
    const auto normals = corner_normals(strip, weight, kPi), leaning = corner_normals(better, weight, kPi);
    for (std::size_t t = 0; t < strip.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = strip.triangles[t][k];
        const bool inside = vertex / 3 > 0 && vertex / 3 < 8 && (weight == NormalWeight::angle || vertex % 3 == 1);
        if (!inside) continue;
        EXPECT_TRUE(within(apart_by(normals[t][k], Vec3::UnitZ()), kFewRoundings));
      }
    }
    double least = 1;
    for (std::size_t t = 4; t + 4 < better.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) least = std::min(least, std::abs(leaning[t][k].x()));
    }
    EXPECT_TRUE(apart(least, 0, 0.1));
  }
}

// CLAIM      What has no normal is left alone, what is no mesh or no angle refused.
// ORACLE     identity: one broken rule each.
// TOLERANCE  none.
TEST(VertexNormals, RefuseWhatHasNone) {
  proves({}, Oracle::identity, "one broken rule each");
  const Mesh fin{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}, {0, 0, 1}}};
  const auto normals = corner_normals(fin, NormalWeight::equal, kPi);
  EXPECT_TRUE(within(apart_by(normals[0][0], Vec3::UnitZ()), 0));
  EXPECT_TRUE(within(apart_by(normals[1][0], -Vec3::UnitZ()), 0));
  EXPECT_TRUE(within(normals[2][0].norm(), 0));
  EXPECT_TRUE(refuses([&] { return corner_normals(fin, NormalWeight::equal, 4); }));
  EXPECT_TRUE(refuses([&] { return corner_normals(fin, NormalWeight::equal, -1); }));
  const Mesh broken{{{0, 0, 0}}, {{0, 1, 2}}};
  EXPECT_TRUE(refuses([&] { return facet_normals(broken); }));
}

// CLAIM      IU.3.2a: vertices that are given twice, or once for each triangle, make no edge.
// ORACLE     metamorphic: the same mesh with vertices of its own for each triangle, zeros of either sign among them.
// TOLERANCE  none.
TEST(VertexNormals, DoNotAskHowOftenAVertexIsGiven) {
  proves({"IU.3.2a", "IU.3.2.1a"}, Oracle::metamorphic,
         "a hilly net, smooth and with creases, and its triangles one by one");
  Mesh net, apart;
  for (std::uint32_t j = 0; j < 9; ++j) {
    for (std::uint32_t i = 0; i < 9; ++i) {
      const double x = 0.25 * i - 1, y = 0.25 * j - 1;
      net.vertices.emplace_back(x, y, std::sin(3 * x) * std::cos(2 * y));
      if (i == 8 || j == 8) continue;
      const std::uint32_t a = 9 * j + i;
      net.triangles.push_back({a, a + 1, a + 10});
      net.triangles.push_back({a, a + 10, a + 9});
    }
  }
  for (std::uint32_t t = 0; t < net.triangles.size(); ++t) {
    for (const std::uint32_t end : net.triangles[t]) {
      Vec3 vertex = net.vertices[end];
      for (double& x : vertex) x = x == 0 && t % 2 == 0 ? -0.0 : x;
      apart.vertices.push_back(vertex);
    }
    apart.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  std::uint64_t wrong = 0, bent = 0;
  for (const double crease : {0.3, std::numbers::pi}) {
    const auto once = corner_normals(net, NormalWeight::angle, crease);
    const auto often = corner_normals(apart, NormalWeight::angle, crease);
    const auto facets = facet_normals(net);
    for (std::size_t t = 0; t < once.size(); ++t) {
      wrong += once[t] != often[t] ? 1u : 0u;
      bent += once[t][0] != facets[t] ? 1u : 0u;
    }
  }
  EXPECT_TRUE(all_agree(wrong, 256));
  EXPECT_GT(bent, 200u) << "normals are averages";
}

}  // namespace
}  // namespace etendue::validation
