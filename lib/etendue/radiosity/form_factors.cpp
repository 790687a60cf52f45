// SPDX-License-Identifier: Apache-2.0
#include "etendue/radiosity/form_factors.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

constexpr Eigen::Index kLanes = 4;           // partial sums of a row: column j belongs to sum j mod 4
constexpr Eigen::Index kRowsAtOnce = 4;      // they share what is loaded of x
constexpr Eigen::Index kChannelsAtOnce = 3;  // they share what is loaded of F; more are taken in turns
constexpr Eigen::Index kBlocks = 64;         // of rows, the unit that is scheduled

/// Four doubles side by side; the compiler takes two or four at a time, as the processor has it. Lane by lane the same
/// products and sums either way, so the same bits.
typedef double Lanes __attribute__((vector_size(4 * sizeof(double))));
/// The same where they lie among other doubles, at any of their addresses.
typedef double Among __attribute__((vector_size(4 * sizeof(double)), aligned(sizeof(double)), may_alias));

/// Rows of F, `columns` long and as far apart, and channels of x, as far apart.
struct Operands {
  const double* factors;
  const double* x;
  Eigen::Index columns;
};

/// Some rows of F x for some channels, in the fixed order that DenseFactors promises: product[row][channel].
template <Eigen::Index kRows, Eigen::Index kChannels>
[[gnu::always_inline]] inline void multiply(const Operands& by, double (&product)[kRowsAtOnce][kChannelsAtOnce]) {
  Lanes sums[kRowsAtOnce][kChannelsAtOnce] = {};
  const Eigen::Index n = by.columns, whole = n - n % kLanes;
  for (Eigen::Index j = 0; j < whole; j += kLanes) {
    Lanes v[kChannelsAtOnce];
    for (Eigen::Index c = 0; c < kChannels; ++c) v[c] = *reinterpret_cast<const Among*>(by.x + c * n + j);
    for (Eigen::Index r = 0; r < kRows; ++r) {
      const Lanes f = *reinterpret_cast<const Among*>(by.factors + r * n + j);
      for (Eigen::Index c = 0; c < kChannels; ++c) sums[r][c] += f * v[c];
    }
  }
  for (Eigen::Index r = 0; r < kRows; ++r) {
    for (Eigen::Index c = 0; c < kChannels; ++c) {
      const Lanes& lanes = sums[r][c];  // copied: lanes picked by a variable would keep the sums out of the registers
      double s[kLanes] = {lanes[0], lanes[1], lanes[2], lanes[3]};
      for (Eigen::Index j = whole; j < n; ++j) s[j - whole] += by.factors[r * n + j] * by.x[c * n + j];
      product[r][c] = (s[0] + s[2]) + (s[1] + s[3]);
    }
  }
}

template <Eigen::Index kRows, Eigen::Index kChannels>
void multiply_plain(const Operands& by, double (&product)[kRowsAtOnce][kChannelsAtOnce]) {
  multiply<kRows, kChannels>(by, product);
}

#if defined(__x86_64__)
/// AVX2 without FMA: a fused product and sum would have other bits.
template <Eigen::Index kRows, Eigen::Index kChannels>
[[gnu::target("avx2")]] void multiply_wide(const Operands& by, double (&product)[kRowsAtOnce][kChannelsAtOnce]) {
  multiply<kRows, kChannels>(by, product);
}
#endif

template <Eigen::Index kRows, Eigen::Index kChannels>
void multiply_best(const Operands& by, double (&product)[kRowsAtOnce][kChannelsAtOnce]) {
#if defined(__x86_64__)
  static const bool wide = __builtin_cpu_supports("avx2") != 0;
  if (wide) return multiply_wide<kRows, kChannels>(by, product);
#endif
  multiply_plain<kRows, kChannels>(by, product);
}

