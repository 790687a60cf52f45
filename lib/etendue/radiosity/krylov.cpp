// SPDX-License-Identifier: Apache-2.0
// Eigen's Krylov methods on all channels at once: their unknowns stand one under the other, so that one pass over F serves
// all of them.
#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/IterativeSolvers>
#include <utility>

#include "etendue/linear/dense_solve.hpp"
#include "etendue/radiosity/iteration.hpp"

namespace etendue::detail {
class StackedSystem;
}

template <>
struct Eigen::internal::traits<etendue::detail::StackedSystem>
    : public Eigen::internal::traits<Eigen::SparseMatrix<double>> {};

namespace etendue::detail {

/// I − diag(ρ)F for each channel, as Eigen wants a matrix that only multiplies.
class StackedSystem : public Eigen::EigenBase<StackedSystem> {
 public:
  using Scalar = double;
  using RealScalar = double;
  using StorageIndex = int;
  enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic, IsRowMajor = 0 };

  explicit StackedSystem(Course& course) : course_(&course) {}

  Eigen::Index rows() const { return course_->equation().emission.size(); }
  Eigen::Index cols() const { return rows(); }
  template <class Rhs>
  Eigen::Product<StackedSystem, Rhs, Eigen::AliasFreeProduct> operator*(const Eigen::MatrixBase<Rhs>& x) const {
    return {*this, x.derived()};
  }

  Eigen::VectorXd times(const Eigen::VectorXd& stacked) const {
    const Eigen::MatrixXd& rho = course_->equation().reflectance;
    const Eigen::MatrixXd x = Eigen::Map<const Eigen::MatrixXd>(stacked.data(), rho.rows(), rho.cols());
    const Eigen::MatrixXd product = x - rho.cwiseProduct(course_->times(x));
    return Eigen::Map<const Eigen::VectorXd>(product.data(), product.size());
  }

 private:
  Course* course_;
};

}  // namespace etendue::detail

template <class Rhs>
struct Eigen::internal::generic_product_impl<etendue::detail::StackedSystem, Rhs, Eigen::SparseShape, Eigen::DenseShape,
                                             Eigen::GemvProduct>
    : Eigen::internal::generic_product_impl_base<
          etendue::detail::StackedSystem, Rhs,
          Eigen::internal::generic_product_impl<etendue::detail::StackedSystem, Rhs>> {
  using Scalar = double;
  template <class Dest>
  static void scaleAndAddTo(Dest& to, const etendue::detail::StackedSystem& matrix, const Rhs& x,
                            const Scalar& factor) {
    to.noalias() += factor * matrix.times(x);
  }
};

namespace etendue::detail {

namespace {

/// Search directions between two judgements of the whole bound.
constexpr Eigen::Index kStepsAtOnce = 100;
/// What GMRES keeps; longer memories gain nothing where the spectrum is that of interreflections.
constexpr Eigen::Index kRestart = 30;

/// Improves B by what the method says of the residual until the bound is reached: the method's own measure, a norm of all
/// channels, says how far to go at a time, the bound when to end.
template <class Method, class Prepare>
void refine(Course& course, const Prepare& prepare) {
  const StackedSystem system(course);
  Eigen::MatrixXd radiosity = course.equation().emission;
  const Eigen::Index n = radiosity.rows(), channels = radiosity.cols();
  constexpr double kNoProgress = 0.99, kMargin = 0.1, kLeast = 1e-14;
  for (double last = 0; !course.ends_with(radiosity); last = course.excess()) {
    if (last > 0 && course.excess() > kNoProgress * last) return course.stalled();
    Eigen::MatrixXd residuals = course.judgement().residuals;
    const Eigen::VectorXd unit = units(residuals);
    Eigen::VectorXd scale(channels);  // so that no channel drowns in another
    for (Eigen::Index c = 0; c < channels; ++c) {
      residuals.col(c) /= unit(c);
      const double norm = residuals.col(c).norm();
      scale(c) = norm > 0 ? norm : 1;
      residuals.col(c) /= scale(c);
    }
    Method method;
    method.setMaxIterations(std::min(course.steps_left(), kStepsAtOnce));
    method.setTolerance(std::clamp(kMargin / course.excess(), kLeast, kMargin));
    prepare(method);
    method.compute(system);
    const Eigen::VectorXd stacked = Eigen::Map<const Eigen::VectorXd>(residuals.data(), residuals.size());
    const Eigen::VectorXd found = method.solve(stacked);
    course.count(std::max<Eigen::Index>(1, method.iterations()));
    Eigen::MatrixXd next = radiosity;
    for (Eigen::Index c = 0; c < channels; ++c) next.col(c) += unit(c) * (scale(c) * found.segment(c * n, n));
    if (!all_finite(next)) return course.stalled();
    radiosity = std::move(next);
  }
}

}  // namespace

void gmres(Course& course) {
  refine<Eigen::GMRES<StackedSystem, Eigen::IdentityPreconditioner>>(
      course, [&](auto& method) { method.set_restart(std::min(kRestart, course.equation().emission.size())); });
}

void bicgstab(Course& course) {
  refine<Eigen::BiCGSTAB<StackedSystem, Eigen::IdentityPreconditioner>>(course, [](auto&) {});
}

}  // namespace etendue::detail
