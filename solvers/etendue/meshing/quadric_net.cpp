// SPDX-License-Identifier: Apache-2.0
#include "etendue/meshing/quadric_net.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

/// A quadric over a grid of its box, and the net that grows on it.
class Marcher {
 public:
  Marcher(const Quadric& quadric, int cells)
      : quadric_(quadric), square_((quadric.square + quadric.square.transpose()) / 2), cells_(cells) {
    for (int k = 0; k <= cells; ++k) {
      for (int j = 0; j <= cells; ++j) {
        for (int i = 0; i <= cells; ++i) values_.push_back(value(offset(number(i, j, k))));
      }
    }
  }

  Mesh net() {
    // The six ways from a cell's first corner to its last along three edges: each way's corners are a tetrahedron.
    constexpr std::array<std::array<int, 3>, 6> kWays{
        {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
    for (int k = 0; k < cells_; ++k) {
      for (int j = 0; j < cells_; ++j) {
        for (int i = 0; i < cells_; ++i) {
          for (const auto& way : kWays) {
            std::array<int, 3> at{i, j, k};
            std::array<std::size_t, 4> corners{number(i, j, k)};
            for (std::size_t step = 0; step < 3; ++step) {
              ++at[static_cast<std::size_t>(way[step])];
              corners[step + 1] = number(at[0], at[1], at[2]);
            }
            cut(corners);
          }
        }
      }
    }
    return std::move(mesh_);
  }

 private:
  std::size_t number(int i, int j, int k) const {
    const auto n = static_cast<std::size_t>(cells_ + 1);
    return (static_cast<std::size_t>(k) * n + static_cast<std::size_t>(j)) * n + static_cast<std::size_t>(i);
  }

  /// From the box's centre to a corner of the grid.
  Vec3 offset(std::size_t corner) const {
    const auto n = static_cast<std::size_t>(cells_ + 1);
    const auto share = [&](std::size_t i) { return 2 * static_cast<double>(i) / cells_ - 1; };
    const Vec3 shares(share(corner % n), share(corner / n % n), share(corner / n / n));
    return quadric_.box.axes * shares.cwiseProduct(quadric_.box.half_edges);
  }

  double value(const Vec3& y) const { return y.dot(square_ * y) + 2 * quadric_.linear.dot(y) + quadric_.constant; }

  bool is_outside(std::size_t corner) const { return values_[corner] >= 0; }

  /// The corner of the net on an edge of the grid, on which f changes its sign.
  std::uint32_t on_edge(std::size_t a, std::size_t b) {
    const std::pair edge = std::minmax(a, b);
    const auto [found, is_new] = corners_.emplace(edge, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back(root(edge.first, edge.second));
    return found->second;
  }

  /// f(a + t d) = A t² + 2 B t + C with C and A + 2 B + C on both sides of 0: one root in [0, 1].
  Vec3 root(std::size_t a, std::size_t b) const {
    const Vec3 from = offset(a), way = offset(b) - from;
    const double A = way.dot(square_ * way), B = way.dot(square_ * from) + quadric_.linear.dot(way), C = values_[a];
    const double q = -(B + std::copysign(std::sqrt(std::max(0.0, B * B - A * C)), B));
    const double first = q != 0 ? C / q : 0, second = A != 0 ? q / A : first;
    const bool is_first = std::abs(first - 0.5) <= std::abs(second - 0.5);
    return quadric_.box.centre + from + std::clamp(is_first ? first : second, 0.0, 1.0) * way;
  }

  /// Are the edges from corner `a` to the others right-handed? The net's own triangles may be too thin to tell inside from out.
  bool is_right_handed(std::size_t a, std::size_t b, std::size_t c, std::size_t d) const {
    const Vec3 from = offset(a);
    return (offset(b) - from).cross(offset(c) - from).dot(offset(d) - from) > 0;
  }

  void cut(const std::array<std::size_t, 4>& corners) {
    std::vector<std::size_t> in, out;
    for (const std::size_t corner : corners) (is_outside(corner) ? out : in).push_back(corner);
    if (in.empty() || out.empty()) return;
    if (in.size() == 2) {
      if (!is_right_handed(in[0], in[1], out[0], out[1])) std::swap(out[0], out[1]);
      const std::uint32_t a = on_edge(in[0], out[0]), b = on_edge(in[0], out[1]);
      const std::uint32_t c = on_edge(in[1], out[1]), d = on_edge(in[1], out[0]);
      mesh_.triangles.push_back({a, b, c});
      mesh_.triangles.push_back({a, c, d});
      return;
    }
    const std::size_t one = in.size() == 1 ? in[0] : out[0];
    auto& three = in.size() == 1 ? out : in;
    const bool away =
        is_right_handed(one, three[0], three[1], three[2]);  // from `one` the triangle below then looks away
    if (away != (in.size() == 1)) std::swap(three[1], three[2]);
    mesh_.triangles.push_back({on_edge(one, three[0]), on_edge(one, three[1]), on_edge(one, three[2])});
  }

  const Quadric& quadric_;
  Mat3 square_;
  int cells_;
  std::vector<double> values_;  // of f at the grid's corners
  std::map<std::pair<std::size_t, std::size_t>, std::uint32_t> corners_;
  Mesh mesh_;
};

}  // namespace

Mesh quadric_net(const Quadric& quadric, int cells) {
  require(cells >= 1, "quadric_net: at least one cell");
  return Marcher(quadric, cells).net();
}

}  // namespace etendue
