// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/render.hpp"

#include <algorithm>
#include <memory>
#include <string>

#include "etendue/optics/colour.hpp"
#include "etendue/raytracing/camera_rays.hpp"
#include "etendue/raytracing/picture_facts.hpp"
#include "etendue/text/number_text.hpp"

namespace etendue {

namespace {

/// Rows of the picture that are sampled before their pixels are made: enough to keep threads busy, few enough to hold.
constexpr std::size_t kBatch = 64;

RenderCounts count(const RayTree& tree, int& depth) {
  RenderCounts counts;
  counts.tests = tree.tests;
  for (const RayNode& node : tree.nodes) {
    if (node.end == RayEnd::depth_limit || node.end == RayEnd::below_cutoff) {
      ++(node.end == RayEnd::depth_limit ? counts.cut_by_depth : counts.cut_by_cutoff);
      counts.largest_cut_weight += node.weight;
      continue;
    }
    if (node.end == RayEnd::environment) continue;
    depth = std::max(depth, node.level);
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

/// Whether any ray of the tree meets a surface, or crosses a body, whose index depends on the wavelength.
bool is_dispersed(const RayTree& tree, const Scene& scene) {
  return std::any_of(tree.nodes.begin(), tree.nodes.end(), [&](const RayNode& node) {
    if (node.medium && scene.materials[*node.medium].dispersion) return true;
    return node.hit && scene.materials[scene.objects[node.hit->object].material].dispersion.has_value();
  });
}

/// Whether any ray of the tree meets a surface that reflects by wavelength.
bool is_spectral(const RayTree& tree, const Scene& scene) {
  return std::any_of(tree.nodes.begin(), tree.nodes.end(), [&](const RayNode& node) {
    return node.hit && scene.materials[scene.objects[node.hit->object].material].reflectance.has_value();
  });
}

bool has_moving_bodies(const Scene& scene) {
  return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
    return moves(scene, object) && is_transparent(scene.materials[object.material]);
  });
}

PixelWindow window_of(const RenderOptions& options, const Camera& camera) {
  return options.crop.value_or(PixelWindow{0, 0, camera.columns, camera.rows});
}

std::optional<std::string> fault(const RenderOptions& options, const Camera& camera) {
  if (options.limits.depth < 0) return "depth " + std::to_string(options.limits.depth) + " is negative";
  if (!(options.limits.cutoff >= 0)) return "cutoff " + shortest(options.limits.cutoff) + " is not 0 or more";
  if (options.wavelengths < 0) return std::to_string(options.wavelengths) + " wavelengths are less than none";
  if (const auto wrong = etendue::fault(options.sampling)) return wrong;
  if (!(options.filter.radius > 0 && options.filter.radius <= kLargestFilterRadius))
    return "filter radius " + shortest(options.filter.radius) + " is not in (0, " + shortest(kLargestFilterRadius) +
           "]";
  const PixelWindow window = window_of(options, camera);
  if (window.left < 0 || window.top < 0 || window.columns() < 1 || window.rows() < 1 || window.right > camera.columns ||
      window.bottom > camera.rows)
    return "the crop has no pixel or leaves the picture";
  return std::nullopt;
}

/// The rows of one rendering on their way: begun, completed, made into pixels, forgotten.
class RowPipeline {
 public:
  RowPipeline(const Accelerator& accelerator, const CameraFrame& frame, const RenderOptions& options,
              const Execution& execution, const RenderSession& session)
      : accelerator_(accelerator),
        camera_(accelerator.scene().camera),
        frame_(frame),
        options_(options),
        execution_(execution),
        session_(session),
        window_(window_of(options, camera_)),
        around_(media_around(frame.eye, accelerator)),
        moving_bodies_(has_moving_bodies(accelerator.scene())),
        sampler_(options.sampling, options.filter, {window_.left, window_.right}, camera_.columns),
        begun_(static_cast<std::size_t>(camera_.rows)),
        completed_(begun_.size()) {
    rendering_.image = Image(window_.columns(), window_.rows());
    rendering_.row_done.assign(static_cast<std::size_t>(window_.rows()), 0);
    rendering_.facts.assign(options.facts.size(), rendering_.image);
    rendering_.row_counts.resize(begun_.size());
    if (session.before) rendering_ = *session.before;
  }

