// SPDX-License-Identifier: Apache-2.0
#include "etendue/form_factor/common_shadow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "etendue/form_factor/certified_contour.hpp"
#include "etendue/form_factor/gauss_legendre.hpp"

namespace etendue {

namespace {

using Mask = std::uint32_t;

EnclosedOutline reversed(EnclosedOutline outline) {
  std::reverse(outline.begin(), outline.end());
  return outline;
}

class CommonShadow {
 public:
  CommonShadow(const Interval3& corner, const SourceTriangle& source, const SignedPart& receiver,
               const std::vector<const EnclosedBlocker*>& blockers, double goal, std::int64_t budget)
      : corner_(corner), source_(source), receiver_(receiver), blockers_(blockers), goal_(goal), budget_(budget) {
    for (const EnclosedBlocker* b : blockers) {
      const Interval3& n = b->plane.normal();
      sides_.push_back({b->plane.height(corner), dot(n, source.along), dot(n, source.across)});
    }
    area_ = norm(source.normal).upper;  // doubled
    all_ = std::make_unique<ShadowTerm>(source, std::vector<EnclosedOutline>{relative(receiver.outline)});
  }

  HiddenFlux enclose() {
    push({{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}});
    while (work_ < budget_ && !heap_.empty() && 0.5 * open_ > goal_) {
      std::pop_heap(heap_.begin(), heap_.end());
      const Cell cell = heap_.back();
      heap_.pop_back();
      open_ = std::max(0.0, open_ - cell.width);
      split(cell);
    }
    Interval flux = certain_ + Interval(-slack_, slack_);
    for (const Cell& cell : heap_) flux = flux + cell.flux;
    bool enclosed = true;
    for (const auto& [side, term] : terms_) {
      if (!term) continue;
      flux = flux + Interval(-term->slack(), term->slack());
      enclosed = enclosed && !term->touching();
    }
    return {{std::max(0.0, flux.lower), std::max(0.0, flux.upper)}, work_, enclosed};
  }

 private:
  struct Cell {
    SourceCell place;
    Interval flux;
    double width = 0;
    std::optional<Affine> cut;
    bool operator<(const Cell& other) const { return width < other.width; }
  };
  /// The shadow from one cell.
  struct Shadow {
    bool known = false, loose = false;
    const ShadowTerm* term = nullptr;
    std::vector<ShadowTerm::Arc> arcs;
    std::optional<Affine> cut;
    double share = 0;  ///< of the cell, times what the integrand may be wrong by there
  };

  EnclosedOutline relative(const EnclosedOutline& outline) const {
    EnclosedOutline result;
    for (const Interval3& v : outline) result.push_back(v - corner_);
    return result;
  }

  /// For a source in front of those planes whose bits are set; nothing where no receiver is beyond all of them.
  const ShadowTerm* term(Mask in_front) {
    const auto found = terms_.find(in_front);
    if (found != terms_.end()) return found->second.get();
    EnclosedOutline rest = receiver_.outline;
    std::vector<EnclosedOutline> loops(1);
    for (std::size_t k = 0; k < blockers_.size() && !rest.empty(); ++k) {
      const bool front = (in_front >> k & 1u) != 0;
      rest = beyond(rest, blockers_[k]->plane, front);
      const EnclosedOutline loop =
          relative(EnclosedOutline(blockers_[k]->vertices.begin(), blockers_[k]->vertices.end()));
      loops.push_back(front ? loop : reversed(loop));
    }
    auto& slot = terms_[in_front];
    if (rest.empty()) return nullptr;
    loops.front() = relative(rest);
    slot = std::make_unique<ShadowTerm>(source_, std::move(loops));
    return slot.get();
  }

  /// Corners of cuts that may lie on either side count as on the plane; what that moves is a part of the receiver.
  EnclosedOutline beyond(const EnclosedOutline& outline, const ExactPlane& plane, bool front) {
    std::vector<Interval> heights;
    double off = 0, outline_length = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Interval3& v = outline[i];
      outline_length = above(outline_length + norm(outline[(i + 1) % outline.size()] - v).upper);
      const bool point = v.x.width() == 0 && v.y.width() == 0 && v.z.width() == 0;
      Interval h = point ? plane.height(v.middle()) : plane.height(v);
      if (h.contains(0.0) && !h.is_zero()) {
        off = std::max(off, h.magnitude());
        h = Interval();
      }
      heights.push_back(front ? -h : h);
    }
    if (off > 0) {
      Interval3 area;
      for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
        area = area + cross(outline[i] - outline[0], outline[i + 1] - outline[0]);
      }
      // off and the sine both carry the length of the plane's normal: one division each, and the area's for the other.
      const Interval sine = norm(cross(area, plane.normal())) / norm(area);
      const double swept = (Interval(off) / sine * outline_length).upper;
      slack_ = above(slack_ + (sine.lower > 0 ? std::min(swept, norm(area).upper) : norm(area).upper));
    }
    return clipped(outline, heights);
  }

