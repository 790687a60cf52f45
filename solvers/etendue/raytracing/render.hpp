// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "etendue/execution/execution.hpp"
#include "etendue/image/image.hpp"
#include "etendue/raytracing/sampling.hpp"
#include "etendue/raytracing/shade.hpp"

namespace etendue {

/// A rectangle of pixels: columns [left, right), rows [top, bottom), counted from the picture's upper left corner.
struct PixelWindow {
  int left = 0, top = 0, right = 0, bottom = 0;
  int columns() const { return right - left; }
  int rows() const { return bottom - top; }
};

/// What else a picture can tell of each pixel, besides its colour.
enum class PictureFact {
  depth,   ///< at time 0, along the ray through the pixel's centre, the distance from the eye; 0 where it meets nothing
  normal,  ///< there, the surface's unit normal on the viewer's side, x, y, z in the scene; 0 where there is none
  albedo,  ///< there, k_d, with its pattern
  object,  ///< there, the index of the object; −1 where there is none
  samples,     ///< number of samples on which the pixel rests, but for what a filter takes from the neighbours
  tree_depth,  ///< greatest level of a ray that was followed for these
};

/// What a picture is asked to be.
struct RenderOptions {
  TreeLimits limits;
  Sampling sampling;
  PixelFilter filter;
  std::optional<PixelWindow> crop;  ///< only this part, with the bits it has in the whole
  std::vector<PictureFact> facts;
  Shadows shadows;
  int wavelengths = 0;  ///< parts of the visible light that are traced apart, see(); 0: all light at once
};

/// The work a picture was, and what was left out of it.
struct RenderCounts {
  std::uint64_t eye_rays = 0;
  std::uint64_t reflected_rays = 0;
  std::uint64_t transmitted_rays = 0;
  std::uint64_t shadow_rays = 0;
  TestCount tests;
  std::uint64_t cut_by_depth = 0;  ///< rays that were asked for and not followed, by reason
  std::uint64_t cut_by_cutoff = 0;
  double largest_cut_weight = 0;  ///< over the samples, of the summed weights of the rays not followed: no sample is
                                  ///< darker by more than this times the brightest light that such a ray could bring

  std::uint64_t rays() const { return eye_rays + reflected_rays + transmitted_rays + shadow_rays; }
  RenderCounts& operator+=(const RenderCounts& other);
};

/// What an eye ray sees, and the work it was.
struct Seen {
  Rgb colour = Rgb::Zero();
  RenderCounts counts;
  int tree_depth = 0;  ///< greatest level of a ray that was followed
};

/// Traces and shades one eye ray: once, or once for each part of the visible light.     @eq IU.5-2, IU.4-6, IU.2.9b
///
///     colour = Σ_i w_i I(λ_i)        per channel; w_i, λ_i of wavelength_samples() where an index depends on λ, else of
///                                    even_wavelengths(), and both lit() by the scene's illuminant
///
/// With `wavelengths` the index of each medium is that for λ_i, and so is a reflectance; other colours stay what they are
/// per channel. A ray whose tree meets nothing of both is traced once, and seen in the illuminant's white: a scene
/// without such materials gives the same bits with any number of parts.
/// Symbols   around: media_around() the eye; where in each part the wavelength lies, and where frost sends rays, the key says
[[nodiscard]] Seen see(const Ray& eye_ray, const Accelerator& accelerator, const RenderOptions& options,
                       const Media& around, const SampleKey& key = {});

/// What became of a row of the whole camera picture, in the two steps of RowSampler.
struct RowCounts {
  RenderCounts begun, completed;
};

/// A picture and how it came about. Rows that were not computed (stopped) are black and false in row_done.
struct Rendering {
  Image image;
  std::vector<char> row_done;
  std::vector<Image> facts;  ///< in the order of RenderOptions::facts; where one number is told, in all channels
  std::vector<RowCounts> row_counts;  ///< by row of the camera's picture: of a crop, more than it shows
  RenderCounts counts;                ///< their sum; rays for facts are not counted
  bool complete = false;
};

/// What a rendering goes on from, and whom it shows itself to while it grows.
struct RenderSession {
  const Rendering* before = nullptr;                      ///< of the same scene and options: its finished rows are kept
  std::function<void(const Rendering&)> watch = nullptr;  ///< called now and then, from the caller's thread
};

/// Recursive ray tracing of the scene as its camera sees it.                                       @eq IU.5-2, IU.5.2
///
/// Samples are taken as RowSampler takes them, and filtered into pixels by FilterRow.
///
/// Returns   linear colours, not clamped; the same bits for any number of threads, any accelerator, in any crop, and however
///           often it was stopped and resumed; counts likewise, but for a crop, whose neighbours are looked at, too
/// Errors    those of camera_frame(); options outside depth ≥ 0, cutoff ≥ 0, fault(sampling), a filter radius in (0, 16], a crop
///           in the picture are refused as a usage error
[[nodiscard]] Result<Rendering> render(const Accelerator& accelerator, const RenderOptions& options,
                                       const Execution& execution, const RenderSession& session = {});

/// Widest filter: what a pixel takes from more than sixteen pixels away is no longer a picture.
inline constexpr double kLargestFilterRadius = 16;

}  // namespace etendue
