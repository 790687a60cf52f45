// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <array>
#include <vector>

#include "etendue/raster/gouraud.hpp"
#include "etendue/raytracing/render.hpp"
#include "etendue/view/shaded_view.hpp"
#include "support/scene_builder.hpp"

// The rasteriser on one thread: Gouraud triangles of 50 pixels and more into a picture of 1000 × 1000 (bar: 100 Mpixel/s), and a
// sphere of figure 13 that fills it, normals interpolated (bar: 50 ms); the ray tracer on the same picture, one ray a pixel.
namespace etendue::validation {
namespace {

constexpr int kSide = 1000;

/// A net over the picture, both halves of each cell, a little uneven; each layer nearer than the last, so that all are seen.
std::vector<std::array<GouraudVertex, 3>> net(int cell, int layers) {
  std::vector<std::array<GouraudVertex, 3>> triangles;
  const int count = kSide / cell;
  for (int layer = 0; layer < layers; ++layer) {
    const auto corner = [&](int i, int j) {
      const Vec2 place(i * cell + 0.3 * ((7 * i + j) % 3), j * cell + 0.3 * ((i + 5 * j) % 3));
      return GouraudVertex{place, 1 + layer + 1e-4 * (i + j), {0.1 * (i % 7), 0.1 * (j % 5), 0.5}};
    };
    for (int j = 0; j < count; ++j) {
      for (int i = 0; i < count; ++i) {
        triangles.push_back({corner(i, j), corner(i + 1, j), corner(i, j + 1)});
        triangles.push_back({corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)});
      }
    }
  }
  return triangles;
}

void fill(benchmark::State& state, Stepping stepping) {
  const int cell = static_cast<int>(state.range(0));
  constexpr int kLayers = 4;
  const auto triangles = net(cell, kLayers);
  for (auto _ : state) {
    state.PauseTiming();
    DepthRaster raster(kSide, kSide, Eigen::Array3d::Zero(), stepping);
    state.ResumeTiming();
    for (const auto& triangle : triangles) raster.draw(triangle);
    benchmark::DoNotOptimize(raster.picture().pixels.data());
  }
  const double pixels = static_cast<double>(triangles.size()) * cell * cell / 2;
  state.counters["pixels/s"] =
      benchmark::Counter(pixels * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(fill, direct, Stepping::direct)->Arg(10)->Arg(20)->Arg(50)->Arg(200)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fill, incremental, Stepping::incremental)->Arg(10)->Arg(50)->Unit(benchmark::kMillisecond);

Scene sphere_of_figure_13(double exponent) {
  Scene scene;
  Material material = diffuse(0.4);
  material.k_s = 0.5;
  material.phong_exponent = exponent;
  add(scene, Sphere{{0, 0, 0}, 1}, material);
  scene.ambient = Rgb::Constant(0.2);
  scene.lights = {DirectionalLight{Vec3(0.6, -1.5, 0.7).normalized(), Rgb::Ones()}};
  scene.camera.eye = {0, -40, 0};
  scene.camera.horizontal_half_angle = 0.0252;
  scene.camera.columns = scene.camera.rows = kSide;
  return scene;
}

void sphere_by_raster(benchmark::State& state, Shading shading) {
  const Scene scene = sphere_of_figure_13(static_cast<double>(state.range(0)));
  ShadingOptions options;
  options.shading = shading;
  options.samples = 1;
  Execution one;
  one.threads = 1;
  for (auto _ : state) {
    const auto view = view_shaded(scene, options, one);
    benchmark::DoNotOptimize(view->image.pixels.data());
  }
}
BENCHMARK_CAPTURE(sphere_by_raster, phong, Shading::phong)->Arg(3)->Arg(10)->Arg(100)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sphere_by_raster, gouraud, Shading::gouraud)->Arg(10)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sphere_by_raster, flat, Shading::flat)->Arg(10)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sphere_by_raster, dot, Shading::dot)->Arg(10)->Unit(benchmark::kMillisecond);

void sphere_by_rays(benchmark::State& state) {
  const Scene scene = sphere_of_figure_13(10);
  const auto accelerator = make_accelerator(scene, AcceleratorKind::bounding_volumes);
  RenderOptions options;
  options.sampling.samples_per_side = 1;
  Execution one;
  one.threads = 1;
  for (auto _ : state) {
    const auto rendering = render(*accelerator, options, one);
    benchmark::DoNotOptimize(rendering->image.pixels.data());
  }
}
BENCHMARK(sphere_by_rays)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace etendue::validation
