// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "etendue/acceleration/embree.hpp"
#include "geometry/families.hpp"
#ifdef ETENDUE_EMBREE
#include <embree3/rtcore.h>
#endif

// Nearest hits on a mesh of a million triangles, rays from anywhere in its box in any direction, one thread: our default,
// Embree alone (robust, single precision, no bounds), and Embree as our backend, whose hits are ours. Bars: the default
// half of Embree's rate, the backend 0.9 of it.
namespace etendue::validation {
namespace {

constexpr std::uint32_t kRings = 707;
constexpr std::size_t kRays = 200'000;

struct Setting {
  Scene scene;
  std::vector<Ray> rays;
  const Mesh& mesh() const { return std::get<Mesh>(scene.objects.front().shape); }
};

const Setting& setting() {
  static const Setting made = [] {
    Mesh mesh;
    const double pi = std::numbers::pi;
    for (std::uint32_t i = 0; i <= kRings; ++i) {
      for (std::uint32_t j = 0; j < kRings; ++j) {
        const double down = pi * (i + 0.5) / (kRings + 1), turn = 2 * pi * j / kRings;
        const double radius = 1 + 0.1 * std::sin(20 * down) * std::sin(20 * turn);
        mesh.vertices.push_back(radius *
                                Vec3(std::sin(down) * std::cos(turn), std::sin(down) * std::sin(turn), std::cos(down)));
      }
    }
    for (std::uint32_t i = 0; i < kRings; ++i) {
      for (std::uint32_t j = 0; j < kRings; ++j) {
        const std::uint32_t a = i * kRings + j, b = i * kRings + (j + 1) % kRings;
        mesh.triangles.push_back({a, a + kRings, b});
        mesh.triangles.push_back({b, a + kRings, b + kRings});
      }
    }
    Setting result;
    result.scene.materials.emplace_back();
    Object object;
    object.shape = std::move(mesh);
    result.scene.objects.push_back(std::move(object));
    Random random(5);
    for (std::size_t i = 0; i < kRays; ++i) {
      const Vec3 origin = random.in_cube(1.2);
      result.rays.push_back({origin, random.unit_vector()});
    }
    return result;
  }();
  return made;
}

template <class Hits>
void run(benchmark::State& state, Hits hits) {
  const auto& rays = setting().rays;
  std::size_t i = 0, met = 0, asked = 0;
  for (auto _ : state) {
    met += hits(rays[i]);
    i = (i + 1) % kRays;
    ++asked;
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()));
  state.counters["hits"] = static_cast<double>(met) / static_cast<double>(asked);
}

void by_default(benchmark::State& state) {
  static const auto accelerator = make_accelerator(setting().scene, AcceleratorKind::bounding_volumes);
  run(state, [](const Ray& ray) { return accelerator->nearest(ray).hit.has_value(); });
}

void by_embree_backend(benchmark::State& state) {
  if (const auto missing = embree_missing()) return state.SkipWithError(missing->message.c_str());
  static const auto accelerator = make_accelerator(setting().scene, AcceleratorKind::embree);
  run(state, [](const Ray& ray) { return accelerator->nearest(ray).hit.has_value(); });
}

#ifdef ETENDUE_EMBREE
RTCScene embree_scene() {
  const Mesh& mesh = setting().mesh();
  const RTCDevice device = rtcNewDevice("threads=1");
  const RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* corner = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                             3 * sizeof(float), mesh.vertices.size()));
  auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                               3 * sizeof(unsigned), mesh.triangles.size()));
  for (const Vec3& vertex : mesh.vertices) {
    for (int k = 0; k < 3; ++k) *corner++ = static_cast<float>(vertex[k]);
  }
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) *index++ = vertex;
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  return scene;
}

void by_embree_alone(benchmark::State& state) {
  static const RTCScene scene = embree_scene();
  run(state, [](const Ray& from) {
    RTCRayHit asked{};
    asked.ray.org_x = static_cast<float>(from.origin.x());
    asked.ray.org_y = static_cast<float>(from.origin.y());
    asked.ray.org_z = static_cast<float>(from.origin.z());
    asked.ray.dir_x = static_cast<float>(from.direction.x());
    asked.ray.dir_y = static_cast<float>(from.direction.y());
    asked.ray.dir_z = static_cast<float>(from.direction.z());
    asked.ray.tfar = std::numeric_limits<float>::infinity();
    asked.ray.mask = ~0U;
    asked.hit.geomID = asked.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &asked);
    return asked.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  });
}
BENCHMARK(by_embree_alone)->Name("million_triangles/embree_alone");
#endif

BENCHMARK(by_default)->Name("million_triangles/default");
BENCHMARK(by_embree_backend)->Name("million_triangles/embree_backend");

}  // namespace
}  // namespace etendue::validation
