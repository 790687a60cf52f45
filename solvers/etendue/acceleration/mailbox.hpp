// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace etendue {

/// Which surfaces a ray has been tested against already: a surface may lie in many voxels.                @eq IU.5.7.2a
///
/// Every thread has one, which it lends to the accelerator that asks: begin a ray, then ask once for each surface.
class Mailbox {
 public:
  /// The thread's own mailbox, made ready for a new ray among `count` surfaces of the accelerator `owner`, a number
  /// that no other accelerator has (unused_owner()).
  static Mailbox& for_ray(std::uint64_t owner, std::size_t count) {
    thread_local Mailbox own;
    if (own.owner_ != owner) {
      own.owner_ = owner;
      own.ray_ = 0;
      own.seen_by_.assign(count, 0);
    }
    ++own.ray_;
    return own;
  }
  static std::uint64_t unused_owner();

  /// True when this ray asks for the surface for the first time.
  bool first_time(std::size_t surface) {
    if (seen_by_[surface] == ray_) return false;
    seen_by_[surface] = ray_;
    return true;
  }

 private:
  std::uint64_t owner_ = 0, ray_ = 0;
  std::vector<std::uint64_t> seen_by_;
};

}  // namespace etendue
