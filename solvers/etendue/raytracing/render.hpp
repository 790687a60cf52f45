// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/execution/execution.hpp"
#include "etendue/image/image.hpp"
#include "etendue/raytracing/shade.hpp"

namespace etendue {

/// What a picture is asked to be.
struct RenderOptions {
  TreeLimits limits;
  int samples_per_side = 1;  ///< N: each pixel is the mean of N × N rays
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

/// A picture and how it came about. Rows that were not computed (stopped) are black and false in row_done.
struct Rendering {
  Image image;
  std::vector<char> row_done;
  RenderCounts counts;
  bool complete = false;
};

/// Positions of N samples across a pixel: the centres of N equal parts.                            @eq IU.5.8.1
[[nodiscard]] double sample_position(int index, int samples_per_side);

/// Recursive ray tracing of the scene as its camera sees it.                                       @eq IU.5-2, IU.5.2
///
/// Each pixel is divided into N × N equal parts, a ray is traced through the centre of each (uniform supersampling),
/// and the pixel is their mean (box filter), summed row by row from the top left.
///
/// Returns   linear colours, not clamped; the same bits for any number of threads and either accelerator
/// Errors    those of camera_frame(); options outside depth ≥ 0, cutoff ≥ 0, N ≥ 1 are refused as a usage error
[[nodiscard]] Result<Rendering> render(const Accelerator& accelerator, const RenderOptions& options,
                                       const Execution& execution);

}  // namespace etendue
