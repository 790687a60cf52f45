// SPDX-License-Identifier: Apache-2.0
// One step of progressive refinement, and what its memory costs.
#include <benchmark/benchmark.h>
#include <malloc.h>

#include "refinement/shooting_scenes.hpp"

namespace etendue::validation {
namespace {

std::size_t allocated() {
  const auto info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// A room with a box, so divided that about so many elements are there; patches of 5 × 5 elements.
Scene large(int cells) {
  Scene scene = furnished(cells, cells / 5, false);
  for (std::size_t k = 7; k < scene.objects.size(); ++k) scene.objects[k].subdivision = {{20, 20}, {4, 4}};
  return scene;
}

void shooting_step(benchmark::State& bench) {
  const Scene scene = large(static_cast<int>(bench.range(0)));
  const std::size_t before = allocated();
  const PatchModel model = model_of(scene);
  const auto factors = hemicube_factors(model, {PixelBody::hemicube, 256, 1, false, 1});
  SceneShooting state = begin(scene, model);
  const Execution how{static_cast<int>(bench.range(1)), {}, nullptr};
  for (auto _ : bench) {
    const std::size_t patch = brightest_unshot(model, state);
    shoot(state, scene, model, patch, factors->from_patch(patch, how));
  }
  const auto n = static_cast<double>(model.element_areas.size());
  bench.counters["elements"] = n;
  bench.counters["bytes/element"] = static_cast<double>(allocated() - before) / n;
}
BENCHMARK(shooting_step)->Args({55, 1})->Args({55, 2})->Args({20, 2})->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace etendue::validation
