// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <vector>

#include "etendue/linear/dense_solve.hpp"
#include "etendue/radiosity/iteration.hpp"

namespace etendue::detail {

namespace {

/// In the order of the indices, so that the bits do not depend on how Eigen was vectorised.
double dot(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, Eigen::Index c) {
  double sum = 0;
  for (Eigen::Index i = 0; i < a.rows(); ++i) sum += a(i, c) * b(i, c);
  return sum;
}

/// (I − H) x = b with H = diag(√(ρA)) F diag(√(ρ/A)), symmetric where A_i F_ij is, positive definite (NOTES.md §6);
/// corrections of B are √(ρ/A) x. A patch with ρ = 0 has x = 0: it is E and needs no correction.
class SymmetricSystem {
 public:
  explicit SymmetricSystem(const RadiosityEquation& equation)
      : out_(equation.emission.rows(), equation.emission.cols()), in_(out_.rows(), out_.cols()) {
    const Eigen::VectorXd areas = equation.areas / units(equation.areas)(0);
    for (Eigen::Index c = 0; c < out_.cols(); ++c) {
      for (Eigen::Index i = 0; i < out_.rows(); ++i) {
        in_(i, c) = std::sqrt(equation.reflectance(i, c) * areas(i));
        out_(i, c) = std::sqrt(equation.reflectance(i, c) / areas(i));
      }
    }
  }

  Eigen::MatrixXd right_side(const Eigen::MatrixXd& residuals) const {
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(out_.rows(), out_.cols());
    for (Eigen::Index c = 0; c < b.cols(); ++c) {
      for (Eigen::Index i = 0; i < b.rows(); ++i) {
        if (out_(i, c) > 0) b(i, c) = residuals(i, c) / out_(i, c);
      }
    }
    return b;
  }
  Eigen::MatrixXd times(Course& course, const Eigen::MatrixXd& x) const {
    return x - in_.cwiseProduct(course.times(out_.cwiseProduct(x)));
  }
  Eigen::MatrixXd correction(const Eigen::MatrixXd& x) const { return out_.cwiseProduct(x); }
  double out(Eigen::Index i, Eigen::Index c) const { return out_(i, c); }

 private:
  Eigen::MatrixXd out_, in_;
};

/// What all channels do at once: each is an iteration of its own, but they share the passes over F.
class Search {
 public:
  Search(const SymmetricSystem& system, const Course& course)
      : system_(system),
        unit_(units(course.judgement().residuals)),
        remainder_(system.right_side(course.judgement().residuals * unit_.cwiseInverse().asDiagonal())),
        direction_(remainder_),
        x_(Eigen::MatrixXd::Zero(remainder_.rows(), remainder_.cols())),
        size_(static_cast<std::size_t>(x_.cols())),
        least_(size_.size()),
        since_least_(size_.size(), 0),
        ended_(size_.size(), 0),
        patience_(size_.size()) {
    for (Eigen::Index c = 0; c < x_.cols(); ++c) {
      const auto k = static_cast<std::size_t>(c);
      least_[k] = size_[k] = dot(remainder_, remainder_, c);
      patience_[k] = patience(course, c);
      if (!(size_[k] > 0)) end(c);
    }
  }

  bool ended() const {
    return std::all_of(ended_.begin(), ended_.end(), [](char e) { return e != 0; });
  }

  void step(Course& course) {
    const Eigen::MatrixXd turned = system_.times(course, direction_);
    for (Eigen::Index c = 0; c < x_.cols(); ++c) {
      if (ended_[static_cast<std::size_t>(c)] != 0) continue;
      double& size = size_[static_cast<std::size_t>(c)];
      const double curvature = dot(direction_, turned, c);
      if (!(curvature > 0) || !std::isfinite(curvature)) {  // rounding only, or no reciprocity
        end(c);
        continue;
      }
      const double length = size / curvature;
      for (Eigen::Index i = 0; i < x_.rows(); ++i) {
        x_(i, c) += length * direction_(i, c);
        remainder_(i, c) -= length * turned(i, c);
      }
      const double next = dot(remainder_, remainder_, c);
      for (Eigen::Index i = 0; i < x_.rows(); ++i) direction_(i, c) = remainder_(i, c) + next / size * direction_(i, c);
      size = next;
      if (near(course, c) || !(next > 0) || hopeless(c)) end(c);
    }
  }

  Eigen::MatrixXd correction() const { return system_.correction(x_) * unit_.asDiagonal(); }

 private:
  void end(Eigen::Index c) {
    ended_[static_cast<std::size_t>(c)] = 1;
    direction_.col(c).setZero();
  }

  /// Steps within which the remainder has a new least where the system is symmetric: its eigenvalues lie in [d, 2 − d],
  /// d = min_i (1 − ρ_i Σ_j F_ij), so with κ = (2 − d)/d the remainder after m steps is below
  /// 2 √κ ((√κ − 1)/(√κ + 1))^m of the first, hence below it for m > √κ ln(2 √κ)/2. Twice that, for rounding.
  static double patience(const Course& course, Eigen::Index c) {
    double least = 1;
    for (Eigen::Index i = 0; i < course.radiosity().rows(); ++i) least = std::min(least, course.margin(i, c));
    const double root = std::sqrt((2 - least) / least);
    return 10 + root * std::log(2 * root);
  }

  /// No new least of the remainder for longer than a symmetric system takes: it is not, or rounding is all that is left.
  bool hopeless(Eigen::Index c) {
    const auto k = static_cast<std::size_t>(c);
    if (size_[k] < least_[k]) {
      least_[k] = size_[k];
      since_least_[k] = 0;
    }
    return static_cast<double>(++since_least_[k]) > patience_[k];
  }

  /// Does the remainder, which is the residual but for rounding, promise the bound that is asked?
  bool near(const Course& course, Eigen::Index c) const {
    double bound = 0, largest = 0;
    for (Eigen::Index i = 0; i < x_.rows(); ++i) {
      bound = std::max(bound, unit_(c) * (std::abs(remainder_(i, c)) * system_.out(i, c)) / course.margin(i, c));
      largest = std::max(largest, std::abs(course.radiosity()(i, c) + unit_(c) * (system_.out(i, c) * x_(i, c))));
    }
    const double wanted = course.goal().tolerance * largest, rounding = course.judgement().rounding(c);
    return bound <= (rounding < wanted ? 0.5 * (wanted - rounding) : 0.5 * rounding);
  }

  const SymmetricSystem& system_;
  Eigen::VectorXd unit_;  ///< of the residuals: everything here is in it
  Eigen::MatrixXd remainder_, direction_, x_;
  std::vector<double> size_, least_;  ///< squares of the remainder
  std::vector<Eigen::Index> since_least_;
  std::vector<char> ended_;
  std::vector<double> patience_;
};

}  // namespace

void conjugate_gradients(Course& course) {
  const SymmetricSystem system(course.equation());
  // From B = E: residuals are multiples of ρ, corrections too.
  Eigen::MatrixXd radiosity = course.equation().emission;
  constexpr double kNoProgress = 0.99;  // a search that leaves more than this of the bound helps no more
  for (double last = 0; !course.ends_with(radiosity); last = course.excess()) {
    if (last > 0 && course.excess() > kNoProgress * last) return course.stalled();
    Search search(system, course);
    do {
      search.step(course);
      course.count();
    } while (!search.ended() && course.steps_left() > 0 && course.may_go_on());
    const Eigen::MatrixXd next = radiosity + search.correction();
    if (!all_finite(next)) return course.stalled();
    radiosity = next;
  }
}

}  // namespace etendue::detail
