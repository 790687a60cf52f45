// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/shooting.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

/// Areas divide, and weigh the powers: one that is zero, negative or not a number would spoil both.
bool all_positive(const Eigen::VectorXd& areas) {
  for (Eigen::Index i = 0; i < areas.size(); ++i) {
    if (!(areas(i) > 0) || !std::isfinite(areas(i))) return false;
  }
  return true;
}

/// In the order of the indices, so that the bits do not depend on how Eigen was vectorised.
double power(const Eigen::MatrixXd& radiosity, const Eigen::VectorXd& areas) {
  double sum = 0;
  for (Eigen::Index c = 0; c < radiosity.cols(); ++c) {
    for (Eigen::Index i = 0; i < radiosity.rows(); ++i) sum += radiosity(i, c) * areas(i);
  }
  return sum;
}

bool fit(const ShootingState& state, const Eigen::MatrixXd& other) {
  return state.unshot.rows() == other.rows() && state.unshot.cols() == other.cols() &&
         state.radiosity.rows() == other.rows() && state.radiosity.cols() == other.cols();
}

}  // namespace

ShootingState before_shooting(const Eigen::MatrixXd& emission) {
  return {emission, emission};
}

Eigen::Index brightest_unshot(const ShootingState& state, const Eigen::VectorXd& areas) {
  require(areas.size() == state.unshot.rows() && areas.size() > 0, "brightest_unshot: one area a patch");
  require(all_positive(areas), "brightest_unshot: areas are positive");
  const auto unshot = [&](Eigen::Index j) {
    double sum = 0;
    for (Eigen::Index c = 0; c < state.unshot.cols(); ++c) sum += std::abs(state.unshot(j, c));
    return sum * areas(j);
  };
  Eigen::Index best = 0;
  double most = unshot(0);
  for (Eigen::Index j = 1; j < areas.size(); ++j) {
    const double power = unshot(j);
    if (power > most) {
      best = j;
      most = power;
    }
  }
  return best;
}

ShootingState shoot_along(ShootingState state, Eigen::Index j, const Eigen::VectorXd& factors_to_j,
                          const Eigen::MatrixXd& reflectance) {
  const Eigen::Index n = state.radiosity.rows();
  require(j >= 0 && j < n, "shoot: the patch exists");
  require(factors_to_j.size() == n && fit(state, reflectance), "shoot: one form factor and reflectance a patch");
  for (Eigen::Index c = 0; c < reflectance.cols(); ++c) {
    const double shot = state.unshot(j, c);
    state.unshot(j, c) = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double received = reflectance(i, c) * (shot * factors_to_j(i));
      state.radiosity(i, c) += received;
      state.unshot(i, c) += received;
    }
  }
  return state;
}

ShootingState shoot(ShootingState state, Eigen::Index j, const Eigen::VectorXd& factors_from_j,
                    const Eigen::MatrixXd& reflectance, const Eigen::VectorXd& areas) {
  const Eigen::Index n = state.radiosity.rows();
  require(j >= 0 && j < n, "shoot: the patch exists");
  require(factors_from_j.size() == n && areas.size() == n, "shoot: one form factor, reflectance and area a patch");
  require(all_positive(areas), "shoot: areas are positive");
  Eigen::VectorXd factors_to_j(n);
  for (Eigen::Index i = 0; i < n; ++i) factors_to_j(i) = factors_from_j(i) * (areas(j) / areas(i));
  return shoot_along(std::move(state), j, factors_to_j, reflectance);
}

double unshot_share(const ShootingState& state, const Eigen::MatrixXd& emission, const Eigen::VectorXd& areas) {
  require(fit(state, emission) && areas.size() == state.unshot.rows(), "unshot_share: one emission and area a patch");
  require(all_positive(areas), "unshot_share: areas are positive");
  const double emitted = power(emission, areas);
  require(emitted > 0, "unshot_share: something is emitted");
  return power(state.unshot, areas) / emitted;
}

double shooting_gap(const ShootingState& state, const Eigen::MatrixXd& reflectance) {
  require(fit(state, reflectance), "shooting_gap: one reflectance a patch");
  double gap = 0;
  for (Eigen::Index c = 0; c < reflectance.cols(); ++c) {
    const double most = reflectance.col(c).maxCoeff();
    require(most < 1, "shooting_gap: reflectances are below one");
    gap = std::max(gap, most / (1 - most) * state.unshot.col(c).maxCoeff());
  }
  return gap;
}

ShootingReport shoot_until(const RadiositySystem& system, const Eigen::VectorXd& areas, const ShootingGoal& goal) {
  ShootingReport report;
  report.state = before_shooting(system.emission);
  report.unshot_share = unshot_share(report.state, system.emission, areas);
  while (report.unshot_share > goal.unshot_share && report.steps < goal.most_steps) {
    const Eigen::Index j = brightest_unshot(report.state, areas);
    report.state = shoot(std::move(report.state), j, system.form_factors.row(j).transpose(), system.reflectance, areas);
    report.unshot_share = unshot_share(report.state, system.emission, areas);
    ++report.steps;
  }
  report.gap = shooting_gap(report.state, system.reflectance);
  report.reached = report.unshot_share <= goal.unshot_share;
  return report;
}

}  // namespace etendue
