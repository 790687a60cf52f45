// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "etendue/form_factor/cell.hpp"
#include "etendue/form_factor/shadow_view.hpp"

namespace etendue {

/// What is integrated over the source: the factor of what is hidden, or of what is seen.
enum class Integrand { hidden, visible };

/// The integrand at points of a cell.
class CellView {
 public:
  /// The receiver is cut anew at every point.
  CellView(ShadowView& view, Integrand integrand) : view_(view), integrand_(integrand) {}
  /// By the form that a survey of the cell has found, many points at once.
  CellView(ShadowView& view, Integrand integrand, std::span<const ViewCorner> form)
      : view_(view), integrand_(integrand), form_(form), formed_(true) {}
  void look(std::span<const Vec2> points, std::span<double> factors) const;

 private:
  ShadowView& view_;
  Integrand integrand_;
  std::span<const ViewCorner> form_;
  bool formed_ = false;
};

/// A Gauss rule's sum over a cell, and what it met.
struct CellSum {
  double value = 0;
  double low = 1;  ///< least and greatest of the samples
  double high = 0;
  /// Sum over the quadrilaterals of area × the largest coefficient of the highest Legendre polynomial that the nodes
  /// resolve, of all rows and columns of nodes.
  double tail = 0;
  /// Of a cell of four corners without a collapsed one: the same along its first side, and along the next.
  std::array<double, 2> tails{};
  unsigned ends = 0;  ///< a bit for each corner of the cell that a corner of a loop comes near, and is nearest to
  int nodes = 0;      ///< a side
  int evaluations = 0;
};

/// Integrates over the cell with n × n nodes a quadrilateral. Where a corner of a loop touches the cell or comes near,
/// the integrand depends on the direction from there: triangles collapsed into that corner make it smooth again.
[[nodiscard]] CellSum integrate(const CellView& view, const Cell& cell, std::span<const Vec3> near, int n);

/// What only points nearer to such corners than all nodes would tell: where an outline's corner all but touches the cell,
/// the integrand may change by powers of ten within less than the first node's distance. The ends of the cell within a
/// quarter, a sixteenth … of the way from there to the centre are looked at from their middles, down to the area `least`.
/// What differs there from where the two before lead in a straight line counts on the area of the end.
[[nodiscard]] double unseen_at_ends(const CellView& view, const Cell& cell, const CellSum& sum, double least,
                                    int& evaluations);

}  // namespace etendue
