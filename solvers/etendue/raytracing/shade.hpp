// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "etendue/raytracing/ray_tree.hpp"
#include "etendue/raytracing/sample_key.hpp"
#include "etendue/raytracing/shadow.hpp"
#include "etendue/raytracing/surface_colour.hpp"

namespace etendue {

/// The unit vector from a point towards a light (the middle of one with an area), and how far it is.
struct LightSample {
  Vec3 to_light;    ///< L
  double distance;  ///< infinity for a directional light
};
[[nodiscard]] LightSample towards(const Light& light, const Vec3& point);
/// What of its intensity arrives at that distance; of lights other than points, all.    @eq IU.2-5, IU.2.6a
[[nodiscard]] double arriving_share(const Light& light, double distance);

/// The shadow ray of a hit and a light.                                                     @eq IU.5.4a, IU.5.4b, RT.14
///
/// It begins outside the error bound of the hit (no tolerance on t, no excluded surface) and runs towards the light:
/// for a directional light that travels along l, this is RT(M, −l, 0, ∞), and what it finds are blockers (erratum R7).
/// It ends at a point light, so only a hit nearer than the light blocks. The text's cures of acne stand beside ours.
[[nodiscard]] Ray shadow_ray(const Hit& hit, const Light& light, AcneCure cure = AcneCure::error_bound);

/// What one eye ray sees.
struct Shaded {
  Rgb colour = Rgb::Zero();
  std::uint64_t shadow_rays = 0;
  TestCount tests;  ///< of the shadow rays
};

/// Local part of equation 5-2 where a ray of the tree met a surface: emission, and local_reflection() of the lights that
/// reach it, each weakened by what its shadow ray passes.
///
///     I = E + k_a I_a + Σ_i I_p,i s_i [ k_d max(0, N·L_i) + k_s max(0, R_i·V)ⁿ ]
///
/// Symbols   N the geometric normal on the viewer's side; V = −direction; L_i towards light i; I_pi its intensity, s_i the
///           share of it that passage() leaves; the sum is over the lights that stand before the surface. E, the
///           material's emission, counts as an intensity.
/// Where the material has a bump, shading_normal() is the N of the products; a light still has to stand before the surface itself, so
/// that none leaks through from behind.                                                                   @eq IU.4.2.1
/// As mended: k_d tints the diffuse term only (E2), R is the mirror of each light's own L (E3)
/// At a wavelength, a material's reflectance there is its k_d and k_a.                          @eq IU.2.9b
/// Of a light with an area, each of the point lights that it is (light_part()) counts so; light i draws from key.part(i).
[[nodiscard]] Shaded local_illumination(const RayNode& node, const Accelerator& accelerator, const SampleKey& key = {},
                                        const Shadows& shadows = {}, double wavelength = 0);

/// Intensity that comes back along the tree's first ray.                                      @eq IU.5-2
///
///     I = [ I_local + k_r I_r + k_t I_t ] exp(−σ d)    for each ray that met a surface, from the leaves to the root
///
/// Symbols   σ absorption of the body that the ray travels in, d the ray's length: transmittance()
/// A ray that left the scene brings the background, one that ends in a mirror's environment what its images show in
/// that direction (IU.4.1.3), one that was not followed nothing.
/// Ray i of the tree draws its random numbers from key.part(i).
[[nodiscard]] Shaded shade(const RayTree& tree, const Accelerator& accelerator, const SampleKey& key = {},
                           const Shadows& shadows = {});

}  // namespace etendue
