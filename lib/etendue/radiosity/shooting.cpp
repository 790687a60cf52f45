// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/shooting.hpp"

#include <cmath>

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
double power(const Eigen::VectorXd& radiosity, const Eigen::VectorXd& areas) {
  double sum = 0;
  for (Eigen::Index i = 0; i < radiosity.size(); ++i) sum += radiosity(i) * areas(i);
  return sum;
}

}  // namespace

ShootingState before_shooting(const Eigen::VectorXd& emission) {
  return {emission, emission};
}

Eigen::Index brightest_unshot(const ShootingState& state, const Eigen::VectorXd& areas) {
  require(areas.size() == state.unshot.size() && areas.size() > 0, "brightest_unshot: one area a patch");
  require(all_positive(areas), "brightest_unshot: areas are positive");
  Eigen::Index best = 0;
  for (Eigen::Index j = 1; j < areas.size(); ++j) {
    if (state.unshot(j) * areas(j) > state.unshot(best) * areas(best)) best = j;
  }
  return best;
}

ShootingState shoot(const ShootingState& state, Eigen::Index j, const Eigen::VectorXd& factors_from_j,
                    const Eigen::VectorXd& reflectance, const Eigen::VectorXd& areas) {
  const Eigen::Index n = state.radiosity.size();
  require(j >= 0 && j < n, "shoot: the patch exists");
  require(factors_from_j.size() == n && reflectance.size() == n && areas.size() == n,
          "shoot: one form factor, reflectance and area a patch");
  require(all_positive(areas), "shoot: areas are positive");
  ShootingState next = state;
  next.unshot(j) = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double received = reflectance(i) * (state.unshot(j) * factors_from_j(i) * (areas(j) / areas(i)));
    next.radiosity(i) += received;
    next.unshot(i) += received;
  }
  return next;
}

double unshot_share(const ShootingState& state, const Eigen::VectorXd& emission, const Eigen::VectorXd& areas) {
  require(emission.size() == areas.size() && areas.size() == state.unshot.size(),
          "unshot_share: one emission and area a patch");
  require(all_positive(areas), "unshot_share: areas are positive");
  const double emitted = power(emission, areas);
  require(emitted > 0, "unshot_share: something is emitted");
  return power(state.unshot, areas) / emitted;
}

double shooting_gap(const ShootingState& state, const Eigen::VectorXd& reflectance) {
  const double most = reflectance.maxCoeff();
  require(most < 1, "shooting_gap: reflectances are below one");
  return most / (1 - most) * state.unshot.maxCoeff();
}

ShootingReport shoot_until(const RadiositySystem& system, const Eigen::VectorXd& areas, const ShootingGoal& goal) {
  ShootingReport report;
  report.state = before_shooting(system.emission);
  report.unshot_share = unshot_share(report.state, system.emission, areas);
  while (report.unshot_share > goal.unshot_share && report.steps < goal.most_steps) {
    const Eigen::Index j = brightest_unshot(report.state, areas);
    report.state = shoot(report.state, j, system.form_factors.row(j).transpose(), system.reflectance, areas);
    report.unshot_share = unshot_share(report.state, system.emission, areas);
    ++report.steps;
  }
  report.gap = shooting_gap(report.state, system.reflectance);
  report.reached = report.unshot_share <= goal.unshot_share;
  return report;
}

}  // namespace etendue
