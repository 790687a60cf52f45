// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/product_rule.hpp"

#include "etendue/form_factor/gauss_legendre.hpp"

namespace etendue {

namespace {

/// Plain loops over the lanes, which the compiler turns into whatever vectors the caller below may use.
[[gnu::always_inline]] inline void sum_lanes(ProductRule& rule, int n_first, int n_second) {
  using Lanes = ProductRule::Lanes;
  // Heights of the source's points over the receivers, weighted.
  std::array<Lanes, ProductRule::kMostPoints> depths;
  for (std::size_t a = 0; a < rule.points; ++a) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      depths[a][l] = rule.weight[a] * (rule.depth[l] + rule.s[a] * rule.fall_1[l] + rule.t[a] * rule.fall_2[l]);
    }
  }
  Lanes total{};
  for (const QuadratureNode& u : gauss_legendre(n_first)) {
    for (const QuadratureNode& v : gauss_legendre(n_second)) {
      Lanes x, y, z, inner{};
      for (std::size_t l = 0; l < kLanes; ++l) {
        x[l] = rule.between[0][l] + (u.x * rule.half_1[0][l] + v.x * rule.half_2[0][l]);
        y[l] = rule.between[1][l] + (u.x * rule.half_1[1][l] + v.x * rule.half_2[1][l]);
        z[l] = rule.between[2][l] + (u.x * rule.half_1[2][l] + v.x * rule.half_2[2][l]);
      }
      for (std::size_t a = 0; a < rule.points; ++a) {
        const double ax = rule.x[a], ay = rule.y[a], az = rule.z[a];
        const Lanes& depth = depths[a];
        for (std::size_t l = 0; l < kLanes; ++l) {
          const double rx = x[l] - ax, ry = y[l] - ay, rz = z[l] - az;
          const double square = rx * rx + ry * ry + rz * rz;
          inner[l] += depth[l] / (square * square);
        }
      }
      const double weight = u.weight * v.weight;
      for (std::size_t l = 0; l < kLanes; ++l) {
        total[l] += weight * (rule.height[l] + u.x * rule.rise_1[l] + v.x * rule.rise_2[l]) * inner[l];
      }
    }
  }
  rule.total = total;
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] void sum_wide(ProductRule& rule, int n_first, int n_second) {
  sum_lanes(rule, n_first, n_second);
}
#else
void sum_wide(ProductRule& rule, int n_first, int n_second) {
  sum_lanes(rule, n_first, n_second);
}
#endif

void sum_portable(ProductRule& rule, int n_first, int n_second) {
  sum_lanes(rule, n_first, n_second);
}

}  // namespace

bool has_wide_vectors() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

void ProductRule::set_source(const Vec3& first, const Vec3& second, int n_first, int n_second) {
  source_1 = first;
  source_2 = second;
  points = 0;
  for (const QuadratureNode& u : gauss_legendre(n_first)) {
    for (const QuadratureNode& v : gauss_legendre(n_second)) {
      const Vec3 point = u.x * first + v.x * second;
      s[points] = u.x;
      t[points] = v.x;
      x[points] = point.x();
      y[points] = point.y();
      z[points] = point.z();
      weight[points++] = u.weight * v.weight;
    }
  }
}

void ProductRule::set_lane(std::size_t lane, const Vec3& source_normal, const Vec3& from_source, const Vec3& first,
                           const Vec3& second, const Vec3& normal) {
  for (std::size_t c = 0; c < 3; ++c) {
    const auto axis = static_cast<Eigen::Index>(c);
    between[c][lane] = from_source[axis];
    half_1[c][lane] = first[axis];
    half_2[c][lane] = second[axis];
  }
  height[lane] = source_normal.dot(from_source);
  rise_1[lane] = source_normal.dot(first);
  rise_2[lane] = source_normal.dot(second);
  depth[lane] = -normal.dot(from_source);
  fall_1[lane] = normal.dot(source_1);
  fall_2[lane] = normal.dot(source_2);
}

void ProductRule::sum(int n_first, int n_second, bool wide) {
  wide ? sum_wide(*this, n_first, n_second) : sum_portable(*this, n_first, n_second);
}

}  // namespace etendue
