// SPDX-License-Identifier: Apache-2.0
#include "etendue/refinement/patch_factors.hpp"

#include <algorithm>
#include <atomic>
#include <utility>

namespace etendue {

namespace {

class Hemicubes : public PatchFactors {
 public:
  Hemicubes(const PatchModel& model, const HemicubeSettings& settings)
      : model_(model),
        settings_(settings),
        elements_(model.elements),
        patches_(model.patches),
        projection_(settings.body, settings.resolution) {}

  std::vector<SeenShare> from_patch(std::size_t patch, const Execution& execution) override {
    return mean_seen(elements_, model_.patches.elements[patch], patch, settings_, projection_, desk_,
                     execution.threads);
  }

  std::vector<SeenShare> from_element(std::size_t element) const override {
    LookingDesk desk;
    return mean_seen(patches_, model_.elements.elements[element], element, settings_, projection_, desk, 1);
  }

  bool reciprocal() const override { return false; }

 private:
  const PatchModel& model_;
  HemicubeSettings settings_;
  ItemScene elements_, patches_;
  PixelProjection projection_;
  LookingDesk desk_;
};

/// Patches, then elements, over the same faces: pairs of both are pairs of one mesh.
ElementMesh joined(const PatchModel& model) {
  ElementMesh mesh{model.elements.faces, model.patches.elements, model.elements.patches};
  mesh.elements.insert(mesh.elements.end(), model.elements.elements.begin(), model.elements.elements.end());
  return mesh;
}

/// Elements that one thread takes at a time: enough for the rules that work on rows, few enough to share.
constexpr std::size_t kChunk = 64;

class ExactFactors : public PatchFactors {
 public:
  ExactFactors(const PatchModel& model, const AssemblyTolerance& tolerance)
      : model_(model), mesh_(joined(model)), exchange_(mesh_, tolerance), tolerance_(tolerance) {}

  std::vector<SeenShare> from_patch(std::size_t patch, const Execution& execution) override {
    const std::size_t n = model_.elements.elements.size();
    std::vector<double> factors(n, 0.0);
    const double area = mesh_.elements[patch].polygon.area();
    const std::size_t chunks = (n + kChunk - 1) / kChunk;
    Execution how = execution;
    how.progress = {};
    const bool complete = parallel_for(chunks, how, [&](std::size_t chunk) {
      std::vector<SurfacePair> pairs;
      for (std::size_t q = chunk * kChunk; q < std::min(n, (chunk + 1) * kChunk); ++q) {
        pairs.push_back({patch, model_.patches.elements.size() + q});
      }
      const std::vector<Bounded> found = exchanges(pairs);
      for (std::size_t k = 0; k < pairs.size(); ++k) factors[chunk * kChunk + k] = found[k].value / area;
    });
    std::vector<SeenShare> shares;
    if (!complete) return shares;
    for (std::size_t q = 0; q < n; ++q) {
      if (factors[q] > 0) shares.push_back({q, factors[q]});
    }
    return shares;
  }

  std::vector<SeenShare> from_element(std::size_t element) const override {
    std::vector<SurfacePair> pairs;
    for (std::size_t j = 0; j < model_.patches.elements.size(); ++j) {
      pairs.push_back({j, model_.patches.elements.size() + element});
    }
    const std::vector<Bounded> found = exchanges(pairs);
    const double area = model_.elements.elements[element].polygon.area();
    std::vector<SeenShare> shares;
    for (std::size_t j = 0; j < found.size(); ++j) {
      if (found[j].value > 0) shares.push_back({j, found[j].value / area});
    }
    return shares;
  }

  bool reciprocal() const override { return true; }
  std::size_t missed() const override { return missed_; }

 private:
  std::vector<Bounded> exchanges(const std::vector<SurfacePair>& pairs) const {
    std::vector<Bounded> found(pairs.size());
    TileReport report;
    exchange_.find(pairs, found, report);
    std::size_t beyond = 0;
    const Tolerance asked{std::max(tolerance_.free.relative, tolerance_.obstructed.relative),
                          std::max(tolerance_.free.absolute, tolerance_.obstructed.absolute)};
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const double first = mesh_.elements[pairs[k].i].polygon.area(),
                   second = mesh_.elements[pairs[k].j].polygon.area();
      beyond += !reached(found[k], first, second, asked);
    }
    missed_ += beyond;
    return found;
  }

  const PatchModel& model_;
  ElementMesh mesh_;
  ExactExchange exchange_;
  AssemblyTolerance tolerance_;
  mutable std::atomic<std::size_t> missed_{0};
};

class Remembered : public PatchFactors {
 public:
  Remembered(std::unique_ptr<PatchFactors> source, std::size_t patches, std::size_t bytes)
      : source_(std::move(source)), columns_(patches), left_(bytes) {}

  std::vector<SeenShare> from_patch(std::size_t patch, const Execution& execution) override {
    if (!columns_[patch].empty()) return columns_[patch];
    std::vector<SeenShare> column = source_->from_patch(patch, execution);
    const std::size_t bytes = column.size() * sizeof(SeenShare);
    if (!column.empty() && bytes <= left_) {
      left_ -= bytes;
      columns_[patch] = column;
      columns_[patch].shrink_to_fit();
    }
    return column;
  }
  std::vector<SeenShare> from_element(std::size_t element) const override { return source_->from_element(element); }
  bool reciprocal() const override { return source_->reciprocal(); }
  std::size_t missed() const override { return source_->missed(); }

 private:
  std::unique_ptr<PatchFactors> source_;
  std::vector<std::vector<SeenShare>> columns_;
  std::size_t left_;
};

}  // namespace

std::unique_ptr<PatchFactors> hemicube_factors(const PatchModel& model, const HemicubeSettings& settings) {
  return std::make_unique<Hemicubes>(model, settings);
}

std::unique_ptr<PatchFactors> exact_factors(const PatchModel& model, const AssemblyTolerance& tolerance) {
  return std::make_unique<ExactFactors>(model, tolerance);
}

std::vector<std::size_t> without_view(const PatchModel& model, const std::vector<Rgb>& irradiance,
                                      const Execution& execution) {
  std::vector<std::size_t> dark;
  for (std::size_t q = 0; q < irradiance.size(); ++q) {
    if ((irradiance[q] == 0).all()) dark.push_back(q);
  }
  const Hemicubes coarse(model, {PixelBody::hemicube, kLeastResolution, 1, false, 1});
  std::vector<char> sees(dark.size(), 1);
  parallel_for(dark.size(), {execution.threads, {}, execution.stop},
               [&](std::size_t k) { sees[k] = !coarse.from_element(dark[k]).empty(); });
  std::vector<std::size_t> blind;
  for (std::size_t k = 0; k < dark.size(); ++k) {
    if (!sees[k]) blind.push_back(dark[k]);
  }
  return blind;
}

std::size_t column_budget(const PatchModel& model) {
  constexpr std::size_t kBytesAnElement = 256, kLeast = std::size_t{8} << 20;
  return std::max(kLeast, kBytesAnElement * model.elements.elements.size());
}

std::unique_ptr<PatchFactors> remembered(std::unique_ptr<PatchFactors> source, std::size_t patches, std::size_t bytes) {
  return std::make_unique<Remembered>(std::move(source), patches, bytes);
}

}  // namespace etendue
