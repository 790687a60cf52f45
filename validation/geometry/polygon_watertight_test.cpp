// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <vector>

#include "etendue/geometry/polygon.hpp"
#include "geometry/families.hpp"
#include "support/evidence.hpp"
#include "support/long_run.hpp"

namespace etendue::validation {
namespace {

std::uint64_t rays() {
  return long_run(100'000);
}
constexpr double kFarAway = 2.7e5;

// A prism over an L: eight polygons, two of them concave, that share edges and corners and nothing else.
constexpr std::size_t kCorners = 6;
constexpr std::array<std::array<double, 2>, kCorners> kBase{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}};

struct Prism {
  std::vector<Vec3> low, high;
  std::vector<Polygon> faces;
};

Prism prism(const Mat3& rotation, const Vec3& offset) {
  Prism solid;
  for (const auto& corner : kBase) {
    solid.low.push_back(rotation * Vec3(corner[0], corner[1], -1) + offset);
    solid.high.push_back(rotation * Vec3(corner[0], corner[1], 1) + offset);
  }
  std::vector<std::vector<Vec3>> chains{{solid.low.rbegin(), solid.low.rend()}, solid.high};
  for (std::size_t i = 0; i < kCorners; ++i) {
    const std::size_t j = (i + 1) % kCorners;
    chains.push_back({solid.low[i], solid.low[j], solid.high[j], solid.high[i]});
  }
  for (auto& chain : chains) {
    auto polygon = Polygon::make(std::move(chain));
    EXPECT_TRUE(polygon) << polygon.error().message;
    if (polygon) solid.faces.push_back(*polygon);
  }
  return solid;
}

// The ends of one of the 18 edges.
std::array<Vec3, 2> edge(const Prism& solid, std::size_t index) {
  const std::size_t i = index % kCorners, j = (i + 1) % kCorners;
  if (index < kCorners) return {solid.low[i], solid.low[j]};
  if (index < 2 * kCorners) return {solid.high[i], solid.high[j]};
  return {solid.low[i], solid.high[i]};
}

// Rays from the L's thick corner, which sees every edge but those behind the notch, that leave without a hit.
std::uint64_t cracks(const Vec3& offset, bool at_vertices, std::uint64_t seed) {
  constexpr std::uint64_t kFrames = 20;
  Random random(seed);
  std::uint64_t missed = 0;
  for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
    const Mat3 rotation = random.rotation();
    const Prism solid = prism(rotation, rotation * offset);
    const std::uint64_t rays_of_frame = rays() / kFrames;
    for (std::uint64_t i = 0; i < rays_of_frame; ++i) {
      share_done(frame * rays_of_frame + i, rays());
      const auto ends = edge(solid, random.index(3 * kCorners));
      Ray ray;
      ray.origin = rotation * (offset + Vec3(0.5, 0.5, 0)) + random.in_cube(0.25);
      const Vec3 a = ends[0] - ray.origin, b = ends[1] - ray.origin;
      ray.direction = at_vertices ? a : Vec3(a + random.uniform(0, 1) * (b - a));
      bool hit = false;
      for (const Polygon& face : solid.faces) hit = hit || intersect(ray, face).has_value();
      missed += !hit;
    }
  }
  return missed;
}

// CLAIM      IU.5.6.2: no ray slips between polygons that share an edge or a vertex, convex or concave.
// ORACLE     topology: a ray from inside a closed surface leaves it through a polygon.
// TOLERANCE  none: 0 of 10⁵ rays in each of four families, in random frames.
TEST(Polygon, LetsNoRayThroughACommonEdgeOrVertex) {
  proves({"IU.5.6.2", "IU.5.0"}, Oracle::identity, "a ray from inside a closed surface meets it");
  EXPECT_TRUE(all_agree(cracks(Vec3::Zero(), false, 611), rays()));
  EXPECT_TRUE(all_agree(cracks(Vec3::Zero(), true, 612), rays()));
  EXPECT_TRUE(all_agree(cracks({kFarAway, 0, 0}, false, 613), rays()));
  EXPECT_TRUE(all_agree(cracks({kFarAway, 0, 0}, true, 614), rays()));
}

// CLAIM      IU.5.6.2: the same where every number is exact and the frame is turned: a cube around the origin seen along
//            its own face diagonals.
// ORACLE     topology, as above.
// TOLERANCE  none.
TEST(Polygon, LetsNoRayThroughTheEdgesOfACube) {
  proves({"IU.5.6.2"}, Oracle::identity, "a ray from inside a closed surface meets it");
  std::vector<Polygon> faces;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      std::vector<Vec3> chain;
      for (const auto& [u, v] : std::vector<std::pair<double, double>>{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        Vec3 corner;
        corner[axis] = side;
        corner[(axis + 1) % 3] = u;
        corner[(axis + 2) % 3] = v * side;
        chain.push_back(corner);
      }
      faces.push_back(*Polygon::make(chain));
    }
  }
  std::uint64_t missed = 0, rays = 0;
  for (int x = -4; x <= 4; ++x) {
    for (int y = -4; y <= 4; ++y) {
      for (int z = -4; z <= 4; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        Ray ray;
        ray.direction = Vec3(x, y, z);
        int hits = 0;
        for (const Polygon& face : faces) hits += intersect(ray, face).has_value();
        ++rays;
        missed += hits == 0;
      }
    }
  }
  EXPECT_TRUE(all_agree(missed, rays));
}

}  // namespace
}  // namespace etendue::validation
