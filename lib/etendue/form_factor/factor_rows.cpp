// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/factor_rows.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <tuple>
#include <utility>

#include "etendue/core/contract.hpp"
#include "etendue/core/rounding.hpp"
#include "etendue/form_factor/aligned_pairs.hpp"
#include "etendue/form_factor/polygon_polygon.hpp"
#include "etendue/form_factor/product_plan.hpp"
#include "etendue/form_factor/product_rule.hpp"

namespace etendue {

namespace {

constexpr double kPi = std::numbers::pi;

void set_lane(ProductRule& rule, std::size_t lane, const Parallelogram& from, const Parallelogram& to) {
  rule.set_lane(lane, from.normal, (to.corner - from.corner) + (to.centre - from.centre), to.half[0], to.half[1],
                to.normal);
}

}  // namespace

FactorRows::FactorRows(std::vector<Polygon> polygons, Instructions instructions)
    : polygons_(std::move(polygons)), wide_(instructions == Instructions::widest && has_wide_vectors()) {
  const std::vector<std::uint32_t> planes = planes_of(polygons_);
  patches_.reserve(polygons_.size());
  for (std::size_t i = 0; i < polygons_.size(); ++i) patches_.push_back(parallelogram(polygons_[i], planes[i]));
}

namespace {

bool reaches(const Bounded& factor, const Tolerance& tolerance) {
  return factor.bound <= std::max(tolerance.absolute, tolerance.relative * factor.value);
}

/// Waits until eight pairs of one key are together.
struct Bucket {
  AlignedLanes lanes;
  std::array<std::size_t, kLanes> pair{};
  std::array<double, kLanes> bound{};
  std::size_t filled = 0;

  void take(const AlignedPlan& plan, std::size_t lane, std::size_t k) {
    const auto copy = [&](Lanes& to, const Lanes& from) { to[filled] = from[lane]; };
    copy(lanes.u, plan.lanes.u);
    copy(lanes.v, plan.lanes.v);
    copy(lanes.first, plan.lanes.first);
    copy(lanes.second, plan.lanes.second);
    copy(lanes.product, plan.lanes.product);
    copy(lanes.factor, plan.lanes.factor);
    for (std::size_t c = 0; c < 4; ++c) copy(lanes.squares[c], plan.lanes.squares[c]);
    copy(bound, plan.bound);
    pair[filled++] = k;
  }
};

}  // namespace

/// One call of pairs(): aligned pairs are summed as they come, the rest waits for the product rule.
class FactorRows::Call {
 public:
  Call(const FactorRows& rows, std::span<const IndexPair> pairs, const Tolerance& tolerance, AbsoluteError side,
       std::span<Bounded> factors)
      : rows_(rows), pairs_(pairs), tolerance_(tolerance), side_(side), factors_(factors) {
    plan_.relative = tolerance.relative;
    bucket_of_.fill(kNone);
    from_set_.fill(kNone);
    to_set_.fill(kNone);
  }

  void run() {
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const auto [from, to] = pairs_[k];
      require(from < rows_.size() && to < rows_.size(), "FactorRows: indices are within the set");
      factors_[k] = {0, 0};
      if (rows_.patches_[from].plane == rows_.patches_[to].plane) continue;
      if (from_set_[planned_] != from) plan_.from.set(planned_, rows_.patches_[from]);
      if (to_set_[planned_] != to) plan_.to.set(planned_, rows_.patches_[to]);
      from_set_[planned_] = from;
      to_set_[planned_] = to;
      plan_.absolute[planned_] = asked(k).absolute;
      pair_[planned_++] = k;
      if (planned_ == kLanes) plan();
    }
    plan();
    for (Bucket& bucket : buckets_) sum(bucket, keys_[static_cast<std::size_t>(&bucket - buckets_.data())]);
    product_rules();
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  Tolerance asked(std::size_t k) const {
    if (side_ == AbsoluteError::of_this) return tolerance_;
    const double ratio = rows_.patches_[pairs_[k].to].area / rows_.patches_[pairs_[k].from].area;
    return {tolerance_.relative, tolerance_.absolute * std::min(1.0, ratio)};
  }

  void plan() {
    if (planned_ == 0) return;
    plan_.make(rows_.wide_);
    for (std::size_t lane = 0; lane < planned_; ++lane) {
      const std::uint32_t key = plan_.key[lane];
      if (key == AlignedPlan::kNone) {
        others_.push_back(pair_[lane]);
        continue;
      }
      if (bucket_of_[key] == kNone) {
        bucket_of_[key] = static_cast<std::uint32_t>(buckets_.size());
        buckets_.emplace_back();
        keys_.push_back(key);
      }
      Bucket& bucket = buckets_[bucket_of_[key]];
      bucket.take(plan_, lane, pair_[lane]);
      if (bucket.filled == kLanes) sum(bucket, key);
    }
    planned_ = 0;
  }

  void sum(Bucket& bucket, std::uint32_t key) {
    if (bucket.filled == 0) return;
    sum_aligned(bucket.lanes, key, rows_.wide_);
    for (std::size_t lane = 0; lane < bucket.filled; ++lane) {
      const std::size_t k = bucket.pair[lane];
      const Bounded found{bucket.lanes.total[lane], bucket.bound[lane]};
      keep(k, found);
      if (!reaches(found, asked(k))) others_.push_back(k);  // guessed too large
    }
    bucket.filled = 0;
  }

  void keep(std::size_t k, const Bounded& found) { factors_[k] = {std::clamp(found.value, 0.0, 1.0), found.bound}; }