  Shadow shadow(const SourceCell& cell) {
    Shadow result;
    Mask in_front = 0;
    for (std::size_t k = 0; k < blockers_.size(); ++k) {
      const CellSign side = sign_over(sides_[k], cell);
      if (side.sign == 0) {
        if (side.mixed) result.cut = sides_[k];
        return result;
      }
      result.share = above(result.share + side.share);
      if (side.sign > 0) in_front |= Mask{1} << k;
    }
    result.term = term(in_front);
    result.known = true;
    if (result.term != nullptr) {
      auto topology = result.term->topology(cell);
      result.known = topology.known;
      result.loose = topology.loose;
      result.cut = topology.cut;
      result.share = above(result.share + topology.share);
      result.arcs = std::move(topology.arcs);
    }
    // Where the topology is wrong the sum is, by at most half for each arc, and what is true is at most one.
    result.share = above(result.share * (2 + 0.5 * static_cast<double>(result.arcs.size())));
    return result;
  }

  double cell_area(const SourceCell& cell) const {
    return (abs(doubled_area(cell.corners[0], cell.corners[1], cell.corners[2])) * Interval(0.5 * area_)).upper;
  }

  /// From nothing to what the receiver gets at most from anywhere in the cell.
  Interval bracket(const SourceCell& cell) const {
    std::vector<ShadowTerm::Arc> arcs;
    for (std::size_t e = 0; e < receiver_.outline.size(); ++e) arcs.push_back({e, {}, {}});
    const double most = all_->flux_density_over(arcs, cell).upper;
    const double half_area = abs(doubled_area(cell.corners[0], cell.corners[1], cell.corners[2])).upper;
    return {0, std::min(cell_area(cell), above(above(0.5 * half_area) * std::max(0.0, most)))};
  }

  void push(const SourceCell& place) {
    ++work_;
    const Shadow found = shadow(place);
    Cell cell{place, Interval(), 0, found.cut};
    if (found.known && integrate(place, found)) {
      slack_ = above(slack_ + above(cell_area(place) * found.share));
      return;
    }
    cell.flux = bracket(place);
    if ((found.known || found.loose) && found.term != nullptr) {
      const Interval half_area =
          abs(doubled_area(place.corners[0], place.corners[1], place.corners[2])) * Interval(0.5);
      const double wrong = above(cell_area(place) * found.share);
      const Interval flux = half_area * found.term->flux_density_over(found.arcs, place) + Interval(-wrong, wrong);
      cell.flux = {std::max(cell.flux.lower, flux.lower), std::min(cell.flux.upper, std::max(0.0, flux.upper))};
      cell.flux.lower = std::min(cell.flux.lower, cell.flux.upper);
    }
    cell.width = cell.flux.width();
    open_ += cell.width;
    heap_.push_back(cell);
    std::push_heap(heap_.begin(), heap_.end());
  }

  /// Bounds the integrand on the ellipse ρ in one variable of (u, v) = A + r (B − A + s (C − B)).
  static double largest(const Shadow& found, const SourceCell& cell, double rho, bool first) {
    const auto variable = first ? ShadowTerm::Variable::r : ShadowTerm::Variable::s;
    const double sum = found.term->largest(found.arcs, cell, variable, rho);
    // The weight r is part of the integrand.
    return first ? (Interval(sum) * (Interval(0.5) + Interval(0.25) * (Interval(rho) + Interval(1) / rho))).upper : sum;
  }

  bool integrate(const SourceCell& cell, const Shadow& found) {
    if (found.arcs.empty()) return true;
    const Interval jacobian = abs(doubled_area(cell.corners[0], cell.corners[1], cell.corners[2]));
    // A share of the goal by area, and never less than what cells of the least size would have.
    const double wanted = std::max(goal_ * 0.5 * jacobian.upper, kLeastShare * goal_);
    std::array<int, 2> nodes{};
    double truncation = 0;
    for (std::size_t variable = 0; variable < 2; ++variable) {
      double best = 0;
      for (const double rho : {1.5, 2.2, 3.5, 6.0, 12.0}) {
        const double bound = largest(found, cell, rho, variable == 0);
        if (!(bound < 1 / kLeastShare)) break;
        for (int n = 2; n <= kMostNodes; ++n) {
          const double error = (jacobian * Interval(0.5) * bound * certain_analytic_truncation(n, rho)).upper;
          if (error > 0.5 * wanted) continue;
          if (nodes[variable] == 0 || n < nodes[variable]) {
            nodes[variable] = n;
            best = error;
          }
          break;
        }
      }
      ++work_;
      if (nodes[variable] == 0) return false;
      truncation = above(truncation + best);
    }
    const Interval sum = gauss(cell, found, nodes);
    certain_ = certain_ + jacobian * sum + Interval(-truncation, truncation);
    return true;
  }

