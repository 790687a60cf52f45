// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/radiosity/certificate.hpp"
#include "etendue/radiosity/solve.hpp"

// Inside the solvers only: what an iteration asks after each step, and the iterations.
namespace etendue::detail {

/// Judges what an iteration has, counts its passes, and says whether it is to end.
class Course {
 public:
  /// Contract: refusal() has nothing to say of the equation. @param passes those made already
  Course(const RadiosityEquation& equation, const RadiosityGoal& goal, const RadiosityJudge& judge,
         Eigen::Index passes);

  const RadiosityEquation& equation() const { return equation_; }
  const RadiosityGoal& goal() const { return goal_; }
  double margin(Eigen::Index i, Eigen::Index c) const { return judge_.margin(i, c); }

  /// F x, counted.
  Eigen::MatrixXd times(const Eigen::MatrixXd& x);
  /// Remembers B with its judgement as what would be returned; true where the iteration is to end, for whatever reason.
  bool ends_with(const Eigen::MatrixXd& radiosity);
  /// The same of what a direct solver found: there is no next step, so it is reached, or as near as rounding allows.
  void judge_final(const Eigen::MatrixXd& radiosity);
  /// The bound that is asked of a channel whose radiosities are these.
  double wanted(const Eigen::MatrixXd& radiosity, Eigen::Index c) const;

  const RadiosityJudgement& judgement() const { return judgement_; }
  const Eigen::MatrixXd& radiosity() const { return report_.radiosity; }
  /// Bound over what is wanted of it, or over what rounding allows where that is more; the worst channel.
  double excess() const { return excess_; }
  /// One step, or some, were done.
  void count(Eigen::Index steps = 1) { report_.steps += steps; }
  void count_sweep() { ++report_.passes; }
  Eigen::Index steps_left() const { return goal_.most_steps - report_.steps; }
  bool may_go_on() const;
  /// Steps no longer help: the best that was judged is returned.
  void stalled();

  /// What was last judged, or the best where steps ended helping.
  RadiosityReport report() &&;

 private:
  struct Standing {
    bool reached = true, exhausted = true;
  };
  Standing judged(const Eigen::MatrixXd& radiosity);

  const RadiosityEquation& equation_;
  const RadiosityGoal& goal_;
  const RadiosityJudge& judge_;
  RadiosityJudgement judgement_;
  RadiosityReport report_;
  double excess_ = 0;
  double first_excess_ = 0;
  Eigen::MatrixXd best_;
  double best_excess_ = 0;
};

/// Of each channel a power of two near its largest value, or 1: iterations that form squares divide by it, exactly, so
/// that watts and terawatts take the same steps.
Eigen::VectorXd units(const Eigen::MatrixXd& values);

void jacobi(Course& course);
void gauss_seidel(Course& course);
void southwell(Course& course);
void conjugate_gradients(Course& course);
void gmres(Course& course);
void bicgstab(Course& course);

}  // namespace etendue::detail
