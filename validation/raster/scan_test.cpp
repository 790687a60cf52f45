// SPDX-License-Identifier: Apache-2.0
#include "etendue/raster/scan.hpp"

#include <CGAL/Gmpq.h>

#include <bit>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "etendue/raster/gouraud.hpp"
#include "support/evidence.hpp"

namespace etendue::validation {
namespace {

using Rational = CGAL::Gmpq;
constexpr int kSide = 16;

// Corners on the subpixel grid: where scan() decides exactly. Every third lies on a pixel centre or in its row or
// column.
Vec2 grid_point(std::mt19937_64& random) {
  const auto coordinate = [&] {
    const auto fine = static_cast<double>(random() % (kSide * 4096)) / 4096;
    return random() % 3 == 0 ? std::floor(fine) + 0.5 : fine;
  };
  const double x = coordinate();
  return {x, coordinate()};
}

// Sign of twice the area of a, b, c in rationals.
int turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Rational value = (Rational(b.x()) - Rational(a.x())) * (Rational(c.y()) - Rational(a.y())) -
                         (Rational(b.y()) - Rational(a.y())) * (Rational(c.x()) - Rational(a.x()));
  return CGAL::sign(value);
}

struct Counts {
  std::vector<int> times = std::vector<int>(kSide * kSide, 0);
  void draw(const Vec2& a, const Vec2& b, const Vec2& c) {
    scan({a, b, c}, kSide, kSide,
         [&](const Covered& p) { ++times[static_cast<std::size_t>(p.row * kSide + p.column)]; });
  }
};

// CLAIM      Scan conversion: centres strictly inside a triangle are covered once, those outside never.
// ORACLE     exact arithmetic: signs of areas in rationals.
// TOLERANCE  none: 76,800 pixels of 300 triangles are yes or no. Centres on an edge are left to the next test.
TEST(Scan, AgreesWithExactPointInTriangle) {
  proves({"IU.6.5"}, Oracle::exact, "signs of areas in rationals (GMP)");
  std::mt19937_64 random(50);
  std::uint64_t wrong = 0, decided = 0, on_edge = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Vec2 a = grid_point(random), b = grid_point(random), c = grid_point(random);
    Counts counts;
    counts.draw(a, b, c);
    const int orientation = turn(a, b, c);
    for (int row = 0; row < kSide; ++row) {
      for (int column = 0; column < kSide; ++column) {
        const Vec2 p(column + 0.5, row + 0.5);
        const int s[] = {turn(a, b, p) * orientation, turn(b, c, p) * orientation, turn(c, a, p) * orientation};
        const int times = counts.times[static_cast<std::size_t>(row * kSide + column)];
        const bool outside = orientation == 0 || s[0] < 0 || s[1] < 0 || s[2] < 0;
        const bool inside = orientation != 0 && s[0] > 0 && s[1] > 0 && s[2] > 0;
        if (!outside && !inside) {
          ++on_edge;
          continue;
        }
        wrong += times != (inside ? 1 : 0);
        ++decided;
      }
    }
  }
  EXPECT_GT(on_edge, 50u) << "the family is made to hit edges";
  EXPECT_TRUE(all_agree(wrong, decided));
}

// CLAIM      Top-left rule: triangles that share edges around a common corner cover each centre inside their union
//            once, those on shared edges and on the common corner too.
// ORACLE     exact arithmetic: a fan around a point inside a convex hull covers the hull's interior.
// TOLERANCE  none: every centre is covered once, not less, not twice.
TEST(Scan, CoversSharedEdgesExactlyOnce) {
  proves({"IU.6.5"}, Oracle::exact, "each centre in the interior of a square belongs to one triangle of its fan");
  std::mt19937_64 random(51);
  const Vec2 corner[] = {{0, 0}, {kSide, 0}, {kSide, kSide}, {0, kSide}};
  std::uint64_t wrong = 0, decided = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const Vec2 hub = grid_point(random);
    std::vector<Vec2> rim;
    for (int k = 0; k < 4; ++k) {
      rim.push_back(corner[k]);
      const double t = static_cast<double>(1 + random() % 15) / 16;
      rim.push_back(corner[k] + t * (corner[(k + 1) % 4] - corner[k]));
    }
    Counts counts;
    for (std::size_t k = 0; k < rim.size(); ++k) {
      if (random() % 2)
        counts.draw(hub, rim[k], rim[(k + 1) % rim.size()]);
      else
        counts.draw(rim[(k + 1) % rim.size()], rim[k], hub);
    }
    for (const int times : counts.times) {
      wrong += times != 1;
      ++decided;
    }
  }
  EXPECT_TRUE(all_agree(wrong, decided));
}