  Interval gauss(const SourceCell& cell, const Shadow& found, const std::array<int, 2>& nodes) {
    const auto& c = cell.corners;
    const auto node = [](const QuadratureNode& q) {
      return Interval(0.5) * (Interval(1) + Interval(below(q.x), above(q.x)));
    };
    const auto weight = [](const QuadratureNode& q) {
      return Interval(0.5) * Interval(below(q.weight), above(q.weight));
    };
    Interval sum;
    for (const QuadratureNode& i : gauss_legendre(nodes[0])) {
      const Interval r = node(i);
      for (const QuadratureNode& j : gauss_legendre(nodes[1])) {
        const Interval s = node(j);
        std::array<Interval, 2> uv;
        for (std::size_t k = 0; k < 2; ++k) {
          const auto axis = static_cast<Eigen::Index>(k);
          const Interval ab = Interval(c[1][axis]) - c[0][axis], bc = Interval(c[2][axis]) - c[1][axis];
          uv[k] = c[0][axis] + r * (ab + s * bc);
        }
        const Interval value = found.term->flux_density(found.arcs, uv[0], uv[1]);
        work_ += static_cast<std::int64_t>(found.arcs.size());
        sum = sum + weight(i) * weight(j) * r * value;
      }
    }
    return sum;
  }

  void split(const Cell& cell) {
    if (cell.cut && cut_along(cell.place, *cell.cut)) return;
    const auto& c = cell.place.corners;
    std::size_t longest = 0;
    double length = -1;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 way = c[(i + 1) % 3] - c[i];
      const double here = (way.x() * source_.along.middle() + way.y() * source_.across.middle()).norm();
      if (here > length) {
        length = here;
        longest = i;
      }
    }
    const Vec2 &a = c[longest], &b = c[(longest + 1) % 3], &d = c[(longest + 2) % 3];
    const Vec2 middle = 0.5 * (a + b);
    if (middle == a || middle == b) {
      certain_ = certain_ + cell.flux;
      return;
    }
    charge(a, b, middle);
    push_if_any({{a, middle, d}});
    push_if_any({{middle, b, d}});
  }

  /// Where the rounded point leaves the line from a to b: that triangle counts twice at most.
  void charge(const Vec2& a, const Vec2& b, const Vec2& point) {
    const Interval sliver = abs(doubled_area(a, b, point)) * Interval(0.5) * area_;
    slack_ = above(slack_ + sliver.upper);
  }

  void push_if_any(const SourceCell& cell) {
    const Interval area = doubled_area(cell.corners[0], cell.corners[1], cell.corners[2]);
    if (area.lower > 0) {
      push(cell);
    } else {
      slack_ = above(slack_ + (abs(area) * Interval(0.5) * area_).upper);
    }
  }

  bool cut_along(const SourceCell& cell, const Affine& line) {
    std::array<double, 3> level{};
    int positive = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      level[i] = line(cell.corners[i].x(), cell.corners[i].y()).middle();
      positive += level[i] > 0;
    }
    if (positive == 0 || positive == 3) return false;
    std::size_t alone = 0;
    while ((level[alone] > 0) != (positive == 1)) ++alone;
    const std::size_t next = (alone + 1) % 3, last = (alone + 2) % 3;
    const Vec2 &a = cell.corners[alone], &b = cell.corners[next], &c = cell.corners[last];
    const auto between = [&](std::size_t other) -> Vec2 {
      const double t = std::clamp(level[alone] / (level[alone] - level[other]), 0.0, 1.0);
      return a + t * (cell.corners[other] - a);
    };
    const Vec2 p = between(next), q = between(last);
    if ((p == a && q == a) || (p == b && q == c)) return false;
    charge(a, b, p);
    charge(a, c, q);
    push_if_any({{a, p, q}});
    push_if_any({{p, b, c}});
    push_if_any({{p, c, q}});
    return true;
  }

  static constexpr int kMostNodes = 12;
  static constexpr double kLeastShare = 0x1p-16;
  const Interval3& corner_;
  const SourceTriangle& source_;
  const SignedPart& receiver_;
  const std::vector<const EnclosedBlocker*>& blockers_;
  double goal_;
  std::int64_t budget_;
  std::vector<Affine> sides_;
  double area_ = 0;
  std::unique_ptr<ShadowTerm> all_;
  std::map<Mask, std::unique_ptr<ShadowTerm>> terms_;
  std::vector<Cell> heap_;
  Interval certain_;
  double open_ = 0, slack_ = 0;
  std::int64_t work_ = 0;
};

}  // namespace

HiddenFlux common_shadow(const Interval3& corner, const SourceTriangle& source, const SignedPart& receiver,
                         const std::vector<const EnclosedBlocker*>& blockers, double goal, std::int64_t budget) {
  return CommonShadow(corner, source, receiver, blockers, goal, budget).enclose();
}

}  // namespace etendue
