// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <functional>
#include <map>

#include "refinement/penumbra.hpp"
#include "support/evidence.hpp"
#include "support/exhibit.hpp"

namespace etendue::validation {
namespace {

using Field = std::function<double(double x, double y)>;

/// Points along a side of the floor at which errors are taken: the middles of a grid that every mesh here divides.
constexpr int kPoints = 96;

double mean_over_floor(const Field& field) {
  double sum = 0;
  for (int b = 0; b < kPoints; ++b) {
    for (int a = 0; a < kPoints; ++a) sum += field((a + 0.5) / kPoints, (b + 0.5) / kPoints);
  }
  return sum / (kPoints * kPoints);
}

double square_of_gradient(const Field& field, double x, double y) {
  constexpr double kStep = 0x1p-17;  // a third of the digits: differences are good to ten
  const double dx = field(x + kStep, y) - field(x - kStep, y), dy = field(x, y + kStep) - field(x, y - kStep);
  return (dx * dx + dy * dy) / (4 * kStep * kStep);
}

/// Mean square of (constant radiosities on the floor's elements − truth).
double square_error(const Scene& scene, const AdaptiveSolution& solution, const Field& truth) {
  const auto values = radiosities(scene, solution.model, emissions_of(scene, solution.model), solution.state);
  const auto& elements = solution.model.elements.elements;
  return mean_over_floor([&](double x, double y) {
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (elements[k].face != 0) continue;
      Vec3 low = elements[k].polygon.vertices()[0], high = low;
      for (const Vec3& v : elements[k].polygon.vertices()) {
        low = low.cwiseMin(v);
        high = high.cwiseMax(v);
      }
      if (x < low.x() || x >= high.x() || y < low.y() || y >= high.y()) continue;
      const double error = values[k](0) - truth(x, y);
      return error * error;
    }
    return std::numeric_limits<double>::quiet_NaN();  // no element there: near() refuses it
  });
}

/// Nothing is divided further.
AdaptiveSolution solved(const Scene& scene) {
  return adapted(scene, {1e9, 0, 100'000});
}

// CLAIM      IU.6.6, IU.6-7: on what is smooth, constant elements err with order one: by h √(mean |∇B|²/12), which is what the best
//            constants leave, and no more.
// ORACLE     closed form: a lamp's radiosity on a floor, and its gradient; the variance of a linear function over a square.
// TOLERANCE  h² of it: the next term, the curvature's share, at a lamp two sides away; taken at m × m points of a square the
//            variance is (1 − 1/m²) h²/12 |∇B|², exactly.
TEST(Convergence, IsOfOrderOneWhereRadiosityIsSmooth) {
  proves({"IU.6-7", "IU.6.6"}, Oracle::closed_form, "h² mean |∇B|²/12 of a lamp's light");
  Penumbra penumbra;
  penumbra.plate = {-3, -2, -3, -2};  // hides nothing
  const Field truth = [&](double x, double y) { return penumbra.radiosity(x, y); };
  const double gradient = mean_over_floor([&](double x, double y) { return square_of_gradient(truth, x, y); });
  std::map<int, double> error;
  for (const int cells : {4, 8, 16}) {
    Scene scene = penumbra.scene(cells);
    scene.objects.pop_back();  // the plate
    const double h = 1.0 / cells, m = kPoints * h;
    error[cells] = std::sqrt(square_error(scene, solved(scene), truth) / (1 - 1 / (m * m)));
    EXPECT_TRUE(near(error[cells], h * std::sqrt(gradient / 12), h * h * error[cells])) << cells;
  }
  EXPECT_TRUE(near(std::log2(error[4] / error[8]), 1, 1.0 / 16));
  EXPECT_TRUE(near(std::log2(error[8] / error[16]), 1, 1.0 / 64));
  exhibit(Convergence{"Constant elements under a lamp, where nothing hides it",
                      "h, an element's side",
                      {0.25, 0.125, 0.0625},
                      {error[4], error[8], error[16]},
                      1,
                      (1.0 / 16 + 1.0 / 64) / 2});
}

// CLAIM      IU.6.5.1, IU.6.6: where a partition stands on elements, their error has order one half, √(h θ(1 − θ) ∫ J² dy) for a jump
//            J at the share θ of an element; the same elements cut along its foot have order one again.
// ORACLE     closed form: the lamp's light on the one side of a partition that is as high as the lamp, none on the other; the
//            variance of a step. At a third of the side, θ is one or two thirds for any power of two.
// TOLERANCE  h relatively, of the square: the order that both leave out next, elements of other widths along the foot, is higher by
//            a half at least.
TEST(Convergence, IsOfOrderOneHalfAcrossAPartitionAndOneAlongIt) {
  proves({"IU.6.5.1", "IU.6.6"}, Oracle::closed_form, "h θ(1 − θ) ∫ J² dy + h²/12 ∫ |∇B|²");
  Penumbra penumbra;
  penumbra.lamp = {0.5, 0.9, 0.25, 0.75};
  penumbra.plate = {-3, -2, -3, -2};
  const Field lit = [&](double x, double y) { return penumbra.radiosity(x, y); };
  const Field truth = [&](double x, double y) { return x < 1.0 / 3 ? 0 : lit(x, y); };
  const double smooth =
      mean_over_floor([&](double x, double y) { return x < 1.0 / 3 ? 0 : square_of_gradient(lit, x, y); });
  const double jump = mean_over_floor([&](double, double y) { return lit(1.0 / 3, y) * lit(1.0 / 3, y); });
  std::map<int, double> across, along;
  for (const int cells : {4, 8, 16}) {
    Scene scene = penumbra.scene(cells);
    const double x = 1.0 / 3;
    scene.objects.back() = {"partition", quadrilateral({x, -1, 0}, {x, 2, 0}, {x, 2, 2}, {x, -1, 2}), 1, {}};
    const double h = 1.0 / cells, m = kPoints * h, smooth_part = h * h / 12 * (1 - 1 / (m * m)) * smooth;
    across[cells] = square_error(scene, solved(scene), truth);
    EXPECT_TRUE(near(across[cells], h * 2 / 9 * jump + smooth_part, h * across[cells])) << cells;
    scene.align_mesh = true;
    along[cells] = square_error(scene, solved(scene), truth);
    EXPECT_TRUE(near(along[cells], smooth_part, h * along[cells])) << cells;
  }
  EXPECT_TRUE(near(std::log2(across[4] / across[16]) / 4, 0.5, 0.05));
  EXPECT_TRUE(near(std::log2(along[4] / along[16]) / 4, 1, 0.05));
  const auto curve = [](const char* title, std::map<int, double>& squares, double slope) {
    return Convergence{title,
                       "h, an element's side",
                       {0.25, 0.125, 0.0625},
                       {std::sqrt(squares[4]), std::sqrt(squares[8]), std::sqrt(squares[16])},
                       slope,
                       0.05};
  };
  exhibit(curve("A partition across elements", across, 0.5));
  exhibit(curve("The same elements cut along its foot", along, 1));
}

// CLAIM      IU.6.7.2, IU.6.5.1: elements that were cut along the foot of a partition are quartered like others: quartered everywhere
//            until sides are h, a cut mesh errs like one that begins with sides of h.
// ORACLE     closed form: h √(mean |∇B|²/12) on the lit side, as above.
// TOLERANCE  relatively the side of the coarse elements: pieces along the foot are narrower, those of the fine mesh other ones.
TEST(Convergence, IsThatOfTheFineMeshWhereCutElementsAreQuartered) {
  proves({"IU.6.7.2", "IU.6.5.1"}, Oracle::closed_form, "h² mean |∇B|²/12 on the lit side");
  Penumbra penumbra;
  penumbra.lamp = {0.5, 0.9, 0.25, 0.75};
  penumbra.plate = {-3, -2, -3, -2};
  const Field truth = [&](double x, double y) { return x < 1.0 / 3 ? 0 : penumbra.radiosity(x, y); };
  const double smooth = mean_over_floor([&](double x, double y) {
    return x < 1.0 / 3 ? 0 : square_of_gradient([&](double a, double b) { return penumbra.radiosity(a, b); }, x, y);
  });
  Scene scene = penumbra.scene(4);
  const double x = 1.0 / 3;
  scene.objects.back() = {"partition", quadrilateral({x, -1, 0}, {x, 2, 0}, {x, 2, 2}, {x, -1, 2}), 1, {}};
  scene.align_mesh = true;
  for (const int levels : {1, 2}) {
    // Any difference is too much: all of the lit side is quartered, on the dark side nothing.
    const double h = 0.25 / (1 << levels), m = kPoints * h;
    const double square = square_error(scene, adapted(scene, {1e-7, levels, 100'000}), truth);
    EXPECT_TRUE(near(std::sqrt(square), h * std::sqrt(smooth / 12 * (1 - 1 / (m * m))), 0.25 * std::sqrt(square)));
  }
}

// CLAIM      IU.6.7.2: elements that are quartered keep the grading of their face: after any number of halvings their sides lie on the
//            lines that so many more rows and columns would have.
// ORACLE     closed form: line k of n at (1 − g) u + g (1 − cos πu)/2, u = k/n, written out here.
// TOLERANCE  four roundings of one: a cosine, two products and a corner of the unit square.
TEST(AdaptiveMesh, KeepsTheGradingOfAFace) {
  proves({"IU.6.7.2"}, Oracle::closed_form, "the lines of a graded division");
  const Penumbra penumbra;
  Scene scene = penumbra.scene(8);
  scene.objects[0].subdivision.grading = 0.625;
  const AdaptiveSolution solution = adapted(scene, {0.08, 2, 100'000});
  std::map<int, int> levels;
  double area = 0;
  for (std::size_t k = 0; k < solution.mesh.cells.size(); ++k) {
    const MeshCell& cell = solution.mesh.cells[k];
    if (cell.face != 0) continue;
    const auto line = [&](std::int64_t at) {
      const double u = static_cast<double>(at) / (8 << cell.level);
      return 0.375 * u + 0.625 * (1 - std::cos(std::numbers::pi * u)) / 2;
    };
    const auto& v = solution.model.elements.elements[k].polygon.vertices();
    EXPECT_TRUE(within(std::max((v[0] - Vec3(line(cell.a), line(cell.b), 0)).norm(),
                                (v[2] - Vec3(line(cell.a + 1), line(cell.b + 1), 0)).norm()),
                       4 * 0x1p-53));
    area += (v[2].x() - v[0].x()) * (v[2].y() - v[0].y());
    ++levels[cell.level];
  }
  EXPECT_TRUE(near(area, 1, 0x1p-40));
  EXPECT_TRUE(holds(levels[0] > 0 && levels[1] > 0 && levels[2] > 16));
}

}  // namespace
}  // namespace etendue::validation
