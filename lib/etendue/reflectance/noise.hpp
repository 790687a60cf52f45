// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "etendue/geometry/vector.hpp"

namespace etendue {

/// 64 bits that look random, of a seed and three whole numbers: a counter, not a sequence, so that order of asking and
/// threads change nothing.
[[nodiscard]] std::uint64_t lattice_hash(std::uint64_t seed, std::int64_t i, std::int64_t j, std::int64_t k);

/// Gradient noise: a random slope at each point of the unit lattice, between them blended by f(t) = 6t⁵ − 15t⁴ + 10t³.
///
///     n(p) = Σ_c Π_a W(p_a − c_a) g_c·(p − c),   W(x) = 1 − f(|x|),   c the eight lattice points around p
///
/// Symbols   p in units of the lattice; g_c one of 32 unit vectors (corners of an icosahedron and of a dodecahedron, whose
///           mean of g gᵀ is ⅓ 1), as lattice_hash() says
/// Returns   0 at lattice points, within ±kNoiseBound, with continuous first and second derivatives. The covariance of n(p)
///           and n(p + h) over all p is ⅓ Σ_a A(h_a) Π_b≠a B(h_b), A(h) = ∫ x (x + h) W(x) W(x + h) dx, B without the x (x + h):
///           the same along the axes, and along diagonals smaller by kNoiseAnisotropy of the variance at most: almost, but not
///           isotropic. Far from the origin, where doubles are whole numbers, 0
/// Domain    finite p
/// Accuracy  the bounds are proved in NOTES.md §8
/// Source    Perlin 2002, Improving noise, doi 10.1145/566654.566636: the blend. Directions and hash are ours
[[nodiscard]] double gradient_noise(const Vec3& p, std::uint64_t seed);

/// √3/2, and bounds on each first and on each second derivative along an axis: NOTES.md §8.
inline constexpr double kNoiseBound = 0.8660254037844387;
inline constexpr double kNoiseSlope = 7.5;
inline constexpr double kNoiseCurvature = 27.5;

/// Of the variance, 0.0365: by how much covariances at equal distance differ, most at 1.2 units; computed.
inline constexpr double kNoiseAnisotropy = 0.034;

/// Noise on noise: Σ_k 2^-k n(2^k p + k s), k = 0 … octaves − 1. The shift s keeps zeros from falling together.
///
/// Returns   within ±2 kNoiseBound
/// Domain    finite p; octaves ≥ 1
[[nodiscard]] double fractal_noise(const Vec3& p, int octaves, std::uint64_t seed);

/// With more octaves the last ones are finer than the digits of the first.
inline constexpr int kMostOctaves = 16;

}  // namespace etendue