  Rendering run() {
    std::vector<int> todo;
    for (int row = window_.top; row < window_.bottom; ++row) {
      if (!done(row)) todo.push_back(row);
    }
    total_ = rows_to_complete(todo).size();
    for (std::size_t first = 0; first < todo.size() && !execution_.stopping(); first += kBatch) {
      const std::size_t last = std::min(first + kBatch, todo.size());
      run_batch({todo.begin() + static_cast<std::ptrdiff_t>(first), todo.begin() + static_cast<std::ptrdiff_t>(last)});
      sum_up();
      if (session_.watch) session_.watch(rendering_);
      const int still_needed = last < todo.size() ? todo[last] - options_.filter.reach() - 1 : camera_.rows;
      for (int row = 0; row < still_needed; ++row) slot(row).reset();
    }
    sum_up();
    return std::move(rendering_);
  }

 private:
  std::unique_ptr<SampledRow>& slot(int row) { return rows_[static_cast<std::size_t>(row)]; }
  char& done(int row) { return rendering_.row_done[static_cast<std::size_t>(row - window_.top)]; }
  RowCounts& counts(int row) { return rendering_.row_counts[static_cast<std::size_t>(row)]; }
  bool is(const std::vector<char>& state, int row) const { return state[static_cast<std::size_t>(row)] != 0; }

  /// Rows within `reach` of some of these, in the picture, in order.
  std::vector<int> within(const std::vector<int>& rows, int reach) const {
    std::vector<char> chosen(completed_.size());
    for (const int row : rows) {
      for (int near = std::max(0, row - reach); near <= std::min(camera_.rows - 1, row + reach); ++near)
        chosen[static_cast<std::size_t>(near)] = 1;
    }
    std::vector<int> result;
    for (int row = 0; row < camera_.rows; ++row) {
      if (is(chosen, row)) result.push_back(row);
    }
    return result;
  }

  std::vector<int> rows_to_complete(const std::vector<int>& shown) const {
    std::vector<int> rows = within(shown, options_.filter.reach());
    std::erase_if(rows, [&](int row) { return is(completed_, row); });
    return rows;
  }

  void run_batch(const std::vector<int>& shown) {
    const std::vector<int> completing = rows_to_complete(shown);
    std::vector<int> beginning = within(completing, 1);
    std::erase_if(beginning, [&](int row) { return is(begun_, row) || !sampler_.begins(row); });
    Execution quiet = execution_;
    quiet.progress = nullptr;
    (void)parallel_for(beginning.size(), quiet, [&](std::size_t i) { begin(beginning[i]); });
    Execution counting = execution_;
    if (execution_.progress) {
      counting.progress = [&](std::size_t, std::size_t) { execution_.progress(++rows_completed_, total_); };
    }
    (void)parallel_for(completing.size(), counting, [&](std::size_t i) { complete(completing[i]); });
    // What was sampled is not thrown away, even when stopped.
    quiet.stop = nullptr;
    (void)parallel_for(shown.size(), quiet, [&](std::size_t i) { show(shown[i]); });
  }

  Look looking(RenderCounts& counts) {
    return [this, &counts](double x, double y, const SampleKey& key) {
      const PicturePoint point{x / camera_.columns, (camera_.rows - y) / camera_.rows};
      const Ray ray = sample_ray(camera_, frame_, point, key);
      const Seen seen = moving_bodies_
                            ? see(ray, accelerator_, options_, media_around(frame_.eye, accelerator_, ray.time), key)
                            : see(ray, accelerator_, options_, around_, key);
      counts += seen.counts;
      return Glimpse{seen.colour, seen.tree_depth};
    };
  }

  void begin(int row) {
    RenderCounts work;
    slot(row) = std::make_unique<SampledRow>(sampler_.begin(row, looking(work)));
    counts(row).begun = work;
    begun_[static_cast<std::size_t>(row)] = 1;
  }

  void complete(int row) {
    const bool has_above = row > 0 && sampler_.begins(row - 1),
               has_below = row + 1 < camera_.rows && sampler_.begins(row + 1);
    // After a stop in the first step its neighbours may be missing: then it waits for another run.
    if ((sampler_.begins(row) && !slot(row)) || (has_above && !slot(row - 1)) || (has_below && !slot(row + 1))) return;
    RenderCounts work;
    if (!slot(row)) slot(row) = std::make_unique<SampledRow>(sampler_.fresh(row));
    sampler_.complete(*slot(row), has_above ? slot(row - 1).get() : nullptr, has_below ? slot(row + 1).get() : nullptr,
                      looking(work));
    counts(row).completed = work;
    completed_[static_cast<std::size_t>(row)] = 1;
  }

