// SPDX-License-Identifier: Apache-2.0
#include "etendue/acceleration/brute_force.hpp"

namespace etendue {

Nearest BruteForce::nearest(const Ray& ray) const {
  Nearest answer;
  for (const Surface& surface : surfaces_) {
    ++answer.tests.surfaces;
    const auto hit = intersect(ray, scene(), surface);
    if (!hit) continue;
    const SceneHit candidate{*hit, surface.object, surface.part};
    if (!answer.hit || precedes(candidate, *answer.hit)) answer.hit = candidate;
  }
  return answer;
}

Obstruction BruteForce::obstruction(const Ray& ray) const {
  Obstruction answer;
  for (const Surface& surface : surfaces_) {
    ++answer.tests.surfaces;
    answer.blocked = intersect(ray, scene(), surface).has_value();
    if (answer.blocked) break;
  }
  return answer;
}

}  // namespace etendue