// CLAIM      The weights are barycentric coordinates of the centre, whatever the orientation, also beyond the picture.
// ORACLE     closed form: Σ λ_k corner_k is the centre.
// TOLERANCE  each weight is one rounding of an exact quotient, at most 1: 3 roundings of the coordinates, at most 40.
TEST(Scan, WeightsReproduceThePixelCentre) {
  proves({"IU.6.5"}, Oracle::closed_form, "barycentric combination of the corners");
  std::mt19937_64 random(52);
  for (int trial = 0; trial < 200; ++trial) {
    std::array<Vec2, 3> corners;
    for (Vec2& corner : corners) corner = 2.5 * grid_point(random) - Vec2(12, 12);
    for (Vec2& corner : corners) corner = (corner * 4096).array().round() / 4096;
    scan(corners, kSide, kSide, [&](const Covered& p) {
      const Vec2 centre = p.weight[0] * corners[0] + p.weight[1] * corners[1] + p.weight[2] * corners[2];
      EXPECT_TRUE(within((centre - Vec2(p.column + 0.5, p.row + 0.5)).cwiseAbs().maxCoeff(), 6 * 40 * 0x1p-53));
    });
  }
}

/// A grid of points over the picture and beyond, moved at random by up to a third of a cell, cut into triangles either way.
struct RandomMesh {
  std::vector<Vec2> points;
  std::vector<std::array<std::size_t, 3>> triangles;
};

RandomMesh random_mesh(std::mt19937_64& random, double size, bool on_centres) {
  constexpr std::size_t kCells = 5;
  RandomMesh mesh;
  for (std::size_t j = 0; j <= kCells; ++j) {
    for (std::size_t i = 0; i <= kCells; ++i) {
      const auto moved = [&](std::size_t k) {
        const double third = static_cast<double>(random() % 4096) / 4096 - 0.5;
        const double place = -2 + (static_cast<double>(k) + 0.6 * third) * size;
        return on_centres ? std::floor(place) + 0.5 : std::round(place * 4096) / 4096;
      };
      const double x = moved(i);
      mesh.points.emplace_back(x, moved(j));
    }
  }
  for (std::size_t j = 0; j < kCells; ++j) {
    for (std::size_t i = 0; i < kCells; ++i) {
      const std::size_t a = j * (kCells + 1) + i, b = a + 1, c = a + kCells + 1, d = c + 1;
      const auto add = [&](std::array<std::size_t, 3> corners) {
        if (random() % 2 == 0) std::swap(corners[1], corners[2]);
        mesh.triangles.push_back(corners);
      };
      if (random() % 2 == 0) {
        add({a, b, c});
        add({b, d, c});
      } else {
        add({a, b, d});
        add({a, d, c});
      }
    }
  }
  return mesh;
}

/// Whether the triangle has the point, by the rule's other form: the point moved to the right by a step too small to matter, and
/// down by a much smaller one, lies strictly inside. No edge's direction is asked for.
bool owns(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& p) {
  const int orientation = turn(a, b, c);
  if (orientation == 0) return false;
  const Vec2 corners[] = {a, b, c};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 &from = corners[k], &to = corners[(k + 1) % 3];
    int sign = turn(from, to, p);
    // The area's change with p: by −(to.y − from.y) to the right, then by to.x − from.x down.
    if (sign == 0) sign = from.y() > to.y() ? 1 : from.y() < to.y() ? -1 : to.x() > from.x() ? 1 : -1;
    if (sign != orientation) return false;
  }
  return true;
}

