// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <vector>

#include "etendue/geometry/sphere.hpp"
#include "etendue/geometry/triangle.hpp"
#include "geometry/families.hpp"

// Rates of our intersections beside the textbook forms they replace, in one run: what exactness costs.
namespace etendue::validation {
namespace {

constexpr std::size_t kCount = 1024;

// The quadratic formula as printed in textbooks: t = μ ∓ √γ.
std::optional<double> textbook(const Ray& ray, const Sphere& sphere) {
  const Vec3 v = sphere.centre - ray.origin;
  const double a = ray.direction.squaredNorm(), mu = ray.direction.dot(v);
  const double gamma = mu * mu - a * (v.squaredNorm() - sphere.radius * sphere.radius);
  if (gamma < 0) return std::nullopt;
  const double near = (mu - std::sqrt(gamma)) / a, far = (mu + std::sqrt(gamma)) / a;
  if (near > 0) return near;
  return far > 0 ? std::optional(far) : std::nullopt;
}

// Möller and Trumbore 1997.
std::optional<double> textbook(const Ray& ray, const Triangle& triangle) {
  const Vec3 ab = triangle.b - triangle.a, ac = triangle.c - triangle.a, p = ray.direction.cross(ac);
  const double determinant = ab.dot(p);
  if (determinant == 0) return std::nullopt;
  const Vec3 s = ray.origin - triangle.a, q = s.cross(ab);
  const double beta = s.dot(p) / determinant, gamma = ray.direction.dot(q) / determinant;
  if (beta < 0 || gamma < 0 || beta + gamma > 1) return std::nullopt;
  const double t = ac.dot(q) / determinant;
  return t > 0 ? std::optional(t) : std::nullopt;
}

template <class Shape>
Shape random_shape(Random& random);
template <>
Sphere random_shape(Random& random) {
  return {random.in_cube(1), random.uniform(0.5, 1)};
}
template <>
Triangle random_shape(Random& random) {
  return {random.in_cube(1), random.in_cube(1), random.in_cube(1)};
}

// `aside`: half the width of the cube of targets; 0.3 mostly hits, 10 mostly misses.
template <class Shape, class Test>
void run(benchmark::State& state, double aside, Test test) {
  Random random(1);
  std::vector<Ray> rays(kCount);
  std::vector<Shape> shapes;
  std::size_t hits = 0;
  for (Ray& ray : rays) {
    shapes.push_back(random_shape<Shape>(random));
    ray.origin = 5 * random.unit_vector();
    ray.direction = random.in_cube(aside) - ray.origin;
    hits += test(ray, shapes.back()).has_value();
  }
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(test(rays[i], shapes[i]));
    i = (i + 1) % kCount;
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()));
  state.counters["hits"] = static_cast<double>(hits) / kCount;
}

void sphere(benchmark::State& state, double aside) {
  run<Sphere>(state, aside, [](const Ray& ray, const Sphere& shape) { return intersect(ray, shape); });
}
void sphere_textbook(benchmark::State& state, double aside) {
  run<Sphere>(state, aside, [](const Ray& ray, const Sphere& shape) { return textbook(ray, shape); });
}
void triangle(benchmark::State& state, double aside) {
  run<Triangle>(state, aside, [](const Ray& ray, const Triangle& shape) { return intersect(ray, shape); });
}
void triangle_moeller_trumbore(benchmark::State& state, double aside) {
  run<Triangle>(state, aside, [](const Ray& ray, const Triangle& shape) { return textbook(ray, shape); });
}

BENCHMARK_CAPTURE(sphere_textbook, near, 0.3);
BENCHMARK_CAPTURE(sphere, near, 0.3);
BENCHMARK_CAPTURE(sphere_textbook, aside, 10.0);
BENCHMARK_CAPTURE(sphere, aside, 10.0);
BENCHMARK_CAPTURE(triangle_moeller_trumbore, near, 0.3);
BENCHMARK_CAPTURE(triangle, near, 0.3);
BENCHMARK_CAPTURE(triangle_moeller_trumbore, aside, 10.0);
BENCHMARK_CAPTURE(triangle, aside, 10.0);

}  // namespace
}  // namespace etendue::validation

BENCHMARK_MAIN();
