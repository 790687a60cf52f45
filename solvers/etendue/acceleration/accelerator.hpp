// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "etendue/geometry/hit.hpp"
#include "etendue/geometry/ray.hpp"
#include "etendue/scene/scene.hpp"

namespace etendue {

/// A hit, and whose it is.
struct SceneHit {
  Hit hit;
  std::size_t object = 0;  ///< index into Scene::objects
  std::size_t part = 0;    ///< triangle of a mesh; 0 for every other shape
};

/// How much work a question was: nine tenths of ray tracing are intersection tests.       @eq IU.5.7, IU.5.7n
struct TestCount {
  std::uint64_t surfaces = 0;  ///< ray against a shape, or a triangle of a mesh
  std::uint64_t volumes = 0;   ///< ray against a bounding volume, or the box of a voxel
  std::uint64_t voxels = 0;    ///< undivided voxels of a grid or an octree that the ray entered

  TestCount& operator+=(const TestCount& other) {
    surfaces += other.surfaces;
    volumes += other.volumes;
    voxels += other.voxels;
    return *this;
  }
};

/// Answer to "what does the ray meet first?"
struct Nearest {
  std::optional<SceneHit> hit;
  TestCount tests;
};

/// Answer to "does the ray meet anything?"
struct Obstruction {
  bool blocked = false;
  TestCount tests;
};

/// Answers rays about one scene, which must outlive it and stay as it is.
///
/// Every accelerator (but Embree, embree.hpp) gives the same answers, bit for bit: the hit with the smallest t in (ray.t_min, ray.t_max); of
/// equal t, the one of the smallest object index; of equal objects, the smallest part. Only the work differs.
/// Objects that move are met where they are at ray.time, in [0, camera.shutter].
/// Safe to ask from several threads at once.
class Accelerator {
 public:
  virtual ~Accelerator() = default;

  /// Procedure RT(P0, d, t0, t1): nothing, or the parameter (with point, normal and object).         @eq RT.3
  [[nodiscard]] virtual Nearest nearest(const Ray& ray) const = 0;

  /// Whether nearest(ray) finds a hit, for less work.
  [[nodiscard]] virtual Obstruction obstruction(const Ray& ray) const = 0;

  [[nodiscard]] const Scene& scene() const { return scene_; }

  /// Whether light goes through any surface (k_t > 0); otherwise whatever blocks a ray is opaque.
  [[nodiscard]] bool has_transparent_surfaces() const { return transparent_; }

 protected:
  explicit Accelerator(const Scene& scene);
  Accelerator(const Accelerator&) = default;
  Accelerator& operator=(const Accelerator&) = delete;

 private:
  const Scene& scene_;
  bool transparent_;
};

enum class AcceleratorKind {
  brute_force,       ///< every surface is tested
  bounding_volumes,  ///< hierarchy of boxes
  bounding_spheres,  ///< hierarchy of spheres
  grid,              ///< equal voxels
  octree,            ///< voxels divided where the surfaces are
  embree,            ///< triangles as Embree proposes them: only where embree_missing() says nothing (embree.hpp)
};

[[nodiscard]] std::unique_ptr<const Accelerator> make_accelerator(const Scene& scene, AcceleratorKind kind);

}  // namespace etendue