// CLAIM      Scan conversion of meshes: each centre inside the mesh belongs to exactly one triangle, and that is the one that has
//            it when the picture is moved by an infinitesimal to the left, and less up; whatever rows are asked for.
// ORACLE     exact arithmetic: signs of areas in rationals, on an edge those of the moved point.
// TOLERANCE  none: 2 × 30 meshes of 50 triangles, 256 pixels each; half of the meshes have all their corners on centres.
TEST(Scan, GivesEachPixelOfAMeshToOneTriangle) {
  proves({"IU.6.5", "IU.3.2b"}, Oracle::exact, "signs of areas in rationals (GMP), ties by an infinitesimal shift");
  std::mt19937_64 random(53);
  std::uint64_t wrong = 0, decided = 0, ties = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const RandomMesh mesh = random_mesh(random, 4, trial % 2 == 0);
    std::vector<int> owner(kSide * kSide, -1), times(kSide * kSide, 0);
    const int cut = static_cast<int>(random() % kSide);  // drawn in two parts
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& [i, j, k] = mesh.triangles[t];
      for (const ScanWindow& part : {ScanWindow{kSide, 0, cut}, ScanWindow{kSide, cut, kSide}}) {
        TriangleSpans spans({mesh.points[i], mesh.points[j], mesh.points[k]}, part);
        for (Span span; spans.next(span);) {
          for (int column = span.begin; column < span.end; ++column) {
            const auto index = static_cast<std::size_t>(span.row * kSide + column);
            owner[index] = static_cast<int>(t);
            ++times[index];
          }
        }
      }
    }
    for (int row = 0; row < kSide; ++row) {
      for (int column = 0; column < kSide; ++column) {
        const Vec2 p(column + 0.5, row + 0.5);
        const auto index = static_cast<std::size_t>(row * kSide + column);
        int right = -1;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
          const auto& [i, j, k] = mesh.triangles[t];
          const Vec2 &a = mesh.points[i], &b = mesh.points[j], &c = mesh.points[k];
          const Vec2 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
          if ((p.array() < low.array()).any() || (p.array() > high.array()).any()) continue;  // exact, and most
          if (owns(a, b, c, p)) right = static_cast<int>(t);
          ties += turn(a, b, p) == 0 || turn(b, c, p) == 0 || turn(c, a, p) == 0;
        }
        wrong += owner[index] != right || times[index] != (right < 0 ? 0 : 1);
        ++decided;
      }
    }
  }
  EXPECT_GT(ties, 1000u) << "the family is made to hit edges and corners";
  EXPECT_TRUE(all_agree(wrong, decided));
}

/// v at a pixel: Σ λ v/w / Σ λ/w with λ from areas, in rationals.
std::array<Rational, 3> exact_value(const std::array<GouraudVertex, 3>& t, const Vec2& p) {
  const auto area = [](const Vec2& a, const Vec2& b, const Vec2& c) {
    return (Rational(b.x()) - Rational(a.x())) * (Rational(c.y()) - Rational(a.y())) -
           (Rational(b.y()) - Rational(a.y())) * (Rational(c.x()) - Rational(a.x()));
  };
  Rational below = 0;
  std::array<Rational, 3> sum{0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational weight = area(t[(k + 1) % 3].position, t[(k + 2) % 3].position, p) * Rational(t[k].inverse_depth);
    below += weight;
    for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * Rational(t[k].value[static_cast<Eigen::Index>(c)]);
  }
  for (Rational& value : sum) value /= below;
  return sum;
}

/// The text's form, on the picture: along the edges AB and CB to the scan line, then along it.  I_Q = u I_B + (1−u) I_A, …
std::optional<Rational> along_edges_then_row(std::array<GouraudVertex, 3> t, const Vec2& p) {
  const Rational y(p.y());
  struct End {
    Rational x, value;
  };
  std::vector<End> ends;
  for (std::size_t k = 0; k < 3; ++k) {
    const GouraudVertex &a = t[k], &b = t[(k + 1) % 3];
    const Rational low(a.position.y()), high(b.position.y());
    if (low == high || (y - low) * (y - high) > 0) continue;
    const Rational u = (y - low) / (high - low);
    ends.push_back({u * Rational(b.position.x()) + (1 - u) * Rational(a.position.x()),
                    u * Rational(b.value[0]) + (1 - u) * Rational(a.value[0])});
  }
  for (std::size_t k = 1; k < ends.size(); ++k) {
    if (ends[k].x == ends[0].x) continue;
    const Rational v = (Rational(p.x()) - ends[0].x) / (ends[k].x - ends[0].x);
    return Rational(v * ends[k].value + (1 - v) * ends[0].value);
  }
  return std::nullopt;
}

std::array<GouraudVertex, 3> random_triangle(std::mt19937_64& random, bool flat) {
  std::array<GouraudVertex, 3> triangle;
  const auto share = [&] { return static_cast<double>(random() % 1000) / 999; };
  for (GouraudVertex& corner : triangle) {
    corner.position = 2.5 * grid_point(random) - Vec2(12, 12);
    corner.position = (corner.position * 4096).array().round() / 4096;
    corner.inverse_depth = flat ? 1 : 0.1 + 3 * share();
    for (Eigen::Index c = 0; c < 3; ++c) corner.value[c] = share() - 0.3 * static_cast<double>(c);
  }
  return triangle;
}

