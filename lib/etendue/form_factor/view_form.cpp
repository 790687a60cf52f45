// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/view_form.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "etendue/form_factor/product_rule.hpp"

namespace etendue {

namespace {

/// Points side by side: as many as a cell with two nodes a side has. Compilers turn this into vectors of what width the
/// caller below may use; each of them only adds, multiplies, divides and takes roots, so bits are the same.
constexpr std::size_t kSide = 4;
using Row [[gnu::vector_size(kSide * sizeof(double))]] = double;

struct Rays {
  Row x, y, z;
};

/// Halving the angle three times takes tangents up to kLongArc^½, 57 degrees, below kShortArc^½.
constexpr double kLongArc = 2.36;
constexpr int kHalvings = 3;

[[gnu::always_inline]] inline void look(const ViewEdge* edges, const ViewCorner& corner, const Row& x, const Row& y,
                                        Rays& ray) {
  const ViewEdge &a = edges[corner.first], &b = edges[corner.second];
  const Row ax = a.start.x() - x, ay = a.start.y() - y;
  const double az = a.start.z();
  if (corner.first == corner.second) {
    ray = {ax, ay, az + Row{}};
    return;
  }
  // m × n, m = a × e over the first edge e and n over the second, as (a·n) e − (e·n) a: it errs within the first plane only.
  const Row bx = b.start.x() - x, by = b.start.y() - y;
  const double bz = b.start.z();
  const Row nx = by * b.along.z() - bz * b.along.y();
  const Row ny = bz * b.along.x() - bx * b.along.z();
  const Row nz = bx * b.along.y() - by * b.along.x();
  const Row start = ax * nx + ay * ny + az * nz;
  const Row slope = a.along.x() * nx + a.along.y() * ny + a.along.z() * nz;
  ray = {start * a.along.x() - slope * ax, start * a.along.y() - slope * ay, start * a.along.z() - slope * az};
}

/// arc_over_tangent() up to kLongArc, by atan(√q) = 2 atan(√q'), q' = q/(1 + √(1 + q))².
[[gnu::always_inline]] inline void long_arcs(const Row& tangents, Row& result) {
  Row q = tangents, share = 1.0 + Row{};
  for (int k = 0; k < kHalvings; ++k) {
    Row root = 1 + q;
    for (std::size_t l = 0; l < kSide; ++l) root[l] = std::sqrt(root[l]);
    root = 1 / (1 + root);
    share *= 2 * root;
    q *= root * root;
  }
  arc_over_tangent(q, result);
  result *= share;
}

[[gnu::always_inline]] inline void add_arcs(const Rays& from, const Rays& to, Row& sum) {
  const Row cx = to.y * from.z - to.z * from.y, cy = to.z * from.x - to.x * from.z, cz = to.x * from.y - to.y * from.x;
  const Row dot = to.x * from.x + to.y * from.y + to.z * from.z;
  const Row square = cx * cx + cy * cy + cz * cz, inverse = 1 / dot, tangent = square * inverse * inverse;
  bool all_short = true;
  for (std::size_t l = 0; l < kSide; ++l) all_short = all_short && dot[l] > 0 && tangent[l] < kShortArc;
  Row arc;
  arc_over_tangent(tangent, arc);
  arc *= cz * inverse;
  if (all_short) {
    sum += arc;
    return;
  }
  Row longer;
  long_arcs(tangent, longer);
  longer *= cz * inverse;
  for (std::size_t l = 0; l < kSide; ++l) {
    if (dot[l] > 0 && tangent[l] < kShortArc) {
      sum[l] += arc[l];
    } else if (dot[l] > 0 && tangent[l] < kLongArc) {
      sum[l] += longer[l];
    } else if (square[l] > 0) {
      const double size = std::sqrt(square[l]);
      sum[l] += std::atan2(size, dot[l]) * cz[l] / size;
    }
  }
}

[[gnu::always_inline]] inline void sum_arcs(const ViewEdge* edges, std::span<const ViewCorner> form, const Row& x,
                                            const Row& y, Row& sum) {
  Rays before{}, here;
  bool starts = true;
  for (const ViewCorner& corner : form) {
    look(edges, corner, x, y, here);
    if (!starts) add_arcs(before, here, sum);
    starts = corner.closes;
    before = here;
  }
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void sum_wide(const ViewEdge* edges, std::span<const ViewCorner> form, const Row& x,
                                      const Row& y, Row& sum) {
  sum_arcs(edges, form, x, y, sum);
}
#else
void sum_wide(const ViewEdge* edges, std::span<const ViewCorner> form, const Row& x, const Row& y, Row& sum) {
  sum_arcs(edges, form, x, y, sum);
}
#endif

void sum_portable(const ViewEdge* edges, std::span<const ViewCorner> form, const Row& x, const Row& y, Row& sum) {
  sum_arcs(edges, form, x, y, sum);
}

Vec3 crossing(const ViewEdge& first, const ViewEdge& second, const Vec2& x) {
  const Vec3 eye(x.x(), x.y(), 0), start = first.start - eye, normal = (second.start - eye).cross(second.along);
  return start.dot(normal) * first.along - first.along.dot(normal) * start;
}

}  // namespace

bool keeps_sides(std::span<const ViewEdge> edges, std::span<const ViewCorner> form, const Vec2& centre,
                 std::span<const Vec2> points) {
  for (const ViewCorner& corner : form) {
    if (corner.first == corner.second) continue;
    const ViewEdge &first = edges[corner.first], &second = edges[corner.second];
    const Vec3 ray = crossing(first, second, centre);
    for (const Vec2& x : points) {
      if (!(crossing(first, second, x).dot(ray) > 0)) return false;
    }
  }
  return true;
}

void add_factors(std::span<const ViewEdge> edges, std::span<const ViewCorner> form, std::span<const Vec2> points,
                 std::span<double> factors) {
  static const bool wide = has_wide_vectors();
  for (std::size_t k = 0; k < points.size(); k += kSide) {
    Row x, y, sum{};
    for (std::size_t l = 0; l < kSide; ++l) {
      const Vec2& point = points[std::min(k + l, points.size() - 1)];
      x[l] = point.x();
      y[l] = point.y();
    }
    wide ? sum_wide(edges.data(), form, x, y, sum) : sum_portable(edges.data(), form, x, y, sum);
    for (std::size_t l = 0; l < kSide && k + l < points.size(); ++l) {
      factors[k + l] += sum[l] * (0.5 / std::numbers::pi);
    }
  }
}

}  // namespace etendue
