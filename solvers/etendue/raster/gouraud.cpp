// SPDX-License-Identifier: Apache-2.0
#include "etendue/raster/gouraud.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

/// Rounds to multiples of 2^(e−50), where 2^e ≤ `largest` < 2^(e+1), by adding 3·2^(e+1), whose last place that is, and
/// taking it away: numbers up to 2^(e+1) then have 51 bits, and so have sums of them and of their differences.
class Multiples {
 public:
  Multiples() = default;
  explicit Multiples(double largest) {
    constexpr std::uint64_t kLeastExponent = 64, kHalf = std::uint64_t{1} << 51;
    const std::uint64_t exponent = std::max(std::bit_cast<std::uint64_t>(largest) >> 52, kLeastExponent);
    shift_ = std::bit_cast<double>(((exponent + 2) << 52) | kHalf);
  }
  double rounded(double value) const { return (value + shift_) - shift_; }

 private:
  double shift_ = 0;
};

/// What is interpolated along the rows of a triangle: v_k/w_k of three channels, and 1/w_k.
struct Numerators {
  std::array<std::array<double, 3>, 3> value;  // channel, corner; over the area
  std::array<double, 3> inverse_depth;         // over the area
  std::array<Multiples, 3> multiples;
  std::array<double, 3> step;
  double depth_step = 0;
};

double combined(const std::array<double, 3>& weight, const std::array<double, 3>& value) {
  return weight[0] * value[0] + weight[1] * value[1] + weight[2] * value[2];
}

template <Stepping kStepping>
double placed(const Multiples& multiples, double value) {
  return kStepping == Stepping::direct ? value : multiples.rounded(value);
}

template <Stepping kStepping>
Numerators numerators(const std::array<GouraudVertex, 3>& triangle, const TriangleSpans& spans) {
  Numerators all;
  std::array<double, 3> grows{};
  const double share = 1 / spans.area();
  for (std::size_t k = 0; k < 3; ++k) {
    grows[k] = static_cast<double>(spans.step(k));
    all.inverse_depth[k] = triangle[k].inverse_depth * share;
  }
  for (std::size_t c = 0; c < 3; ++c) {
    double largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double value = triangle[k].value[static_cast<Eigen::Index>(c)] * triangle[k].inverse_depth;
      largest = std::max(largest, std::abs(value));
      all.value[c][k] = value * share;
    }
    if constexpr (kStepping != Stepping::direct) all.multiples[c] = Multiples(largest);
    all.step[c] = placed<kStepping>(all.multiples[c], combined(grows, all.value[c]));
  }
  all.depth_step = combined(grows, all.inverse_depth);
  return all;
}

/// Asks the memory for the pixels beside a span. Small triangles write short pieces of many rows, which no processor foresees, and what
/// is drawn next is mostly their neighbour: a fifth of their time was spent in waiting.
template <class T>
void fetch(const std::vector<T>& pixels, std::size_t from) {
  constexpr std::size_t kAhead = 10, kLine = 64;  // [pixels], [bytes]
  if (from + kAhead > pixels.size()) return;
  const auto* bytes = reinterpret_cast<const char*>(pixels.data() + from);
  for (std::size_t i = 0; i < kAhead * sizeof(T); i += kLine) __builtin_prefetch(bytes + i, 1);
}

