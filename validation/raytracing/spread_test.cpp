// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "etendue/raytracing/camera_rays.hpp"
#include "etendue/raytracing/sampling.hpp"
#include "support/evidence.hpp"
#include "support/scene_builder.hpp"

// How the samples of a pixel share out lens and time.
namespace etendue::validation {
namespace {

constexpr double kPi = std::numbers::pi;

// CLAIM      IU.5.8.1: shuffling is a permutation: n things get n places; and each place is as likely as the others for each thing.
// ORACLE     identity: counted; statistics for the likelihood.
// TOLERANCE  none for the permutations. χ² with n² − n degrees of freedom (rows of a table of n²) over 20,000 shuffles: 6 σ.
TEST(SpreadNumbers, AreShuffledEachToAPlaceOfItsOwn) {
  proves({"IU.5.8.1"}, Oracle::identity, "places counted");
  std::uint64_t wrong = 0, shuffles = 0;
  for (std::uint64_t n = 1; n <= 260; ++n, ++shuffles) {
    std::vector<char> taken(n);
    for (std::uint64_t i = 0; i < n; ++i) {
      const std::uint64_t place = shuffled(i, n, 77 * n);
      ASSERT_LT(place, n);
      taken[place] = 1;
    }
    wrong += std::count(taken.begin(), taken.end(), char{0}) > 0 ? 1u : 0u;
  }
  EXPECT_TRUE(all_agree(wrong, shuffles));
  constexpr int kShuffles = 20'000;
  for (const std::uint64_t n : {4u, 9u, 16u, 25u}) {
    std::vector<int> count(n * n);
    for (std::uint64_t shuffle = 0; shuffle < kShuffles; ++shuffle) {
      for (std::uint64_t i = 0; i < n; ++i) ++count[i * n + shuffled(i, n, split_mix(shuffle))];
    }
    const double expected = kShuffles / static_cast<double>(n), freedom = static_cast<double>(n * n - n);
    double chi = 0;
    for (const int found : count) chi += (found - expected) * (found - expected) / expected;
    EXPECT_TRUE(near(chi, freedom, 6 * std::sqrt(2 * freedom))) << n;
  }
}

// CLAIM      IU.5.8.1: the lens and the time are sampled as the pixel is: of N × N samples each has another one of N × N equal parts of the lens
//            (rings of equal area by angles), and another one of N² equal parts of the time; so have those of adaptive sampling in a pixel
//            that is fully quartered. Which goes with which place in the pixel differs from pixel to pixel.
// ORACLE     identity: parts counted from the rays.
// TOLERANCE  none: a sample within 1e-9 of a part's edge would count wrongly; the seed is fixed.
TEST(SpreadNumbers, HaveOneSampleInEachPartOfLensAndTime) {
  proves({"IU.5.8.1"}, Oracle::identity, "parts of lens and time counted");
  Camera camera = straight(8, 8);
  camera.lens_radius = 0.5;
  camera.focal_distance = 3;
  camera.shutter = 4;
  const CameraFrame frame = camera_frame(camera).value();
  constexpr int kPlaces = 8;
  for (const SamplingScheme scheme : {SamplingScheme::uniform, SamplingScheme::jittered,
                                      SamplingScheme::adaptive_jittered, SamplingScheme::adaptive}) {
    for (const int n : {1, 2, 3, 4, 8}) {
      if (scheme == SamplingScheme::adaptive && n == 3) continue;
      Sampling sampling;
      sampling.scheme = scheme;
      sampling.samples_per_side = n;
      sampling.threshold = Eigen::Array3d::Zero();
      const RowSampler sampler(sampling, usual_filter(FilterKind::box), {0, kPlaces}, kPlaces);
      const auto count = static_cast<std::size_t>(n * n);
      std::vector<std::vector<int>> lens(kPlaces, std::vector<int>(count)), time = lens;
      double brighter = 0;  // every sample differs from all others, so that each is taken
      const Look look = [&](double x, double y, const SampleKey& key) {
        const auto column = static_cast<std::size_t>(x);
        if (x >= kPlaces || y >= 1) return Glimpse{Eigen::Array3d::Constant(brighter += 1), 0};  // corners of others
        const Ray ray = sample_ray(camera, frame, {0.5, 0.5}, key);
        const Vec3 q = (ray.origin - frame.eye) / camera.lens_radius;
        const double turn = std::atan2(frame.up.dot(q), frame.right.dot(q)) / (2 * kPi);
        const auto part =
            static_cast<int>(q.squaredNorm() * n) + n * static_cast<int>((turn < 0 ? turn + 1 : turn) * n);
        ++lens[column].at(static_cast<std::size_t>(part));
        ++time[column].at(static_cast<std::size_t>(ray.time / camera.shutter * static_cast<double>(count)));
        return Glimpse{Eigen::Array3d::Constant(brighter += 1), 0};
      };
      SampledRow row = sampler.begin(0, look);
      if (!(scheme == SamplingScheme::adaptive)) sampler.complete(row, nullptr, nullptr, look);
      std::uint64_t wrong = 0;
      for (std::size_t column = 0; column < kPlaces; ++column) {
        for (std::size_t part = 0; part < count; ++part)
          wrong += (lens[column][part] == 1 ? 0u : 1u) + (time[column][part] == 1 ? 0u : 1u);
      }
      EXPECT_TRUE(all_agree(wrong, 2 * kPlaces * count)) << n << " " << static_cast<int>(scheme);
    }
  }
}

// CLAIM      IU.5.8.1 for the lens: N × N samples of an edge across it have the variance of jittered ones, of the order N^-3, not that of
//            random ones, N^-2.
// ORACLE     closed form: only the parts that the edge cuts can stray, each by a variance of at most ¼. A chord meets N − 1 circles at most twice,
//            and N rays at most half as often and once more: 5N/2 parts, hence at most 5/8 N^-3. Random samples: p(1 − p) N^-2.
// TOLERANCE  that bound; 4,000 pixels find a variance to 5 √(2/4000), 12 %.
TEST(SpreadNumbers, ConvergeAsJitteredSamplesDo) {
  proves({"IU.5.8.1"}, Oracle::closed_form, "parts of a disc that a chord cuts");
  Camera camera = straight(8, 8);
  camera.lens_radius = 1;
  const CameraFrame frame = camera_frame(camera).value();
  constexpr double kEdge = 0.3, kStatistics = 1.12;
  constexpr int kPixels = 4'000;
  const double share = (std::acos(kEdge) - kEdge * std::sqrt(1 - kEdge * kEdge)) / kPi;
  for (const int n : {4, 8, 16}) {
    double sum = 0;
    for (int pixel = 0; pixel < kPixels; ++pixel) {
      int beyond = 0;
      for (int index = 0; index < n * n; ++index) {
        const Ray ray = sample_ray(camera, frame, {0.5, 0.5}, sample_key(3, pixel, 5, index, n));
        beyond += frame.right.dot(ray.origin - frame.eye) > kEdge ? 1 : 0;
      }
      const double off = static_cast<double>(beyond) / (n * n) - share;
      sum += off * off;
    }
    const double found = sum / kPixels, of_random = share * (1 - share) / (n * n);
    RecordProperty("of_random_" + std::to_string(n), std::to_string(found / of_random));
    EXPECT_TRUE(within(found, kStatistics * 0.625 / (n * n * n))) << n;
    EXPECT_TRUE(holds(kStatistics * 0.625 / (n * n * n) < of_random)) << n;  // so that random ones would fail
  }
}

}  // namespace
}  // namespace etendue::validation