/// Rows [row, row + kRows) of F x into `product`, from row `at` on.
template <Eigen::Index kRows>
void multiply_rows(const RowMatrix& factors, Eigen::Index row, const Eigen::MatrixXd& x, Eigen::MatrixXd& product,
                   Eigen::Index at) {
  const Eigen::Index n = factors.cols();
  double found[kRowsAtOnce][kChannelsAtOnce];
  for (Eigen::Index first = 0; first < x.cols(); first += kChannelsAtOnce) {
    const Operands by{factors.data() + row * n, x.data() + first * n, n};
    const Eigen::Index channels = std::min(kChannelsAtOnce, x.cols() - first);
    if (channels == 1) multiply_best<kRows, 1>(by, found);
    if (channels == 2) multiply_best<kRows, 2>(by, found);
    if (channels == 3) multiply_best<kRows, 3>(by, found);
    for (Eigen::Index c = 0; c < channels; ++c) {
      for (Eigen::Index r = 0; r < kRows; ++r) product(at + r, first + c) = found[r][c];
    }
  }
}

void check_rows(const FormFactors& factors, const Eigen::MatrixXd& x, Eigen::Index first, Eigen::Index count) {
  require(x.rows() == factors.size(), "FormFactors: one number a patch is multiplied");
  require(first >= 0 && count >= 0 && first + count <= factors.size(), "FormFactors: the rows exist");
}

}  // namespace

void FormFactors::each_block(const std::function<void(Eigen::Index first, Eigen::Index count)>& body) const {
  const Eigen::Index n = size();
  // Whole groups of rows that are multiplied at once; which rows share a block changes no bit.
  const Eigen::Index groups = (n + kRowsAtOnce - 1) / kRowsAtOnce;
  const Eigen::Index side = std::max<Eigen::Index>(1, (groups + kBlocks - 1) / kBlocks) * kRowsAtOnce;
  const auto block = [&](Eigen::Index k) { body(k * side, std::min(side, n - k * side)); };
  const Eigen::Index count = (n + side - 1) / side;
  if (schedule_ && count > 1) {
    schedule_(count, block);
  } else {
    for (Eigen::Index k = 0; k < count; ++k) block(k);
  }
}

Eigen::MatrixXd FormFactors::times(const Eigen::MatrixXd& x) const {
  require(x.rows() == size(), "FormFactors: one number a patch is multiplied");
  Eigen::MatrixXd product(x.rows(), x.cols());
  each_block(
      [&](Eigen::Index first, Eigen::Index count) { product.middleRows(first, count) = rows_times(x, first, count); });
  return product;
}

Eigen::MatrixXd FormFactors::dense() const {
  const Eigen::Index n = size();
  constexpr Eigen::Index kAtOnce = 32;  // columns a pass
  Eigen::MatrixXd matrix(n, n);
  for (Eigen::Index first = 0; first < n; first += kAtOnce) {
    const Eigen::Index count = std::min(kAtOnce, n - first);
    matrix.middleCols(first, count) = times(Eigen::MatrixXd::Identity(n, n).middleCols(first, count));
  }
  return matrix;
}

DenseFactors::DenseFactors(RowMatrix factors, Schedule schedule)
    : FormFactors(std::move(schedule)), factors_(std::move(factors)) {
  require(factors_.rows() == factors_.cols(), "DenseFactors: the matrix is square");
}

DenseFactors::DenseFactors(const Eigen::MatrixXd& factors, Schedule schedule)
    : DenseFactors(RowMatrix(factors), std::move(schedule)) {}

Eigen::MatrixXd DenseFactors::rows_times(const Eigen::MatrixXd& x, Eigen::Index first, Eigen::Index count) const {
  check_rows(*this, x, first, count);
  Eigen::MatrixXd product(count, x.cols());
  Eigen::Index row = 0;
  for (; row + kRowsAtOnce <= count; row += kRowsAtOnce) {
    multiply_rows<kRowsAtOnce>(factors_, first + row, x, product, row);
  }
  for (; row < count; ++row) multiply_rows<1>(factors_, first + row, x, product, row);
  return product;
}

