// SPDX-License-Identifier: Apache-2.0
#include "support/exhibit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "etendue/core/contract.hpp"

namespace etendue::validation {

namespace {

std::vector<Exhibit>& store() {
  static std::vector<Exhibit> exhibits;
  return exhibits;
}

}  // namespace

ErrorHistogram::ErrorHistogram(std::string title, std::string unit, double width, std::size_t bins)
    : title_(std::move(title)), unit_(std::move(unit)), width_(width), counts_(bins, 0) {
  require(width > 0 && bins > 0, "ErrorHistogram: width and number of bins are positive");
}

ErrorHistogram::ErrorHistogram(std::string title, std::string unit, double width, double worst,
                               std::vector<std::uint64_t> counts)
    : title_(std::move(title)), unit_(std::move(unit)), width_(width), worst_(worst), counts_(std::move(counts)) {
  require(width > 0 && !counts_.empty(), "ErrorHistogram: width and number of bins are positive");
  total_ = std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0});
}

void ErrorHistogram::add(double units) {
  require(units >= 0, "ErrorHistogram::add: not negative, and a number");
  worst_ = std::max(worst_, units);
  ++total_;
  const double bin = std::min(units / width_, static_cast<double>(counts_.size() - 1));
  ++counts_[static_cast<std::size_t>(bin)];
}

void WorstInput::consider(double other_share, const std::string& other_command) {
  if (!command.empty() && !(other_share > share)) return;
  share = other_share;
  command = other_command;
}

void exhibit(Figure figure) {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  require(info != nullptr, "exhibit: within a test");
  store().push_back({std::string(info->test_suite_name()) + "." + info->name(), std::move(figure)});
}

void adopt(Exhibit exhibit) {
  store().push_back(std::move(exhibit));
}

const std::vector<Exhibit>& collected_exhibits() {
  return store();
}

}  // namespace etendue::validation
