// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <cstring>
#include <optional>

#include "etendue/core/contract.hpp"
#include "etendue/geometry/bezier.hpp"
#include "etendue/geometry/clip.hpp"
#include "etendue/geometry/cone.hpp"
#include "etendue/geometry/polygon_with_holes.hpp"
#include "etendue/geometry/quadric.hpp"
#include "etendue/geometry/sight.hpp"
#include "etendue/geometry/torus.hpp"
#include "etendue/geometry/triangle.hpp"
#include "fuzz/target.hpp"

// Shapes and rays of any numbers. Those out of a routine's domain may be refused by its contract, and by nothing else.
namespace etendue::fuzz {

namespace {

/// Numbers from bytes: short ones, in which coincidences are frequent, or any double at all. Zeros at the end.
class Numbers {
 public:
  explicit Numbers(Bytes bytes) : bytes_(bytes) { any_ = byte() % 2 == 1; }

  bool any() const { return any_; }  ///< else all are multiples of 1/8 within ±16
  std::uint8_t byte() { return next_ < bytes_.size() ? bytes_[next_++] : std::uint8_t{0}; }
  double number() {
    if (!any_) return static_cast<double>(static_cast<std::int8_t>(byte())) / 8;
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8 | byte();
    double value;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }
  Vec3 vector() {
    const double x = number(), y = number();
    return {x, y, number()};
  }
  std::vector<Vec3> chain(std::size_t most) {
    std::vector<Vec3> all(byte() % (most + 1));
    for (Vec3& vertex : all) vertex = vector();
    return all;
  }

