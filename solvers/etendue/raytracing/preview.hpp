// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/raytracing/render.hpp"

namespace etendue {

/// A coarse picture, of the size that render() would make: every square of `step` by `step` pixels of the camera's picture
/// has the colour that one ray through its centre sees.
///
/// Domain    step ≥ 1; options that render() accepts, of which sampling, filter and facts are without meaning here
/// Returns   nothing if it was stopped
/// Errors    those of camera_frame()
[[nodiscard]] Result<std::optional<Image>> preview(const Accelerator& accelerator, const RenderOptions& options,
                                                   int step, const Execution& execution);

}  // namespace etendue
