// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/render.hpp"

#include <algorithm>

#include "etendue/raytracing/camera_rays.hpp"

namespace etendue {

namespace {

RenderCounts count(const RayTree& tree) {
  RenderCounts counts;
  counts.tests = tree.tests;
  for (const RayNode& node : tree.nodes) {
    if (node.end == RayEnd::depth_limit || node.end == RayEnd::below_cutoff) {
      ++(node.end == RayEnd::depth_limit ? counts.cut_by_depth : counts.cut_by_cutoff);
      counts.largest_cut_weight += node.weight;
      continue;
    }
    switch (node.kind) {
      case RayKind::eye:
        ++counts.eye_rays;
        break;
      case RayKind::reflected:
        ++counts.reflected_rays;
        break;
      case RayKind::transmitted:
        ++counts.transmitted_rays;
        break;
    }
  }
  return counts;
}

std::optional<std::string> fault(const RenderOptions& options) {
  if (options.limits.depth < 0) return "depth " + std::to_string(options.limits.depth) + " is negative";
  if (!(options.limits.cutoff >= 0)) return "cutoff " + std::to_string(options.limits.cutoff) + " is not 0 or more";
  if (options.samples_per_side < 1)
    return std::to_string(options.samples_per_side) + " samples a side is less than one";
  return std::nullopt;
}

}  // namespace

RenderCounts& RenderCounts::operator+=(const RenderCounts& other) {
  eye_rays += other.eye_rays;
  reflected_rays += other.reflected_rays;
  transmitted_rays += other.transmitted_rays;
  shadow_rays += other.shadow_rays;
  tests += other.tests;
  cut_by_depth += other.cut_by_depth;
  cut_by_cutoff += other.cut_by_cutoff;
  largest_cut_weight = std::max(largest_cut_weight, other.largest_cut_weight);
  return *this;
}

double sample_position(int index, int samples_per_side) {
  return (index + 0.5) / samples_per_side;
}

Result<Rendering> render(const Accelerator& accelerator, const RenderOptions& options, const Execution& execution) {
  if (const auto wrong = fault(options)) return Error{ErrorCode::usage, "render: " + *wrong};
  const Camera& camera = accelerator.scene().camera;
  const auto frame = camera_frame(camera);
  if (!frame) return frame.error();

  Rendering rendering;
  rendering.image = Image(camera.columns, camera.rows);
  rendering.row_done.assign(static_cast<std::size_t>(camera.rows), 0);
  std::vector<RenderCounts> row_counts(static_cast<std::size_t>(camera.rows));
  const int n = options.samples_per_side;

  const auto render_row = [&](std::size_t index) {
    const int row = static_cast<int>(index);
    for (int column = 0; column < camera.columns; ++column) {
      Rgb sum = Rgb::Zero();
      for (int sample = 0; sample < n * n; ++sample) {
        const PicturePoint point =
            picture_point(camera, column, row, sample_position(sample % n, n), sample_position(sample / n, n));
        const RayTree tree = trace(eye_ray(*frame, point), accelerator, options.limits);
        const Shaded shaded = shade(tree, accelerator);
        RenderCounts counts = count(tree);
        counts.shadow_rays = shaded.shadow_rays;
        counts.tests += shaded.tests;
        row_counts[index] += counts;
        sum += shaded.colour;
      }
      rendering.image.at(column, row) = sum / (n * n);
    }
    rendering.row_done[index] = 1;
  };
  rendering.complete = parallel_for(rendering.row_done.size(), execution, render_row);
  for (const RenderCounts& counts : row_counts) rendering.counts += counts;
  return rendering;
}

}  // namespace etendue