 private:
  Bytes bytes_;
  std::size_t next_ = 0;
  bool any_;
};

/// What every hit is, wherever its contract lets the ray pass. Farther than 1e100 a bound may be infinite.
void judge(const Ray& ray, const std::optional<Hit>& hit, bool short_numbers) {
  if (!hit) return;
  expect(hit->t > std::max(0.0, ray.t_min) && hit->t < ray.t_max, "t is within the ray");
  if (!short_numbers) return;
  expect(hit->point.allFinite() && hit->uv.allFinite(), "point and uv are finite");
  expect(std::abs(hit->normal.norm() - 1) < 1e-12, "the normal is a unit vector");
  expect(hit->point_error >= 0 && hit->surface_error >= 0, "bounds are not negative");
  // O + tD is rounded: 4 u of its terms; t itself may be off by an ulp along D.
  const double rounding = 8 * 0x1p-53 * (ray.origin.lpNorm<1>() + hit->t * ray.direction.lpNorm<1>());
  expect((ray.at(hit->t) - hit->point).norm() <= hit->point_error + rounding, "the point is on the ray");
}

template <class Shape>
void meet(const Ray& ray, const Shape& shape, bool short_numbers) {
  try {
    const auto hit = intersect(ray, shape);
    judge(ray, hit, short_numbers);
    if (!short_numbers) return;  // sight() is promised between 2^-120 and 2^120
    const Sight seen = sight(ray, shape);
    if (seen.kind == Sight::Kind::miss) expect(!hit, "what sight() misses is missed");
    if (seen.kind == Sight::Kind::hit) expect(hit.has_value(), "what sight() hits is hit");
    if (hit) expect(hit->t >= seen.first && (seen.kind != Sight::Kind::hit || hit->t <= seen.last), "t is as seen");
  } catch (const ContractViolation&) {
  }
}

Ray ray_of(Numbers& numbers) {
  Ray ray;
  ray.origin = numbers.vector();
  ray.direction = numbers.vector();
  if (numbers.byte() % 4 == 0) ray.t_min = numbers.number();
  if (numbers.byte() % 4 == 0) ray.t_max = numbers.number();
  return ray;
}

Box box_of(Numbers& numbers) {
  Box box;
  box.centre = numbers.vector();
  box.half_edges = numbers.vector();
  return box;
}

BezierSurface bezier_of(Numbers& numbers) {
  BezierSurface surface;
  for (auto& row : surface.control) {
    for (Vec3& point : row) point = numbers.vector();
  }
  return surface;
}

void intersections(Bytes input) {
  Numbers numbers(input);
  const bool is_short = !numbers.any();
  const auto kind = numbers.byte() % 10;
  const Ray ray = ray_of(numbers);
  const Vec3 a = numbers.vector(), b = numbers.vector(), c = numbers.vector();
  const double r = numbers.number(), s = numbers.number();
  if (kind == 0) meet(ray, Sphere{a, r}, is_short);
  if (kind == 1) meet(ray, Plane{a, b.stableNormalized()}, is_short);
  if (kind == 2) meet(ray, Disc{a, b.stableNormalized(), r}, is_short);
  if (kind == 3) meet(ray, Triangle{a, b, c}, is_short);
  if (kind == 4) meet(ray, box_of(numbers), is_short);
  if (kind == 5) meet(ray, Cylinder{a, b, r}, is_short);
  if (kind == 6) meet(ray, Cone{a, b, r, s}, is_short);
  if (kind == 7) meet(ray, Torus{a, b, r, s}, is_short);
  if (kind == 8) {
    Quadric quadric{Mat3::Zero(), c, r, box_of(numbers)};
    quadric.square.diagonal() = a;
    quadric.square(0, 1) = b.x(), quadric.square(0, 2) = b.y(), quadric.square(1, 2) = b.z();
    meet(ray, quadric, is_short);
  }
  if (kind == 9) meet(ray, bezier_of(numbers), is_short);
}

void polygons(Bytes input) {
  Numbers numbers(input);
  const Ray ray = ray_of(numbers);
  const bool flat = numbers.byte() % 2 == 0;
  std::vector<Vec3> chain = numbers.chain(12);
  std::vector<std::vector<Vec3>> holes;
  while (holes.size() < 3 && numbers.byte() % 2 == 1) holes.push_back(numbers.chain(6));
  if (flat) {
    for (Vec3& vertex : chain) vertex.z() = 0;
    for (auto& hole : holes) {
      for (Vec3& vertex : hole) vertex.z() = 0;
    }
  }
  const auto polygon = Polygon::make(chain);
  if (!polygon) return expect(!polygon.error().message.empty(), "a refusal has its reason");
  expect(polygon->area() > 0 && std::abs(polygon->normal().norm() - 1) < 1e-12, "a polygon has area and normal");
  meet(ray, *polygon, !numbers.any());
  const auto pierced = PolygonWithHoles::make(*polygon, holes);
  if (pierced) meet(ray, *pierced, !numbers.any());
}

/// Newell's sum: twice the area, along the normal.
Vec3 area_vector(const std::vector<Vec3>& chain) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < chain.size(); ++i) sum += (chain[i] - chain[0]).cross(chain[i + 1] - chain[0]);
  return sum;
}

void clipping(Bytes input) {
  Numbers numbers(input);
  const Plane plane{numbers.vector(), numbers.vector()};
  std::vector<Vec3> chain = numbers.chain(12);
  for (Vec3& vertex : chain) vertex.z() = 0;
  const auto polygon = Polygon::make(chain);
  if (!polygon) return;
  try {
    const std::vector<Vec3> front = clip(chain, plane), back = clip(chain, Plane{plane.point, -plane.normal});
    if (numbers.any()) return;
    // Cut in two, nothing is lost: corners err by 4 u of 16√2, 24 corners, lengths up to 46.
    const Vec3 lost = area_vector(chain) - area_vector(front) - area_vector(back);
    const bool within = (polygon->normal().cross(plane.normal)).norm() == 0;  // in the plane: both parts are the whole
    expect(within || lost.norm() < 1e-10, "the two parts make the whole");
    for (const Vec3& corner : front) {
      expect(plane.normal.dot(corner - plane.point) >= -1e-12 * (1 + plane.normal.norm()) * 64, "in front");
    }
  } catch (const ContractViolation&) {
  }
}

}  // namespace

const std::vector<Target>& kernel_targets() {
  static const std::vector<Target> all{
      {"intersections", intersections}, {"polygons", polygons}, {"clipping", clipping}};
  return all;
}

}  // namespace etendue::fuzz
