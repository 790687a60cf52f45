// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "etendue/geometry/vector.hpp"

namespace etendue {

inline constexpr std::size_t kLanes = 8;

/// Σ w (n_1·r)(−n_2·r)/r⁴ over the nodes of a product rule on [−1, 1]⁴, for one source parallelogram and eight
/// receivers side by side. The same operations in the same order in every lane and with every instruction set.
struct ProductRule {
  static constexpr std::size_t kMostPoints = 81;
  using Lanes = std::array<double, kLanes>;

  void set_source(const Vec3& first, const Vec3& second, int n_first, int n_second);
  /// `between` leads from the source's centre to the receiver's.
  void set_lane(std::size_t lane, const Vec3& source_normal, const Vec3& between, const Vec3& first, const Vec3& second,
                const Vec3& normal);
  /// Fills `total`; wide: with the widest vectors the machine has.
  void sum(int n_first, int n_second, bool wide);

  Lanes total{};

  std::size_t points = 0;  ///< of the source
  std::array<double, kMostPoints> s{}, t{}, x{}, y{}, z{}, weight{};
  std::array<Lanes, 3> between{}, half_1{}, half_2{};
  Lanes height{}, rise_1{}, rise_2{}, depth{}, fall_1{}, fall_2{};
  Vec3 source_1, source_2;
};

[[nodiscard]] bool has_wide_vectors();

}  // namespace etendue
