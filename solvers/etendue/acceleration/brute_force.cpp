// SPDX-License-Identifier: Apache-2.0
#include "etendue/acceleration/brute_force.hpp"

#include "etendue/acceleration/search.hpp"

namespace etendue {

Nearest BruteForce::nearest(const Ray& ray) const {
  NearestSearch search(scene(), ray);
  for (const Surface& surface : surfaces_) search.try_counted(surface);
  return search.answer();
}

Obstruction BruteForce::obstruction(const Ray& ray) const {
  ObstructionSearch search(scene(), ray);
  (void)search.any_blocks(surfaces_);
  return search.answer();
}

}  // namespace etendue