std::optional<FormFactorEntry> DenseFactors::entry_outside(double most) const {
  const Eigen::Index n = size();
  std::vector<char> sound(static_cast<std::size_t>(n), 1);  // a row
  each_block([&](Eigen::Index first, Eigen::Index count) {
    for (Eigen::Index i = first; i < first + count; ++i) {
      const double* row = factors_.data() + i * n;
      int outside = 0;  // counted without a branch
      for (Eigen::Index j = 0; j < n; ++j)
        outside |= static_cast<int>(!(row[j] >= 0)) | static_cast<int>(!(row[j] <= most));
      if (outside != 0) sound[static_cast<std::size_t>(i)] = 0;
    }
  });
  for (Eigen::Index i = 0; i < n; ++i) {
    if (sound[static_cast<std::size_t>(i)] != 0) continue;
    for (Eigen::Index j = 0; j < n; ++j) {
      if (!(factors_(i, j) >= 0 && factors_(i, j) <= most)) return FormFactorEntry{i, j, factors_(i, j)};
    }
  }
  return std::nullopt;
}

SparseFactors::SparseFactors(SparseRows factors, Schedule schedule)
    : FormFactors(std::move(schedule)), factors_(std::move(factors)) {
  require(factors_.rows() == factors_.cols(), "SparseFactors: the matrix is square");
  factors_.makeCompressed();
  columns_ = factors_;
  for (Eigen::Index i = 0; i < factors_.rows(); ++i) {
    const auto entries = factors_.outerIndexPtr()[i + 1] - factors_.outerIndexPtr()[i];
    roundings_ = std::max(roundings_, static_cast<int>(entries) + 1);
  }
}

Eigen::MatrixXd SparseFactors::rows_times(const Eigen::MatrixXd& x, Eigen::Index first, Eigen::Index count) const {
  check_rows(*this, x, first, count);
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(count, x.cols());
  for (Eigen::Index i = 0; i < count; ++i) {
    for (SparseRows::InnerIterator entry(factors_, first + i); entry; ++entry) {
      for (Eigen::Index c = 0; c < x.cols(); ++c) product(i, c) += entry.value() * x(entry.col(), c);
    }
  }
  return product;
}

std::optional<FormFactorEntry> SparseFactors::entry_outside(double most) const {
  for (Eigen::Index i = 0; i < factors_.rows(); ++i) {
    for (SparseRows::InnerIterator entry(factors_, i); entry; ++entry) {
      if (!(entry.value() >= 0 && entry.value() <= most)) return FormFactorEntry{i, entry.col(), entry.value()};
    }
  }
  return std::nullopt;
}

OperatorFactors::OperatorFactors(Eigen::Index size, int roundings, Times times)
    : size_(size), roundings_(roundings), times_(std::move(times)) {
  require(size_ >= 0 && roundings_ >= 0, "OperatorFactors: numbers of patches and roundings are not negative");
  require(static_cast<bool>(times_), "OperatorFactors: there is a function that multiplies");
}

Eigen::MatrixXd OperatorFactors::times(const Eigen::MatrixXd& x) const {
  require(x.rows() == size_, "FormFactors: one number a patch is multiplied");
  Eigen::MatrixXd product = times_(x);
  require(product.rows() == size_ && product.cols() == x.cols(), "OperatorFactors: the product has the size of x");
  return product;
}

Eigen::MatrixXd OperatorFactors::rows_times(const Eigen::MatrixXd&, Eigen::Index, Eigen::Index) const {
  throw ContractViolation("OperatorFactors: rows are not to be had one at a time");
}

Eigen::VectorXd OperatorFactors::column(Eigen::Index) const {
  throw ContractViolation("OperatorFactors: columns are not to be had one at a time");
}

}  // namespace etendue