  void boundary_integral(std::size_t k) {
    const auto [from, to] = pairs_[k];
    factors_[k] =
        form_factor(Boundary{rows_.polygons_[from].vertices()}, Boundary{rows_.polygons_[to].vertices()}, asked(k));
  }

  struct Job {
    std::uint32_t from, key;
    std::size_t pair;
    double bound;
  };

  void product_rules() {
    std::vector<Job> jobs;
    for (const std::size_t k : others_) {
      const auto [from, to] = pairs_[k];
      const ProductPlan chosen = product_plan(rows_.patches_[from], rows_.patches_[to], asked(k));
      factors_[k] = {0, 0};
      if (chosen.kind == ProductPlan::Kind::other) boundary_integral(k);
      if (chosen.kind == ProductPlan::Kind::rule) jobs.push_back({from, chosen.key, k, chosen.bound});
    }
    std::sort(jobs.begin(), jobs.end(), [](const Job& a, const Job& b) {
      return std::tie(a.from, a.key, a.pair) < std::tie(b.from, b.key, b.pair);
    });
    ProductRule rule;
    for (std::size_t start = 0, end = 0; start < jobs.size(); start = end) {
      while (end < jobs.size() && jobs[end].from == jobs[start].from && jobs[end].key == jobs[start].key) ++end;
      const Parallelogram& source = rows_.patches_[jobs[start].from];
      rule.set_source(source.half[0], source.half[1], ProductPlan::nodes(jobs[start].key, 0),
                      ProductPlan::nodes(jobs[start].key, 1));
      for (std::size_t block = start; block < end; block += kLanes) product_block(rule, {&jobs[block], end - block});
    }
  }

  void product_block(ProductRule& rule, std::span<const Job> jobs) {
    const Parallelogram& source = rows_.patches_[jobs[0].from];
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      set_lane(rule, lane, source, rows_.patches_[pairs_[jobs[std::min(lane, jobs.size() - 1)].pair].to]);
    }
    rule.sum(ProductPlan::nodes(jobs[0].key, 2), ProductPlan::nodes(jobs[0].key, 3), rows_.wide_);
    for (std::size_t lane = 0; lane < std::min(kLanes, jobs.size()); ++lane) {
      const std::size_t k = jobs[lane].pair;
      const Bounded found{rule.total[lane] * (rows_.patches_[pairs_[k].to].area / (16 * kPi)), jobs[lane].bound};
      keep(k, found);
      if (!reaches(found, asked(k))) boundary_integral(k);
    }
  }

  const FactorRows& rows_;
  std::span<const IndexPair> pairs_;
  Tolerance tolerance_;
  AbsoluteError side_;
  std::span<Bounded> factors_;

  AlignedPlan plan_;
  std::array<std::uint32_t, kLanes> from_set_, to_set_;
  std::array<std::size_t, kLanes> pair_{};
  std::size_t planned_ = 0;
  std::array<std::uint32_t, aligned::kKeys> bucket_of_;
  std::vector<Bucket> buckets_;
  std::vector<std::uint32_t> keys_;
  std::vector<std::size_t> others_;
};

void FactorRows::pairs(std::span<const IndexPair> pairs, Tolerance tolerance, AbsoluteError side,
                       std::span<Bounded> factors) const {
  require(tolerance.relative >= 0 && tolerance.absolute >= 0, "FactorRows: tolerances are not negative");
  require(factors.size() == pairs.size(), "FactorRows: spans fit");
  Call(*this, pairs, tolerance, side, factors).run();
}

void FactorRows::row(std::size_t from, std::span<const std::uint32_t> columns, Tolerance tolerance,
                     std::span<Bounded> factors) const {
  require(from < size(), "FactorRows: indices are within the set");
  std::vector<IndexPair> named;
  named.reserve(columns.size());
  for (const std::uint32_t to : columns) named.push_back({static_cast<std::uint32_t>(from), to});
  pairs(named, tolerance, AbsoluteError::of_this, factors);
}

std::optional<Bounded> product_factor(const Polygon& from, const Polygon& to, Tolerance tolerance) {
  const Parallelogram source = parallelogram(from, 0), target = parallelogram(to, 1);
  if (!source.valid || !target.valid) return std::nullopt;
  const auto kept = [](const Bounded& found) { return Bounded{std::clamp(found.value, 0.0, 1.0), found.bound}; };
  AlignedPlan plan;
  plan.from.set(0, source);
  plan.to.set(0, target);
  plan.absolute[0] = tolerance.absolute;
  plan.relative = tolerance.relative;
  plan.make(has_wide_vectors());
  if (plan.key[0] != AlignedPlan::kNone) {
    sum_aligned(plan.lanes, plan.key[0], has_wide_vectors());
    const Bounded found{plan.lanes.total[0], plan.bound[0]};
    if (reaches(found, tolerance)) return kept(found);
  }
  const ProductPlan chosen = product_plan(source, target, tolerance);
  if (chosen.kind == ProductPlan::Kind::nothing) return Bounded{0, 0};
  if (chosen.kind == ProductPlan::Kind::other) return std::nullopt;
  ProductRule rule;
  rule.set_source(source.half[0], source.half[1], ProductPlan::nodes(chosen.key, 0), ProductPlan::nodes(chosen.key, 1));
  for (std::size_t lane = 0; lane < kLanes; ++lane) set_lane(rule, lane, source, target);
  rule.sum(ProductPlan::nodes(chosen.key, 2), ProductPlan::nodes(chosen.key, 3), has_wide_vectors());
  const Bounded found{rule.total[0] * (target.area / (16 * kPi)), chosen.bound};
  if (!reaches(found, tolerance)) return std::nullopt;
  return kept(found);
}

}  // namespace etendue
