// SPDX-License-Identifier: Apache-2.0
// Form factors past blockers: single pairs, and rows of a furnished room whose sums must be one.
#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "etendue/assembly/sight.hpp"
#include "etendue/form_factor/obstructed.hpp"
#include "etendue/form_factor/polygon_polygon.hpp"

namespace {

using etendue::ElementMesh;
using etendue::Polygon;
using etendue::Vec3;

/// A box seen from outside or, as a room, from inside, each face cut n × n.
void add_box(ElementMesh& mesh, const Vec3& low, const Vec3& size, int n, bool inside) {
  const Vec3 x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z()), o = low, e = low + size;
  const std::array<std::array<Vec3, 3>, 6> faces{
      {{o, y, x}, {e, -x, -y}, {o, z, y}, {e, -y, -z}, {o, x, z}, {e, -z, -x}}};
  const std::size_t object = mesh.faces.empty() ? 0 : mesh.faces.back().object + 1;
  for (const auto& [corner, first, second] : faces) {
    const Vec3 a = inside ? second : first, b = inside ? first : second;
    const Vec3 near = corner, along = a, up = b;
    // The corners of faces that meet must be the same doubles: both are sums of the box's own two corners.
    const auto snap = [&](const Vec3& p) {
      Vec3 q = p;
      for (int k = 0; k < 3; ++k) q(k) = std::abs(p(k) - o(k)) < std::abs(p(k) - e(k)) ? o(k) : e(k);
      return q;
    };
    mesh.faces.push_back(
        {Polygon::make({near, snap(near + along), snap(near + along + up), snap(near + up)}).value(), object, 0});
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const auto at = [&](int k, int l) { return Vec3(near + along * (k / double(n)) + up * (l / double(n))); };
        mesh.elements.push_back({Polygon::make({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}).value(),
                                 mesh.faces.size() - 1, 0});
      }
    }
  }
}

/// A room with a column from floor to ceiling, a table (top and four legs) and a floating cube.
ElementMesh furnished_room(int n) {
  ElementMesh mesh;
  add_box(mesh, {0, 0, 0}, {5, 4, 3}, n, true);
  add_box(mesh, {1, 2.5, 0}, {0.4, 0.4, 3}, std::max(1, n / 4), false);
  add_box(mesh, {2.5, 1, 0.7}, {1.5, 0.8, 0.05}, std::max(1, n / 4), false);
  for (double x : {2.55, 3.85}) {
    for (double y : {1.05, 1.65}) add_box(mesh, {x, y, 0}, {0.1, 0.1, 0.7}, 1, false);
  }
  add_box(mesh, {3.5, 2.8, 1.5}, {0.6, 0.6, 0.6}, std::max(1, n / 6), false);
  return mesh;
}

/// Whether furniture stands on a part of the element: what it covers sees nothing, and the row's sum is not one.
bool partly_covered(const ElementMesh& mesh, std::size_t i) {
  constexpr double kInPlane = 1e-12;
  const Polygon& element = mesh.elements[i].polygon;
  const Eigen::AlignedBox3d own = [&] {
    Eigen::AlignedBox3d box;
    for (const Vec3& v : element.vertices()) box.extend(v);
    return box;
  }();
  for (const etendue::Face& face : mesh.faces) {
    if (face.object == mesh.face_of(mesh.elements[i]).object) continue;
    Eigen::AlignedBox3d box;
    double off = 0;
    for (const Vec3& v : face.polygon.vertices()) {
      box.extend(v);
      off = std::max(off, std::abs(element.normal().dot(v - element.centroid())));
    }
    if (off < kInPlane && own.intersects(box)) return true;
  }
  return false;
}

struct RowSum {
  double value = 0, bound = 0;
  std::size_t clear = 0, partial = 0, evaluations = 0;
};

/// A row whose bounds add up to `asked`: half of it for the pairs past blockers, each the same share.
RowSum row_sum(const ElementMesh& mesh, const etendue::SightMap& sights, std::size_t i, double asked) {
  RowSum sum;
  const Polygon& from = mesh.elements[i].polygon;
  std::vector<std::pair<std::size_t, etendue::SightLine>> partial;
  for (std::size_t j = 0; j < mesh.elements.size(); ++j) {
    if (i == j) continue;
    etendue::SightLine line = sights.between(i, j);
    if (line.sight == etendue::PairSight::undecided) partial.emplace_back(j, std::move(line));
    if (line.sight != etendue::PairSight::clear) continue;
    const etendue::Bounded f = etendue::form_factor(from, mesh.elements[j].polygon, {0.1 * asked, 0});
    sum.value += f.value;
    sum.bound += f.bound;
    ++sum.clear;
  }
  sum.partial = partial.size();
  for (const auto& [j, line] : partial) {
    const double share = asked / (2 * static_cast<double>(partial.size()));
    const auto f = etendue::obstructed_form_factor(from, mesh.elements[j].polygon, line.bodies, {0, share});
    sum.evaluations += static_cast<std::size_t>(f.evaluations);
    sum.value += f.value;
    sum.bound += f.bound;
  }
  return sum;
}

/// Every 211th row of the room, its sum right to 10^-digits: `row_bound` is what the bounds add up to, `row_defect` what
/// the sum of an uncovered element misses one by. `full_matrix_s` is what half of all rows would take.
void rows_of_a_furnished_room(benchmark::State& state) {
  const ElementMesh mesh = furnished_room(static_cast<int>(state.range(0)));
  const etendue::SightMap sights(mesh);
  const double asked = std::pow(10.0, -static_cast<double>(state.range(1)));
  double defect = 0, bound = 0;
  std::size_t rows = 0, partial = 0, clear = 0, evaluations = 0;
  for (auto _ : state) {
    for (std::size_t i = 0; i < mesh.elements.size(); i += 211) {
      const RowSum sum = row_sum(mesh, sights, i, asked);
      if (sum.value == 0) continue;  // under a box
      if (!partly_covered(mesh, i)) defect = std::max(defect, std::abs(1 - sum.value));
      bound = std::max(bound, sum.bound);
      partial += sum.partial;
      clear += sum.clear;
      evaluations += sum.evaluations;
      ++rows;
    }
  }
  const auto n = static_cast<double>(rows);
  state.counters["elements"] = static_cast<double>(mesh.elements.size());
  state.counters["row_defect"] = defect;
  state.counters["row_bound"] = bound;
  state.counters["partial_a_row"] = static_cast<double>(partial) / n;
  state.counters["clear_a_row"] = static_cast<double>(clear) / n;
  state.counters["points_a_partial"] = static_cast<double>(evaluations) / static_cast<double>(partial);
  state.counters["full_matrix_s"] = benchmark::Counter(2 * n / static_cast<double>(mesh.elements.size()),
                                                       benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

BENCHMARK(rows_of_a_furnished_room)->ArgsProduct({{22}, {4, 6}})->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
