// SPDX-License-Identifier: Apache-2.0
#include "etendue/acceleration/single_ray.hpp"

#include <cstring>
#ifdef __x86_64__
#include <immintrin.h>
#endif

namespace etendue {

namespace {

constexpr std::size_t kHalf = 4;  // what one register holds
using Four = float __attribute__((vector_size(16)));
using FourInts = std::int32_t __attribute__((vector_size(16)));

Four all(float value) {
  return Four{value, value, value, value};
}
Four four(const float* values) {
  Four result;
  std::memcpy(&result, values, sizeof(result));
  return result;
}
Four four(const std::uint8_t* values) {
#ifdef __SSE2__
  std::int32_t packed;
  std::memcpy(&packed, values, sizeof(packed));
  const __m128i zero = _mm_setzero_si128();
  return _mm_cvtepi32_ps(_mm_unpacklo_epi16(_mm_unpacklo_epi8(_mm_cvtsi32_si128(packed), zero), zero));
#else
  return Four{static_cast<float>(values[0]), static_cast<float>(values[1]), static_cast<float>(values[2]),
              static_cast<float>(values[3])};
#endif
}
/// The second where the first is not a number.
Four larger(const Four& a, const Four& b) {
  return a > b ? a : b;
}
Four smaller(const Four& a, const Four& b) {
  return a < b ? a : b;
}
Four magnitude(const Four& a) {
  return larger(a, -a);
}
unsigned bits(const FourInts& mask) {
#ifdef __SSE2__
  return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
  const FourInts each = mask & FourInts{1, 2, 4, 8};
  return static_cast<unsigned>(each[0] | each[1] | each[2] | each[3]);
#endif
}

/// A component nearer to zero counts as this: over the size of the scene the ray moves by less than the margin.
constexpr double kLeastComponent = 0x1p-60;

double entry(const Ray& ray, const Aabb& box) {
  double first = 0;
  for (int k = 0; k < 3; ++k) {
    const double d = ray.direction[k];
    if (d == 0) continue;
    first = std::max(first, ((d > 0 ? box.low[k] : box.high[k]) - ray.origin[k]) / d);
  }
  return std::isfinite(first) ? first : 0;
}

}  // namespace

SingleRay::SingleRay(const Ray& ray, const WideTree& tree) {
  const double speed = ray.direction.lpNorm<Eigen::Infinity>();
  speed_ = speed * tree.unit;
  // Where the ray comes near the scene: a rounded number serves, the margin pays for it.
  start_ = std::max({0.0, ray.t_min, entry(ray, tree.box)});
  start_place_ = (ray.at(start_) - tree.middle) * tree.unit;
  direction_ = ray.direction / speed;
  const double far = tree.box.low.cwiseAbs().cwiseMax(tree.box.high.cwiseAbs()).maxCoeff();
  const double reach = (ray.origin.lpNorm<Eigen::Infinity>() + far) * tree.unit;
  margin_ = kSingleMargin * (1 + start_place_.lpNorm<Eigen::Infinity>()) + kDoubleMargin * 4 * reach;
  room_ = rounded_up(margin_);
  for (int k = 0; k < 3; ++k) {
    const auto a = static_cast<std::size_t>(k);
    const double component = direction_[k];
    const bool small = std::abs(component) < kLeastComponent;
    origin_[a] = to_single(start_place_[k]);
    inverse_[a] = static_cast<float>(1 / (small ? std::copysign(kLeastComponent, component) : component));
    forward_[a] = inverse_[a] > 0;
  }
  const Shear shear = shear_of(ray.direction);
  axis_ = {static_cast<std::size_t>(shear.x), static_cast<std::size_t>(shear.y), static_cast<std::size_t>(shear.z)};
  along_x_ = static_cast<float>(shear.along_x);
  along_y_ = static_cast<float>(shear.along_y);
  sense_ = shear.scale > 0 ? 1 : -1;
}

/// The planes of a node's bytes along one axis, as a function of the byte: near and far ones.
struct Planes {
  const std::uint8_t *near, *far;
  float step, to_near, to_far;
};

namespace {

unsigned boxes_entered(const std::array<Planes, 3>& planes, float room, float last, float* where) {
  unsigned result = 0;
  for (std::size_t half = 0; half < WideTree::kWidth; half += kHalf) {
    Four near = all(-room), far = all(last);
    for (const Planes& axis : planes) {
      // What is not a number leaves the interval as it is.
      near = larger(four(axis.near + half) * axis.step + axis.to_near, near);
      far = smaller(four(axis.far + half) * axis.step + axis.to_far, far);
    }
    std::memcpy(where + half, &near, sizeof(near));
    result |= bits(near <= far + room) << half;
  }
  return result;
}

#ifdef __x86_64__
/// The same in registers of eight, where the processor has them: the same operations, so the same bits.
__attribute__((target("avx2"))) unsigned boxes_entered_at_once(const std::array<Planes, 3>& planes, float room,
                                                               float last, float* where) {
  __m256 near = _mm256_set1_ps(-room), far = _mm256_set1_ps(last);
  for (const Planes& axis : planes) {
    const __m256 step = _mm256_set1_ps(axis.step);
    const __m128i first = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(axis.near));
    const __m128i second = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(axis.far));
    const __m256 low = _mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(first));
    const __m256 high = _mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(second));
    // Of these, too, the second operand is the answer where one is not a number.
    near = _mm256_max_ps(_mm256_add_ps(_mm256_mul_ps(low, step), _mm256_set1_ps(axis.to_near)), near);
    far = _mm256_min_ps(_mm256_add_ps(_mm256_mul_ps(high, step), _mm256_set1_ps(axis.to_far)), far);
  }
  _mm256_storeu_ps(where, near);
  const __m256 enters = _mm256_cmp_ps(near, _mm256_add_ps(far, _mm256_set1_ps(room)), _CMP_LE_OQ);
  return static_cast<unsigned>(_mm256_movemask_ps(enters));
}
const bool kAtOnce = __builtin_cpu_supports("avx2");
#endif

}  // namespace

