// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "etendue/execution/execution.hpp"
#include "etendue/geometry/vertex_normals.hpp"
#include "etendue/image/image.hpp"
#include "etendue/meshing/tessellation.hpp"
#include "etendue/raster/gouraud.hpp"

namespace etendue {

/// What is computed where on a net of polygons, and what is interpolated from there.
enum class Shading {
  flat,     ///< one intensity a facet, at its centre, with its own normal                     @eq IU.3.1
  gouraud,  ///< intensities at the corners, interpolated                                      @eq IU.3.2b
  phong,    ///< normals at the corners, interpolated and made unit vectors again              @eq IU.3.3, G4
  dot,      ///< N·L and R·V at the corners, interpolated: reflection_of_cosines()             @eq IU.3.4
};

struct ShadingOptions {
  Shading shading = Shading::phong;
  NormalWeight weight = NormalWeight::angle;  ///< the same however polygons are cut into triangles
  TessellationOptions net;
  Stepping stepping = Stepping::direct;  ///< along rows, of normals too                       @eq IU.3.2c, IU.3.3
  int samples = 2;                       ///< samples × samples centres a pixel, averaged
  int wavelengths = 0;                   ///< at which what has a reflectance is seen, as by see(); 0: in three channels
};

struct ShadedView {
  Image image;             ///< linear, not limited
  std::size_t facets = 0;  ///< triangles of the scene, seen or not
};

/// Memory that view_shaded() takes for a pixel, at most [bytes].
inline constexpr double kBytesAShadedPixel = 2 * sizeof(Eigen::Array3d);

/// A picture of the scene by rasteriser: every surface as triangles, nearest ones by depth buffer, the local model of
/// illumination with all lights, nothing that takes a further ray.                                      @eq IU.3.2a
///
///     I = E + local_reflection(N, V, lights)      N by `shading`, turned to the viewer's side with its facet
///
/// A facet whose material has a law of see_through is seen through: I = (1 − t) I + t I_behind, pixel by pixel from the
/// farthest to the nearest, t by the law from N·V. Both walls of a body count.                       @eq IU.4.4a, IU.4.4b
///
/// Patterns and textures have the colours of the pixel's own place, by u and v that are linear on the surface where they
/// follow its parameters; flat and Gouraud's shading interpolate the light that these reflect.           @eq IU.4-1, IU.4.1.2
///
/// With `wavelengths` a sample that shows a surface with a reflectance, or through one, is Σ_i w_i I(λ_i), as see() has it; all
/// others are what they are without, to the bit.                                                              @eq IU.2.9b
/// Symbols   as for local_illumination(), which the ray tracer uses; a light with an area counts as its middle. Values are
///           interpolated on the surface, so perspective does not bend them. Where `shading` is phong bumps turn N, and
///           mirrored_environment() is added                                                   @eq IU.4.2.1, IU.4.1.3
/// Domain    any camera that camera_frame() accepts; columns and rows times samples at most 2^16; samples ≥ 1; wavelengths ≥ 0
/// Returns   the same bits for any number of threads; what left_out() says is not in it
/// Errors    those of camera_frame() and tessellated(); a picture that is too large; ErrorCode::stopped, between bands of rows
[[nodiscard]] Result<ShadedView> view_shaded(const Scene& scene, const ShadingOptions& options,
                                             const Execution& execution = {});

/// What of a scene view_shaded() leaves out with this shading, a phrase each: "reflection (k_r of 'mirror')".
[[nodiscard]] std::vector<std::string> left_out(const Scene& scene, Shading shading = Shading::phong);

}  // namespace etendue
