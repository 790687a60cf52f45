// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/iteration.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "etendue/radiosity/shooting.hpp"

namespace etendue::detail {

Course::Course(const RadiosityEquation& equation, const RadiosityGoal& goal, const RadiosityJudge& judge,
               Eigen::Index passes)
    : equation_(equation), goal_(goal), judge_(judge) {
  report_.passes = passes;
}

Eigen::MatrixXd Course::times(const Eigen::MatrixXd& x) {
  ++report_.passes;
  return equation_.factors->times(x);
}

double Course::wanted(const Eigen::MatrixXd& radiosity, Eigen::Index c) const {
  return goal_.tolerance * radiosity.col(c).cwiseAbs().maxCoeff();
}

bool Course::may_go_on() const {
  if (!goal_.may_go_on) return true;
  constexpr Eigen::Index kThousand = 1000;
  double way = 0;
  if (excess_ > 1 && first_excess_ > excess_) way = 1 - std::log(excess_) / std::log(first_excess_);
  return goal_.may_go_on(static_cast<Eigen::Index>(way * static_cast<double>(kThousand)), kThousand);
}

Course::Standing Course::judged(const Eigen::MatrixXd& radiosity) {
  ++report_.passes;
  report_.radiosity = radiosity;
  judgement_ = judge_.judge(radiosity);
  Standing standing;
  excess_ = 0;
  for (Eigen::Index c = 0; c < radiosity.cols(); ++c) {
    const double asked = wanted(radiosity, c);
    if (judgement_.bound(c) <= asked) continue;
    standing.reached = false;
    excess_ = std::max(excess_, judgement_.bound(c) / std::max(asked, 2 * judgement_.rounding(c)));
    // Without any residual the bound would be as large as `rounding`; no step can take it much below.
    standing.exhausted =
        standing.exhausted && judgement_.rounding(c) > asked && judgement_.bound(c) <= 2 * judgement_.rounding(c);
  }
  if (first_excess_ == 0) first_excess_ = excess_;
  if (best_.size() == 0 || excess_ < best_excess_) {
    best_ = radiosity;
    best_excess_ = excess_;
  }
  return standing;
}

void Course::judge_final(const Eigen::MatrixXd& radiosity) {
  report_.status = judged(radiosity).reached ? RadiosityStatus::reached : RadiosityStatus::rounding;
}

bool Course::ends_with(const Eigen::MatrixXd& radiosity) {
  const Standing standing = judged(radiosity);
  if (standing.reached || standing.exhausted) {
    report_.status = standing.reached ? RadiosityStatus::reached : RadiosityStatus::rounding;
    return true;
  }
  const bool stopped = !may_go_on();
  report_.status = stopped ? RadiosityStatus::stopped : RadiosityStatus::limit;
  return stopped || steps_left() <= 0;
}

void Course::stalled() {
  if (best_excess_ < excess_) judged(best_);
  report_.status = RadiosityStatus::stalled;
}

Eigen::VectorXd units(const Eigen::MatrixXd& values) {
  Eigen::VectorXd unit(values.cols());
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    double largest = 0;
    for (Eigen::Index i = 0; i < values.rows(); ++i) largest = std::max(largest, std::abs(values(i, c)));
    unit(c) = largest > 0 && std::isfinite(largest) ? std::ldexp(1.0, std::ilogb(largest)) : 1;
  }
  return unit;
}

RadiosityReport Course::report() && {
  report_.incident = std::move(judgement_.incident);
  report_.residual = std::move(judgement_.residual);
  report_.bound = std::move(judgement_.bound);
  report_.backward_error = std::move(judgement_.backward_error);
  return std::move(report_);
}

void jacobi(Course& course) {
  const RadiosityEquation& equation = course.equation();
  Eigen::MatrixXd radiosity = equation.emission;
  while (!course.ends_with(radiosity)) {
    radiosity = equation.emission + equation.reflectance.cwiseProduct(course.judgement().incident);
    course.count();
  }
}

namespace {

/// One sweep: each row with what is known by then. How far each channel moved at most.
Eigen::VectorXd sweep(const RadiosityEquation& equation, Eigen::MatrixXd& radiosity) {
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(radiosity.cols());
  for (Eigen::Index i = 0; i < radiosity.rows(); ++i) {
    const Eigen::MatrixXd incident = equation.factors->rows_times(radiosity, i, 1);
    for (Eigen::Index c = 0; c < radiosity.cols(); ++c) {
      const double next = equation.emission(i, c) + equation.reflectance(i, c) * incident(0, c);
      moved(c) = std::max(moved(c), std::abs(next - radiosity(i, c)));
      radiosity(i, c) = next;
    }
  }
  return moved;
}

}  // namespace

void gauss_seidel(Course& course) {
  const RadiosityEquation& equation = course.equation();
  Eigen::MatrixXd radiosity = equation.emission;
  // After a sweep |r_i| ≤ ρ_i Σ_j F_ij · moved = (1 − d_i) · moved, so that bound ≤ moved · max_i (1 − d_i)/d_i.
  Eigen::VectorXd share = Eigen::VectorXd::Zero(radiosity.cols());
  for (Eigen::Index c = 0; c < radiosity.cols(); ++c) {
    for (Eigen::Index i = 0; i < radiosity.rows(); ++i) {
      share(c) = std::max(share(c), (1 - course.margin(i, c)) / course.margin(i, c));
    }
  }
  bool ended = course.ends_with(radiosity);
  Eigen::VectorXd last = Eigen::VectorXd::Constant(radiosity.cols(), -1);
  while (!ended) {
    const Eigen::VectorXd moved = sweep(equation, radiosity);
    course.count();
    course.count_sweep();
    bool near = true;
    for (Eigen::Index c = 0; c < radiosity.cols(); ++c) {
      // A sweep that moves as far as the last one moves by rounding only.
      near = near && (moved(c) * share(c) <= course.wanted(radiosity, c) || moved(c) == 0 ||
                      (last(c) >= 0 && moved(c) >= last(c)));
    }
    last = moved;
    if (near || course.steps_left() <= 0 || !course.may_go_on()) ended = course.ends_with(radiosity);
  }
}

void southwell(Course& course) {
  const RadiosityEquation& equation = course.equation();
  const Eigen::Index n = equation.emission.rows();
  const Eigen::VectorXd areas = equation.areas.size() > 0 ? equation.areas : Eigen::VectorXd::Ones(n);
  ShootingState state = before_shooting(equation.emission);
  while (!course.ends_with(state.radiosity)) {
    // What was judged is the sum of what was shot and of what was not; its residual is what is unshot once all has been.
    state = {course.radiosity() + course.judgement().residuals, course.judgement().residuals};
    for (Eigen::Index shot = 0; shot < n; ++shot) {
      const Eigen::Index j = brightest_unshot(state, areas);
      state = shoot_along(std::move(state), j, equation.factors->column(j), equation.reflectance);
    }
    course.count();
  }
}

}  // namespace etendue::detail