// CLAIM      IU.3.2b: values between the corners are those of barycentric interpolation on the surface, whatever the perspective;
//            without perspective those are the text's: along two edges to the scan line, then along it.
// ORACLE     exact arithmetic: both formulas in rationals.
// TOLERANCE  kInterpolationError of the largest |v/w|, times the depth there, on multiples stepping_error(); for the depth, which
//            is interpolated alike from corners up to 3.1, as much of the value; two roundings of the quotient.
TEST(Gouraud, InterpolatesAsExactBarycentricsDo) {
  proves({"IU.3.2b", "IU.6.5"}, Oracle::exact, "barycentrics and the text's two steps, in rationals (GMP)");
  std::mt19937_64 random(54);
  std::uint64_t pixels = 0, rows = 0, differ = 0;
  for (int trial = 0; trial < 120; ++trial) {
    const bool flat = trial % 2 == 0;
    const auto triangle = random_triangle(random, flat);
    if (turn(triangle[0].position, triangle[1].position, triangle[2].position) == 0) continue;
    const bool multiples = trial % 4 >= 2;
    DepthRaster raster(kSide, kSide, Eigen::Array3d::Constant(-9),
                       multiples ? Stepping::incremental : Stepping::direct);
    const double share = multiples ? stepping_error(kSide) : kInterpolationError;
    raster.draw(triangle);
    Eigen::Array3d largest = Eigen::Array3d::Zero();
    for (const auto& corner : triangle) largest = largest.max((corner.value * corner.inverse_depth).abs());
    for (int row = 0; row < kSide; ++row) {
      for (int column = 0; column < kSide; ++column) {
        if (raster.picture().at(column, row)[0] == -9) continue;
        ++pixels;
        const Vec2 centre(column + 0.5, row + 0.5);
        const auto exact = exact_value(triangle, centre);
        const double depth = 1 / raster.inverse_depth()[static_cast<std::size_t>(row * kSide + column)];
        for (std::size_t c = 0; c < 3; ++c) {
          const double value = raster.picture().at(column, row)[static_cast<Eigen::Index>(c)];
          const double error = CGAL::to_double(CGAL::abs(Rational(value) - exact[c]));
          const double scale = largest[static_cast<Eigen::Index>(c)] * depth;
          EXPECT_TRUE(
              within(error, share * scale + (2 * 0x1p-53 + kInterpolationError * 3.1 * depth) * std::abs(value)));
        }
        if (!flat) continue;
        const auto by_edges = along_edges_then_row(triangle, centre);
        rows += by_edges.has_value();
        differ += by_edges && *by_edges != exact[0];
      }
    }
  }
  EXPECT_GT(pixels, 3000u);
  EXPECT_GT(rows, 1000u);
  EXPECT_TRUE(all_agree(differ, rows));
}

// CLAIM      IU.3.2c: one addition a pixel gives what the formula gives, to the last bit, with and without perspective, over
//            rows of thousands of pixels and values of any size.
// ORACLE     identity: two pictures of the same triangles, bits compared. That plain additions would not: counted, in the test.
// TOLERANCE  none.
TEST(Gouraud, StepsToTheSameBitsAsTheFormula) {
  proves({"IU.3.2c"}, Oracle::identity, "direct and incremental pictures, bit by bit");
  std::mt19937_64 random(55);
  constexpr int kColumns = 3000, kRows = 4;
  DepthRaster direct(kColumns, kRows, Eigen::Array3d::Zero(), Stepping::direct_on_multiples);
  DepthRaster incremental(kColumns, kRows, Eigen::Array3d::Zero(), Stepping::incremental);
  std::uint64_t plain_differs = 0;
  for (int trial = 0; trial < 200; ++trial) {
    auto triangle = random_triangle(random, trial % 3 == 0);
    for (GouraudVertex& corner : triangle) {
      corner.position.x() *= 150;
      corner.inverse_depth *= 1 + trial;  // nearer and nearer: every one is seen
      corner.value *= std::ldexp(1.0, static_cast<int>(random() % 200) - 100);
    }
    direct.draw(triangle);
    incremental.draw(triangle);
    const double start = triangle[0].value[0], step = (triangle[1].value[0] - start) / kColumns;
    double sum = start;
    for (int k = 0; k < kColumns; ++k) sum += step;
    plain_differs += sum != start + kColumns * step;
  }
  std::uint64_t wrong = 0, decided = 0;
  for (std::size_t i = 0; i < direct.picture().pixels.size(); ++i) {
    for (Eigen::Index c = 0; c < 3; ++c) {
      wrong += std::bit_cast<std::uint64_t>(direct.picture().pixels[i][c]) !=
               std::bit_cast<std::uint64_t>(incremental.picture().pixels[i][c]);
      decided += direct.picture().pixels[i][c] != 0;
    }
  }
  EXPECT_GT(decided, 20000u);
  EXPECT_GT(plain_differs, 100u);
  EXPECT_TRUE(all_agree(wrong, decided));
}

}  // namespace
}  // namespace etendue::validation