unsigned SingleRay::entered(const WideTree::Node& node, float last, std::array<float, WideTree::kWidth>& where) const {
  std::array<Planes, 3> planes;
  for (std::size_t k = 0; k < 3; ++k) {
    const float low = (node.origin[k] - room_ - origin_[k]) * inverse_[k];
    const float high = (node.origin[k] + room_ - origin_[k]) * inverse_[k];
    const float step = node.step[k] * inverse_[k];
    planes[k] = forward_[k] ? Planes{node.low[k].data(), node.high[k].data(), step, low, high}
                            : Planes{node.high[k].data(), node.low[k].data(), step, high, low};
  }
#ifdef __x86_64__
  if (kAtOnce) return boxes_entered_at_once(planes, room_, last, where.data());
#endif
  return boxes_entered(planes, room_, last, where.data());
}

unsigned SingleRay::passed(const WideTree::Corners& corners, float last) const {
  std::array<Four, 3> x, y, z;
  Four size = all(0);
  for (std::size_t c = 0; c < 3; ++c) {
    const auto& at = corners.at[c];
    z[c] = four(at[axis_[2]].data()) - origin_[axis_[2]];
    x[c] = four(at[axis_[0]].data()) - origin_[axis_[0]] - along_x_ * z[c];
    y[c] = four(at[axis_[1]].data()) - origin_[axis_[1]] - along_y_ * z[c];
    z[c] *= sense_;
    size = larger(size, larger(magnitude(x[c]), magnitude(y[c])));
  }
  const Four bc = x[1] * y[2] - y[1] * x[2], ca = x[2] * y[0] - y[2] * x[0], ab = x[0] * y[1] - y[0] * x[1];
  const Four sure = (5 * room_) * size + 4 * room_ * room_ + 0x1p-21F * size * size;
  const Four least = smaller(bc, smaller(ca, ab)), greatest = larger(bc, larger(ca, ab));
  const Four nearest = smaller(z[0], smaller(z[1], z[2])), farthest = larger(z[0], larger(z[1], z[2]));
  const FourInts aside = (least < -sure) & (greatest > sure);
  const FourInts elsewhere = (nearest > last + 2 * room_) | (farthest < -2 * room_);
  return bits(~(aside | elsewhere));
}

}  // namespace etendue
