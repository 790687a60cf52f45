// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "etendue/view/facet_shader.hpp"

namespace etendue {

/// What FacetShader::phong() computes, for several pixels at a time: coordinates stand in columns, so that a processor draws two
/// roots or divides twice with each instruction. To the bit what phong() gives: the same operations in the same order.
class PhongRun {
 public:
  explicit PhongRun(const FacetShader& shader);
  PhongRun(const PhongRun&) = delete;
  PhongRun& operator=(const PhongRun&) = delete;
  ~PhongRun() = default;

  /// Whether nothing but N·L and R·V is asked of the material: no bump, no environment, no other law than Phong's.
  static bool takes(const Material& material) { return !material.bump && !material.environment && !material.highlight; }

  /// The colour is there after the next finish(), maybe before; the weights have to stay until then.
  void add(const Facet& facet, const Eigen::Array3d& weights, Rgb& colour) {
    pixels_[static_cast<std::size_t>(count_)] = {&facet, &weights, &colour};
    put(facet, weights);
    if (++count_ == kLength) finish();
  }
  void finish();

 private:
  static constexpr int kLength = 16;
  using Column = Eigen::Array<double, kLength, 1>;
  struct Vectors {
    Column x = Column::Ones(), y = Column::Zero(), z = Column::Zero();

    // The order of the sums is that of Eigen's vectors of three.
    Column dot(const Vectors& other) const { return x * other.x + y * other.y + z * other.z; }
    Column dot(const Vec3& other) const { return x * other.x() + y * other.y() + z * other.z(); }
    void divide(const Column& by) { x /= by, y /= by, z /= by; }
    Vec3 at(int i) const { return {x[i], y[i], z[i]}; }
    void put(int i, const Vec3& value) { x[i] = value.x(), y[i] = value.y(), z[i] = value.z(); }
  };
  struct Pixel {
    const Facet* facet;
    const Eigen::Array3d* weights;
    Rgb* colour;
  };

  void put(const Facet& facet, const Eigen::Array3d& weights);
  void normalize();
  void see(std::size_t light);

  const FacetShader& shader_;
  int count_ = 0;
  std::array<Pixel, kLength> pixels_{};
  Vectors points_, normals_, views_;
  std::vector<LightCosines> cosines_;  // of a pixel and light after light, then of the next pixel
};

}  // namespace etendue