  void show(int row) {
    std::vector<const FilterRow*> lights;
    const int reach = options_.filter.reach();
    for (int near = std::max(0, row - reach); near <= std::min(camera_.rows - 1, row + reach); ++near) {
      if (!is(completed_, near)) return;
      lights.push_back(&slot(near)->light);
    }
    const int shown = row - window_.top;
    for (int column = window_.left; column < window_.right; ++column)
      rendering_.image.at(column - window_.left, shown) = FilterRow::resolve(lights, column, row);
    const SampledRow& sampled = *slot(row);
    for (int column = window_.left; column < window_.right && !options_.facts.empty(); ++column) {
      const PixelWork& work = sampled.work[static_cast<std::size_t>(column - sampled.columns.first)];
      const std::vector<Rgb> facts = picture_facts(accelerator_, frame_, column, row, work, options_.facts);
      for (std::size_t i = 0; i < facts.size(); ++i) rendering_.facts[i].at(column - window_.left, shown) = facts[i];
    }
    done(row) = 1;
  }

  void sum_up() {
    rendering_.counts = {};
    for (const RowCounts& row : rendering_.row_counts) (rendering_.counts += row.begun) += row.completed;
    rendering_.complete = std::count(rendering_.row_done.begin(), rendering_.row_done.end(), char{0}) == 0;
  }

  const Accelerator& accelerator_;
  const Camera& camera_;
  const CameraFrame& frame_;
  const RenderOptions& options_;
  const Execution& execution_;
  const RenderSession& session_;
  const PixelWindow window_;
  const Media around_;
  const bool moving_bodies_;  ///< then what is around the eye may change while the shutter is open
  const RowSampler sampler_;
  std::vector<char> begun_, completed_;  ///< by row of the camera's picture
  std::vector<std::unique_ptr<SampledRow>> rows_ = std::vector<std::unique_ptr<SampledRow>>(begun_.size());
  std::size_t rows_completed_ = 0, total_ = 0;
  Rendering rendering_;
};

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

Seen see(const Ray& eye_ray, const Accelerator& accelerator, const RenderOptions& options, const Media& around,
         const SampleKey& key) {
  Seen seen;
  const auto add = [&](const RayTree& tree, const Rgb& weight) {
    const Shaded shaded = shade(tree, accelerator, key.part(sample_number::kShade), options.shadows);
    RenderCounts counts = count(tree, seen.tree_depth);
    counts.shadow_rays = shaded.shadow_rays;
    counts.tests += shaded.tests;
    seen.counts += counts;
    seen.colour += weight * shaded.colour;
  };
  const SampleKey rays = key.part(sample_number::kTree);
  RayTree tree = trace(eye_ray, accelerator, options.limits, {around, 0, rays});
  const Scene& scene = accelerator.scene();
  const bool disperses = options.wavelengths > 0 && is_dispersed(tree, scene);
  if (options.wavelengths == 0 || !(disperses || is_spectral(tree, scene))) {
    add(tree, scene.white());
    recycle(std::move(tree));
    return seen;
  }
  // Sharp pictures of the parts' wavelengths would show where one stood still; colours of surfaces are smooth in it.
  auto samples = disperses ? wavelength_samples(options.wavelengths, key.number(sample_number::kWavelength))
                           : even_wavelengths(options.wavelengths);
  if (scene.illuminant) samples = lit(std::move(samples), *scene.illuminant);
  for (const WavelengthSample& sample : samples) {
    add(trace(eye_ray, accelerator, options.limits, {around, sample.wavelength, rays}), sample.weight);
  }
  return seen;
}

Result<Rendering> render(const Accelerator& accelerator, const RenderOptions& options, const Execution& execution,
                         const RenderSession& session) {
  const Camera& camera = accelerator.scene().camera;
  if (const auto wrong = fault(options, camera)) return Error{ErrorCode::usage, "render: " + *wrong};
  const auto frame = camera_frame(camera);
  if (!frame) return frame.error();
  return RowPipeline(accelerator, *frame, options, execution, session).run();
}

}  // namespace etendue
