// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "oracles/round_factor.hpp"

namespace etendue::oracle {

/// Families of random pairs of polygons, spheres, discs and cylinders, in which something is round.
///
///     free       nothing between, from far apart to near
///     floating   one to three spheres, discs, cylinders, boxes, plates between
///     standing   a cylinder or a box stands on one of the two, a sphere lies on it, upright or not
///     touching   the two touch: a sphere or a cylinder on a plate, two spheres; with up to two things about
///     tiny       one of the two, or what is between, has a size of 10^-3 … 10^-1
///     hidden     something between hides most
enum class RoundFamily { free, floating, standing, touching, tiny, hidden };
inline constexpr std::array<RoundFamily, 6> kRoundFamilies{RoundFamily::free,     RoundFamily::floating,
                                                           RoundFamily::standing, RoundFamily::touching,
                                                           RoundFamily::tiny,     RoundFamily::hidden};
[[nodiscard]] std::string_view name(RoundFamily family);

inline constexpr int kRoundPairs = 60;  ///< of each family

/// Number `index` of a family: always the same, in a frame of its own.
[[nodiscard]] RoundPair round_pair(RoundFamily family, int index);

}  // namespace etendue::oracle
