// SPDX-License-Identifier: Apache-2.0
#include "etendue/meshing/quadric_net.hpp"

#include <cmath>
#include <map>
#include <numbers>

#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

Quadric ellipsoid() {
  Quadric q;
  q.box = {{3, -2, 1}, Eigen::AngleAxisd(0.7, Vec3(1, 2, 2) / 3).toRotationMatrix(), {1.2, 1.7, 2.3}};
  const Vec3 inverse(1, 1 / 1.5, 1 / 2.0);
  q.square = q.box.axes * inverse.cwiseProduct(inverse).asDiagonal() * q.box.axes.transpose();
  return q;
}

double value(const Quadric& q, const Vec3& point) {
  const Vec3 y = point - q.box.centre;
  return y.dot(q.square * y) + 2 * q.linear.dot(y) + q.constant;
}

/// How often each edge is passed in each direction: once each way around a closed surface.
std::uint64_t open_edges(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> passed;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++passed[{t[k], t[(k + 1) % 3]}];
  }
  std::uint64_t open = 0;
  for (const auto& [edge, times] : passed) {
    const auto back = passed.find({edge.second, edge.first});
    open += times != 1 || back == passed.end() || back->second != 1;
  }
  return open;
}

double volume(const Mesh& mesh, const Vec3& centre) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle part = mesh.triangle(t);
    sum += (part.a - centre).dot((part.b - centre).cross(part.c - centre)) / 6;
  }
  return sum;
}

// CLAIM      The net of an ellipsoid has its corners on it, is closed, wound outward, of one piece without holes, and its volume comes
//            near the ellipsoid's as the square of the cells' size.
// ORACLE     closed form: f = 0; 4π abc/3; Euler's characteristic 2.
// TOLERANCE  1e-14 of f, which sums terms of 1 to 9; order 2 ± 0.2 of the volume's error from 12 to 48 cells, whose next term is a
//            quarter of a percent of it.
TEST(QuadricNet, ClosesAnEllipsoid) {
  proves({}, Oracle::closed_form, "f = 0; 4π abc/3; Euler's characteristic");
  const Quadric q = ellipsoid();
  const double truth = 4 * std::numbers::pi / 3 * 1 * 1.5 * 2;
  double last = 0;
  for (const int cells : {12, 24, 48}) {
    const Mesh net = quadric_net(q, cells);
    for (const Vec3& corner : net.vertices) EXPECT_TRUE(within(std::abs(value(q, corner)), 1e-14));
    EXPECT_TRUE(all_agree(open_edges(net), 3 * net.triangles.size()));
    const auto edges = 3 * net.triangles.size() / 2;
    EXPECT_TRUE(holds(net.vertices.size() + net.triangles.size() == edges + 2));
    const double missing = truth - volume(net, q.box.centre);
    EXPECT_TRUE(holds(missing > 0)) << "convex: the net lies within";
    if (last > 0) {
      EXPECT_TRUE(near(std::log2(last / missing), 2, 0.2)) << cells;
    }
    last = missing;
  }
}

// CLAIM      What the box cuts off is open at its faces and nowhere else: a hyperboloid of one sheet has corners of open edges there only; of
//            a saddle, whose f has no square along its axis, corners lie on it as well.
// ORACLE     identity: f = 0, the largest coordinate along the box's axes.
// TOLERANCE  1e-14 of f; 1e-15 of the box's half edges.
TEST(QuadricNet, IsOpenAtTheBoxOnly) {
  proves({}, Oracle::identity, "coordinates of open edges");
  Quadric sheet, saddle;
  sheet.square = Vec3(1, 1, -0.5).asDiagonal();
  sheet.constant = -0.3;
  saddle.square = Vec3(1, -1, 0).asDiagonal();
  saddle.linear = {0, 0, -0.5};
  saddle.constant = 0.1;
  for (Quadric* q : {&sheet, &saddle}) {
    q->box = {{0, 0, 0}, Mat3::Identity(), {1, 1, 1}};
    const Mesh net = quadric_net(*q, 17);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> passed;
    for (const auto& t : net.triangles) {
      for (std::size_t k = 0; k < 3; ++k) ++passed[std::minmax(t[k], t[(k + 1) % 3])];
    }
    std::uint64_t wrong = 0, open = 0;
    for (const auto& [edge, times] : passed) {
      if (times == 2) continue;
      ++open;
      const Vec3 middle = (net.vertices[edge.first] + net.vertices[edge.second]) / 2;
      wrong += times != 1 || std::abs(middle.cwiseAbs().maxCoeff() - 1) > 1e-15;
    }
    EXPECT_TRUE(all_agree(wrong, open));
    for (const Vec3& corner : net.vertices) EXPECT_TRUE(within(std::abs(value(*q, corner)), 1e-14));
  }
}

}  // namespace
}  // namespace etendue::validation
