// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/edge_decay.hpp"

#include <cmath>
#include <numbers>

namespace etendue {

namespace {

/// The bent path leaves room between itself and the branch point of the crossing lines.
constexpr double kBranchClearance = 0.7;
/// Lines at a smaller angle are not bent around: their crossing is too uncertain.
constexpr double kLeastSine = 1e-9;
/// Leading digits and roots err by a few roundings of their own.
constexpr double kOwnRoundings = 1 - 0x1p-48;

double joukowski(double semi_axis) {
  return semi_axis <= 1 ? 1 : semi_axis + std::sqrt((semi_axis - 1) * (semi_axis + 1));
}

/// |x − p| + |x − q| for the two ends p, q of `outer`, x at an end of `inner`.
template <class T>
double focal_sum(const Edge<T>& outer, const Triple<T>& x) {
  return leading(norm(x - outer.start)) + leading(norm(x - outer.end));
}

/// Least focal sum over the inner edge: the straight way from p to q when their half-planes around the inner line are
/// unfolded, where it passes the edge; else at the nearer end, as the sum is convex.
template <class T>
double least_focal_sum(const Edge<T>& outer, const Edge<T>& inner, double slack) {
  const Triple<T> p = outer.start - inner.start, q = outer.end - inner.start;
  const double xp = leading(dot(p, inner.direction)), xq = leading(dot(q, inner.direction));
  const double hp = leading(norm(cross(p, inner.direction))), hq = leading(norm(cross(q, inner.direction)));
  const double length = leading(inner.length);
  const double ends = std::min(focal_sum(outer, inner.start), focal_sum(outer, inner.end));
  const double weighted = xp * hq + xq * hp, heights = hp + hq;
  constexpr double kRoom = 0x1p-20;  // of the edge: the foot need not be known better
  const bool certain = heights > slack / kRoom * 4;
  if (certain && (weighted < -kRoom * length * heights || weighted > (1 + kRoom) * length * heights)) return ends;
  return std::min(ends, std::hypot(xp - xq, std::max(0.0, heights - slack)));
}

}  // namespace

template <class T>
Decay plain_decay(const Edge<T>& outer, const Edge<T>& inner) {
  const double slack = slack_of(outer, inner);
  const double sum = kOwnRoundings * least_focal_sum(outer, inner, slack) - slack;
  return {joukowski(sum / leading(outer.length)), leading(inner.length)};
}

template <class T>
Decay bent_decay(const Edge<T>& outer, const Edge<T>& inner) {
  const double slack = slack_of(outer, inner), length = leading(outer.length);
  const double ends = std::min(focal_sum(outer, inner.start), focal_sum(outer, inner.end));
  const auto u = widened(outer.direction), v = widened(inner.direction);
  const Triple<DoubleDouble> normal = cross(u, v), gap = widened(inner.start) - widened(outer.start);
  const double sine = leading(norm(normal));
  if (sine < kLeastSine) return {};
  const double square = leading(dot(normal, normal));
  // The unit directions themselves err by a few kRounding, which the sine divides.
  const double doubt = slack / (sine * sine);
  const double height = std::max(0.0, std::abs(leading(dot(gap, normal))) / square - doubt);
  const double foot = leading(dot(cross(gap, v), normal)) / square - 0.5 * length, half = 0.5 * length;
  const double branch_sum = std::hypot(foot - half, height) + std::hypot(foot + half, height) - 2 * doubt;
  const double branch = joukowski(kOwnRoundings * branch_sum / length);
  const double rho = std::min(joukowski((kOwnRoundings * ends - slack) / length), 1 + kBranchClearance * (branch - 1));
  if (!(rho > 1)) return {};
  const double clearance = 0.5 * half * (branch - rho) * (1 - 1 / (branch * rho));
  const double factor = 1 + sine * std::sqrt(1 + (height + 2 * doubt) / clearance);
  return {rho, leading(inner.length) + 0.25 * std::numbers::pi * length * (rho + 1 / rho) * factor};
}

template Decay plain_decay(const Edge<double>&, const Edge<double>&);
template Decay plain_decay(const Edge<DoubleDouble>&, const Edge<DoubleDouble>&);
template Decay bent_decay(const Edge<double>&, const Edge<double>&);
template Decay bent_decay(const Edge<DoubleDouble>&, const Edge<DoubleDouble>&);

}  // namespace etendue