/// Calls show(index, value, inverse depth) for each pixel of the triangle that is nearer than what `depths` holds; values go to
/// `values`.
template <Stepping kStepping, class Show>
void step(const std::array<GouraudVertex, 3>& triangle, const ScanWindow& window, const std::vector<double>& depths,
          const std::vector<Eigen::Array3d>& values, const Show& show) {
  for (const auto& corner : triangle) require(corner.inverse_depth > 0, "draw: corners lie before the eye");
  TriangleSpans spans({triangle[0].position, triangle[1].position, triangle[2].position}, window);
  Span span;
  if (!spans.next(span)) return;
  const Numerators all = numerators<kStepping>(triangle, spans);
  do {
    std::array<double, 3> weight{};
    for (std::size_t k = 0; k < 3; ++k) weight[k] = static_cast<double>(span.weight[k]);
    const double nearness = combined(weight, all.inverse_depth);
    std::array<double, 3> start{};
    for (std::size_t c = 0; c < 3; ++c) start[c] = placed<kStepping>(all.multiples[c], combined(weight, all.value[c]));
    std::array<double, 3> sum = start;
    const std::size_t first =
        static_cast<std::size_t>(span.row - window.first_row) * static_cast<std::size_t>(window.columns) +
        static_cast<std::size_t>(span.begin);
    const int count = span.end - span.begin;
    fetch(depths, first + static_cast<std::size_t>(count));
    fetch(values, first + static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      const std::size_t index = first + static_cast<std::size_t>(i);
      const double t = i;
      if constexpr (kStepping != Stepping::incremental) {
        for (std::size_t c = 0; c < 3; ++c) sum[c] = start[c] + t * all.step[c];
      }
      const double inverse_depth = nearness + t * all.depth_step;
      if (inverse_depth > depths[index]) {
        const double depth = 1 / inverse_depth;
        show(index, Eigen::Array3d(sum[0] * depth, sum[1] * depth, sum[2] * depth), inverse_depth);
      }
      if constexpr (kStepping == Stepping::incremental) {
        for (std::size_t c = 0; c < 3; ++c) sum[c] += all.step[c];
      }
    }
  } while (spans.next(span));
}

template <class Show>
void fill(Stepping stepping, const std::array<GouraudVertex, 3>& triangle, const ScanWindow& window,
          const std::vector<double>& depths, const std::vector<Eigen::Array3d>& values, const Show& show) {
  switch (stepping) {
    case Stepping::direct:
      return step<Stepping::direct>(triangle, window, depths, values, show);
    case Stepping::direct_on_multiples:
      return step<Stepping::direct_on_multiples>(triangle, window, depths, values, show);
    case Stepping::incremental:
      return step<Stepping::incremental>(triangle, window, depths, values, show);
  }
}

std::size_t pixels_of(const ScanWindow& window) {
  return static_cast<std::size_t>(window.columns) * static_cast<std::size_t>(window.last_row - window.first_row);
}

}  // namespace

DepthRaster::DepthRaster(int columns, int rows, const Eigen::Array3d& background, Stepping stepping)
    : stepping_(stepping), picture_(columns, rows), inverse_depth_(picture_.pixels.size(), 0.0) {
  for (auto& pixel : picture_.pixels) pixel = background;
}

void DepthRaster::draw(const std::array<GouraudVertex, 3>& triangle) {
  const ScanWindow window{picture_.columns, 0, picture_.rows};
  const auto show = [this](std::size_t index, const Eigen::Array3d& value, double inverse_depth) {
    inverse_depth_[index] = inverse_depth;
    picture_.pixels[index] = value;
  };
  fill(stepping_, triangle, window, inverse_depth_, picture_.pixels, show);
}

void FacetRaster::look(const ScanWindow& window, Stepping stepping) {
  window_ = window;
  stepping_ = stepping;
  inverse_depth_.assign(pixels_of(window), 0.0);
  weights_.resize(pixels_of(window));
  facet_.assign(pixels_of(window), kNoFacet);
}

void FacetRaster::draw(const std::array<GouraudVertex, 3>& triangle, std::uint32_t facet) {
  const auto show = [&](std::size_t index, const Eigen::Array3d& value, double inverse_depth) {
    inverse_depth_[index] = inverse_depth;
    weights_[index] = value;
    facet_[index] = facet;
  };
  fill(stepping_, triangle, window_, inverse_depth_, weights_, show);
}

void FacetRaster::collect(const std::array<GouraudVertex, 3>& triangle, std::uint32_t facet,
                          std::vector<Fragment>& fragments) const {
  const auto show = [&](std::size_t index, const Eigen::Array3d& value, double inverse_depth) {
    fragments.push_back({index, inverse_depth, facet, value});
  };
  fill(stepping_, triangle, window_, inverse_depth_, weights_, show);
}

void sort_back_to_front(std::vector<Fragment>& fragments) {
  std::sort(fragments.begin(), fragments.end(), [](const Fragment& a, const Fragment& b) {
    if (a.place != b.place) return a.place < b.place;
    return a.inverse_depth != b.inverse_depth ? a.inverse_depth < b.inverse_depth : a.facet < b.facet;
  });
}

}  // namespace etendue
